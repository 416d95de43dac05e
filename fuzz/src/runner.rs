//! The loop: make a case, try it, keep what is new, tell what is wrong.

use crate::coverage::Seen;
use crate::mutate::below;
use crate::targets::Target;
use crate::{memory, watch};
use cpu_time::ProcessTime;
use std::collections::BTreeMap;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Duration;
use trueness_geom::num::random::Random;

/// How long, and from where.
pub struct Plan {
    /// Stop after this processor time of the whole process, seconds.
    pub seconds: f64,
    /// Stop after so many cases.
    pub cases: u64,
    /// Beginning of the random numbers.
    pub seed: u64,
    /// Memory for one case, whatever its size.
    pub base: usize,
    /// Where findings go.
    pub findings: PathBuf,
}

/// Memory for each byte of the file, beyond [`Plan::base`].
pub const FACTOR: usize = 20;

/// Where the last panic happened, and what it said.
static SAID: Mutex<String> = Mutex::new(String::new());

/// Keeps panics quiet and remembers them.
pub fn listen() {
    std::panic::set_hook(Box::new(|about| {
        if let Ok(mut said) = SAID.lock() {
            *said = about.to_string().replace('\n', " ");
        }
    }));
}

/// Tries `target` as planned; seeds come from the folder `corpus`. Returns the number of findings.
pub fn run(target: &Target, corpus: &Path, plan: &Plan) -> io::Result<usize> {
    let mut run = Run::of(target, plan)?;
    let mut pool = (target.seeds)(corpus);
    println!("{}: {} seeds, {} counters", target.name, pool.len(), run.seen.counters());
    for seed in &pool {
        run.case(seed)?;
    }
    let mut random = Random::new(plan.seed);
    let mut next = 0.0;
    while run.cases < plan.cases && run.seconds() < plan.seconds {
        let newest = pool.len().saturating_sub(50);
        let from = if random.below(2) == 0 { newest } else { 0 };
        let (a, b) = (from + below(&mut random, pool.len() - from), below(&mut random, pool.len()));
        let case = (target.mutate)(&mut random, &pool[a], &pool[b]);
        if run.case(&case)? {
            pool.push(case);
        }
        if run.seconds() > next {
            next += 60.0;
            println!("{}, {} kept", run.progress(), pool.len());
        }
    }
    println!("{}, {} kept, {}", run.progress(), pool.len(), run.extremes());
    run.end()
}

/// Tries one case from a file. Returns the number of findings.
pub fn replay(target: &Target, case: &Path, plan: &Plan) -> io::Result<usize> {
    let bytes = std::fs::read(case)?;
    let mut run = Run::of(target, plan)?;
    run.case(&bytes)?;
    println!("{}, {}", run.progress(), run.extremes());
    run.end()
}

struct Run<'a> {
    target: &'a Target,
    plan: &'a Plan,
    /// Where the case under way lies.
    file: PathBuf,
    begin: ProcessTime,
    seen: Seen,
    cases: u64,
    /// How often each thing was found.
    found: BTreeMap<String, usize>,
    /// The greatest memory of a case.
    peak: usize,
    /// The longest case, processor time.
    longest: Duration,
}

impl<'a> Run<'a> {
    fn of(target: &'a Target, plan: &'a Plan) -> io::Result<Run<'a>> {
        std::fs::create_dir_all(&plan.findings)?;
        let name = format!("{}-now-{}.{}", target.name, std::process::id(), target.extension);
        Ok(Run {
            target,
            plan,
            file: plan.findings.join(name),
            begin: ProcessTime::now(),
            seen: Seen::new(),
            cases: 0,
            found: BTreeMap::new(),
            peak: 0,
            longest: Duration::ZERO,
        })
    }

    /// Processor time since the beginning.
    fn seconds(&self) -> f64 {
        self.begin.elapsed().as_secs_f64()
    }

    fn progress(&self) -> String {
        let (name, edges) = (self.target.name, self.seen.edges());
        format!("{name}: {:.0} s, {} cases, {edges} edges", self.seconds(), self.cases)
    }

    fn extremes(&self) -> String {
        let (peak, longest, findings) = (self.peak / 1000, self.longest.as_secs_f64(), self.found.len());
        format!("most memory {peak} kB, longest case {longest:.2} s, {findings} findings")
    }

    /// Number of findings.
    fn end(self) -> io::Result<usize> {
        std::fs::remove_file(&self.file)?;
        Ok(self.found.len())
    }

    /// Tries a case; true if it went where none went before.
    fn case(&mut self, bytes: &[u8]) -> io::Result<bool> {
        // Should the program end here, the case is still there.
        std::fs::write(&self.file, bytes)?;
        self.seen.reset();
        let begin = ProcessTime::now();
        let job = || catch_unwind(AssertUnwindSafe(|| (self.target.run)(bytes, &self.file)));
        let (result, memory) = watch::over(&self.file, || memory::measured(job));
        self.longest = self.longest.max(begin.elapsed());
        let new = self.seen.is_new();
        self.cases += 1;
        self.peak = self.peak.max(memory);
        if result.is_err() {
            let said = SAID.lock().map(|s| s.clone()).unwrap_or_default();
            self.finding(bytes, &said)?;
        }
        let allowed = self.plan.base + FACTOR * (self.target.size)(bytes);
        if memory > allowed {
            self.finding(bytes, &format!("memory beyond {allowed} bytes: {memory}"))?;
        }
        Ok(new)
    }

    /// Writes the case down, unless the same was found before.
    fn finding(&mut self, bytes: &[u8], said: &str) -> io::Result<()> {
        // The same place is the same finding, whatever the numbers in its message.
        let key: String = said.chars().take(60).filter(|c| !c.is_ascii_digit()).collect();
        let times = self.found.entry(key).or_default();
        *times += 1;
        if *times > 1 {
            return Ok(());
        }
        let name = format!("{}-{}.{}", self.target.name, self.found.len(), self.target.extension);
        let path = self.plan.findings.join(name);
        std::fs::write(&path, bytes)?;
        println!("FOUND {}: {said}", path.display());
        Ok(())
    }
}

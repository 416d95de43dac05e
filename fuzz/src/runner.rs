//! The loop: make a case, try it, keep what is new, tell what is wrong.

use crate::coverage::Seen;
use crate::memory;
use crate::mutate::below;
use crate::target::Target;
use cpu_time::ProcessTime;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};
use trueness_geom::num::random::Random;

/// How long, and from where.
pub struct Plan {
    /// Stop after this time.
    pub seconds: f64,
    /// Stop after so many cases.
    pub cases: u64,
    /// Beginning of the random numbers.
    pub seed: u64,
    /// Processor time for one case.
    pub case_seconds: f64,
    /// Memory for one case, whatever its size.
    pub base: usize,
    /// Where findings go.
    pub findings: PathBuf,
}

/// Memory for each byte of the file, beyond [`Plan::base`].
pub const FACTOR: usize = 20;

/// What a run came to.
pub struct Outcome {
    /// Cases tried.
    pub cases: u64,
    /// Different findings.
    pub findings: usize,
    /// The greatest memory of a case.
    pub peak: usize,
    /// The longest case.
    pub longest: Duration,
}

/// Where the last panic happened, and what it said.
static SAID: Mutex<String> = Mutex::new(String::new());
/// Since when the case under way runs, in milliseconds since the start; 0 between cases.
static SINCE: AtomicU64 = AtomicU64::new(0);

/// Keeps panics quiet and remembers them.
pub fn listen() {
    std::panic::set_hook(Box::new(|about| {
        if let Ok(mut said) = SAID.lock() {
            *said = about.to_string().replace('\n', " ");
        }
    }));
}

/// Ends the program when a case takes too long: it cannot be stopped otherwise. The case stays in its file. What counts is
/// the processor's time, so that a busy machine is not a finding; many times as long without any is one, too.
fn watch(start: Instant, seconds: f64, file: PathBuf) {
    const IDLE: f64 = 30.0;
    std::thread::spawn(move || {
        let (mut case, mut cpu) = (0, ProcessTime::now());
        loop {
            std::thread::sleep(Duration::from_millis(200));
            let since = SINCE.load(Relaxed);
            if since != case {
                (case, cpu) = (since, ProcessTime::now());
            }
            let wall = start.elapsed().as_secs_f64() - since as f64 / 1e3;
            if since > 0 && (cpu.elapsed().as_secs_f64() > seconds || wall > IDLE * seconds) {
                eprintln!("FOUND a case that takes longer than {seconds} s: {}", file.display());
                std::process::exit(1);
            }
        }
    });
}

/// Tries `target` as planned; seeds come from the folder `corpus`.
pub fn run(target: &Target, corpus: &Path, plan: &Plan) -> std::io::Result<Outcome> {
    std::fs::create_dir_all(&plan.findings)?;
    let file = plan.findings.join(format!("{}-now-{}.{}", target.name, std::process::id(), target.extension));
    let start = Instant::now();
    watch(start, plan.case_seconds, file.clone());
    let mut run =
        Run { target, plan, file, start, seen: Seen::new(), found: BTreeMap::new(), outcome: nothing() };
    let mut pool = (target.seeds)(corpus);
    println!("{}: {} seeds, {} counters", target.name, pool.len(), run.seen.counters());
    for seed in &pool {
        run.case(seed)?;
    }
    let mut random = Random::new(plan.seed);
    let mut next = 0.0;
    while run.outcome.cases < plan.cases && start.elapsed().as_secs_f64() < plan.seconds {
        let newest = pool.len().saturating_sub(50);
        let from = if random.below(2) == 0 { newest } else { 0 };
        let (a, b) = (from + below(&mut random, pool.len() - from), below(&mut random, pool.len()));
        let case = (target.mutate)(&mut random, &pool[a], &pool[b]);
        if run.case(&case)? {
            pool.push(case);
        }
        if start.elapsed().as_secs_f64() > next {
            next += 60.0;
            let (o, edges) = (&run.outcome, run.seen.edges());
            let seconds = start.elapsed().as_secs();
            println!("{}: {seconds} s, {} cases, {} kept, {edges} edges", target.name, o.cases, pool.len());
        }
    }
    std::fs::remove_file(&run.file)?;
    let edges = run.seen.edges();
    let o = run.outcome;
    println!(
        "{}: {:.0} s, {} cases, {} kept, {edges} edges, most memory {} kB, longest case {:.2} s, {} findings",
        target.name,
        start.elapsed().as_secs_f64(),
        o.cases,
        pool.len(),
        o.peak / 1000,
        o.longest.as_secs_f64(),
        o.findings
    );
    Ok(o)
}

/// Tries one case from a file.
pub fn replay(target: &Target, case: &Path, plan: &Plan) -> std::io::Result<Outcome> {
    let bytes = std::fs::read(case)?;
    std::fs::create_dir_all(&plan.findings)?;
    let file = plan.findings.join(format!("{}-now-{}.{}", target.name, std::process::id(), target.extension));
    let start = Instant::now();
    watch(start, plan.case_seconds, file.clone());
    let mut run =
        Run { target, plan, file, start, seen: Seen::new(), found: BTreeMap::new(), outcome: nothing() };
    run.case(&bytes)?;
    std::fs::remove_file(&run.file)?;
    Ok(run.outcome)
}

fn nothing() -> Outcome {
    Outcome { cases: 0, findings: 0, peak: 0, longest: Duration::ZERO }
}

struct Run<'a> {
    target: &'a Target,
    plan: &'a Plan,
    file: PathBuf,
    start: Instant,
    seen: Seen,
    /// How often each thing was found.
    found: BTreeMap<String, usize>,
    outcome: Outcome,
}

impl Run<'_> {
    /// Tries a case; true if it went where none went before.
    fn case(&mut self, bytes: &[u8]) -> std::io::Result<bool> {
        // Should the program end here, the case is still there.
        std::fs::write(&self.file, bytes)?;
        self.seen.reset();
        let begin = self.start.elapsed();
        SINCE.store(begin.as_millis() as u64 + 1, Relaxed);
        let job = || catch_unwind(AssertUnwindSafe(|| (self.target.run)(bytes, &self.file)));
        let (result, memory) = memory::measured(job);
        SINCE.store(0, Relaxed);
        let new = self.seen.is_new();
        self.outcome.cases += 1;
        self.outcome.peak = self.outcome.peak.max(memory);
        self.outcome.longest = self.outcome.longest.max(self.start.elapsed() - begin);
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
    fn finding(&mut self, bytes: &[u8], said: &str) -> std::io::Result<()> {
        // The same place is the same finding, whatever the numbers in its message.
        let key: String = said.chars().take(60).filter(|c| !c.is_ascii_digit()).collect();
        let times = self.found.entry(key).or_default();
        *times += 1;
        if *times > 1 {
            return Ok(());
        }
        self.outcome.findings += 1;
        let name = format!("{}-{}.{}", self.target.name, self.outcome.findings, self.target.extension);
        let path = self.plan.findings.join(name);
        std::fs::write(&path, bytes)?;
        println!("FOUND {}: {said}", path.display());
        Ok(())
    }
}

//! Broken and odd input for the readers, the check and the repair, made by changing good input: no panic, no hang, no memory without
//! bound. See README.md.

mod coverage;
mod deform;
mod memory;
mod mutate;
mod runner;
mod targets;
mod watch;

use runner::Plan;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use targets::{TARGETS, Target};

#[global_allocator]
static ALLOCATOR: memory::Counting = memory::Counting;

const HELP: &str = "\
trueness-fuzz [--target NAME]... [--seconds S | --cases N] [--seed N] [--threads N] [--replay FILE]

Targets: stl ply obj off table npy gz check repair; all without --target, one after the other.
Each is tried for 60 s, or as many as --seconds says: processor time of the process, not that of the clock.
Exit status: 0 nothing found, 1 something found, 2 wrong usage.";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let asked = match Asked::of(&words) {
        Ok(asked) => asked,
        Err(why) => {
            eprintln!("{why}\n\n{HELP}");
            return ExitCode::from(2);
        }
    };
    match asked.run() {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::from(1),
        Err(e) => {
            eprintln!("{e}");
            ExitCode::from(2)
        }
    }
}

/// Processor time for one case.
const CASE_SECONDS: f64 = 10.0;

struct Asked {
    targets: Vec<&'static Target>,
    threads: usize,
    replay: Option<PathBuf>,
    plan: Plan,
}

impl Asked {
    fn of(words: &[String]) -> Result<Asked, String> {
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        let plan =
            Plan { seconds: 60.0, cases: u64::MAX, seed: 1, base: 24 << 20, findings: here.join("findings") };
        let mut asked = Asked { targets: vec![], threads: 1, replay: None, plan };
        let mut words = words.iter();
        while let Some(word) = words.next() {
            let value = words.next().ok_or(format!("{word}: its value is missing"))?;
            let wrong = || format!("{word} {value}: give a number");
            match word.as_str() {
                "--target" => {
                    let known = TARGETS.iter().find(|t| t.name == value);
                    asked.targets.push(known.ok_or(format!("{value}: there is no such target"))?);
                }
                "--seconds" => asked.plan.seconds = value.parse().map_err(|_| wrong())?,
                "--cases" => {
                    asked.plan.cases = value.parse().map_err(|_| wrong())?;
                    asked.plan.seconds = f64::INFINITY;
                }
                "--seed" => asked.plan.seed = value.parse().map_err(|_| wrong())?,
                "--threads" => asked.threads = value.parse().map_err(|_| wrong())?,
                "--replay" => asked.replay = Some(value.into()),
                _ => return Err(format!("{word}: there is no such option")),
            }
        }
        if asked.targets.is_empty() {
            asked.targets = TARGETS.iter().collect();
        }
        Ok(asked)
    }

    /// Number of findings.
    fn run(&self) -> Result<usize, Box<dyn std::error::Error>> {
        runner::listen();
        watch::begin(CASE_SECONDS);
        // Inside the pool nothing is handed from thread to thread, which would take longer than most cases.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads).build()?;
        Ok(pool.install(|| self.in_turn())?)
    }

    fn in_turn(&self) -> std::io::Result<usize> {
        let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus");
        let mut findings = 0;
        for target in &self.targets {
            findings += match &self.replay {
                Some(case) => runner::replay(target, case, &self.plan)?,
                None => runner::run(target, &corpus, &self.plan)?,
            };
        }
        Ok(findings)
    }
}

//! Tasks of the project. `cargo xtask test` runs every check there is, in the order in which failures are cheapest.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

const HELP: &str = "\
cargo xtask test      every check: format, lints, tests, documentation, viewer (needs Node; a browser if there is one)
cargo xtask schema    writes the JSON schemas of the result documents to docs/schema/";

/// A check: its name and the command that decides it.
struct Step {
    name: &'static str,
    folder: &'static str,
    program: &'static str,
    arguments: &'static [&'static str],
    variables: &'static [(&'static str, &'static str)],
}

const fn cargo(name: &'static str, arguments: &'static [&'static str]) -> Step {
    Step { name, folder: ".", program: env!("CARGO"), arguments, variables: &[] }
}

const STEPS: &[Step] = &[
    cargo("format", &["fmt", "--all", "--check"]),
    cargo("lints", &["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"]),
    cargo("tests", &["test", "--workspace", "--locked"]),
    Step {
        variables: &[("RUSTDOCFLAGS", "-D warnings")],
        ..cargo("documentation", &["doc", "--workspace", "--no-deps", "--locked"])
    },
    cargo(
        "benchmarks compile",
        &["check", "--manifest-path", "bench/Cargo.toml", "--all-targets", "--locked"],
    ),
    cargo(
        "fuzzing lints",
        &[
            "clippy",
            "--manifest-path",
            "fuzz/Cargo.toml",
            "--all-targets",
            "--locked",
            "--",
            "-D",
            "warnings",
        ],
    ),
    Step {
        name: "viewer packages",
        folder: "crates/viewer/web",
        program: NPM,
        arguments: &["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--prefer-offline"],
        variables: &[],
    },
    Step { name: "viewer", folder: "crates/viewer/web", program: NPM, arguments: &["test"], variables: &[] },
];

const NPM: &str = if cfg!(windows) { "npm.cmd" } else { "npm" };

fn main() -> ExitCode {
    let ok = match std::env::args().nth(1).as_deref() {
        Some("test") => test(),
        Some("schema") => {
            run(&cargo("schema", &["run", "--quiet", "--package", "trueness-inspect", "--example", "schema"]))
        }
        _ => {
            eprintln!("{HELP}");
            return ExitCode::from(2);
        }
    };
    if ok { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_path_buf()
}

/// Runs all steps, stops at the first that fails.
fn test() -> bool {
    let mut times = vec![];
    for step in STEPS {
        println!("\n── {} ──", step.name);
        let start = Instant::now();
        if !run(step) {
            eprintln!("\n✕ {} failed", step.name);
            return false;
        }
        times.push((step.name, start.elapsed().as_secs_f64()));
    }
    println!();
    for (name, seconds) in times {
        println!("✓ {name:<20} {seconds:7.1} s");
    }
    true
}

fn run(step: &Step) -> bool {
    let mut command = Command::new(step.program);
    command.current_dir(root().join(step.folder)).args(step.arguments).envs(step.variables.iter().copied());
    match command.status() {
        Ok(status) => status.success(),
        Err(e) => {
            eprintln!("{} cannot be started: {e}", step.program);
            false
        }
    }
}

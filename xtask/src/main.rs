//! Tasks of the project. `cargo xtask test` runs every check that takes minutes at most, in the order in which failures are cheapest;
//! `cargo xtask long` those that take longer, or need what a new machine lacks.

mod dependencies;
mod oldest;
mod package;
mod readback;
mod venv;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

const HELP: &str = "\
cargo xtask test      every check: format, lints, tests, documentation, viewer (needs Node; a browser if there is one)
cargo xtask long      the checks that take longer: ignored tests, many cases, fuzzing, the oldest compiler, advisories
cargo xtask tidy      lists circles between modules, long files and long functions, rooms with more numbers than before
cargo xtask licences  the licences and double versions of what the workspace depends on
cargo xtask readback  what the program writes, read by other programs (needs Python 3)
cargo xtask python    builds the Python package and runs its tests (needs Python 3.11)
cargo xtask schema    writes the JSON schemas of result documents and requests to docs/schema/, and the Python package's types of them";

/// A check: its name and what decides it.
enum Step {
    Command(Call),
    /// Its name and a function of the project's folder.
    Own(&'static str, fn(&Path) -> bool),
}

impl Step {
    fn name(&self) -> &'static str {
        match self {
            Step::Command(call) => call.name,
            Step::Own(name, _) => name,
        }
    }
    fn run(&self) -> bool {
        match self {
            Step::Command(call) => run(call),
            Step::Own(_, check) => check(&root()),
        }
    }
}

/// A command with the name of its check.
struct Call {
    name: &'static str,
    folder: &'static str,
    program: &'static str,
    arguments: &'static [&'static str],
    variables: &'static [(&'static str, &'static str)],
}

const fn cargo(name: &'static str, arguments: &'static [&'static str]) -> Call {
    Call { name, folder: ".", program: env!("CARGO"), arguments, variables: &[] }
}

/// Geometry in one piece for each crate.
const IN_ONE_PIECE: &str = "--config=xtask/one-piece.toml";

/// With all members, the examples and the options of the tests: nothing that the tests built is built again.
const BUILD: [&str; 5] = ["build", IN_ONE_PIECE, "--workspace", "--locked", "--examples"];

const STEPS: &[Step] = &[
    Step::Command(cargo("format", &["fmt", "--all", "--check"])),
    Step::Own("licences", dependencies::run),
    Step::Command(cargo(
        "lints",
        &["clippy", IN_ONE_PIECE, "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"],
    )),
    Step::Command(cargo("tests", &["test", IN_ONE_PIECE, "--workspace", "--locked"])),
    Step::Own("read back", readback::run),
    Step::Own("python package", package::run),
    Step::Command(Call {
        variables: &[("RUSTDOCFLAGS", "-D warnings")],
        ..cargo("documentation", &["doc", IN_ONE_PIECE, "--workspace", "--no-deps", "--locked"])
    }),
    Step::Command(TIDY),
    Step::Command(cargo(
        "tidy's tests",
        &["test", "--quiet", "--manifest-path", "tidy/Cargo.toml", "--locked"],
    )),
    Step::Command(cargo(
        "benchmarks compile",
        &["check", "--manifest-path", "bench/Cargo.toml", "--all-targets", "--locked"],
    )),
    Step::Command(cargo(
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
    )),
    Step::Command(Call {
        name: "viewer packages",
        folder: "crates/viewer/web",
        program: NPM,
        arguments: &["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--prefer-offline"],
        variables: &[],
    }),
    // The tests built it.
    Step::Command(Call {
        name: "viewer reports",
        folder: ".",
        program: "target/debug/examples/report_fixtures",
        arguments: &["target/reports"],
        variables: &[],
    }),
    Step::Command(Call {
        name: "viewer",
        folder: "crates/viewer/web",
        program: NPM,
        arguments: &["test", "--", "--fixtures", "../../../target/reports"],
        variables: &[],
    }),
];

/// What takes too long for every change.
const LONG_STEPS: &[Step] = &[
    Step::Own("advisories", dependencies::deny),
    Step::Own("oldest compiler", oldest::run),
    Step::Own("Python wheel", package::wheel),
    Step::Command(cargo(
        "without the program",
        &["check", IN_ONE_PIECE, "--locked", "-p", "trueness", "--lib", "--no-default-features"],
    )),
    Step::Command(cargo(
        "ignored tests",
        &[
            "test",
            IN_ONE_PIECE,
            "--workspace",
            "--locked",
            "--lib",
            "--tests",
            "--",
            "--ignored",
            // Known faults: they fail until they are mended.
            "--skip=holes_of_cut_out_facets_are_widened_until_something_fits",
            "--skip=every_way_of_writing_is_read_to_the_numbers_written_or_refused",
        ],
    )),
    Step::Command(Call {
        variables: &[("COPIES", "400")],
        ..cargo(
            "many noisy copies",
            &["test", IN_ONE_PIECE, "--workspace", "--locked", "--lib", "radii_of_balls_scatter_as_stated"],
        )
    }),
    Step::Command(Call {
        variables: &[("TRUENESS_POINTS", "5000")],
        ..cargo(
            "many exact points",
            &["test", IN_ONE_PIECE, "--workspace", "--locked", "--test", "all", "--", "exactness"],
        )
    }),
    Step::Command(cargo(
        "benchmarks run",
        &["bench", "--manifest-path", "bench/Cargo.toml", "--locked", "--", "--test"],
    )),
    Step::Command(Call {
        folder: "fuzz",
        ..cargo("fuzzing", &["run", "--release", "--locked", "--", "--cases", "2000"])
    }),
];

/// The rules that the compiler does not check.
const TIDY: Call = cargo("tidy", &["run", "--quiet", "--manifest-path", "tidy/Cargo.toml"]);

/// The schemas of result documents and of requests.
const SCHEMAS: &[Call] = &[
    cargo("schema", &["run", "--quiet", "--locked", "--example", "schema"]),
    cargo("schema of requests", &["run", "--quiet", "--locked", "--example", "request_schema"]),
];

const NPM: &str = if cfg!(windows) { "npm.cmd" } else { "npm" };

fn main() -> ExitCode {
    let ok = match std::env::args().nth(1).as_deref() {
        Some("test") => all(STEPS),
        Some("long") => all(LONG_STEPS),
        Some("tidy") => run(&TIDY),
        Some("licences") => dependencies::run(&root()),
        Some("readback") => readback::run(&root()),
        Some("python") => package::run(&root()),
        Some("schema") => SCHEMAS.iter().all(run) && package::write(&root()),
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

/// Whether a check that cannot be run here is a failure: `TRUENESS_REQUIRE_ALL` is 1.
fn requires_all() -> bool {
    std::env::var("TRUENESS_REQUIRE_ALL").as_deref() == Ok("1")
}

/// Runs all steps, stops at the first that fails.
fn all(steps: &[Step]) -> bool {
    let mut times = vec![];
    for step in steps {
        println!("\n── {} ──", step.name());
        let start = Instant::now();
        if !step.run() {
            eprintln!("\n✕ {} failed", step.name());
            return false;
        }
        times.push((step.name(), start.elapsed().as_secs_f64()));
    }
    println!();
    for (name, seconds) in times {
        println!("✓ {name:<20} {seconds:7.1} s");
    }
    true
}

fn run(call: &Call) -> bool {
    let mut command = Command::new(call.program);
    command.current_dir(root().join(call.folder)).args(call.arguments).envs(call.variables.iter().copied());
    match command.status() {
        Ok(status) => status.success(),
        Err(e) => {
            eprintln!("{} cannot be started: {e}", call.program);
            false
        }
    }
}

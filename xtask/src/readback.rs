//! Reads what the program writes with other programs: sets up Python with the packages of
//! `crates/cli/tests/readback/requirements.txt` below `target/` and runs `readback.py` there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs the comparison; `false` if it fails. Without Python it is skipped, unless `TRUENESS_REQUIRE_PYTHON` is 1.
pub fn run(root: &Path) -> bool {
    let python = if cfg!(windows) { "python" } else { "python3" };
    if !Command::new(python).args(["-m", "venv", "--help"]).output().is_ok_and(|o| o.status.success()) {
        println!("SKIPPED: reading back by other programs. There is no Python 3 with venv.");
        return std::env::var("TRUENESS_REQUIRE_PYTHON").as_deref() != Ok("1");
    }
    let folder = root.join("crates/cli/tests/readback");
    let environment = root.join("target/readback");
    let done = |command: &mut Command| command.current_dir(root).status().is_ok_and(|s| s.success());
    let Some(packages) = packages(python, &folder.join("requirements.txt"), &environment, &done) else {
        eprintln!("the Python packages for reading back cannot be installed");
        return false;
    };
    // With the examples and the tests' options: nothing that the tests built is built again.
    let build = ["build", crate::IN_ONE_PIECE, "--locked", "--bins", "--examples"];
    done(Command::new(env!("CARGO")).args(build))
        && done(
            Command::new(packages)
                .arg(folder.join("readback.py"))
                .arg(root.join("target/debug").join(format!("trueness{}", std::env::consts::EXE_SUFFIX)))
                .arg(root.join("corpus")),
        )
}

/// The Python of the environment, with what `requirements` lists; made anew when the list has changed.
fn packages(
    python: &str,
    requirements: &Path,
    environment: &Path,
    done: &dyn Fn(&mut Command) -> bool,
) -> Option<PathBuf> {
    let inside = environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let (list, stamp) = (fs::read(requirements).ok()?, environment.join("installed"));
    if fs::read(&stamp).is_ok_and(|installed| installed == list) {
        return Some(inside);
    }
    let made = done(Command::new(python).args(["-m", "venv", "--clear"]).arg(environment));
    let quiet = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--requirement"];
    if !made || !done(Command::new(&inside).args(quiet).arg(requirements)) {
        return None;
    }
    fs::write(&stamp, &list).ok()?;
    Some(inside)
}

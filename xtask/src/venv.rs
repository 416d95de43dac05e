//! Environments of Python below `target/`, each with the packages of a list.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The Python of an environment, or what a check says that cannot have one.
pub enum Python {
    /// Its path.
    Ready(PathBuf),
    /// Whether the check passes nonetheless.
    Missing(bool),
}

/// The system's Python.
pub const SYSTEM: &str = if cfg!(windows) { "python" } else { "python3" };

/// The environment `target/NAME` with what `requirements` lists, made anew when the list has changed. `what` is skipped without Python,
/// unless `TRUENESS_REQUIRE_PYTHON` is 1; `least` is the oldest version 3.N that will do.
pub fn ready(root: &Path, name: &str, requirements: &Path, least: u32, what: &str) -> Python {
    let probe = format!("import sys, venv; sys.exit(sys.version_info < (3, {least}))");
    if !Command::new(SYSTEM).args(["-c", &probe]).output().is_ok_and(|o| o.status.success()) {
        println!("SKIPPED: {what}. There is no Python 3.{least} with venv.");
        return Python::Missing(std::env::var("TRUENESS_REQUIRE_PYTHON").as_deref() != Ok("1"));
    }
    packages(root, requirements, &root.join("target").join(name)).map_or_else(
        || {
            eprintln!("the Python packages for this cannot be installed: {what}");
            Python::Missing(false)
        },
        Python::Ready,
    )
}

/// Whether a command succeeds in the project's folder.
pub fn done(root: &Path, command: &mut Command) -> bool {
    command.current_dir(root).status().is_ok_and(|s| s.success())
}

fn packages(root: &Path, requirements: &Path, environment: &Path) -> Option<PathBuf> {
    let inside = environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let (list, stamp) = (fs::read(requirements).ok()?, environment.join("installed"));
    if fs::read(&stamp).is_ok_and(|installed| installed == list) {
        return Some(inside);
    }
    let made = done(root, Command::new(SYSTEM).args(["-m", "venv", "--clear"]).arg(environment));
    let quiet = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--requirement"];
    if !made || !done(root, Command::new(&inside).args(quiet).arg(requirements)) {
        return None;
    }
    fs::write(&stamp, &list).ok()?;
    Some(inside)
}

//! The Python package: builds its wheel with the options of the tests, installs it in an environment of its own below `target/`, and runs
//! its tests there.

use crate::venv::{self, Python, done};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The oldest Python that the package runs on, 3.N.
const OLDEST_PYTHON: u32 = 11;

/// Runs the tests of the package; `false` if they fail. Without Python they are skipped.
pub fn run(root: &Path) -> bool {
    let requirements = root.join("python/tests/requirements.txt");
    let python = match venv::ready(root, "package", &requirements, OLDEST_PYTHON, "the Python package") {
        Python::Ready(path) => path,
        Python::Missing(passes) => return passes,
    };
    let wheels = root.join("target/wheels/test");
    // Of the wheels of other versions none is taken for this one.
    if wheels.exists() && fs::remove_dir_all(&wheels).is_err() {
        return false;
    }
    let mut build = Command::new(&python);
    build.args([
        "-m",
        "maturin",
        "build",
        crate::IN_ONE_PIECE,
        "--profile",
        "dev",
        "--locked",
        "--manifest-path",
    ]);
    build.arg("python/Cargo.toml").arg("--out").arg(&wheels).arg("--interpreter").arg(&python);
    if !done(root, &mut build) {
        return false;
    }
    let Some(wheel) = only_file(&wheels) else { return false };
    let install =
        ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--force-reinstall", "--no-deps"];
    done(root, Command::new(&python).args(install).arg(wheel))
        && done(root, Command::new(&python).args(["-m", "pytest", "--quiet", "python/tests"]))
}

/// Writes the types of documents and the functions of tasks from the schemas.
pub fn write(root: &Path) -> bool {
    done(root, Command::new(venv::SYSTEM).arg("python/generate.py"))
}

fn only_file(folder: &Path) -> Option<PathBuf> {
    fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path()).next()
}

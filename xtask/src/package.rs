//! The Python package: its module is built with what the tests built and is laid beside its Python files, and its tests run there in an
//! environment below `target/`. The wheel, which is built from nothing, is for [`wheel`].

use crate::venv::{self, Python, done};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The oldest Python that the package runs on, 3.N.
const OLDEST_PYTHON: u32 = 11;

/// Runs the tests of the package; `false` if they fail. Without Python they are skipped.
pub fn run(root: &Path) -> bool {
    with_packages(root, |python| {
        done(root, Command::new(env!("CARGO")).args(crate::BUILD).arg("--lib"))
            && lay_module(root).inspect_err(|e| eprintln!("the built module cannot be copied: {e}")).is_ok()
            && tests(root, python, true)
    })
}

/// Builds the wheel as `pip install ./python` does, installs it in an environment of its own, and runs the tests with it.
pub fn wheel(root: &Path) -> bool {
    with_packages(root, |python| {
        let wheels = root.join("target/wheels");
        // Of the wheels of other versions none is taken for this one.
        if wheels.exists() && fs::remove_dir_all(&wheels).is_err() {
            return false;
        }
        let mut build = Command::new(python);
        build.args([
            "-m",
            "maturin",
            "build",
            "--release",
            "--locked",
            "--manifest-path",
            "python/Cargo.toml",
        ]);
        if !done(root, build.arg("--out").arg(&wheels).arg("--interpreter").arg(python)) {
            return false;
        }
        let Some(wheel) = only_file(&wheels) else { return false };
        println!("{}: {} bytes", wheel.display(), fs::metadata(&wheel).map_or(0, |m| m.len()));
        let install = ["-m", "pip", "install", "--quiet", "--force-reinstall", "--no-deps"];
        done(root, Command::new(python).args(install).arg(wheel)) && tests(root, python, false)
    })
}

fn with_packages(root: &Path, run: impl Fn(&Path) -> bool) -> bool {
    let requirements = root.join("python/tests/requirements.txt");
    match venv::ready(root, "package", &requirements, OLDEST_PYTHON, "the Python package") {
        Python::Ready(python) => run(&python),
        Python::Missing(passes) => passes,
    }
}

/// Lays the module beside the package's files, under the name by which Python finds it.
fn lay_module(root: &Path) -> std::io::Result<u64> {
    use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
    let built = root.join(format!("target/debug/{DLL_PREFIX}_trueness{DLL_SUFFIX}"));
    let name = if cfg!(windows) { "_trueness.pyd" } else { "_trueness.abi3.so" };
    fs::copy(built, root.join("python/trueness").join(name))
}

/// Runs the tests of the package that is installed, or of the one `in_place`.
fn tests(root: &Path, python: &Path, in_place: bool) -> bool {
    let mut tests = Command::new(python);
    tests.args(["-m", "pytest", "--quiet", "python/tests"]);
    if in_place {
        tests.env("PYTHONPATH", root.join("python"));
    }
    done(root, &mut tests)
}

/// Writes the types of documents and the functions of tasks from the schemas.
pub fn write(root: &Path) -> bool {
    done(root, Command::new(venv::SYSTEM).arg("python/generate.py"))
}

fn only_file(folder: &Path) -> Option<PathBuf> {
    fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path()).next()
}

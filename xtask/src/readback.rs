//! Reads what the program writes with other programs: sets up Python with the packages of
//! `crates/cli/tests/readback/requirements.txt` below `target/` and runs `readback.py` there.

use crate::venv::{self, Python, done};
use std::path::Path;
use std::process::Command;

/// The oldest Python that it runs on, 3.N.
const OLDEST_PYTHON: u32 = 8;

/// Runs the comparison; `false` if it fails. Without Python it is skipped.
pub fn run(root: &Path) -> bool {
    let folder = root.join("crates/cli/tests/readback");
    let requirements = folder.join("requirements.txt");
    let packages =
        match venv::ready(root, "readback", &requirements, OLDEST_PYTHON, "reading back by other programs") {
            Python::Ready(path) => path,
            Python::Missing(passes) => return passes,
        };
    done(root, Command::new(env!("CARGO")).args(crate::BUILD).arg("--bins"))
        && done(
            root,
            Command::new(packages)
                .arg(folder.join("readback.py"))
                .arg(root.join("target/debug").join(format!("trueness{}", std::env::consts::EXE_SUFFIX)))
                .arg(root.join("corpus")),
        )
}

//! The rules of ARCHITECTURE.md that the compiler does not check: the direction of imports, and the size of files and functions.
//!
//! Within a crate the modules form a graph: an arrow goes from the file that names an item to the file that defines it.
//! A re-export is followed to the definition, so `mod.rs` may list its children and they may use one another.
//! Modules marked `#[cfg(test)]` are left out. Methods are found through their type, so a call of a method draws no arrow.

mod circles;
mod modules;
mod paths;
mod size;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Crates from the lowest floor upward, and the crates of the project that each may use.
const FLOORS: [(&str, &[&str]); 7] = [
    ("geom", &[]),
    ("viewer", &[]),
    ("document", &[]),
    ("files", &["geom"]),
    ("measure", &["geom", "document"]),
    ("report", &["geom", "viewer", "document", "measure"]),
    ("cli", &["geom", "files", "document", "measure", "report"]),
];

fn main() -> ExitCode {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    match findings(here.parent().unwrap_or(here)) {
        Ok(found) => {
            found.iter().for_each(|f| println!("{f}"));
            if found.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(e) => {
            eprintln!("{e}");
            ExitCode::FAILURE
        }
    }
}

/// All places under `root` that break a rule.
///
/// # Errors
/// A file that cannot be read or is not Rust.
fn findings(root: &Path) -> io::Result<Vec<String>> {
    let mut found = vec![];
    for (name, below) in FLOORS {
        let folder = root.join("crates").join(name);
        found.extend(upward(&folder, name, below)?);
        found.extend(circles::of_crate(&folder.join("src"), &format!("crates/{name}/src"))?);
        // The rooms of the other crates reach each other still.
        if ["geom", "document", "measure", "report"].contains(&name) {
            found.extend(circles::of_rooms(&folder.join("src"), &format!("crates/{name}/src"))?);
        }
    }
    for folder in ["crates", "xtask", "bench", "fuzz", "tidy"] {
        for file in sources(&root.join(folder))? {
            let text = fs::read_to_string(&file)?;
            let shown = file.strip_prefix(root).unwrap_or(&file).display().to_string();
            found.extend(size::findings(&shown, &text).map_err(io::Error::other)?);
        }
    }
    Ok(found)
}

/// Dependencies on crates that lie higher, or beside.
fn upward(folder: &Path, name: &str, below: &[&str]) -> io::Result<Vec<String>> {
    let manifest = fs::read_to_string(folder.join("Cargo.toml"))?;
    // As a line of a table, as a table of its own, and under another name.
    let written = |line: &str| {
        let (_, after) = line.split_once("trueness-")?;
        let is_name = line.starts_with("trueness-") || line.contains("dependencies.trueness-");
        let is_used = is_name || line.contains("package = \"trueness-");
        after.split([' ', '.', '=', '"', ']']).next().filter(|_| is_used).map(String::from)
    };
    let used: Vec<String> = manifest.lines().filter_map(written).collect();
    Ok(used
        .into_iter()
        .filter(|used| !below.contains(&used.as_str()))
        .map(|used| format!("crates/{name}/Cargo.toml: `{name}` must not use `{used}`"))
        .collect())
}

/// All Rust files in a folder and those below it, in order of name; build output is left out.
fn sources(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut entries = fs::read_dir(folder)?.map(|e| Ok(e?.path())).collect::<io::Result<Vec<_>>>()?;
    entries.sort();
    let mut files = vec![];
    for path in entries {
        let skipped = path.file_name().is_some_and(|n| n == "target" || n == "node_modules");
        if path.is_dir() && !skipped {
            files.extend(sources(&path)?);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    Ok(files)
}

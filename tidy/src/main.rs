//! The rules of ARCHITECTURE.md that the compiler does not check: the direction of imports, the size of files and functions, and
//! that what is counted in a room does not grow (`limits.tsv`).
//!
//! `--write` writes the counts down, `--verbose` tells all that is told in part.
//!
//! Within a crate the modules form a graph: an arrow goes from the file that names an item to the file that defines it.
//! A re-export is followed to the definition, so `mod.rs` may list its children and they may use one another.
//! Modules marked `#[cfg(test)]` are left out. Methods are found through their type, so a call of a method draws no arrow.

mod circles;
mod count;
mod limits;
mod modules;
mod numbers;
mod paths;
mod rooms;
mod size;

use count::Count;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Crates from the lowest floor upward, and the crates of the project that each may use.
const FLOORS: [(&str, &[&str]); 12] = [
    ("geom", &[]),
    ("viewer", &[]),
    ("section", &["geom"]),
    ("solid", &["geom"]),
    ("surface", &["geom"]),
    ("cad", &["geom"]),
    ("files", &["geom", "cad"]),
    ("document", &[]),
    ("measure", &["geom", "section", "solid", "surface", "cad", "document"]),
    ("report", &["geom", "section", "solid", "surface", "viewer", "document", "measure"]),
    ("trueness", &["geom", "section", "solid", "surface", "cad", "files", "document", "measure", "report"]),
    ("cli", &["geom", "section", "solid", "surface", "files", "document", "measure", "report", "trueness"]),
];

/// What was found.
#[derive(Default)]
pub struct Report {
    /// What breaks a rule.
    pub failures: Vec<String>,
    /// What is worth a look.
    pub notes: Vec<String>,
}

fn main() -> ExitCode {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let words: Vec<String> = std::env::args().skip(1).collect();
    let given = |word: &str| words.iter().any(|w| w == word);
    if let Some(unknown) = words.iter().find(|word| !["--write", "--verbose"].contains(&word.as_str())) {
        eprintln!("`{unknown}` is unknown: give --write or --verbose");
        return ExitCode::from(2);
    }
    match report(here.parent().unwrap_or(here), given("--write"), given("--verbose")) {
        Ok(found) => {
            found.notes.iter().chain(&found.failures).for_each(|f| println!("{f}"));
            if found.failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(e) => {
            eprintln!("{e}");
            ExitCode::FAILURE
        }
    }
}

/// All places under `root` that break a rule, and what is worth a look.
///
/// # Errors
/// A file that cannot be read or is not Rust.
fn report(root: &Path, write: bool, verbose: bool) -> io::Result<Report> {
    let mut report = Report::default();
    let mut count = Count::default();
    for (name, below) in FLOORS {
        let folder = root.join("crates").join(name);
        let graphs = circles::Graphs::read(&folder.join("src"))?;
        report.failures.extend(upward(&folder, name, below)?);
        report.failures.extend(graphs.of_files(&format!("crates/{name}/src")));
        count.add(&folder.join("src"), &graphs, name)?;
    }
    count.compare(&root.join("tidy/limits.tsv"), write, verbose, &mut report)?;
    let mut long = vec![];
    for folder in ["crates", "xtask", "bench", "fuzz", "tidy"] {
        for file in sources(&root.join(folder))? {
            let text = fs::read_to_string(&file)?;
            let shown = file.strip_prefix(root).unwrap_or(&file).display().to_string();
            long.extend(size::findings(&shown, &text).map_err(io::Error::other)?);
        }
    }
    let (failures, told): (Vec<_>, Vec<_>) = long.into_iter().partition(size::Long::is_failure);
    report.failures.extend(failures.into_iter().map(|one| one.text));
    report.notes.extend(size::summary(told, verbose));
    Ok(report)
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

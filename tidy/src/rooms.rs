//! What is counted in each room of a crate.

use super::circles::Graphs;
use super::limits::{Counts, Table};
use super::numbers;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;

/// Definitions of each constant's name in the project.
pub type Names = BTreeMap<String, usize>;

/// What stands in a crate.
pub struct Crate {
    /// The counts of the crate's own files, under its name, and of each room.
    pub counts: Table,
    /// Circles of folders, at any depth.
    pub circles: Vec<String>,
}

/// Counts in the crate `name`, and adds the names of its constants.
///
/// # Errors
/// A file that cannot be read or is not Rust.
pub fn of_crate(source: &Path, graphs: &Graphs, name: &str, names: &mut Names) -> io::Result<Crate> {
    let mut found = Crate { counts: Table::from([(name.to_string(), Counts::default())]), circles: vec![] };
    for file in graphs.files() {
        let text = fs::read_to_string(source.join(file))?;
        let numbers = numbers::of_text(&text)
            .map_err(|e| io::Error::other(format!("{}: {e}", source.join(file).display())))?;
        let Counts(counts) = found.counts.entry(room(source, name, file)).or_default();
        counts[0] += numbers.compared;
        counts[1] += numbers.constants.len();
        for constant in numbers.constants {
            *names.entry(constant).or_default() += 1;
        }
    }
    found.circles.extend(graphs.of_rooms(name));
    Ok(found)
}

/// The line that counts a file, or a folder below a room: the folder directly below `src` that it is in or stands for.
fn room(source: &Path, name: &str, file: &Path) -> String {
    let first = file.components().next().map(|first| Path::new(&first).with_extension(""));
    match first {
        Some(room) if source.join(&room).is_dir() => format!("{name}/{}", room.display()),
        _ => name.to_string(),
    }
}

/// Constants whose name has several definitions.
pub fn shared(names: &Names) -> usize {
    names.values().filter(|count| **count > 1).sum()
}

/// How many constants and names there are, and the names with the most definitions, or all of them.
pub fn summary(names: &Names, verbose: bool) -> String {
    const SHOWN: usize = 10;
    let mut all: Vec<(&String, &usize)> = names.iter().collect();
    all.sort_by_key(|(name, count)| (std::cmp::Reverse(**count), *name));
    let shown = all.iter().take(if verbose { all.len() } else { SHOWN });
    let shown: Vec<String> = shown.map(|(name, count)| format!("{name} {count}")).collect();
    format!(
        "{} constants have {} names; {} share theirs: {}",
        names.values().sum::<usize>(),
        names.len(),
        shared(names),
        shown.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_count_for_the_folder_they_are_in_or_stand_for() {
        let folder = std::env::temp_dir().join(format!("tidy-{}-rooms", std::process::id()));
        for (file, text) in [
            ("lib.rs", "mod a; mod b; mod c; const MAX: u8 = 1;"),
            ("a.rs", "const MAX: u8 = 1; mod d;"),
            ("a/d/mod.rs", "const Y: u8 = 1; mod e; mod f;"),
            ("a/d/e.rs", "use super::f::F; pub struct E;"),
            ("a/d/f.rs", "use super::e::E; pub struct F;"),
            ("b/mod.rs", "use crate::c::C; pub const MAX: u8 = 1; fn f(x: u8) -> bool { x > 3 && x < MAX }"),
            ("c.rs", "use crate::b::MAX; pub struct C;"),
            ("unused.rs", "const MAX: u8 = 1;"),
        ] {
            let path = folder.join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let mut names = Names::new();
        let found = of_crate(&folder, &Graphs::read(&folder).unwrap(), "n", &mut names).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        let counts = |place: &str| found.counts[place].0;
        assert_eq!((counts("n"), counts("n/a"), counts("n/b")), ([0, 1], [0, 2], [2, 1]));
        assert_eq!((found.counts.len(), found.circles.len()), (3, 2));
        assert_eq!(summary(&names, false), "4 constants have 2 names; 3 share theirs: MAX 3, Y 1");
    }
}

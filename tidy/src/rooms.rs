//! What is counted in each room of a crate.

use super::limits::{Counts, Table};
use super::{circles, modules, numbers};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Definitions of each constant's name in the project.
pub type Names = BTreeMap<String, usize>;

/// What stands in a crate.
pub struct Crate {
    /// The counts of the crate's own files, under its name, and of each room.
    pub counts: Table,
    /// Circles of folders, by the line that counts them.
    pub circles: Vec<(String, String)>,
}

/// Counts in the crate `name`, and adds the names of its constants.
///
/// # Errors
/// A file that cannot be read or is not Rust.
pub fn of_crate(source: &Path, name: &str, names: &mut Names) -> io::Result<Crate> {
    let mut found = Crate { counts: Table::from([(name.to_string(), Counts::default())]), circles: vec![] };
    let mut files: BTreeSet<PathBuf> = BTreeSet::new();
    for root in circles::roots(source) {
        files.extend(modules::of_crate(source, root)?.into_iter().map(|module| module.file));
    }
    for file in files {
        let text = fs::read_to_string(source.join(&file))?;
        let numbers = numbers::of_text(&text)
            .map_err(|e| io::Error::other(format!("{}: {e}", source.join(&file).display())))?;
        let Counts(counts) = found.counts.entry(room(source, name, &file)).or_default();
        counts[0] += numbers.compared;
        counts[1] += numbers.constants.len();
        for constant in numbers.constants {
            *names.entry(constant).or_default() += 1;
        }
    }
    for circle in circles::of_rooms(source, name)? {
        // Circles among the rooms stand in the crate's own line.
        let place = if circle.folder.as_os_str().is_empty() {
            name.to_string()
        } else {
            room(source, name, &circle.folder)
        };
        found.counts.entry(place.clone()).or_default().0[2] += circle.arrows;
        found.circles.push((place, circle.text));
    }
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

/// The names with the most definitions, with their number.
pub fn worst(names: &Names, most: usize) -> String {
    let mut all: Vec<(&String, &usize)> = names.iter().collect();
    all.sort_by_key(|(name, count)| (std::cmp::Reverse(**count), *name));
    let shown: Vec<String> = all.iter().take(most).map(|(name, count)| format!("{name} {count}")).collect();
    shown.join(", ")
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
        let found = of_crate(&folder, "n", &mut names).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        let counts = |place: &str| found.counts[place].0;
        assert_eq!((counts("n"), counts("n/a"), counts("n/b")), ([0, 1, 2], [0, 2, 2], [2, 1, 0]));
        assert_eq!(found.counts.len(), 3);
        assert_eq!((shared(&names), worst(&names, 1)), (3, "MAX 3".to_string()));
    }
}

//! A ratchet: what is counted in each room must not become more than what is written down.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::io;
use std::path::Path;

/// The head of the file of limits, which explains its lines.
const HEAD: &str = "\
# What each room may hold at most; a room is a folder directly below `src`, a crate's own line its files beside the rooms.
# numbers    literals other than 0, 1, 2, 0.5 (and their negatives), and constants, that stand in comparisons
# constants  definitions of constants that are numbers
# The last line: constants whose name has several definitions in the project.
# Tests are left out. More than a line allows is a failure: find the number a name that exists, or do without it.
# Less is a note: write it down. `cargo run --manifest-path tidy/Cargo.toml -- --write` does so, and says which limits it raised.
";

/// The place of the last line.
pub const PROJECT: &str = "~ shared names";

/// Counts of one place: numbers in comparisons, constants; of the project the shared names, then zero.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug)]
pub struct Counts(pub [usize; 2]);

/// What the counts of a room are called.
const ROOM: [&str; 2] = ["numbers in comparisons", "constants"];

/// Counts by place.
pub type Table = BTreeMap<String, Counts>;

/// What a comparison with the limits says.
#[derive(Default)]
pub struct Findings {
    /// What is more than its limit, or has none.
    pub failures: Vec<String>,
    /// What is less than its limit.
    pub notes: Vec<String>,
}

/// Reads the limits.
///
/// # Errors
/// A file that cannot be read, or a line that is none of its kind.
pub fn read(file: &Path) -> io::Result<Table> {
    let mut table = Table::new();
    for (number, line) in fs::read_to_string(file)?.lines().enumerate() {
        if line.starts_with('#') || line.is_empty() {
            continue;
        }
        let wrong = || io::Error::other(format!("{}:{}: no line of limits", file.display(), number + 1));
        let mut cells = line.split('\t');
        let place = cells.next().ok_or_else(wrong)?;
        let mut counts = Counts::default();
        for (i, cell) in cells.enumerate() {
            *counts.0.get_mut(i).ok_or_else(wrong)? = cell.parse().map_err(|_| wrong())?;
        }
        table.insert(place.to_string(), counts);
    }
    Ok(table)
}

/// Writes the counts as limits.
///
/// # Errors
/// A file that cannot be written.
pub fn write(file: &Path, now: &Table) -> io::Result<()> {
    let mut text = HEAD.to_string();
    for (place, Counts(counts)) in now {
        let used = if place == PROJECT { 1 } else { counts.len() };
        let cells: Vec<String> = counts[..used].iter().map(usize::to_string).collect();
        // Writing into a text never fails.
        let _ = writeln!(text, "{place}\t{}", cells.join("\t"));
    }
    fs::write(file, text)
}

/// Compares what there is with what there may be.
pub fn compare(now: &Table, limits: &Table) -> Findings {
    let mut findings = Findings::default();
    for (place, counts) in now {
        let Some(limit) = limits.get(place) else {
            findings.failures.push(format!(
                "{place}: no line in tidy/limits.tsv for {}; write it with `--write`, and look at what it says",
                listed(place, counts)
            ));
            continue;
        };
        for ((count, limit), what) in counts.0.iter().zip(limit.0).zip(names(place)) {
            match count.cmp(&limit) {
                std::cmp::Ordering::Greater => {
                    findings.failures.push(format!("{place}: {count} {what}; tidy/limits.tsv allows {limit}"))
                }
                std::cmp::Ordering::Less => findings.notes.push(format!(
                    "{place}: {limit} {what} are allowed, now {count}: write it down (`--write`)"
                )),
                std::cmp::Ordering::Equal => {}
            }
        }
    }
    let gone = limits.keys().filter(|place| !now.contains_key(*place));
    findings.notes.extend(gone.map(|place| format!("{place}: is gone; write it down (`--write`)")));
    findings
}

/// Limits that become higher when `now` is written over them.
pub fn raised(now: &Table, limits: &Table) -> Vec<String> {
    let mut all = vec![];
    for (place, counts) in now {
        let Some(limit) = limits.get(place) else {
            all.push(format!("{place}: new, with {}", listed(place, counts)));
            continue;
        };
        for ((count, limit), what) in counts.0.iter().zip(limit.0).zip(names(place)) {
            if *count > limit {
                all.push(format!("{place}: {what} raised from {limit} to {count}"));
            }
        }
    }
    all
}

fn names(place: &str) -> &'static [&'static str] {
    if place == PROJECT { &["constants whose name has several definitions"] } else { &ROOM }
}

fn listed(place: &str, counts: &Counts) -> String {
    let all: Vec<String> =
        counts.0.iter().zip(names(place)).map(|(count, what)| format!("{count} {what}")).collect();
    all.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(lines: &[(&str, [usize; 2])]) -> Table {
        lines.iter().map(|(place, counts)| (place.to_string(), Counts(*counts))).collect()
    }

    #[test]
    fn more_fails_less_is_noted_and_a_new_room_needs_a_line() {
        let limits = table(&[("geom/a", [3, 2]), ("geom/b", [1, 1]), ("geom/old", [0, 0])]);
        let now = table(&[("geom/a", [4, 3]), ("geom/b", [1, 0]), ("geom/new", [0, 0])]);
        let found = compare(&now, &limits);
        assert_eq!(found.failures.len(), 3, "{:?}", found.failures);
        assert_eq!(found.failures[0], "geom/a: 4 numbers in comparisons; tidy/limits.tsv allows 3");
        assert_eq!(found.failures[1], "geom/a: 3 constants; tidy/limits.tsv allows 2");
        assert!(found.failures[2].starts_with("geom/new: no line"), "{}", found.failures[2]);
        assert_eq!(found.notes.len(), 2, "{:?}", found.notes);
        assert_eq!(raised(&now, &limits).len(), 3);
        assert!(compare(&limits, &limits).failures.is_empty() && raised(&limits, &limits).is_empty());
    }

    #[test]
    fn what_is_written_is_read() {
        let file = std::env::temp_dir().join(format!("tidy-{}-limits.tsv", std::process::id()));
        let now = table(&[("geom", [4, 2]), ("geom/b", [1, 0]), (PROJECT, [7, 0])]);
        write(&file, &now).unwrap();
        assert_eq!(read(&file).unwrap(), now);
        fs::write(&file, "geom\t1\tx\t0\n").unwrap();
        assert!(read(&file).unwrap_err().to_string().contains(":1: no line"));
        fs::write(&file, "geom\t1\t1\t9\n").unwrap();
        assert!(read(&file).is_err());
        fs::remove_file(&file).unwrap();
    }
}

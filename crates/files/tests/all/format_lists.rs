//! Which formats there are stands in their list alone: no message, help text or page of the manual repeats it by hand.

use std::path::{Path, PathBuf};
use trueness_files::FORMATS;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// The names of formats, as people write them.
fn names() -> Vec<&'static str> {
    FORMATS.iter().flat_map(|format| format.known_as().iter().copied()).collect()
}

/// Pairs of names with nothing but a comma, a stroke, "and" or "or" between them.
fn lists<'a>(text: &'a str, names: &[&str]) -> Vec<(usize, &'a str)> {
    let is_name = |word: &str| names.contains(&word);
    let is_joint = |between: &str| {
        let words = between.split(|c: char| c.is_whitespace() || ",/`|!".contains(c));
        words.filter(|w| !w.is_empty()).all(|w| ["and", "or", "a", "an"].contains(&w))
    };
    let mut found = vec![];
    let mut last: Option<(usize, usize)> = None;
    let starts = text.char_indices().filter(|(i, c)| {
        c.is_alphanumeric()
            && !text[..*i].chars().next_back().is_some_and(|before| before.is_alphanumeric() || before == '_')
    });
    for (start, _) in starts {
        let word = text[start..].split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap();
        if is_name(word) {
            if let Some((first, _)) = last.filter(|(_, end)| is_joint(&text[*end..start])) {
                found.push((1 + text[..first].matches('\n').count(), &text[first..start + word.len()]));
            }
            last = Some((start, start + word.len()));
        }
    }
    found
}

fn texts_below(folder: &Path, endings: &[&str], all: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        // The pages of formats name their kin; decisions tell of their day; schemas are made of the types.
        let is_left_out =
            ["files/src/formats", "docs/decisions", "docs/schema"].iter().any(|end| path.ends_with(end));
        if path.is_dir() && !is_left_out {
            texts_below(&path, endings, all);
        } else if path.extension().is_some_and(|e| endings.iter().any(|known| e == *known)) {
            all.push(path);
        }
    }
}

#[test]
fn a_list_is_seen_in_every_way_of_writing_it() {
    let names = names();
    for text in ["STL, PLY", "STL and PLY", "`STL`, or PLY", "STL/PLY", "LAS,\n/// E57", "a NPZ or a Parquet"]
    {
        assert_eq!(lists(text, &names).len(), 1, "{text}");
    }
    for text in ["as STL; as PLY", "STL holds less than PLY", "A_STL, PLYS", "stl, ply", "a STEP file"] {
        assert_eq!(lists(text, &names), [], "{text}");
    }
}

#[test]
fn nothing_repeats_the_list_of_formats() {
    let (names, mut all) = (names(), vec![]);
    for krate in std::fs::read_dir(format!("{ROOT}/crates")).unwrap() {
        let source = krate.unwrap().path().join("src");
        if source.is_dir() {
            texts_below(&source, &["rs"], &mut all);
        }
    }
    texts_below(Path::new(&format!("{ROOT}/docs")), &["md"], &mut all);
    all.extend(["README.md", "CONTRIBUTING.md", "ARCHITECTURE.md"].map(|name| Path::new(ROOT).join(name)));
    let repeated = all.iter().flat_map(|path| {
        let text = std::fs::read_to_string(path).unwrap();
        let at = |(line, list): (usize, &str)| format!("{}:{line}: {list}", path.display());
        lists(&text, &names).into_iter().map(at).collect::<Vec<_>>()
    });
    let repeated: Vec<String> = repeated.collect();
    assert!(
        repeated.is_empty(),
        "take it from `Holds::formats`, or name a kind of file:\n{}",
        repeated.join("\n")
    );
}

//! The sections of an IGES file: lines of fixed columns become entities with their parameters.
//!
//! What is wrong with one entity is kept with it, and costs what needs it; only what is wrong with the file as a whole is an error.

use super::words::{signs, words};
use crate::error::{Fault, Result};
use crate::formats::brep::Wrong;
use crate::lines::Lines;
use crate::number::{count, integer};
use std::collections::BTreeMap;
use std::ops::Range;

/// An entity.
pub(super) struct Entity {
    /// The line of the directory by which others name it.
    pub number: u64,
    pub kind: u64,
    pub form: i64,
    /// Line of the directory of the matrix that places it; 0 for none.
    pub matrix: u64,
    pub level: i64,
    /// A standard color, or below 0 the entity that defines one.
    pub color: i64,
    /// Blank, subordinate, use, hierarchy.
    pub status: [u8; 4],
    /// Its name, with its number where it has one.
    pub label: String,
    /// Line in the file where its parameters begin, for messages.
    pub line: u64,
    /// Where its parameters after its number stand in the text, or why they cannot be read.
    pub words: std::result::Result<Vec<Range<usize>>, String>,
}

/// The file: its global parameters, and its entities by the line of the directory.
pub(super) struct File {
    pub global: Vec<Vec<u8>>,
    /// Contents of all lines of parameters.
    pub text: Vec<u8>,
    pub entities: BTreeMap<u64, Entity>,
    /// Whether the line of section T is there.
    pub is_whole: bool,
    pub last_line: u64,
}

/// Columns of a line.
const LINE_COLUMNS: usize = 80;
/// The column, from 0, whose letter names the section of a line; the content stands before it.
pub(super) const SECTION_COLUMN: usize = 72;
/// Columns for parameters on a line of the parameter section.
pub(super) const PARAMETER_COLUMNS: usize = 64;

/// The text up to the line of section T, which ends the file, and the number of bytes after it that are not blank. Mail and other systems append
/// such bytes.
pub(super) fn up_to_the_end(text: &[u8]) -> (&[u8], u64) {
    let mut lines = Lines::new(text);
    while let Some(line) = lines.next() {
        if line.get(SECTION_COLUMN) == Some(&b'T') {
            let after = lines.rest().len() + line.len().saturating_sub(LINE_COLUMNS);
            let end = text.len() - after;
            // A line end of its own may lie between the columns and what follows.
            let blank = |b: &&u8| !matches!(b, 0 | 0x1a) && !b.is_ascii_whitespace();
            return (&text[..end], text[end..].iter().filter(blank).count() as u64);
        }
    }
    (text, 0)
}

/// Lines of one section with their numbers.
type Section<'a> = Vec<(u64, &'a [u8])>;

/// Reads the sections.
///
/// # Errors
/// A line without the letter of its section, but for the last one of a file that is cut short; compressed and binary files.
pub(super) fn file(text: &[u8]) -> Result<File> {
    let mut sections: BTreeMap<u8, Section> = BTreeMap::new();
    let mut lines = Lines::new(text);
    while let Some(line) = lines.next() {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        if line.trim_ascii().is_empty() {
            continue;
        }
        match line.get(SECTION_COLUMN) {
            Some(letter @ (b'S' | b'G' | b'D' | b'P' | b'T')) => {
                sections.entry(*letter).or_default().push((lines.number, line));
            }
            Some(b'C' | b'B') if sections.is_empty() => {
                let what = "the file is in the compressed or binary form of IGES, which is not read".into();
                let remedy = "export it in the fixed format of 80 columns";
                return Err(Fault::Unsupported { what, remedy }.at_line(lines.number));
            }
            None if lines.rest().trim_ascii().is_empty() => break,
            _ => {
                let what = "a line of 80 columns with S, G, D, P or T in the 73rd";
                return Err(Fault::unexpected(what, line).at_line(lines.number));
            }
        }
    }
    let section = |letter: u8| sections.get(&letter).map_or(&[][..], |all| all);
    let global = section(b'G');
    let signs = signs(global.first().map_or(b"", |(_, line)| line));
    let whole: Vec<u8> = global.iter().flat_map(|(_, l)| &l[..SECTION_COLUMN]).copied().collect();
    let found = words(&whole, signs).map_err(|f| f.at_line(global.first().map_or(1, |l| l.0)))?;
    let global = found.into_iter().map(|word| whole[word].to_vec()).collect();
    let parameters = section(b'P');
    let text: Vec<u8> = parameters.iter().flat_map(|(_, l)| &l[..PARAMETER_COLUMNS]).copied().collect();
    let mut entities = BTreeMap::new();
    for (k, pair) in section(b'D').chunks(2).enumerate() {
        let number = 2 * k as u64 + 1;
        let mut entity = directory(number, pair);
        if entity.words.is_ok() {
            entity.words = own_words(&mut entity, pair, parameters, &text, signs);
        }
        entities.insert(number, entity);
    }
    let is_whole = sections.contains_key(&b'T');
    Ok(File { global, text, entities, is_whole, last_line: lines.number })
}

/// A field of eight columns.
fn field<'a>(pair: &[(u64, &'a [u8])], row: usize, k: usize) -> &'a [u8] {
    let line = pair.get(row).map_or(&b""[..], |(_, line)| line);
    line.get(8 * k..8 * k + 8).map_or(b"", |word| word.trim_ascii())
}

/// What the directory says of an entity.
fn directory(number: u64, pair: &[(u64, &[u8])]) -> Entity {
    let mut wrong = None;
    let mut whole = |row: usize, k: usize| {
        let word = field(pair, row, k);
        let value = if word.is_empty() { Some(0) } else { integer(word) };
        value.unwrap_or_else(|| {
            let shown = String::from_utf8_lossy(word);
            wrong.get_or_insert_with(|| format!("has \"{shown}\" where its directory needs a number"));
            0
        })
    };
    let kind = u64::try_from(whole(0, 0)).unwrap_or_default();
    let (level, matrix) = (whole(0, 4), u64::try_from(whole(0, 6)).unwrap_or_default());
    let (color, form) = (whole(1, 2), whole(1, 4));
    // Blanks stand for zeros.
    let digits = format!("{:0>8}", String::from_utf8_lossy(field(pair, 0, 8)).replace(' ', "0"));
    let two = |k: usize| digits.get(2 * k..2 * k + 2).and_then(|d| d.parse().ok()).unwrap_or(0);
    let label = String::from_utf8_lossy(field(pair, 1, 7)).into_owned();
    let subscript = pair.get(1).and_then(|(_, l)| l.get(64..72)).map_or(b"" as &[u8], |w| w.trim_ascii());
    let label = match (label.is_empty(), count(subscript)) {
        (false, Some(n)) if n > 0 => format!("{label} {n}"),
        _ => label,
    };
    let words = match wrong {
        Some(wrong) => Err(wrong),
        None if pair.len() < 2 => Err("has only one of its two lines in the directory".into()),
        None => Ok(vec![]),
    };
    let line = pair.first().map_or(0, |(line, _)| *line);
    let status = [0, 1, 2, 3].map(two);
    Entity { number, kind, form, matrix, level, color, status, label, line, words }
}

/// Where the parameters of an entity stand.
fn own_words(
    entity: &mut Entity,
    pair: &[(u64, &[u8])],
    parameters: &[(u64, &[u8])],
    text: &[u8],
    signs: [u8; 2],
) -> std::result::Result<Vec<Range<usize>>, String> {
    let at = |row: usize, k: usize| count(field(pair, row, k)).and_then(|n| usize::try_from(n).ok());
    let first = at(0, 1).and_then(|first| first.checked_sub(1));
    let lines = at(1, 3).unwrap_or(1).max(1);
    let own = first.and_then(|first| Some(first..first.checked_add(lines)?));
    let Some(own) = own.filter(|own| own.end <= parameters.len()) else {
        return Err(format!("has parameters on lines that are not among the {} there are", parameters.len()));
    };
    entity.line = parameters.get(own.start).map_or(entity.line, |(line, _)| *line);
    let start = own.start * PARAMETER_COLUMNS;
    let own = &text[start..own.end * PARAMETER_COLUMNS];
    let mut found = words(own, signs).map_err(|fault| format!("has damaged parameters: {fault}"))?;
    if found.is_empty() || integer(&own[found[0].clone()]) != i64::try_from(entity.kind).ok() {
        return Err("has parameters that do not begin with its kind".into());
    }
    found.remove(0);
    Ok(found.into_iter().map(|word| word.start + start..word.end + start).collect())
}

impl Entity {
    /// What is wrong with it.
    pub fn wrong(&self, reason: impl Into<String>) -> Wrong {
        Wrong { entity: self.number, line: self.line, reason: reason.into() }
    }
}

//! Entities of an IGES file, from its lines of fixed columns.

use crate::error::{Fault, Located, Result};
use crate::lines::Lines;
use crate::number::{integer, whole_number};
use std::collections::BTreeMap;

/// An entity.
pub(super) struct Entity {
    pub kind: u64,
    /// Line of the directory of the matrix that places it; 0 for none.
    pub matrix: u64,
    /// Line in the file where its parameters begin, for messages.
    pub line: u64,
    /// Its parameters, after its number.
    pub parameters: Vec<Vec<u8>>,
}

/// The file: its global parameters, and its entities by the line of the directory.
pub(super) struct Model {
    pub global: Vec<Vec<u8>>,
    pub entities: BTreeMap<u64, Entity>,
}

impl Entity {
    /// A fault of it.
    pub(super) fn wrong(&self, expected: &'static str, found: &[u8]) -> Located {
        Fault::unexpected(expected, found).at_line(self.line)
    }
    /// Parameter `k` as a whole number; 0 where it is left out.
    pub(super) fn integer(&self, k: usize) -> Result<i64> {
        let word = self.parameters.get(k).map_or(&b""[..], |w| w);
        let value = if word.is_empty() { Some(0) } else { integer(word) };
        value.ok_or_else(|| self.wrong("a whole number", word))
    }
    /// Parameters from `k` on as numbers; 0 where they are left out.
    pub(super) fn reals(&self, k: usize, count: usize) -> Result<Vec<f64>> {
        let end = k.checked_add(count).filter(|end| *end <= self.parameters.len());
        let Some(end) = end else {
            let there = self.parameters.len().saturating_sub(k) as u64;
            let short = Fault::Short { what: "numbers", declared: count as u64, present: there };
            return Err(short.at_line(self.line));
        };
        let number = |word: &Vec<u8>| {
            let value = if word.is_empty() { Some(0.0) } else { whole_number(word, b'.') };
            value.filter(|x| x.is_finite()).ok_or_else(|| self.wrong("a number", word))
        };
        self.parameters[k..end].iter().map(number).collect()
    }
}

/// Columns of a line.
const LINE_COLUMNS: usize = 80;
/// The column, from 0, whose letter names the section of a line; the content stands before it.
pub(super) const SECTION_COLUMN: usize = 72;

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

/// Reads the sections.
pub(super) fn model(text: &[u8]) -> Result<Model> {
    let mut sections: BTreeMap<u8, Vec<(u64, &[u8])>> = BTreeMap::new();
    let mut lines = Lines::new(text);
    while let Some(line) = lines.next() {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        if line.trim_ascii().is_empty() {
            continue;
        }
        let Some(letter) = line.get(SECTION_COLUMN).filter(|l| matches!(l, b'S' | b'G' | b'D' | b'P' | b'T'))
        else {
            let what = "a line of 80 columns with S, G, D, P or T in the 73rd";
            return Err(Fault::unexpected(what, line).at_line(lines.number));
        };
        sections.entry(*letter).or_default().push((lines.number, line));
    }
    if !sections.contains_key(&b'T') {
        let what = "the line of section T at the end";
        return Err(Fault::unexpected(what, b"").at_line(lines.number));
    }
    let of = |letter: u8| sections.get(&letter).map_or(&[][..], |all| all);
    let global = of(b'G');
    let signs = signs(global);
    let whole: Vec<u8> = global.iter().flat_map(|(_, l)| &l[..72]).copied().collect();
    let global = words(&whole, signs).map_err(|f| f.at_line(global.first().map_or(1, |l| l.0)))?;
    let mut entities = BTreeMap::new();
    let parameters = of(b'P');
    for (k, pair) in of(b'D').chunks(2).enumerate() {
        let [first, second] = pair else {
            return Err(
                Fault::unexpected("two lines of the directory for each entity", b"").at_line(pair[0].0)
            );
        };
        let field = |(number, line): &(u64, &[u8]), k: usize| {
            let word = line[8 * k..8 * k + 8].trim_ascii();
            let value = if word.is_empty() { Some(0) } else { crate::number::count(word) };
            value.ok_or_else(|| Fault::unexpected("a number in the directory", word).at_line(*number))
        };
        let kind = field(first, 0)?;
        // Only these are looked into; others may be laid out in any way.
        if !READ_ENTITY_KINDS.contains(&kind) {
            let entity = Entity { kind, matrix: 0, line: first.0, parameters: vec![] };
            entities.insert(2 * k as u64 + 1, entity);
            continue;
        }
        let (start, matrix, count) = (field(first, 1)?, field(first, 6)?, field(second, 3)?.max(1));
        let from = usize::try_from(start).ok().and_then(|s| s.checked_sub(1));
        let own = from.and_then(|f| parameters.get(f..f.checked_add(usize::try_from(count).ok()?)?));
        let Some(own) = own else {
            let short = Fault::Short {
                what: "lines of parameters",
                declared: count,
                present: parameters.len() as u64,
            };
            return Err(short.at_line(first.0));
        };
        let line = own[0].0;
        let text: Vec<u8> = own.iter().flat_map(|(_, l)| &l[..64]).copied().collect();
        let mut words = words(&text, signs).map_err(|f| f.at_line(line))?.into_iter();
        let number = words.next().unwrap_or_default();
        if integer(&number) != i64::try_from(kind).ok() {
            return Err(Fault::unexpected("the number of the entity first", &number).at_line(line));
        }
        entities.insert(2 * k as u64 + 1, Entity { kind, matrix, line, parameters: words.collect() });
    }
    Ok(Model { global, entities })
}

/// Kinds of entities whose parameters are read: matrix, B-spline curve and surface, trimmed surface with its bounds and their curves, face.
const READ_ENTITY_KINDS: [u64; 9] = [102, 110, 124, 126, 128, 142, 143, 144, 510];

/// The signs that end a parameter and an entity: the first two global parameters say them.
fn signs(global: &[(u64, &[u8])]) -> [u8; 2] {
    let Some((_, line)) = global.first() else { return [b',', b';'] };
    match &line[..8] {
        [b'1', b'H', a, _, b'1', b'H', b, ..] => [*a, *b],
        [b'1', b'H', a, _, other, ..] if other != &b'1' => [*a, b';'],
        [a, b'1', b'H', b, ..] => [*a, *b],
        _ => [b',', b';'],
    }
}

/// Parameters up to the sign that ends them all, text without its count.
fn words(text: &[u8], [between, last]: [u8; 2]) -> std::result::Result<Vec<Vec<u8>>, Fault> {
    let (mut all, mut at) = (vec![], 0);
    loop {
        while text.get(at) == Some(&b' ') {
            at += 1;
        }
        let digits = text[at.min(text.len())..].iter().take_while(|b| b.is_ascii_digit()).count();
        if digits > 0 && text.get(at + digits) == Some(&b'H') {
            let count = crate::number::count(&text[at..at + digits]).and_then(|n| usize::try_from(n).ok());
            let from = at + digits + 1;
            let own = count.and_then(|n| text.get(from..from.checked_add(n)?));
            let Some(own) = own else {
                return Err(Fault::unexpected("text as long as it says", &text[at..]));
            };
            all.push(own.to_vec());
            at = from + own.len();
        } else {
            let end = text[at..].iter().position(|b| *b == between || *b == last);
            let Some(end) = end else {
                return Err(Fault::unexpected(
                    "a sign that ends the parameters",
                    &text[at.min(text.len())..],
                ));
            };
            all.push(text[at..at + end].trim_ascii().to_vec());
            at += end;
        }
        while text.get(at) == Some(&b' ') {
            at += 1;
        }
        match text.get(at) {
            Some(b) if *b == last => return Ok(all),
            Some(b) if *b == between => at += 1,
            _ => return Err(Fault::unexpected("a sign between parameters", &text[at.min(text.len())..])),
        }
    }
}

//! ASCII STL: words, separated by any white space.
//!
//! Large files are cut into parts behind lines that say `endfacet`, and each part is read by itself. The first fault in the
//! file is reported, whichever part was read first. Positions keep all digits of the text, beyond single precision.

use super::facet::Facet;
use crate::{
    FacetRegions, Warning,
    error::{Fault, Result, quoted},
    lines::{line_end, line_of, without_mark},
    number::number,
};
use trueness_geom::parallel::prelude::*;

/// One task reads about this many bytes.
const STL_TEXT_BYTES_PER_TASK: usize = 1 << 20;

/// A facet as the text gives it.
#[derive(Clone, Copy)]
pub(super) struct TextFacet {
    normal: [f32; 3],
    corners: [[f64; 3]; 3],
}

impl Facet for TextFacet {
    type Position = [f64; 3];
    fn corner(&self, k: usize) -> [f64; 3] {
        self.corners[k]
    }
    fn normal(&self) -> [f32; 3] {
        self.normal
    }
    fn finite(&self) -> bool {
        self.corners.as_flattened().iter().all(|x| x.is_finite())
    }
}

/// The content of an ASCII file.
pub(super) struct Read {
    pub facets: Vec<TextFacet>,
    /// The solid of each facet, where there are several.
    pub regions: Option<FacetRegions>,
    pub warnings: Vec<Warning>,
}

/// Reads the facets of all solids.
pub(super) fn read(bytes: &[u8]) -> Result<Read> {
    let text = without_mark(bytes);
    let mut starts = vec![0];
    while let Some(next) = behind_endfacet(text, starts[starts.len() - 1] + STL_TEXT_BYTES_PER_TASK) {
        starts.push(next);
    }
    let ends = starts.iter().skip(1).copied().chain([text.len()]);
    let parts: Vec<(usize, usize)> = starts.iter().copied().zip(ends).collect();
    let parsed: Vec<std::result::Result<TextPart, (usize, Fault)>> =
        parts.into_par_iter().map(|(from, to)| TextPart::read(text, from, to)).collect();
    let mut all = TextPart::default();
    let (mut open, mut behind) = (false, None);
    let mut facets = Vec::new();
    let mut regions = FacetRegions::default();
    for part in parsed {
        let part = part.map_err(|(at, fault)| fault.at_line(line_of(text, at)))?;
        open = part.open.unwrap_or(open);
        behind = part.text.or(behind);
        all.solids += part.solids;
        // Facets before the first name of a part are of the solid that was open at its start.
        let mut names = part.names.into_iter().peekable();
        for f in 0..part.facets.len() {
            while let Some((_, name)) = names.next_if(|(first, _)| *first <= f) {
                regions.names.push(name);
            }
            regions.of_facet.push((regions.names.len() as u32).saturating_sub(1));
        }
        regions.names.extend(names.map(|(_, name)| name));
        facets.push(part.facets);
    }
    let mut warnings = vec![];
    if all.solids > 1 {
        warnings.push(Warning::Solids { count: all.solids });
    }
    if open {
        warnings.push(Warning::NoEndsolid);
    }
    if let Some(at) = behind {
        let first = text[at..].split(|b| matches!(b, b'\n' | b'\r')).next().unwrap_or_default();
        warnings.push(Warning::TextBehind { line: line_of(text, at), text: quoted(first) });
    }
    Ok(Read { facets: facets.concat(), regions: (all.solids > 1).then_some(regions), warnings })
}

/// The start of the line after the first `endfacet` line that begins behind `at`; `None` near the end.
fn behind_endfacet(text: &[u8], at: usize) -> Option<usize> {
    let end = line_end(&text[..text.len().min(STL_TEXT_BYTES_PER_TASK)]);
    let mut at = at + memchr::memchr(end, text.get(at..)?)? + 1;
    loop {
        let line = &text[at..];
        let length = memchr::memchr(end, line)? + 1;
        at += length;
        let mut words = Words::new(&line[..length], 0);
        if words.end_of("facet") && words.next().is_none() {
            return Some(at);
        }
    }
}

/// The facets of a part of the text.
#[derive(Default)]
struct TextPart {
    facets: Vec<TextFacet>,
    solids: u64,
    /// First facet and name of each solid that begins here.
    names: Vec<(usize, String)>,
    /// Whether a solid is open at the end; `None` if no solid begins or ends in this part.
    open: Option<bool>,
    /// Where text begins that stands behind the last solid.
    text: Option<usize>,
}

impl TextPart {
    /// Reads `text[from..to]`, which begins between two facets.
    fn read(text: &[u8], from: usize, to: usize) -> std::result::Result<TextPart, (usize, Fault)> {
        let mut words = Words::new(&text[..to], from);
        // A facet takes 100 bytes at least; asking for more than is there would trust the file.
        let mut part = TextPart { facets: Vec::with_capacity((to - from) / 256), ..TextPart::default() };
        loop {
            if words.end_of("solid") {
                words.skip_name(false);
                part.open = Some(false);
                continue;
            }
            let Some((at, word)) = words.next() else { break };
            if is(word, "facet") {
                part.facets.push(words.facet()?);
            } else if is(word, "solid") {
                let start = words.at;
                words.skip_name(true);
                let name = String::from_utf8_lossy(text[start..words.at].trim_ascii()).into_owned();
                part.names.push((part.facets.len(), name));
                part.solids += 1;
                part.open = Some(true);
            } else if part.open == Some(false) && to == text.len() && is_prose(&text[at..]) {
                part.text = Some(at);
                break;
            } else {
                return Err((at, Fault::unexpected("\"facet\", \"solid\" or \"endsolid\"", word)));
            }
        }
        Ok(part)
    }
}

/// Whether no line of a text begins with a word of the format.
fn is_prose(text: &[u8]) -> bool {
    const FORMAT_WORDS: [&str; 9] =
        ["facet", "solid", "outer", "vertex", "end", "loop", "endloop", "endfacet", "endsolid"];
    let mut first = text.split(|b| matches!(b, b'\n' | b'\r')).filter_map(|line| Words::new(line, 0).next());
    first.all(|(_, word)| !FORMAT_WORDS.iter().any(|known| is(word, known)))
}

fn is(word: &[u8], name: &str) -> bool {
    word.eq_ignore_ascii_case(name.as_bytes())
}

/// Words of the text and where they are.
#[derive(Clone)]
struct Words<'a> {
    text: &'a [u8],
    at: usize,
    /// Where a line without facets ends, and where a facet begins on a line with a name: as found out last.
    no_facet: usize,
    facet: usize,
}

type Step<T> = std::result::Result<T, (usize, Fault)>;

impl<'a> Words<'a> {
    fn new(text: &'a [u8], at: usize) -> Words<'a> {
        Words { text, at, no_facet: 0, facet: 0 }
    }

    #[inline]
    fn next(&mut self) -> Option<(usize, &'a [u8])> {
        let blank = |b: &u8| b.is_ascii_whitespace();
        let start = self.at + self.text[self.at..].iter().position(|b| !blank(b))?;
        let length = self.text[start..].iter().position(blank).unwrap_or(self.text.len() - start);
        self.at = start + length;
        Some((start, &self.text[start..self.at]))
    }

    fn expect(&mut self, name: &'static str) -> Step<()> {
        match self.next() {
            Some((_, word)) if is(word, name) => Ok(()),
            Some((at, word)) => Err((at, Fault::unexpected(format!("\"{name}\""), word))),
            None => Err((self.text.len(), Fault::unexpected(format!("\"{name}\""), b"the end of the file"))),
        }
    }

    /// Passes over `endNAME` or, as some programs write, `end NAME`. False, and nothing passed over, if neither is next.
    fn end_of(&mut self, name: &str) -> bool {
        let before = self.at;
        let found = match self.next() {
            Some((_, word)) if is(word, "end") => self.next().is_some_and(|(_, word)| is(word, name)),
            Some((_, word)) => word.len() == 3 + name.len() && is(&word[..3], "end") && is(&word[3..], name),
            None => false,
        };
        if !found {
            self.at = before;
        }
        found
    }

    fn expect_end(&mut self, name: &str) -> Step<()> {
        if self.end_of(name) {
            return Ok(());
        }
        let expected = format!("\"end{name}\"");
        match self.next() {
            Some((at, word)) => Err((at, Fault::unexpected(expected, word))),
            None => Err((self.text.len(), Fault::unexpected(expected, b"the end of the file"))),
        }
    }

    /// Passes over the name of a solid: the rest of the line, whatever words are in it. A facet on the same line shows that the
    /// file has no line ends; there the name ends before the next word of the format.
    fn skip_name(&mut self, begins: bool) {
        let line = &self.text[self.at..];
        let end = self.at + memchr::memchr2(b'\n', b'\r', line).unwrap_or(line.len());
        if end <= self.no_facet {
            self.at = self.end_of_empty(end, begins);
            return;
        }
        let mut words = Words { text: &self.text[..end], ..self.clone() };
        // The first word of the format, if a facet follows.
        let mut first = None;
        loop {
            let start = words.at;
            let ends = words.end_of("solid");
            let word = if ends {
                &b"solid"[..]
            } else if let Some((_, word)) = words.next() {
                word
            } else {
                break;
            };
            if is(word, "facet") && (Words { text: self.text, ..words.clone() }).begins_facet() {
                self.facet = start;
            }
            if is(word, "solid") && first.is_none() {
                first = Some(start);
            }
            // A facet that is known to lie ahead need not be looked for again.
            if self.facet >= start && (first.is_some() || self.facet == start) {
                self.at = first.unwrap_or(start);
                return;
            }
        }
        self.no_facet = end;
        self.at = self.end_of_empty(end, begins);
    }

    /// Where the name of a solid ends, on a line up to `line_end` that holds no facet. That is the line end, unless an empty solid
    /// ends on the same line.
    fn end_of_empty(&self, line_end: usize, begins: bool) -> usize {
        let text = &self.text[self.at..line_end];
        let lower = text.to_ascii_lowercase();
        let Some(end) = memchr::memmem::rfind(&lower, b"endsolid").filter(|_| begins) else {
            return line_end;
        };
        let (name, again) = (text[..end].trim_ascii(), text[end + 8..].trim_ascii());
        if again.is_empty() || again == name { self.at + end } else { line_end }
    }

    /// Whether the words behind `facet` are those that a facet begins with.
    fn begins_facet(mut self) -> bool {
        if self.expect("normal").is_err() {
            return false;
        }
        let outer = (0..4).any(|_| self.next().is_some_and(|(_, word)| is(word, "outer")));
        outer && self.expect("loop").is_ok() && self.expect("vertex").is_ok()
    }

    /// A facet from behind its first word to `endfacet`.
    fn facet(&mut self) -> Step<TextFacet> {
        self.expect("normal")?;
        let mut normal = [0.0; 3];
        for n in &mut normal {
            let before = self.at;
            match self.next() {
                // Too few words: the corners count, not the normal.
                Some((_, word)) if is(word, "outer") => {
                    self.at = before;
                    break;
                }
                Some((_, word)) => *n = number(word, b'.').map_or(0.0, |(x, _)| x as f32),
                None => break,
            }
        }
        self.expect("outer")?;
        self.expect("loop")?;
        let mut corners = [[0.0; 3]; 3];
        for corner in &mut corners {
            self.expect("vertex")?;
            for x in corner {
                *x = self.coordinate()?;
            }
        }
        self.expect_end("loop")?;
        self.expect_end("facet")?;
        Ok(TextFacet { normal, corners })
    }

    #[inline]
    fn coordinate(&mut self) -> Step<f64> {
        // Numbers are short: parsing them where they stand saves looking for their end first.
        let blank = self.text[self.at..].iter().position(|b| !b.is_ascii_whitespace());
        let start = blank.map_or(self.text.len(), |n| self.at + n);
        if let Some((x, length)) = number(&self.text[start..], b'.')
            && self.text.get(start + length).is_none_or(u8::is_ascii_whitespace)
        {
            self.at = start + length;
            return Ok(x);
        }
        match self.next() {
            Some((at, word)) => Err((at, Fault::unexpected("a number with a decimal point", word))),
            None => Err((self.text.len(), Fault::unexpected("a number", b"the end of the file"))),
        }
    }
}

//! ASCII STL: words, separated by any white space.
//!
//! Large files are cut into parts behind lines that say `endfacet`, each read by itself; a fault found in one is the
//! same whoever finds it, and the first in the file is reported. Positions keep what the text says beyond single
//! precision.

use super::facet::Facet;
use crate::{
    Warning,
    error::{Fault, Result},
    lines::{line_end, line_of, without_mark},
    number::number,
};
use trueness_geom::parallel::prelude::*;

/// Bytes of one part.
const PART: usize = 1 << 20;

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

/// What ASCII text held.
pub(super) struct Read {
    pub facets: Vec<TextFacet>,
    pub warnings: Vec<Warning>,
}

/// Reads the facets of all solids.
pub(super) fn read(bytes: &[u8]) -> Result<Read> {
    let text = without_mark(bytes);
    let mut starts = vec![0];
    while let Some(next) = behind_endfacet(text, starts[starts.len() - 1] + PART) {
        starts.push(next);
    }
    let ends = starts.iter().skip(1).copied().chain([text.len()]);
    let parts: Vec<(usize, usize)> = starts.iter().copied().zip(ends).collect();
    let parsed: Vec<std::result::Result<Part, (usize, Fault)>> =
        parts.into_par_iter().map(|(from, to)| Part::read(text, from, to)).collect();
    let mut all = Part::default();
    let mut open = false;
    let mut facets = Vec::new();
    for part in parsed {
        let part = part.map_err(|(at, fault)| fault.at_line(line_of(text, at)))?;
        open = part.open.unwrap_or(open);
        all.solids += part.solids;
        facets.push(part.facets);
    }
    let mut warnings = vec![];
    if all.solids > 1 {
        warnings.push(Warning::Solids { count: all.solids });
    }
    if open {
        warnings.push(Warning::NoEndsolid);
    }
    Ok(Read { facets: facets.concat(), warnings })
}

/// The start of the line after the first `endfacet` line that begins behind `at`; `None` near the end.
fn behind_endfacet(text: &[u8], at: usize) -> Option<usize> {
    let end = line_end(&text[..text.len().min(PART)]);
    let mut at = at + memchr::memchr(end, text.get(at..)?)? + 1;
    loop {
        let line = &text[at..];
        let length = memchr::memchr(end, line)? + 1;
        at += length;
        if line[..length].trim_ascii().eq_ignore_ascii_case(b"endfacet") {
            return Some(at);
        }
    }
}

/// The facets of a part of the text.
#[derive(Default)]
struct Part {
    facets: Vec<TextFacet>,
    solids: u64,
    /// Whether a solid is open at the end; `None` if no solid begins or ends here.
    open: Option<bool>,
}

impl Part {
    /// Reads `text[from..to]`, which begins between two facets.
    fn read(text: &[u8], from: usize, to: usize) -> std::result::Result<Part, (usize, Fault)> {
        let mut words = Words { text: &text[..to], at: from };
        // A facet takes 100 bytes at least; asking for more than is there would trust the file.
        let mut part = Part { facets: Vec::with_capacity((to - from) / 256), ..Part::default() };
        while let Some((at, word)) = words.next() {
            if is(word, "facet") {
                part.facets.push(words.facet()?);
            } else if is(word, "solid") {
                words.skip_name();
                part.solids += 1;
                part.open = Some(true);
            } else if is(word, "endsolid") {
                words.skip_name();
                part.open = Some(false);
            } else {
                return Err((at, Fault::unexpected("\"facet\", \"solid\" or \"endsolid\"", word)));
            }
        }
        Ok(part)
    }
}

fn is(word: &[u8], name: &str) -> bool {
    word.eq_ignore_ascii_case(name.as_bytes())
}

/// Words of the text and where they are.
struct Words<'a> {
    text: &'a [u8],
    at: usize,
}

type Step<T> = std::result::Result<T, (usize, Fault)>;

impl<'a> Words<'a> {
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

    /// Passes over the name of a solid: the rest of the line or, in a file without line ends, what comes before the
    /// next word that has a meaning.
    fn skip_name(&mut self) {
        let line = &self.text[self.at..];
        let line = &line[..memchr::memchr2(b'\n', b'\r', line).unwrap_or(line.len())];
        let mut words = Words { text: &self.text[..self.at + line.len()], at: self.at };
        while let Some((start, word)) = words.next() {
            let facet = is(word, "facet") && words.clone().next().is_some_and(|(_, w)| is(w, "normal"));
            if facet || is(word, "endsolid") || is(word, "solid") && words.clone().any_facet() {
                words.at = start;
                break;
            }
        }
        self.at = words.at;
    }

    fn any_facet(mut self) -> bool {
        while let Some((_, word)) = self.next() {
            if is(word, "facet") {
                return true;
            }
        }
        false
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
        self.expect("endloop")?;
        self.expect("endfacet")?;
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

impl Clone for Words<'_> {
    fn clone(&self) -> Self {
        Words { text: self.text, at: self.at }
    }
}

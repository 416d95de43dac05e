//! Rows of elements in text.
//!
//! Most programs write a row as a line. Most readers take words wherever the lines end, so there are files with lines
//! broken at will. A reading by lines is right if each line holds exactly the words of a row. Else a reading by words is
//! right if it uses the file up to its last word. Where neither is right, the fault of the better one is reported.

use super::header::{Element, PropertyType};
use crate::{
    error::{Fault, Result},
    flow::Flow,
    lines::{Lines, words},
    number::{count, whole_number},
};

/// Takes the wanted list of a row: the element and the numbers of the list.
pub(super) type TakeList<'t> = dyn FnMut(&Element, &[f64]) -> std::result::Result<(), Fault> + 't;

/// The property wanted of the rows of an element, if any.
pub(super) type WantedList = fn(&Element) -> Option<usize>;

/// The text after the rows, and whether each row had its proper length.
pub(super) struct Passed<'a> {
    pub rest: &'a [u8],
    even: bool,
}

/// The reading by lines, from a text that begins behind `before` lines.
pub(super) fn by_lines<'a>(
    text: &'a [u8],
    before: u64,
    elements: &[Element],
    wanted: WantedList,
    take: &mut TakeList,
) -> Result<Passed<'a>> {
    let mut lines = Lines::new(text);
    let (mut list, mut even) = (vec![], true);
    for element in elements.iter().filter(|e| !e.properties.is_empty()) {
        let wanted = wanted(element);
        for row in 0..element.count {
            let Some(line) = lines.find(|l| !l.trim_ascii().is_empty()) else {
                return Err(short(element, row).at_line(before + lines.number));
            };
            let number = before + lines.number;
            let mut words = words(line);
            // Rows that are not wanted may be written in any way.
            match row_of(element, wanted, &mut words, &mut list) {
                Ok(()) => even &= words.next().is_none(),
                Err(BadRow) if wanted.is_none() => even = false,
                Err(BadRow) => return Err(Fault::unexpected(expected(element), line).at_line(number)),
            }
            if wanted.is_some() {
                take(element, &list).map_err(|f| f.at_line(number))?;
            }
        }
    }
    Ok(Passed { rest: lines.rest(), even })
}

/// The reading by words.
pub(super) fn by_words<'a>(
    text: &'a [u8],
    before: u64,
    elements: &[Element],
    wanted: WantedList,
    take: &mut TakeList,
) -> Result<Passed<'a>> {
    let mut flow = Flow::new(text, false);
    let mut list = vec![];
    for element in elements.iter().filter(|e| !e.properties.is_empty()) {
        let wanted = wanted(element);
        for row in 0..element.count {
            let start = flow.at;
            if row_of(element, wanted, &mut flow, &mut list).is_err() {
                let fault = match flow.clone().next() {
                    None => short(element, row),
                    Some(_) => Fault::unexpected(expected(element), &text[start..flow.at]),
                };
                return Err(fault.at_line(before + flow.line()));
            }
            if wanted.is_some() {
                take(element, &list).map_err(|f| f.at_line(before + flow.line()))?;
            }
        }
    }
    Ok(Passed { rest: flow.rest(), even: true })
}

impl Passed<'_> {
    /// Whether every row had its proper length and, if `to_end`, nothing follows.
    pub fn is_exact(&self, to_end: bool) -> bool {
        self.even && (!to_end || self.rest.trim_ascii().is_empty())
    }
}

/// The text after the rows of elements that are not wanted.
pub(super) fn skip_elements<'a>(text: &'a [u8], before: u64, elements: &[Element]) -> Result<&'a [u8]> {
    let (nothing, mut take): (WantedList, _) = (|_| None, |_: &Element, _: &[f64]| Ok(()));
    let lines = by_lines(text, before, elements, nothing, &mut take);
    match lines {
        Ok(passed) if passed.is_exact(false) => Ok(passed.rest),
        lines => match by_words(text, before, elements, nothing, &mut take) {
            Ok(passed) => Ok(passed.rest),
            Err(_) => lines.map(|passed| passed.rest),
        },
    }
}

fn short(element: &Element, present: u64) -> Fault {
    let what = if element.name == "face" { "faces" } else { "rows" };
    Fault::Short { what, declared: element.count, present }
}

fn expected(element: &Element) -> &'static str {
    if element.name == "face" {
        "the number of corners and as many numbers of vertices"
    } else {
        "as many words as the properties in the header"
    }
}

/// A row is not what it should be.
pub(super) struct BadRow;

/// Passes over the words of a row and gives the numbers of the list `wanted`.
pub(super) fn row_of<'w>(
    element: &Element,
    wanted: Option<usize>,
    words: &mut impl Iterator<Item = &'w [u8]>,
    list: &mut Vec<f64>,
) -> std::result::Result<(), BadRow> {
    let mut next = || words.next().ok_or(BadRow);
    for (i, property) in element.properties.iter().enumerate() {
        let PropertyType::List { .. } = property.kind else {
            next()?;
            continue;
        };
        let size = count(next()?).ok_or(BadRow)?;
        if wanted == Some(i) {
            list.clear();
        }
        for _ in 0..size {
            let word = next()?;
            if wanted == Some(i) {
                list.push(whole_number(word, b'.').ok_or(BadRow)?);
            }
        }
    }
    Ok(())
}

//! Vertices in text whose rows are no lines, or hold lists: words, one after the other.

use super::header::{Element, PropertyType};
use crate::{
    error::{Fault, Located, Result},
    feed::Feed,
    flow::Flow,
    lines::{Lines, count_lines, words},
    number::{count, whole_number},
};
use trueness_geom::{cloud::PointStream, space::Point};

/// A block begins with a window of this many bytes.
const FIRST_WINDOW_BYTES: usize = 1 << 20;

/// Points of such rows.
pub(super) struct FlowPoints {
    feed: Feed,
    vertex: Element,
    /// Which properties are the coordinates.
    xyz: [usize; 3],
    /// The byte that ends lines, and how many have been stepped over.
    end: u8,
    lines: u64,
    found: u64,
    block: usize,
}

/// Whether the rows of `vertex` are lines. `head` holds the first rows, and all of them if `whole`. Lines may hold more words than a
/// row has properties if all lines do.
pub(super) fn rows_are_lines(vertex: &Element, xyz: [usize; 3], head: &[u8], whole: bool) -> bool {
    let list = vertex.properties.iter().position(|p| matches!(p.kind, PropertyType::List { .. }));
    if let Some(list) = list {
        // A list behind the coordinates may be declared and not be there.
        return xyz.iter().all(|i| *i < list)
            && !fits(vertex, xyz, head, whole)
            && lists_are_missing(vertex, head, whole);
    }
    let mut lines = Lines::new(head);
    let (mut count, mut width) = (0, None);
    while count < vertex.count {
        let Some(line) = lines.find(has_words) else { break };
        // The head may end within a line.
        if !whole && lines.rest().is_empty() {
            return true;
        }
        let there = words(line).count();
        if *width.get_or_insert(there) != there || there < vertex.properties.len() {
            return false;
        }
        count += 1;
    }
    count == vertex.count || !whole || width == Some(vertex.properties.len())
}

/// Whether a line has words.
fn has_words(line: &&[u8]) -> bool {
    !line.trim_ascii().is_empty() && !line.trim_ascii().starts_with(b"#")
}

/// Whether each row is a line that holds all properties but the lists.
fn lists_are_missing(vertex: &Element, head: &[u8], whole: bool) -> bool {
    let single = vertex.properties.iter().filter(|p| matches!(p.kind, PropertyType::One(_))).count();
    let mut lines = Lines::new(head);
    for _ in 0..vertex.count {
        let Some(line) = lines.find(has_words) else { break };
        // The head may end within a line.
        if !whole && lines.rest().is_empty() {
            break;
        }
        if words(line).count() != single {
            return false;
        }
    }
    true
}

/// Whether the words of `head` are rows as they are declared.
fn fits(vertex: &Element, xyz: [usize; 3], head: &[u8], whole: bool) -> bool {
    let mut flow = Flow::new(head, false);
    for number in 0..vertex.count {
        match row(vertex, xyz, number, &mut flow) {
            Ok(Some(_)) => {}
            // The last word of the head may be cut.
            Ok(None) => return !whole,
            Err(_) => return !whole && flow.rest().is_empty(),
        }
    }
    true
}

impl FlowPoints {
    pub fn new(
        feed: Feed,
        vertex: Element,
        xyz: [usize; 3],
        end: u8,
        lines: u64,
        block: usize,
    ) -> FlowPoints {
        FlowPoints { feed, vertex, xyz, end, lines, found: 0, block: block.max(1) }
    }
    /// The file, as far as it has been read.
    pub fn feed(&mut self) -> &mut Feed {
        &mut self.feed
    }
    /// The file behind the points and how many lines have been stepped over.
    pub fn into_rest(self) -> (Feed, u64) {
        (self.feed, self.lines)
    }

    /// Reads whole rows of the next `want` bytes, and gives how many bytes they take.
    fn rows(&mut self, want: usize, block: &mut Vec<Point>) -> Result<usize> {
        let (found, before, end) = (self.found, self.lines, self.end);
        let bytes = self.feed.ahead(want)?;
        let (bytes, last) = (&bytes[..bytes.len().min(want)], bytes.len() < want);
        let mut flow = Flow::new(bytes, false);
        let mut used = 0;
        while block.len() < self.block && found + (block.len() as u64) < self.vertex.count {
            let number = found + block.len() as u64;
            let row = row(&self.vertex, self.xyz, number, &mut flow);
            // A word at the end of the window may go on behind it.
            if !last && (flow.rest().is_empty() || matches!(row, Ok(None))) {
                break;
            }
            let line = || before + 1 + count_lines(&bytes[..flow.at], end);
            let short = Fault::Short { what: "points", declared: self.vertex.count, present: number };
            match row {
                Ok(Some(point)) => block.push(point),
                Ok(None) => return Err(short.at_line(line())),
                Err(fault) => return Err(fault.at_line(line())),
            }
            used = flow.at;
        }
        self.lines += count_lines(&bytes[..used], end);
        Ok(used)
    }
}

impl PointStream for FlowPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.vertex.count)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        block.clear();
        let mut want = FIRST_WINDOW_BYTES;
        while block.is_empty() && self.found < self.vertex.count {
            let used = self.rows(want, block)?;
            self.feed.step(used);
            want = want.saturating_mul(2);
        }
        self.found += block.len() as u64;
        Ok(())
    }
}

/// The point of the row ahead; `None` if the words end within it.
fn row(
    vertex: &Element,
    xyz: [usize; 3],
    number: u64,
    flow: &mut Flow,
) -> std::result::Result<Option<Point>, Fault> {
    let mut point = [0.0; 3];
    for (i, property) in vertex.properties.iter().enumerate() {
        let Some(word) = flow.next() else { return Ok(None) };
        if let PropertyType::List { .. } = property.kind {
            let size = count(word).ok_or_else(|| Fault::unexpected("the length of a list", word))?;
            for _ in 0..size {
                let Some(item) = flow.next() else { return Ok(None) };
                if whole_number(item, b'.').is_none() {
                    return Err(Fault::unexpected("as many numbers as the length of the list says", item));
                }
            }
        } else if let Some(axis) = xyz.iter().position(|wanted| *wanted == i) {
            let x = whole_number(word, b'.')
                .ok_or_else(|| Fault::unexpected("a number with a decimal point", word))?;
            if !x.is_finite() {
                return Err(Fault::NotFinite { what: "vertex", number: number + 1 });
            }
            point[axis] = x;
        }
    }
    Ok(Some(point))
}

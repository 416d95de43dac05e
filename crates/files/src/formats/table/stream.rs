//! Rows of text to blocks of points, many rows at a time.
//!
//! The window over the file is cut into parts of whole lines. Lines are counted first, so that each part knows where
//! in the block its points go and is parsed straight into that place, by whichever thread; the gaps that comments
//! leave are closed afterwards. So the order is that of the file, whatever the threads did.

use super::row::Layout;
use crate::{
    error::{Fault, Located, Result},
    feed::Feed,
    lines::{count_lines, parts},
};
use rayon::prelude::*;
use trueness_geom::{cloud::PointStream, space::Point};

/// Bytes parsed at a time by one thread: they stay in its cache.
const PART: usize = 1 << 18;
/// The longest line taken for one.
const LINE: usize = 1 << 20;

/// How many points there should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Limit {
    /// As many as come.
    None,
    /// At least so many; fewer are a fault.
    Expected(u64),
    /// Exactly so many; what follows is something else.
    Exactly(u64),
}

/// Points of rows.
pub(crate) struct TextPoints {
    feed: Feed,
    layout: Layout,
    /// Lines stepped over.
    lines: u64,
    limit: Limit,
    /// Points delivered.
    found: u64,
    /// Bytes looked at for one block.
    window: usize,
}

impl TextPoints {
    /// Points from the rows ahead, the first of which is behind `lines` lines.
    pub fn new(feed: Feed, layout: Layout, lines: u64, limit: Limit, window: usize) -> TextPoints {
        TextPoints { feed, layout, lines, limit, found: 0, window: window.clamp(PART, 1 << 30) }
    }

    /// The file behind the points and how many lines have been stepped over.
    pub fn into_rest(self) -> (Feed, u64) {
        (self.feed, self.lines)
    }

    /// Parses the next window. False at the end of the points.
    fn advance(&mut self, block: &mut Vec<Point>) -> Result<bool> {
        let left = match self.limit {
            Limit::Exactly(n) => n - self.found,
            _ => u64::MAX,
        };
        if left == 0 {
            return Ok(false);
        }
        let bytes = self.feed.ahead(self.window)?;
        if bytes.is_empty() {
            return match self.limit {
                Limit::Expected(declared) | Limit::Exactly(declared) if self.found < declared => {
                    Err(Fault::Short { what: "points", declared, present: self.found }
                        .at_line(self.lines + 1))
                }
                _ => Ok(false),
            };
        }
        let window = whole_lines(bytes, self.window, self.layout.end)
            .ok_or_else(|| Fault::unexpected("a line of a table", &bytes[..64]).at_line(self.lines + 1))?;
        let window = first_lines(window, left, self.layout.end);
        let length = window.len();
        let lines = parse(window, &self.layout, self.lines, block)?;
        self.lines += lines;
        self.found += block.len() as u64;
        self.feed.step(length);
        Ok(true)
    }
}

impl PointStream for TextPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        match self.limit {
            Limit::Exactly(n) | Limit::Expected(n) => Some(n),
            Limit::None => None,
        }
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        loop {
            if !self.advance(block)? {
                block.clear();
                return Ok(());
            }
            // A window may hold comments only.
            if !block.is_empty() {
                return Ok(());
            }
        }
    }
}

/// The whole lines at the start of `bytes`, about `size` bytes of them. `None` if a line has no end.
fn whole_lines(bytes: &[u8], size: usize, end: u8) -> Option<&[u8]> {
    if bytes.len() <= size {
        // `ahead` gave less than was asked for, or just that.
        let cut = memchr::memrchr(end, bytes).map_or(bytes.len(), |i| i + 1);
        return Some(if bytes.len() < size { bytes } else { &bytes[..cut] });
    }
    match memchr::memrchr(end, &bytes[..size]) {
        Some(i) => Some(&bytes[..=i]),
        None if size > LINE => None,
        None => whole_lines(bytes, size * 2, end),
    }
}

/// At most the first `count` lines of `window`.
fn first_lines(window: &[u8], count: u64, end: u8) -> &[u8] {
    let there = count_lines(window, end);
    if there < count {
        return window;
    }
    let last = usize::try_from(count - 1).ok().and_then(|n| memchr::memchr_iter(end, window).nth(n));
    last.map_or(window, |i| &window[..=i])
}

/// Points of one part, or the line in it and what is wrong there.
type Filled = std::result::Result<usize, (u64, Fault)>;

/// Fills `block` with the points of whole lines; `before` lines came before. Gives the number of lines.
fn parse(window: &[u8], layout: &Layout, before: u64, block: &mut Vec<Point>) -> Result<u64> {
    let parts = parts(window, PART, layout.end);
    let counts: Vec<u64> = parts.par_iter().map(|p| count_lines(p, layout.end)).collect();
    let open = window.last().is_some_and(|b| *b != layout.end);
    let lines = counts.iter().sum::<u64>() + u64::from(open);
    // What the block held before is overwritten: only growth costs anything.
    block.resize(lines as usize, [0.0; 3]);
    let mut rest = &mut block[..];
    let mut jobs = Vec::with_capacity(parts.len());
    for (i, (part, count)) in parts.iter().zip(&counts).enumerate() {
        let last = i + 1 == parts.len();
        let (mine, later) = rest.split_at_mut(*count as usize + usize::from(last && open));
        rest = later;
        jobs.push((*part, mine));
    }
    let filled: Vec<Filled> = jobs.into_par_iter().map(|(part, mine)| fill(part, layout, mine)).collect();
    close_gaps(block, &counts, filled, before)?;
    Ok(lines)
}

/// Parses the lines of a part into `out`, which has room for one point each.
fn fill(part: &[u8], layout: &Layout, out: &mut [Point]) -> Filled {
    let mut found = 0;
    let mut start = 0;
    let mut number = 0;
    while start < part.len() {
        let end = memchr::memchr(layout.end, &part[start..]).map_or(part.len(), |n| start + n);
        number += 1;
        match layout.row(&part[start..end]) {
            Ok(None) => {}
            Ok(Some(point)) => {
                if let Some(slot) = out.get_mut(found) {
                    *slot = point;
                    found += 1;
                }
            }
            Err((_, fault)) => return Err((number, fault)),
        }
        start = end + 1;
    }
    Ok(found)
}

/// Moves the points of all parts together, or reports the first fault in the file.
fn close_gaps(block: &mut Vec<Point>, room: &[u64], filled: Vec<Filled>, before: u64) -> Result<()> {
    let (mut from, mut to, mut lines) = (0usize, 0usize, before);
    for (room, filled) in room.iter().zip(filled) {
        let found = filled.map_err(|(line, fault)| fault.at_line(lines + line))?;
        if from != to {
            block.copy_within(from..from + found, to);
        }
        from += *room as usize;
        to += found;
        lines += room;
    }
    block.truncate(to);
    Ok(())
}

//! Rows of text to blocks of points, many rows at a time.
//!
//! The window over the file is cut into parts of whole lines. Lines are counted first, so that each part knows the place
//! of its points in the block. Any thread may parse it straight into that place. The gaps that comments leave are closed
//! afterwards. So the points keep the order of the file, whatever the threads did.

use super::row::{Layout, Row};
use crate::{
    error::{Fault, Located, Result},
    feed::Feed,
    lines::{count_lines, first_lines, parts, whole_lines},
};
use trueness_geom::parallel::prelude::*;
use trueness_geom::{cloud::PointStream, space::Point};

/// A thread parses this many bytes at a time, which stay in its cache.
const TABLE_BYTES_PER_TASK: usize = 1 << 18;
/// How many points there should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Limit {
    /// As many as come.
    None,
    /// As many as the file announces: this many at its start, and further ones on lines of their own. More or fewer are
    /// a fault.
    Announced(u64),
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
    /// The first of the rows of nothing but separators that no point has followed yet.
    hollow: Option<u64>,
    /// Bytes looked at for one block.
    window: usize,
}

impl TextPoints {
    /// Points from the rows ahead, the first of which is behind `lines` lines.
    pub fn new(feed: Feed, layout: Layout, lines: u64, limit: Limit, window: usize) -> TextPoints {
        TextPoints {
            feed,
            layout,
            lines,
            limit,
            found: 0,
            hollow: None,
            window: window.clamp(TABLE_BYTES_PER_TASK, 1 << 30),
        }
    }

    /// The file, as far as it has been read.
    pub fn feed(&mut self) -> &mut Feed {
        &mut self.feed
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
            return self.ended().map(|()| false);
        }
        let window = whole_lines(bytes, self.window, self.layout.end)
            .ok_or_else(|| Fault::unexpected("a line of a table", &bytes[..64]).at_line(self.lines + 1))?;
        let window = first_lines(window, left, self.layout.end);
        let length = window.len();
        let parsed = parse(window, &self.layout, self.lines, self.hollow, block)?;
        self.lines += parsed.lines;
        self.hollow = parsed.hollow;
        self.found += block.len() as u64;
        if let Limit::Announced(n) = &mut self.limit {
            *n = n.saturating_add(parsed.announced);
        }
        self.feed.step(length);
        Ok(true)
    }

    /// Whether as many points came as were announced.
    fn ended(&self) -> Result<()> {
        let (what, present) = ("points", self.found);
        match self.limit {
            Limit::Announced(declared) | Limit::Exactly(declared) if present < declared => {
                Err(Fault::Short { what, declared, present }.at_line(self.lines + 1))
            }
            Limit::Announced(declared) if present > declared => {
                Err(Fault::Surplus { what, declared, present }.at_line(self.lines))
            }
            _ => Ok(()),
        }
    }
}

impl PointStream for TextPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        match self.limit {
            Limit::Exactly(n) | Limit::Announced(n) => Some(n),
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

/// The result of the lines of a part, or of a window.
#[derive(Default)]
struct Filled {
    lines: u64,
    points: usize,
    announced: u64,
    /// The first line of those that are hollow and that no point follows.
    hollow: Option<u64>,
}

/// A part, or the line in it and what is wrong there.
type Parsed = std::result::Result<Filled, (u64, Fault)>;

/// Fills `block` with the points of whole lines; `before` lines came before, and perhaps a hollow one.
fn parse(
    window: &[u8],
    layout: &Layout,
    before: u64,
    hollow: Option<u64>,
    block: &mut Vec<Point>,
) -> Result<Filled> {
    let parts = parts(window, TABLE_BYTES_PER_TASK, layout.end);
    let counts: Vec<u64> = parts.par_iter().map(|p| count_lines(p, layout.end)).collect();
    let open = window.last().is_some_and(|b| *b != layout.end);
    let lines = counts.iter().sum::<u64>() + u64::from(open);
    // The old content of the block is overwritten: only growth costs anything.
    block.resize(lines as usize, [0.0; 3]);
    let mut rest = &mut block[..];
    let mut jobs = Vec::with_capacity(parts.len());
    for (i, (part, count)) in parts.iter().zip(&counts).enumerate() {
        let last = i + 1 == parts.len();
        let (mine, later) = rest.split_at_mut(*count as usize + usize::from(last && open));
        rest = later;
        jobs.push((*part, mine));
    }
    let filled: Vec<Parsed> = jobs.into_par_iter().map(|(part, mine)| fill(part, layout, mine)).collect();
    let all = Filled { lines, hollow, ..Filled::default() };
    close_gaps(block, &counts, filled, before, all)
}

/// Parses the lines of a part into `out`, which has room for one point each.
fn fill(part: &[u8], layout: &Layout, out: &mut [Point]) -> Parsed {
    let mut all = Filled::default();
    let mut start = 0;
    while start < part.len() {
        let end = memchr::memchr(layout.end, &part[start..]).map_or(part.len(), |n| start + n);
        all.lines += 1;
        match layout.row(&part[start..end]) {
            Ok(Row::Point(point)) => {
                if let Some(line) = all.hollow {
                    return Err((line, hollow_row()));
                }
                if let Some(slot) = out.get_mut(all.points) {
                    *slot = point;
                    all.points += 1;
                }
            }
            Ok(Row::Nothing) => {}
            Ok(Row::Hollow) => all.hollow = all.hollow.or(Some(all.lines)),
            Ok(Row::Announced(n)) => all.announced = all.announced.saturating_add(n),
            Err(fault) => return Err((all.lines, fault)),
        }
        start = end + 1;
    }
    Ok(all)
}

/// A row of nothing but separators with points behind it: a point is missing there.
fn hollow_row() -> Fault {
    let remedy = "fill the cells or delete the row";
    Fault::Unclear { what: "a row without numbers between others".into(), remedy }
}

/// Moves the points of all parts together, or reports the first fault in the file.
fn close_gaps(
    block: &mut Vec<Point>,
    room: &[u64],
    filled: Vec<Parsed>,
    before: u64,
    mut all: Filled,
) -> Result<Filled> {
    let (mut from, mut to, mut lines) = (0usize, 0usize, before);
    for (room, filled) in room.iter().zip(filled) {
        // A part that holds a fault may hold points before it, and a hollow row may come before all of them.
        let points = filled.as_ref().map_or(true, |part| part.points > 0);
        if let Some(line) = all.hollow.filter(|_| points) {
            return Err(hollow_row().at_line(line));
        }
        let part = filled.map_err(|(line, fault)| fault.at_line(lines + line))?;
        if from != to {
            block.copy_within(from..from + part.points, to);
        }
        all.hollow = all.hollow.or(part.hollow.map(|line| lines + line));
        all.announced = all.announced.saturating_add(part.announced);
        from += *room as usize;
        to += part.points;
        lines += room;
    }
    block.truncate(to);
    all.points = to;
    Ok(all)
}

//! Lines of text, each a record of a scan: parsed by several threads, delivered in the order of the file.

use crate::{
    error::{Fault, Result},
    feed::Feed,
    lines::{first_lines, parts, whole_lines},
};
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::Point;

/// A thread parses this many bytes at a time, which stay in its cache.
const RECORD_BYTES_PER_TASK: usize = 1 << 18;
/// The bytes of a block of points, per point: a usual line.
const USUAL_LINE_BYTES: usize = 32;

/// The lines of a file from some place on.
pub(crate) struct TextRecords {
    feed: Feed,
    /// The byte that ends a line.
    end: u8,
    /// Lines stepped over.
    pub lines: u64,
    /// Bytes looked at for one block.
    window: usize,
}

/// The points of a part, and how many lines and records it has; or a line of it and what is wrong there.
type Parsed = std::result::Result<Part, (u64, Fault)>;

struct Part {
    lines: u64,
    records: u64,
    points: Vec<Point>,
}

impl TextRecords {
    /// The lines ahead, behind `lines` others; blocks of about `block` points.
    pub fn new(feed: Feed, end: u8, lines: u64, block: usize) -> TextRecords {
        let window = block.saturating_mul(USUAL_LINE_BYTES).clamp(RECORD_BYTES_PER_TASK, 1 << 27);
        TextRecords { feed, end, lines, window }
    }

    /// The next line that is not blank; `None` at the end of the file.
    pub fn line(&mut self) -> Result<Option<Vec<u8>>> {
        loop {
            let bytes = self.feed.ahead(RECORD_BYTES_PER_TASK)?;
            if bytes.is_empty() {
                return Ok(None);
            }
            let end = memchr::memchr(self.end, bytes).unwrap_or(bytes.len());
            let line = bytes[..end.min(RECORD_BYTES_PER_TASK)].trim_ascii().to_vec();
            self.feed.step(end + 1);
            self.lines += 1;
            if !line.is_empty() {
                return Ok(Some(line));
            }
        }
    }

    /// Appends the points of some of the next `most` records; `parse` makes of a line its point, if it has one. Gives how many
    /// records were read, 0 at the end of the file. Blank lines are none.
    pub fn points(
        &mut self,
        most: u64,
        parse: impl Fn(&[u8]) -> std::result::Result<Option<Point>, Fault> + Sync,
        out: &mut Vec<Point>,
    ) -> Result<u64> {
        loop {
            let (before, end) = (self.lines, self.end);
            let bytes = self.feed.ahead(self.window)?;
            if bytes.is_empty() || most == 0 {
                return Ok(0);
            }
            let window = whole_lines(bytes, self.window, end)
                .ok_or_else(|| Fault::unexpected("a line of numbers", &bytes[..64]).at_line(before + 1))?;
            let window = first_lines(window, most, end);
            let length = window.len();
            let parts = parts(window, RECORD_BYTES_PER_TASK, end);
            let parsed: Vec<Parsed> = parts.into_par_iter().map(|text| part(text, end, &parse)).collect();
            let mut records = 0;
            for part in parsed {
                let part = part.map_err(|(line, fault)| fault.at_line(self.lines + line))?;
                self.lines += part.lines;
                records += part.records;
                out.extend_from_slice(&part.points);
            }
            self.feed.step(length);
            if records > 0 {
                return Ok(records);
            }
        }
    }

    /// Bytes left in the file, where that is known.
    pub fn left(&self) -> Option<u64> {
        self.feed.left()
    }
}

/// The points of some whole lines.
fn part(text: &[u8], end: u8, parse: &impl Fn(&[u8]) -> std::result::Result<Option<Point>, Fault>) -> Parsed {
    let mut part = Part { lines: 0, records: 0, points: vec![] };
    let mut rest = text;
    while !rest.is_empty() {
        let at = memchr::memchr(end, rest).unwrap_or(rest.len());
        let line = &rest[..at];
        rest = rest.get(at + 1..).unwrap_or_default();
        part.lines += 1;
        if line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        part.records += 1;
        part.points.extend(parse(line).map_err(|fault| (part.lines, fault))?);
    }
    Ok(part)
}

//! Points in rows of bytes, all of the same length.

use crate::{
    error::{Fault, Located, Result},
    feed::Feed,
    scalar::{Order, Scalar},
};
use trueness_geom::parallel::prelude::*;
use trueness_geom::{cloud::PointStream, space::Point};

/// One task reads this many points.
const STRIDED_POINTS_PER_TASK: usize = 1 << 13;

/// Where a coordinate is in a row: offset and type.
pub(crate) type RowField = (usize, Scalar);

/// How the rows are made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows {
    pub order: Order,
    /// Bytes of a row; at least up to the end of each place.
    pub stride: usize,
    pub x: RowField,
    pub y: RowField,
    /// `None` in the plane: z is 0.
    pub z: Option<RowField>,
    /// How many there are.
    pub count: u64,
    /// Their name in messages: one, many.
    pub what: (&'static str, &'static str),
}

impl Rows {
    /// The point of a row, which has `stride` bytes at least.
    #[inline(always)]
    pub fn point(&self, row: &[u8]) -> Point {
        let get = |(at, scalar): RowField| scalar.get(&row[at..], self.order);
        [get(self.x), get(self.y), self.z.map_or(0.0, get)]
    }
}

/// Points of rows.
pub(crate) struct StridedPoints {
    feed: Feed,
    rows: Rows,
    found: u64,
    block: usize,
    /// Rows that were left out because their place is not finite; `None` where such a row is a fault.
    left_out: Option<u64>,
}

impl StridedPoints {
    /// Points of the rows ahead. Refuses at once if it is known that there are fewer than declared.
    pub fn new(feed: Feed, rows: Rows, block: usize) -> Result<StridedPoints> {
        let stride = rows.stride as u64;
        if let Some(left) = feed.left()
            && rows.count.checked_mul(stride).is_none_or(|need| need > left)
        {
            let present = left.checked_div(stride).unwrap_or(0);
            let short = Fault::Short { what: rows.what.1, declared: rows.count, present };
            return Err(short.at_byte(feed.position() + left));
        }
        Ok(StridedPoints { feed, rows, found: 0, block: block.max(1), left_out: None })
    }
    /// Leaves out rows whose place is not finite, and counts them.
    pub fn finite_alone(self) -> StridedPoints {
        StridedPoints { left_out: Some(0), ..self }
    }
    /// Rows left out so far.
    pub fn left_out(&self) -> u64 {
        self.left_out.unwrap_or_default()
    }
    /// Bytes of the file that no row takes up, where its length is known.
    pub fn left_behind(&self) -> Option<u64> {
        let need = (self.rows.count - self.found).checked_mul(self.rows.stride as u64)?;
        self.feed.left()?.checked_sub(need)
    }
    /// The file, as far as it has been read.
    pub fn feed(&mut self) -> &mut Feed {
        &mut self.feed
    }
    /// The file behind the points.
    pub fn into_rest(self) -> Feed {
        self.feed
    }
}

impl PointStream for StridedPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.rows.count)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        loop {
            let rows = self.advance(block)?;
            let Some(left_out) = &mut self.left_out else { return Ok(()) };
            block.retain(is_finite);
            *left_out += (rows - block.len()) as u64;
            if rows == 0 || !block.is_empty() {
                return Ok(());
            }
        }
    }
}

impl StridedPoints {
    /// The points of the next rows; none at their end. Gives how many rows there were.
    fn advance(&mut self, block: &mut Vec<Point>) -> Result<usize> {
        let rows = self.rows;
        let left = usize::try_from(rows.count - self.found).unwrap_or(usize::MAX);
        let wanted = self.block.min(left);
        if wanted == 0 {
            block.clear();
            return Ok(0);
        }
        let at = self.feed.position();
        let bytes = self.feed.ahead(wanted.saturating_mul(rows.stride))?;
        let there = (bytes.len() / rows.stride).min(wanted);
        if there == 0 {
            let short = Fault::Short { what: rows.what.1, declared: rows.count, present: self.found };
            return Err(short.at_byte(at + bytes.len() as u64));
        }
        block.resize(there, [0.0; 3]);
        let bytes = &bytes[..there * rows.stride];
        block
            .par_chunks_mut(STRIDED_POINTS_PER_TASK)
            .zip(bytes.par_chunks(STRIDED_POINTS_PER_TASK * rows.stride))
            .for_each(|(out, bytes)| {
                let bytes = bytes.chunks_exact(rows.stride);
                out.iter_mut().zip(bytes).for_each(|(point, row)| *point = rows.point(row));
            });
        if self.left_out.is_none() {
            finite(block, rows.what.0, self.found)
                .map_err(|(i, fault)| fault.at_byte(at + (i * rows.stride) as u64))?;
        }
        self.feed.step(there * rows.stride);
        self.found += there as u64;
        Ok(there)
    }
}

/// Whether all coordinates are numbers.
pub(crate) fn is_finite(point: &Point) -> bool {
    point.iter().all(|x| x.is_finite())
}

/// Checks that all points of a block are finite, `before` of them having come before. Gives the first that is not.
pub(crate) fn finite(
    block: &[Point],
    what: &'static str,
    before: u64,
) -> std::result::Result<(), (usize, Fault)> {
    // Zero times a number is zero unless the number is not finite.
    let suspect = |part: &[Point]| part.as_flattened().iter().map(|x| x * 0.0).sum::<f64>() != 0.0;
    let Some(chunk) = block.par_chunks(STRIDED_POINTS_PER_TASK).position_first(suspect) else {
        return Ok(());
    };
    match block[chunk * STRIDED_POINTS_PER_TASK..].iter().position(|p| !is_finite(p)) {
        Some(i) => {
            let i = chunk * STRIDED_POINTS_PER_TASK + i;
            Err((i, Fault::NotFinite { what, number: before + i as u64 + 1 }))
        }
        None => Ok(()),
    }
}

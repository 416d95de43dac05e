//! Vertices in bytes that also hold lists: rows of unequal length, read one after the other.

use super::{faces, header::Element};
use crate::{
    error::{Fault, Located, Result},
    feed::Feed,
    formats::strided::{RowField, Rows, finite},
};
use trueness_geom::{cloud::PointStream, space::Point};

/// Points of such rows.
pub(super) struct LoosePoints {
    feed: Feed,
    vertex: Element,
    /// The types of the coordinates; the stride is the least there can be.
    rows: Rows,
    /// Which properties they are.
    xyz: [usize; 3],
    /// Where the properties of a row begin.
    starts: Vec<usize>,
    found: u64,
    block: usize,
}

impl LoosePoints {
    pub fn new(feed: Feed, vertex: Element, rows: Rows, xyz: [usize; 3], block: usize) -> LoosePoints {
        let starts = vec![0; vertex.properties.len()];
        LoosePoints { feed, vertex, rows, xyz, starts, found: 0, block: block.max(1) }
    }
    /// The file, as far as it has been read.
    pub fn feed(&mut self) -> &mut Feed {
        &mut self.feed
    }
    pub fn into_rest(self) -> Feed {
        self.feed
    }
}

impl PointStream for LoosePoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.rows.count)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        block.clear();
        let at = self.feed.position();
        while block.len() < self.block && self.found + (block.len() as u64) < self.rows.count {
            let row = faces::row_length(&mut self.feed, &self.vertex, self.rows.order, &mut self.starts)?;
            let Some(length) = row else {
                let present = self.found + block.len() as u64;
                let short = Fault::Short { what: self.rows.what.1, declared: self.rows.count, present };
                return Err(short.at_byte(self.feed.position()));
            };
            let [x, y, z] = self.xyz.map(|i| self.starts[i]);
            let scalar = |(_, scalar): RowField, at: usize| (at, scalar);
            let z = self.rows.z.map(|field| scalar(field, z));
            let rows = Rows { x: scalar(self.rows.x, x), y: scalar(self.rows.y, y), z, ..self.rows };
            block.push(rows.point(self.feed.ahead(length)?));
            self.feed.step(length);
        }
        finite(block, self.rows.what.0, self.found).map_err(|(_, fault)| fault.at_byte(at))?;
        self.found += block.len() as u64;
        Ok(())
    }
}

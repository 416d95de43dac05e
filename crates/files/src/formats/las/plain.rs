//! Points of records that are not packed.

use super::record::{Layout, Tally};
use crate::{
    error::{Fault, Located, Result},
    feed::Feed,
};
use trueness_geom::parallel::prelude::*;
use trueness_geom::{cloud::PointStream, space::Point};

/// One task reads this many records.
const RECORDS_PER_TASK: usize = 1 << 13;

/// Points of the records ahead.
pub(super) struct PlainPoints {
    feed: Feed,
    layout: Layout,
    declared: u64,
    found: u64,
    block: usize,
    tally: Tally,
}

impl PlainPoints {
    pub fn new(feed: Feed, layout: Layout, declared: u64, block: usize) -> Result<PlainPoints> {
        check_count(declared, layout.length, feed.left())?;
        Ok(PlainPoints { feed, layout, declared, found: 0, block: block.max(1), tally: Tally::default() })
    }
}

impl PointStream for PlainPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.declared)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        let length = self.layout.length;
        let left = usize::try_from(self.declared - self.found).unwrap_or(usize::MAX);
        let wanted = self.block.min(left);
        let at = self.feed.position();
        let bytes = if wanted == 0 { &[] } else { self.feed.ahead(wanted.saturating_mul(length))? };
        let there = (bytes.len() / length).min(wanted);
        if there == 0 && wanted > 0 {
            return Err(Fault::short("points", self.declared, self.found).at_byte(at));
        }
        block.resize(there, [0.0; 3]);
        let layout = &self.layout;
        let tallies: Vec<Tally> = block
            .par_chunks_mut(RECORDS_PER_TASK)
            .zip(bytes[..there * length].par_chunks(RECORDS_PER_TASK * length))
            .map(|(out, records)| {
                let mut tally = Tally::default();
                let records = records.chunks_exact(length);
                out.iter_mut().zip(records).for_each(|(p, record)| *p = layout.point(record, &mut tally));
                tally
            })
            .collect();
        tallies.into_iter().for_each(|tally| self.tally += tally);
        self.feed.step(there * length);
        self.found += there as u64;
        Ok(())
    }
    fn remarks(&self) -> Vec<String> {
        self.tally.remarks()
    }
}

/// Refuses fewer points than declared where their number is known from the bytes.
fn check_count(declared: u64, length: usize, left: Option<u64>) -> Result<()> {
    match left {
        Some(left) if declared.checked_mul(length as u64).is_none_or(|need| need > left) => {
            Err(Fault::short("points", declared, left / length as u64).into())
        }
        _ => Ok(()),
    }
}

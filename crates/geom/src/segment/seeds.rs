//! Where to try next: random pieces, large ones more often, each neighbourhood once.

use super::surface::{NONE, Surface};
use crate::num::random::Random;

/// Draws pieces with a chance that is proportional to their weight.
#[derive(Debug)]
pub(super) struct Seeds {
    pieces: Vec<u32>,
    /// Sum of the weights up to and with each piece.
    sums: Vec<f64>,
}

impl Seeds {
    /// Of the pieces that `open` says yes to.
    pub(super) fn new(surface: &Surface, open: impl Fn(u32) -> bool) -> Seeds {
        let pieces: Vec<u32> = (0..surface.len() as u32).filter(|&p| surface.counts(p) && open(p)).collect();
        let mut sum = 0.0;
        let sums = pieces
            .iter()
            .map(|&p| {
                sum += surface.weights[p as usize];
                sum
            })
            .collect();
        Seeds { pieces, sums }
    }
    /// Whether there is nothing to draw from.
    pub(super) fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }
    /// A piece, or [`NONE`] where there is none.
    pub(super) fn draw(&self, random: &mut Random) -> u32 {
        let Some(&total) = self.sums.last() else { return NONE };
        let at = random.unit() * total;
        let index = self.sums.partition_point(|&s| s <= at);
        self.pieces.get(index).or(self.pieces.last()).copied().unwrap_or(NONE)
    }
}

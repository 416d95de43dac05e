//! Where to try next: random pieces, large ones more often, each neighborhood once.

use super::pieces::{NO_PIECE, PieceGraph};
use crate::num::random::Random;

/// Draws pieces with a chance that is proportional to their weight.
#[derive(Debug)]
pub(super) struct Seeds {
    pieces: Vec<u32>,
    /// Sum of the weights up to and with each piece.
    sums: Vec<f64>,
}

impl Seeds {
    /// The seeds among the pieces that `open` says yes to.
    pub(super) fn new(surface: &PieceGraph, open: impl Fn(u32) -> bool) -> Seeds {
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
    /// A piece, or [`NO_PIECE`] where there is none.
    pub(super) fn draw(&self, random: &mut Random) -> u32 {
        let Some(&total) = self.sums.last() else { return NO_PIECE };
        let at = random.unit() * total;
        let index = self.sums.partition_point(|&s| s <= at);
        self.pieces.get(index).or(self.pieces.last()).copied().unwrap_or(NO_PIECE)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{facets, tests::parts::bored};
    use super::*;

    /// In 20,000 draws each face gets its share of the area, within four standard deviations.
    #[test]
    fn faces_are_drawn_as_often_as_they_are_large() {
        const DRAWS: u64 = 20_000;
        let part = bored(32);
        let surface = facets::surface(&part.mesh);
        let seeds = Seeds::new(&surface, |p| part.labels[p as usize] != 2);
        let (mut drawn, mut area) = (vec![0.0; part.faces.len()], vec![0.0; part.faces.len()]);
        for k in 0..DRAWS {
            drawn[part.labels[seeds.draw(&mut Random::stream(3, k)) as usize]] += 1.0;
        }
        for (label, weight) in part.labels.iter().zip(&surface.weights).filter(|(label, _)| **label != 2) {
            area[*label] += weight;
        }
        let total: f64 = area.iter().sum();
        for (drawn, area) in drawn.iter().zip(&area) {
            let (share, count) = (area / total, DRAWS as f64);
            assert!((drawn - share * count).abs() <= 4.0 * (share * (1.0 - share) * count).sqrt());
        }
    }
}

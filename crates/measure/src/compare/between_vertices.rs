//! What a measured mesh says between its vertices: a facet across a bore that was not made has its corners on the part.

use super::worst::WorstPoint;
use trueness_document::tolerance::badness;
use trueness_geom::space::Point;

/// Places on large facets of a measured mesh, and those of them that are out of tolerance.
#[derive(Clone, Copy, Debug, Default)]
pub struct BetweenVertices {
    /// Places that count.
    pub count: u64,
    /// Those out of tolerance.
    pub beyond: u64,
    /// The worst of these.
    pub worst: Option<WorstPoint>,
}

impl BetweenVertices {
    /// Takes a place with its deviation, and what that may be: anything without a zone.
    pub fn add(&mut self, point: Point, deviation: f64, zone: Option<[f64; 2]>) {
        let index = self.count;
        self.count += 1;
        let Some([lower, upper]) = zone else { return };
        if (lower..=upper).contains(&deviation) {
            return;
        }
        self.beyond += 1;
        let badness = badness(deviation, zone);
        if self.worst.is_none_or(|w| badness > w.badness) {
            self.worst = Some(WorstPoint { index, point, deviation, badness, region: 0 });
        }
    }
}

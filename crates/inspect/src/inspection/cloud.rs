//! The places of a measured cloud.

use trueness_geom::feature::farthest_covered;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::Point;
use trueness_geom::spatial::neighbors::PointTree;

/// The places of a cloud: copies of a point tell nothing new.
pub(super) struct Cloud {
    /// Their numbers in the cloud, ascending; of copies the first.
    numbers: Vec<u32>,
    /// How far at most one of them covers a feature, mm.
    pub farthest: f64,
}

impl Cloud {
    pub fn new(points: &[Point]) -> Cloud {
        // Minus zero is zero.
        let key = |n: &u32| points[*n as usize].map(|x| (x + 0.0).to_bits());
        let mut numbers: Vec<u32> = (0..points.len() as u32).collect();
        numbers.par_sort_unstable_by_key(|n| (key(n), *n));
        numbers.dedup_by_key(|n| key(n));
        numbers.sort_unstable();
        let places: Vec<Point> = numbers.iter().map(|n| points[*n as usize]).collect();
        Cloud { farthest: farthest_covered(&places, &PointTree::new(&places)), numbers }
    }

    /// Whether a point of the cloud is the first of its place.
    pub fn is_first(&self, number: u32) -> bool {
        self.numbers.binary_search(&number).is_ok()
    }
}

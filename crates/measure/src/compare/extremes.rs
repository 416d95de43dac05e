//! The lowest and the highest deviation of all that count, with their points.

use trueness_geom::space::Point;

/// A measured point with its deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// Number of the point, from 0 in file order.
    pub index: u64,
    /// The point, millimeters.
    pub point: Point,
    /// Its deviation, millimeters.
    pub deviation: f64,
}

/// Lowest and highest so far; of equal ones the first in the file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extremes {
    /// The lowest deviation.
    pub lowest: Option<Extreme>,
    /// The highest one.
    pub highest: Option<Extreme>,
}

impl Extremes {
    /// Takes a block of points whose first has number `start`. A deviation that is none is passed over.
    pub fn add(&mut self, start: u64, points: &[Point], deviations: &[f64]) {
        for ((index, point), &deviation) in (start..).zip(points).zip(deviations) {
            if !deviation.is_finite() {
                continue;
            }
            let here = Extreme { index, point: *point, deviation };
            if self.lowest.is_none_or(|l| deviation < l.deviation) {
                self.lowest = Some(here);
            }
            if self.highest.is_none_or(|h| deviation > h.deviation) {
                self.highest = Some(here);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_equal_ones_over_blocks() {
        let points: Vec<Point> = (0..6).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        let mut all = Extremes::default();
        all.add(0, &points[..3], &[f64::NAN, 0.2, 0.5]);
        all.add(3, &points[3..], &[0.5, f64::INFINITY, 0.2]);
        let found = [all.lowest, all.highest].map(|e| e.map(|e| (e.index, e.point[0], e.deviation)));
        assert_eq!(found, [Some((1, 1.0, 0.2)), Some((2, 2.0, 0.5))]);
    }
}

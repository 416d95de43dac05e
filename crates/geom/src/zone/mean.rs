//! Means of points.

use crate::space::{Point, minus, plus, times};

/// Mean of the points, summed from the first one so that no digit is lost far from the origin.
pub fn mean(points: &[Point]) -> Point {
    let Some(&first) = points.first() else { return [0.0; 3] };
    let sum = points.iter().fold([0.0; 3], |s, p| plus(s, minus(*p, first)));
    plus(first, times(1.0 / points.len() as f64, sum))
}

//! The points of a fit, checked once, with the center and scale that take size and position out of it.

use super::FitError;
use crate::num::random::GOLDEN_STEP;
use crate::simd::widest::widest;
use crate::space::{Aabb, Point, Vector, minus, plus, times};
use std::borrow::Cow;

/// Points, and the unit frame they are seen in. The middle of their box is its origin, and half the longest side of the box is
/// between 1/2 and 1 long. The scale is a power of two, so that nothing is rounded by it.
#[derive(Clone, Debug)]
pub(super) struct Sample<'a> {
    pub points: Cow<'a, [Point]>,
    pub center: Point,
    pub scale: f64,
    /// Mean of all points, in the unit frame: elements without an end are reported with their origin at its foot. A part of the sample
    /// keeps the mean of the whole.
    pub station: Point,
}

impl<'a> Sample<'a> {
    /// Looks at all points once: errors if one is not finite or all are equal.
    pub(super) fn new(points: &'a [Point]) -> Result<Sample<'a>, FitError> {
        let bounds = bounds(points);
        let Some(bounds) = bounds else {
            let index = points.iter().position(|p| p.iter().any(|x| !x.is_finite())).unwrap_or(0);
            return Err(FitError::NotFinite { index });
        };
        let half = times(0.5, minus(times(0.5, bounds.max), times(0.5, bounds.min)));
        let reach = 2.0 * half[0].max(half[1]).max(half[2]);
        if reach == 0.0 {
            return Err(FitError::AllEqual);
        }
        let center = plus(times(0.5, bounds.min), times(0.5, bounds.max));
        // 2^1000 and more would overflow when squared on the way back; such sizes are no parts.
        let scale = libm::exp2((-libm::log2(reach).ceil()).clamp(-1000.0, 1000.0));
        let mut sample = Sample { points: Cow::Borrowed(points), center, scale, station: [0.0; 3] };
        sample.station = sample.mean();
        Ok(sample)
    }
    /// Number of points.
    pub(super) fn len(&self) -> usize {
        self.points.len()
    }
    /// `p` in the unit frame.
    pub(super) fn unit(&self, p: Point) -> Point {
        times(self.scale, minus(p, self.center))
    }
    /// A place of the unit frame in the frame of the points.
    pub(super) fn place(&self, p: Point) -> Point {
        plus(self.center, times(1.0 / self.scale, p))
    }
    /// All points in the unit frame.
    pub(super) fn units(&self) -> impl Iterator<Item = Point> {
        self.points.iter().map(|&p| self.unit(p))
    }
    /// At most `count` of the points, spread over the whole list.
    ///
    /// They are taken at multiples of the golden section. A fixed stride would pick one and the same column of a grid of
    /// points, or one generator of a cylinder measured ring by ring.
    pub(super) fn thinned(&self, count: usize) -> Sample<'_> {
        if self.len() <= count {
            return self.with(Cow::Borrowed(&self.points));
        }
        self.with(Cow::Owned(self.spread(count).map(|k| self.points[k]).collect()))
    }
    /// Other points in the same frame.
    pub(super) fn with<'b>(&self, points: Cow<'b, [Point]>) -> Sample<'b> {
        Sample { points, center: self.center, scale: self.scale, station: self.station }
    }
    /// The mean of the points, in the unit frame; the same for any number of threads.
    fn mean(&self) -> Point {
        use crate::parallel::prelude::*;
        let sum = |part: &[Point]| part.iter().fold([0.0; 3], |s, &p| plus(s, self.unit(p)));
        let total = match self.len() <= POINTS_PER_SAMPLE_TASK {
            true => sum(&self.points),
            false => {
                let parts: Vec<Point> = self.points.par_chunks(POINTS_PER_SAMPLE_TASK).map(sum).collect();
                parts.into_iter().fold([0.0; 3], plus)
            }
        };
        times(1.0 / self.len() as f64, total)
    }
    /// Indices of at most `count` points, as [`Sample::thinned`] takes them.
    pub(super) fn spread(&self, count: usize) -> impl Iterator<Item = usize> {
        let all = self.len();
        let turn = |k: usize| u128::from((k as u64).wrapping_mul(GOLDEN_STEP));
        let pick = move |k: usize| ((turn(k) * all as u128) >> 64) as usize;
        (0..count.min(all)).map(move |k| if all <= count { k } else { pick(k) })
    }
}

/// Points of one task.
const POINTS_PER_SAMPLE_TASK: usize = 1 << 16;

/// The box of the points, or `None` if a coordinate is not finite.
fn bounds(points: &[Point]) -> Option<Aabb> {
    use crate::parallel::prelude::*;
    if points.len() <= POINTS_PER_SAMPLE_TASK {
        return block_bounds(points);
    }
    points
        .par_chunks(POINTS_PER_SAMPLE_TASK)
        .map(block_bounds)
        .reduce(|| Some(Aabb::EMPTY), |a, b| Some(a?.union(&b?)))
}

widest! {
    fn block_bounds [] [] (points: &[Point]) -> Option<Aabb> = bounds_in(points)
}

#[inline(always)]
fn bounds_in(points: &[Point]) -> Option<Aabb> {
    /// Coordinates side by side: those of 8 points.
    const COORDINATES_AT_ONCE: usize = 24;
    // Minima pass over NaN; a sum of zeros does not.
    let (mut zeros, mut low, mut high) = (
        [0.0; COORDINATES_AT_ONCE],
        [f64::INFINITY; COORDINATES_AT_ONCE],
        [f64::NEG_INFINITY; COORDINATES_AT_ONCE],
    );
    let (parts, _) = points.as_flattened().as_chunks::<COORDINATES_AT_ONCE>();
    for part in parts {
        for l in 0..COORDINATES_AT_ONCE {
            let x = part[l];
            zeros[l] += x * 0.0;
            low[l] = if x < low[l] { x } else { low[l] };
            high[l] = if x > high[l] { x } else { high[l] };
        }
    }
    let rest = &points[COORDINATES_AT_ONCE / 3 * parts.len()..];
    let mut bounds = Aabb::of(rest);
    for l in 0..COORDINATES_AT_ONCE {
        bounds.min[l % 3] = bounds.min[l % 3].min(low[l]);
        bounds.max[l % 3] = bounds.max[l % 3].max(high[l]);
    }
    let zero = zeros.iter().sum::<f64>() + rest.as_flattened().iter().map(|x| x * 0.0).sum::<f64>();
    (zero == 0.0).then_some(bounds)
}

/// Middle of two directions' or places' span, a helper of starts that work on unit coordinates.
pub(super) fn mean(points: &[Point]) -> Vector {
    let sum = points.iter().fold([0.0; 3], |s, &p| plus(s, p));
    times(1.0 / points.len() as f64, sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_is_that_of_a_plain_loop() {
        for n in [1usize, 3, 4, 5, 17, 1000] {
            let points: Vec<Point> =
                (0..n).map(|k| [(k as f64).sin(), 3.0 * (k as f64).cos(), 0.1 * k as f64 - 7.0]).collect();
            assert_eq!(bounds(&points), Some(Aabb::of(&points)));
        }
    }

    #[test]
    fn a_bad_coordinate_is_named() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut points = vec![[1.0, 2.0, 3.0]; 30];
            points[5][0] = 2.0;
            points[17][1] = bad;
            assert_eq!(Sample::new(&points).unwrap_err(), FitError::NotFinite { index: 17 });
        }
        assert_eq!(Sample::new(&[[1.0, 2.0, 3.0]; 9]).unwrap_err(), FitError::AllEqual);
    }

    #[test]
    fn thinning_a_grid_keeps_its_columns_apart() {
        let points: Vec<Point> = (0..10_000).map(|k| [f64::from(k % 100), f64::from(k / 100), 0.0]).collect();
        let sample = Sample::new(&points).unwrap();
        let thin = sample.thinned(200);
        let mut columns: Vec<u64> = thin.points.iter().map(|p| p[0] as u64).collect();
        columns.sort_unstable();
        columns.dedup();
        assert!(columns.len() > 80, "{}", columns.len());
    }
}

//! Global sizes of two opposite planes.

use super::datum::Freedom;
use super::error::ZoneError;
use super::motion::{Search, placed};
use super::planes::parallel_planes;
use crate::fit::Method;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, least_axis};

/// Two parallel planes at the size of two opposite features.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opposite {
    /// Common unit normal, from the first to the second.
    pub normal: Vector,
    /// Their distance, mm; below 0 where the points of the first lie beyond those of the second (inscribed only).
    pub distance: f64,
}

/// The size of two opposite planes from their points (mm), by ISO 14405-1:2016, 3.7: the distance of the two parallel planes
///
/// - with the least sum of squares (`Gaussian`, GG; also for `Robust`, of which there is no size);
/// - that are the nearest with all points between them (`MinimumCircumscribed`, GN);
/// - that are the farthest with all points outside of them (`MaximumInscribed`, GX): the first plane's points on one side, the
///   second's on the other;
/// - with the least greatest distance of the points from their own plane (`MinimumZone`, GC).
///
/// All but the first are sought from the least-squares attitude: the search is local in the tilt. Cost: linear in the points,
/// two to five passes.
///
/// # Errors
/// [`ZoneError::NoPlanes`] where the points determine no direction (see [`parallel_planes`]), a coordinate that is no number, a search that does not
/// settle, [`ZoneError::Cancelled`].
///
/// ```
/// use trueness_geom::{fit::Method, progress::Silent, zone::opposite_planes};
/// // A floor, and a roof with a dent of 0.25: the inscribed pair is that much nearer.
/// let floor = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [9.0, 9.0, 0.0]];
/// let mut roof = floor.map(|[x, y, _]| [x, y, 5.0]).to_vec();
/// roof.push([4.5, 4.5, 4.75]);
/// let size = |method| opposite_planes(&floor, &roof, method, &Silent).map(|o| o.distance);
/// assert!((size(Method::MinimumCircumscribed)? - 5.0).abs() < 1e-12);
/// assert!((size(Method::MaximumInscribed)? - 4.75).abs() < 1e-12);
/// # Ok::<(), trueness_geom::zone::ZoneError>(())
/// ```
pub fn opposite_planes(
    first: &[Point],
    second: &[Point],
    method: Method,
    progress: &dyn Progress,
) -> Result<Opposite, ZoneError> {
    let Some((normal, distance)) = parallel_planes(first, second) else {
        return Err(ZoneError::NoPlanes);
    };
    let points: Vec<Point> = first.iter().chain(second).copied().collect();
    let start = Rigid::into_frame(points[0], normal, least_axis(normal)).ok_or(ZoneError::NoPlanes)?;
    // Out of the space between the planes is above 0, for the inscribed pair into it.
    let inscribed = method == Method::MaximumInscribed;
    let height = |i: usize, p: Point| {
        let s = if (i < first.len()) == inscribed { 1.0 } else { -1.0 };
        Some((s * p[2], [0.0, 0.0, s]))
    };
    let free = Freedom { shift: [false, false, true], turn: [true, true, false] };
    let touching = Search { start, free, middle: 0.0, floating: false, outer: true };
    let zone = Search { middle: 0.5 * distance, floating: true, outer: false, ..touching };
    let found = |search| placed(&points, &height, search, progress);
    let (motion, distance) = match method {
        Method::Gaussian | Method::Robust => return Ok(Opposite { normal, distance }),
        Method::MinimumCircumscribed => found(&touching).map(|found| (found.motion, 2.0 * found.half))?,
        Method::MaximumInscribed => found(&touching).map(|found| (found.motion, -2.0 * found.half))?,
        // The least and the greatest height are as far from the middle, which is half the distance.
        Method::MinimumZone => found(&zone).map(|found| (found.motion, found.min.0 + found.max.0))?,
    };
    Ok(Opposite { normal: motion.inverse().vector([0.0, 0.0, 1.0]), distance })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::num::random::Random;
    use crate::progress::Silent;
    use crate::space::dot;

    const METHODS: [Method; 3] =
        [Method::MinimumCircumscribed, Method::MaximumInscribed, Method::MinimumZone];

    /// Two rough planes, 7 mm apart, each with its own dents.
    fn rough(seed: u64) -> (Vec<Point>, Vec<Point>) {
        let mut random = Random::new(seed);
        let mut side = |z: f64| -> Vec<Point> {
            let mut place =
                || [20.0 * random.unit() - 10.0, 12.0 * random.unit() - 6.0, z + 0.1 * random.unit()];
            (0..40).map(|_| place()).collect()
        };
        (side(0.0), side(7.0))
    }

    /// The measure of a pair with this normal. It is the least (greatest) distance of planes that hold all (no) points between
    /// them. For the minimax pair it is the greatest distance from the own plane.
    fn asked(first: &[Point], second: &[Point], n: Vector, method: Method) -> f64 {
        let range = |points: &[Point]| {
            let h = points.iter().map(|p| dot(*p, n));
            (h.clone().fold(f64::INFINITY, f64::min), h.fold(f64::NEG_INFINITY, f64::max))
        };
        let ((a, b), (c, d)) = (range(first), range(second));
        match method {
            Method::MinimumCircumscribed => d - a,
            Method::MaximumInscribed => b - c,
            _ => 0.5 * (b - a).max(d - c),
        }
    }

    /// Many normals near the one found are tried: none is better, and the distance is that of its normal.
    #[test]
    fn no_pair_nearby_is_better() {
        for seed in 0..20 {
            let (first, second) = rough(seed);
            let mut random = Random::new(seed + 100);
            for method in METHODS {
                let found = opposite_planes(&first, &second, method, &Silent).unwrap();
                let best = asked(&first, &second, found.normal, method);
                match method {
                    Method::MinimumCircumscribed => assert!((found.distance - best).abs() < 1e-12),
                    Method::MaximumInscribed => assert!((found.distance + best).abs() < 1e-12),
                    _ => {}
                }
                for k in 0..3000 {
                    let reach = [1e-1, 1e-3, 1e-5][k % 3];
                    let mut off = || reach * (2.0 * random.unit() - 1.0);
                    let n = crate::space::plus(found.normal, [off(), off(), off()]);
                    let n = crate::space::times(1.0 / crate::space::norm(n), n);
                    assert!(asked(&first, &second, n, method) >= best - 1e-12, "{method:?} {seed}");
                }
            }
        }
    }

    /// The minimax pair is halfway between the ranges of both sides.
    #[test]
    fn the_minimax_pair_has_the_same_greatest_distance_on_both_sides() {
        let floor = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [9.0, 9.0, 0.0], [4.0, 4.0, 0.2]];
        let roof = [[0.0, 0.0, 5.0], [9.0, 0.0, 5.0], [0.0, 9.0, 5.0], [9.0, 9.0, 5.0], [4.0, 4.0, 5.2]];
        let found = opposite_planes(&floor, &roof, Method::MinimumZone, &Silent).unwrap();
        assert!((found.distance - 5.0).abs() < 1e-12, "{}", found.distance);
        let outer = opposite_planes(&floor, &roof, Method::MinimumCircumscribed, &Silent).unwrap();
        let inner = opposite_planes(&floor, &roof, Method::MaximumInscribed, &Silent).unwrap();
        assert!(outer.distance > 5.19 && inner.distance < 4.81);
    }
}

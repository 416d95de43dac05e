//! The narrowest pair of parallel planes, of a given attitude, that holds all points.

use super::azimuth::Cone;
use super::error::{ZoneError, sane};
use super::mean::mean;
use crate::space::{Point, Vector, dot, minus, unit};

/// Two parallel planes that hold points between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// Unit normal of both.
    pub normal: Vector,
    /// Their distance, millimeters.
    pub width: f64,
    /// The first point on the lower plane.
    pub low: usize,
    /// The first point on the upper plane.
    pub high: usize,
}

/// The planes across `normal` that hold `points` (mm): orientation and run-out zones whose datum leaves nothing free.
/// One pass over the points.
///
/// # Errors
/// No points, a coordinate that is no number, a normal without length.
///
/// ```
/// let points = [[0.0, 0.0, 1.0], [5.0, 0.0, 1.5], [0.0, 7.0, 0.75]];
/// let slab = trueness_geom::zone::slab(&points, [0.0, 0.0, 2.0])?;
/// assert_eq!((slab.width, slab.low, slab.high), (0.75, 2, 1));
/// # Ok::<(), trueness_geom::zone::ZoneError>(())
/// ```
pub fn slab(points: &[Point], normal: Vector) -> Result<Slab, ZoneError> {
    sane(points)?;
    let (normal, _) = unit(normal).ok_or(ZoneError::NoDirection)?;
    Ok(across(points, normal))
}

/// The same for a unit normal and points that are there. Heights are taken from the first point: far from the origin no
/// digit of the width is lost.
fn across(points: &[Point], normal: Vector) -> Slab {
    let (mut low, mut high) = ((0.0, 0), (0.0, 0));
    for (index, p) in points.iter().enumerate() {
        let height = dot(minus(*p, points[0]), normal);
        if height < low.0 {
            low = (height, index);
        }
        if height > high.0 {
            high = (height, index);
        }
    }
    Slab { normal, width: high.0 - low.0, low: low.1, high: high.1 }
}

/// Points up to which all are searched at once.
const MAX_POINTS_AT_ONCE: usize = 4096;
/// Points of the first working set, where there are more.
const SPREAD_POINTS: usize = 512;

/// The narrowest planes whose normal stands at `angle` (radians, 0 to π/2) to `axis` and is free to turn about it. They are
/// zones of perpendicularity and angularity to a single datum, which holds the zone in its angle alone (ISO 1101:2017, 17.11
/// and 17.12).
///
/// The least over the whole turn, to rounding. Some thousand passes over a working set, and one over all points for each of
/// a few rounds of exchange.
///
/// # Errors
/// No points, a coordinate that is no number, an axis without length.
///
/// ```
/// // A wall that leans by 0.1 towards its top; turning about the vertical cannot mend that.
/// let wall = [[0.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.1, 0.0, 20.0], [0.1, 9.0, 20.0]];
/// let zone = trueness_geom::zone::slab_at_angle(&wall, [0.0, 0.0, 1.0], std::f64::consts::FRAC_PI_2)?;
/// assert!((zone.width - 0.1).abs() < 1e-14);
/// # Ok::<(), trueness_geom::zone::ZoneError>(())
/// ```
pub fn slab_at_angle(points: &[Point], axis: Vector, angle: f64) -> Result<Slab, ZoneError> {
    sane(points)?;
    if angle == 0.0 {
        return slab(points, axis);
    }
    let cone = Cone::about(axis, angle).ok_or(ZoneError::NoDirection)?;
    let pick = |index: &usize| points[*index];
    let stride = if points.len() <= MAX_POINTS_AT_ONCE { 1 } else { points.len() / SPREAD_POINTS };
    let mut working: Vec<Point> = points.iter().step_by(stride).copied().collect();
    // Each round takes in the two points that stick out most; the working set's least is a lower bound of all points'.
    loop {
        let phi = cone.least(|normal| across(&working, normal).width);
        let normal = cone.direction(phi);
        let (all, held) = (across(points, normal), across(&working, normal));
        if all.width <= held.width {
            return Ok(all);
        }
        let before = working.len();
        for place in [all.low, all.high].iter().map(pick) {
            if !working.contains(&place) {
                working.push(place);
            }
        }
        if working.len() == before {
            // Rounding of the heights about another first point.
            return Ok(all);
        }
    }
}

/// The two parallel planes with the least sum of squared distances, each from its own points (mm). Returns their common unit
/// normal, from the first to the second, and their distance. `None` where the points determine no direction: fewer than two
/// points more than planes and directions, or all in one line.
///
/// ```
/// let floor = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0]];
/// let roof = floor.map(|[x, y, _]| [x, y, 5.0]);
/// let (normal, distance) = trueness_geom::zone::parallel_planes(&floor, &roof).unwrap();
/// assert!((distance - 5.0).abs() < 1e-14 && (normal[2] - 1.0).abs() < 1e-14);
/// ```
pub fn parallel_planes(first: &[Point], second: &[Point]) -> Option<(Vector, f64)> {
    if first.is_empty() || second.is_empty() || first.len() + second.len() < 4 {
        return None;
    }
    let middles = [mean(first), mean(second)];
    let mut scatter = [[0.0; 3]; 3];
    for (points, middle) in [first, second].into_iter().zip(middles) {
        for p in points {
            let q = minus(*p, middle);
            for (i, row) in scatter.iter_mut().enumerate() {
                for (j, x) in row.iter_mut().enumerate() {
                    *x += q[i] * q[j];
                }
            }
        }
    }
    let (moments, axes) = crate::num::dense::eigen(scatter);
    // Points along one line: the middle moment is rounding as the least one is.
    if moments[1] <= 1e-12 * moments[2] {
        return None;
    }
    let (normal, _) = unit(axes[0])?;
    let distance = dot(minus(middles[1], middles[0]), normal);
    let normal = if distance < 0.0 { normal.map(|x| -x) } else { normal };
    Some((normal, distance.abs()))
}

//! Radius of curvature at the edge of a profile, from the measured points around it.

use super::ends::distance;
use super::error::AirfoilError;

/// What a radius of an edge is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeRadius {
    /// Radius of curvature there.
    pub radius: f64,
    /// Its standard uncertainty, from the scatter of the points about the local curve; 0 where they lie on it.
    pub uncertainty: f64,
    /// Points that tell it.
    pub count: usize,
}

/// Fewest points.
const FEWEST: usize = 7;
/// Unknowns of the local curve.
const UNKNOWNS: usize = 5;
/// The points lie within this share of the radius to either side: a turn of about 40 degrees each.
const REACH: f64 = 0.65;

/// The radius of the points of `row` at `place`, an end of the chord whose other end is `from`.
///
/// With `x` along the chord into the profile and `y` across, from the place, `x = a + b y + q (k + l y + m y²)` for `q = x² + y²`
/// is fitted to the points near it: exact for circles, where `k` is half the curvature, and nearly so for the ends of ellipses,
/// parabolas and profiles. The reach follows from the radius found.
pub(super) fn radius(row: &[[f64; 2]], place: [f64; 2], from: [f64; 2]) -> Result<EdgeRadius, AirfoilError> {
    let chord = distance(place, from);
    let inward = [(from[0] - place[0]) / chord, (from[1] - place[1]) / chord];
    let local = |p: &[f64; 2]| {
        let d = [p[0] - place[0], p[1] - place[1]];
        [d[0] * inward[0] + d[1] * inward[1], inward[0] * d[1] - inward[1] * d[0]]
    };
    let mut near: Vec<[f64; 2]> = row.iter().map(local).filter(|p| p[0] < 0.25 * chord).collect();
    near.sort_by(|p, q| libm::hypot(p[0], p[1]).total_cmp(&libm::hypot(q[0], q[1])));
    if near.len() < FEWEST {
        return Err(AirfoilError::FewAround { found: near.len() });
    }
    // Points whose foot is beyond the reach are left out by their distance: a chord of a circle.
    let mut count = near.len().min(FEWEST.max(near.len() / 8));
    let mut found = fit(&near[..count])?;
    for _ in 0..8 {
        let reach = REACH * found.radius;
        let next = near.partition_point(|p| libm::hypot(p[0], p[1]) < reach).max(FEWEST);
        if next == count {
            break;
        }
        count = next;
        found = fit(&near[..count])?;
    }
    Ok(found)
}

/// The radius by least squares of the deviations along `x`.
fn fit(points: &[[f64; 2]]) -> Result<EdgeRadius, AirfoilError> {
    let n = points.len();
    let size = points.iter().map(|p| libm::hypot(p[0], p[1])).fold(0.0, f64::max);
    let row = |p: &[f64; 2]| {
        let (x, y) = (p[0] / size, p[1] / size);
        let q = x * x + y * y;
        ([1.0, y, q, q * y, q * y * y], x)
    };
    // Orthogonal columns (Gram and Schmidt, twice); the third coefficient is told from the last two by taking it last.
    const ORDER: [usize; UNKNOWNS] = [0, 1, 3, 4, 2];
    let mut columns: Vec<Vec<f64>> = vec![];
    let mut rest: Vec<f64> = points.iter().map(|p| row(p).1).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let (mut curvature, mut unit) = (0.0, 0.0);
    for k in ORDER {
        let mut column: Vec<f64> = points.iter().map(|p| row(p).0[k]).collect();
        for before in columns.iter().chain(&columns) {
            let w = dot(&column, before);
            column.iter_mut().zip(before).for_each(|(c, b)| *c -= w * b);
        }
        let norm = dot(&column, &column).sqrt();
        if norm < 1e-9 {
            return Err(AirfoilError::Flat);
        }
        column.iter_mut().for_each(|c| *c /= norm);
        let w = dot(&rest, &column);
        rest.iter_mut().zip(&column).for_each(|(r, c)| *r -= w * c);
        (curvature, unit) = (2.0 * w / norm, 2.0 / norm);
        columns.push(column);
    }
    if curvature.is_nan() || curvature <= 0.0 {
        return Err(AirfoilError::Flat);
    }
    let variance = dot(&rest, &rest) / (n - UNKNOWNS) as f64;
    let radius = size / curvature;
    Ok(EdgeRadius { radius, uncertainty: radius * unit * variance.sqrt() / curvature, count: n })
}

//! Radius of curvature at the edge of a profile, from the measured points around it.

use super::error::AirfoilError;
use crate::model::flat::distance;

/// The source of the radius of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeRadius {
    /// Radius of curvature there.
    pub radius: f64,
    /// Its standard uncertainty, from the scatter of the points about the local curve; 0 where they lie on it.
    pub uncertainty: f64,
    /// Points that tell it.
    pub count: usize,
}

/// Fewest points of a reach.
const MIN_POINTS_OF_EDGE: usize = 7;
/// They grow by this factor from reach to reach.
const REACH_GROWTH: f64 = 1.25;
/// Unknowns of the local curve.
const LOCAL_CURVE_UNKNOWNS: usize = 5;
/// Points belong to the edge within this share of the chord along it.
const EDGE_CHORD_SHARE: f64 = 0.25;
/// Curvatures agree within so many standard uncertainties of that of the smaller reach.
const AGREEING_SIGMAS: f64 = 2.5;
/// A curvature below so many standard uncertainties is none.
const MIN_CURVATURE_SIGMAS: f64 = 2.0;
/// The scatter counts as much as in a reach of so much fewer points, within which the bend may change unseen.
const SMALLER_REACH_SHARE: f64 = 0.7;

/// The radius of the points of `row` at `place`, an end of the chord whose other end is `from`.
///
/// The curve `x = a + b y + q (k + l y + m y²)` for `q = x² + y²` is fitted to the points near the place.
/// `x` goes along the chord into the profile and `y` across, from the place. It is exact for circles, where
/// `k` is half the curvature, and nearly so for the ends of ellipses, parabolas and profiles. The more points, the less their scatter `noise`
/// counts, and the more how the bend changes. The widest reach is chosen whose curvature agrees with that of all
/// smaller ones. (Lepskii, On a problem of adaptive estimation in Gaussian white noise, 1990). How far that of the
/// reach beside it differs is part of the uncertainty.
pub(super) fn radius(
    row: &[[f64; 2]],
    place: [f64; 2],
    from: [f64; 2],
    noise: f64,
) -> Result<EdgeRadius, AirfoilError> {
    let chord = distance(place, from);
    let inward = [(from[0] - place[0]) / chord, (from[1] - place[1]) / chord];
    let local = |p: &[f64; 2]| {
        let d = [p[0] - place[0], p[1] - place[1]];
        [d[0] * inward[0] + d[1] * inward[1], inward[0] * d[1] - inward[1] * d[0]]
    };
    let mut near: Vec<[f64; 2]> = row.iter().map(local).filter(|p| p[0] < EDGE_CHORD_SHARE * chord).collect();
    near.sort_by(|p, q| libm::hypot(p[0], p[1]).total_cmp(&libm::hypot(q[0], q[1])));
    if near.len() < MIN_POINTS_OF_EDGE {
        return Err(AirfoilError::FewAround { found: near.len() });
    }
    let (mut all, mut count): (Vec<Bend>, usize) = (vec![], MIN_POINTS_OF_EDGE);
    // One that disagrees may do so by chance, two in succession do not.
    let mut other: Option<Bend> = None;
    while let Some(bend) = fit(&near[..count], noise) {
        // A bend that is not known to be one refutes none but by far.
        let within = |b: &Bend| {
            if b.curvature.abs() < MIN_CURVATURE_SIGMAS * b.uncertainty {
                2.0 * AGREEING_SIGMAS
            } else {
                AGREEING_SIGMAS
            }
        };
        let agrees = |b: &Bend| (b.curvature - bend.curvature).abs() <= within(b) * b.uncertainty;
        let is_other = !all.iter().all(agrees);
        if is_other && other.is_some() {
            break;
        }
        if is_other {
            other = Some(bend);
        } else {
            other = None;
            all.push(bend);
        }
        if count == near.len() {
            break;
        }
        count = ((count as f64 * REACH_GROWTH).ceil() as usize).min(near.len());
    }
    all.splice(0..0, other);
    let [.., best] = all[..] else { return Err(AirfoilError::Flat) };
    // A change with the square of the reach is as large as this makes it from one reach to the next. The one that
    // disagrees was put first. Within its uncertainty a smaller reach agrees with a bend that changes, too.
    let previous = if all.len() > 2 { all[all.len() - 2] } else { all[0] };
    let changed = (best.curvature - previous.curvature) / (REACH_GROWTH * REACH_GROWTH - 1.0);
    let is_smaller_reach = |b: &&Bend| (b.count as f64) < SMALLER_REACH_SHARE * best.count as f64;
    let scatter = all[..all.len() - 1].iter().rfind(is_smaller_reach).unwrap_or(&best).uncertainty;
    let uncertainty = libm::hypot(scatter, changed);
    match best.curvature {
        k if k > MIN_CURVATURE_SIGMAS * uncertainty => {
            Ok(EdgeRadius { radius: 1.0 / k, uncertainty: uncertainty / (k * k), count: best.count })
        }
        k if k <= -MIN_CURVATURE_SIGMAS * uncertainty || uncertainty == 0.0 => Err(AirfoilError::Flat),
        _ => Err(AirfoilError::Hidden),
    }
}

/// A curvature told by some points.
#[derive(Clone, Copy, Debug)]
struct Bend {
    curvature: f64,
    uncertainty: f64,
    count: usize,
}

/// The curvature by least squares of the deviations from the local curve, which are distances if it is a circle. `None`
/// where the points do not determine it.
fn fit(points: &[[f64; 2]], noise: f64) -> Option<Bend> {
    let n = points.len();
    let size = points.iter().map(|p| libm::hypot(p[0], p[1])).fold(0.0, f64::max);
    let row = |p: &[f64; 2]| {
        let (x, y) = (p[0] / size, p[1] / size);
        let q = x * x + y * y;
        ([1.0, y, q, q * y, q * y * y], x)
    };
    // Orthogonal columns (Gram and Schmidt, twice); the third coefficient is told from the last two by taking it last.
    /// Orthogonal columns (Gram and Schmidt, twice); the third coefficient is told from the last two by taking it last.
    const COLUMN_ORDER: [usize; LOCAL_CURVE_UNKNOWNS] = [0, 1, 3, 4, 2];
    let mut columns: Vec<Vec<f64>> = vec![];
    let mut rest: Vec<f64> = points.iter().map(|p| row(p).1).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let (mut curvature, mut unit) = (0.0, 0.0);
    for k in COLUMN_ORDER {
        let mut column: Vec<f64> = points.iter().map(|p| row(p).0[k]).collect();
        for before in columns.iter().chain(&columns) {
            let w = dot(&column, before);
            column.iter_mut().zip(before).for_each(|(c, b)| *c -= w * b);
        }
        let norm = dot(&column, &column).sqrt();
        if norm < 1e-9 {
            return None;
        }
        column.iter_mut().for_each(|c| *c /= norm);
        let w = dot(&rest, &column);
        rest.iter_mut().zip(&column).for_each(|(r, c)| *r -= w * c);
        (curvature, unit) = (2.0 * w / norm, 2.0 / norm);
        columns.push(column);
    }
    // The scatter of few points is known better from all.
    let variance = (dot(&rest, &rest) / (n - LOCAL_CURVE_UNKNOWNS) as f64).max((noise / size).powi(2));
    let uncertainty = unit * variance.sqrt() / size;
    let curvature = curvature / size;
    curvature.is_finite().then_some(Bend { curvature, uncertainty, count: n })
}

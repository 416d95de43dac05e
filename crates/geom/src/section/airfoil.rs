//! Measures of an airfoil or blade section: chord, camber line, thickness, radii of its edges.
//!
//! The points run around the profile from its trailing edge over the leading edge and back. A cubic B-spline is fitted to them,
//! of as many control points as the likelihood with Schwarz's penalty pays for; edges of the trailing end (corners, or the ends
//! of an open row) are its ends. The camber line is that of blade inspection: the centers of the circles inscribed into the
//! profile, each the greatest that touches the curve at a place without crossing it (Ma, Bae and Choi, 3D medial axis point
//! approximation using nearest neighbors and the normal field, 2012: there a ball is shrunk point by point, here its radius is the
//! least over all places at once).

mod circles;
mod edge;
mod ends;
mod error;

use super::result::Contour;
use crate::progress::{Cancelled, Progress};
use crate::spline::curve::{self, Curve, Ends, Fitted};
use circles::Inscribed;
pub use edge::EdgeRadius;
pub use ends::TrailingEdge;
use ends::{Around, distance};
pub use error::AirfoilError;
use error::FEWEST;

/// Of more points than this the means of neighbors are taken.
const MOST: usize = 2000;
/// Distances below this share of the spacing are not told from 0.
const RESOLUTION: f64 = 1e-4;
/// Places for each control point by which a curve's length is told.
const PLACES: usize = 8;
/// Control points to begin with, and by what they grow.
const BEGIN: (usize, f64) = (8, 1.3);
/// A curve longer than the way through the points by this factor runs wild between them.
const LONGER: f64 = 1.03;
/// Tries without gain after which no more control points are tried.
const IDLE: usize = 4;

/// What is measured of a profile. Lengths as the points have them; shares are of the chord, from the leading edge.
#[derive(Clone, Debug, PartialEq)]
pub struct Airfoil {
    /// The place of the profile farthest from the trailing edge.
    pub leading: [f64; 2],
    /// The trailing edge; of one with two corners, or of an open row, the middle between these.
    pub trailing: [f64; 2],
    /// Distance of the two.
    pub chord: f64,
    /// Diameter of the greatest inscribed circle.
    pub thickness: f64,
    /// Its standard uncertainty, from the scatter of the points; that of the diameter, not that of its place.
    pub thickness_uncertainty: f64,
    /// Center of that circle.
    pub thickness_center: [f64; 2],
    /// Where along the chord that is, as a share.
    pub thickness_at: f64,
    /// Greatest distance of the camber line from the chord, positive to the left of the way from leading to trailing edge.
    pub camber: f64,
    /// Where along the chord that is, as a share.
    pub camber_at: f64,
    /// Centers and radii of inscribed circles, from the leading to the trailing edge.
    pub camber_line: Vec<([f64; 2], f64)>,
    /// Radius of curvature at the leading edge.
    pub leading_radius: Result<EdgeRadius, AirfoilError>,
    /// What the trailing edge is.
    pub trailing_edge: TrailingEdge,
    /// Radius of curvature of a round trailing edge.
    pub trailing_radius: Result<EdgeRadius, AirfoilError>,
}

/// Measures the profile whose points are `points`, of which `contour` was found.
///
/// Of the contour are used whether it is closed, and which points were left out. The trailing edge of an open row is at its ends;
/// of a closed one at the end where the profile is thinner, a twentieth of the chord from it. It is sharp with one corner, blunt
/// with two, else round. Cost: fits of up to 2,000 points, and inscribed circles as the square of 2,000 places.
///
/// # Errors
/// [`AirfoilError`]: too few points, an open row whose ends lie apart, points that enclose nothing, cancelled.
///
/// ```
/// use trueness_geom::progress::Silent;
/// use trueness_geom::section::{airfoil, contour, Options};
/// // An ellipse, 4 by 1: its radius at the end is 0.5² / 2.
/// let points: Vec<[f64; 2]> = (0..400).map(|i| f64::from(i) * std::f64::consts::TAU / 400.0)
///     .map(|a| [2.0 * a.cos(), 0.5 * a.sin()]).collect();
/// let found = contour(&points, &Options::default(), &Silent).unwrap();
/// let blade = airfoil(&points, &found, &Silent).unwrap();
/// assert!((blade.chord - 4.0).abs() < 1e-4 && (blade.thickness - 1.0).abs() < 1e-4);
/// assert!((blade.leading_radius.unwrap().radius - 0.125).abs() < 1e-3);
/// ```
pub fn airfoil(
    points: &[[f64; 2]],
    contour: &Contour,
    progress: &dyn Progress,
) -> Result<Airfoil, AirfoilError> {
    let mut left_out = contour.outliers.iter().chain(&contour.repeated).copied().collect::<Vec<_>>();
    left_out.sort_unstable();
    let kept = |(i, p): (usize, &[f64; 2])| left_out.binary_search(&i).is_err().then_some(*p);
    let mut row: Vec<[f64; 2]> = points.iter().enumerate().filter_map(kept).collect();
    // Points as near as this are one: a trailing edge of both is sharp.
    let nothing = RESOLUTION * contour.spacing;
    row.dedup_by(|a, b| distance(*a, *b) < nothing);
    while contour.closed && row.len() > FEWEST && distance(row[0], row[row.len() - 1]) < nothing {
        row.pop();
    }
    if row.len() < FEWEST {
        return Err(AirfoilError::TooFewPoints { found: row.len() });
    }
    let around = Around::new(&row, contour.closed)?;
    let fitted = Smooth::new(&thinned(&around.row), progress)?;
    let round = around.trailing == TrailingEdge::Round;
    let inscribed = Inscribed::new(&fitted.curve, round.then(|| around.row[around.over]), progress)?;
    let (leading, trailing) = inscribed.chord(round);
    let chord = distance(leading, trailing);
    let (center, radius) = inscribed.greatest().ok_or(AirfoilError::Inside)?;
    let along = [(trailing[0] - leading[0]) / chord, (trailing[1] - leading[1]) / chord];
    let share = |p: [f64; 2]| ((p[0] - leading[0]) * along[0] + (p[1] - leading[1]) * along[1]) / chord;
    let off = |p: [f64; 2]| along[0] * (p[1] - leading[1]) - along[1] * (p[0] - leading[0]);
    let top = inscribed.extreme(&off).ok_or(AirfoilError::Inside)?;
    // Each point once.
    let once = &around.row[..around.row.len() - 2 * around.over - usize::from(round)];
    let near = |place, from| edge::radius(once, place, from);
    let trailing_radius = match around.trailing {
        TrailingEdge::Round => near(trailing, leading),
        other => Err(AirfoilError::Cornered(other.name())),
    };
    Ok(Airfoil {
        leading,
        trailing,
        chord,
        thickness: 2.0 * radius,
        thickness_uncertainty: fitted.place_uncertainty * std::f64::consts::SQRT_2,
        thickness_center: center,
        thickness_at: share(center),
        camber: off(top),
        camber_at: share(top),
        camber_line: inscribed.line(),
        leading_radius: near(leading, trailing),
        trailing_edge: around.trailing,
        trailing_radius,
    })
}

/// The means of so many neighbors that few enough points are left; the ends stay.
fn thinned(row: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let by = row.len().div_ceil(MOST);
    if by < 2 {
        return row.to_vec();
    }
    let mean = |some: &[[f64; 2]]| [0, 1].map(|k| some.iter().map(|p| p[k]).sum::<f64>() / some.len() as f64);
    let last = row.len() - 1;
    let inner = row[1..last].chunks(by).map(mean);
    std::iter::once(row[0]).chain(inner).chain(std::iter::once(row[last])).collect()
}

/// The curve through the points.
struct Smooth {
    curve: Curve<[f64; 2]>,
    /// Standard uncertainty of a place of it, across.
    place_uncertainty: f64,
}

impl Smooth {
    /// Of the number of control points that costs least: a chi-squared part and Schwarz's penalty, two for each. No more than
    /// three for four points: with more, hardly any point would tell that the curve is wrong.
    fn new(row: &[[f64; 2]], progress: &dyn Progress) -> Result<Smooth, AirfoilError> {
        let n = row.len();
        let chords = curve::chord_parameters(row).ok_or(AirfoilError::Inside)?;
        let length: f64 = row.windows(2).map(|w| distance(w[0], w[1])).sum();
        let floor = (RESOLUTION * length / n as f64).powi(2);
        let mut best: Option<(f64, Smooth)> = None;
        let most = (3 * n / 4).max(BEGIN.0).min(n);
        let (mut count, mut idle) = (BEGIN.0.min(most), 0);
        loop {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            let mut parameters = chords.clone();
            let knots = curve::spread_knots(3, count, &parameters);
            let fitted = curve::corrected(row, &mut parameters, &knots, Ends::FREE).ok();
            let held = |f: &Fitted<2>| {
                let places = f.curve.sample(PLACES * knots.count());
                places.windows(2).map(|w| distance(w[0], w[1])).sum::<f64>() < LONGER * length
            };
            if let Some(fitted) = fitted.filter(held) {
                let p = knots.count() as f64;
                let mean = fitted.sum_of_squares / (n as f64 - p).max(1.0);
                let cost = n as f64 * libm::log(mean + floor) + 2.0 * p * libm::log(n as f64);
                if best.as_ref().is_none_or(|b| cost < b.0) {
                    idle = 0;
                    let variance = fitted.sum_of_squares / (n as f64 - p).max(1.0);
                    let place_uncertainty = (variance * p / n as f64).sqrt();
                    best = Some((cost, Smooth { curve: fitted.curve, place_uncertainty }));
                } else {
                    idle += 1;
                }
            }
            if count >= most || idle >= IDLE {
                return best.map(|b| b.1).ok_or(AirfoilError::Inside);
            }
            count = ((count as f64 * BEGIN.1) as usize).min(most);
        }
    }
}

#[cfg(test)]
mod tests;

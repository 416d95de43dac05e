//! Measures of an airfoil or blade section: chord, camber line, thickness, radii of its edges.
//!
//! The points run around the profile from its trailing edge over the leading edge and back. The course through them is
//! that of the contour's lines, arcs and curves, or a cubic B-spline, whichever is the likelier. The camber line is
//! that of blade inspection: the centers of the circles inscribed into the profile. Each is the greatest that touches
//! the curve at a place without crossing it. Ma, Bae and Choi (3D medial axis point approximation using nearest
//! neighbors and the normal field, 2012) shrink a ball point by point. Here its radius is the least over all places at
//! once.

mod circles;
mod edge;
mod ends;
mod error;
mod profile;
mod tail;

use crate::model::flat::distance;
use crate::model::result::{Contour, Geometry, Uncertainty};
use crate::row::direction::from_the_end;
use circles::InscribedCircles;
pub use edge::EdgeRadius;
pub use ends::TrailingEdge;
pub use error::AirfoilError;
use error::MIN_POINTS_OF_PROFILE;
use profile::{Profile, SAME_PLACE_SPACINGS};
use trueness_geom::progress::Progress;

/// An edge lies on an arc of the contour that turns by more than this, radians.
const MIN_EDGE_ARC_TURN: f64 = 2.4;
/// By so many standard uncertainties of a mean of its points the radius of an edge may differ from that of its arc.
const HIDDEN_RADIUS_SIGMAS: f64 = 8.0 * std::f64::consts::SQRT_2;

/// Measures of a profile. Lengths as the points have them; shares are of the chord, from the leading edge.
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
    /// The kind of the trailing edge.
    pub trailing_edge: TrailingEdge,
    /// Radius of curvature of a round trailing edge.
    pub trailing_radius: Result<EdgeRadius, AirfoilError>,
}

/// Measures the profile whose points are `points`, of which `contour` was found.
///
/// Only whether the contour is closed, and which points were left out of it, are used. The trailing edge of an open row
/// is at its ends; of a closed one at the thinner end. It is the shortest stretch that takes two thirds of half a turn.
/// It is sharp at one point, blunt between two corners, with points on the face or none, else round. Sides are led no
/// farther than their points. Cost: fits of up to 2,000 points, and inscribed circles as the square of 2,000 places.
///
/// # Errors
/// [`AirfoilError`]: too few points, an open row whose ends lie apart, points that enclose nothing, cancelled.
///
/// ```
/// use trueness_geom::progress::Silent;
/// use trueness_section::{airfoil, contour, Options};
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
    if !from_the_end(points) {
        return in_order(points, contour, progress);
    }
    let turned: Vec<[f64; 2]> = points.iter().rev().copied().collect();
    in_order(&turned, &contour.clone().turned_round(&turned), progress)
}

/// The radius of the arc that a place lies on, if it does.
fn on_arc(contour: &Contour, place: [f64; 2]) -> Option<EdgeRadius> {
    let off = |k: &usize| contour.segments[*k].nearest(place).distance.abs();
    let nearest = (0..contour.segments.len()).min_by(|a, b| off(a).total_cmp(&off(b)))?;
    let segment = &contour.segments[nearest];
    match (&segment.geometry, segment.uncertainty) {
        (Geometry::Arc { radius, sweep, .. }, Some(Uncertainty::Arc { radius: uncertainty, .. }))
            if sweep.abs() > MIN_EDGE_ARC_TURN =>
        {
            // Waves of the edge that scatter hides bend it more than the arc. They do by eight times as much as they
            // are high over its radius, with three to a round.
            let hidden = HIDDEN_RADIUS_SIGMAS * contour.noise / contour.independent_of(nearest).sqrt();
            let uncertainty = libm::hypot(uncertainty, hidden);
            Some(EdgeRadius { radius: *radius, uncertainty, count: segment.count })
        }
        _ => None,
    }
}

fn in_order(
    points: &[[f64; 2]],
    contour: &Contour,
    progress: &dyn Progress,
) -> Result<Airfoil, AirfoilError> {
    let mut left_out = contour.outliers.iter().chain(&contour.repeated).copied().collect::<Vec<_>>();
    left_out.sort_unstable();
    let mut numbers: Vec<usize> = (0..points.len()).filter(|i| left_out.binary_search(i).is_err()).collect();
    // Points as near as this are one: a trailing edge of both is sharp.
    let nothing = SAME_PLACE_SPACINGS * contour.spacing;
    let near = |i: usize, j: usize| distance(points[i], points[j]) < nothing;
    numbers.dedup_by(|i, j| near(*i, *j));
    while contour.closed
        && numbers.len() > MIN_POINTS_OF_PROFILE
        && near(numbers[0], numbers[numbers.len() - 1])
    {
        numbers.pop();
    }
    let row: Vec<[f64; 2]> = numbers.iter().map(|i| points[*i]).collect();
    if row.len() < MIN_POINTS_OF_PROFILE {
        return Err(AirfoilError::TooFewPoints { found: row.len() });
    }
    let (around, mut course, mut other) = Profile::new(&row, &numbers, contour, progress)?;
    let round = around.trailing == TrailingEdge::Round;
    let mut inscribed = InscribedCircles::new(&course, progress);
    // Segments overshoot where they join in a place that the points do not determine; the free curve through all points has no such place.
    if matches!(inscribed, Err(AirfoilError::Crosses { .. }))
        && course.of_contour
        && let Some(smooth) = other.take()
    {
        course = smooth;
        inscribed = InscribedCircles::new(&course, progress);
    }
    let inscribed = inscribed?;
    let (leading, trailing) = inscribed.chord(round);
    let chord = distance(leading, trailing);
    let (center, radius) = inscribed.greatest().ok_or(AirfoilError::Inside)?;
    // The result of another course through the points differs by the scatter that a free curve follows, or by the form
    // that it does not.
    let other = match other.map(|other| InscribedCircles::new(&other, progress)) {
        Some(Err(AirfoilError::Cancelled(e))) => return Err(e.into()),
        other => other.and_then(|o| o.ok()?.greatest()),
    };
    let differs = other.map_or(0.0, |(_, other)| 2.0 * (radius - other).abs());
    // Scatter makes one of many circles of one size the greatest, which is too large by about as much as it is
    // uncertain.
    let across = course.uncertainty * std::f64::consts::SQRT_2;
    let chosen = if inscribed.is_flat(across) { across } else { 0.0 };
    let along = [(trailing[0] - leading[0]) / chord, (trailing[1] - leading[1]) / chord];
    let share = |p: [f64; 2]| ((p[0] - leading[0]) * along[0] + (p[1] - leading[1]) * along[1]) / chord;
    let off = |p: [f64; 2]| along[0] * (p[1] - leading[1]) - along[1] * (p[0] - leading[0]);
    let top = inscribed.extreme(&off).ok_or(AirfoilError::Inside)?;
    // Each point once.
    let once = &around.row[..around.row.len() - 2 * around.over - usize::from(round)];
    let near = |place, from| match course.of_contour.then(|| on_arc(contour, place)).flatten() {
        Some(arc) => Ok(arc),
        None => edge::radius(once, place, from, course.noise),
    };
    let trailing_radius = match around.trailing {
        TrailingEdge::Round => near(trailing, leading),
        other => Err(AirfoilError::Cornered(other.name())),
    };
    Ok(Airfoil {
        leading,
        trailing,
        chord,
        thickness: 2.0 * radius,
        thickness_uncertainty: libm::hypot(libm::hypot(across, chosen), differs),
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

#[cfg(test)]
mod tests;

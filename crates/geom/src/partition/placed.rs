//! Where a face really is.

use super::best::Candidate;
use super::faces::{Face, Seat};
use crate::fit::{Method, Options, fit};
use crate::num::median::median;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::shape::Shape;
use crate::space::Point;

/// Most points by which a face is placed.
const MAX_PLACING_POINTS: usize = 2000;
/// Points for each unknown from which on a face is fitted; with fewer it is moved along its normal.
const PLACES_PER_UNKNOWN: usize = 4;
/// Share of the deviation below which a fit is clearly better than a move along the normal. Points along one line or circle of
/// a narrow face do not tell how it leans.
const CLEAR_FIT_SHARE: f64 = 0.75;
/// Least share of points that are off where coordinates are rounded to the size of the noise. Fewer may be a defect.
const MIN_ROUNDED_SHARE: f64 = 0.25;
/// The standard deviation over the median magnitude, of normal noise.
const SIGMA_OVER_MEDIAN: f64 = 1.4826;

/// Where a face really is, by the points that are surely its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The element fitted to them; `None` of a free face, and where they are too few.
    pub shape: Option<Shape>,
    /// How far it lies off the nominal, out of the material, where nothing was fitted, millimeters.
    pub offset: f64,
    /// Deviation of the points from it, millimeters: noise and form.
    pub deviation: f64,
    /// Their number.
    pub points: usize,
}

impl Placed {
    pub(super) fn of(face: &Face, points: &[Point], sure: &[Candidate], floor: f64, seed: u64) -> Placed {
        let chosen = Random::new(seed).choose(MAX_PLACING_POINTS, sure.len());
        let chosen: Vec<Candidate> = chosen.into_iter().map(|i| sure[i]).collect();
        let places: Vec<Point> = chosen.iter().map(|c| points[c.point as usize]).collect();
        let with = |shape: Option<Shape>| {
            let mut placed = Placed { shape, offset: 0.0, deviation: 0.0, points: sure.len() };
            let off = |placed: &Placed| -> Vec<f64> {
                let all = places.iter().zip(&chosen).map(|(p, c)| placed.off(face, *p, c.seat));
                all.filter(|x| x.is_finite()).collect()
            };
            if shape.is_none() {
                placed.offset = median(&mut off(&placed)).unwrap_or(0.0);
            }
            placed.deviation = deviation(off(&placed).into_iter().map(f64::abs).collect(), floor);
            placed
        };
        let moved = with(None);
        let fitted =
            face.shape.filter(|s| places.len() >= PLACES_PER_UNKNOWN * s.kind().unknowns()).and_then(|s| {
                let options = Options { method: Method::Robust, start: Some(s), seed };
                let found = fit(&places, s.kind(), &options, &Silent).ok()?;
                found.converged.then(|| with(Some(facing_as(found.shape, face, &places))))
            });
        fitted.filter(|fitted| fitted.deviation < CLEAR_FIT_SHARE * moved.deviation).unwrap_or(moved)
    }

    /// Distance of a point across the face where it really is, positive outside of the material.
    pub(super) fn off(&self, face: &Face, p: Point, seat: Seat) -> f64 {
        match self.shape {
            Some(shape) => face.outward * shape.distance(p),
            None => seat.off - self.offset,
        }
    }
}

/// The same element, planes with their normal to the side of the face's.
fn facing_as(found: Shape, face: &Face, places: &[Point]) -> Shape {
    match (found, face.shape, places.first()) {
        (Shape::Plane { point, normal }, Some(nominal), Some(p)) => {
            let turned = crate::space::dot(normal, nominal.normal(*p)) < 0.0;
            Shape::Plane { point, normal: if turned { normal.map(|x| -x) } else { normal } }
        }
        _ => found,
    }
}

/// The standard deviation of normal noise by its magnitudes. More than half may be zero, as on a plane along whose normal
/// coordinates are rounded. Then it is the step that they are rounded to: the least of the others.
fn deviation(all: Vec<f64>, floor: f64) -> f64 {
    let middle = SIGMA_OVER_MEDIAN * median(&mut all.clone()).unwrap_or(0.0);
    if middle > floor {
        return middle;
    }
    let others: Vec<f64> = all.iter().copied().filter(|off| *off > floor).collect();
    match (others.len() as f64) < MIN_ROUNDED_SHARE * all.len() as f64 {
        true => floor,
        false => others.into_iter().fold(f64::INFINITY, f64::min),
    }
}

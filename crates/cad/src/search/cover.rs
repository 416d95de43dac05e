//! Boxes around faces and edges: many small ones, without those that hold nothing of the face.

use super::face::Face;
use super::region::Region;
use crate::curve::CurveFeet;
use crate::surface::SurfaceFeet;
use trueness_geom::space::{Aabb, Point, minus, norm};

/// Most boxes along a parameter of a face.
const MAX_STEPS: usize = 32;
/// Most boxes for a piece of an edge.
const MAX_BOXES_OF_PIECE: usize = 64;
/// Places by which the length of a line on a face is judged.
const LENGTH_PLACES: usize = 8;
/// Share of a step by which boxes are widened beyond the gap between the face and its edges: what is rounded must not part them.
const BOX_SLACK_STEPS: f64 = 0.1;

/// Boxes around an edge, about as long as `step`.
pub(super) fn pieces_of_edge(feet: &CurveFeet, step: f64) -> Vec<Aabb> {
    let mut boxes = vec![];
    for (bounds, range) in feet.pieces() {
        let count = (bounds.diagonal() / step).ceil();
        let count = if count.is_finite() { (count as usize).clamp(1, MAX_BOXES_OF_PIECE) } else { 1 };
        if count == 1 {
            boxes.push(bounds);
            continue;
        }
        let at = |i: usize| range[0] + (range[1] - range[0]) * i as f64 / count as f64;
        boxes.extend((0..count).map(|i| feet.bounds_within([at(i), at(i + 1)])));
    }
    boxes
}

/// A box, and a place of the face within; NaN where none is known.
pub(super) type Cover = (Aabb, Point);

/// The units of a face with boxes around the parts of them that the face may have; `borders` are boxes around its edges.
pub(super) fn cover_of_face<R: Region>(
    face: &Face<R>,
    step: f64,
    borders: &[Aabb],
) -> Vec<(u32, Vec<Cover>)> {
    let Some(region) = &face.region else { return vec![] };
    let feet = &face.feet;
    let kept = |(bounds, middle): (Aabb, [f64; 2])| -> Option<Cover> {
        if region.contains(middle) {
            return Some((bounds, feet.surface().at(middle[0], middle[1])));
        }
        let wide = bounds.widened(BOX_SLACK_STEPS * step + region.gap());
        borders.iter().any(|b| b.meets(&wide)).then_some((bounds, [f64::NAN; 3]))
    };
    let mut cover = vec![];
    for unit in 0..feet.units() {
        let own: Vec<Cover> = match feet.unit(unit) {
            Some(own) => kept(own).into_iter().collect(),
            None => cells(feet, region.window(), step).filter_map(kept).collect(),
        };
        if !own.is_empty() {
            cover.push((unit as u32, own));
        }
    }
    cover
}

/// Boxes around the cells of a window, with the parameters of their middles.
fn cells(
    feet: &SurfaceFeet,
    window: [[f64; 2]; 2],
    step: f64,
) -> impl Iterator<Item = (Aabb, [f64; 2])> + '_ {
    let surface = feet.surface();
    let at = move |k: usize, share: f64| window[k][0] + share * (window[k][1] - window[k][0]);
    let length = |k: usize| {
        let line = |other: f64| -> f64 {
            let place = |i: usize| {
                let mut shares = [other; 2];
                shares[k] = i as f64 / LENGTH_PLACES as f64;
                surface.at(at(0, shares[0]), at(1, shares[1]))
            };
            (0..LENGTH_PLACES).map(|i| norm(minus(place(i), place(i + 1)))).sum()
        };
        [0.0, 0.3, 0.6, 1.0].map(line).into_iter().fold(0.0, f64::max)
    };
    let count = |k: usize| {
        let steps = (length(k) / step).ceil();
        if steps.is_finite() { (steps as usize).clamp(1, MAX_STEPS) } else { 1 }
    };
    let counts = [count(0), count(1)];
    (0..counts[0] * counts[1]).map(move |n| {
        let cell = [n / counts[1], n % counts[1]];
        let range = [0, 1].map(|k| [0, 1].map(|end| at(k, (cell[k] + end) as f64 / counts[k] as f64)));
        let [us, vs] = [0, 1].map(|k| home(range[k], feet.periods()[k], surface.domain()[k]));
        let mut bounds = Aabb::EMPTY;
        for u in &us {
            for v in &vs {
                bounds = bounds.union(&surface.bounds([*u, *v]));
            }
        }
        (bounds, range.map(|[a, b]| 0.5 * (a + b)))
    })
}

/// The parts of a domain that a range of a parameter that repeats stands for.
fn home([from, to]: [f64; 2], period: Option<f64>, domain: [f64; 2]) -> Vec<[f64; 2]> {
    let Some(period) = period else { return vec![[from, to]] };
    if to - from >= period {
        return vec![domain];
    }
    let turns = ((from - domain[0]) / period).floor();
    let [from, to] = [from - period * turns, to - period * turns];
    if to <= domain[1] { vec![[from, to]] } else { vec![[from, domain[1]], [domain[0], to - period]] }
}

//! The chord of a profile by each of its usual definitions, and its centroid.

use super::airfoil::{Airfoil, AirfoilError, TrailingEdge};
use super::nominal::Outline;
use crate::model::flat::distance;
use crate::model::result::{Contour, Geometry};

/// A chord, from the leading to the trailing edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chord {
    /// Its end at the leading edge.
    pub leading: [f64; 2],
    /// Its end at the trailing edge.
    pub trailing: [f64; 2],
}

impl Chord {
    /// Its length.
    pub fn length(&self) -> f64 {
        distance(self.leading, self.trailing)
    }

    /// Angle of the way from leading to trailing edge with the first axis, radians.
    pub fn angle(&self) -> f64 {
        libm::atan2(self.trailing[1] - self.leading[1], self.trailing[0] - self.leading[0])
    }
}

/// The chords of a profile, each by another definition.
#[derive(Clone, Debug, PartialEq)]
pub struct Chords {
    /// Between the two places of the profile that are farthest from each other.
    pub farthest: Chord,
    /// Between the ends of the camber line, led on to the profile.
    pub camber_ends: Chord,
    /// The profile's extent along the flat tangent, the line that touches its hollow side at two places; on that tangent.
    pub bitangent: Result<Chord, AirfoilError>,
    /// Center of the area that it encloses.
    pub centroid: [f64; 2],
    /// That area.
    pub area: f64,
}

/// Places around a profile that are looked at.
const PLACES_AROUND_PROFILE: usize = 4000;
/// A tangent touches two places if these are apart by so much of the profile: the sides of a round one's hull are far shorter.
const MIN_TANGENT_SHARE: f64 = 0.25;
/// Places of a nominal's arcs and curves that a row has.
const PLACES_PER_OUTLINE_ROW: usize = 1200;

/// The chords of the profile whose points are `points`, of which `contour` and `found` were found. An open row is
/// closed by the straight line between its ends. Where segments of a contour are unreliable the points themselves are
/// measured.
///
/// # Errors
/// [`AirfoilError::Inside`] where the profile encloses nothing. Cost: 4,000 places, sorted.
pub fn chords(points: &[[f64; 2]], contour: &Contour, found: &Airfoil) -> Result<Chords, AirfoilError> {
    let places = match contour.segments.is_empty() || !contour.unreliable.is_empty() {
        true => points.to_vec(),
        false => evenly(&Outline::of(contour), PLACES_AROUND_PROFILE),
    };
    let (area, centroid) = of_area(&places).ok_or(AirfoilError::Inside)?;
    let hull = hull(&places);
    let toward = |a: [f64; 2], b: [f64; 2]| match distance(a, found.leading) <= distance(b, found.leading) {
        true => Chord { leading: a, trailing: b },
        false => Chord { leading: b, trailing: a },
    };
    let [a, b] = farthest_pair(&hull);
    let farthest = toward(a, b);
    let camber_ends = camber_ends(found, &places);
    Ok(Chords { farthest, camber_ends, bitangent: bitangent(&hull, &farthest), centroid, area })
}

/// The two places of a hull that are farthest from each other, between its corners where these follow a curve.
fn farthest_pair(hull: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let (mut pair, mut most) = ([0; 2], 0.0);
    for (i, a) in hull.iter().enumerate() {
        for (j, b) in hull.iter().enumerate().skip(i + 1) {
            let d = distance(*a, *b);
            if d > most {
                (pair, most) = ([i, j], d);
            }
        }
    }
    let mut far = pair.map(|i| hull[i]);
    for _ in 0..REFINING_TURNS {
        for side in 0..2 {
            far[side] = top(hull, pair[side], far[1 - side]);
        }
    }
    far
}

/// The place farthest from another on the parabola through a corner of a hull and the two beside; the corner itself where it is sharp.
fn top(hull: &[[f64; 2]], i: usize, from: [f64; 2]) -> [f64; 2] {
    let n = hull.len();
    let [a, b, c] = [hull[(i + n - 1) % n], hull[i], hull[(i + 1) % n]];
    let [u, v] = [[b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]];
    let turn = libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]).abs();
    let [x, y, z] = [a, b, c].map(|p| distance(p, from));
    let bend = x - 2.0 * y + z;
    if turn > SHARP_HULL_TURN || bend >= 0.0 {
        return b;
    }
    let t = (0.5 * (x - z) / bend).clamp(-1.0, 1.0);
    [0, 1].map(|k| b[k] + 0.5 * t * (c[k] - a[k]) + 0.5 * t * t * (a[k] - 2.0 * b[k] + c[k]))
}

/// Turns between the two ends of the farthest way.
const REFINING_TURNS: usize = 8;
/// A hull that turns by more at a corner is sharp there, radians.
const SHARP_HULL_TURN: f64 = 0.2;

/// Extent along the longest side of the hull, if that is a long one beside the profile.
fn bitangent(hull: &[[f64; 2]], farthest: &Chord) -> Result<Chord, AirfoilError> {
    let n = hull.len();
    let side = |i: usize| (hull[i], hull[(i + 1) % n]);
    let size = |i: usize| distance(side(i).0, side(i).1);
    let way = [0, 1].map(|k| farthest.trailing[k] - farthest.leading[k]);
    let length = farthest.length();
    // A blunt edge is a side of the hull, too, but stands across.
    let lies_along = |i: &usize| {
        let (a, b) = side(*i);
        ((b[0] - a[0]) * way[0] + (b[1] - a[1]) * way[1]).abs() > 0.5 * size(*i) * length
    };
    let longest = (0..n).filter(lies_along).max_by(|i, j| size(*i).total_cmp(&size(*j)));
    let Some(i) = longest.filter(|i| size(*i) >= MIN_TANGENT_SHARE * length) else {
        return Err(AirfoilError::NotHollow);
    };
    let (a, b) = side(i);
    let sense = if (b[0] - a[0]) * way[0] + (b[1] - a[1]) * way[1] < 0.0 { -1.0 } else { 1.0 };
    let along = [0, 1].map(|k| sense * (b[k] - a[k]) / size(i));
    let far = |p: &[f64; 2]| (p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1];
    let [low, high] =
        hull.iter().map(far).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
    let at = |x: f64| [a[0] + x * along[0], a[1] + x * along[1]];
    Ok(Chord { leading: at(low), trailing: at(high) })
}

/// From where the camber line meets the profile at the leading edge to where it does at a round trailing edge. It is
/// led on by its direction over a radius of its last circle. Other edges are its end themselves.
fn camber_ends(found: &Airfoil, places: &[[f64; 2]]) -> Chord {
    let line = &found.camber_line;
    let back: Vec<([f64; 2], f64)> = line.iter().rev().copied().collect();
    let leading = led_on(line, places).unwrap_or(found.leading);
    let trailing = match found.trailing_edge {
        TrailingEdge::Round => led_on(&back, places).unwrap_or(found.trailing),
        TrailingEdge::Sharp | TrailingEdge::Blunt(_) | TrailingEdge::Open(_) => found.trailing,
    };
    Chord { leading, trailing }
}

/// Where the way through the first circles, from within, meets a polygon.
fn led_on(circles: &[([f64; 2], f64)], polygon: &[[f64; 2]]) -> Option<[f64; 2]> {
    let (first, radius) = *circles.first()?;
    let (other, _) = circles.iter().find(|(c, _)| distance(*c, first) >= radius.max(f64::MIN_POSITIVE))?;
    let size = distance(first, *other);
    let along = [0, 1].map(|k| (first[k] - other[k]) / size);
    let n = polygon.len();
    let crossing = |i: usize| -> Option<f64> {
        let (a, b) = (polygon[i], polygon[(i + 1) % n]);
        let across = |p: [f64; 2]| along[0] * (p[1] - first[1]) - along[1] * (p[0] - first[0]);
        let (s, t) = (across(a), across(b));
        if (s > 0.0) == (t > 0.0) {
            return None;
        }
        let share = s / (s - t);
        let d = [0, 1].map(|k| a[k] + share * (b[k] - a[k]) - first[k]);
        Some(d[0] * along[0] + d[1] * along[1]).filter(|x| *x >= 0.0)
    };
    let nearest = (0..n).filter_map(crossing).min_by(f64::total_cmp)?;
    Some([0, 1].map(|k| first[k] + nearest * along[k]))
}

/// Places along an outline, about so many, at even steps of each segment; all its ends are among them.
fn evenly(outline: &Outline, count: usize) -> Vec<[f64; 2]> {
    let total = outline.length().max(f64::MIN_POSITIVE);
    let mut all = vec![];
    for s in &outline.segments {
        let parts = ((count as f64 * s.length / total).ceil() as usize).max(1);
        all.extend((0..parts).map(|i| s.place(i as f64 / parts as f64)));
    }
    all.extend(outline.segments.last().filter(|_| !outline.closed).map(|s| s.end));
    all
}

/// An outline of a nominal as a row of points. They are the ends of chords, or even places where it has arcs or curves,
/// or only a few lines.
pub fn outline_row(outline: &Outline) -> Vec<[f64; 2]> {
    let chords = outline.segments.len() > MAX_SIDES_OF_POLYGON
        && outline.segments.iter().all(|s| s.geometry == Geometry::Line);
    evenly(outline, if chords { 1 } else { PLACES_PER_OUTLINE_ROW })
}

/// So few lines are no chords of a curve.
const MAX_SIDES_OF_POLYGON: usize = 16;

/// Area and centroid of a polygon, whichever way round it runs.
fn of_area(polygon: &[[f64; 2]]) -> Option<(f64, [f64; 2])> {
    let o = *polygon.first()?;
    let at = |i: usize| {
        let p = polygon[i % polygon.len()];
        [p[0] - o[0], p[1] - o[1]]
    };
    let (mut area, mut moment) = (0.0, [0.0; 2]);
    for i in 0..polygon.len() {
        let (a, b) = (at(i), at(i + 1));
        let cross = a[0] * b[1] - a[1] * b[0];
        area += 0.5 * cross;
        for k in 0..2 {
            moment[k] += cross * (a[k] + b[k]) / 6.0;
        }
    }
    let inside = area != 0.0 && area.is_finite();
    inside.then(|| (area.abs(), [0, 1].map(|k| o[k] + moment[k] / area)))
}

/// Corners of the convex hull, counter-clockwise (A. M. Andrew 1979).
fn hull(places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = places.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    let left = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
    };
    let half = |all: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = vec![];
        for p in all {
            while chain.len() > 1 && !left(chain[chain.len() - 2], chain[chain.len() - 1], p) {
                chain.pop();
            }
            chain.push(p);
        }
        chain
    };
    let mut lower = half(&mut sorted.iter().copied());
    let mut upper = half(&mut sorted.iter().rev().copied());
    if sorted.len() > 1 {
        lower.pop();
        upper.pop();
    }
    lower.extend(upper);
    lower
}

#[cfg(test)]
mod tests;

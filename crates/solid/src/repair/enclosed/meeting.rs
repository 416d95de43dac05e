//! Where two facets meet.

use trueness_geom::num::big::{self, Big};
use trueness_geom::num::interval::{self, Interval};
use trueness_geom::num::predicates::side_of_plane;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times};

/// A facet with its vertices' numbers, true places, and places as seen from the middle of the mesh.
pub(super) struct Facet {
    pub vertices: [u32; 3],
    pub places: [Point; 3],
    pub local: [Point; 3],
}

impl Facet {
    /// Twice its area, along its normal.
    pub(super) fn vector(&self) -> Vector {
        let [a, b, c] = self.local;
        cross(minus(b, a), minus(c, a))
    }
}

/// The common places of two facets.
pub(super) enum Meeting {
    /// Both lie in one plane, decided exactly.
    Coplanar,
    /// A segment, as seen from the middle of the mesh.
    Segment([Point; 2]),
    /// A point at most.
    Nothing,
}

/// Which side of each facet the other's vertices lie on is decided exactly. It is the same for both orders of the two.
/// Where an edge meets a facet there is one place, whichever facet at the edge is asked about.
pub(super) fn meeting(f: &Facet, g: &Facet) -> Meeting {
    let sides = |t: &Facet, plane: &Facet| {
        let [a, b, c] = &plane.places;
        t.places.map(|p| side_of_plane(a, b, c, &p))
    };
    let (of_f, of_g) = (sides(f, g), sides(g, f));
    if of_f == [0; 3] || of_g == [0; 3] {
        return Meeting::Coplanar;
    }
    let (Some(p), Some(q)) = (cut(f, of_f, g), cut(g, of_g, f)) else { return Meeting::Nothing };
    // The line of both planes, as well as it is known.
    let (along, other) = (minus(p[1], p[0]), minus(q[1], q[0]));
    let along = if norm(along) >= norm(other) { along } else { other };
    let sorted = |[a, b]: [Point; 2]| {
        let (s, t) = (dot(along, a), dot(along, b));
        if s <= t { [(s, a), (t, b)] } else { [(t, b), (s, a)] }
    };
    let ([p0, p1], [q0, q1]) = (sorted(p), sorted(q));
    let from = if p0.0 >= q0.0 { p0 } else { q0 };
    let to = if p1.0 <= q1.0 { p1 } else { q1 };
    if from.0 < to.0 { Meeting::Segment([from.1, to.1]) } else { Meeting::Nothing }
}

/// Where the boundary of a facet passes the plane of another, its vertices being on these sides.
fn cut(t: &Facet, sides: [i32; 3], plane: &Facet) -> Option<[Point; 2]> {
    let mut found: Vec<Point> = (0..3).filter(|&k| sides[k] == 0).map(|k| t.local[k]).collect();
    for k in 0..3 {
        let l = (k + 1) % 3;
        if sides[k] * sides[l] < 0 {
            let (i, j) = if t.vertices[k] < t.vertices[l] { (k, l) } else { (l, k) };
            let share = share(plane, t.places[i], t.places[j]);
            found.push(plus(t.local[i], times(share, minus(t.local[j], t.local[i]))));
        }
    }
    match found[..] {
        [a, b] => Some([a, b]),
        _ => None,
    }
}

/// The share of the way from `u` to `v` that leads to the plane of a facet; they lie on either side of it.
fn share(facet: &Facet, u: Point, v: Point) -> f64 {
    /// Beyond this error, exact numbers are used.
    const MAX_ERROR_OF_DOUBLES: f64 = 1e-12;
    let [a, b, c] = facet.places;
    let minus = |p: Point, q: Point| [0, 1, 2].map(|k| Interval::of(p[k]) - Interval::of(q[k]));
    let normal = interval::cross(minus(b, a), minus(c, a));
    let [from, to] = [u, v].map(|p| interval::dot(normal, minus(p, a)));
    let middle = |i: Interval| i.low + 0.5 * (i.high - i.low);
    let (whole, wide) = (middle(from) - middle(to), (from.high - from.low) + (to.high - to.low));
    if wide <= MAX_ERROR_OF_DOUBLES * whole.abs() {
        return (middle(from) / whole).clamp(0.0, 1.0);
    }
    let normal = big::cross(&big::minus(b, a), &big::minus(c, a));
    let [from, to] = [u, v].map(|p| big::dot(&normal, &big::minus(p, a)));
    let whole = &from - &to;
    match whole.sign() {
        0 => 0.5,
        1 => Big::quotient(&from, &whole)[0],
        _ => Big::quotient(&from.negated(), &whole.negated())[0],
    }
}

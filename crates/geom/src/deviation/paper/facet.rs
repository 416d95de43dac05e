//! One facet: the paper's distance, and how far rounding may have moved it.

use crate::space::{Point, cross, dot, minus, norm};

/// A distance by the paper's method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Millimeters, unsigned.
    pub distance: f64,
    /// Greatest rounding in this evaluation and in that of the exact distance to the same facet, millimeters.
    ///
    /// Both see differences of coordinates, which are good to half a unit in the last place. So errors go with the distances to
    /// the corners, not with the coordinates. To a segment that is a dozen roundings. To a plane the normal's direction is
    /// uncertain too, by 1/sin of the angle between the edges that span it.
    pub rounding: f64,
}

/// Bound of the roundings of one evaluation, with those of the exact method.
const EVALUATION_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The least distance of `m` to the facets (18).
pub(super) fn least(m: &Point, facets: impl Iterator<Item = [Point; 3]>) -> Value {
    let (mut distance, mut low, mut high) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
    for corners in facets {
        let value = of(m, corners);
        distance = distance.min(value.distance);
        // Another facet may be the true winner: the minimum of the bounds bounds the minimum.
        low = low.min(value.distance - value.rounding);
        high = high.min(value.distance + value.rounding);
    }
    Value { distance, rounding: (distance - low).max(high - distance) }
}

/// The distance of `m` to one facet: to its plane where the angles (5) allow, else to its edges.
fn of(m: &Point, [a, b, c]: [Point; 3]) -> Value {
    let [ma, mb, mc] = [a, b, c].map(|corner| squared(minus(*m, corner)));
    let [ab, bc, ca] = [minus(b, a), minus(c, b), minus(a, c)].map(squared);
    let n = cross(minus(b, a), minus(c, a));
    let size = norm(n);
    let farthest = ma.max(mb).max(mc).sqrt();
    let angles = right_or_less(ma, ab, mb) && right_or_less(ma, ca, mc) && right_or_less(mb, bc, mc);
    if angles && size > 0.0 {
        let slender = (ab * ca).sqrt() / size;
        let distance = dot(n, minus(*m, a)).abs() / size;
        return Value { distance, rounding: EVALUATION_ROUNDING * (1.0 + slender) * farthest };
    }
    let edges = [(a, b, ma, mb, ab), (b, c, mb, mc, bc), (c, a, mc, ma, ca)];
    let distance =
        edges.map(|(a, b, ma, mb, ab)| edge(m, &a, &b, ma, mb, ab)).into_iter().fold(f64::INFINITY, f64::min);
    Value { distance, rounding: EVALUATION_ROUNDING * farthest }
}

/// Distance of `m` to the segment `ab` (14): `ma`, `mb`, `ab` are squared lengths.
fn edge(m: &Point, a: &Point, b: &Point, ma: f64, mb: f64, ab: f64) -> f64 {
    if ab > 0.0 && right_or_less(ma, ab, mb) {
        norm(cross(minus(*m, *a), minus(*b, *a))) / ab.sqrt()
    } else {
        ma.min(mb).sqrt()
    }
}

/// True if neither angle at the ends of the segment is obtuse, by the law of cosines.
fn right_or_less(ma: f64, ab: f64, mb: f64) -> bool {
    ma + ab - mb >= 0.0 && mb + ab - ma >= 0.0
}

fn squared(v: [f64; 3]) -> f64 {
    dot(v, v)
}

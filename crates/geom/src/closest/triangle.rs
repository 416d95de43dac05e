//! Distance from a point to one triangle, in double precision: the definition of the answer.
//!
//! [`squared`] is written once over [`Real`]. So the scalar brute-force twin and the vector kernel run the same operations in
//! the same order and agree bit for bit.
//!
//! Method. The distance is the least of the distances to the three edges. Where the foot of the perpendicular falls inside, the
//! distance to the plane joins these. Testing the edges always (instead of sorting the point into one of seven regions, Ericson
//! 2005 §5.1.5) costs a few operations. It makes every degenerate triangle an ordinary case: a needle, a segment or a point is
//! answered by its edges. Where the normal is not well determined ([`MIN_SINE_SQUARED`]), [`thin`] goes on.
#![expect(unsafe_code, reason = "constants of a vector type need its instructions")]

use crate::closest::segment::{along, aside, dot, edge, sub};
use crate::closest::thin::{self, MIN_SINE_SQUARED};
use crate::simd::lanes::Real;
use crate::space::Point;

#[inline(always)]
fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Squared distance from `p` to the triangle `a b c`, any of which may coincide, a height, and a mark. Where the closest point
/// lies inside the triangle, the height is that of `p` over the plane times the length of the normal. On the rim it is 0. The
/// mark is 1 where the triangle is thin, else 0. Then the distance is that to its rim, and [`thin::squared`] must be asked for
/// the rest.
///
/// # Safety
/// The processor has the instructions of `T` (none for `f64`).
#[inline(always)]
pub unsafe fn squared<T: Real>(p: [T; 3], [a, b, c]: [[T; 3]; 3]) -> (T, T, T) {
    // SAFETY: the caller's promise.
    let (zero, one, thin) = unsafe { (T::splat(0.0), T::splat(1.0), T::splat(MIN_SINE_SQUARED)) };
    let (ab, ac, bc) = (sub(b, a), sub(c, a), sub(c, b));
    let (ap, bp) = (sub(p, a), sub(p, b));
    let (aa, cc) = (dot(ab, ab), dot(ac, ac));
    let rim = edge(ap, ab, aa, zero, one).least(edge(ap, ac, cc, zero, one));
    let rim = rim.least(edge(bp, bc, dot(bc, bc), zero, one));
    let n = cross(ab, ac);
    let nn = dot(n, n);
    let left_of_ab = dot(n, cross(ab, ap)).at_least(zero);
    let left_of_bc = dot(n, cross(bc, bp)).at_least(zero);
    let left_of_ca = dot(n, cross(ap, ac)).at_least(zero);
    let wide = nn.above(thin * aa * cc);
    let h = dot(ap, n);
    let plane = (h * h / nn).least(rim);
    let inside = T::both(T::both(left_of_ab, left_of_bc), T::both(left_of_ca, wide));
    (T::select(inside, plane, rim), T::select(inside, h, zero), T::select(wide, zero, one))
}

/// Squared distance, and height as in [`squared`], of plain points.
pub fn squared_distance(p: &Point, t: &[Point; 3]) -> (f64, f64) {
    // SAFETY: `f64` needs no special instructions.
    let (distance, height, thin) = unsafe { squared::<f64>(*p, *t) };
    // For a thin triangle this is the distance from its rim.
    if thin == 0.0 { (distance, height) } else { thin::squared(p, t, distance) }
}

/// Whether the normal of a triangle is a matter for [`thin`].
fn is_thin([a, b, c]: &[Point; 3]) -> bool {
    let (ab, ac) = (sub(*b, *a), sub(*c, *a));
    let n = cross(ab, ac);
    dot(n, n) <= MIN_SINE_SQUARED * dot(ab, ab) * dot(ac, ac)
}

/// The normal of a triangle, its length twice the area.
pub(super) fn normal(t: &[Point; 3]) -> Point {
    let [a, b, c] = *t;
    if is_thin(t) { thin::normal(t) } else { cross(sub(b, a), sub(c, a)) }
}

/// The part of a face that a closest point lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// The inside.
    Face,
    /// Edge `i` runs from corner `i` to corner `i + 1` (mod 3); its ends excluded.
    Edge(u8),
    /// Corner `i`.
    Vertex(u8),
}

/// A point of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointOfTriangle {
    /// Where.
    pub point: Point,
    /// Weights of the corners: the point is their weighted mean.
    pub barycentric: [f64; 3],
    /// The feature that it lies on.
    pub feature: Feature,
}

/// The point of triangle `t` closest to `p` where the search has found it inside, at this height and squared distance. `None`
/// where it lies on the rim or must be looked for by [`closest_point`], which finds the same.
#[inline(always)]
pub(super) fn foot(p: &Point, t: &[Point; 3], height: f64, distance_squared: f64) -> Option<Point> {
    let [a, b, c] = *t;
    let (ab, ac) = (sub(b, a), sub(c, a));
    let n = cross(ab, ac);
    let nn = dot(n, n);
    let inside = height != 0.0
        && nn > MIN_SINE_SQUARED * dot(ab, ab) * dot(ac, ac)
        && height * height / nn <= distance_squared;
    let s = height / nn;
    inside.then(|| [p[0] - s * n[0], p[1] - s * n[1], p[2] - s * n[2]])
}

/// The point of triangle `t` closest to `p`: the place whose distance [`squared_distance`] reports.
///
/// Scalar; called once per answer, not in the search.
pub fn closest_point(p: &Point, t: &[Point; 3]) -> PointOfTriangle {
    let [a, b, c] = *t;
    let (ab, ac, bc) = (sub(b, a), sub(c, a), sub(c, b));
    let (ap, bp) = (sub(*p, a), sub(*p, b));
    let (mut least, mut place) = (
        f64::INFINITY,
        PointOfTriangle { point: a, barycentric: [1.0, 0.0, 0.0], feature: Feature::Vertex(0) },
    );
    // Edge 2 is measured from corner 0 to corner 2, as in `squared`.
    for (i, from, to, v, w) in [(0, 0, 1, ab, ap), (2, 0, 2, ac, ap), (1, 1, 2, bc, bp)] {
        let s = along(w, v, dot(v, v), 0.0, 1.0);
        let d = aside(w, v, s);
        if d < least {
            let mut barycentric = [0.0; 3];
            (barycentric[from], barycentric[to]) = (1.0 - s, s);
            (least, place) = match s {
                0.0 => {
                    (d, PointOfTriangle { point: t[from], barycentric, feature: Feature::Vertex(from as u8) })
                }
                1.0 => (d, PointOfTriangle { point: t[to], barycentric, feature: Feature::Vertex(to as u8) }),
                _ => {
                    let point = std::array::from_fn(|k| t[from][k] + s * v[k]);
                    (d, PointOfTriangle { point, barycentric, feature: Feature::Edge(i) })
                }
            };
        }
    }
    let inside = |point, [wa, wb, wc]: [f64; 3]| {
        let sum = wa + wb + wc;
        PointOfTriangle { point, barycentric: [wa / sum, wb / sum, wc / sum], feature: Feature::Face }
    };
    if is_thin(t) {
        return match thin::foot(p, t).filter(|foot| foot.height_squared < least) {
            Some(foot) => inside(std::array::from_fn(|k| p[k] - foot.normals * foot.normal[k]), foot.weights),
            None => place,
        };
    }
    let n = cross(ab, ac);
    let nn = dot(n, n);
    let [wc, wa, wb] = [dot(n, cross(ab, ap)), dot(n, cross(bc, bp)), dot(n, cross(ap, ac))];
    let h = dot(ap, n);
    if wa >= 0.0 && wb >= 0.0 && wc >= 0.0 && h * h / nn < least {
        let s = h / nn;
        place = inside(std::array::from_fn(|k| p[k] - s * n[k]), [wa, wb, wc]);
    }
    place
}

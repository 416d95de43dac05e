//! Distance from a point to a thin triangle, in twice the precision.
//!
//! The normal of a triangle is a difference of products. At an angle whose sine is `s`, double precision keeps it to 2^-53 / s
//! only. The height of a point over the plane is no better. From [`MIN_SINE_SQUARED`] on downwards the same is done with twice
//! the digits, so the distance stays as good as that to a segment. The brute-force twin and the search both come here.

use crate::num::double::Double;
use crate::space::{self, Point};

/// Square of the sine of the angle at the first corner below which a triangle is thin. There double precision would keep
/// the height to 2^-53 / 2^-10 of the distance from that corner.
pub const MIN_SINE_SQUARED: f64 = 1.0 / (1 << 20) as f64;

type Wide = [Double; 3];

fn between(a: &Point, b: &Point) -> Wide {
    std::array::from_fn(|k| Double::difference(a[k], b[k]))
}

fn dot(a: &Wide, b: &Wide) -> Double {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Wide, b: &Wide) -> Wide {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// The normal of a thin triangle, its length twice the area.
pub fn normal([a, b, c]: &[Point; 3]) -> Point {
    cross(&between(b, a), &between(c, a)).map(Double::value)
}

/// The foot of a point on the plane of a triangle, where it falls inside.
pub struct Foot {
    /// Square of the height over the plane.
    pub height_squared: f64,
    /// Height times the length of the normal.
    pub height: f64,
    /// Height over the length of the normal: the foot is that many normals from the point.
    pub normals: f64,
    /// The normal.
    pub normal: Point,
    /// Weights of the corners, which do not sum up to one.
    pub weights: [f64; 3],
}

/// The foot of `p`; `None` where it falls outside, or where the triangle has no area.
pub fn foot(p: &Point, [a, b, c]: &[Point; 3]) -> Option<Foot> {
    let (ab, ac, bc) = (between(b, a), between(c, a), between(c, b));
    let (ap, bp) = (between(p, a), between(p, b));
    let n = cross(&ab, &ac);
    let nn = dot(&n, &n);
    let weights = [cross(&bc, &bp), cross(&ap, &ac), cross(&ab, &ap)].map(|part| dot(&n, &part).value());
    if !(nn.value() > 0.0 && weights.iter().all(|w| *w >= 0.0)) {
        return None;
    }
    let h = dot(&ap, &n);
    let normals = h.over(nn);
    Some(Foot {
        height_squared: (h * normals).value(),
        height: h.value(),
        normals: normals.value(),
        normal: n.map(Double::value),
        weights,
    })
}

/// Whether double precision is enough to tell that [`foot`] finds none: some weight is negative by more than its rounding.
///
/// Nearly all triangles of a thin fan are dismissed here, which costs a fortieth. A difference of two numbers is off by `u`, so
/// a product of two differences by `3 u`. A component of a normal is off by `4 u` of its two products, and a weight by `11 u`
/// of the product of the four lengths. These lengths are sums of magnitudes; twice as much is allowed for. [`foot`] itself is
/// off by far less, so this changes no answer.
fn is_surely_outside(p: &Point, [a, b, c]: &[Point; 3]) -> bool {
    /// Bound of the rounding of a weight, as a share of the product of the four lengths: see above.
    const WEIGHT_ROUNDING: f64 = 11.0 * f64::EPSILON;
    // More than what products of these lengths lose at the lower end of the numbers.
    /// More than products of these lengths lose at the lower end of the numbers.
    const PRODUCT_UNDERFLOW: f64 = 1e-300;
    let size = |v: Point| v[0].abs() + v[1].abs() + v[2].abs();
    let (ab, ac, bc) = (space::minus(*b, *a), space::minus(*c, *a), space::minus(*c, *b));
    let (ap, bp) = (space::minus(*p, *a), space::minus(*p, *b));
    let n = space::cross(ab, ac);
    let margin = WEIGHT_ROUNDING * size(ab) * size(ac);
    [(bc, bp), (ap, ac), (ab, ap)]
        .iter()
        .any(|&(v, w)| space::dot(n, space::cross(v, w)) < -(margin * size(v) * size(w) + PRODUCT_UNDERFLOW))
}

/// Squared distance and height of `p`, as `triangle::squared` has them; `rim` is its squared distance to the nearest edge.
pub fn squared(p: &Point, t: &[Point; 3], rim: f64) -> (f64, f64) {
    if is_surely_outside(p, t) {
        return (rim, 0.0);
    }
    match foot(p, t) {
        Some(foot) if foot.height_squared < rim => (foot.height_squared, foot.height),
        Some(foot) => (rim, foot.height),
        None => (rim, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;
    use crate::space::{minus, plus, times};

    /// A dismissed triangle has no foot, however thin it is; and nearly all without a foot are dismissed.
    #[test]
    fn what_is_dismissed_has_no_foot() {
        let (random, mut outside, mut dismissed) = (&mut Random::new(3), 0, 0);
        for case in 0..40_000 {
            let thin = [1e-3, 1e-6, 1e-10, 1e-15, 1e-17][case % 5];
            let far = [0.0, 1.0, 1e6][case % 3];
            let mut place = || -> Point { std::array::from_fn(|_| far + random.unit()) };
            let (a, b) = (place(), place());
            let c = plus(plus(a, times(0.7, minus(b, a))), times(thin, minus(place(), a)));
            let p = if case % 2 == 0 { place() } else { plus(c, times(thin, minus(place(), a))) };
            let t = [a, b, c];
            let has_foot = foot(&p, &t).is_some();
            assert!(!(has_foot && is_surely_outside(&p, &t)), "{case} {p:?} {t:?}");
            if case % 5 < 2 && case % 3 < 2 && case % 2 == 0 {
                outside += usize::from(!has_foot);
                dismissed += usize::from(is_surely_outside(&p, &t));
            }
        }
        assert!(outside > 2000 && dismissed * 100 > outside * 95, "{dismissed} of {outside}");
    }

    /// Few triangles of a thin fan are left that have no foot, however many there are.
    #[test]
    fn of_a_fan_few_are_left() {
        let random = &mut Random::new(4);
        for n in [10_000, 100_000] {
            let at = |i: usize| {
                let turn = std::f64::consts::TAU * i as f64 / n as f64;
                [libm::cos(turn), libm::sin(turn), 0.0]
            };
            for _ in 0..20 {
                let p = [random.unit() - 0.5, random.unit() - 0.5, 2.0 * random.unit()];
                let fan = (0..n).map(|i| [[0.0, 0.0, 1.0], at(i), at(i + 1)]);
                let left: Vec<[Point; 3]> = fan.filter(|t| !is_surely_outside(&p, t)).collect();
                let feet = left.iter().filter(|t| foot(&p, t).is_some()).count();
                assert!(left.len() <= feet + 2, "{n} {p:?}: {} for {feet}", left.len());
            }
        }
    }
}

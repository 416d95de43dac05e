//! Analytic derivatives against automatic differentiation of the distances as a textbook writes them.

use super::dual::Dual;
use super::{Kind, Made};
use crate::fit::family::{Element, Family, slope};
use crate::fit::sample::Sample;
use crate::fit::unknown::Local;
use crate::fit::{circle, cone, cylinder, ellipse, line, plane, sphere, torus};
use crate::space::Point;

type Vector = [Dual; 3];

fn fixed(v: Point) -> Vector {
    v.map(Dual::fixed)
}
fn dot(a: Vector, b: Vector) -> Dual {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn added(a: Vector, s: Dual, b: Point) -> Vector {
    std::array::from_fn(|k| a[k] + s * Dual::fixed(b[k]))
}
fn unit(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// The element with its unknowns as numbers that carry derivatives: origin, first and third axis, sizes.
struct Loose {
    origin: Vector,
    u: Vector,
    w: Vector,
    size: [Dual; 2],
}

fn loose(element: &Element, unknowns: &[Local]) -> Loose {
    let [u, v, w] = element.pose.axes;
    let mut all = Loose {
        origin: fixed(element.pose.origin),
        u: fixed(u),
        w: fixed(w),
        size: element.size.map(Dual::fixed),
    };
    for (k, unknown) in unknowns.iter().enumerate() {
        let zero = Dual::unknown(0.0, k);
        match *unknown {
            Local::Shift(i) => all.origin = added(all.origin, zero, [u, v, w][i]),
            Local::Tilt(i) => all.w = added(all.w, zero, [u, v][i]),
            Local::Turn => all.u = added(all.u, zero, v),
            Local::Size(i) => all.size[i] = Dual::unknown(element.size[i], k),
        }
    }
    (all.u, all.w) = (unit(all.u), unit(all.w));
    all
}

/// Distance of `p`, by the definition of the element.
fn distance(kind: Kind, Loose { origin, u, w, size }: Loose, p: Point) -> Dual {
    let q: Vector = std::array::from_fn(|k| Dual::fixed(p[k]) - origin[k]);
    let far = dot(q, q).sqrt();
    let along = dot(q, w);
    let (x, y) = (dot(q, u), q[1] * u[0] - q[0] * u[1]);
    let off = || {
        let across: Vector = std::array::from_fn(|k| q[k] - along * w[k]);
        dot(across, across).sqrt()
    };
    let beside = |a: Dual, b: Dual| (a * a + b * b).sqrt();
    match kind {
        Kind::Line2 => y,
        Kind::Line => off(),
        Kind::Plane => along,
        Kind::Circle2 => beside(x, y) - size[0],
        Kind::Circle => beside(off() - size[0], along),
        Kind::Ellipse2 => ellipse_distance(size, x, y),
        Kind::Sphere => far - size[0],
        Kind::Cylinder => off() - size[0],
        Kind::Cone => off() * size[1].cos() - along * size[1].sin() - size[0],
        Kind::Torus => beside(off() - size[0], along) - size[1],
    }
}

/// Distance from the foot (a cos t, b sin t), where t solves the condition of a right angle.
fn ellipse_distance([a, b]: [Dual; 2], x: Dual, y: Dual) -> Dual {
    let square = |t: f64| (a.value * t.cos() - x.value).powi(2) + (b.value * t.sin() - y.value).powi(2);
    let turns = (0..4000).map(|k| f64::from(k) * std::f64::consts::TAU / 4000.0);
    let nearest = turns.min_by(|s, t| square(*s).total_cmp(&square(*t))).unwrap();
    let mut t = Dual::fixed(nearest);
    for _ in 0..5 {
        let (sin, cos) = (t.sin(), t.cos());
        let oblique = (b * b - a * a) * sin * cos + a * x * sin - b * y * cos;
        t = t - oblique / ((b * b - a * a) * (cos * cos - sin * sin) + a * x * cos + b * y * sin);
    }
    let (ex, ey) = (x - a * t.cos(), y - b * t.sin());
    let outside = (x.value / a.value).hypot(y.value / b.value) > 1.0;
    let length = (ex * ex + ey * ey).sqrt();
    if outside { length } else { -length }
}

fn check<const P: usize, F: Family<P>>(kind: Kind) {
    let made = Made { kind, count: 60, share: 0.8, noise: 2.0, seed: 21 };
    let points = made.points();
    let sample = Sample::new(&points).unwrap();
    let element = F::element(&made.shape(), &sample).unwrap();
    for &p in &points {
        let p: Point = sample.unit(p);
        let (found, analytic) = slope::<P, F>(element.size, element.pose.local(p));
        let told = made.shape().distance(sample.place(p)) * sample.scale;
        assert!((found - told).abs() < 1e-13, "{kind:?} {found} {told}");
        let wide: f64 = F::distance(element.size, element.pose.local(p));
        assert!((found - wide).abs() < 1e-15);
        let automatic = distance(kind, loose(&element, &F::LOCAL), p);
        assert!((found - automatic.value).abs() < 1e-13, "{kind:?} {found} {}", automatic.value);
        for k in 0..P {
            let error = (automatic.slope[k] - analytic[k]).abs();
            assert!(error < 1e-12 * (1.0 + analytic[k].abs()), "{kind:?} unknown {k}: {error:e}");
        }
    }
}

#[test]
fn derivatives_are_those_of_the_distances() {
    check::<2, line::Line2>(Kind::Line2);
    check::<4, line::Line>(Kind::Line);
    check::<3, plane::Plane>(Kind::Plane);
    check::<3, circle::Circle2>(Kind::Circle2);
    check::<6, circle::Circle>(Kind::Circle);
    check::<5, ellipse::Ellipse2>(Kind::Ellipse2);
    check::<4, sphere::Sphere>(Kind::Sphere);
    check::<5, cylinder::Cylinder>(Kind::Cylinder);
    check::<6, cone::Cone>(Kind::Cone);
    check::<7, torus::Torus>(Kind::Torus);
}

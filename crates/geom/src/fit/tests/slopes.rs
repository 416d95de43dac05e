//! Analytic derivatives against differences of the distances of moved elements.

use super::{Kind, Made};
use crate::fit::family::{Element, Family, slope};
use crate::fit::sample::Sample;
use crate::fit::{circle, cone, cylinder, ellipse, line, plane, sphere, torus};
use crate::space::Point;

fn check<const P: usize, F: Family<P>>(kind: Kind) {
    let made = Made { kind, count: 60, share: 0.8, noise: 2.0, seed: 21 };
    let points = made.points();
    let sample = Sample::new(&points).unwrap();
    let element = F::element(&made.shape(), &sample).unwrap();
    for &p in &points {
        let p: Point = sample.unit(p);
        let at = |e: &Element| slope::<P, F>(e.size, e.pose.local(p));
        let (distance, analytic) = at(&element);
        let told = made.shape().distance(sample.place(p)) * sample.scale;
        assert!((distance - told).abs() < 1e-13, "{kind:?} {distance} {told}");
        let wide: f64 = F::distance(element.size, element.pose.local(p));
        assert!((distance - wide).abs() < 1e-15);
        for k in 0..P {
            // Richardson: the error of the differences falls with the fourth power of the step.
            let difference = |h: f64| {
                let step = |h: f64| std::array::from_fn(|i| if i == k { h } else { 0.0 });
                let (more, less) = (
                    element.moved(&F::LOCAL, &step(h)).unwrap(),
                    element.moved(&F::LOCAL, &step(-h)).unwrap(),
                );
                (at(&more).0 - at(&less).0) / (2.0 * h)
            };
            let numeric = (4.0 * difference(2e-5) - difference(4e-5)) / 3.0;
            assert!(
                (numeric - analytic[k]).abs() < 1e-9 * (1.0 + analytic[k].abs()),
                "{kind:?} unknown {k}: {numeric} {}",
                analytic[k]
            );
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

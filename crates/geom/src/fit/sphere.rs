//! Spheres.

use super::family::{Element, Family, Rows};
use super::round::{MIN_DIVISOR, round_starts};
use super::sample::Sample;
use super::scatter::Scatter;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::space::Point;

/// Sphere about the origin of its frame.
pub(super) struct Sphere;

impl Family<4> for Sphere {
    const LOCAL: [Local; 4] = [Local::Shift(0), Local::Shift(1), Local::Shift(2), Local::Size(0)];

    #[inline(always)]
    fn rows(size: [f64; 2], [x, y, z]: Point, rows: &mut impl Rows<4>) {
        let rho = (x * x + y * y + z * z).sqrt();
        let inverse = -1.0 / rho.max(MIN_DIVISOR);
        rows.row(rho - size[0], [x * inverse, y * inverse, z * inverse, -1.0]);
    }
    #[inline(always)]
    fn distance(size: [f64; 2], [x, y, z]: Point) -> f64 {
        (x * x + y * y + z * z).sqrt() - size[0]
    }
    fn sound(size: [f64; 2]) -> bool {
        size[0] > 0.0
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let scatter = Scatter::of(points);
        let axes = [scatter.axes[1], scatter.axes[2], scatter.axes[0]];
        round_starts::<3>(points, &scatter)
            .into_iter()
            .map(|(center, radius)| Element { pose: Pose { origin: center, axes }, size: [radius, 0.0] })
            .collect()
    }
    fn settled(element: Element) -> Element {
        element
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        Shape::Sphere { center: sample.place(element.pose.origin), radius: element.size[0] / sample.scale }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Sphere { center, radius } = *shape else { return None };
        let pose = Pose::along(sample.unit(center), [0.0, 0.0, 1.0]);
        Some(Element { pose, size: [radius * sample.scale, 0.0] })
    }
}

//! Circles, in the plane and in space.

use super::family::{Element, Family, Rows};
use super::line::flat;
use super::round::{MIN_DIVISOR, round_starts};
use super::sample::Sample;
use super::scatter::Scatter;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::space::{Point, unit};

/// Circle in the plane z = 0.
pub(super) struct Circle2;

impl Family<3> for Circle2 {
    const LOCAL: [Local; 3] = [Local::Shift(0), Local::Shift(1), Local::Size(0)];

    #[inline(always)]
    fn rows(size: [f64; 2], [x, y, _]: Point, rows: &mut impl Rows<3>) {
        let rho = (x * x + y * y).sqrt();
        let inverse = 1.0 / rho.max(MIN_DIVISOR);
        rows.row(rho - size[0], [-(x * inverse), -(y * inverse), -1.0]);
    }
    #[inline(always)]
    fn distance(size: [f64; 2], [x, y, _]: Point) -> f64 {
        (x * x + y * y).sqrt() - size[0]
    }
    fn sound(size: [f64; 2]) -> bool {
        size[0] > 0.0
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let points: Vec<Point> = points.iter().map(|&p| flat(p)).collect();
        let scatter = Scatter::flat(&points);
        round_starts::<2>(&points, &scatter)
            .into_iter()
            .map(|(center, radius)| Element {
                pose: Pose::flat(center, [1.0, 0.0, 0.0]),
                size: [radius, 0.0],
            })
            .collect()
    }
    fn settled(element: Element) -> Element {
        element
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        Shape::Circle2 {
            center: flat(sample.place(element.pose.origin)),
            radius: element.size[0] / sample.scale,
        }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Circle2 { center, radius } = *shape else { return None };
        let pose = Pose::flat(flat(sample.unit(center)), [1.0, 0.0, 0.0]);
        Some(Element { pose, size: [radius * sample.scale, 0.0] })
    }
}

/// Circle in space: in the first two axes of its frame.
pub(super) struct Circle;

impl Family<6> for Circle {
    const LOCAL: [Local; 6] =
        [Local::Shift(0), Local::Shift(1), Local::Shift(2), Local::Tilt(0), Local::Tilt(1), Local::Size(0)];
    const SIGNED: bool = false;

    #[inline(always)]
    fn rows(size: [f64; 2], [x, y, z]: Point, rows: &mut impl Rows<6>) {
        let rho = (x * x + y * y).sqrt();
        let inverse = 1.0 / rho.max(MIN_DIVISOR);
        let (nu, nv) = (x * inverse, y * inverse);
        rows.row(rho - size[0], [-nu, -nv, 0.0, -(z * nu), -(z * nv), -1.0]);
        rows.row(z, [0.0, 0.0, -1.0, x, y, 0.0]);
    }
    #[inline(always)]
    fn distance(size: [f64; 2], [x, y, z]: Point) -> f64 {
        let e = (x * x + y * y).sqrt() - size[0];
        (e * e + z * z).sqrt()
    }
    fn sound(size: [f64; 2]) -> bool {
        size[0] > 0.0
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let scatter = Scatter::of(points);
        // The plane is nearly always the flattest; a short noisy arc may have it upright.
        (0..2)
            .flat_map(|normal| {
                let frame = Pose::toward(scatter.mean, scatter.axes[normal], scatter.axes[2]);
                let within: Vec<Point> = points.iter().map(|&p| flat(frame.local(p))).collect();
                round_starts::<2>(&within, &Scatter::flat(&within)).into_iter().map(move |(c, radius)| {
                    let pose = frame.moved([c[0], c[1], 0.0], [0.0; 2], 0.0);
                    Element { pose, size: [radius, 0.0] }
                })
            })
            .collect()
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        Shape::Circle {
            center: sample.place(element.pose.origin),
            normal: element.pose.axes[2],
            radius: element.size[0] / sample.scale,
        }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Circle { center, normal, radius } = *shape else { return None };
        let (w, _) = unit(normal)?;
        Some(Element { pose: Pose::along(sample.unit(center), w), size: [radius * sample.scale, 0.0] })
    }
}

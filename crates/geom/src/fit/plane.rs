//! Planes.

use super::family::{Element, Family, Rows};
use super::sample::Sample;
use super::scatter::Scatter;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::space::{Point, unit};

/// Plane: the first two axes of its frame.
pub(super) struct Plane;

impl Family<3> for Plane {
    const LOCAL: [Local; 3] = [Local::Shift(2), Local::Tilt(0), Local::Tilt(1)];
    const FREE: &'static [usize] = &[0, 1];

    #[inline(always)]
    fn rows(_: [f64; 2], [x, y, z]: Point, rows: &mut impl Rows<3>) {
        rows.row(z, [-1.0, x, y]);
    }
    #[inline(always)]
    fn distance(_: [f64; 2], q: Point) -> f64 {
        q[2]
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let scatter = Scatter::of(points);
        // With the longest direction as an axis the two tilts do not disturb each other.
        let pose = Pose::toward(scatter.mean, scatter.axes[0], scatter.axes[2]);
        vec![Element { pose, size: [0.0; 2] }]
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        let point = sample.place(element.foot(sample.station, Self::FREE));
        Shape::Plane { point, normal: element.pose.axes[2] }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Plane { point, normal } = *shape else { return None };
        let (w, _) = unit(normal)?;
        let mut pose = Pose::along(sample.unit(point), w);
        // A point far away in the plane would cost digits.
        let foot = pose.local([0.0; 3]);
        pose = pose.moved([foot[0], foot[1], 0.0], [0.0; 2], 0.0);
        Some(Element { pose, size: [0.0; 2] })
    }
}

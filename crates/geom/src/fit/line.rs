//! Straight lines, in the plane and in space.

use super::family::{Element, Family, Rows};
use super::sample::Sample;
use super::scatter::Scatter;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::space::{Point, unit};

/// Line in the plane z = 0: the first axis of its frame.
pub(super) struct Line2;

impl Family<2> for Line2 {
    const LOCAL: [Local; 2] = [Local::Shift(1), Local::Turn];
    const FREE: &'static [usize] = &[0];

    #[inline(always)]
    fn rows(_: [f64; 2], [x, y, _]: Point, rows: &mut impl Rows<2>) {
        rows.row(y, [-1.0, -x]);
    }
    #[inline(always)]
    fn distance(_: [f64; 2], q: Point) -> f64 {
        q[1]
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let scatter = Scatter::flat(points);
        vec![Element { pose: Pose::flat(scatter.mean, scatter.axes[2]), size: [0.0; 2] }]
    }
    fn settled(element: Element) -> Element {
        element.facing_up(0)
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        let direction = element.pose.axes[0];
        let point = flat(sample.place(element.foot(sample.station, Self::FREE)));
        Shape::Line2 { point, direction }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Line2 { point, direction } = *shape else { return None };
        let (u, _) = unit(flat(direction))?;
        Some(Element { pose: Pose::flat(flat(sample.unit(point)), u), size: [0.0; 2] })
    }
}

/// Line in space: the third axis of its frame.
pub(super) struct Line;

impl Family<4> for Line {
    const LOCAL: [Local; 4] = [Local::Shift(0), Local::Shift(1), Local::Tilt(0), Local::Tilt(1)];
    const SIGNED: bool = false;
    const FREE: &'static [usize] = &[2];

    #[inline(always)]
    fn rows(_: [f64; 2], [x, y, z]: Point, rows: &mut impl Rows<4>) {
        rows.row(x, [-1.0, 0.0, -z, 0.0]);
        rows.row(y, [0.0, -1.0, 0.0, -z]);
    }
    #[inline(always)]
    fn distance(_: [f64; 2], [x, y, _]: Point) -> f64 {
        (x * x + y * y).sqrt()
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let scatter = Scatter::of(points);
        vec![Element { pose: Pose::along(scatter.mean, scatter.axes[2]), size: [0.0; 2] }]
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        Shape::Line {
            point: sample.place(element.foot(sample.station, Self::FREE)),
            direction: element.pose.axes[2],
        }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Line { point, direction } = *shape else { return None };
        let (w, _) = unit(direction)?;
        Some(Element { pose: Pose::along(sample.unit(point), w), size: [0.0; 2] }.footed([0.0; 3]))
    }
}

/// `p` without its height.
pub(super) fn flat(p: Point) -> Point {
    [p[0], p[1], 0.0]
}

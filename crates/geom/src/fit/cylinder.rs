//! Right circular cylinders.

use super::family::{Element, Family, Rows};
use super::revolution::{Powers, Profile};
use super::round::MIN_DIVISOR;
use super::sample::Sample;
use super::scatter::Scatter;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::space::{Point, unit};

/// Cylinder about the third axis of its frame.
pub(super) struct Cylinder;

impl Family<5> for Cylinder {
    const LOCAL: [Local; 5] =
        [Local::Shift(0), Local::Shift(1), Local::Tilt(0), Local::Tilt(1), Local::Size(0)];
    const FREE: &'static [usize] = &[2];

    #[inline(always)]
    fn rows(size: [f64; 2], [x, y, z]: Point, rows: &mut impl Rows<5>) {
        let rho = (x * x + y * y).sqrt();
        let inverse = -1.0 / rho.max(MIN_DIVISOR);
        let (nu, nv) = (x * inverse, y * inverse);
        rows.row(rho - size[0], [nu, nv, z * nu, z * nv, -1.0]);
    }
    #[inline(always)]
    fn distance(size: [f64; 2], [x, y, _]: Point) -> f64 {
        (x * x + y * y).sqrt() - size[0]
    }
    fn sound(size: [f64; 2]) -> bool {
        size[0] > 0.0
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let principal = Scatter::of(points).axes;
        Powers::of(points)
            .axes(Profile::Constant, &principal, 6)
            .into_iter()
            .filter(|axis| axis.radius_squared > 0.0)
            .map(|axis| Element { pose: axis.pose, size: [axis.radius_squared.sqrt(), 0.0] }.footed([0.0; 3]))
            .collect()
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        Shape::Cylinder {
            point: sample.place(element.foot(sample.station, Self::FREE)),
            direction: element.pose.axes[2],
            radius: element.size[0] / sample.scale,
        }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Cylinder { point, direction, radius } = *shape else { return None };
        let (w, _) = unit(direction)?;
        let pose = Pose::along(sample.unit(point), w);
        Some(Element { pose, size: [radius * sample.scale, 0.0] }.footed([0.0; 3]))
    }
}

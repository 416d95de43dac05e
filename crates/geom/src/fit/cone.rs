//! Right circular cones.

use super::family::{Element, Family, Rows};
use super::revolution::{Powers, Profile};
use super::round::{TINY, least_squares};
use super::sample::Sample;
use super::scatter::Scatter;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::space::{Point, plus, times, unit};
use std::f64::consts::FRAC_PI_2;

/// Cone about the third axis of its frame, opening along it. Its sizes are the distance of the origin from the
/// surface and the half angle: unlike radius and apex they stay finite from the cylinder to the plane.
pub(super) struct Cone;

impl Family<6> for Cone {
    const LOCAL: [Local; 6] =
        [Local::Shift(0), Local::Shift(1), Local::Tilt(0), Local::Tilt(1), Local::Size(0), Local::Size(1)];
    const FREE: &'static [usize] = &[2];

    #[inline(always)]
    fn rows(size: [f64; 2], [x, y, z]: Point, rows: &mut impl Rows<6>) {
        let (sin, cos) = libm::sincos(size[1]);
        let rho = (x * x + y * y).sqrt();
        let inverse = 1.0 / rho.max(TINY);
        let (nu, nv) = (cos * x * inverse, cos * y * inverse);
        rows.row(
            rho * cos - z * sin - size[0],
            [-nu, -nv, -(z * nu) - x * sin, -(z * nv) - y * sin, -1.0, -(rho * sin) - z * cos],
        );
    }
    #[inline(always)]
    fn distance(size: [f64; 2], [x, y, z]: Point) -> f64 {
        let (sin, cos) = libm::sincos(size[1]);
        (x * x + y * y).sqrt() * cos - z * sin - size[0]
    }
    fn sound(size: [f64; 2]) -> bool {
        size[0].is_finite() && size[1].abs() < FRAC_PI_2
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let principal = Scatter::of(points).axes;
        let powers = Powers::of(points);
        let mut axes = powers.axes(Profile::Parabola, &principal, 6);
        axes.extend(powers.axes(Profile::Constant, &principal, 3));
        axes.into_iter()
            .filter_map(|axis| {
                // The generator: a straight line through distance from the axis over height.
                let line = least_squares(points.iter().map(|&p| {
                    let [x, y, z] = axis.pose.local(p);
                    (vec![1.0, z], libm::hypot(x, y))
                }))?;
                let angle = libm::atan(line[1]);
                let element = Element { pose: axis.pose, size: [line[0] * libm::cos(angle), angle] };
                Some(Cone::settled(refooted(element, [0.0; 3])))
            })
            .collect()
    }
    fn settled(element: Element) -> Element {
        if element.size[1] < 0.0 {
            let mut other = element.reversed(2);
            other.size[1] = -other.size[1];
            return other;
        }
        element
    }
    fn answer([_, half_angle]: [f64; 2]) -> [f64; 6] {
        [0.0, 0.0, 0.0, 0.0, -libm::sin(half_angle), 0.0]
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        let element = refooted(*element, sample.station);
        let [distance, half_angle] = element.size;
        let direction = element.pose.axes[2];
        let apex = plus(element.pose.origin, times(-distance / libm::sin(half_angle), direction));
        Shape::Cone {
            apex: sample.place(apex),
            direction,
            half_angle,
            point: sample.place(element.pose.origin),
            radius: distance / libm::cos(half_angle) / sample.scale,
        }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Cone { direction, half_angle, point, radius, .. } = *shape else { return None };
        let (w, _) = unit(direction)?;
        let pose = Pose::along(sample.unit(point), w);
        let size = [radius * sample.scale * libm::cos(half_angle), half_angle];
        Some(refooted(Element { pose, size }, [0.0; 3]))
    }
}

/// The same cone with its origin at the foot of `place`.
fn refooted(element: Element, place: Point) -> Element {
    let height = element.pose.local(place)[2];
    let mut moved = element.footed(place);
    moved.size[0] += height * libm::sin(element.size[1]);
    moved
}

//! Right circular cones.

use super::family::{Element, Family, Rows};
use super::osculating::{self, refooted};
use super::round::MIN_DIVISOR;
use super::sample::Sample;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::space::{Point, minus, norm, plus, times, unit};
use std::f64::consts::{FRAC_PI_2, PI};

/// Cone about the third axis of its frame, opening along it. Its sizes are the distance of the origin from the surface and the
/// half angle. Unlike radius and apex they stay finite from the cylinder to the plane. On the way there an angle may pass
/// through either. Below zero the cone opens against its axis. Beyond a right angle it is the cone on the other side of the
/// plane with its inside out. [`Family::settled`] writes both as they are told.
///
/// A cone ends at its apex. Beyond it the apex is the nearest place.
pub(super) struct Cone;

impl Family<6> for Cone {
    const LOCAL: [Local; 6] =
        [Local::Shift(0), Local::Shift(1), Local::Tilt(0), Local::Tilt(1), Local::Size(0), Local::Size(1)];
    const FREE: &'static [usize] = &[2];

    #[inline(always)]
    fn rows(size: [f64; 2], [x, y, z]: Point, rows: &mut impl Rows<6>) {
        let (sin, cos) = libm::sincos(size[1]);
        let square = x * x + y * y;
        let rho = square.sqrt();
        if is_beyond(size, (sin, cos), rho, z) {
            let apex = -size[0] / sin;
            let height = z - apex;
            let far = cos.signum() * (square + height * height).sqrt();
            let inverse = 1.0 / far.abs().max(MIN_DIVISOR).copysign(far);
            let (nu, nv, nw) = (x * inverse, y * inverse, height * inverse / sin);
            rows.row(far, [-nu, -nv, -(apex * nu), -(apex * nv), nw, apex * cos * nw]);
            return;
        }
        let inverse = 1.0 / rho.max(MIN_DIVISOR);
        let (nu, nv) = (cos * x * inverse, cos * y * inverse);
        rows.row(
            rho * cos - z * sin - size[0],
            [-nu, -nv, -(z * nu) - x * sin, -(z * nv) - y * sin, -1.0, -(rho * sin) - z * cos],
        );
    }
    #[inline(always)]
    fn distance(size: [f64; 2], [x, y, z]: Point) -> f64 {
        let (sin, cos) = libm::sincos(size[1]);
        let square = x * x + y * y;
        let rho = square.sqrt();
        let height = z + size[0] / sin;
        let beyond = cos.signum() * (square + height * height).sqrt();
        if is_beyond(size, (sin, cos), rho, z) { beyond } else { rho * cos - z * sin - size[0] }
    }
    fn sound(size: [f64; 2]) -> bool {
        size[0].is_finite() && size[1].abs() < PI
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        osculating::cones::<Cone>(points)
    }
    /// With its apex at the point next to it.
    fn at_corner(element: &Element, sample: &Sample, within: f64) -> Option<Element> {
        let below = -element.size[0] / libm::sin(element.size[1]);
        let apex = plus(element.pose.origin, times(below, element.pose.axes[2]));
        let far = |p: &Point| norm(minus(*p, apex));
        let points: Vec<Point> = sample.units().collect();
        let tip = points.iter().min_by(|p, q| far(p).total_cmp(&far(q)))?;
        (far(tip) <= within).then(|| osculating::with_apex::<Cone>(*tip, &points))
    }
    fn settled(mut element: Element) -> Element {
        if element.size[1] < 0.0 {
            element = element.reversed(2);
            element.size[1] = -element.size[1];
        }
        if element.size[1] > FRAC_PI_2 {
            element = element.reversed(2);
            element.size = [-element.size[0], PI - element.size[1]];
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

/// Whether the apex is the nearest place: the foot on the generator, by its height above the apex times the sine, is none.
#[inline(always)]
fn is_beyond(size: [f64; 2], (sin, cos): (f64, f64), rho: f64, z: f64) -> bool {
    (rho * sin + z * cos) * sin + size[0] * cos < 0.0
}

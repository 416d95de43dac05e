//! Ellipses in the plane.

use super::family::{Element, Family, Rows};
use super::line::flat;
use super::round::least_squares;
use super::sample::Sample;
use super::scatter::Scatter;
use super::unknown::Local;
use crate::frame::Pose;
use crate::shape::Shape;
use crate::shape::ellipse::{Foot, foot};
use crate::space::{Point, plus, times, unit};

/// Ellipse in the plane z = 0; its half axes lie along the first two axes of its frame.
pub(super) struct Ellipse2;

impl Family<5> for Ellipse2 {
    const LOCAL: [Local; 5] = [Local::Shift(0), Local::Shift(1), Local::Turn, Local::Size(0), Local::Size(1)];

    #[inline(always)]
    fn rows(size: [f64; 2], [x, y, _]: Point, rows: &mut impl Rows<5>) {
        let Foot { cos, sin, normal: [nx, ny], distance } = foot(size, x, y);
        rows.row(distance, [-nx, -ny, nx * y - ny * x, -(nx * cos), -(ny * sin)]);
    }
    #[inline(always)]
    fn distance(size: [f64; 2], q: Point) -> f64 {
        foot(size, q[0], q[1]).distance
    }
    fn sound(size: [f64; 2]) -> bool {
        size.iter().all(|x| *x > 0.0 && x.is_finite())
    }
    fn starts(points: &[Point]) -> Vec<Element> {
        let scatter = Scatter::flat(points);
        let spread = Pose::flat(scatter.mean, scatter.axes[2]);
        // Points all round an ellipse have variances of half the squares of its half axes.
        let covered = [2.0 * scatter.variance[2], 2.0 * scatter.variance[1]].map(f64::sqrt);
        let mut starts = vec![Element { pose: spread, size: covered }];
        starts.extend(conic(points));
        starts.retain(|element| Ellipse2::sound(element.size));
        starts
    }
    fn settled(mut element: Element) -> Element {
        if element.size[1] > element.size[0] {
            let [u, v, w] = element.pose.axes;
            element.pose.axes = [v, times(-1.0, u), w];
            element.size.swap(0, 1);
        }
        element.facing_up(0)
    }
    fn shape(element: &Element, sample: &Sample) -> Shape {
        Shape::Ellipse2 {
            center: flat(sample.place(element.pose.origin)),
            direction: element.pose.axes[0],
            major_radius: element.size[0] / sample.scale,
            minor_radius: element.size[1] / sample.scale,
        }
    }
    fn element(shape: &Shape, sample: &Sample) -> Option<Element> {
        let Shape::Ellipse2 { center, direction, major_radius, minor_radius } = *shape else { return None };
        let (u, _) = unit(flat(direction))?;
        let size = [major_radius * sample.scale, minor_radius * sample.scale];
        Some(Element { pose: Pose::flat(flat(sample.unit(center)), u), size })
    }
}

/// The conic x² + y² + a(x² − y²) + 2bxy + … nearest in the algebraic sense, where it is an ellipse. Written
/// so, the answer turns with the points.
fn conic(points: &[Point]) -> Option<Element> {
    let x = least_squares(points.iter().map(|p| {
        let (x, y) = (p[0], p[1]);
        (vec![x * x - y * y, 2.0 * x * y, x, y, 1.0], -(x * x + y * y))
    }))?;
    let [a, b, d, e, f] = x[..] else { return None };
    let (xx, xy, yy) = (1.0 + a, b, 1.0 - a);
    let det = xx * yy - xy * xy;
    if det <= 0.0 {
        return None;
    }
    let center = [-(yy * d - xy * e) / (2.0 * det), -(xx * e - xy * d) / (2.0 * det), 0.0];
    let level = -(f + 0.5 * (d * center[0] + e * center[1]));
    let away = libm::hypot(a, b);
    // The eigenvalue 1 − away belongs to the longer half axis.
    let angle = 0.5 * libm::atan2(b, a) + std::f64::consts::FRAC_PI_2;
    let size = [level / (1.0 - away), level / (1.0 + away)].map(f64::sqrt);
    let pose = Pose::flat(plus(center, [0.0; 3]), [libm::cos(angle), libm::sin(angle), 0.0]);
    Ellipse2::sound(size).then_some(Element { pose, size })
}

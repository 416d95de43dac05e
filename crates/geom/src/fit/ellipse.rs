//! Ellipses in the plane.

use super::family::{Element, Family, Rows};
use super::line::flat;
use super::pose::{Local, Pose};
use super::round::{TINY, least_squares};
use super::sample::Sample;
use super::scatter::Scatter;
use super::shape::Shape;
use crate::space::{Point, plus, times, unit};

/// Ellipse in the plane z = 0; its half axes lie along the first two axes of its frame.
pub(super) struct Ellipse2;

/// The point of the ellipse nearest to a point: cosine and sine of its eccentric angle, the outward unit
/// normal there, and the signed distance.
struct Foot {
    cos: f64,
    sin: f64,
    normal: [f64; 2],
    distance: f64,
}

/// Foot of (x, y). The search steps along the circle of curvature (A. Chou, "A simple method for distance to an
/// ellipse", 2017, a variant of B. Maisonobe's), in the first quadrant, a fixed number of times: the last steps
/// change nothing.
#[inline(always)]
fn foot([a, b]: [f64; 2], x: f64, y: f64) -> Foot {
    let (px, py) = (x.abs(), y.abs());
    let (ea, eb) = ((a * a - b * b) / a, (b * b - a * a) / b);
    let mut cos = std::f64::consts::FRAC_1_SQRT_2;
    let mut sin = cos;
    for _ in 0..STEPS {
        let (ex, ey) = (ea * cos * cos * cos, eb * sin * sin * sin);
        let (rx, ry) = (a * cos - ex, b * sin - ey);
        let (qx, qy) = (px - ex, py - ey);
        let ratio = ((rx * rx + ry * ry) / (qx * qx + qy * qy).max(TINY)).sqrt();
        cos = ((qx * ratio + ex) / a).max(0.0);
        sin = ((qy * ratio + ey) / b).max(0.0);
        let length = 1.0 / (cos * cos + sin * sin).sqrt().max(TINY);
        (cos, sin) = (cos * length, sin * length);
    }
    // The outward normal (b cos, a sin) does not shrink with the distance: its sign is safe on the ellipse.
    let (nx, ny) = (b * cos, a * sin);
    let length = 1.0 / (nx * nx + ny * ny).sqrt();
    let (nx, ny) = (nx * length, ny * length);
    let distance = (px - a * cos) * nx + (py - b * sin) * ny;
    Foot { cos: cos.copysign(x), sin: sin.copysign(y), normal: [nx.copysign(x), ny.copysign(y)], distance }
}

/// Steps of the search. Each more than doubles the digits; long ellipses need the first few to come near.
const STEPS: usize = 12;

/// Signed distance of `q` from the ellipse with half axes `size` along the first two coordinates.
pub(super) fn distance(size: [f64; 2], q: Point) -> f64 {
    foot(size, q[0], q[1]).distance
}

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
    let away = a.hypot(b);
    // The eigenvalue 1 − away belongs to the longer half axis.
    let angle = 0.5 * b.atan2(a) + std::f64::consts::FRAC_PI_2;
    let size = [level / (1.0 - away), level / (1.0 + away)].map(f64::sqrt);
    let pose = Pose::flat(plus(center, [0.0; 3]), [angle.cos(), angle.sin(), 0.0]);
    Ellipse2::sound(size).then_some(Element { pose, size })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Least distance to ten thousand points of the ellipse, refined about the least.
    fn plain(size: [f64; 2], x: f64, y: f64) -> f64 {
        let at = |t: f64| (x - size[0] * t.cos()).hypot(y - size[1] * t.sin());
        let mut best = 0.0;
        let mut step = std::f64::consts::TAU / 10_000.0;
        for k in 0..10_000 {
            if at(f64::from(k) * step) < at(best) {
                best = f64::from(k) * step;
            }
        }
        while step > 1e-12 {
            for t in [best - step, best + step] {
                if at(t) < at(best) {
                    best = t;
                }
            }
            step *= 0.7;
        }
        at(best)
    }

    #[test]
    fn the_foot_is_the_nearest_point() {
        for size in [[2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [5.0, 0.5]] {
            for k in 0..60 {
                let angle = 0.37 * f64::from(k);
                for far in [0.7, 0.99, 1.0, 1.3, 4.0] {
                    let (x, y) = (far * size[0] * angle.cos(), far * size[1] * angle.sin());
                    let d = distance(size, [x, y, 0.0]);
                    assert!((d.abs() - plain(size, x, y)).abs() < 1e-9, "{size:?} {x} {y} {d}");
                    let outside = (x / size[0]).hypot(y / size[1]) > 1.0;
                    assert!(d.abs() < 1e-12 || (d > 0.0) == outside);
                }
            }
        }
    }
}

//! The point of an ellipse nearest to a given point.

use crate::space::Point;

/// The point of the ellipse nearest to a point: cosine and sine of its eccentric angle, the outward unit
/// normal there, and the signed distance.
pub(crate) struct Foot {
    pub(crate) cos: f64,
    pub(crate) sin: f64,
    pub(crate) normal: [f64; 2],
    pub(crate) distance: f64,
}

/// Foot of (x, y). The search steps along the circle of curvature in the first quadrant, a fixed number of times: the last
/// steps change nothing. (A. Chou, "A simple method for distance to an ellipse", 2017, a variant of B. Maisonobe's.)
#[inline(always)]
pub(crate) fn foot([a, b]: [f64; 2], x: f64, y: f64) -> Foot {
    let (px, py) = (x.abs(), y.abs());
    let (ea, eb) = ((a * a - b * b) / a, (b * b - a * a) / b);
    let mut cos = std::f64::consts::FRAC_1_SQRT_2;
    let mut sin = cos;
    for _ in 0..ELLIPSE_FOOT_STEPS {
        let (ex, ey) = (ea * cos * cos * cos, eb * sin * sin * sin);
        let (rx, ry) = (a * cos - ex, b * sin - ey);
        let (qx, qy) = (px - ex, py - ey);
        let ratio = ((rx * rx + ry * ry) / (qx * qx + qy * qy).max(f64::MIN_POSITIVE)).sqrt();
        cos = ((qx * ratio + ex) / a).max(0.0);
        sin = ((qy * ratio + ey) / b).max(0.0);
        let length = 1.0 / (cos * cos + sin * sin).sqrt().max(f64::MIN_POSITIVE);
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
const ELLIPSE_FOOT_STEPS: usize = 12;

/// Signed distance of `q` from the ellipse with half axes `size` along the first two coordinates.
pub(crate) fn distance(size: [f64; 2], q: Point) -> f64 {
    foot(size, q[0], q[1]).distance
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

//! Starts for short pieces of a torus: tubes that are hardly bent.
//!
//! Only the bend of its tube tells the axis of a torus of which little is seen. A search from a wrong axis ends in a wrong
//! minimum. The tube itself is well known: it is nearly a cylinder. So a cylinder is taken first and its axis bent then. The
//! curvature of the spine, a vector across it, is one more pair of unknowns that may be zero, which a ring's radius may not.

use super::family::Element;
use crate::frame::Pose;
use crate::num::dense::{cholesky, cholesky_solve};
use crate::space::{Point, cross, minus, plus, times};

/// A tube about an arc: it passes through the origin of the frame along the third axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tube {
    frame: Pose,
    radius: f64,
    /// Curvature vector of the arc, in the first two axes.
    bend: [f64; 2],
}

/// Curvature in the unit frame below which a spine counts as straight: a ring has a radius.
const MIN_BENT_CURVATURE: f64 = 1e-3;
/// Steps of improvement.
const BEND_STEPS: usize = 6;

impl Tube {
    /// The tube near the straight one about the third axis of `frame`, bent to fit the points. Steps of Gauss and Newton follow
    /// as long as they bring it nearer.
    pub(super) fn near(frame: Pose, radius: f64, points: &[Point]) -> Tube {
        let mut best = Tube { frame, radius, bend: [0.0; 2] };
        let Some((mut square, mut step)) = best.step(points) else { return best };
        for _ in 0..BEND_STEPS {
            let next = best.moved(&step);
            let Some((less, further)) = next.step(points).filter(|n| next.radius > 0.0 && n.0 < square)
            else {
                break;
            };
            (best, square, step) = (next, less, further);
        }
        best
    }

    /// Sum of the squared distances and the step that would lead to the least one, were the distances linear: shifts and tilts
    /// across, radius, bends. `None` where the points do not determine it.
    fn step(&self, points: &[Point]) -> Option<(f64, [f64; 7])> {
        let (mut normal, mut right, mut square) = ([[0.0; 7]; 7], [0.0; 7], 0.0);
        let (curvature, [tu, tv]) = self.curvature();
        for &p in points {
            let [x, y, z] = self.frame.local(p);
            // Toward the center of the arc, and across its plane.
            let (toward, aside) = (x * tu + y * tv, y * tu - x * tv);
            // From the center, and from there to the foot on the spine; lengths in radii of the arc.
            let short = 1.0 - curvature * toward;
            let far = libm::hypot(short, curvature * z);
            let (cos, sin) = (short / far, curvature * z / far);
            let within = (2.0 * toward - curvature * (toward * toward + z * z)) / (1.0 + far);
            let rho = libm::hypot(within, aside);
            let (nt, na) = if rho > 0.0 { (within / rho, aside / rho) } else { (0.0, 0.0) };
            let across = |t: f64| [t * tu - na * tv, t * tv + na * tu];
            let ([nu, nv], nw) = (across(nt * cos), -nt * sin);
            // How far the spine leaves its tangent for a unit of curvature.
            let bow = z * z / (far * (far + short));
            let [bu, bv] = across(nt).map(|n| n * bow);
            let off = rho - self.radius;
            let columns = [nu, nv, z * nu - x * nw, z * nv - y * nw, 1.0, bu, bv];
            square += off * off;
            for i in 0..7 {
                right[i] += columns[i] * off;
                for j in 0..7 {
                    normal[i][j] += columns[i] * columns[j];
                }
            }
        }
        let lower = cholesky(&normal)?;
        Some((square, cholesky_solve(&lower, &right)))
    }

    /// The curvature of the arc, and the direction toward its center; where it is straight, the first axis.
    fn curvature(&self) -> (f64, [f64; 2]) {
        let curvature = libm::hypot(self.bend[0], self.bend[1]);
        (curvature, if curvature > 0.0 { self.bend.map(|b| b / curvature) } else { [1.0, 0.0] })
    }

    fn moved(&self, &[a, b, tilt_u, tilt_v, grown, bend_u, bend_v]: &[f64; 7]) -> Tube {
        Tube {
            frame: self.frame.moved([a, b, 0.0], [tilt_u, tilt_v], 0.0),
            radius: self.radius + grown,
            bend: [self.bend[0] + bend_u, self.bend[1] + bend_v],
        }
    }

    /// The torus with this tube.
    pub(super) fn torus(&self) -> Element {
        let [u, v, w] = self.frame.axes;
        let (curvature, [tu, tv]) = self.curvature();
        let toward = plus(times(tu, u), times(tv, v));
        let ring = 1.0 / curvature.max(MIN_BENT_CURVATURE);
        let center = plus(self.frame.origin, times(ring, toward));
        let pose = Pose::toward(center, cross(w, toward), minus(self.frame.origin, center));
        Element { pose, size: [ring, self.radius] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::family::Family;
    use crate::fit::torus::Torus;

    /// 20° of a ring of radius 3 with a tube of radius 1, half of it seen, from a cylinder a little off.
    #[test]
    fn a_cylinder_is_bent_into_the_torus() {
        let points: Vec<Point> = (0..40)
            .map(|k| {
                let (t, a) =
                    (0.35 * (0.618 * f64::from(k)).fract(), std::f64::consts::PI * f64::from(k) / 39.0);
                let rho = 3.0 + a.cos();
                [rho * t.cos(), rho * t.sin(), a.sin()]
            })
            .collect();
        let frame = Pose::along([3.1, 0.4, 0.1], [-0.1, 1.0, 0.05]);
        let torus = Tube::near(frame, 0.9, &points).torus();
        assert!((torus.size[0] - 3.0).abs() < 1e-4 && (torus.size[1] - 1.0).abs() < 1e-4, "{torus:?}");
        let worst =
            points.iter().fold(0.0f64, |m, &p| m.max(Torus::distance(torus.size, torus.pose.local(p)).abs()));
        assert!(worst < 1e-5, "{worst}");
    }
}

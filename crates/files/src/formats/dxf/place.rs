//! Places of blocks in a drawing.

use super::conic::conic;
use crate::content::drawing::Drawn;
use crate::error::Fault;
use trueness_geom::spline::rational::Rational;
use trueness_geom::spline::value::Mass;

/// A circle stays a circle where lengths and right angle of the placed axes differ by no more than this share.
const MAX_AXES_MISMATCH: f64 = 1e-9;

/// How the coordinates of a block become those of the drawing: the images of its axes and of its origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placing {
    pub axes: [[f64; 2]; 2],
    pub origin: [f64; 2],
}

impl Placing {
    pub const UNMOVED: Placing = Placing { axes: [[1.0, 0.0], [0.0, 1.0]], origin: [0.0; 2] };

    fn out(&self, v: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| v[0] * self.axes[0][k] + v[1] * self.axes[1][k])
    }

    pub fn place(&self, p: [f64; 2]) -> [f64; 2] {
        let v = self.out(p);
        [v[0] + self.origin[0], v[1] + self.origin[1]]
    }

    /// This placing after another one.
    pub fn after(&self, inner: &Placing) -> Placing {
        Placing { axes: inner.axes.map(|v| self.out(v)), origin: self.place(inner.origin) }
    }

    /// An entity placed; circles that become ellipses are rational curves.
    pub fn drawn(&self, drawn: &Drawn) -> Result<Vec<Drawn>, Fault> {
        let [u, v] = self.axes;
        Ok(match drawn {
            Drawn::Line { start, end } => {
                vec![Drawn::Line { start: self.place(*start), end: self.place(*end) }]
            }
            Drawn::Arc { center, radius, start, sweep } => {
                let (a, b) = (libm::hypot(u[0], u[1]), libm::hypot(v[0], v[1]));
                let round = (a - b).abs() <= MAX_AXES_MISMATCH * a
                    && (u[0] * v[0] + u[1] * v[1]).abs() <= MAX_AXES_MISMATCH * a * b;
                if !round {
                    let axes = [u, v].map(|w| w.map(|x| radius * x));
                    return conic(self.place(*center), axes, *start, *sweep);
                }
                let sense = (u[0] * v[1] - u[1] * v[0]).signum();
                let (turn, center) = (libm::atan2(u[1], u[0]), self.place(*center));
                vec![Drawn::Arc {
                    center,
                    radius: a * radius,
                    start: turn + sense * start,
                    sweep: sense * sweep,
                }]
            }
            Drawn::Spline(curve) => {
                let masses = curve.masses();
                let moved = |m: &Mass<3>| {
                    let v = self.out([m.moment[0], m.moment[1]]);
                    let moment = [v[0] + m.mass * self.origin[0], v[1] + m.mass * self.origin[1], 0.0];
                    Mass { moment, mass: m.mass }
                };
                let points = masses.points().iter().map(moved).collect();
                let moved = Rational::of_masses(masses.knots().clone(), points);
                vec![Drawn::Spline(moved.map_err(|_| Fault::unexpected("a curve of a block", b""))?)]
            }
        })
    }
}

//! Rational surfaces (NURBS): surfaces of mass points, seen from the mass.

use super::super::basis::{KnotError, Knots};
use super::super::value::{Mass, Value};
use super::{Bend, Surface};
use crate::space::{Point, norm};

/// A rational B-spline surface.
///
/// A quarter of a cylinder of radius 2, exactly:
/// ```
/// use trueness_geom::spline::{basis::Knots, surface::RationalSurface};
/// let half = 0.5f64.sqrt();
/// let arc = [([2.0, 0.0], 1.0), ([2.0, 2.0], half), ([0.0, 2.0], 1.0)];
/// let points: Vec<_> = arc.iter().flat_map(|([x, y], w)| [0.0, 5.0].map(|z| ([*x, *y, z], *w))).collect();
/// let knots = [Knots::uniform(2, 1, 0.0, 1.0), Knots::uniform(1, 1, 0.0, 1.0)];
/// let bend = RationalSurface::new(knots, &points).unwrap().bend(0.3, 0.2).unwrap();
/// assert!((bend.principal[1].curvature + 0.5).abs() < 1e-14 && bend.gaussian.abs() < 1e-14);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RationalSurface(Surface<Mass<3>>);

impl RationalSurface {
    /// The surface of control points with their weights, row after row as in [`Surface`].
    ///
    /// # Errors
    /// [`KnotError::Points`] where their number does not fit the knots.
    pub fn new(knots: [Knots; 2], points: &[(Point, f64)]) -> Result<RationalSurface, KnotError> {
        Ok(RationalSurface(Surface::new(knots, points.iter().map(|(p, w)| Mass::new(*p, *w)).collect())?))
    }
    /// The surface of mass points: knots are inserted, degrees elevated and parts split off there.
    pub fn masses(&self) -> &Surface<Mass<3>> {
        &self.0
    }
    /// The surface at `u`, `v`; `None` where the mass is 0.
    pub fn at(&self, u: f64, v: f64) -> Option<Point> {
        self.0.at(u, v).place()
    }
    /// All partial derivatives up to `order`, as [`Surface::derivatives`] has them, by the quotient rule; `None` where the mass
    /// is 0.
    pub fn derivatives(&self, u: f64, v: f64, order: usize) -> Option<Vec<Vec<Point>>> {
        let masses = self.0.derivatives(u, v, order);
        let mut out: Vec<Vec<Point>> = (0..=order).map(|k| vec![[0.0; 3]; order - k + 1]).collect();
        for k in 0..=order {
            for l in 0..=order - k {
                let mut top = masses[k][l].moment;
                let mut choose_k = 1.0;
                for i in 0..=k {
                    let mut choose_l = 1.0;
                    for j in 0..=l {
                        if i + j > 0 {
                            top = top.plus(-choose_k * choose_l * masses[i][j].mass, out[k - i][l - j]);
                        }
                        choose_l *= (l - j) as f64 / (j + 1) as f64;
                    }
                    choose_k *= (k - i) as f64 / (i + 1) as f64;
                }
                let value = top.map(|x| x / masses[0][0].mass);
                if value.iter().any(|x| !x.is_finite()) {
                    return None;
                }
                out[k][l] = value;
            }
        }
        Some(out)
    }
    /// Normal and curvatures at `u`, `v`; `None` where there is no place or the derivatives span no plane.
    pub fn bend(&self, u: f64, v: f64) -> Option<Bend> {
        let d = self.derivatives(u, v, 2)?;
        let masses = self.0.derivatives(u, v, 1);
        // A first derivative that is the rounding of its quotient rule has no direction, as at a pole.
        let rounding = |m: &Mass<3>| {
            let terms = norm(m.moment) + m.mass.abs() * norm(d[0][0]);
            4.0 * f64::EPSILON * terms / masses[0][0].mass.abs()
        };
        if norm(d[1][0]) <= rounding(&masses[1][0]) || norm(d[0][1]) <= rounding(&masses[0][1]) {
            return None;
        }
        Bend::new([d[1][0], d[0][1]], [d[2][0], d[1][1], d[0][2]])
    }
}

impl From<Surface<Mass<3>>> for RationalSurface {
    fn from(masses: Surface<Mass<3>>) -> RationalSurface {
        RationalSurface(masses)
    }
}

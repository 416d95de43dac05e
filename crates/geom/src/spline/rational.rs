//! Rational curves (NURBS): curves of mass points, seen from the mass.

use super::basis::{KnotError, Knots};
use super::curve::Curve;
use super::value::{Mass, Value};

/// A rational B-spline curve.
///
/// The half circle of three points with masses 1, 0 and 1, where the one without mass is a direction:
/// ```
/// use trueness_geom::spline::{basis::Knots, rational::Rational, value::Mass};
/// let mass = |moment, mass| Mass { moment, mass };
/// let points = vec![mass([1.0, 0.0], 1.0), mass([0.0, 1.0], 0.0), mass([-1.0, 0.0], 1.0)];
/// let half = Rational::of_masses(Knots::uniform(2, 1, 0.0, 1.0), points).unwrap();
/// let [x, y] = half.at(0.2).unwrap();
/// assert!((x * x + y * y - 1.0).abs() < 1e-15 && y > 0.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Rational<const D: usize>(Curve<Mass<D>>);

impl<const D: usize> Rational<D> {
    /// The curve of control points with their weights.
    ///
    /// # Errors
    /// [`KnotError::Points`] where their number does not fit the knots.
    pub fn new(knots: Knots, points: &[([f64; D], f64)]) -> Result<Rational<D>, KnotError> {
        Rational::of_masses(knots, points.iter().map(|(p, w)| Mass::new(*p, *w)).collect())
    }
    /// The curve of mass points.
    ///
    /// # Errors
    /// As [`Rational::new`].
    pub fn of_masses(knots: Knots, points: Vec<Mass<D>>) -> Result<Rational<D>, KnotError> {
        Ok(Rational(Curve::new(knots, points)?))
    }
    /// The curve of mass points: knots are inserted and removed and degrees elevated there.
    pub fn masses(&self) -> &Curve<Mass<D>> {
        &self.0
    }
    /// The curve at `t`; `None` where the mass is 0.
    pub fn at(&self, t: f64) -> Option<[f64; D]> {
        self.0.at(t).place()
    }
    /// The curve and its derivatives up to `order` at `t`, by the quotient rule; `None` where the mass is 0.
    pub fn derivatives(&self, t: f64, order: usize) -> Option<Vec<[f64; D]>> {
        let masses = self.0.derivatives(t, order);
        let mut out: Vec<[f64; D]> = vec![];
        for k in 0..=order {
            let mut top = masses[k].moment;
            let mut choose = 1.0;
            for i in 1..=k {
                choose *= (k + 1 - i) as f64 / i as f64;
                top = top.plus(-choose * masses[i].mass, out[k - i]);
            }
            let value = top.map(|x| x / masses[0].mass);
            if value.iter().any(|x| !x.is_finite()) {
                return None;
            }
            out.push(value);
        }
        Some(out)
    }
}

impl<const D: usize> From<Curve<Mass<D>>> for Rational<D> {
    fn from(curve: Curve<Mass<D>>) -> Rational<D> {
        Rational(curve)
    }
}

//! The result of a fit: the element, how well the points keep to it, how well they determine it.

use super::Method;
use crate::shape::{Parameter, Shape};

/// An element fitted to points. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The element.
    pub shape: Shape,
    /// How it was fitted.
    pub method: Method,
    /// Distances of the points from it.
    pub residuals: Residuals,
    /// How well the points determine it. Absent where there are no more points than unknowns, and for methods
    /// that rest on a few touching points.
    pub covariance: Option<Covariance>,
    /// The points that hold a minimum zone, circumscribed or inscribed element; empty for least squares.
    pub touching: Vec<Touching>,
    /// Points that a robust fit left out, for lying too far off: they do not count in the residuals.
    pub outliers: usize,
    /// Steps of the solver on all points.
    pub iterations: usize,
    /// Whether the last step changed nothing that shows. False only where the points hardly determine the element.
    pub converged: bool,
}

/// Signed distances of the points from the element; distances from curves in space have no sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residuals {
    /// Number of points; of a robust fit, those that are no outliers.
    pub count: usize,
    /// Root mean square.
    pub rms: f64,
    /// Standard deviation of one distance: the sum of squares over the number of distances less that of the
    /// unknowns. Absent where nothing is left over.
    pub std_dev: Option<f64>,
    /// Least distance, and the first point that has it.
    pub min: (f64, usize),
    /// Greatest distance, and the first point that has it.
    pub max: (f64, usize),
    /// Deviation of form: greatest less least distance; for a curve in space twice the greatest.
    pub form_error: f64,
}

/// A point that touches the zone or element, and its share in holding it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touching {
    /// Index of the point.
    pub point: usize,
    /// +1 if it touches from the inner side of the outer boundary, −1 if from the outer side of the inner one.
    pub side: i8,
    /// Multiplier: how strongly the zone's half width answers to a shift of this point. All are positive and
    /// sum to 1; they certify that no small change of the element makes the zone narrower.
    pub multiplier: f64,
}

/// Covariance of the parameters, in the order of [`Shape::parameters`], vectors spelt out.
#[derive(Clone, Debug, PartialEq)]
pub struct Covariance {
    /// Number of parameters.
    pub size: usize,
    /// `size` rows of `size` numbers.
    pub values: Vec<f64>,
}

impl Covariance {
    /// The covariance where so many points tell as much as an independent one, as neighbors share their errors
    /// ([`Noise::points_per_independent`](crate::noise::Noise)). The covariance of a fit takes points as independent.
    ///
    /// For errors shared over distances in which the element hardly bends.
    pub fn of_shared(mut self, points_per_independent: f64) -> Covariance {
        self.values.iter_mut().for_each(|x| *x *= points_per_independent);
        self
    }

    /// Standard uncertainty of each parameter of `shape`, with its name; of a vector, coordinate by coordinate.
    pub fn uncertainties(&self, shape: &Shape) -> Vec<(&'static str, Parameter)> {
        let deviation = |k: usize| self.values[k * self.size + k].max(0.0).sqrt();
        let mut next = 0;
        shape
            .parameters()
            .into_iter()
            .map(|(name, parameter)| match parameter {
                Parameter::Number(_) => {
                    next += 1;
                    (name, Parameter::Number(deviation(next - 1)))
                }
                Parameter::Vector(_) => {
                    next += 3;
                    (name, Parameter::Vector([deviation(next - 3), deviation(next - 2), deviation(next - 1)]))
                }
            })
            .collect()
    }
}

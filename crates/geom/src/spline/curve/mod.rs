//! B-spline curves.

mod b_spline;
mod closest;
mod divide;
mod fair;
mod fit;
mod knots;
mod length;
#[cfg(test)]
mod tests;

pub use b_spline::Curve;
pub use closest::Foot;
pub use divide::divided;
pub use fit::corrected;
pub use fit::{End, Ends, FitCurveError, Fitted, approximate, chord_parameters, fit, spread_knots};

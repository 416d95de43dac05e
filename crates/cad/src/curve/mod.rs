//! Curves of edges: places and derivatives by a parameter, as ISO 10303-42 states them.
//!
//! | kind | place at `t` |
//! |---|---|
//! | line | `origin + t·direction` (the direction has the length that the file gives it) |
//! | circle | `radius·(cos t, sin t, 0)` in its frame; ellipse with a radius of each axis |
//! | hyperbola | `(a·cosh t, b·sinh t, 0)` |
//! | parabola | `(f·t², 2·f·t, 0)` with the focal distance `f` |
//! | spline, rational | clamped B-splines by their knots |
//! | polyline | straight from point to point, one unit of `t` for each |
//! | joined | several curves one after another, one unit of `t` for each |

mod bezier;
mod conic;
mod corners;
mod evaluate;
mod extent;
mod feet;
mod kinds;
mod part;
mod placed;
mod sample;
#[cfg(test)]
mod tests;

pub use feet::CurveFeet;
pub use kinds::{Curve, Span};
pub use part::Foot;

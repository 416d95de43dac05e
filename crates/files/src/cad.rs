//! B-spline surfaces for CAD programs, and from them.

pub(crate) mod assemble;
mod spline_model;
pub(crate) mod spline_surface;

pub use crate::formats::iges::surface as iges;
pub use crate::formats::step::surface as step;
pub use spline_model::SplineModel;
pub use spline_surface::{Bound, SplineSurface, TrimmedFace};

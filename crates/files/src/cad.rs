//! B-spline surfaces for CAD programs, and from them.

pub use crate::content::spline_model::SplineModel;
pub use crate::content::spline_surface::{Bound, SplineSurface, TrimmedFace};
pub use crate::formats::iges::surface as iges;
pub use crate::formats::step::surface as step;

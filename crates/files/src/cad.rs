//! B-spline surfaces for CAD programs.

pub(crate) mod spline_surface;

pub use crate::formats::iges::surface as iges;
pub use crate::formats::step::surface as step;
pub use spline_surface::SplineSurface;

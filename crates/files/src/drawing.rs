//! Drawings in a plane: lines, arcs and splines for the writers of drawings (DXF, SVG), and of curves in space (STEP, IGES), and as
//! they are read.

pub use crate::content::drawing::{Clamped, Drawing, Drawn, DrawnEntity, Entity, Layer};
pub use crate::formats::dxf::write as dxf;
pub use crate::formats::iges::curves as iges;
pub use crate::formats::step::curves as step;
pub use crate::formats::svg::write as svg;

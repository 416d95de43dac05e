//! Drawings in a plane: lines, arcs and splines. Writers make drawings and curves in space of them, and readers
//! give them.

pub use crate::content::drawing::{Clamped, Drawing, Drawn, DrawnEntity, Entity, Layer};
pub use crate::formats::dxf::write as dxf;
pub use crate::formats::iges::curves as iges;
pub use crate::formats::step::curves as step;
pub use crate::formats::svg::write as svg;

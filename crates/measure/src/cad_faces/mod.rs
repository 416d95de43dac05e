//! Faces of a CAD model as a reference: exact distances, elements, the numbers and names that a file gives them.
//!
//! | file | what |
//! |---|---|
//! | `align` | alignments end on them |
//! | `deviation` | deviations of points from them |
//! | `faces` | the faces of a model |
//! | `face` | what is known of a face |
//! | `element` | the element that a surface is |
//! | `one_surface` | which faces are parts of one surface |
//! | `named` | faces by their number or name |
//! | `extent` | some faces as the nominal of a feature |

mod align;
mod deviation;
mod element;
mod extent;
mod face;
mod faces;
mod named;
mod one_surface;
#[cfg(test)]
mod tests;

pub use deviation::deviation;
pub use extent::NoNominal;
pub use face::CadFace;
pub use faces::CadFaces;
pub use named::{FaceChoice, NoFace};

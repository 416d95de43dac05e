//! STEP files (ISO 10303-21) of application protocol 214, millimetres: what all of them say.
//!
//! The header's time stamp is fixed, so that the same model gives the same bytes.

mod curves;
mod instances;
mod surface;

pub use curves::write as curves;
pub(super) use instances::real;
pub use surface::write as surface;

//! IGES 5.3 files, millimetres: what all of them say.
//!
//! Lines have 80 columns: 64 to 72 of content, a letter for the section, a number. The dates are fixed, so that the same model
//! gives the same bytes.

mod curves;
mod entry;
mod surface;

pub use curves::write as curves;
pub use surface::write as surface;

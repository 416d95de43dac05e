//! STEP files (ISO 10303-21): what all of them say that are written, of application protocol 214 and in millimeters; and what
//! is read of others'.
//!
//! The header's time stamp is fixed, so that the same model gives the same bytes.

mod curves;
mod instances;
mod model;
mod part21;
mod read;
mod spline;
mod surface;
#[cfg(test)]
mod tests;

pub use curves::write as curves;
pub(super) use instances::real;
pub(crate) use model::read as model;
pub use surface::write as surface;

use crate::format::{Format, Head};

/// STEP.
pub(crate) const STEP: Format = Format {
    name: "step",
    extensions: &["step", "stp", "p21"],
    written_as: &[],
    manual: include_str!("step.md"),
    columns: false,
    sniff: |head: &Head| head.bytes.trim_ascii_start().starts_with(b"ISO-10303-21"),
    read: Some(read::read),
    points: None,
    mesh: None,
};

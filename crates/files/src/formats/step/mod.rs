//! STEP files (ISO 10303-21): the common part of written ones, of application protocol 214 and in millimeters; and their
//! reading.
//!
//! The header's time stamp is fixed, so that the same model gives the same bytes.

mod curves;
mod instances;
mod read;
mod surface;
#[cfg(test)]
mod tests;
mod text;

pub use curves::write as curves;
pub(super) use instances::real;
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

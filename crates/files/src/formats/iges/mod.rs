//! IGES 5.3 files: the common part of written ones, in millimeters; and their reading.
//!
//! Lines have 80 columns: 64 to 72 of content, a letter for the section, a number. The dates are fixed, so that the same model
//! gives the same bytes.

mod curves;
mod entry;
mod read;
mod surface;
#[cfg(test)]
mod tests;
mod text;

pub use curves::write as curves;
pub use surface::write as surface;

use crate::format::{Format, Head};

/// IGES.
pub(crate) const IGES: Format = Format {
    name: "iges",
    extensions: &["iges", "igs"],
    written_as: &[],
    manual: include_str!("iges.md"),
    columns: false,
    // The first line is of the start section, the first of them.
    sniff: |head: &Head| {
        let line = head.bytes.split(|b| *b == b'\n').next().unwrap_or_default();
        line.get(72) == Some(&b'S')
            && line.get(73..80).is_some_and(|n| n.trim_ascii() == b"1" || n.ends_with(b"0000001"))
    },
    read: Some(read::read),
    points: None,
    mesh: None,
};

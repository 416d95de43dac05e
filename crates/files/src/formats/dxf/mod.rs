//! DXF drawings: lines, arcs, circles and splines, written for sections and read as the nominal of one.

mod blocks;
mod conic;
mod entities;
mod groups;
mod hidden;
#[cfg(test)]
mod hidden_tests;
mod place;
mod read;
#[cfg(test)]
mod tests;
mod through;
mod write;

pub use write::write;

use crate::format::{Format, Head, Holds};

/// DXF.
pub(crate) const DXF: Format = Format {
    name: "dxf",
    known_as: &["DXF"],
    extensions: &["dxf"],
    written_as: &[],
    manual: include_str!("dxf.md"),
    holds: &[Holds::Drawing],
    columns: false,
    // A group of code 0 that begins a section, perhaps after comments of code 999; or the mark of binary files.
    sniff: |head: &Head| groups::begins(head.bytes),
    read: Some(read::read),
    model: None,
    points: None,
    mesh: None,
};

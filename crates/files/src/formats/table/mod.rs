//! Points as rows of numbers: XYZ, ASC, TXT, CSV, PTS.

mod detect;
mod header;
mod row;
mod stream;
mod write;

use crate::{
    detect::is_text,
    error::{Fault, Result},
    format::{Format, Head, Parsed},
    open::ReadOptions,
    source::{HEAD, Source},
};
pub(crate) use row::{Layout, Separator};
pub(crate) use stream::{Limit, TextPoints};

/// Rows of numbers under any of their many names.
pub(crate) const TABLE: Format = Format {
    name: "csv",
    extensions: &["csv", "xyz", "asc", "txt", "pts", "xyzn", "xyzrgb", "xy", "dat", "tsv"],
    written_as: &["csv", "tsv", "xyz", "asc", "txt"],
    manual: include_str!("table.md"),
    // Any text could be one: it is tried when everything else, the extension too, has said no.
    sniff: |_: &Head| false,
    read: Some(read),
    points: Some(write::begin),
    mesh: None,
};

/// Whether a file begins like rows of numbers.
pub(crate) fn looks_like_rows(head: &[u8]) -> bool {
    is_text(head) && detect::detect(head, None).is_ok()
}

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let head = source.feed.ahead(HEAD)?;
    let head = &head[..head.len().min(HEAD)];
    if !is_text(head) {
        return Err(Fault::unexpected("rows of numbers", head).at_byte(0));
    }
    let found = detect::detect(head, options.columns.as_ref())?;
    let width = found.width;
    source.feed.step(found.skip);
    let limit = match found.declared {
        Some(declared) => Limit::Expected(declared),
        None => Limit::None,
    };
    let planar = found.layout.planar;
    let points = TextPoints::new(source.feed, found.layout, found.lines, limit, options.block * width);
    Ok(Parsed { planar, warnings: found.warnings, ..Parsed::points(found.variant, points) })
}

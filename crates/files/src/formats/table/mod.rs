//! Points as rows of numbers: XYZ, ASC, TXT, CSV, PTS.
//!
//! Nothing is guessed. A table is read to the numbers that it means, or refused with the place and a remedy. The result
//! names the columns taken ([`TableReading`](crate::TableReading)). The rules, which the manual page states for users:
//!
//! 1. Separators are semicolon, tab, comma or blanks; decimal signs point or comma, but not both commas. The first 400
//!    lines decide. A way of writing that reads all their rows goes before one that does not, three coordinates before
//!    two. It must not skip more rows of another way than it reads. Where equally many tabs stand in all rows, tabs separate.
//! 2. The table begins at the line after a header that names x and y. Without one, it begins at the first line with as many cells as the
//!    rows and a number among them, or with several numbers alone. From there on, every line that is neither blank nor a comment is a
//!    row.
//! 3. The columns asked for are taken. Else a header is binding: its names and the cells must be equally many. Without a
//!    header, the first three (or two) columns are taken that do not hold words in every looked-at row.
//! 4. A cell of these columns that is no finite number is an error with line and column. Such are empty cells, marks such as
//!    `NA` or `-`, thousands separators, units, the other decimal sign, errors of a spreadsheet. U+2212 is a minus.
//! 5. A row of more or fewer cells than the others is an error. Only text behind the last column of numbers may be missing, and
//!    be several words between blanks. A line before the first row that lacks one cell, or is the start of a row, is a row.
//! 6. A table that can be meant in two ways is refused: its commas may be decimal signs, its first column may be x or a
//!    running number, its names fit x twice or not at all.
//! 7. Behind the last row may stand a mark for the end of a text: Ctrl-Z, `END`, `EOF`.
//! 8. An airfoil in Selig's or Lednicer's form is known by its rows. Its title, whatever it looks like, and its counts are no points.
//!    Two sides become one row around the profile. A warning says so.
//! 9. A unit in the names of x, y, z is used, unless the user says another one; one that is not understood is refused.

mod airfoil;
mod cell;
mod choose;
mod detect;
#[cfg(test)]
mod ends_tests;
mod header;
mod length;
mod line;
mod row;
mod stream;
#[cfg(test)]
mod tests;
mod tried;
mod uneven;
#[cfg(test)]
mod uneven_tests;
mod write;

use crate::{
    Warning,
    error::{Fault, Result},
    feed::Feed,
    format::{Format, Head, Holds, Parsed, ReadOptions},
    lines::is_text,
    source::{SNIFFED_BYTES, Source},
};
use cell::END_MARK;
pub(crate) use cell::Separator;
pub(crate) use row::Layout;
pub(crate) use stream::{Limit, TextPoints};

/// Rows of numbers under any of their many names.
pub(crate) const TABLE: Format = Format {
    name: "csv",
    known_as: &["CSV", "XYZ", "PTS"],
    extensions: &["csv", "xyz", "asc", "txt", "pts", "xyzn", "xyzrgb", "xy", "dat", "tsv"],
    written_as: &["csv", "tsv", "xyz", "asc", "txt"],
    manual: include_str!("table.md"),
    holds: &[Holds::Points],
    columns: true,
    // Any text could be one: it is tried when everything else, the extension too, has said no.
    sniff: |_: &Head| false,
    read: Some(read),
    model: None,
    points: Some(write::begin),
    mesh: None,
};

/// Whether a file begins like rows of numbers, be it with faults.
pub(crate) fn looks_like_rows(head: &[u8]) -> bool {
    let head = before_end_mark(head);
    is_text(head) && detect::plausible(head)
}

/// The bytes before the marks that end texts of DOS.
fn before_end_mark(head: &[u8]) -> &[u8] {
    let is_end = |b: &u8| *b == END_MARK || b.is_ascii_whitespace();
    let text = head.iter().rposition(|b| !is_end(b)).map_or(0, |last| last + 1);
    match head[text..].iter().position(|b| *b == END_MARK) {
        Some(at) => &head[..text + at],
        None => head,
    }
}

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let (mut form, mut file_lines) = (None, None);
    let whole = source.feed.ahead(SNIFFED_BYTES)?;
    // Collections of airfoils hold a hundred rows; longer files have none of their forms.
    if options.columns.is_none()
        && whole.len() < SNIFFED_BYTES
        && let Some(airfoil) = airfoil::plain(before_end_mark(whole))
    {
        (form, file_lines) = (Some(airfoil.warning), Some(airfoil.file_lines));
        source.feed = Feed::memory(airfoil.text);
    }
    let head = source.feed.ahead(SNIFFED_BYTES)?;
    let head = before_end_mark(&head[..head.len().min(SNIFFED_BYTES)]);
    if !is_text(head) {
        crate::unicode::no_zeros(head)?;
        return Err(Fault::unexpected("rows of numbers", head).at_byte(0));
    }
    let found = detect::detect(head, options.columns.as_ref(), options.units.is_some());
    let mut found = match &file_lines {
        Some(lines) => found.map_err(|fault| airfoil::in_file(fault, lines))?,
        None => found?,
    };
    if let (Some(header), Some(asked)) = (found.unit, options.units)
        && header != asked
    {
        found.warnings.push(Warning::UnitOverruled { header, asked });
    }
    found.warnings.extend(form);
    let width = found.width;
    source.feed.step(found.skip);
    let limit = match found.declared {
        Some(declared) => Limit::Announced(declared),
        None => Limit::None,
    };
    let planar = found.layout.planar;
    let points = TextPoints::new(source.feed, found.layout, found.lines, limit, options.block * width);
    let parsed = match file_lines {
        Some(file_lines) => Parsed::points(found.variant, airfoil::Around { points, file_lines }),
        None => Parsed::points(found.variant, points),
    };
    Ok(Parsed { planar, warnings: found.warnings, table: Some(found.reading), unit: found.unit, ..parsed })
}

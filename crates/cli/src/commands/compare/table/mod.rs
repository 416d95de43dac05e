//! The comparison as a table for people: the result in some ten lines, or all that the document tells.

mod full;
mod line;
mod result;

pub use full::{along, coverage, outliers, regions};

use trueness_document::compare::CompareDocument;

/// The whole text: all of it, or the result alone, with a list of the worst places or without.
pub fn text(d: &CompareDocument, verbose: bool, places: bool) -> String {
    if verbose { full::text(d) } else { result::text(d, places) }
}

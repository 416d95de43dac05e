//! The comparison as a table for people: the result in some ten lines, or all that the document tells.

mod full;
mod line;
mod result;

pub use full::{along, coverage, outliers, regions};

use trueness_inspect::results::compare::CompareDocument;

/// The whole text.
pub fn text(d: &CompareDocument, verbose: bool) -> String {
    if verbose { full::text(d) } else { result::text(d) }
}

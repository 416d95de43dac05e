//! The dimensions between segments as documents have them.

use super::found::Section;
use crate::words::ToWord;
use trueness_document::section::{DimensionRecord, DimensionsRecord, MemberRecord};
use trueness_section::{Dimension, DimensionKind, RowKind, dimensions};

/// Dimensions that are listed.
const MAX_LISTED_DIMENSIONS: usize = 1000;

/// The dimensions of all sections.
pub fn dimensions_record(sections: &[Section]) -> DimensionsRecord {
    let mut all = DimensionsRecord::default();
    let mut before = 0;
    for section in sections {
        let found = dimensions(&section.contours);
        all.count += found.len() as u64;
        let room = MAX_LISTED_DIMENSIONS - all.items.len();
        all.items.extend(found.iter().take(room).map(|d| record(d, section, before)));
        before += section.contours.len();
    }
    all.truncated = all.items.len() < all.count as usize;
    all
}

fn record(found: &Dimension, section: &Section, before: usize) -> DimensionRecord {
    let exact = found.of.iter().any(|o| section.contours[o[0]].row_kind == RowKind::Facets);
    let reason = match (found.uncertainty, found.kind) {
        (Some(_), _) => None,
        (None, _) if exact => Some("facets of a drawing carry no random noise"),
        (None, DimensionKind::Gap) => {
            Some("the place across a spline or a part of a circle has no uncertainty")
        }
        _ => Some("the points alone do not tell it"),
    };
    DimensionRecord {
        kind: found.kind.word(),
        of: found.of.map(|[contour, segment]| MemberRecord {
            contour: (before + contour) as u64,
            segment: segment as u64,
        }),
        value: found.value,
        std_uncertainty: found.uncertainty,
        std_uncertainty_reason: reason.map(Into::into),
        between: found.between,
    }
}

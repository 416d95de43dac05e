//! Dimensions between the segments of a section.

use super::found::Section;
use crate::Word;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_section::{Dimension, DimensionKind, Taken, dimensions};

/// Dimensions that are listed.
const LISTED: usize = 1000;

/// The dimensions between segments: how many there are, and the first of them.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct DimensionsRecord {
    /// How many there are.
    pub count: u64,
    /// Whether some are not listed.
    pub truncated: bool,
    /// Plane after plane.
    pub items: Vec<DimensionRecord>,
}

/// A dimension between two segments.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct DimensionRecord {
    /// `angle` that a line and the next of its contour enclose, `width` between parallel lines that face each other, distance of
    /// the `centers` of two arcs, or `gap` between two contours.
    pub kind: Word<DimensionKind>,
    /// The segments that it is of.
    pub of: [MemberRecord; 2],
    /// Its value: a length, of an angle radians.
    pub value: f64,
    /// Its standard uncertainty, from the scatter of the points.
    pub std_uncertainty: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub std_uncertainty_reason: Option<String>,
    /// The two places between which it is measured; of an angle, the end of the first line and the start of the next.
    pub between: [[f64; 2]; 2],
}

/// A segment of a contour, both by their numbers from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct MemberRecord {
    /// Number of the contour in `contours`.
    pub contour: u64,
    /// Number of the segment in it.
    pub segment: u64,
}

impl DimensionsRecord {
    /// Those of all sections.
    pub fn new(sections: &[Section]) -> DimensionsRecord {
        let mut all = DimensionsRecord::default();
        let mut before = 0;
        for section in sections {
            let found = dimensions(&section.contours);
            all.count += found.len() as u64;
            let room = LISTED - all.items.len();
            all.items.extend(found.iter().take(room).map(|d| record(d, section, before)));
            before += section.contours.len();
        }
        all.truncated = all.items.len() < all.count as usize;
        all
    }
}

fn record(found: &Dimension, section: &Section, before: usize) -> DimensionRecord {
    let exact = found.of.iter().any(|o| section.contours[o[0]].taken == Taken::Facets);
    let reason = match (found.uncertainty, found.kind) {
        (Some(_), _) => None,
        (None, _) if exact => Some("facets of a drawing carry no random noise"),
        (None, DimensionKind::Gap) => {
            Some("the place across a spline or a part of a circle has no uncertainty")
        }
        _ => Some("the points alone do not tell it"),
    };
    DimensionRecord {
        kind: Word(found.kind),
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

//! The pieces of contours: their kinds, and the picks that lead to them.

use trueness_document::section::{GeometryRecord, Positive, SectionDocument, SegmentRecord};

/// The word for a segment's kind.
pub fn kind(segment: &SegmentRecord) -> &'static str {
    match segment.geometry {
        GeometryRecord::Line { .. } => "line",
        GeometryRecord::Arc { .. } => "arc",
        GeometryRecord::Spline { .. } => "spline",
    }
}

/// The word for where deviations are positive.
pub fn sign(positive: Positive) -> &'static str {
    match positive {
        Positive::Outside => "nominal.outside",
        Positive::Left => "nominal.left",
        Positive::Both => "nominal.outside_or_left",
    }
}

/// The number of the first pick of each contour: its segments, then its joins.
pub fn pick_numbers(document: &SectionDocument) -> Vec<usize> {
    let counts = document.contours.iter().map(|c| c.segments.len() + c.joins.len());
    counts
        .scan(0, |sum, n| {
            *sum += n;
            Some(*sum - n)
        })
        .collect()
}

/// How many picks lead to the pieces of all contours; those of the nominal follow.
pub fn drawn_pieces(document: &SectionDocument) -> usize {
    document.contours.iter().map(|c| c.segments.len() + c.joins.len()).sum()
}

/// Outlines of the nominal that are listed.
const MAX_LISTED_OUTLINES: usize = 60;

/// The first outlines of the nominal that were not measured as a whole, by their numbers.
pub fn lacking(document: &SectionDocument) -> Vec<usize> {
    let all = document.nominal.iter().flat_map(|n| n.outlines.iter().enumerate());
    all.filter(|(_, o)| o.lacks()).map(|(n, _)| n).take(MAX_LISTED_OUTLINES).collect()
}

//! Segments of contours as documents hold them.

use super::near_arc::near_arc;
use trueness_document::section::{GeometryRecord, SegmentRecord, UncertaintyRecord};
use trueness_section::{Geometry, RowKind, Segment, SegmentKind, Uncertainty};

/// The record of a segment.
/// A segment of a contour whose row is of this kind.
pub(super) fn segment_record(found: &Segment, row_kind: RowKind) -> SegmentRecord {
    let (start, end) = (found.start, found.end);
    let geometry = match &found.geometry {
        Geometry::Line => GeometryRecord::Line { angle: found.angle() },
        Geometry::Arc { center, radius, start, sweep } => {
            GeometryRecord::Arc { center: *center, radius: *radius, start_angle: *start, sweep: *sweep }
        }
        Geometry::Spline { curve, deviation } => GeometryRecord::Spline {
            degree: curve.knots().degree() as u64,
            knots: curve.knots().values().to_vec(),
            control_points: curve.points().to_vec(),
            deviation: *deviation,
        },
    };
    let near_arc = match (&found.geometry, row_kind) {
        (Geometry::Spline { curve, .. }, RowKind::Row | RowKind::Scan) => near_arc(curve, found.length),
        _ => None,
    };
    let uncertainty = found.uncertainty.map(|u| match u {
        Uncertainty::Line { angle } => UncertaintyRecord::Line { angle },
        Uncertainty::Arc { center, radius } => UncertaintyRecord::Arc { center, radius },
    });
    let reason = match (found.geometry.kind(), row_kind) {
        _ if uncertainty.is_some() => None,
        (SegmentKind::Spline, _) => Some("a spline is not known by single numbers"),
        (_, RowKind::Facets) => Some("facets of a drawing carry no random noise"),
        _ => Some("the points alone do not tell it"),
    };
    let unknown_length = match (found.length_uncertainty, row_kind) {
        (Some(_), _) => None,
        (None, RowKind::Facets) => Some("facets of a drawing carry no random noise"),
        (None, _) => Some("it ends where the points end, or they do not tell its ends"),
    };
    SegmentRecord {
        geometry,
        start,
        end,
        length: found.length,
        count: found.count as u64,
        rms: found.rms,
        max: found.max,
        curvature: found.curvature,
        near_arc,
        uncertainty,
        uncertainty_reason: reason.map(Into::into),
        length_uncertainty: found.length_uncertainty,
        length_uncertainty_reason: unknown_length.map(Into::into),
    }
}

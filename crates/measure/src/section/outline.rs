//! What sections are measured against: the outlines of a nominal, and how much of each was measured.

use super::convert::outline;
use super::segment::segment_record;
use trueness_document::section::OutlineRecord;
use trueness_section::{Contour, MatchedRow, OffNominal, Outline, RowKind, covered};

/// What the points of a contour were measured against.
#[derive(Clone, Debug)]
pub struct Against<'a> {
    /// The points.
    pub points: &'a [[f64; 2]],
    /// The nearest place of each; `None` beyond the end of an open outline.
    pub found: Vec<Option<OffNominal>>,
    /// So many of these are farther off than was said.
    pub far: usize,
    /// The contour.
    pub contour: &'a Contour,
}

/// What the contours of a plane were measured against.
#[derive(Clone, Debug)]
pub struct AgainstPlane<'a> {
    /// Number of the plane; of points in order none.
    pub plane: Option<u64>,
    /// The outlines of the nominal in it.
    pub outlines: Vec<Outline>,
    /// Its contours.
    pub contours: Vec<Against<'a>>,
}

/// The row of a contour.
fn passed<'a>(c: &'a Against) -> MatchedRow<'a> {
    // Facets lie across the gaps between points of a mesh.
    let gaps = if c.contour.row_kind == RowKind::Row { &c.contour.gaps[..] } else { &[] };
    MatchedRow { points: c.points, found: &c.found, closed: c.contour.closed, gaps }
}

/// The outlines of a plane.
pub(super) fn records(against: AgainstPlane) -> Vec<OutlineRecord> {
    let rows: Vec<MatchedRow> = against.contours.iter().map(passed).collect();
    let found = covered(&rows, &against.outlines);
    let plane = against.plane;
    (against.outlines.into_iter().zip(found))
        .map(|(drawn, covered)| {
            let length = drawn.length();
            let [low, high] = drawn.bounds().unwrap_or_default();
            OutlineRecord {
                plane,
                closed: drawn.closed,
                hole: drawn.closed && drawn.area() < 0.0,
                length,
                center: [0, 1].map(|k| 0.5 * (low[k] + high[k])),
                size: [0, 1].map(|k| high[k] - low[k]),
                points: covered.points as u64,
                covered: if length > 0.0 { (covered.length() / length).min(1.0) } else { 0.0 },
                measured: covered.stretches,
                drawn: drawn.segments.iter().map(|s| segment_record(s, RowKind::Facets)).collect(),
            }
        })
        .collect()
}

/// What of it was measured, and what was not; one that lacks so little that it counts as whole is measured as it is.
pub fn divided(record: &OutlineRecord) -> [Vec<Outline>; 2] {
    let drawn = outline(record);
    let whole = || vec![drawn.clone()];
    if !record.lacks() {
        return [whole(), vec![]];
    }
    if record.covered == 0.0 {
        return [vec![], whole()];
    }
    let ends = record.measured.iter().flatten().copied();
    let ends: Vec<f64> = std::iter::once(0.0).chain(ends).chain([record.length]).collect();
    let missed: Vec<[f64; 2]> = ends.chunks(2).filter_map(|w| w.try_into().ok()).collect();
    [&record.measured, &missed].map(|stretches| drawn.parts(stretches))
}

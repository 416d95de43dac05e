//! What documents hold of sections, as geometry again.

use trueness_document::section::{
    FitRecord, GeometryRecord, OutlineRecord, SegmentRecord, UncertaintyRecord,
};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::Curve;
use trueness_section::{Geometry, Outline, PlaneMotion, Segment, Uncertainty};

/// The motion of a best fit.
pub fn motion(fit: &FitRecord) -> PlaneMotion {
    PlaneMotion { center: fit.center, turn: fit.turn, shift: fit.shift }
}

/// The outline that a record holds; one that was read from a file holds none.
pub fn outline(record: &OutlineRecord) -> Outline {
    Outline { segments: record.drawn.iter().filter_map(segment).collect(), closed: record.closed }
}

/// The curve of a spline; `None` of lines and arcs, and of numbers that are no spline.
pub fn curve(record: &SegmentRecord) -> Option<Curve<[f64; 2]>> {
    let GeometryRecord::Spline { degree, knots, control_points, .. } = &record.geometry else { return None };
    let knots = Knots::new(*degree as usize, knots.clone()).ok()?;
    Curve::new(knots, control_points.clone()).ok()
}

/// The segment; `None` of numbers that are no spline.
fn segment(record: &SegmentRecord) -> Option<Segment> {
    let geometry = match &record.geometry {
        GeometryRecord::Line { .. } => Geometry::Line,
        GeometryRecord::Arc { center, radius, start_angle, sweep } => {
            Geometry::Arc { center: *center, radius: *radius, start: *start_angle, sweep: *sweep }
        }
        GeometryRecord::Spline { deviation, .. } => {
            Geometry::Spline { curve: curve(record)?, deviation: *deviation }
        }
    };
    let uncertainty = record.uncertainty.map(|u| match u {
        UncertaintyRecord::Line { angle } => Uncertainty::Line { angle },
        UncertaintyRecord::Arc { center, radius } => Uncertainty::Arc { center, radius },
    });
    Some(Segment {
        geometry,
        start: record.start,
        end: record.end,
        length: record.length,
        count: record.count as usize,
        rms: record.rms,
        max: record.max,
        curvature: record.curvature,
        uncertainty,
        length_uncertainty: record.length_uncertainty,
    })
}

#[cfg(test)]
mod tests {
    use super::super::segment::segment_record;
    use super::*;
    use trueness_section::RowKind;

    /// Lines, arcs and splines come back as they were, to the last bit.
    #[test]
    fn segments_come_back_from_their_records() {
        let knots = Knots::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0, 1.0]).unwrap();
        let points = vec![[0.0, 0.0], [0.3, 1.0], [1.1, 0.7], [1.9, -0.2], [2.5, 0.1]];
        let curve = Curve::new(knots, points).unwrap();
        let drawn = Outline::polyline(&[[0.1, 0.2], [3.0, 4.0]], false);
        let line = Segment { count: 7, rms: 0.1, max: 0.2, ..drawn.segments[0].clone() };
        let uncertainty = Some(Uncertainty::Arc { center: [0.1, 0.2], radius: 0.3 });
        let geometry = Geometry::Arc { center: [1.0, 2.0], radius: 0.7, start: 0.3, sweep: -1.1 };
        let arc = Segment { geometry, uncertainty, length_uncertainty: Some(0.4), ..line.clone() };
        let geometry = Geometry::Spline { curve, deviation: 0.01 };
        let spline = Segment { geometry, curvature: [0.5, -0.5], ..line.clone() };
        for made in [line, arc, spline] {
            assert_eq!(segment(&segment_record(&made, RowKind::Facets)), Some(made));
        }
    }
}

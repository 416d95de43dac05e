//! Measures of airfoils.

use super::chord;
use super::found::Section;
use trueness_document::section::{AirfoilMeasures, AirfoilRecord};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_section::{Airfoil, AirfoilError, Chords, Contour, EdgeRadius, TrailingEdge, airfoil, chords};

/// The measures of all contours, whose points are `rows`.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
pub fn airfoils(
    sections: &[Section],
    rows: &[Vec<[f64; 2]>],
    progress: &dyn Progress,
) -> Result<Vec<AirfoilRecord>, Cancelled> {
    let contours = sections.iter().flat_map(|s| &s.contours);
    let each = |(n, (contour, row)): (usize, (&Contour, &Vec<[f64; 2]>))| {
        let (found, reason) = match airfoil(row, contour, progress) {
            Ok(found) => {
                let chords = chords(row, contour, &found);
                (Some(with_chords(measures(&found), chords)), None)
            }
            Err(AirfoilError::Cancelled(e)) => return Err(e),
            Err(e) => (None, Some(e.to_string())),
        };
        Ok(AirfoilRecord { contour: n as u64, measures: found, measures_reason: reason })
    };
    contours.zip(rows).enumerate().map(each).collect()
}

/// The measures with their chords.
fn with_chords(mut measures: AirfoilMeasures, found: Result<Chords, AirfoilError>) -> AirfoilMeasures {
    match found {
        Ok(found) => {
            measures.chords = chord::records(&found);
            (measures.centroid, measures.area) = (Some(found.centroid), Some(found.area));
        }
        Err(e) => measures.chords_reason = Some(e.to_string()),
    }
    measures
}

fn measures(found: &Airfoil) -> AirfoilMeasures {
    let ([a, b], [c, d]) = (found.leading, found.trailing);
    let edge = |radius: &Result<EdgeRadius, AirfoilError>| {
        let found = radius.as_ref().ok();
        let reason = radius.as_ref().err().map(ToString::to_string);
        (found.map(|r| r.radius), found.map(|r| r.uncertainty), reason)
    };
    let (leading_radius, leading_radius_uncertainty, leading_radius_reason) = edge(&found.leading_radius);
    let (trailing_radius, trailing_radius_uncertainty, trailing_radius_reason) = edge(&found.trailing_radius);
    AirfoilMeasures {
        leading_edge: found.leading,
        trailing_edge: found.trailing,
        chord: found.chord,
        chord_angle: libm::atan2(d - b, c - a),
        chords: vec![],
        chords_reason: None,
        centroid: None,
        area: None,
        stacking: None,
        thickness: found.thickness,
        thickness_uncertainty: found.thickness_uncertainty,
        thickness_at: found.thickness_at,
        thickness_center: found.thickness_center,
        camber: found.camber,
        camber_at: found.camber_at,
        leading_radius,
        leading_radius_uncertainty,
        leading_radius_reason,
        trailing_kind: found.trailing_edge.name().into(),
        trailing_thickness: match found.trailing_edge {
            TrailingEdge::Blunt(gap) | TrailingEdge::Open(gap) => Some(gap),
            TrailingEdge::Sharp | TrailingEdge::Round => None,
        },
        trailing_radius,
        trailing_radius_uncertainty,
        trailing_radius_reason,
        camber_line: found.camber_line.iter().map(|([x, y], r)| [*x, *y, *r]).collect(),
    }
}

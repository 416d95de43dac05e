//! What was found in planes or in a row of points.

use trueness_document::section::FrameRecord;
use trueness_geom::section::{PlaneFrame, SectionError};
use trueness_measure::section::Section;

/// What was found: contours by section, and the points of each contour.
pub type Sections = (Vec<Section>, Vec<Vec<[f64; 2]>>);

/// The same, or why not.
pub type Found = Result<Sections, SectionError>;

/// A frame as the document has it.
pub fn described(frame: &PlaneFrame, flatness: f64) -> FrameRecord {
    FrameRecord { origin: frame.origin, x: frame.x, y: frame.y, flatness }
}

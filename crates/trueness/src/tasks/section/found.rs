//! What was found in planes or in a row of points.

use trueness_document::section::FrameRecord;
use trueness_geom::plane::PlaneFrame;
use trueness_measure::section::Section;
use trueness_section::{Method, Search};

/// What was found.
pub struct Found {
    /// Contours by section.
    pub sections: Vec<Section>,
    /// The points of each contour.
    pub rows: Vec<Vec<[f64; 2]>>,
    /// What the paper's methods found, where one was asked for.
    pub methods: Option<Methods>,
}

/// What the paper's methods found.
pub struct Methods {
    /// The one whose contour was taken.
    pub chosen: Search,
    /// Name of the interval of the search.
    pub interval: &'static str,
    /// All methods, with the points of their curves.
    pub table: Vec<(Method, usize)>,
}

/// A frame as the document has it.
pub fn described(frame: &PlaneFrame, flatness: f64) -> FrameRecord {
    FrameRecord { origin: frame.origin, x: frame.x, y: frame.y, flatness }
}

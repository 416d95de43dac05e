//! What was found in a plane.

use trueness_document::section::FrameRecord;
use trueness_section::{Bent, Contour};

/// Contours of one plane, or of a row of points.
#[derive(Clone, Debug)]
pub struct Section {
    /// Where its plane lies.
    pub frame: FrameRecord,
    /// The plane, unless it is that of a row of points: its normal of length 1 and its offset.
    pub plane: Option<([f64; 3], f64)>,
    /// Area inside closed chains of a mesh, or why there is none.
    pub area: Result<f64, &'static str>,
    /// Points of a cloud that belong to no contour.
    pub loose: usize,
    /// Over what gaps contours of a cloud go on; where they are suspiciously many, also over what gap most of their ends would
    /// meet others.
    pub gap: Option<(f64, Option<f64>)>,
    /// How thick the slab of a cloud is.
    pub thickness: Option<f64>,
    /// The points of a cloud near the plane fill an area: there are no contours.
    pub fills_area: bool,
    /// The contours.
    pub contours: Vec<Contour>,
    /// The arcs of each contour whose radii the slab of a cloud moves; of others nothing.
    pub bent: Vec<Vec<Bent>>,
}

impl Section {
    /// What is said of a plane near which points fill an area.
    pub const FILLS_AREA: &str = "the slab holds an area of points, not contours: it lies in a face of the part; move the plane, or give a smaller --thickness";

    /// What was found in a plane, or in the plane of a row of points, but for what only a cloud has.
    pub fn new(
        frame: FrameRecord,
        plane: Option<([f64; 3], f64)>,
        area: Result<f64, &'static str>,
        contours: Vec<Contour>,
    ) -> Section {
        Section {
            frame,
            plane,
            area,
            loose: 0,
            gap: None,
            thickness: None,
            fills_area: false,
            contours,
            bent: vec![],
        }
    }
}

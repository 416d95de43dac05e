//! What a report draws of curvatures: the mesh or cloud in the colors of each of them.

use crate::{NoValue, ViewField, ViewObject, ViewRole};
use trueness_document::curvature::{CurvatureDocument, CurvatureKind};
use trueness_geom::scan::Scan;
use trueness_measure::curvature::values;
use trueness_surface::curvature::{Curvatures, NoCurvature};

/// Curvatures prepared for drawing.
pub struct View<'a> {
    name: &'a str,
    scan: &'a Scan,
    values: [Vec<f64>; 4],
    reasons: Vec<NoValue>,
    /// The places that the list leads to.
    keep: Vec<u32>,
}

impl<'a> View<'a> {
    /// Of the vertices of a mesh, or of the points of a cloud; `name` is shown to the reader.
    pub fn new(document: &CurvatureDocument, name: &'a str, scan: &'a Scan, found: &Curvatures) -> View<'a> {
        let why = |place: &Result<_, NoCurvature>| match place {
            Ok(_) => NoValue::Unknown,
            Err(NoCurvature::Boundary) => NoValue::Boundary,
            Err(NoCurvature::FewNeighbors) => NoValue::FewNeighbors,
            Err(NoCurvature::Undetermined | NoCurvature::Folded) => NoValue::Undetermined,
            Err(NoCurvature::NotASurface | NoCurvature::Unused | NoCurvature::NotFinite) => {
                NoValue::NoSurface
            }
        };
        let ends = |kind| [&document.quantity(kind).maximum, &document.quantity(kind).minimum];
        View {
            name,
            scan,
            values: CurvatureKind::ALL.map(|kind| values(found, kind)),
            reasons: found.places.iter().map(why).collect(),
            keep: CurvatureKind::ALL.into_iter().flat_map(ends).map(|place| place.index as u32).collect(),
        }
    }

    /// The mesh or cloud.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        let fields = (0..).zip(&self.values);
        let role = match self.scan {
            Scan::Cloud(_) => ViewRole::Measured,
            Scan::Mesh(_) => ViewRole::Part,
        };
        vec![ViewObject {
            role,
            name: self.name,
            color: None,
            comparison: None,
            geometry: self.scan.into(),
            fields: fields
                .map(|(comparison, values)| ViewField { comparison, values, reasons: &self.reasons })
                .collect(),
            keep: &self.keep,
            gathered: None,
            faces: None,
        }]
    }
}

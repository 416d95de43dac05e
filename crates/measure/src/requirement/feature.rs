//! The features of a plan.

use crate::cad_faces::FaceChoice;
use std::ops::Range;
use trueness_document::plan::{At, Class, DerivedWord};
use trueness_geom::feature::{Nearness, Nominal};
use trueness_geom::fit::Method;
use trueness_geom::space::{Aabb, Point, Vector};

/// A feature that can be taken.
#[derive(Clone, Debug)]
pub struct Feature {
    /// Its name.
    pub id: String,
    /// Where the name stands.
    pub span: Range<usize>,
    /// What it is.
    pub class: Class,
    /// Where it comes from.
    pub source: Source,
    /// As the model has it.
    pub nominal: Option<Nominal>,
    /// What of the measured data belongs to it.
    pub extract: Extract,
    /// How the element is associated.
    pub method: Method,
    /// A direction out of the material.
    pub outward: Option<Vector>,
    /// Of a cylinder, cone or sphere, whether the material is around it.
    pub internal: Option<bool>,
}

impl Feature {
    /// Whether it is known where it should be: written, or by faces of the reference.
    pub fn has_nominal(&self) -> bool {
        self.nominal.is_some() || matches!(self.source, Source::Seed(_) | Source::Faces(_))
    }

    /// Whether its points are those of the measured data where it should be.
    pub fn is_sought(&self) -> bool {
        matches!(self.source, Source::Nominal | Source::Seed(_) | Source::Faces(_))
    }

    /// How near facets must be to its nominal, and which way they face.
    pub fn near(&self, nominal: &Nominal) -> Nearness {
        Nearness { inward: self.internal, ..self.extract.near(nominal) }
    }
}

/// Where a feature comes from.
#[derive(Clone, Debug)]
pub enum Source {
    /// A file of its own points, as written.
    Points(At<String>),
    /// The measured data, by its nominal.
    Nominal,
    /// The measured data, by the region of the reference around this place.
    Seed(At<Point>),
    /// The measured data, by faces of a CAD model.
    Faces(At<FaceChoice>),
    /// Other features.
    Derived {
        /// How.
        how: DerivedWord,
        /// Their numbers.
        of: [usize; 2],
    },
}

/// Distance from the nominal surface within which facets belong to a feature, over the size of the feature.
const EXTRACT_DISTANCE_SHARE: f64 = 0.02;

/// What of the measured data belongs to a feature of the model. Lengths in millimeters.
#[derive(Clone, Copy, Debug)]
pub struct Extract {
    /// Distance from the nominal surface within which facets belong to it; by the size of the feature without.
    pub distance: Option<f64>,
    /// What is left out along the bounds of the feature; below zero, how far it may reach beyond them.
    pub margin: Option<f64>,
    /// Angle between normals within which facets belong to it, radians.
    pub angle: f64,
    /// Whether vertices that facets of other features share count.
    pub rim: bool,
    /// Whether points of a scan that stick out by themselves count.
    pub outliers: bool,
    /// Least share of the nominal area that must have been measured.
    pub coverage: f64,
}

impl Extract {
    /// Whether something is left out along the borders.
    pub fn has_margin(&self) -> bool {
        self.margin.is_some_and(|margin| margin > 0.0)
    }

    fn near(&self, nominal: &Nominal) -> Nearness {
        let size = match nominal {
            Nominal::Plane { boundary, .. } => Aabb::of(boundary).diagonal(),
            Nominal::Cylinder { radius, length, .. } => length.max(2.0 * radius),
            Nominal::Cone { between: [from, to], .. } => (to - from).abs(),
            Nominal::Sphere { radius, .. } => 2.0 * radius,
            Nominal::Edge { length, .. } => *length,
        };
        let distance = self.distance.unwrap_or(EXTRACT_DISTANCE_SHARE * size);
        // A measured edge may be as far off as a measured surface.
        let margin = self.margin.unwrap_or(-distance);
        Nearness { distance, angle: self.angle, margin, rim: self.rim, inward: None }
    }
}

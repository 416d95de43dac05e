//! The curvatures of a place, each with its name, unit and value.

use crate::results::curvature::{CurvatureDocument, Quantity};
use trueness_geom::spline::surface::Bend;
use trueness_surface::curvature::Curvatures;

/// One of the curvatures of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurvatureKind {
    /// Mean of the principal curvatures.
    Mean,
    /// Their product.
    Gaussian,
    /// The greater one.
    K1,
    /// The lesser one.
    K2,
}

impl CurvatureKind {
    /// All of them, in the order in which reports show them.
    pub const ALL: [CurvatureKind; 4] =
        [CurvatureKind::Mean, CurvatureKind::Gaussian, CurvatureKind::K1, CurvatureKind::K2];

    /// Name in documents and files.
    pub fn name(self) -> &'static str {
        match self {
            CurvatureKind::Mean => "mean",
            CurvatureKind::Gaussian => "gaussian",
            CurvatureKind::K1 => "k1",
            CurvatureKind::K2 => "k2",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        if self == CurvatureKind::Gaussian { "mm⁻²" } else { "mm⁻¹" }
    }

    /// What is drawn flat on a body of this size, millimeters: less than that is rounding or noise. Over the whole body the surface
    /// then bows by no more than an 80,000th of the size.
    pub fn least(self, size: f64) -> f64 {
        const FLAT: f64 = 1e-4;
        if size == 0.0 {
            return 0.0;
        }
        if self == CurvatureKind::Gaussian { FLAT / (size * size) } else { FLAT / size }
    }

    /// The value of a place.
    pub fn of(self, bend: &Bend) -> f64 {
        match self {
            CurvatureKind::Mean => bend.mean,
            CurvatureKind::Gaussian => bend.gaussian,
            CurvatureKind::K1 => bend.principal[0].curvature,
            CurvatureKind::K2 => bend.principal[1].curvature,
        }
    }
}

impl CurvatureDocument {
    /// What was found of a curvature.
    pub fn quantity(&self, kind: CurvatureKind) -> &Quantity {
        match kind {
            CurvatureKind::Mean => &self.mean,
            CurvatureKind::Gaussian => &self.gaussian,
            CurvatureKind::K1 => &self.k1,
            CurvatureKind::K2 => &self.k2,
        }
    }
}

/// The values of all places, NaN where there is none.
pub fn values(found: &Curvatures, kind: CurvatureKind) -> Vec<f64> {
    found.places.iter().map(|p| p.as_ref().map_or(f64::NAN, |jet| kind.of(&jet.bend))).collect()
}

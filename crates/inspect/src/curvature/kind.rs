//! The curvatures of a place, each with its name, unit and value.

use crate::results::curvature::{CurvatureDocument, Quantity};
use trueness_geom::curvature::Curvatures;
use trueness_geom::spline::surface::Bend;

/// One of the curvatures of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Mean of the principal curvatures.
    Mean,
    /// Their product.
    Gaussian,
    /// The greater one.
    K1,
    /// The lesser one.
    K2,
}

impl Kind {
    /// All of them, in the order in which reports show them.
    pub const ALL: [Kind; 4] = [Kind::Mean, Kind::Gaussian, Kind::K1, Kind::K2];

    /// Name in documents and files.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Mean => "mean",
            Kind::Gaussian => "gaussian",
            Kind::K1 => "k1",
            Kind::K2 => "k2",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        if self == Kind::Gaussian { "mm⁻²" } else { "mm⁻¹" }
    }

    /// What is drawn flat on a body of this size, millimetres: less than that is rounding or noise. Over the whole body the surface
    /// then bows by no more than an 80,000th of the size.
    pub fn least(self, size: f64) -> f64 {
        const FLAT: f64 = 1e-4;
        if size == 0.0 {
            return 0.0;
        }
        if self == Kind::Gaussian { FLAT / (size * size) } else { FLAT / size }
    }

    /// The value of a place.
    pub fn of(self, bend: &Bend) -> f64 {
        match self {
            Kind::Mean => bend.mean,
            Kind::Gaussian => bend.gaussian,
            Kind::K1 => bend.principal[0].curvature,
            Kind::K2 => bend.principal[1].curvature,
        }
    }
}

impl CurvatureDocument {
    /// What was found of a curvature.
    pub fn quantity(&self, kind: Kind) -> &Quantity {
        match kind {
            Kind::Mean => &self.mean,
            Kind::Gaussian => &self.gaussian,
            Kind::K1 => &self.k1,
            Kind::K2 => &self.k2,
        }
    }
}

/// The values of all places, NaN where there is none.
pub fn values(found: &Curvatures, kind: Kind) -> Vec<f64> {
    found.places.iter().map(|p| p.as_ref().map_or(f64::NAN, |jet| kind.of(&jet.bend))).collect()
}

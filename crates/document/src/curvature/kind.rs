//! The curvatures of a place, each with its name and unit.

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
        const MAX_FLAT_BEND: f64 = 1e-4;
        if size == 0.0 {
            return 0.0;
        }
        if self == CurvatureKind::Gaussian { MAX_FLAT_BEND / (size * size) } else { MAX_FLAT_BEND / size }
    }
}

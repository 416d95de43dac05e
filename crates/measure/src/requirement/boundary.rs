//! The boundary that a material requirement sets.

use trueness_document::plan::MaterialWord;

/// The boundary that a material requirement sets to a feature of size: a perfect cylinder, which the surface must not pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary {
    /// Which requirement.
    pub word: MaterialWord,
    /// Whether the surface must lie within it, as that of a shaft in a gauge ring; else around it.
    pub around: bool,
    /// Maximum or least material size: a diameter, millimeters.
    pub size: f64,
}

impl Boundary {
    /// Diameter of the virtual condition with this geometrical tolerance.
    pub fn virtual_size(&self, tolerance: f64) -> f64 {
        if self.around { self.size + tolerance } else { self.size - tolerance }
    }
}

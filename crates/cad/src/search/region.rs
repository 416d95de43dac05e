//! What is asked of a trimmed face.

use crate::trim::Trim;

/// What of its surface a face is, as the search asks it.
pub trait Region: Sync + Send {
    /// Whether the face has the place with these parameters, whatever number of periods they are away. Its border belongs to it.
    fn contains(&self, at: [f64; 2]) -> bool;
    /// First and last `u`, first and last `v` of the face, on one sheet where parameters repeat.
    fn window(&self) -> [[f64; 2]; 2];
    /// How far its edges may be from its surface.
    fn gap(&self) -> f64 {
        0.0
    }
}

impl Region for Trim {
    fn contains(&self, at: [f64; 2]) -> bool {
        Trim::contains(self, at)
    }
    fn window(&self) -> [[f64; 2]; 2] {
        self.window
    }
    fn gap(&self) -> f64 {
        self.gap
    }
}

//! A region while it is searched for.

use crate::shape::Shape;

/// Root mean square distance, in standard deviations of the noise, beyond which another kind may be the right one. The right
/// element has 1, known to 2 % from the points that are fitted. The rest allows for noise that is not the same everywhere.
const DOUBTFUL_RMS: f64 = 1.25;

/// An element and the pieces that belong to it.
#[derive(Clone, Debug)]
pub(super) struct GrownRegion {
    pub shape: Shape,
    pub pieces: Vec<u32>,
    pub weight: f64,
    /// Root mean square distance of some of its points, millimeters.
    pub rms: f64,
    /// The same of the middles of its pieces.
    pub middles: f64,
}

impl GrownRegion {
    /// Its weight, less where it fits worse than noise of this standard deviation: who comes first.
    pub(super) fn merit(&self, noise: f64) -> f64 {
        self.weight / (1.0 + (self.rms / noise).powi(2))
    }
    /// Whether it fits so much worse than the noise that its kind may be the wrong one.
    pub(super) fn is_doubtful(&self, noise: f64) -> bool {
        self.rms > DOUBTFUL_RMS * noise
    }
}

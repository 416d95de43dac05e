//! The noise of a scan, and why none is told.

use crate::progress::Cancelled;

/// Correlation of shared noise at a distance in reaches (Wendland).
pub(super) fn shared(t: f64) -> f64 {
    if t < 1.0 { (1.0 - t).powi(4) * (4.0 * t + 1.0) } else { 0.0 }
}

/// The noise of a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Standard deviation of a point across the surface, millimeters.
    pub deviation: f64,
    /// Share of its variance that no neighbor has, 0 to 1.
    pub white: f64,
    /// Distance beyond which two points share no noise, millimeters; 0 where none do.
    pub reach: f64,
    /// Points that tell as much as one independent point, 1 or more: the sum of the correlations of a point with all, itself counted.
    pub points_per_independent: f64,
    /// Distance of neighboring points, millimeters: the root of the area of a point, the median over the patches.
    pub spacing: f64,
    /// Patches that the noise is told from.
    pub patches: usize,
    /// Patches left out, which lie over edges or form.
    pub excluded_patches: usize,
    /// How much the variances of the patches differ, in what chance makes: about 1 where the noise is the same everywhere.
    pub unevenness: f64,
}

/// Greatest unevenness of noise from patch to patch. Random scans with noise of zero to three rings show up to 1.5, scans of
/// free forms 3.4 and more.
const MAX_UNEVENNESS: f64 = 2.5;

impl Noise {
    /// This noise, where it is the same everywhere; what differs from patch to patch is form.
    ///
    /// # Errors
    /// [`NoNoise::Uneven`].
    pub fn even(self) -> Result<Noise, NoNoise> {
        if self.unevenness <= MAX_UNEVENNESS { Ok(self) } else { Err(NoNoise::Uneven) }
    }

    /// Correlation of the noise of two points at a distance in millimeters.
    pub fn correlation(&self, distance: f64) -> f64 {
        if distance == 0.0 {
            return 1.0;
        }
        if self.reach > 0.0 { (1.0 - self.white) * shared(distance / self.reach) } else { 0.0 }
    }
}

/// Why no noise is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoNoise {
    /// Too few points, or none of them have neighbors enough.
    #[error(
        "it has too few points to tell how far neighbors share noise: {found} patches of {needed}, {least} are needed"
    )]
    FewPatches {
        /// Patches found.
        found: usize,
        /// Points of a patch.
        needed: usize,
        /// Patches needed.
        least: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is not a finite number; remove it")]
    NotFinite {
        /// Index of the first such point.
        index: usize,
    },
    /// A facet names a vertex that does not exist.
    #[error("facet {facet} names a vertex that does not exist")]
    NoSuchVertex {
        /// Index of the first such facet.
        facet: usize,
    },
    /// The rest of patches is form.
    #[error("it departs from smooth surfaces by more in one place than in another: that is its form")]
    Uneven,
    /// The mesh was drawn: its vertices lie where somebody put them.
    #[error("it is drawn, not measured")]
    Drawn,
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

//! Whether the measured is the mirror image of the reference: a part of the other hand, or an axis of other sign.

use super::rows::MIRROR_RMS_RATIO;
use super::sample::Samples;
use super::start::Search;
use super::work::{START_SAMPLES, Work};
use super::{AlignError, Alignment};
use crate::progress::Progress;
use crate::rigid::Rigid;

/// The evidence of the mirror image of the measured.
pub(super) enum Mirror {
    /// Nothing: it fits no better.
    Same,
    /// It led to a better pose: the reference is its own mirror image.
    Better(Rigid),
    /// It fits much better, so many times as well.
    Mirrored {
        /// Root mean square of what it leaves over what the measured leaves.
        ratio: f64,
    },
}

impl Work<'_> {
    /// Looks for the mirror image of what fits badly. The cost is that of one more search.
    pub(super) fn mirror(
        &self,
        search: &Search,
        result: &Alignment,
        samples: &Samples,
        subset: &Samples,
        progress: &dyn Progress,
    ) -> Result<Mirror, AlignError> {
        let image = samples.mirrored();
        let again = search.again(image.oriented_subset(START_SAMPLES, self.options.seed), self.options.seed);
        let poses = self.briefly(&again, &[], progress)?;
        if poses.is_empty() {
            return Ok(Mirror::Same);
        }
        let image = subset.mirrored();
        let (there, sigma) = self.choose(&poses, &image, progress)?;
        let cap = self.cap(sigma);
        let own = self.problem(subset).cost(&result.reference_from_measured, cap, progress)?;
        let enough = MIRROR_RMS_RATIO * MIRROR_RMS_RATIO * own;
        let left = self.problem(&image).cost(&there, cap, progress)?;
        if left >= enough {
            return Ok(Mirror::Same);
        }
        // A part that is its own mirror image fits as well in another pose, which the search did not find.
        let other = self.choose(&search.in_mirrors(&there), subset, progress)?.0;
        if self.problem(subset).cost(&other, cap, progress)? < enough {
            return Ok(Mirror::Better(other));
        }
        Ok(Mirror::Mirrored { ratio: (left / own).sqrt() })
    }
}

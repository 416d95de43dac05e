//! Whether neighbors share errors, for the tasks that state uncertainties.

use super::{TaskError, Watch, ended};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_geom::noise::MAX_PATCHES;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_measure::{NoSharedNoise, NoiseOrReason};

/// How far neighbors share errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Independence {
    /// Take the errors of the points as independent, as of points probed one by one. Without it what neighbors share is found in the data,
    /// and uncertainties take it into account.
    pub independent: bool,
}

impl Independence {
    /// Refused for what counts as independent without being asked; `shown` names the file.
    ///
    /// # Errors
    /// Wrong usage.
    pub fn only_for_meshes(self, shown: &str) -> Result<(), TaskError> {
        match self.independent {
            true => Err(TaskError::usage(format!(
                "--independent is for meshes: the points of {shown} count as independent without it"
            ))),
            false => Ok(()),
        }
    }

    /// What `find` finds in a stage of its own, unless errors are independent.
    ///
    /// # Errors
    /// Cancelled.
    pub fn shared_noise(
        self,
        watch: &dyn Watch,
        find: impl FnOnce(&dyn Progress) -> Result<NoiseOrReason, Cancelled>,
    ) -> Result<NoiseOrReason, TaskError> {
        if self.independent {
            return Ok(Err(NoSharedNoise::Independent));
        }
        let stage = watch.stage("finding the noise", "patches", Some(MAX_PATCHES as u64));
        let found = find(&*stage);
        Ok(ended(stage, found)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::ErrorKind;
    use trueness_geom::progress::Silent;

    #[test]
    fn nothing_is_looked_for_where_errors_are_independent() {
        let find = |_: &dyn Progress| Err(Cancelled);
        let found = Independence { independent: true }.shared_noise(&Silent, find).unwrap();
        assert_eq!(found.unwrap_err(), NoSharedNoise::Independent);
        let stopped = Independence::default().shared_noise(&Silent, find).unwrap_err();
        assert_eq!(stopped.kind(), ErrorKind::Cancelled);
        let refused = Independence { independent: true }.only_for_meshes("row.xyz").unwrap_err();
        assert_eq!(refused.kind(), ErrorKind::Usage);
        assert!(Independence::default().only_for_meshes("row.xyz").is_ok());
    }
}

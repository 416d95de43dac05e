//! How far neighbors share errors: the option of the commands that state uncertainties, and the line of their tables.

use crate::exit::Usage;
use crate::number::{fixed, scientific};
use crate::options::ProgressStyle;
use crate::progress::Stage;
use clap::Args;
use trueness_document::SharedNoise;
use trueness_geom::noise::PATCHES;
use trueness_geom::progress::Cancelled;
use trueness_measure::NoiseOrReason;

/// How far neighbors share errors.
#[derive(Args, Debug)]
pub struct NoiseArgs {
    /// Take the errors of the points as independent, as of points probed one by one. Without it what neighbors share is found in the data,
    /// and uncertainties take it into account
    #[arg(long)]
    independent: bool,
}

impl NoiseArgs {
    /// Refused for what counts as independent without being asked.
    pub fn only_for_meshes(&self, shown: &str) -> Result<(), Usage> {
        match self.independent {
            true => Err(Usage(format!(
                "--independent is for meshes: the points of {shown} count as independent without it"
            ))),
            false => Ok(()),
        }
    }

    /// What is found, in a stage of its own, unless errors are independent.
    pub fn found(
        &self,
        style: ProgressStyle,
        find: impl FnOnce(&Stage) -> Result<NoiseOrReason, Cancelled>,
    ) -> Result<NoiseOrReason, Cancelled> {
        if self.independent {
            return Ok(Err("errors are independent, as --independent says".into()));
        }
        let stage = Stage::new(style, "finding the noise", "patches", Some(PATCHES as u64));
        let found = find(&stage);
        stage.end(&found);
        found
    }
}

/// The line that tells it, where neighbors share noise.
pub fn line(noise: Option<&SharedNoise>) -> String {
    noise.filter(|n| n.points_per_independent > 1.0).map_or_else(String::new, |n| {
        format!(
            "noise {}, shared over {} mm: {} points tell as much as an independent one, and ± says so\n",
            scientific(n.deviation, 2),
            fixed(n.reach, 2),
            fixed(n.points_per_independent, 1)
        )
    })
}

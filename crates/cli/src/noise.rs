//! How far neighbors share errors: the option of the commands that state uncertainties, and the line of their tables.

use crate::number::{fixed, scientific};
use clap::Args;
use trueness::task::Independence;
use trueness_document::SharedNoise;

/// How far neighbors share errors.
#[derive(Args, Debug)]
pub struct NoiseArgs {
    /// Take the errors of the points as independent, as of points probed one by one. Without this option, the noise shared by neighbors
    /// is estimated from the data, and uncertainties allow for it
    #[arg(long)]
    independent: bool,
}

impl NoiseArgs {
    /// The same for a request.
    pub fn request(&self) -> Independence {
        Independence { independent: self.independent }
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

//! What the entries of the list of steps are.

use super::error::RepairError;
use super::work::Work;

/// A step of the repair: an entry of [`STEPS`](super::STEPS).
#[derive(Debug)]
pub struct Step {
    /// Its name on the command line and in result documents.
    pub name: &'static str,
    /// What it does, for the manual.
    pub about: &'static str,
    pub(super) run: fn(&mut Work) -> Result<(), RepairError>,
}

impl Step {
    /// The state after this step, made from the one before.
    pub(super) fn done<'a>(&self, mut work: Work<'a>) -> Result<Work<'a>, RepairError> {
        (self.run)(&mut work)?;
        Ok(work)
    }
}

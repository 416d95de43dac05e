//! What a command is to the program.

use crate::options::Common;
use trueness::task::Outcome;
use trueness::task::RunFiles;

/// A command with its words.
pub trait Run {
    /// All files that it reads and writes. They are tried before it runs.
    fn files(&self, common: &Common) -> anyhow::Result<RunFiles>;
    /// Does the work.
    fn run(&self, common: &Common) -> anyhow::Result<Outcome>;
}

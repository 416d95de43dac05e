//! What a task is asked.

use super::{Done, RunFiles, TaskError, Watch};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use trueness_files::Sources;

/// The request of a task: a plain value with defaults, which words of a command line, keywords and a JSON object become alike.
pub trait Request: Serialize + DeserializeOwned + JsonSchema {
    /// The result document.
    type Document: Serialize;

    /// The command of this name.
    const COMMAND: &'static str;

    /// All files that it reads and writes, those that its own inputs name in `sources` among them.
    ///
    /// # Errors
    /// Values that cannot be meant.
    fn files(&self, sources: &dyn Sources) -> Result<RunFiles, TaskError>;

    /// Tries the files, then answers: what is read is never overwritten, and an output that cannot be written is told before any work.
    ///
    /// # Errors
    /// Those of [`RunFiles::check`]; why there is no answer.
    fn run(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<Self::Document>, TaskError> {
        self.files(sources)?.check(watch)?;
        self.answer(sources, watch)
    }

    /// Answers. For callers that have tried the [files](Request::files) together with files of their own.
    ///
    /// # Errors
    /// Why there is no answer.
    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<Self::Document>, TaskError>;
}

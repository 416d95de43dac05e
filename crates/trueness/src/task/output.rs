//! Files that a task writes: whole or not at all.

use super::TaskError;
use serde::Serialize;
use std::io::{BufWriter, Write};
use std::path::Path;
use trueness_files::{AtomicFile, WriteError};

/// A file that lies unfinished beside its place. Dropped, it is removed.
pub struct Output(Box<dyn FnOnce() -> Result<(), WriteError> + Send>);

impl Output {
    /// A file whose bytes are written now.
    ///
    /// # Errors
    /// Those of writing.
    pub fn written(
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
    ) -> Result<Output, WriteError> {
        let make = || {
            let mut file = BufWriter::new(AtomicFile::create(path)?);
            write(&mut file)?;
            file.into_inner().map_err(|e| e.into_error())
        };
        Ok(Output::file(path, make().map_err(|e| WriteError::new(path, e))?))
    }

    /// A file that is written.
    pub fn file(path: &Path, file: AtomicFile) -> Output {
        let place = path.to_path_buf();
        Output::later(move || file.commit().map_err(|e| WriteError::new(&place, e)))
    }

    /// A file that `finish` puts in its place.
    pub fn later(finish: impl FnOnce() -> Result<(), WriteError> + Send + 'static) -> Output {
        Output(Box::new(finish))
    }

    /// Puts it in its place.
    ///
    /// # Errors
    /// Those of writing.
    pub fn commit(self) -> Result<(), WriteError> {
        (self.0)()
    }
}

/// Writes a file that appears whole or not at all.
///
/// # Errors
/// Those of writing.
pub fn whole_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), WriteError> {
    Output::written(path, write)?.commit()
}

/// A document as the text of its file.
///
/// # Errors
/// A document that is no JSON, which none is.
pub fn json(document: &impl Serialize) -> Result<String, TaskError> {
    let mut text = serde_json::to_string_pretty(document).map_err(TaskError::because)?;
    text.push('\n');
    Ok(text)
}

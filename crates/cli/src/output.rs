//! Where an answer goes: files that appear whole or not at all, the document, the table.

use crate::console;
use crate::options::DocumentArgs;
use std::io::{BufWriter, Write};
use std::path::Path;
use trueness_files::{AtomicFile, WriteError};

/// Writes a file that appears whole or not at all.
pub fn whole_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), WriteError> {
    let make = || {
        let mut file = BufWriter::new(AtomicFile::create(path)?);
        write(&mut file)?;
        file.into_inner().map_err(|e| e.into_error())?.commit()
    };
    make().map_err(|e| WriteError::new(path, e))
}

impl DocumentArgs {
    /// Writes the document if it was asked for.
    pub fn write(&self, document: &impl serde::Serialize) -> anyhow::Result<()> {
        let Some(path) = &self.json else { return Ok(()) };
        let mut text = serde_json::to_string_pretty(document)?;
        text.push('\n');
        if self.on_stdout() {
            return Ok(console::document(&text)?);
        }
        Ok(whole_file(path, |file| file.write_all(text.as_bytes()))?)
    }

    /// Prints the table, unless the document has taken its place.
    pub fn table(&self, text: impl FnOnce() -> String) -> anyhow::Result<()> {
        if self.on_stdout() { Ok(()) } else { Ok(console::table(&text())?) }
    }

    fn on_stdout(&self) -> bool {
        self.json.as_deref() == Some(Path::new("-"))
    }
}

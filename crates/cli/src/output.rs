//! Where an answer goes: files that appear whole or not at all, the document, the table.

use crate::console;
use crate::options::DocumentArgs;
use std::path::Path;
pub use trueness::task::whole_file;

impl DocumentArgs {
    /// Writes the document if it was asked for.
    pub fn write(&self, document: &impl serde::Serialize) -> anyhow::Result<()> {
        let Some(path) = &self.json else { return Ok(()) };
        let text = trueness::task::json(document)?;
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

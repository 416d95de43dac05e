//! What is counted in all crates, beside what is written down.

use super::Report;
use super::circles::Graphs;
use super::{limits, rooms};
use std::io;
use std::path::Path;

/// The counts of all crates.
#[derive(Default)]
pub struct Count {
    now: limits::Table,
    names: rooms::Names,
    circles: Vec<String>,
}

impl Count {
    /// Adds a crate.
    ///
    /// # Errors
    /// A file that cannot be read or is not Rust.
    pub fn add(&mut self, source: &Path, graphs: &Graphs, name: &str) -> io::Result<()> {
        let mut found = rooms::of_crate(source, graphs, name, &mut self.names)?;
        self.now.append(&mut found.counts);
        self.circles.append(&mut found.circles);
        Ok(())
    }

    /// Reports what has become more or less than the file of limits has; with `write` all is written there first.
    ///
    /// # Errors
    /// A file that cannot be read or written.
    pub fn compare(mut self, file: &Path, write: bool, verbose: bool, report: &mut Report) -> io::Result<()> {
        let shared = rooms::shared(&self.names);
        self.now.insert(limits::PROJECT.to_string(), limits::Counts([shared, 0]));
        let mut allowed = if file.exists() { limits::read(file)? } else { limits::Table::new() };
        if write {
            report.notes.extend(limits::raised(&self.now, &allowed));
            limits::write(file, &self.now)?;
            allowed = self.now.clone();
        }
        report.failures.extend(self.circles);
        let found = limits::compare(&self.now, &allowed);
        report.failures.extend(found.failures);
        report.notes.extend(found.notes);
        report.notes.push(rooms::summary(&self.names, verbose));
        Ok(())
    }
}

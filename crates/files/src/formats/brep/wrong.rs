//! What is wrong with an entity of a file.

/// What is wrong with an entity.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("#{entity}{} {reason}", shown(*.line))]
pub(crate) struct Wrong {
    /// Its number.
    pub entity: u64,
    /// Its line, 0 where it is not in the file.
    pub line: u64,
    /// What is wrong.
    pub reason: String,
}

/// What can be at fault.
pub(crate) trait Faulty {
    /// What is wrong with it.
    fn wrong(&self, reason: &str) -> Wrong;
}

/// A line in brackets.
fn shown(line: u64) -> String {
    if line == 0 { String::new() } else { format!(" (line {line})") }
}

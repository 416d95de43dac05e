//! Everything that is printed goes through here: tables on stdout, notes and errors on stderr.

use std::io::{ErrorKind, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use trueness::task::causes;

static QUIET: AtomicBool = AtomicBool::new(false);

/// With `true`, tables are not printed; documents asked for on stdout and errors still are.
pub fn quiet(on: bool) {
    QUIET.store(on, Ordering::Relaxed);
}

/// The standard output cannot be written to.
#[derive(Debug, thiserror::Error)]
#[error("standard output: {0}; the result was not shown")]
pub struct StdoutError(std::io::Error);

/// Prints text for people on stdout.
pub fn table(text: &str) -> Result<(), StdoutError> {
    if QUIET.load(Ordering::Relaxed) { Ok(()) } else { document(text) }
}

/// Writes a document that was asked for on stdout. A reader that has gone away (`| head`) is no error: it has what it
/// wanted.
pub fn document(text: &str) -> Result<(), StdoutError> {
    let mut out = std::io::stdout().lock();
    fitting(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}

/// Prints the help, the version, or what is wrong with the words of the command line, as the parser has it.
pub fn parser(message: &clap::Error) -> Result<(), StdoutError> {
    fitting(message.print().and_then(|()| std::io::stdout().flush()))
}

fn fitting(written: std::io::Result<()>) -> Result<(), StdoutError> {
    written.or_else(|e| if e.kind() == ErrorKind::BrokenPipe { Ok(()) } else { Err(StdoutError(e)) })
}

/// Prints a line on stderr. Where that cannot be done, there is nobody to tell.
pub fn note(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Prints an error and what led to it on stderr, as one line for each cause.
pub fn error(error: &(dyn std::error::Error + 'static)) {
    for (n, text) in causes(error).iter().enumerate() {
        note(&format!("{}{text}", if n == 0 { "trueness: " } else { "  because: " }));
    }
}

/// Lays rows out in columns: the first column flush left, the others flush right, two spaces between.
pub fn columns(rows: &[Vec<String>]) -> String {
    let width = |i: usize| rows.iter().filter_map(|r| r.get(i)).map(|c| c.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..rows.iter().map(Vec::len).max().unwrap_or(0)).map(width).collect();
    let mut out = String::new();
    for row in rows {
        let mut line = String::new();
        for (i, cell) in row.iter().enumerate() {
            let pad = " ".repeat(widths[i] - cell.chars().count());
            line.push_str(if i > 0 { "  " } else { "" });
            line.push_str(&if i == 0 { format!("{cell}{pad}") } else { format!("{pad}{cell}") });
        }
        out.push_str(line.trim_end());
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn aligns_columns() {
        let rows = [vec!["a".into(), "1.5".into()], vec!["long".into(), "−22".into()]];
        assert_eq!(columns(&rows), "a     1.5\nlong  −22\n");
    }
}

//! Everything that is printed goes through here: tables on stdout, notes and errors on stderr.
#![expect(clippy::print_stderr, reason = "this is the one place that prints")]

use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

static QUIET: AtomicBool = AtomicBool::new(false);

/// With `true`, tables are not printed; documents asked for on stdout and errors still are.
pub fn quiet(on: bool) {
    QUIET.store(on, Ordering::Relaxed);
}

/// Prints text for people on stdout. A reader that has gone away (`| head`) is no error.
pub fn table(text: &str) {
    if !QUIET.load(Ordering::Relaxed) {
        let _ = std::io::stdout().write_all(text.as_bytes());
    }
}

/// Writes a document that was asked for on stdout.
pub fn document(text: &str) -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()
}

/// Prints a line on stderr.
pub fn note(text: &str) {
    eprintln!("{text}");
}

/// Prints an error and what led to it on stderr, as one line for each cause.
pub fn error(error: &anyhow::Error) {
    eprintln!("trueness: {error}");
    let mut last = error.to_string();
    for cause in error.chain().skip(1) {
        let text = cause.to_string();
        // Transparent wrappers repeat their cause.
        if !last.contains(&text) {
            eprintln!("  because: {text}");
        }
        last = text;
    }
}

/// `1234567` as `1,234,567`.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(c);
    }
    out
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
    fn groups_by_three() {
        for (n, text) in [(0, "0"), (999, "999"), (1000, "1,000"), (1234567, "1,234,567")] {
            assert_eq!(grouped(n), text);
        }
    }

    #[test]
    fn aligns_columns() {
        let rows = [vec!["a".into(), "1.5".into()], vec!["long".into(), "−22".into()]];
        assert_eq!(columns(&rows), "a     1.5\nlong  −22\n");
    }
}

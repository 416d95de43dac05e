//! Tables and sentences within the width of a terminal.

use std::fmt::Write;

/// Most letters in a line of a table.
pub const MAX_LINE_LETTERS: usize = 100;
/// Least letters that a column of texts keeps where a table is too wide.
const MIN_COLUMN_LETTERS: usize = 6;

fn letters(text: &str) -> usize {
    text.chars().count()
}

/// Rows in columns, two spaces between: the first `texts` columns flush left, the others, numbers, flush right. Where a row is too long
/// for the width, its texts stand on a line of their own above its numbers.
pub fn table(rows: &[Vec<String>], texts: usize) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let natural = |k: usize| rows.iter().filter_map(|r| r.get(k)).map(|c| letters(c)).max().unwrap_or(0);
    let mut widths: Vec<usize> = (0..count).map(natural).collect();
    let texts = texts.min(count);
    let numbers: usize = widths[texts..].iter().map(|w| w + 2).sum();
    loop {
        let own: usize = widths[..texts].iter().filter(|w| **w > 0).map(|w| w + 2).sum();
        let widest = (0..texts).max_by_key(|k| widths[*k]).filter(|k| widths[*k] > MIN_COLUMN_LETTERS);
        match widest {
            Some(k) if own + numbers > MAX_LINE_LETTERS + 2 => widths[k] -= 1,
            _ => break,
        }
    }
    let mut out = String::new();
    for row in rows {
        let fits = row.iter().zip(&widths).take(texts).all(|(c, w)| letters(c) <= *w);
        if !fits {
            let label: Vec<&str> =
                row.iter().take(texts).map(String::as_str).filter(|c| !c.is_empty()).collect();
            let _ = writeln!(out, "{}", label.join("  "));
        }
        let mut line = String::new();
        for (k, cell) in row.iter().enumerate().filter(|(k, _)| widths[*k] > 0) {
            let cell = if k < texts && !fits { "" } else { cell.as_str() };
            let pad = " ".repeat(widths[k].saturating_sub(letters(cell)));
            let gap = if line.is_empty() && k == 0 { "" } else { "  " };
            line += &if k < texts { format!("{gap}{cell}{pad}") } else { format!("{gap}{pad}{cell}") };
        }
        let _ = writeln!(out, "{}", line.trim_end());
    }
    out
}

/// A sentence with its mark, cut into lines; those behind the first are indented. A word that is longer than a line stays whole.
pub fn wrapped(text: &str) -> String {
    let mut out = String::new();
    let mut line = text.chars().take_while(|c| *c == ' ').collect::<String>();
    let mut is_empty = true;
    for word in text.split_whitespace() {
        if !is_empty && letters(&line) + 1 + letters(word) > MAX_LINE_LETTERS {
            let _ = writeln!(out, "{line}");
            (line, is_empty) = ("    ".into(), true);
        }
        line += if is_empty { "" } else { " " };
        line += word;
        is_empty = false;
    }
    let _ = writeln!(out, "{line}");
    out
}

/// The same as one line where all is to be told: it can be searched then.
pub fn sentence(text: &str, verbose: bool) -> String {
    if verbose { format!("{text}\n") } else { wrapped(text) }
}

/// Names of what is said something of; of many the first ones.
pub fn names(all: &[&str], verbose: bool) -> String {
    const MAX_LISTED_NAMES: usize = 4;
    match all.len() {
        n if verbose || n <= MAX_LISTED_NAMES + 1 => all.join(", "),
        n => format!("{} and {} more", all[..MAX_LISTED_NAMES].join(", "), n - MAX_LISTED_NAMES),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(cells: &[&str]) -> Vec<String> {
        cells.iter().map(|c| c.to_string()).collect()
    }

    #[test]
    fn texts_stand_left_and_numbers_right() {
        let rows = [row(&["a", "plane", "1.5"]), row(&["long", "x", "−22"])];
        assert_eq!(table(&rows, 2), "a     plane  1.5\nlong  x      −22\n");
    }

    #[test]
    fn no_line_is_wider_than_a_terminal_and_long_names_do_not_break_columns() {
        let long = "a very long name of a characteristic that nobody would write twice, but many write once";
        let rows =
            [row(&["id", "kind", "value"]), row(&[long, "flatness", "1.5"]), row(&["b", "size", "22.5"])];
        let text = table(&rows, 2);
        assert!(text.lines().all(|l| letters(l) <= MAX_LINE_LETTERS), "{text}");
        let ends: Vec<usize> = text.lines().filter(|l| !l.starts_with("a very")).map(letters).collect();
        assert!(ends.windows(2).all(|w| w[0] == w[1]), "{text}");
    }

    #[test]
    fn sentences_are_cut_between_words() {
        let text = "word ".repeat(60);
        let cut = wrapped(&format!("! {text}"));
        assert!(cut.lines().all(|l| letters(l) <= MAX_LINE_LETTERS) && cut.starts_with("! word"), "{cut}");
        assert_eq!(cut.split_whitespace().count(), 61);
        assert_eq!(names(&["1", "2", "3", "4", "5", "6"], false), "1, 2, 3, 4 and 2 more");
    }
}

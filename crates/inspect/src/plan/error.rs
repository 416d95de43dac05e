//! What is wrong with a plan, and where.

use std::ops::Range;

/// A fault of a plan: place, what is wrong, what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}, column {column}: {what}")]
pub struct PlanError {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong and what to do.
    pub what: String,
}

impl PlanError {
    /// The fault at these bytes of the text.
    pub fn at(text: &str, span: &Range<usize>, what: impl Into<String>) -> PlanError {
        let start = (0..=span.start.min(text.len())).rev().find(|b| text.is_char_boundary(*b)).unwrap_or(0);
        let before = &text[..start];
        let line_start = before.rfind('\n').map_or(0, |b| b + 1);
        PlanError {
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            what: what.into(),
        }
    }

    /// What the reader of the text found, with the nearest word where one of a list was expected.
    pub(super) fn of_reader(text: &str, error: &toml::de::Error) -> PlanError {
        let message = error.message().trim_end_matches('\n').replace('\n', "; ");
        let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
        let what = match quoted.split_first() {
            Some((word, known)) if message.starts_with("unknown ") && !known.is_empty() => unknown(
                // The reader's word for a value of a list.
                &message
                    .split('`')
                    .next()
                    .unwrap_or("")
                    .trim_start_matches("unknown ")
                    .trim()
                    .replace("variant", "value"),
                word,
                known,
            ),
            _ => message.clone(),
        };
        PlanError::at(text, &error.span().unwrap_or(0..0), what)
    }
}

/// Says that a word is not known, which one may have been meant, and which ones there are.
pub fn unknown(what: &str, word: &str, known: &[&str]) -> String {
    let list = known.join(", ");
    match nearest(word, known) {
        Some(meant) => format!("there is no {what} \"{word}\"; did you mean \"{meant}\"? (known: {list})"),
        None => format!("there is no {what} \"{word}\" (known: {list})"),
    }
}

/// The word that needs fewest changes of letters, if these are no more than a third of its letters and one; of several one that only
/// goes on.
fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let lower = word.to_lowercase();
    let cost = |k: &&str| (changes(&lower, &k.to_lowercase()), !k.to_lowercase().starts_with(&lower));
    let best = known.iter().min_by_key(|k| cost(k))?;
    (cost(best).0 <= 1 + word.chars().count() / 3).then_some(*best)
}

/// Letters to put in, take out or replace (V. I. Levenshtein, 1966), two letters exchanged counting for two.
fn changes(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut corner = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = corner + usize::from(x != *y);
            corner = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(corner + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_lines_and_characters() {
        let text = "a = 1\nµm = \"x\"\n";
        let at = text.find('x').unwrap();
        let error = PlanError::at(text, &(at..at + 1), "no");
        assert_eq!((error.line, error.column), (2, 7));
        assert_eq!(error.to_string(), "line 2, column 7: no");
        assert_eq!(PlanError::at("", &(9..9), "").line, 1);
    }

    #[test]
    fn the_nearest_word_is_named() {
        let known = ["flatness", "roundness", "size"];
        assert!(unknown("kind", "flatnes", &known).contains("did you mean \"flatness\"?"));
        assert!(unknown("kind", "Rundness", &known).contains("did you mean \"roundness\"?"));
        assert!(!unknown("kind", "texture", &known).contains("did you mean"));
        assert!(unknown("method", "zone", &["none", "zones"]).contains("did you mean \"zones\"?"));
        assert_eq!(changes("kitten", "sitting"), 3);
        assert_eq!(changes("", "abc"), 3);
    }
}

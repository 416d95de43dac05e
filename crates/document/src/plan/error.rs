//! What is wrong with a plan, and where.

use super::fault::{Fault, Kind, Wanted};
use super::synonyms::synonyms;
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

    /// What the reader of TOML found, with the remedy for slips.
    pub(super) fn of_toml(text: &str, error: &toml::de::Error) -> PlanError {
        let span = error.span().unwrap_or(0..0);
        let message = error.message().trim_end_matches('\n').replace('\n', "; ");
        let line = text.get(..span.start).unwrap_or("").rsplit('\n').next().unwrap_or("");
        let what = slip(&message, line, text.get(span.start..).unwrap_or("")).unwrap_or(message);
        PlanError::at(text, &span, what)
    }

    /// A fault of a value, with the nearest word where one of a list was expected.
    pub(super) fn of_fault(text: &str, fault: Fault) -> PlanError {
        let span = fault.span.unwrap_or(0..0);
        let what = match *fault.kind {
            Kind::Unknown { what, word, known } => unknown(what, &word, known),
            Kind::Missing(key) => format!("`{key}` is missing; add it, as in {key} = {}", example(key)),
            Kind::Type { wanted, message } => Written::at(text, &span).not(wanted, &message),
            Kind::Length { found, wanted, message } => {
                Written::at(text, &span).not_so_long(found, wanted, &message)
            }
            Kind::Said(message) => message,
        };
        PlanError::at(text, &span, what)
    }
}

/// What stands at a place of the text.
struct Written<'a> {
    /// The key of the value; empty where it has none. An element of a list has the list's.
    key: &'a str,
    value: &'a str,
}

impl Written<'_> {
    fn at<'a>(text: &'a str, span: &Range<usize>) -> Written<'a> {
        let line = text.get(..span.start).unwrap_or("").rsplit('\n').next().unwrap_or("");
        let words = |c: char| !(c.is_alphanumeric() || c == '_' || c == '-');
        // `key = value`, also within `{ … }`.
        let key = line.rsplit_once('=').and_then(|(left, _)| left.trim().rsplit(words).next()).unwrap_or("");
        Written { key, value: text.get(span.clone()).unwrap_or("").trim() }
    }

    /// `key is `, where there is a key.
    fn subject(&self) -> String {
        if self.key.is_empty() { String::new() } else { format!("`{}` is ", self.key) }
    }

    /// What a value should be, and how that is written; `None` where there are no words for it.
    fn wanted(&self, wanted: Option<Wanted>) -> Option<&'static str> {
        Some(match wanted? {
            Wanted::Number if self.key == "tolerance" => "one number, the width or diameter of the zone",
            Wanted::Number => "a number",
            Wanted::Text => "text in quotes",
            Wanted::Bool => "true or false",
            Wanted::Whole => "a whole number from 0",
            Wanted::List => "a list, as in [\"A\", \"B\"]",
            Wanted::Several(2) => "two numbers, as in [-0.1, 0.1]",
            Wanted::Several(3) => "three numbers, as in [0, 0, 1]",
            Wanted::Several(_) => return None,
            Wanted::Table => "a table, as in { … }",
            Wanted::Word => "a word in quotes",
        })
    }

    /// That it is of another type.
    fn not(&self, wanted: Option<Wanted>, message: &str) -> String {
        let there = self.value;
        if wanted == Some(Wanted::List) && there.starts_with('[') && self.key.is_empty() {
            return format!("{there} is one table; write [{there}], as there may be several");
        }
        let Some(words) = self.wanted(wanted) else { return message.into() };
        let number = there.trim_matches('"').replace(',', ".");
        let is_number = matches!(wanted, Some(Wanted::Number | Wanted::Whole | Wanted::Several(_)));
        let remedy = match wanted {
            _ if is_number && there.starts_with('"') && number.parse::<f64>().is_ok() => {
                format!("; write {number} without quotes")
            }
            Some(Wanted::Text)
                if ["id", "title", "datums"].contains(&self.key) && there.parse::<f64>().is_ok() =>
            {
                format!("; write \"{there}\"")
            }
            _ => String::new(),
        };
        // A table or a list of several lines says nothing here.
        let short = !there.is_empty() && !there.contains('\n') && there.chars().count() <= 40;
        let there = if short { there } else { "something else" };
        format!("{}{there}, not {words}{remedy}", self.subject())
    }

    /// That it is a list of another length.
    fn not_so_long(&self, found: usize, wanted: Option<Wanted>, message: &str) -> String {
        match self.wanted(wanted) {
            Some(words) => format!("{}a list of {found}, not {words}", self.subject()),
            None => message.into(),
        }
    }
}

/// Slips of people who do not write TOML every day; `line` is what stands before the place, `after` what follows.
fn slip(message: &str, line: &str, after: &str) -> Option<String> {
    let digit = |s: &str, c: fn(&str) -> Option<char>| c(s).is_some_and(|c| c.is_ascii_digit());
    let next = after.split('\n').next().unwrap_or("").trim();
    let text = match message.split(',').next().unwrap_or("") {
        // Of a Windows path in double quotes.
        _ if is_bad_escape(message, line, next) => {
            let path = quoted_text(line, after);
            format!(
                "in double quotes \\ begins an escape; write '{path}' in single quotes, or \"{}\" with forward slashes",
                path.replace("\\\\", "\\").replace('\\', "/")
            )
        }
        "unexpected key or value" if after.starts_with(',') && digit(line, |s| s.chars().last()) => {
            "a decimal comma; numbers have a point, as in 0.05".into()
        }
        "invalid mantissa" if next.starts_with('.') => format!("a number begins with a digit; write 0{next}"),
        "invalid float" | "invalid integer" if digit(line, |s| s.chars().last()) => {
            format!("a number has no unit: \"{next}\" must go; lengths are in `units`, angles in degrees")
        }
        "string values must be quoted" if next.is_empty() => "there is no value behind `=`".into(),
        "string values must be quoted" | "invalid boolean" => {
            format!("text stands in quotes; write \"{next}\"")
        }
        "invalid key-value pair" if line.is_empty() && after.starts_with(['{', '<']) => {
            "this is no plan; give a TOML file".into()
        }
        "invalid basic string" if !next.trim_start_matches('"').contains('"') => {
            "the text has no closing quote; end it with \"".into()
        }
        "duplicate key" if line.ends_with("[[") => {
            let name = next.trim_end_matches(']');
            format!("[{name}] is one table; write [[{name}]], as there may be several")
        }
        "duplicate key" => {
            let key = next.split('=').next().unwrap_or("").trim();
            format!("`{key}` is there twice; leave one out")
        }
        _ => return None,
    };
    Some(text)
}

/// Whether the reader stopped at a backslash in double quotes, or where one has taken the closing quote away.
fn is_bad_escape(message: &str, line: &str, next: &str) -> bool {
    let words = ["escape", "unicode", "quote", "string"];
    let in_quotes = line.rfind('"').map(|at| &line[at..]).unwrap_or(next);
    words.iter().any(|w| message.contains(w))
        && (in_quotes.contains('\\') || (next.starts_with('"') && next.contains('\\')))
}

/// The text in double quotes around a place: `before` it on its line, and what follows.
fn quoted_text(before: &str, after: &str) -> String {
    let start = before.rfind('"').map_or("", |at| &before[at + 1..]);
    let rest = after.split('\n').next().unwrap_or("");
    let rest = if before.contains('"') { rest } else { rest.trim_start_matches('"') };
    let end = rest.find('"').unwrap_or(rest.trim_end().len());
    format!("{start}{}", rest.get(..end).unwrap_or(""))
}

/// How a key that must be there is written.
fn example(key: &str) -> &'static str {
    match key {
        "schema" => "\"trueness/plan/1\"",
        "id" | "feature" => "\"A\"",
        "shape" => "\"plane\"",
        "kind" => "\"flatness\"",
        "method" => "\"best-fit\"",
        "rule" => "\"simple\"",
        "tolerance" => "[-0.1, 0.1]",
        "measured" | "nominal" | "origin" => "[0, 0, 0]",
        "x" => "[1, 0, 0]",
        "z" => "[0, 0, 1]",
        _ => "…",
    }
}

/// Says that a word is not known, which one may have been meant, and which ones there are.
pub fn unknown(what: &str, word: &str, known: &[&str]) -> String {
    let list = known.join(", ");
    let meant = synonyms(word, known);
    let meant = if meant.is_empty() { nearest(word, known).into_iter().collect() } else { meant };
    let meant: Vec<String> = meant.iter().map(|m| format!("\"{m}\"")).collect();
    match meant.is_empty() {
        false => {
            format!("there is no {what} \"{word}\"; did you mean {}? (known: {list})", meant.join(" or "))
        }
        true => format!("there is no {what} \"{word}\" (known: {list})"),
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

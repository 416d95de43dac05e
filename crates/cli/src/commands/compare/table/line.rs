//! Lines of a table: a name, and a text that keeps to the width of a page.

use crate::layout::MAX_LINE_LETTERS;
use trueness_document::{Verdict, VerdictReason};

/// Columns of the names at the beginning of lines.
const LABEL_COLUMNS: usize = 11;

/// A line with a name. What is longer than a line ends where its last part ends that fits.
pub fn line(name: &str, text: &str) -> String {
    format!("{name:<LABEL_COLUMNS$}{}\n", fitting(text, MAX_LINE_LETTERS - LABEL_COLUMNS))
}

/// A file with what there is to say of it. Where both have no room the folders go, then the middle of the name.
pub fn file(name: &str, path: &str, what: &str) -> String {
    let room = (MAX_LINE_LETTERS - LABEL_COLUMNS).saturating_sub(what.chars().count() + 2);
    let own = short(path);
    let shown = match () {
        () if path.chars().count() <= room => path.to_string(),
        () if own.chars().count() <= room.max(MIN_NAME_COLUMNS) => own.to_string(),
        () => middle_left_out(own, room.max(MIN_NAME_COLUMNS)),
    };
    line(name, &format!("{shown}  {what}"))
}

/// Columns that a name has at least.
const MIN_NAME_COLUMNS: usize = 24;

/// The file's name without its folder.
pub fn short(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

fn middle_left_out(name: &str, room: usize) -> String {
    let all: Vec<char> = name.chars().collect();
    let end = room / 2;
    let start: String = all[..room - end - 1].iter().collect();
    let last: String = all[all.len() - end..].iter().collect();
    format!("{start}…{last}")
}

/// A text in so many columns: cut behind a part of a sentence, else a word; what is cut off is shown by an ellipsis.
fn fitting(text: &str, room: usize) -> String {
    if text.chars().count() <= room {
        return text.to_string();
    }
    let head: String = text.chars().take(room.saturating_sub(2)).collect();
    let behind = |mark: &&str| head.rfind(*mark).filter(|at| *at > head.len() / 2);
    let part = [": ", "; ", ", ", " ("].iter().filter_map(behind).max();
    let end = part.or_else(|| behind(&" ")).unwrap_or(head.len());
    format!("{} …", &head[..end])
}

/// The verdict with its reasons, a line each; nothing where none was asked for.
pub fn verdict(verdict: Option<Verdict>, reasons: &[VerdictReason]) -> String {
    let Some(verdict) = verdict else { return String::new() };
    let word = verdict.word().to_uppercase();
    match reasons {
        [] => line("verdict", &word),
        [first, rest @ ..] => {
            let mut out = line("verdict", &format!("{word}: {}", first.text));
            rest.iter().for_each(|reason| out.push_str(&line("", &reason.text)));
            out
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_is_longer_than_a_page() {
        let long = "half of the points are farther than 2.14 % of the size from the reference: it is hardly the same part, or its place was not found";
        assert_eq!(
            line("!", long),
            "!          half of the points are farther than 2.14 % of the size from the reference …\n"
        );
        let folder = "/a/very/long/folder/that/goes/on/and/on/and/on/for/more/than/there/is/room/on/a/page";
        for name in ["x.stl", &format!("{}.stl", "n".repeat(200)), &"ж".repeat(300)] {
            let shown = file("reference", &format!("{folder}/{name}"), "1,288 points, 2,592 facets, mm");
            assert!(shown.chars().count() <= MAX_LINE_LETTERS + 1, "{shown}");
        }
        assert!(file("measured", "a/x.stl", "mm").contains("a/x.stl  mm"));
        assert!(line("x", &"w".repeat(500)).chars().count() <= MAX_LINE_LETTERS + 1);
    }
}

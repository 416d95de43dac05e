//! The report's browser side, as text: its script, its style sheet and its words in four languages.
//!
//! The script is made of `web/` (TypeScript and three.js) by `build.rs`. Without Node.js it is empty and [`BUILT`] is
//! false; a report then has its verdict, tables, figures and stored picture, and no turnable part.

/// The viewer as one classic script, to stand inside a `<script>` element. Empty when not [`BUILT`].
pub const SCRIPT: &str = include_str!(concat!(env!("OUT_DIR"), "/viewer.js"));
/// Whether there is a script.
pub const BUILT: bool = cfg!(viewer_built);
/// The style sheet of the page: needed with and without the script.
pub const STYLE: &str = concat!(
    include_str!("../web/style/tokens.css"),
    include_str!("../web/style/page.css"),
    include_str!("../web/style/stage.css"),
    include_str!("../web/style/plan.css"),
    include_str!("../web/style/charts.css"),
    include_str!("../web/style/print.css"),
);
/// The words of the page: lines of `key`, English, German, Russian and Chinese, separated by tabs.
pub const TEXTS: &str = include_str!("../texts.tsv");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_script_cannot_end_its_element() {
        let lower = SCRIPT.to_ascii_lowercase();
        assert!(!lower.contains("</script") && !lower.contains("<!--"));
        assert_eq!(BUILT, !SCRIPT.is_empty());
    }

    #[test]
    fn the_script_is_small() {
        assert!(SCRIPT.len() <= 700_000, "{} bytes", SCRIPT.len());
    }

    #[test]
    fn every_word_is_there_in_four_languages() {
        let mut keys = vec![];
        for line in TEXTS.lines() {
            let columns: Vec<&str> = line.split('\t').collect();
            assert_eq!(columns.len(), 5, "{line}");
            assert!(columns.iter().all(|c| !c.trim().is_empty() && c.trim() == *c), "{line}");
            keys.push(columns[0]);
        }
        let all = keys.len();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), all, "a key stands twice");
    }
}

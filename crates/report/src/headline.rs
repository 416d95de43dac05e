//! What a page says first.

use super::text::{Language, word};
use trueness_document::Verdict;

/// What the page says first: a word in a color, with an icon, so that color is never the only sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Headline {
    /// The word is `verdict.<key>` in the table.
    pub key: &'static str,
    /// Its color and icon.
    pub tone: Tone,
}

/// How good the news is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// Conforms.
    Pass,
    /// Does not.
    Fail,
    /// Nobody can tell.
    Undecided,
    /// There is nothing to judge.
    Unknown,
    /// No judgment was asked for.
    Neutral,
}

impl Tone {
    /// Name of its color in the style sheet.
    pub fn name(self) -> &'static str {
        match self {
            Tone::Pass => "pass",
            Tone::Fail => "fail",
            Tone::Undecided => "undecided",
            Tone::Unknown => "not_measured",
            Tone::Neutral => "not_judged",
        }
    }

    /// Its sign, beside which the word stands.
    pub fn icon(self) -> &'static str {
        match self {
            Tone::Pass => "✓",
            Tone::Fail => "✕",
            Tone::Undecided => "?",
            Tone::Unknown => "–",
            Tone::Neutral => "i",
        }
    }
}

impl From<Verdict> for Headline {
    fn from(verdict: Verdict) -> Headline {
        let (key, tone) = match verdict {
            Verdict::Pass => ("pass", Tone::Pass),
            Verdict::Fail => ("fail", Tone::Fail),
            Verdict::Undecided => ("undecided", Tone::Undecided),
            Verdict::NotMeasured => ("not_measured", Tone::Unknown),
        };
        Headline { key, tone }
    }
}

impl Headline {
    /// The word.
    pub fn word_in(self, language: Language) -> String {
        word(&format!("verdict.{}", self.key), language).to_string()
    }
}

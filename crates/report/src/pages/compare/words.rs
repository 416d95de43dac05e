//! Words and keys that a page of a comparison has in several places.

use crate::headline::{Headline, Tone};
use crate::number::Style;
use maud::{Markup, html};
use trueness_document::compare::{Comparison, SignRecord, WarningKind};

/// A verdict, or that there was no tolerance.
pub(super) fn headline(verdict: Option<trueness_document::Verdict>) -> Headline {
    verdict.map_or(Headline { key: "not_judged", tone: Tone::Neutral }, Headline::from)
}

/// Key of how the sign was found, in a few words.
pub(super) fn sign_key(sign: &SignRecord) -> String {
    format!("sign.by.{}", sign.method)
}

/// Key of a warning in a few words.
pub(super) fn warning_key(kind: WarningKind) -> &'static str {
    match kind {
        WarningKind::SizeRatio => "warning.size_ratio",
        WarningKind::HardlyOverlapping => "warning.hardly_overlapping",
    }
}

/// The map in one sentence, for those who cannot see it.
pub(super) fn in_words(s: Style, c: &Comparison) -> Markup {
    let shares = c
        .tolerance
        .as_ref()
        .filter(|_| c.regions.is_empty())
        .and_then(|t| Some([t.inside?, t.above?, t.below?]));
    html! {
        @if let Some(shares) = shares {
            p.words {
                @for (n, (key, share)) in ["within", "above", "below"].into_iter().zip(shares).enumerate() {
                    @if n > 0 { " · " } (s.word(key)) " " (s.percent(share, 2))
                }
            }
        }
    }
}

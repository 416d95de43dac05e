//! Words and keys that a page of a comparison has in several places.

use super::super::super::html::Html;
use super::super::super::page::blocks::{Headline, Tone};
use crate::results::compare::{Comparison, SignRecord, WarningKind};

/// A verdict, or that there was no tolerance.
pub(super) fn headline(verdict: Option<crate::results::Verdict>) -> Headline {
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
pub(super) fn in_words(h: &mut Html, c: &Comparison) {
    let Some(t) = c.tolerance.as_ref().filter(|_| c.regions.is_empty()) else { return };
    let (Some(inside), Some(above), Some(below)) = (t.inside, t.above, t.below) else { return };
    h.raw("<p class=\"words\">");
    for (n, (key, share)) in [("within", inside), ("above", above), ("below", below)].into_iter().enumerate()
    {
        h.raw(if n > 0 { " · " } else { "" }).word(key).raw(" ").percent(share, 2);
    }
    h.raw("</p>");
}

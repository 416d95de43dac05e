//! How the measured part was brought to its reference: the same section in every report that aligns.

use crate::number::Style;
use crate::page::parts::{fact, key_number, mm, section, warning};
use crate::values::Text;
use maud::{Markup, Render, html};
use trueness_document::align::{AlignNote, AlignNoteKind, AlignedTo};

/// What there is to be said of an alignment.
pub struct Facts<'a> {
    /// Its method, as the result document names it.
    pub method: &'a str,
    /// Root mean square distance of what counts, mm.
    pub rms: Option<f64>,
    /// Greatest distance, where it is the least, mm.
    pub greatest: Option<f64>,
    /// How far the worst point is beyond its tolerance, where that is the least, mm.
    pub excess: Option<f64>,
    /// Points without a weight.
    pub left_out: Option<u64>,
    /// What is to be said about the result.
    pub warnings: &'a [AlignNote],
}

impl<'a> Facts<'a> {
    /// Of the best fit that a comparison began with.
    pub fn of_best_fit(of: &'a AlignedTo) -> Facts<'a> {
        let AlignedTo { rms, left_out, warnings, .. } = of;
        let (rms, left_out) = (Some(*rms), Some(*left_out));
        Facts { method: "best-fit", rms, greatest: None, excess: None, left_out, warnings }
    }

    /// Key of the word for its rms. What lies on datums has none of its own.
    fn rms_word(&self) -> &'static str {
        if self.method == "datum" { "align.rms_of_start" } else { "rms" }
    }
}

/// The chip at the head of a page: what the pose leaves, and how many points were left out of it. It warns where the result cannot be relied
/// on, and where so many were left out that a note says so.
pub fn chip(s: Style, of: &Facts, digits: usize) -> Option<Markup> {
    let doubtful = of.warnings.iter().any(|w| w.kind.is_doubt() || w.kind.0 == AlignNoteKind::LeftOut);
    let left_out = of.left_out.filter(|points| *points > 0);
    if of.rms.is_none() && left_out.is_none() && !doubtful {
        return None;
    }
    let value = html! {
        @if doubtful { "⚠\u{a0}" }
        @if let Some(rms) = of.rms { (s.word(of.rms_word())) "\u{a0}" (s.number(rms, digits)) }
        @if let Some(points) = left_out { " " small { (s.word("align.left_out.short")) "\u{a0}" (s.count(points)) } }
    };
    Some(key_number(s, "alignment", if doubtful { "warn" } else { "" }, value))
}

/// The section.
pub fn alignment(s: Style, of: &Facts) -> Markup {
    // Four decimals tell nothing of less.
    let length = |x: f64| mm(if x < 1e-3 { s.small(x) } else { s.number(x, 4).render() });
    let body = html! {
        dl.facts.pairs {
            (fact(s, "method", s.word(format!("align.{}", of.method))))
            @if let Some(rms) = of.rms { (fact(s, of.rms_word(), length(rms))) }
            @if let Some(greatest) = of.greatest { (fact(s, "align.greatest", length(greatest))) }
            @if let Some(excess) = of.excess { (fact(s, "align.excess", mm(s.number(excess, 4).signed()))) }
            @if let Some(points) = of.left_out { (fact(s, "align.left_out", s.count(points))) }
        }
        @for note in of.warnings { (warning(Text(&note.text))) }
    };
    section(s, "alignment", body)
}

//! How the measured part was brought to its reference: the same section in every report that aligns.

use super::super::html::Html;
use super::super::page::blocks::{fact, section};
use crate::results::align::AlignNote;

/// What there is to be said of an alignment.
pub struct Facts<'a> {
    /// Its method, as the result document names it.
    pub method: &'a str,
    /// Root mean square distance of what counts, mm.
    pub rms: Option<f64>,
    /// Greatest distance, where it is the least, mm.
    pub greatest: Option<f64>,
    /// Points without a weight.
    pub left_out: Option<u64>,
    /// What is to be said about the result.
    pub warnings: &'a [AlignNote],
}

/// Writes the section.
pub fn alignment(h: &mut Html, of: &Facts) {
    section(h, "alignment", |h| {
        h.raw("<dl class=\"facts pairs\">");
        fact(h, "method", |h| {
            h.word(&format!("align.{}", of.method));
        });
        if let Some(rms) = of.rms {
            fact(h, "rms", |h| {
                h.number(rms, 4, false).raw("\u{a0}mm");
            });
        }
        if let Some(greatest) = of.greatest {
            fact(h, "align.greatest", |h| {
                h.number(greatest, 4, false).raw("\u{a0}mm");
            });
        }
        if let Some(points) = of.left_out {
            fact(h, "align.left_out", |h| {
                h.count(points);
            });
        }
        h.raw("</dl>");
        for warning in of.warnings {
            h.raw("<p class=\"note\"><strong class=\"warning\">⚠</strong> ").text(&warning.text).raw("</p>");
        }
    });
}

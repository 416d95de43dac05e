//! The best fit onto the nominal and the verdict on the profile, as facts.

use crate::headline::Headline;
use crate::number::{Style, decimals};
use crate::page::parts::{badge, fact};
use crate::values::Text;
use maud::{Markup, html};
use trueness_document::section::{FitRecord, NominalRecord, SectionDocument};

/// Planes whose fits are listed.
const LISTED: usize = 60;

/// The verdict with its shares, its worst place and its reasons; nothing without a tolerance.
pub fn verdict(s: Style, found: &NominalRecord) -> Markup {
    let (Some(profile), Some(verdict)) = (&found.profile, found.verdict) else { return Markup::default() };
    let t = &profile.shares;
    html! {
        p { (badge(s, Headline::from(verdict))) }
        @for reason in &found.verdict_reasons { p.note { strong.warning { "⚠" } " " (Text(&reason.text)) } }
        dl.facts.pairs {
            (fact(s, "tolerance", html! {
                (s.number(t.lower, 4).signed()) " … " (s.number(t.upper, 4).signed()) "\u{a0}mm"
            }))
            (fact(s, "profile.zone", html! { (s.number(profile.zone_width, 4)) "\u{a0}mm" }))
            (fact(s, "within", s.optional_percent(t.inside, 2).because(t.inside_reason.as_deref())))
            @if let Some(w) = &profile.worst {
                (fact(s, "profile.worst", html! {
                    (s.number(w.deviation, 4).signed()) "\u{a0}mm · x\u{a0}" (s.number(w.point[0], 3)) " · y\u{a0}" (s.number(w.point[1], 3))
                }))
            }
            (fact(s, "profile.covered", s.percent(profile.covered, 1)))
            (fact(s, "profile.counterparts", s.percent(profile.counterparts, 1)))
        }
    }
}

/// The best fit of each plane; nothing where none was asked for.
pub fn fits(s: Style, document: &SectionDocument, found: &NominalRecord) -> Markup {
    let several = document.planes.len() > 1;
    html! {
        @for fit in found.fits.iter().take(LISTED) {
            @if let Some(plane) = fit.plane.filter(|_| several) { h3 { (s.word("plane")) "\u{a0}" (plane + 1) } }
            (fit_facts(s, fit))
        }
        @if !found.fits.is_empty() { p.note { (s.word("fitted.text")) } }
    }
}

fn fit_facts(s: Style, fit: &FitRecord) -> Markup {
    let shown = |x: f64, u: Option<f64>, unit: &str| {
        html! { (s.number(x, decimals(u, 4))) @if let Some(u) = u { "\u{a0}±\u{a0}" (s.small(u)) } (unit) }
    };
    let [x, y] = [0, 1].map(|k| shown(fit.shift[k], fit.shift_uncertainty[k], "\u{a0}mm"));
    html! {
        dl.facts.pairs {
            (fact(s, "fitted.shift", html! { "x\u{a0}" (x) " · y\u{a0}" (y) }))
            (fact(s, "fitted.turn", shown(fit.turn.to_degrees(), fit.turn_uncertainty.map(f64::to_degrees), "°")))
            (fact(s, "fitted.rms", html! { (s.small(fit.rms_before)) " → " (s.small(fit.rms)) "\u{a0}mm" }))
            (fact(s, "points", s.count(fit.used)))
            @if fit.left_out > 0 { (fact(s, "fitted.left_out", s.count(fit.left_out))) }
        }
    }
}

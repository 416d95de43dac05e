//! The best fit onto the nominal and the verdict on the profile, as facts.

use crate::headline::Headline;
use crate::number::Style;
use crate::page::parts::{badge, fact, inside, mm, warning, with_uncertainty};
use crate::values::Text;
use maud::{Markup, html};
use trueness_document::section::{FitRecord, NominalRecord, SectionDocument};

/// Planes whose fits are listed.
const MAX_LISTED_FITS: usize = 60;

/// The verdict with its shares, its worst place and its reasons; nothing without a tolerance.
pub fn verdict(s: Style, found: &NominalRecord) -> Markup {
    let (Some(profile), Some(verdict)) = (&found.profile, found.verdict) else { return Markup::default() };
    let t = &profile.shares;
    html! {
        p { (badge(s, Headline::from(verdict))) }
        @for reason in &found.verdict_reasons { (warning(Text(&reason.text))) }
        dl.facts.pairs {
            (fact(s, "tolerance", html! {
                (s.number(t.lower, 4).signed()) " … " (s.number(t.upper, 4).signed()) "\u{a0}mm"
            }))
            (fact(s, "profile.zone", mm(s.number(profile.zone_width, 4))))
            (fact(s, "within", inside(s, t)))
            @if let Some(w) = &profile.worst {
                (fact(s, "profile.worst", html! {
                    (mm(s.number(w.deviation, 4).signed())) " · x\u{a0}" (s.number(w.point[0], 3)) " · y\u{a0}" (s.number(w.point[1], 3))
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
        @for fit in found.fits.iter().take(MAX_LISTED_FITS) {
            @if let Some(plane) = fit.plane.filter(|_| several) { h3 { (s.word("plane")) "\u{a0}" (plane + 1) } }
            (fit_facts(s, fit))
        }
        @if !found.fits.is_empty() { p.note { (s.word("fitted.text")) } }
    }
}

fn fit_facts(s: Style, fit: &FitRecord) -> Markup {
    let [x, y] = [0, 1].map(|k| mm(with_uncertainty(s, fit.shift[k], fit.shift_uncertainty[k])));
    let turn = with_uncertainty(s, fit.turn.to_degrees(), fit.turn_uncertainty.map(f64::to_degrees));
    html! {
        dl.facts.pairs {
            (fact(s, "fitted.shift", html! { "x\u{a0}" (x) " · y\u{a0}" (y) }))
            (fact(s, "fitted.turn", html! { (turn) "°" }))
            (fact(s, "fitted.rms", html! { (s.small(fit.rms_before)) " → " (s.small(fit.rms)) "\u{a0}mm" }))
            (fact(s, "points", s.count(fit.used)))
            @if fit.left_out > 0 { (fact(s, "fitted.left_out", s.count(fit.left_out))) }
        }
    }
}

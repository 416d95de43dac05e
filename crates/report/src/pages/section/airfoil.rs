//! The block of measures of airfoils.

use crate::number::Style;
use crate::page::parts::{fact, mm, with_uncertainty};
use crate::values::Text;
use maud::{Markup, Render, html};
use trueness_document::section::{AirfoilMeasures, AirfoilRecord};

/// Profiles that are shown.
const MAX_LISTED_PROFILES: usize = 60;

/// Every contour as a profile, or why it is none.
pub fn airfoils(s: Style, all: &[AirfoilRecord]) -> Markup {
    html! {
        @for found in all.iter().take(MAX_LISTED_PROFILES) {
            @if all.len() > 1 { h3 { (s.word("contour")) "\u{a0}" (found.contour + 1) } }
            @match &found.measures {
                Some(measures) => { (facts(s, measures)) }
                None => { p.note { (Text(found.measures_reason.as_deref().unwrap_or_default())) } }
            }
        }
        p.note { (s.word("airfoil.text")) }
    }
}

fn facts(s: Style, m: &AirfoilMeasures) -> Markup {
    let length = |x: f64, u: Option<f64>| mm(with_uncertainty(s, x, u));
    let radius = |x: Option<f64>, u: Option<f64>, reason: &Option<String>| match x {
        Some(x) => length(x, u),
        None => s.optional(None, 0).because(reason.as_deref()).render(),
    };
    let at = |share: f64| html! { " (" (s.percent(share, 1)) ")" };
    html! {
        dl.facts.pairs {
            (fact(s, "airfoil.chord", html! {
                (length(m.chord, None)) " · ∠\u{a0}" (s.number(m.chord_angle.to_degrees(), 4)) "°"
            }))
            (fact(s, "airfoil.thickness", html! {
                (length(m.thickness, Some(m.thickness_uncertainty))) (at(m.thickness_at))
            }))
            (fact(s, "airfoil.camber", html! { (length(m.camber, None)) (at(m.camber_at)) }))
            (fact(s, "airfoil.leading",
                radius(m.leading_radius, m.leading_radius_uncertainty, &m.leading_radius_reason)))
            (fact(s, "airfoil.trailing",
                radius(m.trailing_radius, m.trailing_radius_uncertainty, &m.trailing_radius_reason)))
            @if let Some(gap) = m.trailing_thickness { (fact(s, "airfoil.gap", length(gap, None))) }
            @for chord in &m.chords {
                (fact(s, &format!("airfoil.chord.{}", chord.definition), html! {
                    (s.optional(chord.length, 4).because(chord.length_reason.as_deref()))
                    @if let Some(angle) = chord.angle { "\u{a0}mm · ∠\u{a0}" (s.number(angle.to_degrees(), 4)) "°" }
                    @if let Some(twist) = chord.twist {
                        " · " (s.word("airfoil.twist")) "\u{a0}" (s.number(twist.to_degrees(), 4).signed()) "°"
                    }
                }))
            }
            @if let Some(stacking) = &m.stacking {
                (fact(s, "airfoil.stacking", html! {
                    "x\u{a0}" (s.number(stacking.offset[0], 4).signed()) " · y\u{a0}" (s.number(stacking.offset[1], 4).signed()) "\u{a0}mm"
                }))
            }
        }
    }
}

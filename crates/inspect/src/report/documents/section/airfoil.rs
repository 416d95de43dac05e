//! The block of measures of airfoils.

use super::super::super::html::Html;
use super::super::super::number::decimals;
use super::super::super::page::blocks::fact;
use super::tables::small;
use crate::results::section::{AirfoilMeasures, AirfoilRecord};

/// Profiles that are shown.
const LISTED: usize = 60;

/// Every contour as a profile, or why it is none.
pub fn airfoils(h: &mut Html, all: &[AirfoilRecord]) {
    for found in all.iter().take(LISTED) {
        if all.len() > 1 {
            h.raw("<h3>").word("contour").raw(&format!("\u{a0}{}</h3>", found.contour + 1));
        }
        match &found.measures {
            Some(measures) => facts(h, measures),
            None => {
                let reason = found.measures_reason.as_deref().unwrap_or_default();
                h.raw("<p class=\"note\">").text(reason).raw("</p>");
            }
        }
    }
    h.raw("<p class=\"note\">").word("airfoil.text").raw("</p>");
}

fn facts(h: &mut Html, m: &AirfoilMeasures) {
    let length = |h: &mut Html, x: f64, u: Option<f64>| {
        h.number(x, decimals(u, 4), false);
        if let Some(u) = u {
            h.raw("\u{a0}±\u{a0}");
            small(h, u);
        }
        h.raw("\u{a0}mm");
    };
    let at = |h: &mut Html, share: f64| {
        h.raw(" (");
        h.percent(share, 1).raw(")");
    };
    h.raw("<dl class=\"facts pairs\">");
    fact(h, "airfoil.chord", |h| {
        length(h, m.chord, None);
        h.raw(" · ∠\u{a0}").number(m.chord_angle.to_degrees(), 4, false).raw("°");
    });
    fact(h, "airfoil.thickness", |h| {
        length(h, m.thickness, Some(m.thickness_uncertainty));
        at(h, m.thickness_at);
    });
    fact(h, "airfoil.camber", |h| {
        length(h, m.camber, None);
        at(h, m.camber_at);
    });
    fact(h, "airfoil.leading", |h| match m.leading_radius {
        Some(radius) => length(h, radius, m.leading_radius_uncertainty),
        None => {
            h.optional(None, m.leading_radius_reason.as_deref(), 0, false);
        }
    });
    fact(h, "airfoil.trailing", |h| match m.trailing_radius {
        Some(radius) => length(h, radius, m.trailing_radius_uncertainty),
        None => {
            h.optional(None, m.trailing_radius_reason.as_deref(), 0, false);
        }
    });
    if let Some(gap) = m.trailing_thickness {
        fact(h, "airfoil.gap", |h| length(h, gap, None));
    }
    h.raw("</dl>");
}

//! The page of a fit: the element's parameters with their uncertainties, how well the points keep to it, what holds it.

use super::super::html::Html;
use super::super::page::blocks::{Headline, Tone, fact, key_number, place_cells, section, swatch};
use super::{Head, Map, Pick, Subject};
use crate::fit::side_color;
use crate::results::fit::{Extent, Extreme, FitDocument, Number};
use crate::scale::Scale;
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_geom::space::{Vector, plus, times};

impl Subject for FitDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        let key = SHAPES.into_iter().find(|s| *s == self.shape).unwrap_or("element");
        Headline { key, tone: if self.converged { Tone::Neutral } else { Tone::Undecided } }
    }

    fn convention(&self) -> Option<&'static str> {
        Some(match (self.signed(), self.shape.as_str()) {
            (false, _) => "sign.none",
            (true, "plane" | "line") => "sign.plane",
            _ => "sign.fit",
        })
    }

    fn facing(&self) -> Option<Vector> {
        let Extent { axes: [a, b, w], u, v, .. } = *self.extent.as_ref()?;
        let middle = 0.5 * (u[0] + u[1]);
        match self.shape.as_str() {
            "plane" | "circle" | "ellipse" => Some(w),
            "line" if self.planar => Some([0.0, 0.0, 1.0]),
            "sphere" if v[0] > -FRAC_PI_2 => Some(w),
            // The outer side of a part of the turn.
            "cylinder" | "cone" if u[1] - u[0] < TAU => {
                Some(plus(times(libm::cos(middle), a), times(libm::sin(middle), b)))
            }
            _ => None,
        }
    }

    fn picture(&self) -> &'static str {
        "picture.fit"
    }

    fn numbers(&self, h: &mut Html) {
        let digits = self.digits();
        h.raw("<dl class=\"key-numbers\">");
        let mut length = |key, class, value, digits| {
            key_number(h, key, class, |h| {
                h.optional(value, self.std_dev_reason.as_deref(), digits, false);
            });
        };
        length("form_error", "lead", Some(self.form_error), digits);
        length("rms", "", Some(self.rms), digits + 1);
        length("std_dev", "", self.std_dev, digits + 1);
        for (key, count) in [("points", self.count), ("outliers", self.outliers)] {
            if key == "points" || count > 0 {
                key_number(h, key, if key == "outliers" { "warn" } else { "" }, |h| {
                    h.count(count);
                });
            }
        }
        key_number(h, "fit.method", "", |h| {
            h.word(method(&self.method));
        });
        if !self.converged {
            key_number(h, "converged", "warn", |h| {
                h.raw("⚠\u{a0}").word("converged.no");
            });
        }
        h.raw("</dl>");
    }

    fn list(&self, h: &mut Html) {
        section(h, "parameters", |h| parameters(h, self));
        section(h, "residuals", |h| residuals(h, self));
        if !self.touching.is_empty() {
            section(h, "touching", |h| touching(h, self));
        }
    }

    fn method(&self, h: &mut Html) {
        for key in
            [format!("{}.text", method(&self.method)), "method.fit.text".into(), "method.map.text".into()]
        {
            h.raw("<p>").word(&key).raw("</p>");
        }
    }

    fn how(&self, h: &mut Html) {
        h.word(method(&self.method)).raw(" · ").word("orthogonal");
    }

    fn points(&self) -> Option<u64> {
        Some(self.count + self.outliers)
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }

    fn scale(&self) -> Option<&Scale> {
        self.scale.as_ref()
    }

    fn quantity(&self) -> [&'static str; 3] {
        match (self.signed(), self.shape.as_str()) {
            (false, _) => ["distance.title", "ends.unsigned.high", "ends.unsigned.low"],
            (true, "plane" | "line") => ["distance.title", "ends.plane.high", "ends.plane.low"],
            _ => ["distance.title", "ends.fit.high", "ends.fit.low"],
        }
    }

    fn maps(&self) -> Vec<Map<'_>> {
        let (count, histogram) = (self.count + self.outliers, self.histogram.as_ref());
        vec![Map { name: &self.shape, count, histogram, ..Map::default() }]
    }

    fn picks(&self) -> Vec<Pick> {
        let extremes = self.extremes().into_iter().filter_map(|e| {
            Some(Pick { position: e.position?, map: Some(0), value: Some(e.distance), ..Pick::default() })
        });
        let touching = self
            .touching
            .iter()
            .enumerate()
            .filter_map(|(n, t)| Some(Pick { position: t.position?, mark: Some(n), ..Pick::default() }));
        extremes.chain(touching).collect()
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

/// Shapes with a word of their own.
const SHAPES: [&str; 8] = ["line", "plane", "circle", "ellipse", "sphere", "cylinder", "cone", "torus"];

impl FitDocument {
    /// Distances from a curve in space have no sign.
    fn signed(&self) -> bool {
        self.planar || !matches!(self.shape.as_str(), "line" | "circle")
    }

    /// Digits after the point that show the form error.
    fn digits(&self) -> usize {
        self.scale.as_ref().map_or(4, |s| s.decimals as usize)
    }

    fn extremes(&self) -> [&Extreme; 2] {
        [&self.maximum, &self.minimum]
    }
}

fn method(name: &str) -> &'static str {
    match name {
        "minimum-zone" => "fit.minimum_zone",
        "minimum-circumscribed" => "fit.minimum_circumscribed",
        "maximum-inscribed" => "fit.maximum_inscribed",
        "robust" => "fit.robust",
        _ => "fit.gaussian",
    }
}

fn parameters(h: &mut Html, d: &FitDocument) {
    h.raw("<table class=\"parameters\"><thead><tr><th></th><th class=\"r\">").word("value");
    h.raw("</th><th class=\"r\">").word("uncertainty").raw("</th></tr></thead><tbody>");
    for (name, value) in &d.parameters {
        let uncertainty = d.uncertainty.as_ref().and_then(|u| u.get(name));
        match (value, uncertainty) {
            (Number::One(x), u) => {
                let u = u.and_then(|u| if let Number::One(u) = u { Some(*u) } else { None });
                let in_degrees = name == "half_angle";
                let shown = |x: f64| if in_degrees { x.to_degrees() } else { x };
                let unit = if in_degrees { "°" } else { "\u{a0}mm" };
                row(h, name, "", shown(*x), u.map(shown), unit);
            }
            (Number::Three(v), u) => {
                let u = u.and_then(|u| if let Number::Three(u) = u { Some(*u) } else { None });
                let unit = if ["normal", "direction"].contains(&name.as_str()) { "" } else { "\u{a0}mm" };
                for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                    row(h, name, axis, v[k], u.map(|u| u[k]), unit);
                }
            }
        }
    }
    h.raw("</tbody></table>");
    if let Some(reason) = &d.uncertainty_reason {
        h.raw("<p class=\"note\">").word("uncertainty.none").raw(": ").text(reason).raw("</p>");
    }
}

/// A number with as many digits as its uncertainty has a use for: two of the uncertainty's own.
fn row(h: &mut Html, name: &str, axis: &str, x: f64, uncertainty: Option<f64>, unit: &str) {
    let first = axis.is_empty() || axis == "x";
    h.raw(if first { "<tr class=\"first\"><th scope=\"row\">" } else { "<tr><th scope=\"row\">" });
    if first {
        h.word(&format!("parameter.{name}"));
    }
    h.raw(&format!(" <i>{axis}</i></th><td class=\"r\">"));
    let u = uncertainty.filter(|u| *u > 0.0 && u.is_finite());
    let decimals = u.map_or(6.0, |u| (1.0 - libm::log10(u).floor()).clamp(3.0, 9.0)) as usize;
    h.number(x, decimals, false).raw(unit).raw("</td><td class=\"r\">");
    match uncertainty {
        Some(0.0) => h.raw("0"),
        Some(u) if u < 0.5e-9 => h.scientific(u, 0),
        u => h.optional(u, None, decimals, false),
    };
    h.raw("</td></tr>");
}

fn residuals(h: &mut Html, d: &FitDocument) {
    let digits = d.digits();
    h.raw("<dl class=\"facts pairs\">");
    for (key, value, more) in
        [("form_error", Some(d.form_error), 0), ("rms", Some(d.rms), 1), ("std_dev", d.std_dev, 1)]
    {
        fact(h, key, |h| {
            h.optional(value, d.std_dev_reason.as_deref(), digits + more, false);
            h.raw(if value.is_some() { "\u{a0}mm" } else { "" });
        });
    }
    fact(h, "points", |h| {
        h.count(d.count);
    });
    if d.method == "robust" {
        fact(h, "outliers", |h| {
            h.count(d.outliers);
        });
    }
    fact(h, "iterations", |h| {
        h.count(d.iterations);
    });
    h.raw("</dl><table class=\"pick\"><thead><tr><th></th><th class=\"r\">").word("distance.title");
    h.raw("</th><th class=\"r\">x</th><th class=\"r\">y</th><th class=\"r\">z</th></tr></thead><tbody>");
    let placed = d.extremes().into_iter().filter_map(|e| Some((e, e.position?)));
    for (n, (e, place)) in placed.enumerate() {
        h.raw(&format!("<tr data-pick=\"{n}\"><td title=\"{}\">", e.point));
        h.word(if n == 0 { "max" } else { "min" }).raw("</td><td class=\"r\">");
        h.number(e.distance, digits, true).raw("</td>");
        place_cells(h, place);
        h.raw("</tr>");
    }
    h.raw("</tbody></table>");
}

/// The points that hold a zone, a circumscribed or an inscribed element.
fn touching(h: &mut Html, d: &FitDocument) {
    let first = d.extremes().iter().filter(|e| e.position.is_some()).count();
    h.raw("<table class=\"pick\"><thead><tr><th></th><th class=\"r\">").word("share");
    h.raw("</th><th class=\"r\">x</th><th class=\"r\">y</th><th class=\"r\">z</th></tr></thead><tbody>");
    let placed = d.touching.iter().filter_map(|t| Some((t, t.position?)));
    for (n, (t, place)) in placed.enumerate() {
        h.raw(&format!("<tr data-pick=\"{}\"><td>", first + n));
        swatch(h, side_color(t.side));
        h.raw(" ");
        h.word(if t.side > 0 { "touching.outer" } else { "touching.inner" });
        h.raw("</td><td class=\"r\">").percent(t.multiplier, 1).raw("</td>");
        place_cells(h, place);
        h.raw("</tr>");
    }
    h.raw("</tbody></table><p class=\"note\">").word("touching.text").raw("</p>");
}

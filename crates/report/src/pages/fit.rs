//! The page of a fit: the element's parameters with their uncertainties, how well the points keep to it, what holds it.

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{fact, key_number, place_cells, place_heads, section, swatch};
use crate::subject::{Head, Map, Pick, Subject};
use crate::values::{self, Optional, Text};
use crate::views::fit::side_color;
use maud::{Markup, html};
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_document::fit::{Extent, FitDocument, Number};
use trueness_document::noise::shared;
use trueness_document::scale::Scale;
use trueness_document::shape::FitMethod;
use trueness_geom::shape::{Coordinate, Quantity, Sides};
use trueness_geom::space::{Vector, plus, times};
use trueness_measure::fit::kind;

impl Subject for FitDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        Headline {
            key: self.shape.name(),
            tone: if self.converged { Tone::Neutral } else { Tone::Undecided },
        }
    }

    fn convention(&self) -> Option<&'static str> {
        Some(match kind(self).sides() {
            Sides::None => "sign.none",
            Sides::OfNormal => "sign.plane",
            Sides::InAndOut => "sign.fit",
        })
    }

    fn facing(&self) -> Option<Vector> {
        let Extent { axes: [a, b, w], u, v, .. } = *self.extent.as_ref()?;
        let middle = 0.5 * (u[0] + u[1]);
        use Coordinate::{Latitude, Length, None as Nothing, Turn};
        match kind(self).coordinates() {
            [Length, Length] | [Turn, Nothing] => Some(w),
            [Nothing, _] => self.planar.then_some([0.0, 0.0, 1.0]),
            [_, Latitude] => (v[0] > -FRAC_PI_2).then_some(w),
            // The outer side of a part of the turn.
            [Turn, Length] => {
                (u[1] - u[0] < TAU).then(|| plus(times(libm::cos(middle), a), times(libm::sin(middle), b)))
            }
            [Turn, Turn] | [Length | Latitude, _] => None,
        }
    }

    fn picture(&self) -> &'static str {
        "picture.fit"
    }

    fn numbers(&self, s: Style) -> Markup {
        let digits = self.digits();
        html! {
            dl.key-numbers {
                (key_number(s, "form_error", "lead", s.optional(Some(self.form_error), digits)))
                (key_number(s, "rms", "", s.optional(Some(self.rms), digits + 1)))
                (key_number(s, "std_dev", "", std_dev(s, self)))
                (key_number(s, "points", "", s.count(self.count)))
                @if let Some(points) = shared(self.shared_noise) {
                    (key_number(s, "points_per_independent", "", s.number(points, 1)))
                }
                @if self.outliers > 0 { (key_number(s, "outliers", "warn", s.count(self.outliers))) }
                (key_number(s, "fit.method", "", s.word(method(*self.method))))
                @if !self.converged {
                    (key_number(s, "converged", "warn", html! { "⚠\u{a0}" (s.word("converged.no")) }))
                }
            }
        }
    }

    fn list(&self, s: Style) -> Markup {
        html! {
            (section(s, "parameters", parameters(s, self)))
            (section(s, "residuals", residuals(s, self)))
            @if !self.touching.is_empty() { (section(s, "touching", touching(s, self))) }
        }
    }

    fn method(&self, s: Style) -> Markup {
        html! {
            p { (s.word(format!("{}.text", method(*self.method)))) }
            p { (s.word("method.fit.text")) }
            p { (s.word("method.map.text")) }
        }
    }

    fn how(&self, s: Style) -> Markup {
        html! { (s.word(method(*self.method))) " · " (s.word("orthogonal")) }
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
        match kind(self).sides() {
            Sides::None => ["distance.title", "ends.unsigned.high", "ends.unsigned.low"],
            Sides::OfNormal => ["distance.title", "ends.plane.high", "ends.plane.low"],
            Sides::InAndOut => ["distance.title", "ends.fit.high", "ends.fit.low"],
        }
    }

    fn maps(&self) -> Vec<Map<'_>> {
        let (count, histogram) = (self.count + self.outliers, self.histogram.as_ref());
        vec![Map { name: self.shape.name(), count, histogram, ..Map::default() }]
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

/// Key of a method's word.
fn method(method: FitMethod) -> &'static str {
    match method {
        FitMethod::Gaussian => "fit.gaussian",
        FitMethod::MinimumZone => "fit.minimum_zone",
        FitMethod::MinimumCircumscribed => "fit.minimum_circumscribed",
        FitMethod::MaximumInscribed => "fit.maximum_inscribed",
        FitMethod::Robust => "fit.robust",
    }
}

fn std_dev(s: Style, d: &FitDocument) -> Optional<'_, values::Number> {
    s.optional(d.std_dev, d.digits() + 1).because(d.std_dev_reason.as_deref())
}

fn parameters(s: Style, d: &FitDocument) -> Markup {
    html! {
        table.parameters {
            thead { tr { th {} th.r { (s.word("value")) } th.r { (s.word("uncertainty")) } } }
            tbody {
                @for (name, value) in &d.parameters {
                    (parameter(s, d, name, value))
                }
            }
        }
        @if let Some(reason) = &d.uncertainty_reason {
            p.note { (s.word("uncertainty.none")) ": " (Text(reason)) }
        }
    }
}

/// The rows of a parameter.
fn parameter(s: Style, d: &FitDocument, name: &str, value: &Number) -> Markup {
    let uncertainty = d.uncertainty.as_ref().and_then(|u| u.get(name));
    let quantity = kind(d).quantity(name);
    match *value {
        Number::One(x) => {
            let u = uncertainty.and_then(|u| if let Number::One(u) = u { Some(*u) } else { None });
            match quantity {
                Some(Quantity::Angle) => row(s, name, "", x.to_degrees(), u.map(f64::to_degrees), "°"),
                _ => row(s, name, "", x, u, "\u{a0}mm"),
            }
        }
        Number::Three(v) => {
            let u = uncertainty.and_then(|u| if let Number::Three(u) = u { Some(*u) } else { None });
            let unit = if quantity == Some(Quantity::Direction) { "" } else { "\u{a0}mm" };
            html! {
                @for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                    (row(s, name, axis, v[k], u.map(|u| u[k]), unit))
                }
            }
        }
    }
}

/// A number with as many digits as its uncertainty has a use for: two of the uncertainty's own.
fn row(s: Style, name: &str, axis: &str, x: f64, uncertainty: Option<f64>, unit: &str) -> Markup {
    let first = axis.is_empty() || axis == "x";
    let u = uncertainty.filter(|u| *u > 0.0 && u.is_finite());
    let decimals = u.map_or(6.0, |u| (1.0 - libm::log10(u).floor()).clamp(3.0, 9.0)) as usize;
    html! {
        tr class=[first.then_some("first")] {
            th scope="row" { @if first { (s.word(format!("parameter.{name}"))) } " " i { (axis) } }
            td.r { (s.number(x, decimals)) (unit) }
            td.r {
                @match uncertainty {
                    Some(0.0) => "0",
                    Some(u) if u < 0.5e-9 => (s.scientific(u, 0)),
                    u => (s.optional(u, decimals)),
                }
            }
        }
    }
}

fn residuals(s: Style, d: &FitDocument) -> Markup {
    let digits = d.digits();
    let placed = d.extremes().into_iter().filter_map(|e| Some((e, e.position?)));
    html! {
        dl.facts.pairs {
            (fact(s, "form_error", html! { (s.optional(Some(d.form_error), digits)) "\u{a0}mm" }))
            (fact(s, "rms", html! { (s.optional(Some(d.rms), digits + 1)) "\u{a0}mm" }))
            (fact(s, "std_dev", html! { (std_dev(s, d)) @if d.std_dev.is_some() { "\u{a0}mm" } }))
            (fact(s, "points", s.count(d.count)))
            @if *d.method == FitMethod::Robust { (fact(s, "outliers", s.count(d.outliers))) }
            (fact(s, "iterations", s.count(d.iterations)))
        }
        table.pick {
            thead { tr { th {} th.r { (s.word("distance.title")) } (place_heads()) } }
            tbody {
                @for (n, (e, place)) in placed.enumerate() {
                    tr data-pick=(n) {
                        td title=(e.point) { (s.word(if n == 0 { "max" } else { "min" })) }
                        td.r { (s.number(e.distance, digits).signed()) }
                        (place_cells(s, place))
                    }
                }
            }
        }
    }
}

/// The points that hold a zone, a circumscribed or an inscribed element.
fn touching(s: Style, d: &FitDocument) -> Markup {
    let first = d.extremes().iter().filter(|e| e.position.is_some()).count();
    let placed = d.touching.iter().filter_map(|t| Some((t, t.position?)));
    html! {
        table.pick {
            thead { tr { th {} th.r { (s.word("share")) } (place_heads()) } }
            tbody {
                @for (n, (t, place)) in placed.enumerate() {
                    tr data-pick=(first + n) {
                        td {
                            (swatch(side_color(t.side))) " "
                            (s.word(if t.side > 0 { "touching.outer" } else { "touching.inner" }))
                        }
                        td.r { (s.percent(t.multiplier, 1)) }
                        (place_cells(s, place))
                    }
                }
            }
        }
        p.note { (s.word("touching.text")) }
    }
}

//! The page of a fit: the element's parameters with their uncertainties, how well the points keep to it, what holds it.

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{fact, key_number, line, mm, paragraphs, section, swatch};
use crate::page::table::{Row, places, table};
use crate::subject::{Content, Map, Pick, Subject};
use crate::values::{self, Optional, Text};
use crate::views::fit::side_color;
use maud::{Markup, Render, html};
use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_document::fit::{Extent, FitDocument, Number};
use trueness_document::noise::shared;
use trueness_document::scale::Scale;
use trueness_document::shape::FitMethod;
use trueness_geom::shape::{Coordinate, Quantity, Sides};
use trueness_geom::space::{Vector, plus, times};
use trueness_measure::fit::kind;

impl Subject for FitDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        let tone = if self.converged { Tone::Neutral } else { Tone::Undecided };
        let headline = Headline { key: self.shape.name(), tone };
        let sign = match kind(self).sides() {
            Sides::None => "sign.none",
            Sides::OfNormal => "sign.plane",
            Sides::InAndOut => "sign.fit",
        };
        let method = method(*self.method);
        Ok(Content {
            convention: Some(sign),
            picture: "picture.fit",
            numbers: numbers(s, self),
            list: html! {
                (section(s, "parameters", parameters(s, self)))
                (section(s, "residuals", residuals(s, self)))
                @if !self.touching.is_empty() { (section(s, "touching", touching(s, self))) }
            },
            method: paragraphs(s, [&format!("{method}.text"), "method.fit.text", "method.map.text"]),
            how: line(s, [method, "orthogonal"]),
            points: Some(self.count + self.outliers),
            seed: Some(self.seed),
            json: serde_json::to_value(self)?,
            ..Content::of(headline, [&self.schema, &self.version, &self.units], &self.inputs)
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
}

fn numbers(s: Style, d: &FitDocument) -> Markup {
    let digits = d.digits();
    html! {
        dl.key-numbers {
            (key_number(s, "form_error", "lead", s.optional(Some(d.form_error), digits)))
            (key_number(s, "rms", "", s.optional(Some(d.rms), digits + 1)))
            (key_number(s, "std_dev", "", std_dev(s, d)))
            (key_number(s, "points", "", s.count(d.count)))
            @if let Some(points) = shared(d.shared_noise) {
                (key_number(s, "points_per_independent", "", s.number(points, 1)))
            }
            @if d.outliers > 0 { (key_number(s, "outliers", "warn", s.count(d.outliers))) }
            (key_number(s, "fit.method", "", s.word(method(*d.method))))
            @if !d.converged {
                (key_number(s, "converged", "warn", html! { "⚠\u{a0}" (s.word("converged.no")) }))
            }
        }
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
    let rows = d.parameters.iter().flat_map(|(name, value)| parameter(s, d, name, value));
    html! {
        (table(s, "parameters", [&[""], &["value", "uncertainty"]], rows))
        @if let Some(reason) = &d.uncertainty_reason {
            p.note { (s.word("uncertainty.none")) ": " (Text(reason)) }
        }
    }
}

/// The rows of a parameter.
fn parameter(s: Style, d: &FitDocument, name: &str, value: &Number) -> Vec<Row> {
    let uncertainty = d.uncertainty.as_ref().and_then(|u| u.get(name));
    let quantity = kind(d).quantity(name);
    match *value {
        Number::One(x) => {
            let u = uncertainty.and_then(|u| if let Number::One(u) = u { Some(*u) } else { None });
            vec![match quantity {
                Some(Quantity::Angle) => row(s, name, "", x.to_degrees(), u.map(f64::to_degrees), "°"),
                _ => row(s, name, "", x, u, "\u{a0}mm"),
            }]
        }
        Number::Three(v) => {
            let u = uncertainty.and_then(|u| if let Number::Three(u) = u { Some(*u) } else { None });
            let unit = if quantity == Some(Quantity::Direction) { "" } else { "\u{a0}mm" };
            let axes = ["x", "y", "z"].into_iter().enumerate();
            axes.map(|(k, axis)| row(s, name, axis, v[k], u.map(|u| u[k]), unit)).collect()
        }
    }
}

/// A number with as many digits as its uncertainty has a use for: two of the uncertainty's own.
fn row(s: Style, name: &str, axis: &str, x: f64, uncertainty: Option<f64>, unit: &str) -> Row {
    let first = axis.is_empty() || axis == "x";
    let u = uncertainty.filter(|u| *u > 0.0 && u.is_finite());
    let decimals = u.map_or(6.0, |u| (1.0 - libm::log10(u).floor()).clamp(3.0, 9.0)) as usize;
    let called = html! { @if first { (s.word(format!("parameter.{name}"))) } " " i { (axis) } };
    let known = match uncertainty {
        Some(0.0) => html! { "0" },
        Some(u) if u < 0.5e-9 => s.scientific(u, 0).render(),
        u => s.optional(u, decimals).render(),
    };
    let value = html! { (s.number(x, decimals)) (unit) };
    Row::of(&[&called, &value, &known]).named().class(first.then_some("first"))
}

fn residuals(s: Style, d: &FitDocument) -> Markup {
    let digits = d.digits();
    let placed = d.extremes().into_iter().filter_map(|e| Some((e, e.position?)));
    let rows = placed.enumerate().map(|(n, (e, place))| {
        let name = s.word(if n == 0 { "max" } else { "min" });
        Row::at(s, &name, &s.number(e.distance, digits).signed(), place).pick(n).title(e.point)
    });
    html! {
        dl.facts.pairs {
            (fact(s, "form_error", mm(s.optional(Some(d.form_error), digits))))
            (fact(s, "rms", mm(s.optional(Some(d.rms), digits + 1))))
            (fact(s, "std_dev", html! { (std_dev(s, d)) @if d.std_dev.is_some() { "\u{a0}mm" } }))
            (fact(s, "points", s.count(d.count)))
            @if *d.method == FitMethod::Robust { (fact(s, "outliers", s.count(d.outliers))) }
            (fact(s, "iterations", s.count(d.iterations)))
        }
        (places(s, "distance.title", rows))
    }
}

/// The points that hold a zone, a circumscribed or an inscribed element.
fn touching(s: Style, d: &FitDocument) -> Markup {
    let first = d.extremes().iter().filter(|e| e.position.is_some()).count();
    let placed = d.touching.iter().filter_map(|t| Some((t, t.position?)));
    let rows = placed.enumerate().map(|(n, (t, place))| {
        let side = s.word(if t.side > 0 { "touching.outer" } else { "touching.inner" });
        let name = html! { (swatch(side_color(t.side))) " " (side) };
        Row::at(s, &name, &s.percent(t.multiplier, 1), place).pick(first + n)
    });
    html! { (places(s, "share", rows)) p.note { (s.word("touching.text")) } }
}

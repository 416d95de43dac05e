//! The page of curvatures: a map for each of them, where they are greatest and least, how well they are known.

use crate::headline::{Headline, Tone};
use crate::number::{Style, enough};
use crate::page::parts::{extent, fact, key_number, labeled_number, median, mm, most, paragraphs, section};
use crate::page::table::{Row, places, table};
use crate::subject::{Content, Map, Pick, Subject};
use maud::{Markup, Render, html};
use trueness_document::compare::Statistics;
use trueness_document::curvature::{
    CurvatureDocument, CurvatureKind, CurvaturePlace, Neighborhood, NormalSource, PlaceKind, Range,
};
use trueness_document::noise::shared;
use trueness_document::scale::Scale;

impl Subject for CurvatureDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        let source = match *self.normals {
            NormalSource::Facets => "method.curvature.facets",
            NormalSource::Neighbors => "method.curvature.cloud",
        };
        let headline = Headline { key: "curvature", tone: Tone::Neutral };
        Ok(Content {
            convention: Some("sign.curvature"),
            picture: "picture.curvature",
            numbers: html! {
                @for (n, kind) in CurvatureKind::ALL.into_iter().enumerate() { (numbers(s, self, n, kind)) }
            },
            list: list(s, self),
            method: paragraphs(s, ["method.curvature.text", source]),
            how: html! { (s.word("method.curvature")) " · " (s.word("degree")) "\u{a0}" (s.count(self.degree)) },
            points: (*self.places == PlaceKind::Points).then_some(self.total),
            json: serde_json::to_value(self)?,
            ..Content::of(headline, [&self.schema, &self.version, &self.units], &self.inputs)
        })
    }

    fn scale(&self) -> Option<&Scale> {
        Some(&self.mean.scale)
    }

    fn quantity(&self) -> [&'static str; 3] {
        words(CurvatureKind::Mean)
    }

    fn maps(&self) -> Vec<Map<'_>> {
        let of = |kind: CurvatureKind| {
            let found = CurvatureDocument::quantity(self, kind);
            Map {
                name: kind.name(),
                count: self.count,
                mean: found.statistics.mean,
                tolerance: None,
                histogram: found.histogram.as_ref(),
                scale: Some(&found.scale),
                quantity: Some(words(kind)),
            }
        };
        CurvatureKind::ALL.map(of).into()
    }

    fn picks(&self) -> Vec<Pick> {
        let of = |(n, kind): (usize, CurvatureKind)| {
            ends(self, kind).map(|(place, value)| Pick {
                position: place.position,
                normal: Some(place.bend.normal),
                map: Some(n),
                value: Some(value),
                ..Pick::default()
            })
        };
        CurvatureKind::ALL.into_iter().enumerate().flat_map(of).collect()
    }
}

fn list(s: Style, d: &CurvatureDocument) -> Markup {
    html! {
        (section(s, "quantities", quantities(s, d)))
        (section(s, "extremes", extremes(s, d)))
        (section(s, "known", known(s, d)))
        @if !d.without.is_empty() { (section(s, "without", html! {
            dl.facts.pairs {
                @for (reason, count) in &d.without { (fact(s, &format!("reason.{}", reason.name()), s.count(*count))) }
            }
        })) }
    }
}

/// Keys of the words for a curvature, and for the high and the low end of its scale.
pub fn words(kind: CurvatureKind) -> [&'static str; 3] {
    match kind {
        CurvatureKind::Mean => ["curvature.mean", "ends.curvature.high", "ends.curvature.low"],
        CurvatureKind::Gaussian => ["curvature.gaussian", "ends.gaussian.high", "ends.gaussian.low"],
        CurvatureKind::K1 => ["curvature.k1", "ends.curvature.high", "ends.curvature.low"],
        CurvatureKind::K2 => ["curvature.k2", "ends.curvature.high", "ends.curvature.low"],
    }
}

/// Where a curvature is greatest and least, with its value.
fn ends(d: &CurvatureDocument, kind: CurvatureKind) -> [(&CurvaturePlace, f64); 2] {
    let found = CurvatureDocument::quantity(d, kind);
    [&found.maximum, &found.minimum].map(|place| {
        let value = match kind {
            CurvatureKind::Mean => place.bend.mean,
            CurvatureKind::Gaussian => place.bend.gaussian,
            CurvatureKind::K1 => place.bend.k1,
            CurvatureKind::K2 => place.bend.k2,
        };
        (place, value)
    })
}

/// The key numbers of a curvature, those of map `n`.
fn numbers(s: Style, d: &CurvatureDocument, n: usize, kind: CurvatureKind) -> Markup {
    let found = CurvatureDocument::quantity(d, kind);
    let all = &found.statistics;
    let digits = enough(all.median, found.scale.decimals as usize);
    let without = d.total - d.count;
    let places = match *d.places {
        PlaceKind::Vertices => "vertices.title",
        PlaceKind::Points => "points",
    };
    html! {
        dl.key-numbers data-comparison=(n) hidden[n > 0] {
            (middle(s, kind, median(s, all, digits, true)))
            (key_number(s, "most_within", "", most(s, all, digits, true)))
            (key_number(s, "range", "", extent(s, all, digits)))
            (key_number(s, places, "", s.count(d.count)))
            @if without > 0 { (key_number(s, "without", "warn", s.count(without))) }
        }
    }
}

/// The middle value of a curvature, which leads.
pub fn middle(s: Style, kind: CurvatureKind, median: impl Render) -> Markup {
    let label = html! { (s.word(words(kind)[0])) ", " (s.word("median")) };
    labeled_number(label, "lead", html! { (median) "\u{a0}" (kind.unit()) })
}

/// Every curvature in a row, which shows its map.
fn quantities(s: Style, d: &CurvatureDocument) -> Markup {
    let row = |kind: CurvatureKind| {
        let found = CurvatureDocument::quantity(d, kind);
        let digits = enough(found.statistics.median, found.scale.decimals as usize);
        Choice::usual(words(kind)[0], &found.statistics, digits, kind.unit(), true)
    };
    choices(s, USUAL_COLUMNS, CurvatureKind::ALL.into_iter().map(row))
}

/// A quantity of which a map can be shown, with three of its values.
pub struct Choice {
    /// Key of its word.
    pub key: &'static str,
    /// What stands in the three columns.
    pub values: [Option<f64>; 3],
    /// Their digits after the point.
    pub digits: usize,
    /// Their unit.
    pub unit: &'static str,
    /// Whether they may be below zero.
    pub signed: bool,
}

/// Columns of [`Choice::usual`].
pub const USUAL_COLUMNS: [&str; 3] = ["p2_5", "median", "p97_5"];

impl Choice {
    /// Between what most values lie, and the middle one.
    pub fn usual(
        key: &'static str,
        of: &Statistics,
        digits: usize,
        unit: &'static str,
        signed: bool,
    ) -> Choice {
        let p = &of.percentiles;
        Choice { key, values: [p.p2_5, p.p50, p.p97_5], digits, unit, signed }
    }
}

/// A table of quantities, of which one is shown, in the order of their maps; the columns by the keys of their words.
pub fn choices(s: Style, columns: [&str; 3], rows: impl Iterator<Item = Choice>) -> Markup {
    let row = |(map, Choice { key, values, digits, unit, signed }): (usize, Choice)| {
        let [a, b, c] = values.map(|value| s.optional(value, digits).with_sign(signed));
        Row::of(&[&html! { (s.word(key)) " " span.unit { (unit) } }, &a, &b, &c]).choose(map)
    };
    table(s, "choose quantities", [&[""], &columns], rows.enumerate().map(row))
}

fn extremes(s: Style, d: &CurvatureDocument) -> Markup {
    let row = |n: usize, k: usize, (place, value): (&CurvaturePlace, f64)| {
        let digits = CurvatureDocument::quantity(d, CurvatureKind::ALL[n]).scale.decimals as usize;
        let name = s.word(if k == 0 { "max" } else { "min" });
        let row = Row::at(s, &name, &s.number(value, digits).signed(), place.position);
        row.pick(2 * n + k).title(place.index)
    };
    html! {
        @for (n, kind) in CurvatureKind::ALL.into_iter().enumerate() {
            div data-comparison=(n) hidden[n > 0] {
                (places(s, "value", (0..).zip(ends(d, kind)).map(|(k, end)| row(n, k, end))))
            }
        }
    }
}

/// A size, however small.
fn plain(s: Style, x: f64) -> Markup {
    if x == 0.0 || x >= 0.1 { s.number(x, 3).render() } else { s.scientific(x, 1).render() }
}

/// How the neighborhoods were, and what the fits say of themselves.
fn known(s: Style, d: &CurvatureDocument) -> Markup {
    let range = |range: &Range, unit: &str| {
        html! { (plain(s, range.median)) " (≤\u{a0}" (plain(s, range.max)) ")\u{a0}" (unit) }
    };
    html! {
        dl.facts.pairs {
            (fact(s, "degree", s.count(d.degree)))
            (fact(s, "neighborhood", html! {
                @match d.neighborhood {
                    Neighborhood::Count { neighbors } => { "≥\u{a0}" (s.count(neighbors)) " " (s.word("neighbors")) }
                    Neighborhood::Radius { radius } => { "≤\u{a0}" (mm(s.number(radius, 3))) }
                }
            }))
            (fact(s, "curvature.uncertainty", range(&d.uncertainty, "mm⁻¹")))
            @if let Some(points) = shared(d.shared_noise) {
                (fact(s, "points_per_independent", s.number(points, 1)))
            }
            (fact(s, "residual", range(&d.residual, "mm")))
            (fact(s, "reach", range(&d.reach, "mm")))
        }
        p.note { (s.word("known.text")) }
    }
}

//! The page of curvatures: a map for each of them, where they are greatest and least, how well they are known.

use crate::headline::{Headline, Tone};
use crate::number::{Style, enough};
use crate::page::parts::{fact, key_number, labeled_number, place_cells, place_heads, section};
use crate::subject::{Head, Map, Pick, Subject};
use maud::{Markup, Render, html};
use serde_json::Value;
use trueness_document::curvature::{
    CurvatureDocument, CurvatureKind, CurvaturePlace, Neighborhood, NormalSource, PlaceKind, Range,
};
use trueness_document::noise::shared;
use trueness_document::scale::Scale;

impl Subject for CurvatureDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        Headline { key: "curvature", tone: Tone::Neutral }
    }

    fn convention(&self) -> Option<&'static str> {
        Some("sign.curvature")
    }

    fn picture(&self) -> &'static str {
        "picture.curvature"
    }

    fn numbers(&self, s: Style) -> Markup {
        html! { @for (n, kind) in CurvatureKind::ALL.into_iter().enumerate() { (numbers(s, self, n, kind)) } }
    }

    fn list(&self, s: Style) -> Markup {
        html! {
            (section(s, "quantities", quantities(s, self)))
            (section(s, "extremes", extremes(s, self)))
            (section(s, "known", known(s, self)))
            @if !self.without.is_empty() { (section(s, "without", html! {
                dl.facts.pairs {
                    @for (reason, count) in &self.without { (fact(s, &format!("reason.{}", reason.name()), s.count(*count))) }
                }
            })) }
        }
    }

    fn method(&self, s: Style) -> Markup {
        let facets = *self.normals == NormalSource::Facets;
        html! {
            p { (s.word("method.curvature.text")) }
            p { (s.word(if facets { "method.curvature.facets" } else { "method.curvature.cloud" })) }
        }
    }

    fn how(&self, s: Style) -> Markup {
        html! {
            (s.word("method.curvature")) " · " (s.word("degree")) "\u{a0}" (s.count(self.degree))
        }
    }

    fn points(&self) -> Option<u64> {
        (*self.places == PlaceKind::Points).then_some(self.total)
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

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

/// The word for the places that have curvatures.
fn places(document: &CurvatureDocument) -> &'static str {
    match *document.places {
        PlaceKind::Vertices => "vertices.title",
        PlaceKind::Points => "points",
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
    let (all, p) = (&found.statistics, &found.statistics.percentiles);
    let value = |x| s.optional(x, enough(all.median, found.scale.decimals as usize)).signed();
    let label = html! { (s.word(words(kind)[0])) ", " (s.word("median")) };
    let without = d.total - d.count;
    html! {
        dl.key-numbers data-comparison=(n) hidden[n > 0] {
            (labeled_number(label, "lead", html! {
                (value(all.median).because(all.median_reason.as_deref())) "\u{a0}" (kind.unit())
            }))
            (key_number(s, "most_within", "", html! { (value(p.p2_5)) "\u{2009}…\u{2009}" (value(p.p97_5)) }))
            (key_number(s, "range", "", html! {
                (value(all.min).because(all.min_reason.as_deref())) "\u{2009}…\u{2009}"
                (value(all.max).because(all.max_reason.as_deref()))
            }))
            (key_number(s, places(d), "", s.count(d.count)))
            @if without > 0 { (key_number(s, "without", "warn", s.count(without))) }
        }
    }
}

/// Every curvature in a row, which shows its map.
fn quantities(s: Style, d: &CurvatureDocument) -> Markup {
    let row = |kind: CurvatureKind| {
        let found = CurvatureDocument::quantity(d, kind);
        let p = &found.statistics.percentiles;
        let digits = enough(found.statistics.median, found.scale.decimals as usize);
        Choice {
            key: words(kind)[0],
            values: [p.p2_5, p.p50, p.p97_5],
            digits,
            unit: kind.unit(),
            signed: true,
        }
    };
    choices(s, ["p2_5", "median", "p97_5"], CurvatureKind::ALL.into_iter().map(row))
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

/// A table of quantities, of which one is shown, in the order of their maps; the columns by the keys of their words.
pub fn choices(s: Style, columns: [&str; 3], rows: impl Iterator<Item = Choice>) -> Markup {
    html! {
        table.choose.quantities {
            thead { tr { th {} @for key in columns { th.r { (s.word(key)) } } } }
            tbody {
                @for (map, Choice { key, values, digits, unit, signed }) in rows.enumerate() {
                    tr data-choose=(map) aria-selected=(map == 0) {
                        td { (s.word(key)) " " span.unit { (unit) } }
                        @for value in values {
                            td.r { @if signed { (s.optional(value, digits).signed()) } @else { (s.optional(value, digits)) } }
                        }
                    }
                }
            }
        }
    }
}

fn extremes(s: Style, d: &CurvatureDocument) -> Markup {
    html! {
        @for (n, kind) in CurvatureKind::ALL.into_iter().enumerate() {
            @let digits = CurvatureDocument::quantity(d, kind).scale.decimals as usize;
            div data-comparison=(n) hidden[n > 0] {
                table.pick {
                    thead { tr { th {} th.r { (s.word("value")) } (place_heads()) } }
                    tbody {
                        @for (k, (place, value)) in ends(d, kind).into_iter().enumerate() {
                            tr data-pick=(2 * n + k) {
                                td title=(place.index) { (s.word(if k == 0 { "max" } else { "min" })) }
                                td.r { (s.number(value, digits).signed()) }
                                (place_cells(s, place.position))
                            }
                        }
                    }
                }
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
                    Neighborhood::Radius { radius } => { "≤\u{a0}" (s.number(radius, 3)) "\u{a0}mm" }
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

//! The page of curvatures: a map for each of them, where they are greatest and least, how well they are known.

use super::super::html::Html;
use super::super::page::blocks::{Headline, Tone, fact, key_number, place_cells, section};
use super::{Head, Map, Pick, Subject};
use crate::curvature::Kind;
use crate::results::curvature::{CurvatureDocument, Neighborhood, Place, Range};
use crate::scale::Scale;
use serde_json::Value;

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

    fn numbers(&self, h: &mut Html) {
        for (n, kind) in Kind::ALL.into_iter().enumerate() {
            let found = self.quantity(kind);
            let (all, digits) = (&found.statistics, found.scale.decimals as usize);
            h.raw(&format!("<dl class=\"key-numbers\" data-comparison=\"{n}\""));
            h.raw(if n == 0 { ">" } else { " hidden>" });
            key_number(h, words(kind)[0], "lead", |h| {
                h.optional(all.median, all.median_reason.as_deref(), digits, true).raw("\u{a0}");
                h.raw(kind.unit());
            });
            key_number(h, "most_within", "", |h| {
                let p = &all.percentiles;
                h.optional(p.p2_5, None, digits, true).raw("\u{2009}…\u{2009}");
                h.optional(p.p97_5, None, digits, true);
            });
            key_number(h, "range", "", |h| {
                h.optional(all.min, all.min_reason.as_deref(), digits, true).raw("\u{2009}…\u{2009}");
                h.optional(all.max, all.max_reason.as_deref(), digits, true);
            });
            let without = self.total - self.count;
            for (key, count) in [(self.word(), self.count), ("without", without)] {
                if key != "without" || count > 0 {
                    key_number(h, key, if key == "without" { "warn" } else { "" }, |h| {
                        h.count(count);
                    });
                }
            }
            h.raw("</dl>");
        }
    }

    fn list(&self, h: &mut Html) {
        section(h, "quantities", |h| quantities(h, self));
        section(h, "extremes", |h| extremes(h, self));
        section(h, "known", |h| known(h, self));
        if !self.without.is_empty() {
            section(h, "without", |h| {
                h.raw("<dl class=\"facts pairs\">");
                for (reason, count) in &self.without {
                    fact(h, reason_key(reason), |h| {
                        h.count(*count);
                    });
                }
                h.raw("</dl>");
            });
        }
    }

    fn method(&self, h: &mut Html) {
        h.raw("<p>").word("method.curvature.text").raw("</p>");
        let key = if self.normals == "facets" { "method.curvature.facets" } else { "method.curvature.cloud" };
        h.raw("<p>").word(key).raw("</p>");
    }

    fn how(&self, h: &mut Html) {
        h.word("method.curvature").raw(" · ").word("degree").raw("\u{a0}").count(self.degree);
    }

    fn points(&self) -> Option<u64> {
        (self.places == "points").then_some(self.total)
    }

    fn scale(&self) -> Option<&Scale> {
        Some(&self.mean.scale)
    }

    fn quantity(&self) -> [&'static str; 3] {
        words(Kind::Mean)
    }

    fn maps(&self) -> Vec<Map<'_>> {
        let of = |kind: Kind| {
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
        Kind::ALL.map(of).into()
    }

    fn picks(&self) -> Vec<Pick> {
        let of = |(n, kind): (usize, Kind)| {
            ends(self, kind).map(|(place, value)| Pick {
                position: place.position,
                normal: Some(place.bend.normal),
                map: Some(n),
                value: Some(value),
                ..Pick::default()
            })
        };
        Kind::ALL.into_iter().enumerate().flat_map(of).collect()
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

impl CurvatureDocument {
    fn word(&self) -> &'static str {
        if self.places == "vertices" { "vertices.title" } else { "points" }
    }
}

/// Keys of the words for a curvature, and for the high and the low end of its scale.
pub fn words(kind: Kind) -> [&'static str; 3] {
    match kind {
        Kind::Mean => ["curvature.mean", "ends.curvature.high", "ends.curvature.low"],
        Kind::Gaussian => ["curvature.gaussian", "ends.gaussian.high", "ends.gaussian.low"],
        Kind::K1 => ["curvature.k1", "ends.curvature.high", "ends.curvature.low"],
        Kind::K2 => ["curvature.k2", "ends.curvature.high", "ends.curvature.low"],
    }
}

fn reason_key(reason: &str) -> &'static str {
    match reason {
        "not_finite" => "reason.not_finite",
        "unused" => "reason.unused",
        "not_a_surface" => "reason.no_surface",
        "boundary" => "reason.boundary",
        "few_neighbors" => "reason.few_neighbors",
        "folded" => "reason.folded",
        _ => "reason.undetermined",
    }
}

/// Where a curvature is greatest and least, with its value.
fn ends(d: &CurvatureDocument, kind: Kind) -> [(&Place, f64); 2] {
    let found = CurvatureDocument::quantity(d, kind);
    [&found.maximum, &found.minimum].map(|place| {
        let value = match kind {
            Kind::Mean => place.bend.mean,
            Kind::Gaussian => place.bend.gaussian,
            Kind::K1 => place.bend.k1,
            Kind::K2 => place.bend.k2,
        };
        (place, value)
    })
}

/// Every curvature in a row, which shows its map.
fn quantities(h: &mut Html, d: &CurvatureDocument) {
    choose_head(h, ["p2_5", "median", "p97_5"]);
    for (n, kind) in Kind::ALL.into_iter().enumerate() {
        let found = CurvatureDocument::quantity(d, kind);
        let p = &found.statistics.percentiles;
        choose_row(
            h,
            n,
            words(kind)[0],
            [p.p2_5, p.p50, p.p97_5],
            found.scale.decimals as usize,
            kind.unit(),
        );
    }
    h.raw("</tbody></table>");
}

/// Begins a table of quantities, of which one is shown.
pub fn choose_head(h: &mut Html, columns: [&str; 3]) {
    h.raw("<table class=\"choose quantities\"><thead><tr><th></th>");
    for key in columns {
        h.raw("<th class=\"r\">").word(key).raw("</th>");
    }
    h.raw("</tr></thead><tbody>");
}

/// A quantity with three of its values; its row shows map number `map`.
pub fn choose_row(h: &mut Html, map: usize, key: &str, values: [Option<f64>; 3], digits: usize, unit: &str) {
    let current = if map == 0 { "true" } else { "false" };
    h.raw(&format!("<tr data-choose=\"{map}\" aria-selected=\"{current}\"><td>")).word(key);
    h.raw(" <span class=\"unit\">").raw(unit).raw("</span></td>");
    for value in values {
        h.raw("<td class=\"r\">").optional(value, None, digits, true).raw("</td>");
    }
    h.raw("</tr>");
}

fn extremes(h: &mut Html, d: &CurvatureDocument) {
    for (n, kind) in Kind::ALL.into_iter().enumerate() {
        let digits = CurvatureDocument::quantity(d, kind).scale.decimals as usize;
        h.raw(&format!("<div data-comparison=\"{n}\"")).raw(if n == 0 { ">" } else { " hidden>" });
        h.raw("<table class=\"pick\"><thead><tr><th></th><th class=\"r\">").word("value");
        h.raw("</th><th class=\"r\">x</th><th class=\"r\">y</th><th class=\"r\">z</th></tr></thead><tbody>");
        for (k, (place, value)) in ends(d, kind).into_iter().enumerate() {
            h.raw(&format!("<tr data-pick=\"{}\"><td title=\"{}\">", 2 * n + k, place.index));
            h.word(if k == 0 { "max" } else { "min" }).raw("</td><td class=\"r\">");
            h.number(value, digits, true).raw("</td>");
            place_cells(h, place.position);
            h.raw("</tr>");
        }
        h.raw("</tbody></table></div>");
    }
}

/// A size, however small.
fn plain(h: &mut Html, x: f64) {
    if x == 0.0 || x >= 0.1 {
        h.number(x, 3, false);
    } else {
        h.scientific(x, 1);
    }
}

/// How the neighbourhoods were, and what the fits say of themselves.
fn known(h: &mut Html, d: &CurvatureDocument) {
    h.raw("<dl class=\"facts pairs\">");
    fact(h, "degree", |h| {
        h.count(d.degree);
    });
    fact(h, "neighborhood", |h| match d.neighborhood {
        Neighborhood::Count { neighbors } => {
            h.raw("≥\u{a0}").count(neighbors).raw(" ").word("neighbors");
        }
        Neighborhood::Radius { radius } => {
            h.raw("≤\u{a0}").number(radius, 3, false).raw("\u{a0}mm");
        }
    });
    let rows: [(&str, &Range, &str); 3] = [
        ("curvature.uncertainty", &d.uncertainty, "\u{a0}mm⁻¹"),
        ("residual", &d.residual, "\u{a0}mm"),
        ("reach", &d.reach, "\u{a0}mm"),
    ];
    for (key, range, unit) in rows {
        fact(h, key, |h| {
            plain(h, range.median);
            h.raw(" (≤\u{a0}");
            plain(h, range.max);
            h.raw(")").raw(unit);
        });
    }
    h.raw("</dl><p class=\"note\">").word("known.text").raw("</p>");
}

//! The page of a surface through points: how far the points lie from it, how it bends, what it rests on.

use super::super::html::Html;
use super::super::page::blocks::{Headline, Tone, fact, key_number, place_cells, section};
use super::curvature::{Choice, choices, words};
use super::{Head, Map, Pick, Subject};
use crate::curvature::Kind;
use crate::results::Verdict;
use crate::results::compare::ToleranceShares;
use crate::results::curvature::Range;
use crate::results::surface::{MapRecord, SurfaceDocument};
use crate::scale::Scale;
use crate::surface::FOLDED;
use serde_json::Value;
use trueness_geom::surface::BaseKind;

impl Subject for SurfaceDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        match &self.tolerance {
            _ if self.base.folded_share > FOLDED => Verdict::Undecided.into(),
            Some(t) if t.reached => Verdict::Pass.into(),
            Some(_) => Verdict::Fail.into(),
            None => Headline { key: "surface", tone: Tone::Neutral },
        }
    }

    fn convention(&self) -> Option<&'static str> {
        Some("sign.plane")
    }

    fn picture(&self) -> &'static str {
        "picture.surface"
    }

    fn numbers(&self, h: &mut Html) {
        deviations(h, self);
        for (n, (kind, map)) in curvatures(self).enumerate() {
            let digits = map.scale.decimals as usize;
            h.raw(&format!("<dl class=\"key-numbers\" data-comparison=\"{}\" hidden>", n + 1));
            key_number(h, words(kind)[0], "lead", |h| {
                h.optional(range(self, kind).map(|r| r.median), None, digits, true).raw("\u{a0}");
                h.raw(kind.unit());
            });
            key_number(h, "range", "", |h| {
                h.optional(range(self, kind).map(|r| r.min), None, digits, true).raw("\u{2009}…\u{2009}");
                h.optional(range(self, kind).map(|r| r.max), None, digits, true);
            });
            h.raw("</dl>");
        }
    }

    fn list(&self, h: &mut Html) {
        if !self.warnings.is_empty() {
            section(h, "warnings", |h| {
                for warning in &self.warnings {
                    h.raw("<p class=\"warning\">⚠ ").text(warning).raw("</p>");
                }
            });
        }
        section(h, "quantities", |h| quantities(h, self));
        section(h, "worst", |h| worst(h, self));
        section(h, "surface.title", |h| facts(h, self));
    }

    fn method(&self, h: &mut Html) {
        for key in ["method.surface.text", "method.surface.maps"] {
            h.raw("<p>").word(key).raw("</p>");
        }
    }

    fn how(&self, h: &mut Html) {
        h.word("method.surface").raw(" · ").word("orthogonal");
    }

    fn points(&self) -> Option<u64> {
        Some(self.deviation.count)
    }

    fn scale(&self) -> Option<&Scale> {
        Some(&self.map.scale)
    }

    fn quantity(&self) -> [&'static str; 3] {
        DEVIATION
    }

    fn maps(&self) -> Vec<Map<'_>> {
        let shares = self.tolerance.as_ref().map(|t| {
            let share = |count: u64| Some(count as f64 / self.deviation.count as f64);
            ToleranceShares {
                lower: -t.value,
                upper: t.value,
                inside: share(self.deviation.count - t.outside),
                inside_reason: None,
                above: None,
                above_reason: Some("counted together with those below".into()),
                below: None,
                below_reason: Some("counted together with those above".into()),
                required: 1.0,
            }
        });
        let first = map(&self.map, "deviation", self.deviation.count, DEVIATION, shares);
        let count = self.curvature.count;
        let rest = curvatures(self).map(|(kind, of)| map(of, kind.name(), count, words(kind), None));
        std::iter::once(first).chain(rest).collect()
    }

    fn picks(&self) -> Vec<Pick> {
        vec![Pick {
            position: self.worst.position,
            map: Some(0),
            value: Some(self.worst.deviation),
            ..Pick::default()
        }]
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

/// Keys of the words for deviations, and for the high and the low end of their scale.
const DEVIATION: [&str; 3] = ["deviation", "ends.plane.high", "ends.plane.low"];

fn map<'a>(
    of: &'a MapRecord,
    name: &'a str,
    count: u64,
    quantity: [&'static str; 3],
    tolerance: Option<ToleranceShares>,
) -> Map<'a> {
    let (histogram, scale) = (of.histogram.as_ref(), Some(&of.scale));
    Map { name, count, mean: of.mean, tolerance, histogram, scale, quantity: Some(quantity) }
}

/// The curvatures that have values, in the order of their maps.
fn curvatures(d: &SurfaceDocument) -> impl Iterator<Item = (Kind, &MapRecord)> {
    Kind::ALL.into_iter().filter_map(|kind| Some((kind, d.curvature.maps.get(kind.name())?)))
}

fn range(d: &SurfaceDocument, kind: Kind) -> Option<Range> {
    match kind {
        Kind::Mean => d.curvature.mean,
        Kind::Gaussian => d.curvature.gaussian,
        Kind::K1 => d.curvature.k1,
        Kind::K2 => d.curvature.k2,
    }
}

fn deviations(h: &mut Html, d: &SurfaceDocument) {
    let (all, digits) = (&d.deviation, d.map.scale.decimals as usize);
    h.raw("<dl class=\"key-numbers\" data-comparison=\"0\">");
    key_number(h, "rms", "lead", |h| {
        h.optional(all.rms, all.rms_reason.as_deref(), digits + 1, false).raw("\u{a0}mm");
    });
    key_number(h, "range", "", |h| {
        h.optional(all.min, all.min_reason.as_deref(), digits, true).raw("\u{2009}…\u{2009}");
        h.optional(all.max, all.max_reason.as_deref(), digits, true);
    });
    if let Some(tolerance) = &d.tolerance {
        key_number(h, "tolerance", "", |h| {
            h.raw("±").number(tolerance.value, digits, false);
        });
        key_number(h, "beyond", if tolerance.reached { "" } else { "warn" }, |h| {
            h.count(tolerance.outside);
        });
    }
    key_number(h, "points", "", |h| {
        h.count(all.count);
    });
    if d.outliers > 0 {
        key_number(h, "outliers", "warn", |h| {
            h.count(d.outliers);
        });
    }
    h.raw("</dl>");
}

/// Deviation and curvatures, each in a row that shows its map.
fn quantities(h: &mut Html, d: &SurfaceDocument) {
    let (all, digits) = (&d.deviation, d.map.scale.decimals as usize);
    let first = Choice { key: "deviation", values: [all.min, all.median, all.max], digits, unit: "mm" };
    let rest = curvatures(d).map(|(kind, map)| {
        let range = range(d, kind);
        let values = [range.map(|r| r.min), range.map(|r| r.median), range.map(|r| r.max)];
        Choice { key: words(kind)[0], values, digits: map.scale.decimals as usize, unit: kind.unit() }
    });
    h.add(choices(h.style, ["min", "median", "max"], std::iter::once(first).chain(rest)));
    if d.curvature.reason.is_some() {
        h.raw("<p class=\"note\">").word("surface.no_normal").raw("</p>");
    }
}

fn worst(h: &mut Html, d: &SurfaceDocument) {
    h.raw("<table class=\"pick\"><thead><tr><th></th><th class=\"r\">").word("deviation");
    h.raw("</th><th class=\"r\">x</th><th class=\"r\">y</th><th class=\"r\">z</th></tr></thead><tbody>");
    h.raw(&format!("<tr data-pick=\"0\"><td title=\"{}\">1</td><td class=\"r\">", d.worst.point));
    h.number(d.worst.deviation, d.map.scale.decimals as usize, true).raw("</td>");
    place_cells(h, d.worst.position);
    h.raw("</tr></tbody></table>");
}

/// What the surface is made of and what it rests on.
fn facts(h: &mut Html, d: &SurfaceDocument) {
    h.raw("<dl class=\"facts pairs\">");
    let by = |h: &mut Html, [a, b]: [u64; 2]| {
        h.count(a).raw("\u{2009}×\u{2009}").count(b);
    };
    fact(h, "degree", |h| by(h, d.degree));
    let (m, n) = (d.control_points.len(), d.control_points.first().map_or(0, Vec::len));
    fact(h, "control_points", |h| by(h, [m as u64, n as u64]));
    fact(h, "surface.base", |h| {
        h.word(match *d.base.kind {
            BaseKind::Cylinder => "verdict.cylinder",
            BaseKind::Sphere => "verdict.sphere",
            BaseKind::Xy => "base.xy",
            BaseKind::Plane => "verdict.plane",
        });
    });
    fact(h, "fairness", |h| {
        if d.fairness == 0.0 {
            h.raw("0");
        } else {
            h.scientific(d.fairness, 1);
        }
        h.raw("\u{a0}mm²");
    });
    if let Some(freedom) = d.degrees_of_freedom {
        fact(h, "degrees_of_freedom", |h| {
            h.number(freedom, 1, false);
        });
    }
    fact(h, "corrections", |h| {
        h.count(d.corrections);
    });
    fact(h, "unsupported", |h| {
        h.percent(d.unsupported_share, 1);
    });
    h.raw("</dl>");
}

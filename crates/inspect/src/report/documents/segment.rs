//! The page of a segmentation: the elements found, each with its size and how well its points keep to it.

use super::super::html::Html;
use super::super::page::blocks::{Headline, Tone, fact, key_number, section, swatch};
use super::{Head, Pick, Subject};
use crate::results::fit::Number;
use crate::results::segment::{RegionRecord, SegmentDocument};
use crate::scale::palette::category;
use serde_json::Value;

impl Subject for SegmentDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        Headline { key: "segmented", tone: Tone::Neutral }
    }

    fn picture(&self) -> &'static str {
        "picture.segment"
    }

    fn numbers(&self, h: &mut Html) {
        h.raw("<dl class=\"key-numbers\">");
        key_number(h, "elements", "lead", |h| {
            h.count(self.regions.len() as u64);
        });
        key_number(h, "assigned", "", |h| {
            // The same shares as in the list: of the area, or of the points of a cloud.
            h.percent(self.regions.iter().map(|r| r.share).sum(), 1);
        });
        for (key, length) in [("noise", self.noise), ("tolerance.used", self.tolerance)] {
            key_number(h, key, "", |h| {
                micro(h, length);
                h.raw("\u{a0}mm");
            });
        }
        h.raw("</dl>");
    }

    fn list(&self, h: &mut Html) {
        section(h, "elements", |h| elements(h, self));
        section(h, "model", |h| {
            h.raw("<dl class=\"facts pairs\">");
            let pieces =
                if self.inputs.iter().any(|i| i.facets.is_some()) { "facets.title" } else { "points" };
            for (key, count) in [(pieces, self.count), ("pieces.none", self.unassigned)] {
                fact(h, key, |h| {
                    h.count(count);
                });
            }
            fact(h, "crease", |h| {
                h.number(self.crease.to_degrees(), 1, false).raw("°");
            });
            h.raw("</dl>");
        });
    }

    fn method(&self, h: &mut Html) {
        h.raw("<p>").word("method.segment.text").raw("</p>");
    }

    fn how(&self, h: &mut Html) {
        h.word("fit.gaussian");
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }

    fn picks(&self) -> Vec<Pick> {
        let of = |(n, r): (usize, &RegionRecord)| {
            let (low, high) = (r.bounds.min, r.bounds.max);
            let half = 0.5 * (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
            Pick {
                position: std::array::from_fn(|k| low[k] / 2.0 + high[k] / 2.0),
                // A region is large: it is framed, not shown from afar.
                reach: Some(0.3 * half),
                mark: Some(n),
                object: Some(n),
                ..Pick::default()
            }
        };
        self.regions.iter().enumerate().map(of).collect()
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

/// A small length, however small.
fn micro(h: &mut Html, length: f64) {
    if length > 0.0 && length < 5e-5 {
        h.scientific(length, 1);
    } else {
        h.number(length, if length < 0.1 { 5 } else { 3 }, false);
    }
}

fn elements(h: &mut Html, d: &SegmentDocument) {
    h.raw("<table class=\"pick\"><thead><tr><th></th><th class=\"r\">").word("size");
    h.raw("</th><th class=\"r\">").word("share.title").raw("</th><th class=\"r\">").word("rms");
    h.raw("</th></tr></thead><tbody>");
    for (n, region) in d.regions.iter().enumerate() {
        h.raw(&format!("<tr data-pick=\"{n}\"><td>"));
        swatch(h, category(n));
        h.raw(" ").word(&format!("verdict.{}", region.shape)).raw("</td><td class=\"r\">");
        sizes(h, region);
        h.raw("</td><td class=\"r\">").percent(region.share, 1).raw("</td><td class=\"r\">");
        micro(h, region.rms);
        h.raw("</td></tr>");
    }
    h.raw("</tbody></table>");
}

/// Radii and angle of an element; of a cone, whose radius is that at some place, the angle alone.
fn sizes(h: &mut Html, region: &RegionRecord) {
    let number = |name: &str| match region.parameters.get(name) {
        Some(Number::One(x)) => Some(*x),
        _ => None,
    };
    match region.shape.as_str() {
        "cone" => {
            h.optional(number("half_angle").map(f64::to_degrees), None, 2, false).raw("°");
        }
        "torus" => {
            h.raw("R ").optional(number("major_radius"), None, 3, false).raw(", r ");
            h.optional(number("minor_radius"), None, 3, false);
        }
        "plane" if region.area.is_some() => {
            h.optional(region.area, None, 1, false).raw("\u{a0}mm²");
        }
        "plane" => {}
        _ => {
            h.raw("r ").optional(number("radius"), None, 3, false);
        }
    }
}

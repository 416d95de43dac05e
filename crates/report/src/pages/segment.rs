//! The page of a segmentation: the elements found, each with its size and how well its points keep to it.

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{fact, key_number, section, swatch};
use crate::subject::{Head, Pick, Subject};
use crate::views::segment::color;
use maud::{Markup, Render, html};
use serde_json::Value;
use trueness_document::fit::Number;
use trueness_document::noise::shared;
use trueness_document::segment::{RegionRecord, SegmentDocument};

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

    fn numbers(&self, s: Style) -> Markup {
        // The same shares as in the list: of the area, or of the points of a cloud.
        let assigned = self.regions.iter().map(|r| r.share).sum();
        html! {
            dl.key-numbers {
                (key_number(s, "elements", "lead", s.len(&self.regions)))
                (key_number(s, "assigned", "", s.percent(assigned, 1)))
                (key_number(s, "noise", "", html! { (micro(s, self.noise)) "\u{a0}mm" }))
                @if let Some(points) = shared(self.shared_noise) {
                    (key_number(s, "points_per_independent", "", s.number(points, 1)))
                }
                (key_number(s, "tolerance.used", "", html! { (micro(s, self.tolerance)) "\u{a0}mm" }))
            }
        }
    }

    fn list(&self, s: Style) -> Markup {
        let mesh = self.inputs.iter().any(|i| i.facets.is_some());
        html! {
            (section(s, "elements", elements(s, self)))
            (section(
            s,
            "model",
            html! {
                dl.facts.pairs {
                    (fact(s, if mesh { "facets.title" } else { "points" }, s.count(self.count)))
                    (fact(s, "pieces.none", s.count(self.unassigned)))
                    (fact(s, "crease", html! { (s.number(self.crease.to_degrees(), 1)) "°" }))
                }
            },
        ))
        }
    }

    fn method(&self, s: Style) -> Markup {
        html! { p { (s.word("method.segment.text")) } }
    }

    fn how(&self, s: Style) -> Markup {
        s.word("fit.gaussian").render()
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
fn micro(s: Style, length: f64) -> Markup {
    match length {
        tiny if tiny > 0.0 && tiny < 5e-5 => s.scientific(tiny, 1).render(),
        small if small < 0.1 => s.number(small, 5).render(),
        length => s.number(length, 3).render(),
    }
}

fn elements(s: Style, d: &SegmentDocument) -> Markup {
    html! {
        table.pick {
            thead { tr { th {} th.r { (s.word("size")) } th.r { (s.word("share.title")) } th.r { (s.word("rms")) } } }
            tbody {
                @for (n, region) in d.regions.iter().enumerate() {
                    tr data-pick=(n) {
                        td { (swatch(color(Some(n)))) " " (s.word(format!("verdict.{}", region.shape))) }
                        td.r { (sizes(s, region)) }
                        td.r { (s.percent(region.share, 1)) }
                        td.r { (micro(s, region.rms)) }
                    }
                }
            }
        }
    }
}

/// Radii and angle of an element; of a cone, whose radius is that at some place, the angle alone; of what has neither, its area.
fn sizes(s: Style, region: &RegionRecord) -> Markup {
    let number = |name: &str| match region.parameters.get(name) {
        Some(Number::One(x)) => Some(*x),
        _ => None,
    };
    let (angle, radius) = (number("half_angle"), number("radius"));
    let radii = number("major_radius").zip(number("minor_radius"));
    html! {
        @if let Some(angle) = angle {
            (s.number(angle.to_degrees(), 2)) "°"
        } @else if let Some((major, minor)) = radii {
            "R " (s.number(major, 3)) ", r " (s.number(minor, 3))
        } @else if let Some(radius) = radius {
            "r " (s.number(radius, 3))
        } @else if let Some(area) = region.area {
            (s.number(area, 1)) "\u{a0}mm²"
        }
    }
}

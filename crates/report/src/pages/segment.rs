//! The page of a segmentation: the elements found, each with its size and how well its points keep to it.

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{fact, key_number, line, mm, paragraphs, section, swatch};
use crate::page::table::{Row, table};
use crate::subject::{Content, Pick, Subject};
use crate::views::segment::color;
use maud::{Markup, Render, html};
use trueness_document::fit::Number;
use trueness_document::noise::shared;
use trueness_document::segment::{RegionRecord, SegmentDocument};
use trueness_geom::space::{minus, norm};

impl Subject for SegmentDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        let headline = Headline { key: "segmented", tone: Tone::Neutral };
        let mesh = self.inputs.iter().any(|i| i.facets.is_some());
        let model = html! {
            dl.facts.pairs {
                (fact(s, if mesh { "facets.title" } else { "points" }, s.count(self.count)))
                (fact(s, "pieces.none", s.count(self.unassigned)))
                (fact(s, "crease", html! { (s.number(self.crease.to_degrees(), 1)) "°" }))
            }
        };
        Ok(Content {
            picture: "picture.segment",
            numbers: numbers(s, self),
            list: html! { (section(s, "elements", elements(s, self))) (section(s, "model", model)) },
            method: paragraphs(s, ["method.segment.text"]),
            how: line(s, ["fit.gaussian"]),
            seed: Some(self.seed),
            json: serde_json::to_value(self)?,
            ..Content::of(headline, [&self.schema, &self.version, &self.units], &self.inputs)
        })
    }

    fn picks(&self) -> Vec<Pick> {
        let of = |(n, r): (usize, &RegionRecord)| {
            let (low, high) = (r.bounds.min, r.bounds.max);
            Pick {
                position: std::array::from_fn(|k| low[k] / 2.0 + high[k] / 2.0),
                // A region is large: it is framed, not shown from afar.
                reach: Some(0.3 * (0.5 * norm(minus(high, low)))),
                mark: Some(n),
                object: Some(n),
                ..Pick::default()
            }
        };
        self.regions.iter().enumerate().map(of).collect()
    }
}

fn numbers(s: Style, d: &SegmentDocument) -> Markup {
    // The same shares as in the list: of the area, or of the points of a cloud.
    let assigned = d.regions.iter().map(|r| r.share).sum();
    html! {
        dl.key-numbers {
            (key_number(s, "elements", "lead", s.len(&d.regions)))
            (key_number(s, "assigned", "", s.percent(assigned, 1)))
            (key_number(s, "noise", "", mm(micro(s, d.noise))))
            @if let Some(points) = shared(d.shared_noise) {
                (key_number(s, "points_per_independent", "", s.number(points, 1)))
            }
            (key_number(s, "tolerance.used", "", mm(micro(s, d.tolerance))))
        }
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
    let rows = d.regions.iter().enumerate().map(|(n, region)| {
        let name = html! { (swatch(color(Some(n)))) " " (s.word(format!("verdict.{}", region.shape))) };
        let share = s.percent(region.share, 1);
        Row::of(&[&name, &sizes(s, region), &share, &micro(s, region.rms)]).pick(n)
    });
    table(s, "pick", [&[""], &["size", "share.title", "rms"]], rows)
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

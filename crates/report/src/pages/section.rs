//! The page of sections: the contours drawn to scale, their segments and joins with uncertainties, their residuals.

mod airfoil;
mod fitted;
mod nominal_tables;
mod offers;
mod tables;

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{fact, key_number, line, mm, paragraphs, section};
use crate::subject::{Content, Drawn, Pick, Subject};
use crate::views::section::{nominal, pieces};
use maud::{Markup, html};
use trueness_document::section::{ContourRecord, SectionDocument};
use trueness_document::{ResultDocument, Verdict};

impl Subject for SectionDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        let sign = self.nominal.as_ref().map_or("sign.section", |nominal| pieces::sign(*nominal.positive));
        Ok(Content {
            convention: Some(sign),
            picture: "picture.section",
            numbers: numbers(s, self),
            list: list(s, self),
            method: paragraphs(s, ["method.section.text", "method.section.join", "method.section.comb"]),
            how: line(s, ["fit.gaussian", "orthogonal"]),
            points: Some(self.contours.iter().map(|c| c.points).sum()),
            json: serde_json::to_value(self)?,
            ..Content::of(headline(self), [&self.schema, &self.version, &self.units], &self.inputs)
        })
    }

    fn picks(&self) -> Vec<Pick> {
        let mut all = vec![];
        for contour in &self.contours {
            let frame = self.frame_in(contour.plane);
            all.extend(contour.segments.iter().map(|s| Pick {
                position: frame.place([0, 1].map(|k| 0.5 * (s.start[k] + s.end[k]))),
                reach: Some(0.5 * s.length),
                ..Pick::default()
            }));
            all.extend(contour.joins.iter().map(|j| Pick { position: j.position, ..Pick::default() }));
        }
        all.extend(nominal::picks(self));
        all.into_iter().enumerate().map(|(n, pick)| Pick { mark: Some(n), ..pick }).collect()
    }

    fn drawing(&self) -> Option<&dyn Drawn> {
        Some(self)
    }
}

fn headline(d: &SectionDocument) -> Headline {
    match d.nominal.as_ref().and_then(|nominal| nominal.verdict) {
        // A profile within its tolerance, of which something is doubtful.
        Some(Verdict::Pass) if !d.conforms() => Verdict::Undecided.into(),
        Some(verdict) => verdict.into(),
        None if d.conforms() => Headline { key: "sectioned", tone: Tone::Neutral },
        None => Headline { key: "sectioned", tone: Tone::Undecided },
    }
}

fn numbers(s: Style, d: &SectionDocument) -> Markup {
    let count = |f: &dyn Fn(&ContourRecord) -> usize| d.contours.iter().map(f).sum::<usize>() as u64;
    let counts = [
        ("segments", "lead", count(&|c| c.segments.len())),
        ("joins", "", count(&|c| c.joins.len())),
        ("contours", "", d.contours.len() as u64),
        ("planes", "", d.planes.len() as u64),
        ("outliers", "warn", count(&|c| c.outliers.len())),
        ("gaps", "warn", count(&|c| c.gaps.len())),
        ("segments.astray", "warn", count(&|c| c.astray.len())),
    ];
    html! {
        dl.key-numbers {
            @for (key, class, n) in counts.into_iter().filter(|(.., n)| *n > 0) {
                (key_number(s, key, class, s.count(n)))
            }
            @if let [one] = &d.contours[..] { (key_number(s, tables::scatter(one), "", mm(s.small(one.noise)))) }
        }
    }
}

fn list(s: Style, d: &SectionDocument) -> Markup {
    let model = html! {
        dl.facts.pairs {
            (fact(s, "level", s.percent(d.level, 1)))
            @if let Some(noise) = d.noise_given { (fact(s, "noise.given", mm(s.small(noise)))) }
            @if let Some(continuity) = &d.continuity_given {
                (fact(s, "continuity.given", s.word(format!("join.{continuity}"))))
            }
        }
    };
    html! {
        (section(s, "contours", tables::contours(s, d)))
        @if d.dimensions.count > 0 { (section(s, "dimensions", tables::dimensions(s, &d.dimensions))) }
        @if let Some(airfoils) = &d.airfoils { (section(s, "airfoil", airfoil::airfoils(s, airfoils))) }
        @if let Some(nominal) = &d.nominal { (section(s, "nominal.section", nominal_tables::nominal(s, d, nominal))) }
        @if let Some(methods) = &d.methods { (section(s, "methods", tables::methods(s, methods))) }
        @if !d.planes.is_empty() { (section(s, "planes", tables::planes(s, &d.planes))) }
        (section(s, "model", model))
    }
}

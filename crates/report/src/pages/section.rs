//! The page of sections: the contours drawn to scale, their segments and joins with uncertainties, their residuals.

mod airfoil;
mod course;
mod fitted;
mod head;
mod nominal;
mod nominal_tables;
#[cfg(test)]
mod nominal_tests;
mod offers;
mod path;
mod pieces;
mod plan;
mod sheet;
mod tables;
#[cfg(test)]
mod tests;

use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{fact, key_number, section};
use crate::subject::{Drawn, Head, Pick, Subject};
use crate::{Up, ViewObject};
use maud::{Markup, html};
use serde_json::Value;
use trueness_document::section::{ContourRecord, SectionDocument, Taken};
use trueness_document::{ResultDocument, Verdict};

impl Subject for SectionDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        match self.nominal.as_ref().and_then(|nominal| nominal.verdict) {
            // A profile within its tolerance, of which something is doubtful.
            Some(Verdict::Pass) if !self.conforms() => Verdict::Undecided.into(),
            Some(verdict) => verdict.into(),
            None if self.conforms() => Headline { key: "sectioned", tone: Tone::Neutral },
            None => Headline { key: "sectioned", tone: Tone::Undecided },
        }
    }

    fn convention(&self) -> Option<&'static str> {
        Some(self.nominal.as_ref().map_or("sign.section", |nominal| nominal_tables::sign(*nominal.positive)))
    }

    fn picture(&self) -> &'static str {
        "picture.section"
    }

    fn numbers(&self, s: Style) -> Markup {
        let count = |f: &dyn Fn(&ContourRecord) -> usize| self.contours.iter().map(f).sum::<usize>() as u64;
        let counts = [
            ("segments", "lead", count(&|c| c.segments.len())),
            ("joins", "", count(&|c| c.joins.len())),
            ("contours", "", self.contours.len() as u64),
            ("planes", "", self.planes.len() as u64),
            ("outliers", "warn", count(&|c| c.outliers.len())),
            ("gaps", "warn", count(&|c| c.gaps.len())),
            ("segments.astray", "warn", count(&|c| c.astray.len())),
        ];
        html! {
            dl.key-numbers {
                @for (key, class, n) in counts.into_iter().filter(|(.., n)| *n > 0) {
                    (key_number(s, key, class, s.count(n)))
                }
                @if let [one] = &self.contours[..] {
                    @let scatter = if *one.taken == Taken::Facets { "rms" } else { "noise" };
                    (key_number(s, scatter, "", html! { (s.small(one.noise)) "\u{a0}mm" }))
                }
            }
        }
    }

    fn list(&self, s: Style) -> Markup {
        html! {
            (section(s, "contours", tables::contours(s, self)))
            @if self.dimensions.count > 0 { (section(s, "dimensions", tables::dimensions(s, &self.dimensions))) }
            @if let Some(airfoils) = &self.airfoils { (section(s, "airfoil", airfoil::airfoils(s, airfoils))) }
            @if let Some(nominal) = &self.nominal { (section(s, "nominal.section", nominal_tables::nominal(s, self, nominal))) }
            @if let Some(methods) = &self.methods { (section(s, "methods", tables::methods(s, methods))) }
            @if !self.planes.is_empty() { (section(s, "planes", tables::planes(s, &self.planes))) }
            (section(s, "model", html! {
                dl.facts.pairs {
                    (fact(s, "level", s.percent(self.level, 1)))
                    @if let Some(noise) = self.noise_given {
                        (fact(s, "noise.given", html! { (s.small(noise)) "\u{a0}mm" }))
                    }
                    @if let Some(continuity) = &self.continuity_given {
                        (fact(s, "continuity.given", s.word(format!("join.{continuity}"))))
                    }
                }
            }))
        }
    }

    fn method(&self, s: Style) -> Markup {
        let keys = ["method.section.text", "method.section.join", "method.section.comb"];
        html! { @for key in keys { p { (s.word(key)) } } }
    }

    fn how(&self, s: Style) -> Markup {
        html! { (s.word("fit.gaussian")) " · " (s.word("orthogonal")) }
    }

    fn points(&self) -> Option<u64> {
        Some(self.contours.iter().map(|c| c.points).sum())
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

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }

    fn drawing(&self) -> Option<&dyn Drawn> {
        Some(self)
    }
}

impl Drawn for SectionDocument {
    fn shown(&self, objects: &[ViewObject], up: Up, room: usize) -> (usize, usize) {
        let places = |o: &ViewObject| o.places().len();
        let stride = nominal::Rooms::of(self, objects, up, room).dots;
        let shown = stride.map_or(0, |stride| objects.iter().map(|o| places(o).div_ceil(stride)).sum());
        (shown, objects.iter().map(places).sum())
    }

    fn draw(&self, s: Style, objects: &[ViewObject], up: Up, room: usize) -> Markup {
        let rooms = nominal::Rooms::of(self, objects, up, room);
        // Teeth and whiskers at once are too much.
        let comb = if self.nominal.is_some() { " no-comb" } else { "" };
        html! {
            div id="drawing" class={ "drawing" (comb) } {
                "\n"
                @for (n, sheet) in plan::sheets(self).iter().enumerate() {
                    div.sheet data-plane=[sheet.plane] hidden[n > 0] {
                        "\n" (sheet.draw(s, self, objects, up, &rooms))
                    }
                    "\n"
                }
            }
            "\n"
            div id="courses" class="courses" {
                "\n"
                @for (n, contour) in self.contours.iter().enumerate() { (course::course(s, n, contour, self.nominal.is_some())) }
            }
            "\n"
        }
    }
}

//! The contours of one plane, drawn to scale as SVG.
//!
//! Places are millimeters from the middle of the drawing (`data-origin` says where that is), so that single precision, in
//! which browsers draw, has digits enough; y points down in SVG and is negated. Strokes and signs keep their size on the
//! screen however near one looks.

use super::nominal::{self, Rooms};
use super::path::{Path, Tooth};
use super::pieces::{kind, pick_numbers};
use super::plan::{Plan, Sheet, tip};
use crate::number::Style;
use crate::values::leaf;
use crate::{Up, ViewObject};
use maud::{Markup, html};
use std::fmt::Write;
use trueness_document::section::{Continuity, ContourRecord, SectionDocument};

/// More joins than this have no numbers until the script finds room for them.
const MAX_NUMBERED_JOINS: usize = 40;

impl Sheet<'_> {
    /// The drawing, with as much of the nominal and of the measured points as there is room for.
    pub fn draw(
        &self,
        s: Style,
        document: &SectionDocument,
        objects: &[ViewObject],
        up: Up,
        rooms: &Rooms,
    ) -> Markup {
        let plan = Plan::of(self, document, document.frame_in(self.plane), up);
        let ([w, v], [x, y], [a, b]) = (plan.half, plan.middle, plan.up);
        let numbers = pick_numbers(document);
        let total: usize = self.contours.iter().map(|(_, c)| c.joins.len()).sum();
        html! {
            svg.plan viewBox={ (-w) " " (-v) " " (2.0 * w) " " (2.0 * v) } data-origin={ (x) " " (y) }
                data-all=[plan.all().map(|[x, y, w, h]| format!("{x} {y} {w} {h}"))]
                data-up=[(plan.up != [0.0, 1.0]).then(|| format!("{a} {b}"))] role="img" {
                title { (s.bare_word("picture.section")) }
                "\n"
                (nominal::outlines(&plan, self, document, rooms))
                @for (n, (_, contour)) in self.contours.iter().enumerate() { (comb(&plan, n, contour)) }
                (nominal::whiskers(&plan, self, document, objects, rooms))
                @for (number, _) in &self.contours {
                    @if let Some((object, stride)) = objects.get(*number).zip(rooms.dots) {
                        (leaf("path", &[("class", &"dots"), ("d", &dots(&plan, object, stride))])) "\n"
                    }
                }
                @for ((number, contour), paths) in self.contours.iter().zip(&plan.paths) {
                    (segments(&plan, contour, paths, numbers[*number]))
                }
                @for (number, contour) in &self.contours {
                    (joins(&plan, contour, numbers[*number] + contour.segments.len(), total <= MAX_NUMBERED_JOINS))
                }
                (nominal::worst(s, &plan, self, document))
            }
            "\n"
            (self.legend(s, &plan, document, rooms))
            @if plan.curvature > 0.0 {
                @let radius = 1.0 / plan.curvature;
                p.comb-scale {
                    (s.word("comb.scale")) " " (s.number(plan.curvature, digits(plan.curvature))) "\u{a0}mm⁻¹ (r "
                    (s.number(radius, digits(radius))) "\u{a0}mm)"
                }
                "\n"
            }
        }
    }

    /// What the strokes mean, as far as there are such.
    fn legend(&self, s: Style, plan: &Plan, document: &SectionDocument, rooms: &Rooms) -> Markup {
        let seen = |name: &str| self.contours.iter().flat_map(|(_, c)| &c.segments).any(|s| kind(s) == name);
        let astray = self.contours.iter().any(|(_, c)| !c.astray.is_empty());
        html! {
            p.sheet-legend {
                @for name in ["line", "arc", "spline"].into_iter().filter(|name| seen(name)) {
                    span { i class={ "stroke k-" (name) } {} " " (s.word(format!("segment.{name}"))) } " "
                }
                @if astray { span { i.stroke.astray {} " " (s.word("legend.astray")) } " " }
                (nominal::legend(s, plan, self, document, rooms))
            }
            "\n"
        }
    }
}

/// The segments of a contour; their marks are numbered from `first`.
fn segments(plan: &Plan, contour: &ContourRecord, paths: &[Path], first: usize) -> Markup {
    html! {
        @for (i, (segment, path)) in contour.segments.iter().zip(paths).enumerate() {
            @let astray = if contour.astray.contains(&(i as u64)) { " astray" } else { "" };
            @let class = format!("segment k-{}{astray}", kind(segment));
            (leaf("path", &[("class", &class), ("data-mark", &(first + i)), ("d", &draw(plan, path))])) "\n"
        }
    }
}

/// Digits after the point that show three of a number.
fn digits(x: f64) -> usize {
    (2.0 - libm::log10(x.abs().max(1e-9)).floor()).clamp(0.0, 9.0) as usize
}

fn draw(plan: &Plan, path: &Path) -> String {
    let mut d = String::new();
    let places = path.places();
    for (i, p) in places.iter().enumerate() {
        let [x, y] = plan.at(*p);
        let letter = match path {
            _ if i == 0 => "M",
            Path::Straight(_) => "L",
            Path::Cubic(_) if i % 3 == 1 => "C",
            Path::Cubic(_) => "",
        };
        let _ = write!(d, "{letter}{x} {y} ");
    }
    d.truncate(d.trim_end().len());
    d
}

/// Teeth of a contour's segments, and the line over their tips.
fn comb(plan: &Plan, n: usize, contour: &ContourRecord) -> Markup {
    let of = |teeth: &[Tooth]| {
        let (mut d, mut over) = (String::new(), String::new());
        for (i, tooth) in teeth.iter().enumerate() {
            let ([x, y], [u, v]) = (plan.at(tooth.at), plan.at(tip(tooth, plan.comb)));
            let _ = write!(d, "M{x:.6} {y:.6}L{u:.6} {v:.6}");
            let _ = write!(over, "{}{u:.6} {v:.6}", if i == 0 { "M" } else { "L" });
        }
        d + &over
    };
    html! {
        @for (segment, teeth) in contour.segments.iter().zip(&plan.teeth[n]).filter(|(_, t)| !t.is_empty()) {
            (leaf("path", &[("class", &format!("comb k-{}", kind(segment))), ("d", &of(teeth))])) "\n"
        }
    }
}

/// Measured points: dots of one path.
fn dots(plan: &Plan, object: &ViewObject, stride: usize) -> String {
    let decimals = plan.decimals();
    let mut d = String::new();
    for p in object.places().iter().step_by(stride) {
        let [x, y] = plan.at([p[0], p[1]]);
        let _ = write!(d, "M{x:.decimals$} {y:.decimals$}h0");
    }
    d
}

/// Where each join may lie, and its sign with its number.
fn joins(plan: &Plan, contour: &ContourRecord, first: usize, numbered: bool) -> Markup {
    html! {
        @for (n, join) in contour.joins.iter().enumerate() {
            @let [[a, b], [c, d]] = join.interval.map(|p| plan.at(p));
            @let [x, y] = plan.at(join.point);
            (leaf("path", &[("class", &"interval"), ("d", &format!("M{a} {b} L{c} {d}"))])) "\n"
            g class={ "join " (join.continuity) } data-mark=(first + n) data-at={ (x) " " (y) }
                data-reach=(libm::hypot(c - a, d - b))
                transform={ "translate(" (x) " " (y) ") scale(" (plan.pixel()) ")" } {
                @match *join.continuity {
                    Continuity::G0 => { (leaf("path", &[("d", &"M0 -5 L5 0 L0 5 L-5 0 Z")])) }
                    Continuity::G1 | Continuity::G2 => { (leaf("circle", &[("r", &4.5)])) }
                }
                text x="8" y="-7" visibility=[(!numbered).then_some("hidden")] { (n + 1) }
            }
            "\n"
        }
    }
}

//! The contours of one plane, drawn to scale as SVG.
//!
//! Places are millimeters from the middle of the drawing (`data-origin` says where that is), so that single precision, in
//! which browsers draw, has digits enough; y points down in SVG and is negated. Strokes and signs keep their size on the
//! screen however near one looks.

use super::path::{Path, Tooth, teeth};
use super::pieces::{kind, pick_numbers};
use crate::report::ViewObject;
use crate::report::number::Style;
use crate::report::values::leaf;
use crate::results::section::{ContourRecord, SectionDocument};
use maud::{Markup, html};
use std::fmt::Write;
use trueness_geom::section::Continuity;

/// Length of the longest tooth of the comb, in sizes of the drawing.
const COMB: f64 = 0.1;
/// Distance between teeth, in sizes of the drawing.
const STEP: f64 = 1.0 / 150.0;
/// Width of what is seen, in widths of the drawing: signs and numbers at the rim have room.
const MARGIN: f64 = 1.12;
/// Pixels that the drawing is taken to be wide until the script measures it.
const PIXELS: f64 = 800.0;
/// More joins than this have no numbers until the script finds room for them.
const NUMBERED: usize = 40;

/// The contours of one plane.
pub struct Sheet<'a> {
    /// Number of the plane; of points in order none.
    pub plane: Option<u64>,
    /// Numbers of the contours in the document.
    contours: Vec<(usize, &'a ContourRecord)>,
}

/// What is drawn of a sheet, and how large that is.
struct Plan {
    /// Of each segment of each contour.
    paths: Vec<Vec<Path>>,
    teeth: Vec<Vec<Vec<Tooth>>>,
    /// Middle, and half the width and height of all.
    middle: [f64; 2],
    half: [f64; 2],
    /// Greatest curvature, and millimeters of a tooth for each unit of it.
    curvature: f64,
    comb: f64,
}

/// The sheets of a document: a plane each.
pub fn sheets(document: &SectionDocument) -> Vec<Sheet<'_>> {
    let mut all: Vec<Sheet> = vec![];
    for (n, contour) in document.contours.iter().enumerate() {
        match all.last_mut() {
            Some(sheet) if sheet.plane == contour.plane => sheet.contours.push((n, contour)),
            _ => all.push(Sheet { plane: contour.plane, contours: vec![(n, contour)] }),
        }
    }
    all
}

/// Middle of the box around places, and half its sides.
fn frame(places: impl Iterator<Item = [f64; 2]>) -> ([f64; 2], [f64; 2]) {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in places {
        for k in 0..2 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    if low[0] > high[0] {
        return ([0.0; 2], [1.0; 2]);
    }
    ([0, 1].map(|k| 0.5 * (low[k] + high[k])), [0, 1].map(|k| 0.5 * (high[k] - low[k])))
}

impl Plan {
    fn of(sheet: &Sheet) -> Plan {
        let each = |c: &ContourRecord| c.segments.iter().map(Path::of).collect::<Vec<_>>();
        let paths: Vec<Vec<Path>> = sheet.contours.iter().map(|(_, c)| each(c)).collect();
        let (_, half) = frame(paths.iter().flatten().flat_map(|p| p.places()).copied());
        let size = 2.0 * libm::hypot(half[0], half[1]);
        let of = |c: &ContourRecord| c.segments.iter().map(|s| teeth(s, STEP * size)).collect::<Vec<_>>();
        let teeth: Vec<Vec<Vec<Tooth>>> = sheet.contours.iter().map(|(_, c)| of(c)).collect();
        let curvature = teeth.iter().flatten().flatten().map(|t| t.curvature.abs()).fold(0.0, f64::max);
        let comb = if curvature > 0.0 { COMB * size / curvature } else { 0.0 };
        let drawn = paths.iter().flatten().flat_map(|p| p.places()).copied();
        let (middle, half) = frame(drawn.chain(teeth.iter().flatten().flatten().map(|t| tip(t, comb))));
        let least = 0.02 * half[0].max(half[1]).max(1e-9);
        Plan { paths, teeth, middle, half: half.map(|x| MARGIN * x.max(least)), curvature, comb }
    }

    /// A place as SVG has it.
    fn at(&self, p: [f64; 2]) -> [f64; 2] {
        // 0 and no minus 0.
        [p[0] - self.middle[0], self.middle[1] - p[1] + 0.0]
    }

    /// Millimeters of a pixel at first sight.
    fn pixel(&self) -> f64 {
        2.0 * self.half[0].max(self.half[1]) / PIXELS
    }
}

/// Outside of the curve: on the right where it turns to the left.
fn tip(tooth: &Tooth, comb: f64) -> [f64; 2] {
    [0, 1].map(|k| tooth.at[k] - comb * tooth.curvature * tooth.normal[k])
}

impl Sheet<'_> {
    /// The drawing; of the measured points every `stride`-th, or none.
    pub fn draw(
        &self,
        s: Style,
        document: &SectionDocument,
        objects: &[ViewObject],
        stride: Option<usize>,
    ) -> Markup {
        let plan = Plan::of(self);
        let ([w, v], [x, y]) = (plan.half, plan.middle);
        let numbers = pick_numbers(document);
        let total: usize = self.contours.iter().map(|(_, c)| c.joins.len()).sum();
        html! {
            svg.plan viewBox={ (-w) " " (-v) " " (2.0 * w) " " (2.0 * v) } data-origin={ (x) " " (y) } role="img" {
                title { (s.bare_word("picture.section")) }
                "\n"
                @for (n, (_, contour)) in self.contours.iter().enumerate() { (comb(&plan, n, contour)) }
                @for (number, _) in &self.contours {
                    @if let Some((object, stride)) = objects.get(*number).zip(stride) {
                        (leaf("path", &[("class", &"dots"), ("d", &dots(&plan, object, stride))])) "\n"
                    }
                }
                @for ((number, contour), paths) in self.contours.iter().zip(&plan.paths) {
                    (segments(&plan, contour, paths, numbers[*number]))
                }
                @for (number, contour) in &self.contours {
                    (joins(&plan, contour, numbers[*number] + contour.segments.len(), total <= NUMBERED))
                }
            }
            "\n"
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
}

/// The segments of a contour; their marks are numbered from `first`.
fn segments(plan: &Plan, contour: &ContourRecord, paths: &[Path], first: usize) -> Markup {
    html! {
        @for (i, (segment, path)) in contour.segments.iter().zip(paths).enumerate() {
            @let class = format!("segment k-{}", kind(segment));
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
    // A ten-millionth of the drawing: finer than what can be seen of it however near one looks.
    let size = plan.half[0].max(plan.half[1]);
    let decimals = (7.0 - libm::log10(size).floor()).clamp(0.0, 12.0) as usize;
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

//! The nominal on the sheets: its outlines, the deviations of points from it as whiskers, and the points farthest off.

use super::path::Path;
use super::pieces::{drawn_pieces, lacking, sign};
use super::plan::{Plan, Sheet, sheets};
use crate::number::{Style, decimals};
use crate::subject::Pick;
use crate::values::leaf;
use crate::{Up, ViewObject};
use maud::{Markup, html};
use std::fmt::Write;
use trueness_document::section::SectionDocument;
use trueness_measure::section::divided;
use trueness_section::{Outline, Segment};

/// Bytes that a measured point takes in the drawing, and a whisker.
pub const DOT_BYTES: usize = 26;
const WHISKER_BYTES: usize = 60;
/// Bytes of an outline's element without its places, and of the words and elements of a sheet that a nominal adds.
const OUTLINE_BYTES: usize = 80;
const SHEET_BYTES: usize = 1200;
/// Whiskers of all sheets: more would be an area.
const MAX_WHISKERS: usize = 20_000;
/// Where outlines have no room, straight ones are drawn within this share of the drawing, then within four times as much, …
const LEAST_COARSENESS: f64 = 1e-6;
/// … so many times.
const MAX_COARSER_STEPS: i32 = 9;

/// What of nominal and points there is room for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rooms {
    /// Outlines are drawn within this share of the drawing; `None` where there is no room for them, or none.
    within: Option<f64>,
    /// Every which point has a whisker; `None` without any.
    whiskers: Option<usize>,
    /// Every which point has a dot; `None` without any.
    pub dots: Option<usize>,
}

impl Rooms {
    /// In so many bytes: outlines take half of them at most, whiskers a quarter of the rest, dots what is left.
    pub fn of(document: &SectionDocument, objects: &[ViewObject], up: Up, room: usize) -> Rooms {
        let (mut left, mut within, mut whiskers) = (room, None, None);
        if let Some(found) = &document.nominal {
            let sheets = sheets(document);
            left = left.saturating_sub(SHEET_BYTES * sheets.len());
            let plan = |sheet: &Sheet| Plan::of(sheet, document, document.frame_in(sheet.plane), up);
            let plans: Vec<Plan> = sheets.iter().map(plan).collect();
            let strokes: Vec<(&Plan, [Vec<Outline>; 2])> = (sheets.iter().zip(&plans))
                .flat_map(|(sheet, plan)| sheet.outlines.iter().map(move |(_, o)| (plan, divided(o))))
                .collect();
            let bytes = |within: f64| {
                let of = |(plan, parts): &(&Plan, [Vec<Outline>; 2])| {
                    parts.iter().map(|parts| OUTLINE_BYTES + path(plan, parts, within).len()).sum::<usize>()
                };
                strokes.iter().map(of).sum::<usize>()
            };
            let coarser = |k: i32| if k == 0 { 0.0 } else { LEAST_COARSENESS * 4.0_f64.powi(k - 1) };
            let fit = |w: f64| Some((w, bytes(w))).filter(|(_, bytes)| *bytes <= left / 2);
            let fitting = (0..=MAX_COARSER_STEPS).map(coarser).find_map(fit);
            within = fitting.map(|(within, _)| within);
            left -= fitting.map_or(0, |(_, bytes)| bytes);
            let most = (left / 4 / WHISKER_BYTES).min(MAX_WHISKERS);
            let all = found.deviations.iter().flatten().flatten().count();
            whiskers = (most > objects.len()).then(|| all.div_ceil(most - objects.len()).max(1));
            let taken = whiskers.map_or(0, |stride| all.div_ceil(stride) + objects.len());
            left -= WHISKER_BYTES * taken;
        }
        let fit = (left / DOT_BYTES).checked_sub(objects.len()).filter(|n| *n > 0);
        let count = objects.iter().map(|o| o.places().len()).sum::<usize>();
        Rooms { within, whiskers, dots: fit.map(|fit| count.div_ceil(fit).max(1)) }
    }
}

/// Outlines as one path.
fn path(plan: &Plan, parts: &[Outline], within: f64) -> String {
    parts.iter().map(|part| course(plan, part, within)).collect()
}

/// The course of an outline: exactly, or straight parts within a share of the drawing.
fn course(plan: &Plan, outline: &Outline, within: f64) -> String {
    let decimals = plan.decimals();
    let mut d = String::new();
    let write = |d: &mut String, letter: &str, p: [f64; 2]| {
        let [x, y] = plan.at(p);
        let _ = write!(d, "{letter}{x:.decimals$} {y:.decimals$}");
    };
    let segments = &outline.segments;
    let Some(first) = segments.first() else { return d };
    write(&mut d, "M", first.start);
    let mut run = vec![first.start];
    let straight = |d: &mut String, run: &[[f64; 2]]| {
        let kept = thinned(run, within * plan.half[0].max(plan.half[1]));
        kept.into_iter().skip(1).for_each(|p| write(d, "L", p));
    };
    for segment in segments {
        match Path::of_nominal(segment) {
            Path::Straight(places) => run.extend(places.into_iter().skip(1)),
            Path::Cubic(places) => {
                straight(&mut d, &run);
                for (i, p) in places.iter().enumerate().skip(1) {
                    write(&mut d, if i % 3 == 1 { "C" } else { " " }, *p);
                }
                run = places.last().map_or(vec![], |p| vec![*p]);
            }
        }
    }
    straight(&mut d, &run);
    if outline.closed {
        d.push('Z');
    }
    d
}

/// As few of the places as keep within a distance of all of them, the ends among them (Douglas and Peucker 1973). All at the distance 0.
fn thinned(places: &[[f64; 2]], within: f64) -> Vec<[f64; 2]> {
    if within <= 0.0 || places.len() < 3 {
        return places.to_vec();
    }
    let mut kept = vec![false; places.len()];
    let mut open = vec![(0, places.len() - 1)];
    (kept[0], kept[places.len() - 1]) = (true, true);
    while let Some((a, b)) = open.pop() {
        let chord = Segment::straight(places[a], places[b]);
        let far = |i: usize| chord.nearest(places[i]).distance.abs();
        let Some(worst) = (a + 1..b).max_by(|i, j| far(*i).total_cmp(&far(*j))) else { continue };
        if far(worst) > within {
            kept[worst] = true;
            open.extend([(a, worst), (worst, b)]);
        }
    }
    places.iter().zip(kept).filter(|(_, kept)| *kept).map(|(p, _)| *p).collect()
}

/// The outlines of a sheet.
pub fn outlines(plan: &Plan, sheet: &Sheet, document: &SectionDocument, rooms: &Rooms) -> Markup {
    let Some(within) = rooms.within else { return Markup::default() };
    let first = drawn_pieces(document) + document.nominal.as_ref().map_or(0, |n| n.worst.len());
    let listed = lacking(document);
    html! {
        @for (number, record) in &sheet.outlines {
            @let [measured, missed] = divided(record).map(|parts| path(plan, &parts, within));
            @if !measured.is_empty() { (leaf("path", &[("class", &"nominal"), ("d", &measured)])) "\n" }
            @if !missed.is_empty() {
                @match listed.binary_search(number) {
                    Ok(n) => { (leaf("path", &[("class", &"nominal missed"), ("data-mark", &(first + n)), ("d", &missed)])) }
                    Err(_) => { (leaf("path", &[("class", &"nominal missed"), ("d", &missed)])) }
                }
                "\n"
            }
        }
    }
}

/// The deviations of the points of a sheet: from the nominal through the point, so many times as long.
pub fn whiskers(
    plan: &Plan,
    sheet: &Sheet,
    document: &SectionDocument,
    objects: &[ViewObject],
    rooms: &Rooms,
) -> Markup {
    let (Some(found), Some(stride)) = (&document.nominal, rooms.whiskers) else { return Markup::default() };
    let decimals = plan.decimals().saturating_sub(1);
    let mut sides = [String::new(), String::new()];
    for (number, _) in &sheet.contours {
        let (Some(object), Some(deviations)) = (objects.get(*number), found.deviations.get(*number)) else {
            continue;
        };
        let nearest = found.nearest.get(*number).map_or(&[][..], |n| n);
        let known = object.places().iter().zip(deviations).zip(nearest);
        let known = known.filter_map(|((p, d), n)| Some((p, (*d)?, (*n)?)));
        for (p, deviation, near) in known.step_by(stride).filter(|(_, deviation, _)| *deviation != 0.0) {
            let tip = [0, 1].map(|k| near[k] + plan.times * (p[k] - near[k]));
            let [[x, y], [u, v]] = [near, tip].map(|p| plan.at(p));
            let side = &mut sides[usize::from(deviation < 0.0)];
            let _ = write!(side, "M{x:.decimals$} {y:.decimals$}L{u:.decimals$} {v:.decimals$}");
        }
    }
    html! {
        @for (d, side) in sides.iter().zip(["plus", "minus"]).filter(|(d, _)| !d.is_empty()) {
            (leaf("path", &[("class", &format!("whisker {side}")), ("d", d)])) "\n"
        }
    }
}

/// The points farthest off on both sides, as far as they are on this sheet.
pub fn worst(s: Style, plan: &Plan, sheet: &Sheet, document: &SectionDocument) -> Markup {
    let Some(found) = &document.nominal else { return Markup::default() };
    let first = drawn_pieces(document);
    let digits = decimals(found.deviation.all.std_dev, 4);
    let own = |contour: u64| sheet.contours.iter().any(|(n, _)| *n as u64 == contour);
    html! {
        @for (n, worst) in found.worst.iter().enumerate().filter(|(_, w)| own(w.contour)) {
            @let [[x, y], [u, v]] = [worst.point, worst.nearest].map(|p| plan.at(p));
            @let (side, sign) = if worst.deviation > 0.0 { ("plus", "M0 -6L6 5H-6Z") } else { ("minus", "M0 6L6 -5H-6Z") };
            @let right = x > 0.5 * plan.half[0];
            (leaf("path", &[("class", &format!("off {side}")), ("d", &format!("M{u} {v}L{x} {y}"))])) "\n"
            g class={ "worst " (side) } data-mark=(first + n) data-at={ (x) " " (y) } data-reach=(worst.deviation.abs())
                transform={ "translate(" (x) " " (y) ") scale(" (plan.pixel()) ")" } {
                (leaf("path", &[("d", &sign)]))
                // At the right rim there is no room to the right.
                text x=(if right { "-9" } else { "9" }) y="-6" text-anchor=[right.then_some("end")] {
                    tspan data-n=(worst.deviation) data-d=(digits) data-s { (s.signed(worst.deviation, digits)) }
                }
            }
            "\n"
        }
    }
}

/// What strokes of the nominal and whiskers mean.
pub fn legend(s: Style, plan: &Plan, sheet: &Sheet, document: &SectionDocument, rooms: &Rooms) -> Markup {
    let missed = sheet.outlines.iter().any(|(_, o)| o.lacks());
    let solid = sheet.outlines.iter().any(|(_, o)| o.covered > 0.0);
    let drawn = rooms.within.filter(|_| !sheet.outlines.is_empty());
    let whiskers = document.nominal.is_some() && rooms.whiskers.is_some() && !sheet.contours.is_empty();
    html! {
        @if let Some(within) = drawn {
            @if solid || within > 0.0 {
                span {
                    i.stroke.nominal {} " " (s.word("reference"))
                    @if within > 0.0 {
                        " ≤\u{a0}" (s.small(within * plan.half[0].max(plan.half[1]))) "\u{a0}mm"
                    }
                }
                " "
            }
            @if missed { span { i.stroke.nominal.missed {} " " (s.word("nominal.missed")) } " " }
        }
        @if whiskers {
            span.off-legend {
                i.stroke.plus {} i.stroke.minus {} " " (s.word("deviation")) " ×\u{a0}" (s.number(plan.times, 0)) " (▲\u{a0}+ ▼\u{a0}−)"
                @if let Some(found) = &document.nominal { " · " (s.word(sign(*found.positive))) }
            }
            " "
        }
    }
}

/// The places of the points farthest off, then of the outlines that were not measured as a whole.
pub fn picks(document: &SectionDocument) -> Vec<Pick> {
    let Some(found) = &document.nominal else { return vec![] };
    let worst = found.worst.iter().map(|w| {
        let plane = document.contours.get(w.contour as usize).and_then(|c| c.plane);
        Pick { position: document.frame_in(plane).place(w.point), ..Pick::default() }
    });
    let outline = |n: usize| {
        let o = &found.outlines[n];
        let reach = Some(0.5 * libm::hypot(o.size[0], o.size[1]));
        Pick { position: document.frame_in(o.plane).place(o.center), reach, ..Pick::default() }
    };
    worst.chain(lacking(document).into_iter().map(outline)).collect()
}

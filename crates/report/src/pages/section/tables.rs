//! The tables of sections.

use super::offers::{between, offers};
use crate::number::{Style, decimals};
use crate::page::parts::{fact, mm, warning, with_uncertainty};
use crate::page::table::{Row, not_printed, row_class, table};
use crate::values::Text;
use crate::views::section::pieces::{kind, pick_numbers};
use maud::{Markup, html};
use trueness_document::section::{
    ContourRecord, DimensionKind, DimensionsRecord, GeometryRecord, JoinRecord, MethodsRecord, PlaneRecord,
    SectionDocument, SegmentRecord, Taken, UncertaintyRecord,
};

/// Contours that are listed open.
const MAX_OPEN_CONTOURS: usize = 3;

/// Every contour with its segments and joins.
pub fn contours(s: Style, document: &SectionDocument) -> Markup {
    let numbers = pick_numbers(document);
    html! {
        @for (n, contour) in document.contours.iter().enumerate() {
            details.kind.contour data-contour=(n) open[n < MAX_OPEN_CONTOURS] {
                summary {
                    span.kind-name {
                        (s.word("contour")) "\u{a0}" (n + 1)
                        @if let Some(plane) = contour.plane.filter(|_| document.planes.len() > 1) {
                            " · " (s.word("plane")) "\u{a0}" (plane + 1)
                        }
                    }
                    (s.word(if contour.closed { "contour.closed" } else { "contour.open" }))
                    strong { (s.len(&contour.segments)) }
                }
                (facts(s, contour))
                @for hint in contour.doubts.iter().chain(&contour.hints) { (warning(Text(hint))) }
                @if !contour.astray.is_empty() {
                    (warning(html! { (s.word("contour.astray")) " " (listed(&contour.astray)) }))
                }
                @if let ([[x, y], ..], []) = (&contour.crossings[..], &contour.astray[..]) {
                    (warning(html! { (s.word("contour.crossings")) " (" (s.number(*x, 4)) ", " (s.number(*y, 4)) ")" }))
                }
                div.wide { (segments(s, contour, numbers[n])) }
                @if contour.joins_reason.is_some() {
                    @let line = matches!(&contour.segments[..], [one] if matches!(one.geometry, GeometryRecord::Line { .. }));
                    p.note { (s.word("joins.none")) ": " (s.word(if line { "joins.one_line" } else { "joins.one_curve" })) }
                }
                @if !contour.joins.is_empty() {
                    div.wide { (joins(s, contour, numbers[n] + contour.segments.len())) }
                }
                (offers(s, contour))
            }
        }
    }
}

/// Numbers, counted from 1.
fn listed(numbers: &[u64]) -> String {
    numbers.iter().map(|n| (n + 1).to_string()).collect::<Vec<_>>().join(", ")
}

/// The word for how far points lie from a contour: facets have no noise.
pub fn scatter(contour: &ContourRecord) -> &'static str {
    if *contour.taken == Taken::Facets { "rms" } else { "noise" }
}

fn facts(s: Style, contour: &ContourRecord) -> Markup {
    let lists = [("outliers", &contour.outliers), ("repeated", &contour.repeated), ("gaps", &contour.gaps)];
    html! {
        dl.facts.pairs {
            (fact(s, "taken", s.word(format!("taken.{}", contour.taken.name()))))
            (fact(s, "points", s.count(contour.points)))
            (fact(s, "length.title", mm(s.number(contour.length, 3))))
            (fact(s, scatter(contour), mm(s.small(contour.noise))))
            (fact(s, "spacing", mm(s.small(contour.spacing))))
            @for (key, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
                (fact(s, key, s.len(list)))
            }
        }
    }
}

fn segments(s: Style, contour: &ContourRecord, first: usize) -> Markup {
    let row = |(n, segment): (usize, &SegmentRecord)| {
        let astray = if contour.astray.contains(&(n as u64)) { " astray" } else { "" };
        let called = html! {
            i class={ "stroke k-" (kind(segment)) (astray) } {} "\u{a0}"
            (s.word(format!("segment.{}", kind(segment))))
        };
        let [what, known] = known_by(s, segment);
        let u = segment.length_uncertainty;
        let length = html! { (s.number(segment.length, decimals(u, 4))) @if let Some(u) = u { " ±\u{a0}" (s.small(u)) } };
        let [rms, max] = [segment.rms, segment.max].map(|x| s.small(x));
        let row = Row::of(&[&(n + 1), &called, &what, &known, &length, &rms, &max]);
        row.pick(first + n).class(row_class(n)).then(of_arc(s, segment))
    };
    let columns: [&[&str]; 2] = [&["", ""], &["parameter", "uncertainty", "length.title", "rms", "greatest"]];
    let rows = contour.segments.iter().enumerate().map(row);
    html! { (table(s, "pick segments", columns, rows)) (not_printed(s, contour.segments.len())) }
}

/// The rows under that of an arc, or of a curve that is nearly one.
fn of_arc(s: Style, segment: &SegmentRecord) -> Markup {
    let under = |text: Markup| html! { tr.under { td {} td colspan="6" { (text) } } };
    html! {
        @if let GeometryRecord::Arc { center, .. } = &segment.geometry {
            @let u = match segment.uncertainty { Some(UncertaintyRecord::Arc { center, .. }) => center.map(Some), _ => [None; 2] };
            @let [x, y] = [0, 1].map(|k| with_uncertainty(s, center[k], u[k]));
            (under(html! { (s.word("parameter.center")) " x\u{a0}" (x) " · y\u{a0}" (y) }))
        }
        @if let Some(arc) = &segment.near_arc {
            (under(html! {
                (s.word("segment.near_arc")) " ≤\u{a0}" (s.small(arc.max)) " · r\u{a0}" (s.number(arc.radius, 4))
                " · x\u{a0}" (s.number(arc.center[0], 4)) " · y\u{a0}" (s.number(arc.center[1], 4))
            }))
        }
    }
}

/// Angle, radius or control points with the uncertainty, in two cells.
fn known_by(s: Style, segment: &SegmentRecord) -> [Markup; 2] {
    let reason = segment.uncertainty_reason.as_deref();
    let (what, u, unit) = match (&segment.geometry, &segment.uncertainty) {
        (GeometryRecord::Line { angle }, u) => {
            let u = match u {
                Some(UncertaintyRecord::Line { angle }) => Some(angle.to_degrees()),
                _ => None,
            };
            (html! { "∠\u{a0}" (s.number(angle.to_degrees(), decimals(u, 4))) "°" }, u, "°")
        }
        (GeometryRecord::Arc { radius, .. }, u) => {
            let u = match u {
                Some(UncertaintyRecord::Arc { radius, .. }) => Some(*radius),
                _ => None,
            };
            (html! { "r\u{a0}" (s.number(*radius, decimals(u, 4))) }, u, "")
        }
        (GeometryRecord::Spline { control_points, .. }, _) => {
            (html! { (s.len(control_points)) "\u{a0}" (s.word("spline.points")) }, None, "")
        }
    };
    [what, uncertain(s, u, reason, unit)]
}

fn uncertain(s: Style, u: Option<f64>, reason: Option<&str>, unit: &str) -> Markup {
    html! {
        @match u {
            Some(u) => { (s.small(u)) (unit) }
            None => { (s.optional(None, 0).because(reason)) }
        }
    }
}

fn joins(s: Style, contour: &ContourRecord, first: usize) -> Markup {
    let row = |(n, join): (usize, &JoinRecord)| {
        let called = html! {
            i class={ "sign " (join.continuity) } {} "\u{a0}"
            (s.word(format!("join.{}", join.continuity)))
        };
        let [x, y] = join.point.map(|x| s.number(x, decimals(Some(join.std_uncertainty), 4)));
        let [a, b] = join.interval;
        let interval = html! {
            @if join.interval_open.contains(&true) { "≥\u{a0}" }
            (s.small(libm::hypot(b[0] - a[0], b[1] - a[1])))
        };
        let row = Row::of(&[&(n + 1), &called, &x, &y, &s.small(join.std_uncertainty), &interval]);
        row.pick(first + n).class(row_class(n))
    };
    let columns: [&[&str]; 2] = [&["", ""], &["x", "y", "uncertainty", "interval"]];
    let rows = contour.joins.iter().enumerate().map(row);
    html! { (table(s, "pick joins", columns, rows)) (not_printed(s, contour.joins.len())) }
}

/// Dimensions that are listed.
const MAX_LISTED_DIMENSIONS: usize = 60;

/// Angles, widths, distances of centers, gaps.
pub fn dimensions(s: Style, all: &DimensionsRecord) -> Markup {
    let rows = all.items.iter().take(MAX_LISTED_DIMENSIONS).enumerate().map(|(n, item)| {
        let angle = *item.kind == DimensionKind::Angle;
        let shown = |x: f64| if angle { x.to_degrees() } else { x };
        let unit = if angle { "°" } else { "" };
        let u = item.std_uncertainty.map(shown);
        let value = html! { (s.number(shown(item.value), decimals(u, 4))) (unit) };
        let called = s.word(format!("dimension.{}", item.kind));
        let known = uncertain(s, u, item.std_uncertainty_reason.as_deref(), unit);
        Row::of(&[&(n + 1), &called, &between(&item.of), &value, &known])
    });
    html! {
        div.wide { (table(s, "dimensions", [&["", ""], &["between", "value", "uncertainty"]], rows)) }
        p.note {
            (s.word("dimensions.text")) @if all.count > MAX_LISTED_DIMENSIONS as u64 { " " (s.word("dimensions.more")) }
        }
    }
}

/// The paper's methods side by side.
pub fn methods(s: Style, methods: &MethodsRecord) -> Markup {
    let rows = methods.table.iter().map(|m| {
        let chosen = if m.method == methods.chosen { "●" } else { "" };
        let [x, y] = m.join.map(|x| s.number(x, 4));
        let [interval, line, curve] = [m.interval_length, m.line.rms, m.curve.rms].map(|x| s.small(x));
        Row::of(&[&chosen, &Text(&m.method), &interval, &x, &y, &line, &curve])
    });
    html! {
        div.wide { (table(s, "methods", [&["", ""], &["interval", "x", "y", "rms", "rms"]], rows)) }
        p.note { (s.word("methods.text")) }
    }
}

/// The planes that a mesh or cloud was cut by.
pub fn planes(s: Style, planes: &[PlaneRecord]) -> Markup {
    let rows = planes.iter().enumerate().map(|(n, plane)| {
        let [x, y, z] = plane.normal.map(|x| s.number(x, if x == x.round() { 0 } else { 4 }));
        let area = s.optional(plane.area, 3).because(plane.area_reason.as_deref());
        let normal = html! { (x) " " (y) " " (z) };
        Row::of(&[&(n + 1), &normal, &s.number(plane.offset, 3), &s.count(plane.contours), &area])
    });
    let columns: [&[&str]; 2] = [&["", ""], &["distance.title", "contours", "area.section"]];
    html! { div.wide { (table(s, "planes", columns, rows)) } }
}

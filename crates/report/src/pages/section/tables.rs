//! The tables of sections.

use super::head::head;
use super::pieces::{kind, pick_numbers};
use crate::number::{Style, decimals};
use crate::page::parts::{fact, not_printed, row_class};
use crate::values::{Number, Optional, Text};
use maud::{Markup, html};
use trueness_document::section::{
    ContourRecord, DimensionKind, DimensionsRecord, GeometryRecord, MethodsRecord, PlaneRecord,
    SectionDocument, SegmentRecord, Taken, UncertaintyRecord,
};

/// Contours that are listed open.
const OPEN: usize = 3;

/// Every contour with its segments and joins.
pub fn contours(s: Style, document: &SectionDocument) -> Markup {
    let numbers = pick_numbers(document);
    html! {
        @for (n, contour) in document.contours.iter().enumerate() {
            details.kind.contour data-contour=(n) open[n < OPEN] {
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
                @for hint in contour.doubts.iter().chain(&contour.hints) {
                    p.note { strong.warning { "⚠" } " " (Text(hint)) }
                }
                @if !contour.astray.is_empty() {
                    p.note { strong.warning { "⚠" } " " (s.word("contour.astray")) " " (listed(&contour.astray)) }
                }
                @if let ([[x, y], ..], []) = (&contour.crossings[..], &contour.astray[..]) {
                    p.note { strong.warning { "⚠" } " " (s.word("contour.crossings")) " (" (s.number(*x, 4)) ", " (s.number(*y, 4)) ")" }
                }
                div.wide { (segments(s, contour, numbers[n])) }
                @if contour.joins_reason.is_some() {
                    @let line = matches!(&contour.segments[..], [one] if matches!(one.geometry, GeometryRecord::Line { .. }));
                    p.note { (s.word("joins.none")) ": " (s.word(if line { "joins.one_line" } else { "joins.one_curve" })) }
                }
                @if !contour.joins.is_empty() {
                    div.wide { (joins(s, contour, numbers[n] + contour.segments.len())) }
                }
                (super::offers::offers(s, contour))
            }
        }
    }
}

/// Numbers, counted from 1.
fn listed(numbers: &[u64]) -> String {
    numbers.iter().map(|n| (n + 1).to_string()).collect::<Vec<_>>().join(", ")
}

fn facts(s: Style, contour: &ContourRecord) -> Markup {
    let lists = [("outliers", &contour.outliers), ("repeated", &contour.repeated), ("gaps", &contour.gaps)];
    html! {
        dl.facts.pairs {
            (fact(s, "taken", s.word(format!("taken.{}", contour.taken.name()))))
            (fact(s, "points", s.count(contour.points)))
            (fact(s, "length.title", html! { (s.number(contour.length, 3)) "\u{a0}mm" }))
            @let scatter = if *contour.taken == Taken::Facets { "rms" } else { "noise" };
            (fact(s, scatter, html! { (s.small(contour.noise)) "\u{a0}mm" }))
            (fact(s, "spacing", html! { (s.small(contour.spacing)) "\u{a0}mm" }))
            @for (key, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
                (fact(s, key, s.len(list)))
            }
        }
    }
}

fn segments(s: Style, contour: &ContourRecord, first: usize) -> Markup {
    html! {
        table.pick.segments {
            (head(s, &["parameter", "uncertainty", "length.title", "rms", "greatest"]))
            tbody {
                @for (n, segment) in contour.segments.iter().enumerate() {
                    @let u = segment.length_uncertainty;
                    tr data-pick=(first + n) class=[row_class(n)] {
                        td { (n + 1) }
                        td {
                            @let astray = if contour.astray.contains(&(n as u64)) { " astray" } else { "" };
                            i class={ "stroke k-" (kind(segment)) (astray) } {} "\u{a0}"
                            (s.word(format!("segment.{}", kind(segment))))
                        }
                        (known_by(s, segment))
                        td.r {
                            (s.number(segment.length, decimals(u, 4))) @if let Some(u) = u { " ±\u{a0}" (s.small(u)) }
                        }
                        td.r { (s.small(segment.rms)) }
                        td.r { (s.small(segment.max)) }
                    }
                    @if let GeometryRecord::Arc { center, .. } = &segment.geometry {
                        (of_center(s, *center, segment.uncertainty.as_ref()))
                    }
                    @if let Some(arc) = &segment.near_arc {
                        tr.under {
                            td {}
                            td colspan="6" {
                                (s.word("segment.near_arc")) " ≤\u{a0}" (s.small(arc.max)) " · r\u{a0}" (s.number(arc.radius, 4))
                                " · x\u{a0}" (s.number(arc.center[0], 4)) " · y\u{a0}" (s.number(arc.center[1], 4))
                            }
                        }
                    }
                }
            }
        }
        (not_printed(s, contour.segments.len()))
    }
}

/// Angle, radius or control points with the uncertainty, as two cells.
fn known_by(s: Style, segment: &SegmentRecord) -> Markup {
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
    html! { td.r { (what) } td.r { (uncertain(s, u, reason, unit)) } }
}

fn uncertain(s: Style, u: Option<f64>, reason: Option<&str>, unit: &str) -> Markup {
    html! {
        @match u {
            Some(u) => { (s.small(u)) (unit) }
            None => { (none(s, reason)) }
        }
    }
}

/// That there is no number, and why.
fn none(s: Style, reason: Option<&str>) -> Optional<'_, Number> {
    s.optional(None, 0).because(reason)
}

/// The row of an arc's center under its own.
fn of_center(s: Style, center: [f64; 2], uncertainty: Option<&UncertaintyRecord>) -> Markup {
    let u = match uncertainty {
        Some(UncertaintyRecord::Arc { center, .. }) => Some(*center),
        _ => None,
    };
    let coordinate = |k: usize| {
        let u = u.map(|u| u[k]);
        html! { (s.number(center[k], decimals(u, 4))) @if let Some(u) = u { "\u{a0}±\u{a0}" (s.small(u)) } }
    };
    html! {
        tr.under {
            td {}
            td colspan="6" { (s.word("parameter.center")) " x\u{a0}" (coordinate(0)) " · y\u{a0}" (coordinate(1)) }
        }
    }
}

fn joins(s: Style, contour: &ContourRecord, first: usize) -> Markup {
    html! {
        table.pick.joins {
            (head(s, &["x", "y", "uncertainty", "interval"]))
            tbody {
                @for (n, join) in contour.joins.iter().enumerate() {
                    @let [a, b] = join.interval;
                    tr data-pick=(first + n) class=[row_class(n)] {
                        td { (n + 1) }
                        td {
                            i class={ "sign " (join.continuity) } {} "\u{a0}"
                            (s.word(format!("join.{}", join.continuity)))
                        }
                        @for x in join.point { td.r { (s.number(x, decimals(Some(join.std_uncertainty), 4))) } }
                        td.r { (s.small(join.std_uncertainty)) }
                        td.r {
                            @if join.interval_open.contains(&true) { "≥\u{a0}" }
                            (s.small(libm::hypot(b[0] - a[0], b[1] - a[1])))
                        }
                    }
                }
            }
        }
        (not_printed(s, contour.joins.len()))
    }
}

/// Dimensions that are listed.
const LISTED: usize = 60;

/// Angles, widths, distances of centers, gaps.
pub fn dimensions(s: Style, all: &DimensionsRecord) -> Markup {
    html! {
        div.wide {
            table.dimensions {
                (head(s, &["between", "value", "uncertainty"]))
                tbody {
                    @for (n, item) in all.items.iter().take(LISTED).enumerate() {
                        @let angle = *item.kind == DimensionKind::Angle;
                        @let shown = |x: f64| if angle { x.to_degrees() } else { x };
                        @let unit = if angle { "°" } else { "" };
                        @let u = item.std_uncertainty.map(shown);
                        @let [from, to] = item.of.map(|m| format!("{}.{}", m.contour + 1, m.segment + 1));
                        tr {
                            td { (n + 1) }
                            td { (s.word(format!("dimension.{}", item.kind))) }
                            td.r { (from) " – " (to) }
                            td.r { (s.number(shown(item.value), decimals(u, 4))) (unit) }
                            td.r { (uncertain(s, u, item.std_uncertainty_reason.as_deref(), unit)) }
                        }
                    }
                }
            }
        }
        p.note {
            (s.word("dimensions.text")) @if all.count > LISTED as u64 { " " (s.word("dimensions.more")) }
        }
    }
}

/// The paper's methods side by side.
pub fn methods(s: Style, methods: &MethodsRecord) -> Markup {
    html! {
        div.wide {
            table.methods {
                (head(s, &["interval", "x", "y", "rms", "rms"]))
                tbody {
                    @for m in &methods.table {
                        tr {
                            td { @if m.method == methods.chosen { "●" } }
                            td { (Text(&m.method)) }
                            td.r { (s.small(m.interval_length)) }
                            @for x in m.join { td.r { (s.number(x, 4)) } }
                            @for x in [m.line.rms, m.curve.rms] { td.r { (s.small(x)) } }
                        }
                    }
                }
            }
        }
        p.note { (s.word("methods.text")) }
    }
}

/// The planes that a mesh or cloud was cut by.
pub fn planes(s: Style, planes: &[PlaneRecord]) -> Markup {
    let whole = |x: f64| s.number(x, if x == x.round() { 0 } else { 4 });
    html! {
        div.wide {
            table.planes {
                (head(s, &["distance.title", "contours", "area.section"]))
                tbody {
                    @for (n, plane) in planes.iter().enumerate() {
                        @let [x, y, z] = plane.normal;
                        tr {
                            td { (n + 1) }
                            td { (whole(x)) " " (whole(y)) " " (whole(z)) }
                            td.r { (s.number(plane.offset, 3)) }
                            td.r { (s.count(plane.contours)) }
                            td.r { (s.optional(plane.area, 3).because(plane.area_reason.as_deref())) }
                        }
                    }
                }
            }
        }
    }
}

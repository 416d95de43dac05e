//! The tables of sections.

use super::super::super::html::Html;
use super::super::super::page::blocks::{fact, file_name, not_printed, pick_row};
use super::super::compare::by_side;
use super::pieces::{kind, pick_numbers};
use crate::results::section::{
    ContourRecord, DimensionsRecord, GeometryRecord, MethodsRecord, NominalRecord, PlaneRecord,
    SectionDocument, SegmentRecord, UncertaintyRecord,
};

/// Contours that are listed open.
const OPEN: usize = 3;

/// A small length: two digits of it, as 1.5e−7 where it would need many zeros.
pub fn small(h: &mut Html, x: f64) -> &mut Html {
    match x {
        0.0 => h.raw("0"),
        x if x < 1e-5 => h.scientific(x, 1),
        x => h.number(x, decimals(Some(x), 4), false),
    }
}

/// Digits after the point that show two digits of an uncertainty.
pub fn decimals(uncertainty: Option<f64>, without: usize) -> usize {
    let u = uncertainty.filter(|u| *u > 0.0 && u.is_finite());
    u.map_or(without, |u| (1.0 - libm::log10(u).floor()).clamp(1.0, 9.0) as usize)
}

/// Every contour with its segments and joins.
pub fn contours(h: &mut Html, document: &SectionDocument) {
    let numbers = pick_numbers(document);
    for (n, contour) in document.contours.iter().enumerate() {
        let open = if n < OPEN { " open" } else { "" };
        h.raw(&format!("<details class=\"kind contour\" data-contour=\"{n}\"{open}><summary>"));
        h.raw("<span class=\"kind-name\">").word("contour").raw(&format!("\u{a0}{}", n + 1));
        if let Some(plane) = contour.plane.filter(|_| document.planes.len() > 1) {
            h.raw(" · ").word("plane").raw(&format!("\u{a0}{}", plane + 1));
        }
        h.raw("</span>").word(if contour.closed { "contour.closed" } else { "contour.open" });
        h.raw("<strong>").count(contour.segments.len() as u64).raw("</strong></summary>");
        facts(h, contour);
        if !contour.astray.is_empty() {
            let numbers: Vec<String> = contour.astray.iter().map(|s| (s + 1).to_string()).collect();
            h.raw("<p class=\"note\"><strong class=\"warning\">⚠</strong> ").word("contour.astray");
            h.raw(" ").text(&numbers.join(", ")).raw("</p>");
        }
        if let [[x, y], ..] = contour.crossings[..] {
            h.raw("<p class=\"note\"><strong class=\"warning\">⚠</strong> ").word("contour.crossings");
            h.raw(&format!(" ({x:.4}, {y:.4})</p>"));
        }
        h.raw("<div class=\"wide\">");
        segments(h, contour, numbers[n]);
        h.raw("</div>");
        if let Some(reason) = &contour.joins_reason {
            h.raw("<p class=\"note\">").word("joins.none").raw(": ").text(reason).raw("</p>");
        }
        if !contour.joins.is_empty() {
            h.raw("<div class=\"wide\">");
            joins(h, contour, numbers[n] + contour.segments.len());
            h.raw("</div>");
        }
        h.raw("</details>");
    }
}

fn facts(h: &mut Html, contour: &ContourRecord) {
    h.raw("<dl class=\"facts pairs\">");
    fact(h, "taken", |h| {
        h.word(&format!("taken.{}", contour.taken));
    });
    fact(h, "points", |h| {
        h.count(contour.points);
    });
    fact(h, "length.title", |h| {
        h.number(contour.length, 3, false).raw("\u{a0}mm");
    });
    for (key, x) in [("noise", contour.noise), ("spacing", contour.spacing)] {
        fact(h, key, |h| {
            small(h, x).raw("\u{a0}mm");
        });
    }
    for (key, list) in
        [("outliers", &contour.outliers), ("repeated", &contour.repeated), ("gaps", &contour.gaps)]
    {
        if !list.is_empty() {
            fact(h, key, |h| {
                h.count(list.len() as u64);
            });
        }
    }
    h.raw("</dl>");
}

fn head(h: &mut Html, words: &[&str]) {
    h.raw("<thead><tr><th></th><th></th>");
    for word in words {
        h.raw("<th class=\"r\">");
        // Coordinates are called the same in all languages.
        if word.len() == 1 {
            h.raw(word)
        } else {
            h.word(word)
        };
        h.raw("</th>");
    }
    h.raw("</tr></thead><tbody>");
}

fn segments(h: &mut Html, contour: &ContourRecord, first: usize) {
    h.raw("<table class=\"pick segments\">");
    head(h, &["parameter", "uncertainty", "length.title", "rms", "greatest"]);
    for (n, segment) in contour.segments.iter().enumerate() {
        pick_row(h, n, first + n);
        h.raw(&format!("<td>{}</td><td><i class=\"stroke k-{}\"></i>\u{a0}", n + 1, kind(segment)));
        h.word(&format!("segment.{}", kind(segment))).raw("</td><td class=\"r\">");
        known_by(h, segment);
        let u = segment.length_uncertainty;
        h.raw("</td><td class=\"r\">").number(segment.length, decimals(u, 4), false);
        if let Some(u) = u {
            h.raw(" ±\u{a0}");
            small(h, u);
        }
        h.raw("</td>");
        for x in [segment.rms, segment.max] {
            h.raw("<td class=\"r\">");
            small(h, x).raw("</td>");
        }
        h.raw("</tr>");
        if let GeometryRecord::Arc { center, .. } = &segment.geometry {
            of_center(h, *center, segment.uncertainty.as_ref());
        }
    }
    h.raw("</tbody></table>");
    not_printed(h, contour.segments.len());
}

/// Angle, radius or control points with the uncertainty, as two cells but for their rims.
fn known_by(h: &mut Html, segment: &SegmentRecord) {
    let reason = segment.uncertainty_reason.as_deref();
    match (&segment.geometry, &segment.uncertainty) {
        (GeometryRecord::Line { angle }, u) => {
            let u = match u {
                Some(UncertaintyRecord::Line { angle }) => Some(angle.to_degrees()),
                _ => None,
            };
            h.raw("∠\u{a0}").number(angle.to_degrees(), decimals(u, 4), false).raw("°</td><td class=\"r\">");
            uncertain(h, u, reason, "°");
        }
        (GeometryRecord::Arc { radius, .. }, u) => {
            let u = match u {
                Some(UncertaintyRecord::Arc { radius, .. }) => Some(*radius),
                _ => None,
            };
            h.raw("r\u{a0}").number(*radius, decimals(u, 4), false).raw("</td><td class=\"r\">");
            uncertain(h, u, reason, "");
        }
        (GeometryRecord::Spline { control_points, .. }, _) => {
            h.count(control_points.len() as u64).raw("\u{a0}").word("spline.points");
            h.raw("</td><td class=\"r\">");
            uncertain(h, None, reason, "");
        }
    }
}

fn uncertain(h: &mut Html, u: Option<f64>, reason: Option<&str>, unit: &str) {
    match u {
        Some(u) => small(h, u).raw(unit),
        None => h.optional(None, reason, 0, false),
    };
}

/// The row of an arc's center under its own.
fn of_center(h: &mut Html, center: [f64; 2], uncertainty: Option<&UncertaintyRecord>) {
    let u = match uncertainty {
        Some(UncertaintyRecord::Arc { center, .. }) => Some(*center),
        _ => None,
    };
    h.raw("<tr class=\"under\"><td></td><td colspan=\"6\">").word("parameter.center");
    for k in 0..2 {
        h.raw(if k == 0 { " x\u{a0}" } else { " · y\u{a0}" });
        h.number(center[k], decimals(u.map(|u| u[k]), 4), false);
        if let Some(u) = u {
            h.raw("\u{a0}±\u{a0}");
            small(h, u[k]);
        }
    }
    h.raw("</td></tr>");
}

fn joins(h: &mut Html, contour: &ContourRecord, first: usize) {
    h.raw("<table class=\"pick joins\">");
    head(h, &["x", "y", "uncertainty", "interval"]);
    for (n, join) in contour.joins.iter().enumerate() {
        pick_row(h, n, first + n);
        h.raw(&format!("<td>{}</td><td><i class=\"sign {}\"></i>\u{a0}", n + 1, join.continuity));
        h.word(&format!("join.{}", join.continuity)).raw("</td>");
        for x in join.point {
            h.raw("<td class=\"r\">").number(x, decimals(Some(join.std_uncertainty), 4), false).raw("</td>");
        }
        h.raw("<td class=\"r\">");
        small(h, join.std_uncertainty).raw("</td><td class=\"r\">");
        let [a, b] = join.interval;
        h.raw(if join.interval_open.contains(&true) { "≥\u{a0}" } else { "" });
        small(h, libm::hypot(b[0] - a[0], b[1] - a[1])).raw("</td></tr>");
    }
    h.raw("</tbody></table>");
    not_printed(h, contour.joins.len());
}

/// Dimensions that are listed.
const LISTED: usize = 60;

/// Angles, widths, distances of centers, gaps.
pub fn dimensions(h: &mut Html, all: &DimensionsRecord) {
    h.raw("<div class=\"wide\"><table class=\"dimensions\">");
    head(h, &["between", "value", "uncertainty"]);
    for (n, item) in all.items.iter().take(LISTED).enumerate() {
        let angle = item.kind == "angle";
        let shown = |x: f64| if angle { x.to_degrees() } else { x };
        let unit = if angle { "°" } else { "" };
        h.raw(&format!("<tr><td>{}</td><td>", n + 1)).word(&format!("dimension.{}", item.kind));
        let [from, to] = item.of.map(|m| format!("{}.{}", m.contour + 1, m.segment + 1));
        h.raw(&format!("</td><td class=\"r\">{from} – {to}</td><td class=\"r\">"));
        let u = item.std_uncertainty.map(shown);
        h.number(shown(item.value), decimals(u, 4), false).raw(unit).raw("</td><td class=\"r\">");
        uncertain(h, u, item.std_uncertainty_reason.as_deref(), unit);
        h.raw("</td></tr>");
    }
    h.raw("</tbody></table></div><p class=\"note\">").word("dimensions.text");
    if all.count > LISTED as u64 {
        h.raw(" ").word("dimensions.more");
    }
    h.raw("</p>");
}

/// How the points differ from the nominal.
pub fn nominal(h: &mut Html, found: &NominalRecord) {
    h.raw("<p class=\"note\">").text(file_name(&found.path)).raw(": ");
    h.word(&format!("nominal.{}", found.outline)).raw(" · ").word(&format!("nominal.{}", found.positive));
    h.raw("</p>");
    let digits = decimals(found.deviation.all.std_dev, 4);
    by_side(h, &found.deviation, digits);
    h.raw("<dl class=\"facts pairs\">");
    for (reason, count) in &found.excluded {
        fact(h, &format!("nominal.{reason}"), |h| {
            h.count(*count);
        });
    }
    h.raw("</dl>");
}

/// The paper's methods side by side.
pub fn methods(h: &mut Html, methods: &MethodsRecord) {
    h.raw("<div class=\"wide\"><table class=\"methods\">");
    head(h, &["interval", "x", "y", "rms", "rms"]);
    for m in &methods.table {
        let chosen = if m.method == methods.chosen { "●" } else { "" };
        h.raw(&format!("<tr><td>{chosen}</td><td>")).text(&m.method).raw("</td><td class=\"r\">");
        small(h, m.interval_length).raw("</td>");
        for x in m.join {
            h.raw("<td class=\"r\">").number(x, 4, false).raw("</td>");
        }
        for x in [m.line.rms, m.curve.rms] {
            h.raw("<td class=\"r\">");
            small(h, x).raw("</td>");
        }
        h.raw("</tr>");
    }
    h.raw("</tbody></table></div><p class=\"note\">").word("methods.text").raw("</p>");
}

/// The planes that a mesh or cloud was cut by.
pub fn planes(h: &mut Html, planes: &[PlaneRecord]) {
    h.raw("<div class=\"wide\"><table class=\"planes\">");
    head(h, &["distance.title", "contours", "area.mm2"]);
    for (n, plane) in planes.iter().enumerate() {
        let [x, y, z] = plane.normal;
        h.raw(&format!("<tr><td>{}</td><td>", n + 1));
        for (k, x) in [x, y, z].into_iter().enumerate() {
            h.raw(if k > 0 { " " } else { "" }).number(x, if x == x.round() { 0 } else { 4 }, false);
        }
        h.raw("</td><td class=\"r\">").number(plane.offset, 3, false).raw("</td><td class=\"r\">");
        h.count(plane.contours).raw("</td><td class=\"r\">");
        h.optional(plane.area, plane.area_reason.as_deref(), 3, false).raw("</td></tr>");
    }
    h.raw("</tbody></table></div>");
}

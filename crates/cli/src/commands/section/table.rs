//! Sections for people.

use crate::number::{fixed, grouped, scientific};
use crate::{console, read};
use std::fmt::Write;
use trueness_inspect::results::section::{ContourRecord, GeometryRecord, SectionDocument, SegmentRecord};

/// Rows of a contour that are shown.
const ROWS: usize = 60;

/// The document as text.
pub fn table(document: &SectionDocument) -> String {
    let mut out = read::notes(&document.inputs);
    for (n, contour) in document.contours.iter().enumerate() {
        let closed = if contour.closed { "closed" } else { "open" };
        let _ = writeln!(
            out,
            "contour {}   {closed}   {} points   length {}   noise {}   mm and degrees",
            n + 1,
            grouped(contour.points),
            fixed(contour.length, 6),
            scientific(contour.noise, 2)
        );
        out.push_str(&segments(contour));
        if !contour.joins.is_empty() {
            out.push_str(&joins(contour));
        }
        if let Some(reason) = &contour.joins_reason {
            let _ = writeln!(out, "no join: {reason}");
        }
        let odd = [
            ("outliers", &contour.outliers),
            ("repeated points", &contour.repeated),
            ("gaps", &contour.gaps),
        ];
        for (word, list) in odd.into_iter().filter(|(_, list)| !list.is_empty()) {
            let _ = writeln!(out, "{word}: {} (first after point {})", list.len(), list[0]);
        }
    }
    out
}

fn segments(contour: &ContourRecord) -> String {
    let head = ["segment", "kind", "size", "length", "points", "rms", "max"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for (n, segment) in contour.segments.iter().take(ROWS).enumerate() {
        let (kind, size) = known_by(segment);
        rows.push(vec![
            (n + 1).to_string(),
            kind.into(),
            size,
            fixed(segment.length, 6),
            grouped(segment.count),
            scientific(segment.rms, 2),
            scientific(segment.max, 2),
        ]);
    }
    let mut out = console::columns(&rows);
    if contour.segments.len() > ROWS {
        let _ = writeln!(out, "… and {} more", contour.segments.len() - ROWS);
    }
    out
}

fn known_by(segment: &SegmentRecord) -> (&'static str, String) {
    match &segment.geometry {
        GeometryRecord::Line { angle } => ("line", format!("angle {}", fixed(angle.to_degrees(), 4))),
        GeometryRecord::Arc { radius, sweep, .. } => {
            ("arc", format!("r {}, sweep {}", fixed(*radius, 6), fixed(sweep.to_degrees(), 4)))
        }
        GeometryRecord::Spline { control_points, .. } => {
            ("spline", format!("{} control points", control_points.len()))
        }
    }
}

fn joins(contour: &ContourRecord) -> String {
    let head = ["join", "", "x", "y", "± standard uncertainty", "interval"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for (n, join) in contour.joins.iter().take(ROWS).enumerate() {
        let [[a, b], [c, d]] = join.interval;
        let open = if join.interval_open.contains(&true) { " or more" } else { "" };
        let length = ((c - a) * (c - a) + (d - b) * (d - b)).sqrt();
        rows.push(vec![
            (n + 1).to_string(),
            join.continuity.clone(),
            fixed(join.point[0], 6),
            fixed(join.point[1], 6),
            scientific(join.std_uncertainty, 2),
            format!("{}{open}", scientific(length, 2)),
        ]);
    }
    console::columns(&rows)
}

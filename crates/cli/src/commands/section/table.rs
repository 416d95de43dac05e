//! Sections for people.

mod blade;
mod fitted;
mod offers;

use crate::inputs;
use crate::number::{fixed, grouped, scientific};
use crate::{console, noise};
use std::fmt::Write;
use trueness_document::section::{
    AirfoilMeasures, AirfoilRecord, BEYOND_END, ContourRecord, DimensionsRecord, FrameRecord, GeometryRecord,
    MAX_DISTANCE, MethodsRecord, NominalRecord, OutlineRecord, Positive, SectionDocument, SegmentRecord,
};
use trueness_document::section::{DimensionKind, Taken};

/// Rows of a contour that are shown.
const MAX_CONTOUR_ROWS: usize = 60;

/// Contours that are shown.
const MAX_CONTOURS: usize = 40;

/// The document as text.
pub fn table(document: &SectionDocument) -> String {
    let mut out = inputs::notes(&document.inputs);
    out.push_str(&noise::line(document.shared_noise.as_ref()));
    let mut plane = None;
    if document.planes.is_empty() && document.frame.is_in_space() {
        let _ = writeln!(out, "frame     {}", axes(&document.frame));
    }
    for (n, contour) in document.contours.iter().take(MAX_CONTOURS).enumerate() {
        if contour.plane != plane {
            plane = contour.plane;
            out.push_str(&plane_line(document, plane));
        }
        let closed = if contour.closed { "closed" } else { "open" };
        let _ = writeln!(
            out,
            "contour {}   {closed}   {}{} points   length {}   {} {}   mm and degrees",
            n + 1,
            if *contour.taken == Taken::Row { String::new() } else { format!("{}   ", contour.taken.name()) },
            grouped(contour.points),
            fixed(contour.length, 6),
            // Facets of a drawing carry no noise.
            if *contour.taken == Taken::Facets { "rms" } else { "noise" },
            scientific(contour.noise, 2)
        );
        contour.doubts.iter().chain(&contour.hints).for_each(|hint| _ = writeln!(out, "! {hint}"));
        if !contour.astray.is_empty() {
            out.push_str(&astray(contour));
        }
        // Of segments that do not run along the points it tells nothing of the part.
        if let ([[x, y], ..], []) = (&contour.crossings[..], &contour.astray[..]) {
            let often = if contour.crossings.len() > 1 {
                format!(" {} times, first", contour.crossings.len())
            } else {
                String::new()
            };
            let _ = writeln!(
                out,
                "! the contour crosses itself{often} at ({x:.4}, {y:.4}): it has no inside{}",
                if contour.closed { "; look whether its points are in order" } else { "" }
            );
        }
        out.push_str(&segments(contour));
        if !contour.joins.is_empty() {
            out.push_str(&joins(contour));
        }
        if let Some(reason) = &contour.joins_reason {
            let _ = writeln!(out, "no join: {reason}");
        }
        out.push_str(&offers::offers(contour));
        let odd = [
            ("outliers", &contour.outliers),
            ("repeated points", &contour.repeated),
            ("gaps", &contour.gaps),
        ];
        for (word, list) in odd.into_iter().filter(|(_, list)| !list.is_empty()) {
            let _ = writeln!(out, "{word}: {} (first after point {})", list.len(), list[0]);
        }
    }
    if document.contours.len() > MAX_CONTOURS {
        let _ = writeln!(out, "… and {} more contours", document.contours.len() - MAX_CONTOURS);
    }
    out.push_str(&dimensions(&document.dimensions));
    for found in document.airfoils.iter().flatten().take(MAX_CONTOURS) {
        out.push_str(&airfoil(found));
    }
    out.push_str(&document.lean.as_ref().map_or(String::new(), blade::lean));
    if let Some(found) = &document.nominal {
        out.push_str(&nominal(found, document.planes.len() > 1));
    }
    if let Some(methods) = &document.methods {
        out.push_str(&methods_table(methods));
    }
    let empty = document.planes.iter().filter(|p| p.contours == 0).count();
    if empty > 0 {
        let _ = writeln!(out, "planes that meet nothing: {empty} of {}", document.planes.len());
    }
    out
}

/// What is said of segments that do not run along their points: what may help depends on where these come from.
fn astray(contour: &ContourRecord) -> String {
    let (one, all) = (contour.astray.len() == 1, contour.astray.len() == contour.segments.len());
    let (which, run, tell) = match (all, one) {
        (true, true) => ("the segment".into(), "does not run along the points", "tells"),
        (true, false) => ("the segments".into(), "do not run along the points", "tell"),
        (false, true) => (numbered(&contour.astray), "does not run along its points", "tells"),
        (false, false) => (numbered(&contour.astray), "do not run along their points", "tell"),
    };
    let help = match (contour.plane, *contour.taken) {
        (None, _) => "more points around corners and bends, or --noise if it is known, may help",
        (_, Taken::Row) if covers_area(contour) => {
            "points that cover an area follow no curve: a thinner slab, or a plane that cuts less obliquely, may help"
        }
        (_, Taken::Row) => {
            "the points are few for its corners and bends: a thicker slab, or --noise if it is known, may help"
        }
        (_, Taken::Facets | Taken::Scan) => "a plane a little beside, or a finer mesh, may help",
    };
    format!("! {which} {run} and {tell} nothing of the part; {help}\n")
}

/// Whether the points of a cloud scatter about their contour by more than a share of what neighbors are apart. Two points to a side
/// of an octagon scatter by an eighth about a circle, points of an area by a quarter and more. The length of a contour astray tells
/// nothing: it may run far off.
fn covers_area(contour: &ContourRecord) -> bool {
    const MIN_AREA_SCATTER: f64 = 0.2;
    contour.noise > MIN_AREA_SCATTER * contour.spacing
}

/// Numbers of segments from 0 as the table counts them: the first few.
fn numbered(segments: &[u64]) -> String {
    const MAX_LISTED_SEGMENTS: usize = 8;
    let some: Vec<String> = segments.iter().take(MAX_LISTED_SEGMENTS).map(|s| (s + 1).to_string()).collect();
    let more = if segments.len() > MAX_LISTED_SEGMENTS { " …" } else { "" };
    format!("segment{} {}{more}", if segments.len() == 1 { "" } else { "s" }, some.join(", "))
}

/// The paper's table of its methods.
fn methods_table(methods: &MethodsRecord) -> String {
    let head =
        ["method", "interval", "x", "y", "rms of line", "max", "rms of curve", "max", "control points"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for m in &methods.table {
        let chosen = if m.method == methods.chosen { " *" } else { "" };
        rows.push(vec![
            format!("{}{chosen}", m.method),
            fixed(m.interval_length, 6),
            fixed(m.join[0], 6),
            fixed(m.join[1], 6),
            scientific(m.line.rms, 2),
            scientific(m.line.max, 2),
            scientific(m.curve.rms, 2),
            scientific(m.curve.max, 2),
            m.control_points.to_string(),
        ]);
    }
    format!("{}* the contour above; interval of golden: {}\n", console::columns(&rows), methods.interval)
}

/// A line about a plane.
fn plane_line(document: &SectionDocument, number: Option<u64>) -> String {
    let Some((number, plane)) = number.and_then(|n| Some((n, document.planes.get(n as usize)?))) else {
        return String::new();
    };
    let [x, y, z] = plane.normal.map(|n| fixed(n, 6));
    let mut line = format!("plane {}   {x} {y} {z}, {}", number + 1, fixed(plane.offset, 6));
    if let Some(area) = plane.area {
        let _ = write!(line, "   area {}", fixed(area, 6));
    }
    if let Some(gap) = plane.gap {
        let _ = write!(line, "   gap {}", fixed(gap, 4));
    }
    if plane.loose > 0 {
        let _ = write!(line, "   {} points of no contour", grouped(plane.loose));
    }
    let hint = plane.hint.as_ref().map_or(String::new(), |hint| format!("! {hint}\n"));
    format!("{line}\n          {}\n{hint}", axes(&plane.frame))
}

/// Where a plane lies in space.
fn axes(frame: &FrameRecord) -> String {
    let [x, y] = [frame.x, frame.y].map(|a| a.map(|n| fixed(n, 4)).join(" "));
    format!("x along {x}, y along {y}, from {}", frame.origin.map(|n| fixed(n, 6)).join(" "))
}

fn segments(contour: &ContourRecord) -> String {
    let head = ["segment", "kind", "size", "length", "±", "points", "rms", "max"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for (n, segment) in contour.segments.iter().take(MAX_CONTOUR_ROWS).enumerate() {
        let (kind, size) = known_by(segment);
        rows.push(vec![
            (n + 1).to_string(),
            kind.into(),
            size,
            fixed(segment.length, 6),
            segment.length_uncertainty.map_or(String::new(), |u| scientific(u, 2)),
            grouped(segment.count),
            scientific(segment.rms, 2),
            scientific(segment.max, 2),
        ]);
    }
    let mut out = console::columns(&rows);
    if contour.segments.len() > MAX_CONTOUR_ROWS {
        let _ = writeln!(out, "… and {} more", contour.segments.len() - MAX_CONTOUR_ROWS);
    }
    for (n, segment) in contour.segments.iter().take(MAX_CONTOUR_ROWS).enumerate() {
        let Some(arc) = &segment.near_arc else { continue };
        let [x, y] = arc.center.map(|c| fixed(c, 6));
        let _ = writeln!(
            out,
            "segment {} keeps within {} of an arc of r {} at {x} {y}; --noise {} may take it for one",
            n + 1,
            scientific(arc.max, 2),
            fixed(arc.radius, 6),
            two_digits(arc.noise())
        );
    }
    out
}

/// A length above 0 with two digits, as an option takes it.
fn two_digits(x: f64) -> String {
    let places = (1.0 - libm::log10(x).floor()).clamp(0.0, 12.0) as usize;
    format!("{x:.places$}")
}

fn known_by(segment: &SegmentRecord) -> (&'static str, String) {
    match &segment.geometry {
        GeometryRecord::Line { angle } => ("line", format!("angle {}", fixed(angle.to_degrees(), 4))),
        GeometryRecord::Arc { center: [x, y], radius, sweep, .. } => {
            let [radius, x, y] = [*radius, *x, *y].map(|n| fixed(n, 6));
            ("arc", format!("r {radius} at {x} {y}, sweep {}", fixed(sweep.to_degrees(), 4)))
        }
        GeometryRecord::Spline { control_points, .. } => {
            ("spline", format!("{} control points", control_points.len()))
        }
    }
}

fn joins(contour: &ContourRecord) -> String {
    let head = ["join", "", "x", "y", "± standard uncertainty", "interval"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for (n, join) in contour.joins.iter().take(MAX_CONTOUR_ROWS).enumerate() {
        let [[a, b], [c, d]] = join.interval;
        let open = if join.interval_open.contains(&true) { " or more" } else { "" };
        let length = ((c - a) * (c - a) + (d - b) * (d - b)).sqrt();
        rows.push(vec![
            (n + 1).to_string(),
            join.continuity.to_string(),
            fixed(join.point[0], 6),
            fixed(join.point[1], 6),
            scientific(join.std_uncertainty, 2),
            format!("{}{open}", scientific(length, 2)),
        ]);
    }
    console::columns(&rows)
}

/// Angles, widths, distances of centers, gaps.
fn dimensions(all: &DimensionsRecord) -> String {
    if all.count == 0 {
        return String::new();
    }
    let mut rows =
        vec![["dimension", "between", "and", "value", "± standard uncertainty"].map(String::from).to_vec()];
    for item in all.items.iter().take(MAX_CONTOUR_ROWS) {
        let angle = *item.kind == DimensionKind::Angle;
        let shown = |x: f64| if angle { x.to_degrees() } else { x };
        let [from, to] = item.of.map(|m| format!("{}.{}", m.contour + 1, m.segment + 1));
        rows.push(vec![
            item.kind.to_string(),
            from,
            to,
            format!("{}{}", fixed(shown(item.value), 6), if angle { "°" } else { "" }),
            item.std_uncertainty.map_or(String::new(), |u| scientific(shown(u), 2)),
        ]);
    }
    let mut out = console::columns(&rows);
    if all.count > MAX_CONTOUR_ROWS as u64 {
        let _ = writeln!(out, "… and {} more", all.count - MAX_CONTOUR_ROWS as u64);
    }
    out
}

/// A contour as an airfoil.
fn airfoil(found: &AirfoilRecord) -> String {
    let Some(m) = &found.measures else {
        let reason = found.measures_reason.as_deref().unwrap_or_default();
        return format!("airfoil of contour {}: not measured: {reason}\n", found.contour + 1);
    };
    let head = [format!("airfoil of contour {}", found.contour + 1), "value".into()];
    let rest = ["± standard uncertainty", "at share of chord", "x", "y"].map(String::from);
    let mut rows = vec![head.into_iter().chain(rest).collect::<Vec<_>>()];
    let mut row = |name: &str, value: String, u: Option<f64>, at: Option<f64>, place: Option<[f64; 2]>| {
        let place = place.map_or([String::new(), String::new()], |p| p.map(|x| fixed(x, 6)));
        let u = u.map_or(String::new(), |u| scientific(u, 2));
        let at = at.map_or(String::new(), |s| fixed(s, 4));
        rows.push([name.into(), value, u, at].into_iter().chain(place).collect());
    };
    let angle = format!("{}°", fixed(m.chord_angle.to_degrees(), 4));
    row("chord", fixed(m.chord, 6), None, None, None);
    row("angle of chord", angle, None, None, None);
    let (u, center) = (Some(m.thickness_uncertainty), Some(m.thickness_center));
    row("greatest thickness", fixed(m.thickness, 6), u, Some(m.thickness_at), center);
    row("greatest camber", fixed(m.camber, 6), None, Some(m.camber_at), None);
    let radius = |r: Option<f64>| r.map_or("–".into(), |r| fixed(r, 6));
    let u = m.leading_radius_uncertainty;
    row("leading radius", radius(m.leading_radius), u, None, Some(m.leading_edge));
    let (name, value) = trailing(m);
    row(&name, value, m.trailing_radius_uncertainty, None, Some(m.trailing_edge));
    let mut out = console::columns(&rows);
    for reason in m.leading_radius_reason.iter().chain(&m.trailing_radius_reason) {
        let _ = writeln!(out, "no radius: {reason}");
    }
    out + &blade::chords(m)
}

/// The row of a trailing edge: its radius, or how thick it is.
fn trailing(m: &AirfoilMeasures) -> (String, String) {
    match (m.trailing_radius, m.trailing_thickness) {
        (Some(radius), _) => ("trailing radius".into(), fixed(radius, 6)),
        (None, Some(gap)) => (format!("trailing edge, {}", m.trailing_kind), fixed(gap, 6)),
        (None, None) => (format!("trailing edge, {}", m.trailing_kind), "–".into()),
    }
}

/// How the points differ from the nominal, and what of it was not measured; `several` planes have numbers.
fn nominal(found: &NominalRecord, several: bool) -> String {
    let side = match *found.positive {
        Positive::Outside => "+ outside",
        Positive::Left => "+ left of the nominal",
        Positive::Both => "+ outside of its closed contours, + left of its open ones",
    };
    let mut out = format!("deviation from {} ({}), {side}\n", found.path, found.outline);
    out.push_str(&fitted::fits(&found.fits, several));
    let mut rows =
        vec![["", "points", "least", "greatest", "mean", "std dev", "rms"].map(String::from).to_vec()];
    let d = &found.deviation;
    for (name, s) in [("all", &d.all), ("+", &d.positive), ("−", &d.negative)] {
        let shown = |x: Option<f64>| x.map_or("–".into(), |x| fixed(x, 6));
        let all = [s.min, s.max, s.mean, s.std_dev, s.rms].map(shown);
        rows.push([name.into(), grouped(s.count)].into_iter().chain(all).collect());
    }
    out.push_str(&console::columns(&rows));
    for (reason, count) in &found.excluded {
        let words = match &reason[..] {
            BEYOND_END => "beyond the end of the nominal",
            MAX_DISTANCE => "farther than --max-distance",
            _ => "in planes without nominal",
        };
        let _ = writeln!(out, "points {words}: {}", grouped(*count));
    }
    found.warnings.iter().for_each(|warning| _ = writeln!(out, "! {}", warning.text));
    out.push_str(&lacking(&found.outlines, several));
    out.push_str(&fitted::verdict(found));
    out
}

/// Outlines of the nominal that are named where they were not measured.
const MAX_NAMED_OUTLINES: usize = 20;

/// The outlines of the nominal that were not measured, or not as a whole.
fn lacking(outlines: &[OutlineRecord], several: bool) -> String {
    let mut out = String::new();
    let all = outlines.iter().enumerate().filter(|(_, outline)| outline.lacks());
    for (n, outline) in all.clone().take(MAX_NAMED_OUTLINES) {
        let plane =
            outline.plane.filter(|_| several).map_or(String::new(), |n| format!(" in plane {}", n + 1));
        let how = match outline.covered {
            0.0 => "not measured".into(),
            covered => format!("measured over {:.0} % of its length", 100.0 * covered),
        };
        let what = if outline.hole { "a hole of about" } else { "about" };
        let [[width, height], [x, y]] = [outline.size, outline.center].map(|p| p.map(|x| fixed(x, 3)));
        let _ = writeln!(
            out,
            "! contour {}{plane} of the nominal was {how} ({what} {width} × {height} at {x} {y})",
            n + 1
        );
    }
    let more = all.count().saturating_sub(MAX_NAMED_OUTLINES);
    if more > 0 {
        let _ = writeln!(out, "… and {more} more contours of the nominal that were not measured as a whole");
    }
    out
}

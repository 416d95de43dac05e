//! Surfaces for people.

use crate::console;
use crate::inputs;
use crate::number::{POINTS, counted, fixed, grouped, scientific};
use std::fmt::Write;
use trueness_document::curvature::Range;
use trueness_document::surface::Reached;
use trueness_document::surface::{BaseRecord, SurfaceDocument};

/// The document as text.
pub fn table(document: &SurfaceDocument) -> String {
    let mut out = inputs::notes(&document.inputs);
    document.warnings.iter().for_each(|w| {
        let _ = writeln!(out, "! {w}");
    });
    let [p, q] = document.degree;
    let (m, n) = (document.control_points.len(), document.control_points.first().map_or(0, Vec::len));
    let _ = writeln!(
        out,
        "degree {p}x{q}   control points {m}x{n}   base {}{}   {}   mm",
        document.base.kind,
        moved(&document.base),
        counted(document.deviation.count, POINTS)
    );
    let range = |knots: &[f64]| {
        let [first, last] =
            [knots.first(), knots.last()].map(|k| k.map_or_else(String::new, |k| fixed(*k, 4)));
        format!("{first} to {last}")
    };
    let _ = writeln!(out, "parameters u {}   v {}", range(&document.knots.u), range(&document.knots.v));
    let freedom = document.degrees_of_freedom.map(|d| format!(", {} degrees of freedom", fixed(d, 1)));
    let _ = writeln!(
        out,
        "fairness {} ({}{})   corrections {}   without support {} %",
        scientific(document.fairness, 2),
        document.fairness_from,
        freedom.unwrap_or_default(),
        document.corrections,
        fixed(100.0 * document.unsupported_share, 1)
    );
    let deviation = &document.deviation;
    let shown = |x: Option<f64>| x.map_or_else(|| "-".to_string(), |x| fixed(x, 6));
    let [low, high] = [deviation.percentiles.p2_5, deviation.percentiles.p97_5].map(shown);
    let rows = [
        ["deviation", "min", "max", "mean", "rms", "2.5 %", "97.5 %"].map(String::from),
        [
            "".into(),
            shown(deviation.min),
            shown(deviation.max),
            shown(deviation.mean),
            shown(deviation.rms),
            low,
            high,
        ],
    ];
    out.push_str(&console::columns(&rows.map(Vec::from)));
    let [x, y, z] = document.worst.position.map(|x| fixed(x, 4));
    let _ = writeln!(
        out,
        "farthest is point {} at {x}  {y}  {z}: {}",
        document.worst.point,
        fixed(document.worst.deviation, 6)
    );
    if let Some(trim) = &document.trim {
        let holes: usize = trim.regions.iter().map(|region| region.holes.len()).sum();
        let _ = writeln!(
            out,
            "cut along the outline of the points: {} % of the rectangle, {}, {}; gaps up to {} mm do not count{}",
            fixed(100.0 * trim.share, 1),
            counted(trim.regions.len() as u64, ["part", "parts"]),
            counted(holes as u64, ["hole", "holes"]),
            fixed(2.0 * trim.reach, 4),
            match trim.left_out {
                0 => String::new(),
                n => format!("; {} of small parts left out", counted(n, POINTS)),
            }
        );
    }
    out.push_str(&excluded(document));
    if let Some(tolerance) = &document.tolerance {
        let all =
            if document.outliers + document.beyond_border > 0 { "all other points" } else { "all points" };
        let _ = writeln!(out, "{}", reached(tolerance.value, tolerance.outside, *tolerance.stopped_by, all));
    }
    out.push_str(&curvature(document));
    out
}

/// Points that no number counts.
fn excluded(document: &SurfaceDocument) -> String {
    let mut out = String::new();
    if document.outliers > 0 {
        let _ = writeln!(out, "{} left out", counted(document.outliers, ["outlier", "outliers"]));
    }
    if document.beyond_border > 0 {
        let _ = writeln!(out, "excluded {} (beyond the border)", counted(document.beyond_border, POINTS));
    }
    out
}

/// How far the base is tilted, facets are stretched, and the rectangle of the parameters turned, where they are.
fn moved(base: &BaseRecord) -> String {
    let by = |angle: f64, how: [&str; 2]| match angle {
        0.0 => String::new(),
        angle => format!(", {} by {}° {}", how[0], fixed(angle.to_degrees(), 2), how[1]),
    };
    let tilted =
        by(base.tilted, ["tilted", "from the least-squares plane, over which it folds or stands on edge"]);
    let stretch = base.stretch.map(|[least, most]| {
        format!(", laid flat: lengths {} to {} of what they are", fixed(least, 3), fixed(most, 3))
    });
    tilted + &by(base.turned, ["turned", "along what bends"]) + &stretch.unwrap_or_default()
}

fn reached(value: f64, outside: u64, stopped_by: Reached, all: &str) -> String {
    let why = match stopped_by {
        Reached::Noise => "more knots would follow the noise of the points",
        Reached::Points => "there are too few points for more knots",
        Reached::Memory => "more knots would take more memory than allowed",
        Reached::Tolerance => return format!("tolerance {value}: reached, {all} are within"),
    };
    format!("tolerance {value}: not reached, {} beyond it; {why}", counted(outside, POINTS))
}

fn curvature(document: &SurfaceDocument) -> String {
    let found = &document.curvature;
    let mut rows = vec![["curvature", "min", "median", "max"].map(String::from).to_vec()];
    let all: [(&str, &Option<Range>); 4] =
        [("k1", &found.k1), ("k2", &found.k2), ("mean", &found.mean), ("gaussian", &found.gaussian)];
    for (name, range) in all {
        let Some(range) = range else { continue };
        rows.push(vec![
            name.into(),
            scientific(range.min, 4),
            scientific(range.median, 4),
            scientific(range.max, 4),
        ]);
    }
    let mut out = console::columns(&rows);
    if let Some(reason) = &found.reason {
        let _ = writeln!(out, "{} places with curvature: {reason}", grouped(found.count));
    }
    out
}

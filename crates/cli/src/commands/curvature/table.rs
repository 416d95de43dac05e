//! Curvatures for people.

use crate::inputs;
use crate::number::{POINTS, VERTICES, counted, fixed, grouped, scientific, six_digits};
use crate::{console, noise};
use std::fmt::Write;
use trueness_document::curvature::CurvatureKind;
use trueness_document::curvature::{CurvatureDocument, CurvaturePlace, Neighborhood, PlaceKind, Range};

/// The document as text.
pub fn table(document: &CurvatureDocument) -> String {
    let mut out = inputs::notes(&document.inputs);
    let what = match *document.places {
        PlaceKind::Vertices => VERTICES,
        PlaceKind::Points => POINTS,
    };
    let around = match document.neighborhood {
        Neighborhood::Count { neighbors } => format!("at least {} neighbors", grouped(neighbors)),
        Neighborhood::Radius { radius } => format!("all within {radius} mm"),
    };
    let _ = writeln!(
        out,
        "{} of {} with curvatures   degree {}   {around}   mm",
        grouped(document.count),
        counted(document.total, what),
        document.degree
    );
    let shown = |x: Option<f64>| x.map_or_else(|| "-".to_string(), six_digits);
    let mut rows =
        vec![["curvature", "min", "2.5 %", "median", "mean", "97.5 %", "max"].map(String::from).to_vec()];
    for (name, kind) in [
        ("k1", CurvatureKind::K1),
        ("k2", CurvatureKind::K2),
        ("mean", CurvatureKind::Mean),
        ("gaussian", CurvatureKind::Gaussian),
    ] {
        let s = &document.quantity(kind).statistics;
        let p = &s.percentiles;
        let all = [s.min, p.p2_5, s.median, s.mean, p.p97_5, s.max];
        rows.push([vec![name.to_string()], all.map(shown).to_vec()].concat());
    }
    out.push_str(&console::columns(&rows));
    for (name, place) in [("greatest k1", &document.k1.maximum), ("least k2", &document.k2.minimum)] {
        let _ = writeln!(out, "{}", at(name, place));
    }
    for (name, range, unit) in [
        ("uncertainty of mean", &document.uncertainty, "1/mm"),
        ("residual", &document.residual, "mm"),
        ("condition", &document.condition, ""),
    ] {
        let _ = writeln!(out, "{}", spread(name, range, unit));
    }
    out.push_str(&noise::line(document.shared_noise.as_ref()));
    for (reason, count) in &document.without {
        let _ =
            writeln!(out, "! {} without a value: {}", counted(*count, what), reason.name().replace('_', " "));
    }
    out.push_str("positive where the surface bends towards its normal; normals by the ");
    match document.parts {
        0 => out.push_str("facets\n"),
        1 => out.push_str("neighbors, one part\n"),
        n => {
            let _ = writeln!(out, "neighbors, {} parts", grouped(n));
        }
    }
    out
}

fn at(name: &str, place: &CurvaturePlace) -> String {
    let value = if name.ends_with("k1") { place.bend.k1 } else { place.bend.k2 };
    let [x, y, z] = place.position.map(|x| fixed(x, 4));
    format!("{name} is at {} ({x}  {y}  {z}): {}", place.index, six_digits(value))
}

fn spread(name: &str, range: &Range, unit: &str) -> String {
    format!("{name}: median {}, at most {} {unit}", scientific(range.median, 2), scientific(range.max, 2))
        .trim_end()
        .to_string()
}

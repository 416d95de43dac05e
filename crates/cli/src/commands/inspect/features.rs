//! The features of a part as a table: place and size as measured, beside the nominal ones.

use crate::layout;
use crate::number::{fixed, grouped, short_signed};
use trueness_document::inspect::{FeatureRecord, MeasuredPlace};

/// Two rows a feature: measured, and what that is off the nominal.
pub fn table(features: &[FeatureRecord]) -> String {
    let head = ["feature", "shape", "", "points", "x", "y", "z", "size", "form"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for f in features {
        let own = f.measured.as_ref();
        let mut row = vec![f.id.clone(), f.shape.to_string(), "measured".into(), grouped(f.points)];
        row.extend(numbers(own));
        row.push(f.form_error.map_or_else(|| "–".into(), |x| fixed(x, 4)));
        rows.push(row);
        if let Some(nominal) = &f.nominal {
            let mut row = vec![String::new(), String::new(), "nominal".into(), String::new()];
            row.extend(numbers(Some(nominal)));
            row.push(String::new());
            rows.push(row);
        }
        if let Some((measured, nominal)) = own.zip(f.nominal.as_ref()) {
            let mut row = vec![String::new(), String::new(), "off".into(), String::new()];
            row.extend((0..3).map(|k| short_signed(rounded(measured.place[k] - nominal.place[k]))));
            let off = size(measured).zip(size(nominal)).map(|(a, b)| short_signed(a - b));
            row.extend([off.unwrap_or_default(), String::new()]);
            rows.push(row);
        }
    }
    if rows.len() > 1 { layout::table(&rows, 3) } else { String::new() }
}

/// What rounding leaves of a difference of places is none.
fn rounded(x: f64) -> f64 {
    if x.abs() < 1e-9 { 0.0 } else { x }
}

fn size(p: &MeasuredPlace) -> Option<f64> {
    p.diameter.or(p.angle)
}

fn numbers(p: Option<&MeasuredPlace>) -> Vec<String> {
    let Some(p) = p else { return vec!["–".into(); 4] };
    let mut all: Vec<String> = p.place.iter().map(|x| fixed(*x, 4)).collect();
    all.push(match (p.diameter, p.angle) {
        (Some(d), _) => format!("∅{}", fixed(d, 4)),
        (None, Some(a)) => format!("{}°", fixed(a, 4)),
        _ => String::new(),
    });
    all
}

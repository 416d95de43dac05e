//! General tolerances: ISO 2768-1:1989 for linear and angular dimensions, ISO 2768-2:1989 for forms and attitudes.
//!
//! ISO 2768-2 was withdrawn for ISO 22081:2021, which has no tables; drawings that name it keep their meaning. A class may be
//! written as on drawings for both parts: `mK`.

use super::error::ClassError;

/// Ends of ranges, and for each class a value for each range.
type Table<const RANGES: usize, const CLASSES: usize, T> =
    ([f64; RANGES], [(&'static str, [T; RANGES]); CLASSES]);

/// Ends of the lengths of linear dimensions, millimeters, and their limit deviations by class.
const LINEAR: Table<8, 4, Option<f64>> = (
    [3.0, 6.0, 30.0, 120.0, 400.0, 1000.0, 2000.0, 4000.0],
    [
        ("f", [Some(0.05), Some(0.05), Some(0.1), Some(0.15), Some(0.2), Some(0.3), Some(0.5), None]),
        ("m", [Some(0.1), Some(0.1), Some(0.2), Some(0.3), Some(0.5), Some(0.8), Some(1.2), Some(2.0)]),
        ("c", [Some(0.2), Some(0.3), Some(0.5), Some(0.8), Some(1.2), Some(2.0), Some(3.0), Some(4.0)]),
        ("v", [None, Some(0.5), Some(1.0), Some(1.5), Some(2.5), Some(4.0), Some(6.0), Some(8.0)]),
    ],
);

/// The same of external radii and heights of chamfers.
const RADII: Table<3, 4, f64> = (
    [3.0, 6.0, f64::INFINITY],
    [("f", [0.2, 0.5, 1.0]), ("m", [0.2, 0.5, 1.0]), ("c", [0.4, 1.0, 2.0]), ("v", [0.4, 1.0, 2.0])],
);

/// The same of angles: ends of the length of the shorter leg, and minutes of arc.
const ANGULAR: Table<5, 4, f64> = (
    [10.0, 50.0, 120.0, 400.0, f64::INFINITY],
    [
        ("f", [60.0, 30.0, 20.0, 10.0, 5.0]),
        ("m", [60.0, 30.0, 20.0, 10.0, 5.0]),
        ("c", [90.0, 60.0, 30.0, 15.0, 10.0]),
        ("v", [180.0, 120.0, 60.0, 30.0, 20.0]),
    ],
);

const FORM: Table<6, 3, f64> = (
    [10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0],
    [
        ("H", [0.02, 0.05, 0.1, 0.2, 0.3, 0.4]),
        ("K", [0.05, 0.1, 0.2, 0.4, 0.6, 0.8]),
        ("L", [0.1, 0.2, 0.4, 0.8, 1.2, 1.6]),
    ],
);

/// Ends of the lengths of perpendicular and of symmetric features.
const LONG: [f64; 4] = [100.0, 300.0, 1000.0, 3000.0];
const PERPENDICULARITY: [(&str, [f64; 4]); 3] =
    [("H", [0.2, 0.3, 0.4, 0.5]), ("K", [0.4, 0.6, 0.8, 1.0]), ("L", [0.6, 1.0, 1.5, 2.0])];
const SYMMETRY: [(&str, [f64; 4]); 3] =
    [("H", [0.5, 0.5, 0.5, 0.5]), ("K", [0.6, 0.6, 0.8, 1.0]), ("L", [0.6, 1.0, 1.5, 2.0])];
const RUNOUT: [(&str, [f64; 1]); 3] = [("H", [0.1]), ("K", [0.2]), ("L", [0.5])];

const GEOMETRY: &str = "H, K, L of ISO 2768-2";
const DIMENSIONS: &str = "f, m, c, v of ISO 2768-1";

/// The letter of the part of the standard that is asked for: `mK` has one of each.
fn letter(class: &str, geometry: bool) -> &str {
    let both =
        class.len() == 2 && class.starts_with(['f', 'm', 'c', 'v']) && class.ends_with(['H', 'K', 'L']);
    match (both, geometry) {
        (false, _) => class,
        (true, true) => &class[1..],
        (true, false) => &class[..1],
    }
}

fn row<'a, V>(
    class: &str,
    geometry: bool,
    rows: &'a [(&str, V)],
    known: &'static str,
) -> Result<&'a V, ClassError> {
    let wanted = letter(class, geometry);
    let found = rows.iter().find(|(letter, _)| *letter == wanted);
    found.map(|(_, v)| v).ok_or_else(|| ClassError::Unknown { class: class.into(), known })
}

fn at(class: &str, ends: &[f64], least: f64, length: f64, range: &'static str) -> Result<usize, ClassError> {
    let place = ends.iter().position(|end| length <= *end).filter(|_| length >= least && length > 0.0);
    place.ok_or_else(|| ClassError::Range { class: class.into(), length, range })
}

pub(super) fn linear(class: &str, nominal: f64, known: &'static str) -> Result<[f64; 2], ClassError> {
    let values = row(class, false, &LINEAR.1, known)?;
    const RANGE: &str = "0.5 to 4000 mm; f up to 2000 mm, v above 3 mm";
    let place = at(class, &LINEAR.0, 0.5, nominal, RANGE)?;
    let value =
        values[place].ok_or_else(|| ClassError::Range { class: class.into(), length: nominal, range: RANGE });
    value.map(|t| [-t, t])
}

pub(super) fn radius(class: &str, nominal: f64) -> Result<[f64; 2], ClassError> {
    let values = row(class, false, &RADII.1, DIMENSIONS)?;
    let t = values[at(class, &RADII.0, 0.5, nominal, "radii from 0.5 mm")?];
    Ok([-t, t])
}

/// In degrees.
pub(super) fn angular(class: &str, leg: f64) -> Result<[f64; 2], ClassError> {
    let values = row(class, false, &ANGULAR.1, DIMENSIONS)?;
    let t = values[at(class, &ANGULAR.0, 0.0, leg, "above 0 mm")?] / 60.0;
    Ok([-t, t])
}

pub(super) fn form(class: &str, length: f64) -> Result<[f64; 2], ClassError> {
    let values = row(class, true, &FORM.1, GEOMETRY)?;
    Ok([0.0, values[at(class, &FORM.0, 0.0, length, "above 0 up to 3000 mm")?]])
}

pub(super) fn perpendicularity(class: &str, length: f64) -> Result<[f64; 2], ClassError> {
    let values = row(class, true, &PERPENDICULARITY, GEOMETRY)?;
    Ok([0.0, values[at(class, &LONG, 0.0, length, "above 0 up to 3000 mm")?]])
}

pub(super) fn symmetry(class: &str, length: f64) -> Result<[f64; 2], ClassError> {
    let values = row(class, true, &SYMMETRY, GEOMETRY)?;
    Ok([0.0, values[at(class, &LONG, 0.0, length, "above 0 up to 3000 mm")?]])
}

pub(super) fn runout(class: &str) -> Result<[f64; 2], ClassError> {
    let [t] = row(class, true, &RUNOUT, GEOMETRY)?;
    Ok([0.0, *t])
}

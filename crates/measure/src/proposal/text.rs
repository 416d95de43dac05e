//! Numbers and names in the text of plans.

use std::fmt::Write;

/// Share of a number, and of 1, by which the single precision of meshes moves what is found from them.
const SINGLE_PRECISION_SHARE: f64 = 4.0 * f32::EPSILON as f64;

/// A number without the rounding of single precision that meshes come with: to three digits after the point where that is all that it changes,
/// else to six.
pub(super) fn number_text(x: f64) -> String {
    let to = |scale: f64| (x * scale).round() / scale;
    let rounded =
        if (to(1e3) - x).abs() <= SINGLE_PRECISION_SHARE * x.abs().max(4.0) { to(1e3) } else { to(1e6) };
    // TOML has floats with a point; minus zero is zero.
    format!("{:?}", rounded + 0.0)
}

pub(super) fn vector(v: [f64; 3]) -> String {
    format!("[{}]", v.map(number_text).join(", "))
}

/// A string of TOML.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// Digits of tolerances and dimensions that are written: the conversion of units leaves the last ones wrong.
const WRITTEN_DIGITS: usize = 12;

/// A number of a file's tolerances, without the rounding of its unit.
pub(super) fn decimal(x: f64) -> String {
    let rounded = format!("{x:.*e}", WRITTEN_DIGITS - 1).parse().unwrap_or(x);
    format!("{:?}", rounded + 0.0)
}

/// A text as a comment of one line.
pub(super) fn comment(text: &str) -> String {
    let plain = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    format!("# {}\n", plain.collect::<String>())
}

/// Things one after the other.
pub(super) fn listed<T: ToString>(all: &[T]) -> String {
    all.iter().map(ToString::to_string).collect::<Vec<String>>().join(", ")
}

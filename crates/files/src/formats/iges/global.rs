//! What the global section says.

use crate::error::{Fault, Result};
use crate::number::{integer, whole_number};

/// Parameters of the global section that are used.
pub(super) struct Global {
    /// The name of the model, as its program knows it.
    pub name: String,
    /// Millimeters in the unit of the model, where it says one.
    pub millimeters: Option<f64>,
    /// The least distance that tells two places apart, in this unit.
    pub resolution: Option<f64>,
}

impl Global {
    /// Reads the parameters.
    ///
    /// # Errors
    /// A scale, a unit that is not known.
    pub fn of(words: &[Vec<u8>]) -> Result<Global> {
        let word = |k: usize| words.get(k - 1).map_or(&b""[..], |w| w);
        let scale = if word(13).is_empty() { Some(1.0) } else { whole_number(word(13), b'.') };
        if scale != Some(1.0) {
            let what = "the model is drawn to a scale, which is not read".into();
            return Err(Fault::Unsupported { what, remedy: "export it in its own size" }.into());
        }
        let text = |k: usize| String::from_utf8_lossy(word(k)).trim().to_string();
        let name = [3, 4].map(text).into_iter().find(|name| !name.is_empty()).unwrap_or_default();
        let resolution = whole_number(word(19), b'.').filter(|r| *r > 0.0 && r.is_finite());
        Ok(Global { name, millimeters: millimeters(word(14), &text(15).to_ascii_uppercase())?, resolution })
    }
}

/// Millimeters in a unit by its number, or by its name where the number is 3.
fn millimeters(flag: &[u8], name: &str) -> Result<Option<f64>> {
    Ok(Some(match (integer(flag), name) {
        (None, "") if flag.is_empty() => return Ok(None),
        (Some(1), _) | (Some(3), "IN" | "INCH") => 25.4,
        (Some(2), _) | (Some(3), "MM") => 1.0,
        (Some(4), _) | (Some(3), "FT") => 304.8,
        (Some(5), _) | (Some(3), "MI") => 1_609_344.0,
        (Some(6), _) | (Some(3), "M") => 1000.0,
        (Some(7), _) | (Some(3), "KM") => 1e6,
        (Some(8), _) | (Some(3), "MIL") => 0.0254,
        (Some(9), _) | (Some(3), "UM") => 1e-3,
        (Some(10), _) | (Some(3), "CM") => 10.0,
        (Some(11), _) | (Some(3), "UIN") => 25.4e-6,
        _ => {
            let what = "the unit of the model is none that IGES has (inch, mm, foot, mile, m, km, mil, µm, cm, µinch)".into();
            return Err(Fault::Unsupported { what, remedy: "export it in millimeters" }.into());
        }
    }))
}

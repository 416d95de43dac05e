//! The text of a tolerance: `T` for ±T, or `-L,+U`.

use std::str::FromStr;
use trueness_document::tolerance::Tolerance;

/// A tolerance as it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToleranceText(pub Tolerance);

/// A text that is no tolerance.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoTolerance {
    /// A part of it is no number.
    #[error("‘{text}’ is not a number; write 0.1 for ±0.1, or -0.1,+0.2")]
    Number {
        /// That part.
        text: String,
    },
    /// It can be meant in several ways.
    #[error("{}", both_readings(.text, *.limits))]
    Ambiguous {
        /// As written.
        text: String,
        /// Its two numbers.
        limits: (f64, f64),
    },
    /// A single number that is not above 0.
    #[error("{tolerance} leaves no zone; a single number T means ±T and must be above 0")]
    NoZone {
        /// That number.
        tolerance: f64,
    },
    /// The limits are not in their order.
    #[error("the lower limit {lower} must be below the upper limit {upper}")]
    Reversed {
        /// The first.
        lower: f64,
        /// The second.
        upper: f64,
    },
}

impl FromStr for ToleranceText {
    type Err = NoTolerance;

    fn from_str(text: &str) -> Result<Self, NoTolerance> {
        let number = |t: &str| match t.trim().parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(NoTolerance::Number { text: t.into() }),
        };
        let (lower, upper) = match text.split_once(',') {
            Some((lower, upper)) => {
                let limits = (number(lower)?, number(upper)?);
                if !is_clear(lower, upper) {
                    return Err(NoTolerance::Ambiguous { text: text.into(), limits });
                }
                limits
            }
            None => {
                let t = number(text)?;
                if t <= 0.0 {
                    return Err(NoTolerance::NoZone { tolerance: t });
                }
                (-t, t)
            }
        };
        if lower >= upper {
            return Err(NoTolerance::Reversed { lower, upper });
        }
        Ok(ToleranceText(Tolerance { lower, upper }))
    }
}

/// Whether two limits can be meant in one way only: both have signs, or one has (the other being 0, or the whole no
/// number with a decimal comma).
fn is_clear(lower: &str, upper: &str) -> bool {
    let signed = |t: &str| t.trim().starts_with(['+', '-']);
    let zero = |t: &str| t.trim() == "0";
    let decimal_comma = || format!("{lower}.{upper}").trim().parse::<f64>().is_ok();
    match (signed(lower), signed(upper)) {
        (true, true) => true,
        (true, false) => zero(upper) || !decimal_comma(),
        (false, true) => zero(lower),
        (false, false) => false,
    }
}

/// What a text without signs can mean, each as it should be written.
fn both_readings(text: &str, (lower, upper): (f64, f64)) -> String {
    if lower >= upper {
        return format!("‘{text}’: the lower limit comes first: write {upper:+},{lower:+}");
    }
    let zone = format!("{lower:+},{upper:+}");
    let number = text.replacen(',', ".", 1);
    match number.trim().parse::<f64>() {
        Ok(t) if t.is_finite() && t != 0.0 => format!(
            "‘{text}’ can mean two things: write {} for ±{} mm, or {zone} for the zone from {lower} to {upper} mm",
            t.abs(),
            t.abs()
        ),
        _ => {
            let around = if lower > 0.0 {
                format!(", or {:+},{upper:+} for that from −{lower} to {upper} mm", -lower)
            } else {
                String::new()
            };
            format!(
                "‘{text}’ is a zone without signs: write {zone} for the zone from {lower} to {upper} mm{around}"
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_both_forms() {
        for (text, lower, upper) in [
            ("0.1", -0.1, 0.1),
            ("-0.1,+0.2", -0.1, 0.2),
            ("0,+0.5", 0.0, 0.5),
            ("-0.5,0", -0.5, 0.0),
            ("-0.2,0.6", -0.2, 0.6),
            ("+0.1,+0.2", 0.1, 0.2),
            ("-0.2,-0.1", -0.2, -0.1),
        ] {
            assert_eq!(text.parse(), Ok(ToleranceText(Tolerance { lower, upper })), "{text}");
        }
    }

    #[test]
    fn limits_without_signs_are_refused_with_both_readings() {
        for (text, number, zone) in [
            ("0,1", "0.1", "+0,+1"),
            ("0,05", "0.05", "+0,+5"),
            ("-1,5", "1.5", "-1,+5"),
            ("0.1,0.2", "", "+0.1,+0.2"),
        ] {
            let said = text.parse::<ToleranceText>().unwrap_err().to_string();
            assert!(said.contains(number) && said.contains(zone), "{text}: {said}");
            assert!(zone.parse::<ToleranceText>().is_ok(), "{zone}");
            assert_eq!(text == "0.1,0.2", said.contains("-0.1,+0.2"), "{text}: {said}");
        }
    }

    #[test]
    fn refuses_what_has_no_zone() {
        for text in ["0", "-1", "nan", "inf", "a", "0.2,0.1", "1,1", "", "0.1,"] {
            assert!(text.parse::<ToleranceText>().is_err(), "{text}");
        }
    }
}

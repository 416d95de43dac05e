//! The words of `--tolerance`: `T` for ±T, or `-L,+U`.

use std::str::FromStr;
use trueness_inspect::tolerance::Tolerance;

/// A tolerance as written on the command line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToleranceArg(pub Tolerance);

impl FromStr for ToleranceArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |t: &str| match t.trim().parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(format!("‘{t}’ is not a number; write 0.1 for ±0.1, or -0.1,+0.2")),
        };
        let (lower, upper) = match text.split_once(',') {
            Some((lower, upper)) => (number(lower)?, number(upper)?),
            None => {
                let t = number(text)?;
                if t <= 0.0 {
                    return Err(format!(
                        "{t} leaves no zone; a single number T means ±T and must be above 0"
                    ));
                }
                (-t, t)
            }
        };
        if lower >= upper {
            return Err(format!("the lower limit {lower} must be below the upper limit {upper}"));
        }
        Ok(ToleranceArg(Tolerance { lower, upper }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_both_forms() {
        for (text, lower, upper) in [("0.1", -0.1, 0.1), ("-0.1,+0.2", -0.1, 0.2), ("0,0.5", 0.0, 0.5)] {
            assert_eq!(text.parse(), Ok(ToleranceArg(Tolerance { lower, upper })), "{text}");
        }
    }

    #[test]
    fn refuses_what_has_no_zone() {
        for text in ["0", "-1", "nan", "inf", "a", "0.2,0.1", "1,1", "", "0.1,"] {
            assert!(text.parse::<ToleranceArg>().is_err(), "{text}");
        }
    }
}

//! The words of `--outliers` and `--coverage`, and the angle of `--facing`.

use std::str::FromStr;
use trueness_inspect::compare::{Coverage, OutlierRule};

/// A rule for outliers: `mad:K` or `Ksigma`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutliersArg(pub OutlierRule);

impl FromStr for OutliersArg {
    type Err = String;
    fn from_str(text: &str) -> Result<OutliersArg, String> {
        let lower = text.trim().to_lowercase();
        let rule: fn(f64) -> OutlierRule;
        let number = match (lower.strip_prefix("mad:"), lower.strip_suffix("sigma")) {
            (Some(k), _) => {
                rule = OutlierRule::Mad;
                k
            }
            (None, Some(k)) => {
                rule = OutlierRule::Sigma;
                k
            }
            (None, None) => {
                return Err(format!(
                    "‘{text}’ is no rule for outliers; write mad:5 (from the median, which outliers do not move) or 3sigma (from \
                     the mean)"
                ));
            }
        };
        match number.trim().parse::<f64>() {
            Ok(k) if k > 0.0 && k.is_finite() => Ok(OutliersArg(rule(k))),
            _ => Err(format!("‘{text}’: how many is a number above 0, as in mad:5 or 3sigma")),
        }
    }
}

/// How far a point covers: `auto` or millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoverageArg(pub Coverage);

impl FromStr for CoverageArg {
    type Err = String;
    fn from_str(text: &str) -> Result<CoverageArg, String> {
        if text.trim().eq_ignore_ascii_case("auto") {
            return Ok(CoverageArg(Coverage::Auto));
        }
        match text.trim().parse::<f64>() {
            Ok(reach) if reach > 0.0 && reach.is_finite() => Ok(CoverageArg(Coverage::Within(reach))),
            _ => Err(format!("‘{text}’ is no reach; write auto, or a number of mm above 0")),
        }
    }
}

/// An angle in degrees, above 0 and at most 180.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacingArg(pub f64);

impl FromStr for FacingArg {
    type Err = String;
    fn from_str(text: &str) -> Result<FacingArg, String> {
        match text.trim().parse::<f64>() {
            Ok(angle) if angle > 0.0 && angle <= 180.0 => Ok(FacingArg(angle)),
            _ => Err(format!("‘{text}’ is no angle between normals; write degrees above 0 and up to 180")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_there_and_back() {
        for word in ["3sigma", "2.5sigma", "mad:5", "mad:3.5"] {
            assert_eq!(word.parse::<OutliersArg>().unwrap().0.to_string(), word);
        }
        for bad in ["", "sigma", "mad", "mad:", "mad:0", "mad:-3", "3", "infsigma", "nansigma", "iqr:1.5"] {
            assert!(bad.parse::<OutliersArg>().is_err(), "{bad}");
        }
    }

    #[test]
    fn reaches_and_angles() {
        assert_eq!("auto".parse(), Ok(CoverageArg(Coverage::Auto)));
        assert_eq!("1.5".parse(), Ok(CoverageArg(Coverage::Within(1.5))));
        for bad in ["", "0", "-1", "inf", "nan", "far"] {
            assert!(bad.parse::<CoverageArg>().is_err(), "{bad}");
        }
        assert_eq!("180".parse(), Ok(FacingArg(180.0)));
        for bad in ["0", "-5", "181", "nan", "wide"] {
            assert!(bad.parse::<FacingArg>().is_err(), "{bad}");
        }
    }
}

//! The angle of `--facing`.

use std::str::FromStr;

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
    fn angles() {
        assert_eq!("180".parse(), Ok(FacingArg(180.0)));
        for bad in ["0", "-5", "181", "nan", "wide"] {
            assert!(bad.parse::<FacingArg>().is_err(), "{bad}");
        }
    }
}

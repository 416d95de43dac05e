//! How far normals may turn away.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// An angle between normals in degrees, above 0 and at most 180.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "f64", into = "f64")]
pub struct FacingAngle(f64);

impl FacingAngle {
    /// The same in radians.
    pub fn radians(self) -> f64 {
        self.0.to_radians()
    }
}

impl TryFrom<f64> for FacingAngle {
    type Error = NoFacingAngle;
    fn try_from(degrees: f64) -> Result<FacingAngle, NoFacingAngle> {
        match degrees > 0.0 && degrees <= 180.0 {
            true => Ok(FacingAngle(degrees)),
            false => Err(NoFacingAngle { written: degrees.to_string() }),
        }
    }
}

impl From<FacingAngle> for f64 {
    fn from(angle: FacingAngle) -> f64 {
        angle.0
    }
}

impl FromStr for FacingAngle {
    type Err = NoFacingAngle;
    fn from_str(text: &str) -> Result<FacingAngle, NoFacingAngle> {
        let degrees = text.trim().parse::<f64>().ok();
        let angle = degrees.and_then(|degrees| FacingAngle::try_from(degrees).ok());
        angle.ok_or_else(|| NoFacingAngle { written: text.into() })
    }
}

/// What is no such angle.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("‘{written}’ is no angle between normals; write degrees above 0 and up to 180")]
pub struct NoFacingAngle {
    written: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles() {
        assert_eq!("180".parse(), Ok(FacingAngle(180.0)));
        assert_eq!(serde_json::from_str::<FacingAngle>("60").unwrap(), FacingAngle(60.0));
        assert_eq!(serde_json::to_string(&FacingAngle(60.0)).unwrap(), "60.0");
        for bad in ["0", "-5", "181", "nan", "wide"] {
            assert!(bad.parse::<FacingAngle>().is_err(), "{bad}");
            assert!(serde_json::from_str::<FacingAngle>(bad).is_err(), "{bad}");
        }
    }
}

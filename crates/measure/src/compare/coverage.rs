//! Within what distance a point covers the reference.

use std::str::FromStr;

/// Within what distance of its nearest place a point covers the reference.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Coverage {
    /// Three times as far as the points lie apart.
    #[default]
    Auto,
    /// So far along the surface, millimeters.
    Within(f64),
}

/// `auto` or millimeters.
///
/// # Errors
/// A sentence that says what can be written.
impl FromStr for Coverage {
    type Err = String;
    fn from_str(text: &str) -> Result<Coverage, String> {
        if text.trim().eq_ignore_ascii_case("auto") {
            return Ok(Coverage::Auto);
        }
        match text.trim().parse::<f64>() {
            Ok(reach) if reach > 0.0 && reach.is_finite() => Ok(Coverage::Within(reach)),
            _ => Err(format!("‘{text}’ is no reach; write auto, or a number of mm above 0")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reaches() {
        assert_eq!("auto".parse(), Ok(Coverage::Auto));
        assert_eq!("1.5".parse(), Ok(Coverage::Within(1.5)));
        for bad in ["", "0", "-1", "inf", "nan", "far"] {
            assert!(bad.parse::<Coverage>().is_err(), "{bad}");
        }
    }
}

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

/// A text that is no reach.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("‘{text}’ is no reach; write auto, or a number of mm above 0")]
pub struct NoReach {
    text: String,
}

/// `auto` or millimeters.
///
/// # Errors
/// Whatever else is written.
impl FromStr for Coverage {
    type Err = NoReach;
    fn from_str(text: &str) -> Result<Coverage, NoReach> {
        if text.trim().eq_ignore_ascii_case("auto") {
            return Ok(Coverage::Auto);
        }
        match text.trim().parse::<f64>() {
            Ok(reach) if reach > 0.0 && reach.is_finite() => Ok(Coverage::Within(reach)),
            _ => Err(NoReach { text: text.into() }),
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

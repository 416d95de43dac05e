//! Shares for people.

/// A share (0 to 1) in percent: one decimal, and as many more as keep what is not all from 100, and what is not nothing from 0.
///
/// ```
/// use trueness_document::percent;
/// assert_eq!([0.5, 0.99992, 1.0, 2e-6].map(percent), ["50 %", "99.99 %", "100 %", "0.0002 %"]);
/// ```
pub fn percent(share: f64) -> String {
    let x = 100.0 * share;
    let told = |digits: usize| {
        let unit = 10f64.powi(digits as i32);
        let rounded = (x * unit).round() / unit;
        (rounded > 0.0 || x <= 0.0) && (rounded < 100.0 || x >= 100.0)
    };
    let digits = (1..9).find(|digits| told(*digits)).unwrap_or(9);
    let text = format!("{x:.digits$}");
    let short = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{short} %")
}

/// Two shares that differ as they are shown, with as many digits as that needs.
///
/// ```
/// use trueness_document::percents;
/// assert_eq!(percents([0.97781, 0.97785]), ["97.781 %", "97.785 %"]);
/// assert_eq!(percents([0.9, 1.0]), ["90 %", "100 %"]);
/// ```
pub fn percents([a, b]: [f64; 2]) -> [String; 2] {
    let short = [a, b].map(percent);
    if short[0] != short[1] || a == b {
        return short;
    }
    let told = |digits: usize| [a, b].map(|x| format!("{:.digits$} %", 100.0 * x));
    (2..13).map(told).find(|two| two[0] != two[1]).unwrap_or(short)
}

/// Why a number is no share in percent.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoPercent {
    /// It is a share of 1.
    #[error("a share is in percent: write {meant} for {meant} %")]
    ShareOfOne {
        /// The same in percent.
        meant: f64,
    },
    /// It is below 0, above 100 or no number.
    #[error("a share is from 0 to 100 percent")]
    OutOfRange,
}

/// The share that is written in percent: 0, or from above 1 to 100. What is less is a share that was meant as one of 1.
///
/// # Errors
/// What is wrong, and what to write.
///
/// ```
/// use trueness_document::of_percent;
/// assert_eq!([0.0, 98.0, 100.0].map(of_percent), [Ok(0.0), Ok(0.98), Ok(1.0)]);
/// assert_eq!(of_percent(0.98).unwrap_err().to_string(), "a share is in percent: write 98 for 98 %");
/// assert!(of_percent(-1.0).is_err() && of_percent(101.0).is_err() && of_percent(f64::NAN).is_err());
/// ```
pub fn of_percent(written: f64) -> Result<f64, NoPercent> {
    if written > 0.0 && written <= 1.0 {
        let meant = (1e10 * written).round() / 1e8;
        return Err(NoPercent::ShareOfOne { meant });
    }
    match (0.0..=100.0).contains(&written) {
        true => Ok(written / 100.0),
        false => Err(NoPercent::OutOfRange),
    }
}

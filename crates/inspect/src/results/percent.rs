//! Shares for people.

/// A share (0 to 1) in percent: one decimal, and as many more as keep what is not all from 100, and what is not nothing from 0.
///
/// ```
/// use trueness_inspect::results::percent;
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

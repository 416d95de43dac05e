//! How many decimals the numbers of a characteristic are shown with.

use super::CharacteristicRecord;

/// More digits after the point tell nothing.
const MAX_DECIMALS: usize = 9;
/// Digits of an uncertainty that count (JCGM 100:2008, 7.2.6).
const UNCERTAINTY_DIGITS: i32 = 2;

impl CharacteristicRecord {
    /// Decimals of value and limits: at least so many, and so many that a value which is not a limit does not look like it.
    pub fn decimals(&self, least: usize) -> usize {
        (least..MAX_DECIMALS).find(|n| !self.is_like_limit(*n)).unwrap_or(MAX_DECIMALS)
    }

    /// The limit that the value looks like with so many decimals, but is not.
    fn is_like_limit(&self, decimals: usize) -> bool {
        self.limit_alike(decimals).is_some()
    }

    fn limit_alike(&self, decimals: usize) -> Option<f64> {
        let value = self.value?;
        let unit = 10f64.powi(decimals as i32);
        let is_like = |limit: &f64| value != *limit && (value * unit).round() == (limit * unit).round();
        self.lower.into_iter().chain([self.upper]).find(is_like)
    }

    /// How far the value is from a limit that no digits tell it from.
    pub fn beyond_digits(&self) -> Option<f64> {
        Some(self.value? - self.limit_alike(MAX_DECIMALS)?)
    }

    /// Decimals in a table: four, or as many as the uncertainty has, and as many as tell the value from a limit.
    pub fn decimals_in_table(&self) -> usize {
        let of = |u: f64| UNCERTAINTY_DIGITS - 1 - libm::log10(u).floor() as i32;
        let least = self.uncertainty.filter(|u| *u > 0.0 && u.is_finite()).map_or(4, of);
        let least = if self.unit == "1" { least.min(3) } else { least };
        let least = least.clamp(1, MAX_DECIMALS as i32) as usize;
        // What no digits tell from its limit takes no more of them.
        if self.beyond_digits().is_some() { least } else { self.decimals(least) }
    }
}

//! Numbers as a reader of some language writes them.

use super::Language;
use trueness_document::scale::Scale;

/// How numbers look on the page.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Language of grouping and decimal sign.
    pub language: Language,
    /// Decimal sign wished for instead of the language's.
    pub decimal: Option<char>,
}

impl Style {
    fn decimal(self) -> char {
        self.decimal.unwrap_or(match self.language {
            Language::De | Language::Ru => ',',
            Language::En | Language::Zh => '.',
        })
    }

    fn group(self) -> char {
        match (self.language, self.decimal()) {
            (Language::Ru, _) => '\u{a0}',
            (_, ',') => '.',
            _ => ',',
        }
    }

    /// `value` with `decimals` digits after the decimal sign, thousands grouped, a true minus sign. Never "−0".
    pub fn fixed(self, value: f64, decimals: usize) -> String {
        let plain = format!("{:.decimals$}", value.abs());
        let (whole, fraction) = plain.split_once('.').unwrap_or((&plain, ""));
        let negative = value < 0.0 && plain.bytes().any(|b| (b'1'..=b'9').contains(&b));
        let mut text = String::from(if negative { "\u{2212}" } else { "" });
        for (i, digit) in whole.chars().enumerate() {
            if i > 0 && (whole.len() - i) % 3 == 0 {
                text.push(self.group());
            }
            text.push(digit);
        }
        if !fraction.is_empty() {
            text.push(self.decimal());
            text.push_str(fraction);
        }
        text
    }

    /// A number as 1.5e−7, with `decimals` digits after the decimal sign.
    pub fn exponent(self, value: f64, decimals: usize) -> String {
        let text = format!("{value:.decimals$e}");
        text.replace('.', &self.decimal().to_string()).replace('-', "\u{2212}")
    }

    /// As [`Style::fixed`], with a plus sign before what is above zero.
    pub fn signed(self, value: f64, decimals: usize) -> String {
        let text = self.fixed(value, decimals);
        let zero = !text.bytes().any(|b| (b'1'..=b'9').contains(&b));
        if value > 0.0 && !zero { format!("+{text}") } else { text }
    }
}

impl Style {
    /// A value as the numbers beside a scale: with a sign where the scale goes below zero, none where it begins at zero.
    pub fn on_scale(self, value: f64, scale: Option<&Scale>) -> String {
        let decimals = scale.map_or(3, |s| s.decimals as usize);
        match scale.is_some_and(|s| s.lower >= 0.0) {
            true => self.fixed(value, decimals),
            false => self.signed(value, decimals),
        }
    }
}

/// Digits after the point of numbers beside a scale with so many: as many more, up to four, as show two digits of this one of them.
pub fn enough(value: Option<f64>, decimals: usize) -> usize {
    let size = value.map(f64::abs).filter(|x| *x > 0.0 && x.is_finite());
    let wanted = size.map_or(0.0, |x| 1.0 - libm::log10(x).floor()).max(0.0) as usize;
    wanted.clamp(decimals, decimals + 4)
}

/// Digits after the point that show two digits of an uncertainty.
pub fn decimals(uncertainty: Option<f64>, without: usize) -> usize {
    let u = uncertainty.filter(|u| *u > 0.0 && u.is_finite());
    u.map_or(without, |u| (1.0 - libm::log10(u).floor()).clamp(1.0, 9.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_language() {
        let show = |language, x| Style { language, decimal: None }.fixed(x, 3);
        assert_eq!(show(Language::En, 1234.567), "1,234.567");
        assert_eq!(show(Language::De, 1234.567), "1.234,567");
        assert_eq!(show(Language::Ru, 1234.567), "1\u{a0}234,567");
        assert_eq!(show(Language::Zh, -1234567.0), "\u{2212}1,234,567.000");
        assert_eq!(Style { language: Language::En, decimal: Some(',') }.fixed(1234.5, 1), "1.234,5");
    }

    #[test]
    fn zero_has_no_sign() {
        let s = Style { language: Language::En, decimal: None };
        assert_eq!(
            (s.fixed(-0.0001, 3), s.signed(0.0001, 3), s.signed(0.01, 3)),
            ("0.000".into(), "0.000".into(), "+0.010".into())
        );
        assert_eq!((s.fixed(100.0, 0), s.signed(-2.0, 0)), ("100".into(), "\u{2212}2".into()));
    }

    #[test]
    fn small_numbers_beside_a_scale_get_two_digits_and_at_most_four_more_places() {
        let digits = |value| enough(value, 3);
        assert_eq!([0.123, 0.0123, -0.00012, 0.0000123].map(|x| digits(Some(x))), [3, 3, 5, 6]);
        assert_eq!([Some(1e-30), Some(0.0), Some(f64::NAN), None].map(digits), [7, 3, 3, 3]);
        assert_eq!(enough(Some(1234.0), 0), 0);
    }
}

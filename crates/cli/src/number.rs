//! Numbers and counts as tables show them: U+2212 for minus, thousands grouped. Documents have them as JSON does.

/// `1234567` as `1,234,567`.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(c);
    }
    out
}

/// So many things: `1 point`, `1,234 points`.
pub fn counted(n: u64, [one, many]: [&str; 2]) -> String {
    format!("{} {}", grouped(n), if n == 1 { one } else { many })
}

/// What is counted: one, and several.
pub const POINTS: [&str; 2] = ["point", "points"];
/// As [`POINTS`].
pub const FACETS: [&str; 2] = ["facet", "facets"];
/// As [`POINTS`].
pub const VERTICES: [&str; 2] = ["vertex", "vertices"];
/// As [`POINTS`].
pub const EDGES: [&str; 2] = ["edge", "edges"];
/// As [`POINTS`].
pub const SHELLS: [&str; 2] = ["shell", "shells"];

/// With so many decimals.
pub fn fixed(x: f64, decimals: usize) -> String {
    minus(format!("{x:.decimals$}"))
}

/// A length, an area or a volume with six decimals; what they would hardly show, with a power of ten.
pub fn extent(x: f64) -> String {
    if x != 0.0 && x.abs() < 1e-3 { scientific(x, 5) } else { fixed(x, 6) }
}

/// With so many decimals and a power of ten.
pub fn scientific(x: f64, decimals: usize) -> String {
    minus(format!("{x:.decimals$e}"))
}

/// A length as tables show it: four decimals; what these would show with fewer than two digits that count, with a power of ten.
pub fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    // Below a thousandth four decimals leave one digit.
    if (1e-3..1e9).contains(&x.abs()) { fixed(x, 4) } else { scientific(x, 1) }
}

/// The same with + above zero.
pub fn short_signed(x: f64) -> String {
    if x > 0.0 { format!("+{}", short(x)) } else { short(x) }
}

/// Six significant digits, as people read them; the document has all of them.
pub fn six_digits(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let digits = (5 - libm::log10(x.abs()).floor() as i32).clamp(0, 12) as usize;
    if (1e-6..1e9).contains(&x.abs()) { fixed(x, digits) } else { scientific(x, 5) }
}

/// The same with + above zero.
pub fn signed(x: f64) -> String {
    if x > 0.0 { format!("+{}", six_digits(x)) } else { six_digits(x) }
}

fn minus(text: String) -> String {
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_by_three_and_counts() {
        for (n, text) in [(0, "0"), (999, "999"), (1000, "1,000"), (1234567, "1,234,567")] {
            assert_eq!(grouped(n), text);
        }
        assert_eq!(["0 points", "1 point", "2 points"], [0, 1, 2].map(|n| counted(n, POINTS))[..]);
        assert_eq!(counted(1, VERTICES), "1 vertex");
    }

    #[test]
    fn minus_signs_are_those_of_print() {
        assert_eq!([fixed(-1.5, 2), scientific(-2e-5, 1)], ["−1.50", "−2.0e−5"]);
    }

    #[test]
    fn four_decimals_and_no_zero_that_is_none() {
        for (x, text) in [
            (0.0, "0"),
            (0.12345, "0.1235"),
            (-79.1114, "−79.1114"),
            (1234.5, "1234.5000"),
            (0.001, "0.0010"),
            (5e-6, "5.0e−6"),
            (-0.00098, "−9.8e−4"),
            (3e12, "3.0e12"),
        ] {
            assert_eq!(short(x), text);
        }
        assert_eq!([short_signed(5e-6), short_signed(-0.5), short_signed(0.0)], ["+5.0e−6", "−0.5000", "0"]);
    }

    #[test]
    fn six_digits_of_any_size() {
        for (x, text) in [
            (0.0, "0"),
            (0.123456789, "0.123457"),
            (-79.1114, "−79.1114"),
            (1234567.8, "1234568"),
            (1e-9, "1.00000e−9"),
        ] {
            assert_eq!(six_digits(x), text);
        }
        assert_eq!([signed(0.5), signed(-0.5), signed(0.0)], ["+0.500000", "−0.500000", "0"]);
    }
}

//! Deviations as whole numbers, with apart codes for what has no value.

use super::super::no_value::NoValue;

/// Codes reserved at the low end for reasons.
const RESERVED_CODES: i32 = NoValue::ALL.len() as i32;
/// The step must be at least this much finer than the range that is looked at.
const MIN_STEPS_PER_RANGE: f64 = 500.0;

/// How deviations become codes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Codes {
    /// 2 or 3.
    pub bytes: usize,
    /// Millimeters a code.
    pub step: f64,
}

impl Codes {
    /// Two bytes where that resolves a 500th of `range` (the tolerance zone or the color range), else three.
    pub fn for_values(values: &[f64], range: f64) -> Codes {
        let greatest = values.iter().filter(|v| v.is_finite()).fold(0.0f64, |m, v| m.max(v.abs()));
        let with = |bytes: usize| {
            let step = greatest / f64::from((1i32 << (8 * bytes - 1)) - RESERVED_CODES);
            Codes {
                bytes,
                step: if step > 0.0 { step } else { range.max(1e-9) / (4.0 * MIN_STEPS_PER_RANGE) },
            }
        };
        let coarse = with(2);
        if coarse.step <= range / MIN_STEPS_PER_RANGE { coarse } else { with(3) }
    }

    /// Code of a deviation, or of the reason why there is none.
    pub fn code(&self, value: f64, reason: NoValue) -> i32 {
        if value.is_finite() { (value / self.step).round() as i32 } else { self.no_value(reason) }
    }

    /// Code that stands for a reason.
    pub fn no_value(&self, reason: NoValue) -> i32 {
        -(1 << (8 * self.bytes - 1)) + reason as i32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_clipped_and_half_a_step_is_the_error() {
        for (values, bytes) in [(vec![-0.3, 0.0, 0.12345, 0.2], 2), (vec![-79.0, 0.0123, 0.2], 3)] {
            let c = Codes::for_values(&values, 0.4);
            assert_eq!(c.bytes, bytes);
            for v in values {
                let code = c.code(v, NoValue::Unknown);
                assert!((f64::from(code) * c.step - v).abs() <= 0.5 * c.step * (1.0 + 1e-9));
                assert!(code > c.no_value(NoValue::NoDirection));
            }
        }
    }

    #[test]
    fn reasons_have_their_own_codes() {
        let c = Codes::for_values(&[1.0], 1.0);
        assert_eq!(c.code(f64::NAN, NoValue::Unknown), -32_768);
        assert_eq!(c.code(f64::NAN, NoValue::BoundaryEdge), -32_766);
        // Beyond thirteen reasons.
        assert_eq!(c.code(-1.0, NoValue::Unknown), -32_755);
    }

    #[test]
    fn all_zero_has_a_step() {
        assert!(Codes::for_values(&[0.0, f64::NAN], 0.2).step > 0.0);
    }
}

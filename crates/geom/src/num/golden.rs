//! The bottom of a valley without derivatives (J. Kiefer, Sequential minimax search for a maximum, 1953).

/// 1 over the golden ratio.
const INVERSE_GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;

/// The place of the least value between two places, where the function has one valley, and the value there. Each step leaves
/// 0.618 of the range.
pub fn golden(value: &impl Fn(f64) -> f64, mut low: f64, mut high: f64, steps: usize) -> (f64, f64) {
    let (mut a, mut b) =
        (high - INVERSE_GOLDEN_RATIO * (high - low), low + INVERSE_GOLDEN_RATIO * (high - low));
    let (mut at_a, mut at_b) = (value(a), value(b));
    for _ in 0..steps {
        if at_a <= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - INVERSE_GOLDEN_RATIO * (high - low);
            at_a = value(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + INVERSE_GOLDEN_RATIO * (high - low);
            at_b = value(b);
        }
    }
    if at_a <= at_b { (a, at_a) } else { (b, at_b) }
}

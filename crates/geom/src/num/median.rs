//! The median of numbers.

/// The middle one of numbers in ascending order, of an even number the upper of both; `None` where there are none. NaN comes after all
/// others. They are left in another order. Cost: linear.
///
/// ```
/// use trueness_geom::num::median::median;
/// assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
/// assert_eq!(median(&mut [4.0, 1.0]), Some(4.0));
/// assert_eq!(median(&mut []), None);
/// ```
pub fn median(numbers: &mut [f64]) -> Option<f64> {
    let middle = numbers.len() / 2;
    (!numbers.is_empty()).then(|| *numbers.select_nth_unstable_by(middle, f64::total_cmp).1)
}

//! Named numbers of points.

/// The named numbers, reason and color of each point.
pub struct Values<'a, const N: usize> {
    /// Names of the numbers.
    pub names: [&'a str; N],
    /// The numbers of a point, NaN where there is none.
    pub of: &'a (dyn Fn(usize) -> [f64; N] + Sync),
    /// Why a point lacks its numbers: a place in `reasons`, 0 where it has them.
    pub reason: &'a (dyn Fn(usize) -> u8 + Sync),
    /// The words for it; the first is empty.
    pub reasons: &'a [&'a str],
    /// The color of a point.
    pub color: &'a (dyn Fn(usize) -> [u8; 3] + Sync),
}

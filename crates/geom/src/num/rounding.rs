//! Bounds of rounding that several searches share.

/// Bound of a distance in single precision, as a share of the sum of its terms. A distance is formed with about ten roundings of
/// 2^-24; this allows sixteen.
pub(crate) const SINGLE_DISTANCE_ROUNDING: f32 = 1.0 / (1 << 20) as f32;

/// Bound of a sum of two or three products, as a share of the sum of their magnitudes. It is more than rounding takes on both
/// sides of a comparison.
pub(crate) const PRODUCT_SUM_ROUNDING: f64 = 16.0 * f64::EPSILON;

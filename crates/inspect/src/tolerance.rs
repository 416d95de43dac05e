//! What is allowed.

/// A zone of allowed deviations; both limits belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Least allowed deviation, millimetres.
    pub lower: f64,
    /// Greatest allowed deviation, millimetres.
    pub upper: f64,
}

//! The effect of the unknowns of a fit on an element.

/// One unknown of a fit: what a unit of it does to the element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Local {
    /// Moves the origin along axis 0, 1 or 2.
    Shift(usize),
    /// Leans the third axis towards axis 0 or 1.
    Tilt(usize),
    /// Turns the first axis towards the second.
    Turn,
    /// Adds to the size with this index.
    Size(usize),
}

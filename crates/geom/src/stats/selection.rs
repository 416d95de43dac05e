//! All, positive or negative deviations.

/// Which deviations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selection {
    /// All of them.
    All,
    /// The deviations above zero.
    Positive,
    /// The deviations below zero.
    Negative,
}

impl Selection {
    /// The part lies strictly between these.
    pub(super) fn limits(self) -> (f64, f64) {
        match self {
            Selection::All => (f64::NEG_INFINITY, f64::INFINITY),
            Selection::Positive => (0.0, f64::INFINITY),
            Selection::Negative => (f64::NEG_INFINITY, 0.0),
        }
    }
    /// True if the part has this value; never for a value that is not finite.
    pub fn holds(self, x: f64) -> bool {
        let (above, below) = self.limits();
        x > above && x < below
    }
}

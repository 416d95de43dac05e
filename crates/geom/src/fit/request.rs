//! The request to a fit, and why it may have no answer.

use crate::shape::{Kind, Shape};

/// The measure by which an element is the best.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Method {
    /// Least sum of squared distances.
    #[default]
    Gaussian,
    /// Least deviation of form: the zone between two elements of equal distance from this one is the narrowest that holds all
    /// points. For a line in space: the thinnest cylinder about it.
    MinimumZone,
    /// The smallest circle, sphere or cylinder around all points.
    MinimumCircumscribed,
    /// The largest circle, sphere or cylinder free of points, near the least-squares one.
    MaximumInscribed,
    /// Least sum of a loss that grows no more beyond a few standard deviations: outliers of a scan do not count.
    Robust,
}

impl Method {
    /// All methods.
    pub const ALL: [Method; 5] = [
        Method::Gaussian,
        Method::MinimumZone,
        Method::MinimumCircumscribed,
        Method::MaximumInscribed,
        Method::Robust,
    ];
    /// The word for it: `gaussian`, `minimum-zone`, …
    pub fn name(self) -> &'static str {
        match self {
            Method::Gaussian => "gaussian",
            Method::MinimumZone => "minimum-zone",
            Method::MinimumCircumscribed => "minimum-circumscribed",
            Method::MaximumInscribed => "maximum-inscribed",
            Method::Robust => "robust",
        }
    }
}

/// How to fit.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// The measure by which an element is the best.
    pub method: Method,
    /// Where to start: an element of the kind asked for, near the one sought. Without it all starts are
    /// looked for.
    pub start: Option<Shape>,
    /// Seed of the random choices: of the trials of a robust fit, of the further starts of a zone.
    pub seed: u64,
}

/// Why there is no element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FitError {
    /// Fewer points than unknowns.
    #[error("a {} needs at least {needed} points, there are {found}", kind.name())]
    TooFewPoints {
        /// The kind that was asked for.
        kind: Kind,
        /// Points that would do.
        needed: usize,
        /// Points given.
        found: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is not a finite number; remove it")]
    NotFinite {
        /// Index of the first such point.
        index: usize,
    },
    /// All points are one and the same.
    #[error("all points are equal")]
    AllEqual,
    /// All points lie on one straight line.
    #[error("all points lie on one straight line: they determine no {}", kind.name())]
    Collinear {
        /// The kind that was asked for.
        kind: Kind,
    },
    /// The points fit more than one such element equally well, as points of one circle fit many spheres.
    #[error("the points determine no {}: measure more of its surface", kind.name())]
    Undetermined {
        /// The kind that was asked for.
        kind: Kind,
    },
    /// The start is not of the kind asked for, or has no direction or size.
    #[error("the start is not a sound {}", kind.name())]
    WrongStart {
        /// The kind that was asked for.
        kind: Kind,
    },
    /// The method has no meaning for the element.
    #[error("{} is not defined for a {}: choose another method", method.name(), kind.name())]
    NoSuchMethod {
        /// The kind that was asked for.
        kind: Kind,
        /// How.
        method: Method,
    },
    /// Stopped through the progress argument.
    #[error("cancelled")]
    Cancelled,
}

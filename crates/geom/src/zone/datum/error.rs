//! Why there is no datum system.

use crate::fit::FitError;
use crate::zone::error::ZoneError;

/// Why there is no datum system. Datums are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum DatumError {
    /// No element could be associated.
    #[error("datum {datum}: {error}", datum = datum + 1)]
    Fit {
        /// Which datum.
        datum: usize,
        /// Why.
        error: FitError,
    },
    /// No zone could be found.
    #[error("datum {datum}: {error}", datum = datum + 1)]
    Zone {
        /// Which datum.
        datum: usize,
        /// Why.
        error: ZoneError,
    },
    /// It holds nothing that the datums before it leave free.
    #[error("datum {datum} holds nothing that the datums before it leave free (it stands at {degrees:.3}° to the first)", datum = datum + 1)]
    Idle {
        /// Which datum.
        datum: usize,
        /// Its angle to the first datum.
        degrees: f64,
    },
    /// It is neither parallel nor perpendicular to those before it.
    #[error("datum {datum} stands at {degrees:.3}° to those before it; only datums parallel or perpendicular to each other are evaluated", datum = datum + 1)]
    Oblique {
        /// Which datum.
        datum: usize,
        /// Its angle to the first datum.
        degrees: f64,
    },
    /// It is an axis across an attitude that those before it do not hold.
    #[error("datum {datum} is an axis across those before it, which leave a turn free; such an axis is evaluated only behind datums that hold all turns", datum = datum + 1)]
    Across {
        /// Which datum.
        datum: usize,
    },
    /// The features of a common datum do not go together.
    #[error("common datum {datum}: {what}", datum = datum + 1)]
    Common {
        /// Which datum.
        datum: usize,
        /// Why.
        what: &'static str,
    },
    /// The combination has no rule here.
    #[error("a datum system of {what} is not evaluated")]
    Unsupported {
        /// The elements that it is made of.
        what: &'static str,
    },
}

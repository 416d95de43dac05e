//! Progress and cancellation, handed down as one explicit argument.

/// Told how far a long computation is; may ask it to stop. Called from several threads.
pub trait Progress: Sync {
    /// `items` more are done (points, facets: the function called says which).
    fn advance(&self, items: u64) {
        let _ = items;
    }
    /// True if the result is no longer wanted. Asked often; the computation then returns its `Cancelled` error soon. Once
    /// true it must stay so: loops inside end early on one answer, and the caller tells by the next that they did.
    fn cancelled(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests;

/// Tells nobody and never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {}

/// The computation was stopped through [`Progress::cancelled`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

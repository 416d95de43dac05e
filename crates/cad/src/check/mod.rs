//! What is wrong with a boundary: borders, gaps, faces and edges of no size.

mod borders;
mod fault;
mod gaps;
mod sizes;
#[cfg(test)]
mod tests;

pub use fault::{Fault, FaultKind, place_of_face};

use crate::measure::Integrals;
use crate::trimmed::Trimmed;

/// All faults, kind by kind. `within` is the uncertainty of the file, millimeters; `integrals` are those of the faces.
pub fn faults(shape: &Trimmed, integrals: &[Option<Integrals>], within: f64) -> Vec<Fault> {
    let mut all = borders::faults(shape);
    all.extend(gaps::faults(shape, within));
    all.extend(sizes::faults(shape, integrals, within));
    all.sort_by_key(|fault| fault.kind);
    all
}

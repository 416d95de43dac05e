//! The best fit of a section onto its nominal.

use trueness_document::section::FitRecord;
use trueness_section::{Freedom, OntoNominal};

/// The record of a fit in a plane; `freedom` by its name.
pub fn fit_record(plane: Option<u64>, (name, freedom): (&str, Freedom), found: &OntoNominal) -> FitRecord {
    let of = |k: usize, u: f64| freedom.axes[k].then_some(u);
    let [x, y] = found.shift_uncertainty;
    FitRecord {
        plane,
        freedom: name.into(),
        center: found.motion.center,
        shift: found.motion.shift,
        shift_uncertainty: [of(0, x), of(1, y)],
        turn: found.motion.turn,
        turn_uncertainty: of(2, found.turn_uncertainty),
        transform: found.motion.rows(),
        rms_before: found.rms_before,
        rms: found.rms,
        correlated: found.correlated,
        used: found.used as u64,
        left_out: found.left_out as u64,
        iterations: found.iterations as u64,
        converged: found.converged,
    }
}

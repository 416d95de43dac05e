//! The paper's methods, side by side.

use trueness_document::section::{MethodRecord, MethodsRecord, ResidualsRecord};
use trueness_section::{Method, Search};

/// What the methods found, each with its number of points of the curve.
pub(super) fn methods_record(chosen: Search, interval: &str, methods: &[(Method, usize)]) -> MethodsRecord {
    let table = methods.iter().map(|(m, on_curve)| method(m, *on_curve)).collect();
    MethodsRecord { chosen: chosen.name().into(), interval: interval.into(), table }
}

fn method(found: &Method, on_curve: usize) -> MethodRecord {
    let [a, b] = found.interval;
    let record = |points: usize, [rms, max]: [f64; 2]| ResidualsRecord { points: points as u64, rms, max };
    MethodRecord {
        method: found.search.name().into(),
        interval: found.interval,
        interval_length: ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt(),
        join: found.join,
        line: record(found.on_line, found.line_residuals),
        curve: record(on_curve, found.curve_residuals),
        control_points: found.curve.points().len() as u64,
    }
}

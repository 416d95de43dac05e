//! From an alignment to the result document.

mod note;

pub use note::{note, notes_of_rows, notes_of_search};

use trueness_document::align::{
    AlignDocument, AlignedTo, AlternativeRecord, BestFitRecord, ChebyshevRecord, FreeMotion, LockRecord,
    PairRecord, SCHEMA, SlackMotion, ZonesRecord,
};
use trueness_document::{InputRecord, UNITS, VERSION};
use trueness_geom::align::{Alignment, Freedom, InZones, Lock, Minimax, NotCounted, RowFit, Scale};
use trueness_geom::space::{cross, minus, norm};

/// Share of a free motion from which on a component takes part in it.
const MIN_FREE_SHARE: f64 = 0.03;
/// Names of the components of a motion: of the translation, then of the rotation vector.
const MOTION_COMPONENTS: [&str; 6] = ["tx", "ty", "tz", "rx", "ry", "rz"];

/// What a comparison tells of a best fit to `reference`.
pub fn aligned_to(found: &Alignment, reference: String) -> AlignedTo {
    AlignedTo {
        reference,
        transform: found.reference_from_measured.matrix(),
        rms: found.rms,
        mean_abs: found.mean_abs,
        iterations: found.iterations as u64,
        converged: found.converged,
        left_out: found.excluded_points,
        warnings: found.warnings.iter().map(note).collect(),
    }
}

/// The document of a best fit of the first of `inputs` to the second.
pub fn best_fit(found: &Alignment, inputs: Vec<InputRecord>, seed: u64) -> AlignDocument {
    let alternatives = found.alternatives.iter().map(|a| AlternativeRecord {
        transform: a.reference_from_measured.matrix(),
        angle: a.angle,
        ratio: a.ratio,
    });
    AlignDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs,
        method: "best-fit".into(),
        transform: found.reference_from_measured.matrix(),
        scale: None,
        scale_std_uncertainty: None,
        angle: found.reference_from_measured.angle(),
        rms: found.rms,
        mean_abs: found.mean_abs,
        iterations: found.iterations as u64,
        converged: found.converged,
        degrees_of_freedom: 6 - found.freedoms.len().min(6) as u64,
        free: found.freedoms.iter().map(free_motion).collect(),
        slack: found
            .slack
            .iter()
            .map(|(f, width)| SlackMotion { motion: free_motion(f), width: *width })
            .collect(),
        lock: None,
        best_fit: Some(BestFitRecord {
            median: found.median,
            used: found.used,
            left_out: found.excluded_points,
            share: found.share,
            center: found.center,
            covariance: found.covariance,
            std_uncertainty: std::array::from_fn(|k| found.covariance[k][k].max(0.0).sqrt()),
            condition: found.condition,
            condition_reason: found.condition.is_none().then(|| "a motion is free".into()),
            alternatives: alternatives.collect(),
        }),
        chebyshev: None,
        zones: None,
        pairs: vec![],
        warnings: found.warnings.iter().map(note).collect(),
        seed,
    }
}

/// The document of the least greatest distance, found from the best fit `from`.
pub fn minimax(found: &Minimax, from: &Alignment, inputs: Vec<InputRecord>, seed: u64) -> AlignDocument {
    AlignDocument {
        method: "chebyshev".into(),
        transform: found.reference_from_measured.matrix(),
        scale: None,
        scale_std_uncertainty: None,
        angle: found.reference_from_measured.angle(),
        rms: found.rms,
        mean_abs: found.mean_abs,
        chebyshev: Some(ChebyshevRecord {
            greatest: found.greatest,
            at: found.at,
            used: found.used,
            left_out: found.not_counted.count,
            left_out_farthest: farthest(&found.not_counted),
        }),
        warnings: notes_of_search(from, &found.not_counted),
        ..best_fit(from, inputs, seed)
    }
}

/// The document of the least greatest excess over tolerances, found from the best fit `from`.
pub fn zones(found: &InZones, from: &Alignment, inputs: Vec<InputRecord>, seed: u64) -> AlignDocument {
    AlignDocument {
        method: "zones".into(),
        transform: found.reference_from_measured.matrix(),
        scale: None,
        scale_std_uncertainty: None,
        angle: found.reference_from_measured.angle(),
        rms: found.rms,
        mean_abs: found.mean_abs,
        zones: Some(ZonesRecord {
            excess: found.excess,
            at: found.at,
            deviation: found.deviation,
            tolerance: found.zone,
            beyond: found.beyond,
            least: found.least,
            used: found.used,
            left_out: found.not_counted.count,
            left_out_farthest: farthest(&found.not_counted),
            without_zone: found.without_zone,
        }),
        warnings: notes_of_search(from, &found.not_counted),
        ..best_fit(from, inputs, seed)
    }
}

/// The document of an alignment by rows of a table: `method` is `pairs`, `3-2-1` or `rps`; `corners` are those of the part, in the frame of the reference.
pub fn rows(
    found: &RowFit,
    method: &str,
    corners: &[[f64; 3]],
    inputs: Vec<InputRecord>,
    seed: u64,
) -> AlignDocument {
    let count = found.residuals.len().max(1) as f64;
    let amplifications = found.amplifications(corners);
    let row = |(row, residual): (usize, &f64)| PairRecord {
        row: row as u64,
        residual: *residual,
        amplification: amplifications.get(row).copied(),
    };
    AlignDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs,
        method: method.into(),
        transform: found.reference_from_measured.matrix(),
        scale: None,
        scale_std_uncertainty: None,
        angle: found.reference_from_measured.angle(),
        rms: found.rms,
        mean_abs: found.residuals.iter().map(|r| r.abs()).sum::<f64>() / count,
        iterations: found.iterations as u64,
        converged: found.converged,
        degrees_of_freedom: 6,
        free: vec![],
        slack: vec![],
        lock: None,
        best_fit: None,
        chebyshev: None,
        zones: None,
        pairs: found.residuals.iter().enumerate().map(row).collect(),
        warnings: notes_of_rows(found, corners),
        seed,
    }
}

/// The document with components of the motion that stayed zero.
pub fn with_lock(mut document: AlignDocument, lock: &Lock) -> AlignDocument {
    let locked = lock.axes.iter().filter(|locked| **locked).count() as u64;
    document.degrees_of_freedom = document.degrees_of_freedom.saturating_sub(locked);
    document.lock = Some(lock_record(lock));
    document
}

/// The document of a best fit with a scale.
pub fn with_scale(mut document: AlignDocument, scale: &Scale) -> AlignDocument {
    for row in &mut document.transform[..3] {
        row[..3].iter_mut().for_each(|x| *x *= scale.factor);
    }
    (document.scale, document.scale_std_uncertainty) = (Some(scale.factor), Some(scale.std_uncertainty));
    document
}

/// Which components of the motion the measured leaves open: of the rotation vector about the center of a best fit, then of its translation.
pub fn open(document: &AlignDocument) -> [bool; 6] {
    let center = document.best_fit.as_ref().map_or([0.0; 3], |fit| fit.center);
    let bounds = document.inputs.first().and_then(|measured| measured.bounds.as_ref());
    // Turns move the center as far as they move the part where its axis lies that far off.
    let size = bounds.map_or(0.0, |b| norm(minus(b.max, b.min)));
    let mut open = [false; 6];
    for motion in document.free.iter().chain(document.slack.iter().map(|s| &s.motion)) {
        let d = motion.direction;
        let (turn, shift, whole) = match motion.point {
            None => ([0.0; 3], d, 1.0),
            Some(point) => (d, cross(d, minus(center, point)), size),
        };
        for k in 0..3 {
            open[k] |= turn[k].abs() > MIN_FREE_SHARE;
            open[k + 3] |= shift[k].abs() > MIN_FREE_SHARE * whole;
        }
    }
    open
}

fn lock_record(lock: &Lock) -> LockRecord {
    let axes = MOTION_COMPONENTS.iter().zip(lock.axes).filter(|a| a.1).map(|a| a.0.to_string());
    LockRecord { axes: axes.collect(), center: lock.center }
}

fn free_motion(freedom: &Freedom) -> FreeMotion {
    match *freedom {
        Freedom::Slides { direction } => FreeMotion { kind: "slides".into(), direction, point: None },
        Freedom::Turns { point, direction } => {
            FreeMotion { kind: "turns".into(), direction, point: Some(point) }
        }
    }
}

fn farthest(left_out: &NotCounted) -> Option<f64> {
    (left_out.count > 0).then_some(left_out.farthest)
}

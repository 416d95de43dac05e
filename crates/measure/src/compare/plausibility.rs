//! Whether measured and reference can belong together, judged by their boxes alone.
//!
//! A wrong unit scales everything by a known factor, and a scan that was never aligned lies somewhere else. Both give
//! distances that are computed right and mean nothing. A box is all that is needed to notice it; and as a scan of a
//! small part of a model looks much the same, what is noticed is a warning and no error.

use trueness_document::compare::{Bounds, Warning, WarningKind};
use trueness_geom::space::{minus, norm};

/// Quotients of two units of length in use: micrometers, millimeters, centimeters, inches, meters.
const UNIT_RATIOS: [f64; 8] = [10.0, 25.4, 1000.0 / 25.4, 100.0, 1000.0, 1e4, 25400.0, 1e6];
/// How far a ratio of sizes may lie from one of units, as a factor. The diagonal of a box grows by noise and strays, and
/// changes as the part is turned.
const MAX_RATIO_FACTOR: f64 = 1.3;
/// Each box is widened by this share of the smaller diagonal on all sides: flat parts have boxes without height.
const WIDENED_BOX_SHARE: f64 = 0.05;
/// Boxes that share less than this part of the smaller one hardly overlap.
const MIN_OVERLAP_SHARE: f64 = 0.1;

/// What makes it unlikely that points in the box `measured` were taken from the part in the box `reference`, both mm.
///
/// Boxes of no size are not judged: a single point may lie anywhere. `remedy`: how units are set where it is asked.
pub fn warnings(measured: &Bounds, reference: &Bounds, remedy: &str) -> Vec<Warning> {
    let diagonal = |b: &Bounds| norm(minus(b.max, b.min));
    let (m, r) = (diagonal(measured), diagonal(reference));
    if !(m > 0.0 && r > 0.0 && m.is_finite() && r.is_finite()) {
        return vec![];
    }
    let mut found = vec![];
    let ratio = m / r;
    if near_ratio_of_units(ratio) {
        let (than, factor) = if ratio > 1.0 { ("larger", ratio) } else { ("smaller", 1.0 / ratio) };
        let text = format!(
            "the measured is {} times {than} than the reference: is a unit wrong? ({remedy})",
            short(factor)
        );
        found.push(Warning { kind: WarningKind::SizeRatio, value: ratio, text });
    }
    let share = overlap(measured, reference, WIDENED_BOX_SHARE * m.min(r));
    if share < MIN_OVERLAP_SHARE {
        let text = "the boxes of measured and reference hardly overlap: not aligned, or a unit wrong?".into();
        found.push(Warning { kind: WarningKind::HardlyOverlapping, value: share, text });
    }
    found
}

fn near_ratio_of_units(ratio: f64) -> bool {
    let factor = ratio.max(1.0 / ratio);
    UNIT_RATIOS.iter().any(|unit| factor / unit < MAX_RATIO_FACTOR && unit / factor < MAX_RATIO_FACTOR)
}

/// Share of the smaller box that both have in common, after both were widened by `margin`.
fn overlap(a: &Bounds, b: &Bounds, margin: f64) -> f64 {
    let axis = |k: usize| {
        let common = a.max[k].min(b.max[k]) - a.min[k].max(b.min[k]) + 2.0 * margin;
        let length = (a.max[k] - a.min[k]).min(b.max[k] - b.min[k]) + 2.0 * margin;
        (common / length).clamp(0.0, 1.0)
    };
    axis(0) * axis(1) * axis(2)
}

/// Three digits.
fn short(x: f64) -> String {
    match x {
        x if x < 10.0 => format!("{x:.2}"),
        x if x < 100.0 => format!("{x:.1}"),
        x => format!("{x:.0}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(min: [f64; 3], max: [f64; 3]) -> Bounds {
        Bounds { min, max }
    }

    fn kinds(measured: &Bounds, reference: &Bounds) -> Vec<WarningKind> {
        warnings(measured, reference, "").iter().map(|w| w.kind).collect()
    }

    #[test]
    fn wrong_units_are_noticed_and_parts_are_not() {
        let part = of([-50.0, -30.0, 0.0], [50.0, 30.0, 20.0]);
        let scaled = |s: f64| of(part.min.map(|x| s * x), part.max.map(|x| s * x));
        for s in [0.001, 0.1, 1.0 / 25.4, 25.4 / 1000.0, 10.0, 25.4, 1000.0, 1000.0 / 25.4] {
            let found = warnings(&scaled(s), &part, "");
            assert_eq!(found[0].kind, WarningKind::SizeRatio, "{s}");
            assert!((found[0].value / s - 1.0).abs() < 1e-12);
        }
        for s in [1.0, 0.5, 1.7, 3.0, 0.2, 5.0] {
            assert_eq!(kinds(&scaled(s), &part), [], "{s}");
        }
    }

    #[test]
    fn parts_that_lie_apart_are_noticed_and_flat_ones_are_not() {
        let part = of([0.0; 3], [100.0, 60.0, 20.0]);
        let moved = |d: f64| of([d, 0.0, 0.0], [100.0 + d, 60.0, 20.0]);
        assert_eq!(kinds(&moved(50.0), &part), []);
        assert_eq!(kinds(&moved(120.0), &part), [WarningKind::HardlyOverlapping]);
        // A scan of one face, off by a tenth of a millimeter.
        assert_eq!(kinds(&of([0.0, 0.0, 20.1], [100.0, 60.0, 20.1]), &part), []);
        let sheet = of([0.0; 3], [100.0, 60.0, 0.0]);
        assert_eq!(kinds(&of([0.0, 0.0, 0.3], [100.0, 60.0, 0.3]), &sheet), []);
        // A point alone, or none, tells nothing.
        assert_eq!(kinds(&of([500.0; 3], [500.0; 3]), &part), []);
    }

    #[test]
    fn moving_and_turning_both_by_right_angles_changes_nothing() {
        let (a, b) = (of([0.0; 3], [9.0, 5.0, 2.0]), of([8.5, 4.0, 0.0], [20.0, 9.0, 3.0]));
        let turned =
            |b: &Bounds| of([b.min[2] + 7.0, b.min[0], b.min[1]], [b.max[2] + 7.0, b.max[0], b.max[1]]);
        let (before, after) = (warnings(&a, &b, ""), warnings(&turned(&a), &turned(&b), ""));
        assert_eq!(before.len(), 1);
        assert!((before[0].value - after[0].value).abs() < 1e-12);
    }
}

//! How a section differs from that of a nominal.

use super::doubts::doubts;
use super::outline::{AgainstPlane, records};
use crate::statistics::{by_side, counted};
use std::collections::BTreeMap;
use trueness_document::Word;
use trueness_document::section::{
    BEYOND_END, MAX_DISTANCE, NO_OUTLINE, NominalRecord, OutlineRecord, Positive, WorstRecord,
};
use trueness_geom::stats::statistics::Summary;

/// The record of all contours, plane after plane.
pub fn nominal(path: &str, outline: &str, planes: Vec<AgainstPlane>) -> NominalRecord {
    let mut excluded: BTreeMap<String, u64> = BTreeMap::new();
    let mut worst: [Option<WorstRecord>; 2] = [None; 2];
    let mut extremes: [Option<WorstRecord>; 2] = [None; 2];
    let mut values = vec![];
    let contours = planes.iter().flat_map(|p| p.contours.iter().map(|c| (p.outlines.is_empty(), c)));
    for (contour, (bare, against)) in contours.enumerate() {
        if against.far > 0 {
            *excluded.entry(MAX_DISTANCE.into()).or_default() += against.far as u64;
        }
        let mut far = against.far;
        for (index, (point, found)) in against.points.iter().zip(&against.found).enumerate() {
            let Some(off) = found else {
                // Those that are too far off are counted above.
                if far > 0 {
                    far -= 1;
                    continue;
                }
                let reason = if bare { NO_OUTLINE } else { BEYOND_END };
                *excluded.entry(reason.into()).or_default() += 1;
                continue;
            };
            values.push(off.deviation);
            let slot = &mut worst[usize::from(off.deviation < 0.0)];
            let own = WorstRecord {
                contour: contour as u64,
                index: index as u64,
                point: *point,
                nearest: off.place,
                deviation: off.deviation,
            };
            if off.deviation != 0.0 && slot.is_none_or(|w| w.deviation.abs() < off.deviation.abs()) {
                *slot = Some(own);
            }
            for (slot, sign) in extremes.iter_mut().zip([-1.0, 1.0]) {
                if slot.is_none_or(|w| sign * w.deviation < sign * off.deviation) {
                    *slot = Some(own);
                }
            }
        }
    }
    let found = || planes.iter().flat_map(|p| p.contours.iter().map(|c| &c.found));
    let summary = Summary::of(&values);
    let deviations = found().map(|f| f.iter().map(|o| o.map(|o| o.deviation)).collect()).collect();
    let nearest = found().map(|f| f.iter().map(|o| o.map(|o| o.place)).collect()).collect();
    let warnings = doubts(&planes);
    let outlines: Vec<OutlineRecord> = planes.into_iter().flat_map(records).collect();
    NominalRecord {
        path: path.into(),
        outline: outline.into(),
        positive: Word(positive(&outlines)),
        deviation: by_side(&summary),
        fits: vec![],
        profile: None,
        verdict: None,
        verdict_reasons: vec![],
        extremes: extremes.into_iter().flatten().collect(),
        excluded,
        histogram: counted(&summary.all, &values),
        worst: worst.into_iter().flatten().collect(),
        warnings,
        deviations,
        nearest,
        outlines,
    }
}

/// The side of the outlines that points are nearest to; of all, if there are none.
fn positive(outlines: &[OutlineRecord]) -> Positive {
    let all = outlines.iter().all(|o| o.points == 0);
    let counts = || outlines.iter().filter(|o| all || o.points > 0);
    match (counts().any(|o| o.closed), counts().any(|o| !o.closed)) {
        (true, true) => Positive::Both,
        (false, true) => Positive::Left,
        (_, false) => Positive::Outside,
    }
}

#[cfg(test)]
mod tests;

//! How a section differs from that of a nominal.

use super::super::Word;
use super::super::compare::{BySide, Histogram};
use super::super::word::named;
use super::doubts::{NominalWarning, doubts};
use super::fitted::FitRecord;
use super::outline::{self, AgainstPlane, OutlineRecord};
use super::profile::{ProfileRecord, WorstRecord};
use crate::{Verdict, VerdictReason};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use trueness_geom::stats::statistics::Summary;

/// Where deviations from a nominal are positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Positive {
    /// Outside of the material within closed outlines.
    Outside,
    /// To the left of open outlines.
    Left,
    /// Outside of the material within closed outlines, to the left of open ones: there are both.
    Both,
}

impl Positive {
    /// Of the outlines that points are nearest to; of all, if there are none.
    fn of(outlines: &[OutlineRecord]) -> Positive {
        let all = outlines.iter().all(|o| o.points == 0);
        let counts = || outlines.iter().filter(|o| all || o.points > 0);
        match (counts().any(|o| o.closed), counts().any(|o| !o.closed)) {
            (true, true) => Positive::Both,
            (false, true) => Positive::Left,
            (_, false) => Positive::Outside,
        }
    }
}

/// Reason why a point is left out: it lies beyond the end of an open outline.
pub const BEYOND_END: &str = "beyond_end";
/// Reason why a point is left out: it lies farther off than was said.
pub const MAX_DISTANCE: &str = "max_distance";
/// Reason why a point is left out: there is no outline in its plane.
pub const NO_OUTLINE: &str = "no_outline";

named!(Positive, "side", [Positive::Outside, Positive::Left, Positive::Both], |side| match side {
    Positive::Outside => "outside",
    Positive::Left => "left",
    Positive::Both => "outside_or_left",
});

/// Deviations of the points of a section from the section of a nominal.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct NominalRecord {
    /// Path of the nominal; it is the last of `inputs`.
    pub path: String,
    /// What was measured against: `facets` (the cut of a mesh), `contour` (the segments found in a row of points) or `drawing` (the
    /// entities of a drawing).
    pub outline: String,
    /// Positive deviations: `outside` of the material within closed outlines, to the `left` of open ones, or `outside_or_left` where points
    /// are nearest to both: each is as its outline is (`closed` of `outlines`).
    pub positive: Word<Positive>,
    /// Statistics of the deviations: all, those above zero, those below zero.
    pub deviation: BySide,
    /// The best fit of each plane before the deviations were taken, where one was asked for.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub fits: Vec<FitRecord>,
    /// The deviations against the tolerance of the profile, where one was given.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub profile: Option<ProfileRecord>,
    /// The verdict on them: what table, page and exit status go by. Without a tolerance it is absent.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub verdict: Option<Verdict>,
    /// Why it is not a pass.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub verdict_reasons: Vec<VerdictReason>,
    /// Points left out, by reason: [`BEYOND_END`], [`NO_OUTLINE`], [`MAX_DISTANCE`].
    pub excluded: BTreeMap<String, u64>,
    /// Counts of the deviations; absent when there are none.
    pub histogram: Option<Histogram>,
    /// The points farthest off on both sides: above first.
    pub worst: Vec<WorstRecord>,
    /// The deviation of each point of each contour; `null` where it is left out.
    pub deviations: Vec<Vec<Option<f64>>>,
    /// The outlines of the nominal, plane after plane, and how much of each was measured.
    #[serde(default)]
    pub outlines: Vec<OutlineRecord>,
    /// What makes the deviations doubtful, although each is computed right.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub warnings: Vec<NominalWarning>,
    /// The least and the greatest deviation, for the verdict.
    #[serde(skip)]
    pub extremes: Vec<WorstRecord>,
    /// The place nearest to each point of each contour, for the page.
    #[serde(skip)]
    pub nearest: Vec<Vec<Option<[f64; 2]>>>,
}

impl NominalRecord {
    /// The record of all contours, plane after plane.
    pub fn new(path: &str, outline: &str, planes: Vec<AgainstPlane>) -> NominalRecord {
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
        let outlines: Vec<OutlineRecord> = planes.into_iter().flat_map(outline::records).collect();
        NominalRecord {
            path: path.into(),
            outline: outline.into(),
            positive: Word(Positive::of(&outlines)),
            deviation: BySide::of(&summary),
            fits: vec![],
            profile: None,
            verdict: None,
            verdict_reasons: vec![],
            extremes: extremes.into_iter().flatten().collect(),
            excluded,
            histogram: Histogram::counted(&summary.all, &values),
            worst: worst.into_iter().flatten().collect(),
            warnings,
            deviations,
            nearest,
            outlines,
        }
    }
}

//! How a section differs from that of a nominal.

use super::super::Word;
use super::super::compare::{BySide, Histogram};
use super::super::word::named;
use super::doubts::NominalWarning;
use super::fitted::FitRecord;
use super::outline::OutlineRecord;
use super::profile::{ProfileRecord, WorstRecord};
use crate::{Verdict, VerdictReason};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

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
    /// What was measured against: `facets` (the cut of a mesh), `faces` (the cut of a CAD model), `contour` (the segments found in a row of
    /// points) or `drawing` (the entities of a drawing).
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

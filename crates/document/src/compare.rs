//! `trueness/compare/1`: deviations of measured points from one or several references.

mod words;

use super::align::AlignedTo;
use super::check::Defects;
use super::face::FaceDeviation;
use super::research::Research;
use super::result::ResultDocument;
pub use super::{Bounds, BySide, Histogram, Percentiles, Statistics};
use super::{InputRecord, Verdict, VerdictReason, Word};
use crate::scale::Scale;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

pub use words::{AlongKind, MeasuredKind, Method, SignBy};

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/compare/1";

/// The whole document.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct CompareDocument {
    /// `trueness/compare/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// Files read: the measured one, then the references in the order given.
    pub inputs: Vec<InputRecord>,
    /// What was compared.
    pub measured: Measured,
    /// How the measured was brought to the first reference; absent where it was compared as it lies.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub alignment: Option<AlignedTo>,
    /// How distances were computed: `exact` or `paper`.
    pub method: Word<Method>,
    /// The sign method; with several references, what holds for all of them (see each comparison for its own).
    pub sign: SignRecord,
    /// Points farther than this are excluded, millimeters.
    pub max_distance: Option<f64>,
    /// Points whose closest place lies on a boundary edge are excluded.
    pub skip_boundary: bool,
    /// Only points count whose normals are within this angle of that of the reference, radians; absent where all count.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub facing: Option<f64>,
    /// One entry a reference, in the order given.
    pub comparisons: Vec<Comparison>,
    /// Every pair of references on the same points, the better one first; empty with one reference.
    pub paired: Vec<Paired>,
    /// The color scale that all comparisons share.
    pub scale: Scale,
    /// The worst of the comparisons' verdicts: what table, page and exit status go by. Without a tolerance it is absent, unless the
    /// alignment cannot be relied on.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub verdict: Option<Verdict>,
    /// Why it is not a pass: the reasons of the comparisons that have this verdict.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub verdict_reasons: Vec<VerdictReason>,
    /// How many of the points a report shows.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub sampling: Option<Sampling>,
    /// Seed of everything random.
    pub seed: u64,
}

/// What was measured.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Measured {
    /// `points`, `vertices` (of a mesh) or `samples` (of a mesh's surface).
    pub kind: Word<MeasuredKind>,
    /// Their number.
    pub count: u64,
    /// Their box.
    pub bounds: Option<Bounds>,
}

/// How the sign of the deviations was found.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SignRecord {
    /// What was asked for: `auto`, `pseudonormal`, `winding` or `none`.
    pub requested: String,
    /// What was used: `pseudonormal`, `winding`, `normal` (of B-spline surfaces), `none`, or `several` when references differ.
    pub method: Word<SignBy>,
    /// Why that one.
    pub reason: String,
    /// Share of the sampled points whose sign the two methods disagree on (0 to 1).
    pub disagreement: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub disagreement_reason: Option<String>,
    /// Points in that sample.
    pub sample: u64,
}

/// Deviations from one reference.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Comparison {
    /// Path of the reference.
    pub reference: String,
    /// 1 for the reference with the least root mean square; equal for equal values.
    pub rank: u32,
    /// What makes it unlikely that measured and reference belong together as they lie.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub warnings: Vec<Warning>,
    /// Of a reference that is not a mesh but B-spline surfaces; absent for meshes.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub surfaces: Option<SurfacesRecord>,
    /// Along what lines the deviations are; absent where they are to the nearest place.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub along: Option<AlongRecord>,
    /// How the sign was found here.
    pub sign: SignRecord,
    /// Whether the statistics rest on a sound mesh; of B-spline surfaces, which have no facets that could be wrong, `sound`.
    pub soundness: Soundness,
    /// Statistics of the deviations: all, those above zero, those below zero.
    pub deviation: BySide,
    /// Points left out, by reason: `max_distance`, `free_edge`; with `--facing` also `facing`, with `--outliers` `outlier`, with
    /// `--along` `no_crossing` (the line meets nothing) and, for normals, `no_direction`.
    pub excluded: BTreeMap<String, u64>,
    /// The rule for outliers and what it gave here; absent without one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub outliers: Option<OutliersRecord>,
    /// What part of the reference no measured point covers, nor a large facet of a measured mesh; with a tolerance, with `--coverage` and
    /// with a report.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub coverage: Option<CoverageRecord>,
    /// Places between the vertices of the measured mesh that are out of tolerance; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub between_vertices: Option<BetweenRecord>,
    /// Shares against the tolerance; absent without one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub tolerance: Option<ToleranceShares>,
    /// Parts of the reference with tolerances of their own; `tolerance` is then of the points of no region.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub regions: Vec<RegionRecord>,
    /// Pass when the share inside reaches what was asked, in every region too, and enough of the reference is covered. Undecided where the
    /// values cannot be relied on, and where nothing fails but not enough was measured. Without a tolerance it is absent, unless the
    /// alignment cannot be relied on.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub verdict: Option<Verdict>,
    /// Why it is not a pass.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub verdict_reasons: Vec<VerdictReason>,
    /// The verdict on all points of no region; absent where there are no regions, or no tolerance for these points.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub others_verdict: Option<Verdict>,
    /// Counts of the deviations; absent when there are none.
    pub histogram: Option<Histogram>,
    /// The lowest deviation of all that count, and its point; absent where none counts.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub lowest: Option<ExtremeRecord>,
    /// The highest one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub highest: Option<ExtremeRecord>,
    /// The worst places, far from one another, on both sides: the farthest beyond the tolerance first, without a tolerance
    /// the greatest deviation.
    pub worst: Vec<Worst>,
    /// Deviations of each face of a CAD model that has points, in the order of the model; absent for other references.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub faces: Vec<FaceDeviation>,
    /// The same question asked from the reference's vertices to the measured mesh; only with `--both`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reverse: Option<Reverse>,
    /// How the paper's method differs from the exact distance; only with `--method paper`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub paper_vs_exact: Option<PaperVsExact>,
    /// Intervals, tests and models; only with `--research`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub research: Option<Research>,
}

/// Along what lines deviations are: distances to the nearest crossing of a line through the point with the reference, ahead or
/// behind; the sign is that of the nearest place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AlongRecord {
    /// `direction`: the same for all points; `reference`: the reference's normal at the nearest place; `measured`: each point's own
    /// normal.
    pub kind: Word<AlongKind>,
    /// The direction, as it was given.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub direction: Option<[f64; 3]>,
}

/// A part of the reference with a tolerance of its own. A point belongs to the first region that has its place on the reference.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct RegionRecord {
    /// Its name.
    pub id: String,
    /// Statistics of its points' deviations.
    pub deviation: Statistics,
    /// Shares of its points against its tolerance.
    pub tolerance: ToleranceShares,
    /// Pass when the share inside reaches what was asked; `not_measured` without points; `undecided` where the values cannot be relied on.
    pub verdict: Verdict,
}

/// Which points were left out as outliers. The limits belong to what counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OutliersRecord {
    /// The rule: `mad:K`, farther than K times 1.4826 MAD from the median, or `Ksigma`, farther than K standard deviations from
    /// the mean; of the deviations that nothing else excludes.
    pub rule: String,
    /// Median or mean, millimeters.
    pub center: Option<f64>,
    /// 1.4826 MAD or standard deviation, millimeters.
    pub spread: Option<f64>,
    /// Least deviation that counts, millimeters.
    pub lower: Option<f64>,
    /// Greatest deviation that counts, millimeters.
    pub upper: Option<f64>,
    /// Why the rule gives no limits, and left out nothing.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub limits_reason: Option<String>,
    /// Points left out by it.
    pub count: u64,
}

/// What part of a reference no measured point covers. A piece of it counts as covered if all its corners have the nearest place of
/// a point that counts within the reach.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CoverageRecord {
    /// Area of the reference, square millimeters.
    pub area: f64,
    /// Area that is not covered, gray in the map, square millimeters.
    pub uncovered: f64,
    /// Its share of the area (0 to 1).
    pub uncovered_share: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub uncovered_share_reason: Option<String>,
    /// The share that must be covered for a pass (0 to 1); absent without a tolerance.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub required: Option<f64>,
    /// Within what distance a point covers, millimeters.
    pub reach: f64,
    /// How far the points' nearest places lie apart, millimeters.
    pub spacing: f64,
    /// Places on large facets of the measured mesh, between its vertices, that count here and in the map, and in no statistics.
    #[serde(skip_serializing_if = "none", default)]
    pub between: u64,
}

/// Places on large facets of the measured mesh, between its vertices. They are in no statistics, but what passes must keep its tolerance there
/// too: a facet across a bore that was not made has its corners on the part.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BetweenRecord {
    /// Places that count, evenly spread.
    pub places: u64,
    /// Those out of tolerance.
    pub beyond: u64,
    /// The deviation of the worst, millimeters.
    pub deviation: f64,
    /// Where it is.
    pub point: [f64; 3],
}

fn none(count: &u64) -> bool {
    *count == 0
}

/// Something that makes the deviations doubtful, although each is computed right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Warning {
    /// What was noticed.
    pub kind: WarningKind,
    /// The number that it was noticed by.
    pub value: f64,
    /// The same in words.
    pub text: String,
}

/// What can be noticed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WarningKind {
    /// The sizes of measured and reference stand in a ratio as two units do. `value`: diagonal of the measured box over
    /// that of the reference.
    SizeRatio,
    /// Their boxes hardly overlap. `value`: the common share of the smaller box, both widened by a margin.
    HardlyOverlapping,
}

/// B-spline surfaces as a reference: distances are those from the surfaces themselves.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SurfacesRecord {
    /// Their number.
    pub count: u64,
    /// Points for which a nearer place by more than a billionth of the surfaces' size is not excluded, as around the center of a
    /// sphere.
    pub uncertain: u64,
    /// How far the facets that draw them may be from the surfaces, millimeters. No number rests on them but those of `--both` and
    /// of the alignment.
    pub drawn_within: f64,
}

/// Whether a reference is a sound mesh: the precondition of the statistics.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Soundness {
    /// Two facets at every edge, a closed fan at every vertex, no coincident facets, all facing outward.
    pub sound: bool,
    /// No boundary edge.
    pub closed: bool,
    /// Neighbors agree on which side is outside.
    pub consistently_oriented: bool,
    /// The enclosed volume is positive.
    pub outward: bool,
    /// Parts connected through edges.
    pub shells: u64,
    /// Edges with one facet.
    pub boundary_edges: u64,
    /// Edges with more than two.
    pub non_manifold_edges: u64,
    /// Vertices whose facets are no single fan.
    pub non_manifold_vertices: u64,
    /// Facets on the same three vertices as an earlier one.
    pub duplicate_facets: u64,
    /// Facets with a repeated vertex or all corners on one line; they break no rule.
    pub degenerate_facets: u64,
    /// Facets with a coordinate that is not finite, left out.
    pub not_finite_facets: u64,
    /// Edges that both neighbors pass in the same direction.
    pub inconsistent_edges: u64,
    /// What breaks the rule, by kind and with its places, as the document of the check has it; empty where the mesh is
    /// sound. Self-intersections are not looked for.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub findings: BTreeMap<String, Defects>,
}

/// Shares of the points against the tolerance (0 to 1); the limits belong to the zone.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ToleranceShares {
    /// Lower limit, millimeters.
    pub lower: f64,
    /// Upper limit, millimeters.
    pub upper: f64,
    /// Share within.
    pub inside: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub inside_reason: Option<String>,
    /// Share above the upper limit.
    pub above: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub above_reason: Option<String>,
    /// Share below the lower limit.
    pub below: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub below_reason: Option<String>,
    /// The share inside that was asked for.
    pub required: f64,
}

impl ResultDocument for CompareDocument {
    /// Whether nothing speaks against it: the verdict is a pass, or none was asked for and the alignment can be relied on.
    fn conforms(&self) -> bool {
        self.verdict.is_none_or(|verdict| verdict == Verdict::Pass)
    }
}

impl CoverageRecord {
    /// Share of the reference that is covered (0 to 1).
    pub fn covered_share(&self) -> Option<f64> {
        self.uncovered_share.map(|share| 1.0 - share)
    }
}

impl ToleranceShares {
    /// Whether the share inside is what was asked for; `None` where there is no share.
    pub fn verdict(&self) -> Option<Verdict> {
        let of = |share| if share >= self.required { Verdict::Pass } else { Verdict::Fail };
        self.inside.map(of)
    }
}

/// A measured point with its deviation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ExtremeRecord {
    /// Number of the point, from 0 in file order.
    pub index: u64,
    /// The point, where it was compared.
    pub point: [f64; 3],
    /// Its deviation, millimeters.
    pub deviation: f64,
}

/// One of the worst places.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Worst {
    /// `1` above, `-1` below.
    pub sign: i8,
    /// Number of the measured point, from 0 in file order.
    pub index: u64,
    /// The measured point.
    pub point: [f64; 3],
    /// The nearest place on the reference, or where its line meets it.
    pub nearest: [f64; 3],
    /// Unit normal of the reference there; null on a facet without area.
    pub normal: Option<[f64; 3]>,
    /// The deviation, millimeters.
    pub deviation: f64,
    /// The region that it belongs to, if one does.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub region: Option<String>,
}

/// From the reference to the measured mesh, and both directions together.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Reverse {
    /// Unsigned distances of the reference's vertices (or samples) from the measured mesh.
    pub deviation: Statistics,
    /// The greater of the two greatest distances.
    pub hausdorff: Option<f64>,
    /// Mean of the two mean distances.
    pub mean: Option<f64>,
}

/// The paper's method beside the exact distance, over the points that have both.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PaperVsExact {
    /// Points compared.
    pub count: u64,
    /// Points whose values differ by more than rounding.
    pub differing: u64,
    /// Of those, points where the paper's value is too small.
    pub too_small: u64,
    /// Largest difference, millimeters.
    pub max_difference: f64,
    /// Median difference where they differ, millimeters.
    pub median_difference: Option<f64>,
}

/// The difference `|d| to the first − |d| to the second`, point by point.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Paired {
    /// Number of the better reference (0-based, in the order given).
    pub better: usize,
    /// Number of the other.
    pub other: usize,
    /// Points compared.
    pub count: u64,
    /// Points that tell as much as an independent one, as the differences of neighbors go together.
    #[serde(default)]
    pub points_per_independent: Option<f64>,
    /// Why that is not told: intervals and p values are those of independent points.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub points_per_independent_reason: Option<String>,
    /// Mean difference; negative where the better one is nearer.
    pub mean_difference: Option<f64>,
    /// Its 95 % confidence interval.
    pub interval: Option<[f64; 2]>,
    /// Standard deviation of the differences.
    pub std_dev: Option<f64>,
    /// Two-sided p value of the mean difference being zero (Student).
    pub p_value: Option<f64>,
    /// Two-sided p value of Wilcoxon's signed-rank test.
    pub wilcoxon_p_value: Option<f64>,
    /// Why numbers are missing.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
}

/// What a report shows of all points.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Sampling {
    /// Points drawn.
    pub shown: u64,
    /// Points measured; every number is from all of them.
    pub total: u64,
}

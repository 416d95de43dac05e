//! `trueness/section/1`: the lines, arcs and curves of sections, and where they join.

mod airfoil;
mod chord;
mod dimension;
mod doubts;
mod fitted;
mod frame;
mod methods;
mod near_arc;
mod nominal;
mod outline;
mod profile;
mod segment;
mod tidy;
mod verdict;
mod vocabulary;

pub use airfoil::{AirfoilMeasures, AirfoilRecord};
pub use chord::{ChordBy, ChordRecord, LeanRecord, StackingRecord};
pub use dimension::{DimensionRecord, DimensionsRecord, MemberRecord};
pub use doubts::{NominalWarning, NominalWarningKind};
pub use fitted::FitRecord;
pub use frame::FrameRecord;
pub use methods::{MethodRecord, MethodsRecord, ResidualsRecord};
pub use near_arc::NearArc;
pub use nominal::{BEYOND_END, MAX_DISTANCE, NO_OUTLINE, NominalRecord, Positive};
pub use outline::OutlineRecord;
pub use profile::{ProfileRecord, WorstRecord};
pub use segment::{GeometryRecord, SegmentRecord, UncertaintyRecord};
pub use tidy::OfferRecord;
pub use verdict::ProfileRule;
pub use vocabulary::{Continuity, DimensionKind, OfferKind, Taken};

use super::result::ResultDocument;
use super::{InputRecord, SharedNoise, Verdict, Word};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/section/1";

/// The whole document. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SectionDocument {
    /// `trueness/section/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// Confidence of the intervals.
    pub level: f64,
    /// Standard deviation of the points across the contour, where it was given.
    pub noise_given: Option<f64>,
    /// The noise of a mesh's vertices, and how far neighbors share it: of contours taken from a scan's facets the search and the
    /// uncertainties take it into account.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shared_noise: Option<SharedNoise>,
    /// Why none is told.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shared_noise_reason: Option<String>,
    /// Continuity of all joins, where it was asked for: `g0`, `g1` or `g2`.
    pub continuity_given: Option<Word<Continuity>>,
    /// Where the plane of the section lies in space; of several, the first.
    pub frame: FrameRecord,
    /// The planes that a mesh or cloud was cut by; of points in order none.
    pub planes: Vec<PlaneRecord>,
    /// The contours.
    pub contours: Vec<ContourRecord>,
    /// Angles, widths, distances of centers and gaps between segments; lengths and radii stand with the segments.
    pub dimensions: DimensionsRecord,
    /// Chord, camber, thickness and edges of each contour, where they were asked for.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub airfoils: Option<Vec<AirfoilRecord>>,
    /// How the stacking points of the profiles lean from plane to plane: of parallel planes with one profile each.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub lean: Option<LeanRecord>,
    /// How the points differ from the section of a nominal, where one was given.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub nominal: Option<NominalRecord>,
    /// The three methods of the paper, side by side, where one was asked for; the contour is that of the one chosen.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub methods: Option<MethodsRecord>,
}

/// A plane that a mesh or cloud was cut by: all places `p` with `normal · p = offset`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PlaneRecord {
    /// Its normal, of length 1.
    pub normal: [f64; 3],
    /// Its distance from the origin along the normal.
    pub offset: f64,
    /// Its axes.
    pub frame: FrameRecord,
    /// Contours found in it.
    pub contours: u64,
    /// Area inside closed contours of a mesh, holes taken off, of the facets themselves. What shells share counts once for each of them.
    pub area: Option<f64>,
    /// Why there is no area.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub area_reason: Option<String>,
    /// Points of a cloud in its slab that belong to no contour.
    pub loose: u64,
    /// Contours of a cloud go on over gaps up to this: the one given, or told from how uneven the points lie.
    pub gap: Option<f64>,
    /// What may help where contours of a cloud are suspiciously many.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub hint: Option<String>,
    /// Whether the points of a cloud in its slab fill an area, so that there are no contours; `hint` says so.
    #[serde(skip_serializing_if = "is_false", default)]
    pub fills_area: bool,
}

/// A contour.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ContourRecord {
    /// Number of its plane in `planes`, from 0; of points in order `null`.
    pub plane: Option<u64>,
    /// What its points were taken for: `row` (measured points), `facets` (exact ones, of a drawing), `scan` (facets of a scan).
    pub taken: Word<Taken>,
    /// Whether its end is its start.
    pub closed: bool,
    /// Length of all segments.
    pub length: f64,
    /// Standard deviation of the points about it; of `facets`, which carry no noise, the root mean square of their distances from it.
    pub noise: f64,
    /// Mean distance between neighboring points.
    pub spacing: f64,
    /// Points given.
    pub points: u64,
    /// The segments in the order of the points.
    pub segments: Vec<SegmentRecord>,
    /// The joins: number `i` between segments `i` and `i + 1`, of a closed contour the last between the last and the first.
    pub joins: Vec<JoinRecord>,
    /// Why there is no join.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub joins_reason: Option<String>,
    /// Points left out as outliers, by their numbers from 0.
    pub outliers: Vec<u64>,
    /// Crossings of a scan's edges, by their numbers from 0, where its facets pass a corner of the part by: they belong to no segment.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub bevels: Vec<u64>,
    /// Points that repeat the one before, by their numbers; they were left out.
    pub repeated: Vec<u64>,
    /// Gaps: the number of the point before.
    pub gaps: Vec<u64>,
    /// Where the contour crosses itself, at most a hundred places: a closed one that does has no inside.
    #[serde(default)]
    pub crossings: Vec<[f64; 2]>,
    /// Segments, by their numbers from 0, that do not run along their points and tell nothing of the part; with any, the exit
    /// status is 1.
    #[serde(default)]
    pub astray: Vec<u64>,
    /// What makes the contour doubtful, each with what may help: points that may be strays, walls too thin to be told apart. With any, the
    /// exit status is 1.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub doubts: Vec<String>,
    /// What to heed about it, each with what may help: points of a row off their plane, a noise given that they contradict, radii that the
    /// thickness of a slab moves.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub hints: Vec<String>,
    /// What a drawing would have, as offers that the points allow, where they were asked for. None of them is put into the contour.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub tidy: Option<Vec<OfferRecord>>,
    /// Why there are no offers.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub tidy_reason: Option<String>,
    /// Signed distance of each point from the contour, positive to the left.
    pub residuals: Vec<f64>,
    /// Number of the segment of each point.
    pub labels: Vec<u32>,
    /// Length along the contour from the start of the first segment to the foot of each point.
    pub stations: Vec<f64>,
}

/// A join.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct JoinRecord {
    /// The place.
    pub point: [f64; 2],
    /// The same place in space.
    pub position: [f64; 3],
    /// `g0` (a corner), `g1` (a common tangent) or `g2` (and, as far as the data can tell, a common curvature).
    pub continuity: Word<Continuity>,
    /// The join lies between these two places, at the confidence `level`.
    pub interval: [[f64; 2]; 2],
    /// Standard uncertainty along the contour; of a corner, the greatest of any direction.
    pub std_uncertainty: f64,
    /// Whether the data allow the join beyond an end of the interval, which was not followed farther.
    pub interval_open: [bool; 2],
    /// Angle of the corner, positive to the left; 0 of a tangent join.
    pub turn: f64,
}

fn is_false(flag: &bool) -> bool {
    !flag
}

impl ResultDocument for SectionDocument {
    /// Whether all contours are beyond doubt, and the profile keeps its tolerance, where it has one.
    fn conforms(&self) -> bool {
        let doubtful = self.contours.iter().any(|c| !c.astray.is_empty() || !c.doubts.is_empty())
            || self.planes.iter().any(|plane| plane.fills_area);
        let judged = self.nominal.as_ref().and_then(|nominal| nominal.verdict);
        !doubtful && judged.is_none_or(|verdict| verdict == Verdict::Pass)
    }
}

impl ContourRecord {
    /// Whether a point belongs to no segment.
    pub fn is_left_out(&self, point: usize) -> bool {
        [&self.outliers, &self.bevels].iter().any(|list| list.binary_search(&(point as u64)).is_ok())
    }
}

impl SectionDocument {
    /// Where a plane lies; `None` is that of points in order.
    pub fn frame_in(&self, plane: Option<u64>) -> &FrameRecord {
        let plane = plane.and_then(|n| self.planes.get(n as usize));
        plane.map_or(&self.frame, |p| &p.frame)
    }
}

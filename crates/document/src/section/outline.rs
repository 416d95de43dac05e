//! What sections are measured against: the outlines of a nominal, and how much of each was measured.

use super::segment::SegmentRecord;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An outline of a nominal. Documents do not hold its lines, arcs and curves, which may be far more than those of the contours; a report
/// draws them.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct OutlineRecord {
    /// Number of its plane in `planes`, from 0; of points in order `null`.
    pub plane: Option<u64>,
    /// Whether its end is its start.
    pub closed: bool,
    /// Whether the material is outside of it.
    pub hole: bool,
    /// Its length.
    pub length: f64,
    /// Middle of the box around it.
    pub center: [f64; 2],
    /// Width and height of that.
    pub size: [f64; 2],
    /// Points that are nearest to it.
    pub points: u64,
    /// Share of its length that successive points run along, from 0 to 1; 0: it was not measured.
    pub covered: f64,
    /// Its lines, arcs and curves.
    #[serde(skip)]
    pub drawn: Vec<SegmentRecord>,
    /// Where points run along it: lengths from its start, in ascending order.
    #[serde(skip)]
    pub measured: Vec<[f64; 2]>,
}

/// So much of an outline counts as all of it: points of open rows end beside its ends.
const WHOLE_OUTLINE_SHARE: f64 = 0.98;

impl OutlineRecord {
    /// Whether it was not measured as a whole.
    pub fn lacks(&self) -> bool {
        self.covered < WHOLE_OUTLINE_SHARE
    }
}

//! The chord by each of its usual definitions, stacking points, lean.

use crate::Word;
use crate::word::named;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a chord is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChordBy {
    /// Between the two places that are farthest from each other.
    Farthest,
    /// Between the ends of the camber line, led on to the profile.
    CamberEnds,
    /// The extent along the flat tangent, which touches the hollow side at two places.
    Bitangent,
}

impl ChordBy {
    /// All of them.
    pub const ALL: [ChordBy; 3] = [ChordBy::Farthest, ChordBy::CamberEnds, ChordBy::Bitangent];

    /// The word for it: `farthest`, `camber_ends`, `bitangent`.
    pub fn name(self) -> &'static str {
        match self {
            ChordBy::Farthest => "farthest",
            ChordBy::CamberEnds => "camber_ends",
            ChordBy::Bitangent => "bitangent",
        }
    }
}

named!(ChordBy, "chord", Self::ALL, |by| by.name());

/// A chord.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ChordRecord {
    /// `farthest`: between the two places of the profile that are farthest from each other; `camber_ends`: between the ends of the camber
    /// line, led on to the profile; `bitangent`: the extent along the flat tangent, the line that touches the hollow side at two places.
    pub definition: Word<ChordBy>,
    /// Its end at the leading edge.
    pub leading: Option<[f64; 2]>,
    /// Its end at the trailing edge.
    pub trailing: Option<[f64; 2]>,
    /// Its length.
    pub length: Option<f64>,
    /// Angle of the way from leading to trailing edge with the first axis, radians.
    pub angle: Option<f64>,
    /// Why there is no such chord.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub length_reason: Option<String>,
    /// Twist: by how much its angle is greater than that of the nominal's chord of the same definition, radians.
    pub twist: Option<f64>,
    /// Why there is no twist.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub twist_reason: Option<String>,
}

/// Where a profile is, against where it should be.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct StackingRecord {
    /// The stacking point: the one given, or the centroid of the nominal's profile.
    pub point: [f64; 2],
    /// `given` or `centroid`.
    pub by: String,
    /// How far the profile's own stacking point is from it. With a nominal it goes with the profile as centroid and twist (of the chord between
    /// the farthest places) say; without one it is the centroid.
    pub offset: [f64; 2],
    /// The same along the profile's farthest chord, positive toward the trailing edge.
    pub along_chord: f64,
    /// The same across it, positive to its left.
    pub across_chord: f64,
}

/// How the offsets of the stacking points grow from plane to plane.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct LeanRecord {
    /// Angles by which the stacking line leans toward the first and the second axis of the planes, radians: of the line of least squares.
    pub lean: [f64; 2],
    /// Greatest distance of an offset from that line.
    pub greatest: f64,
    /// Planes that it is of.
    pub planes: u64,
}

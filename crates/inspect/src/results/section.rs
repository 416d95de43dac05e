//! `trueness/section/1`: the lines, arcs and curves of sections, and where they join.

use super::{InputRecord, UNITS, VERSION};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_geom::section::{Contour, Geometry, Options, Segment};

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/section/1";

/// The whole document. Lengths in millimetres, angles in radians.
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
    /// Continuity of all joins, where it was asked for: `g0`, `g1` or `g2`.
    pub continuity_given: Option<String>,
    /// Where the plane of the section lies in space.
    pub frame: FrameRecord,
    /// The contours.
    pub contours: Vec<ContourRecord>,
}

/// The plane of a section: a place of it and the directions of its two axes.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FrameRecord {
    /// The place with the coordinates 0, 0.
    pub origin: [f64; 3],
    /// Direction of the first axis.
    pub x: [f64; 3],
    /// Direction of the second axis.
    pub y: [f64; 3],
    /// Greatest distance of a point from the plane.
    pub flatness: f64,
}

/// A contour.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ContourRecord {
    /// Whether its end is its start.
    pub closed: bool,
    /// Length of all segments.
    pub length: f64,
    /// Standard deviation of the points about it.
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
    /// Points that repeat the one before, by their numbers; they were left out.
    pub repeated: Vec<u64>,
    /// Gaps: the number of the point before.
    pub gaps: Vec<u64>,
    /// Signed distance of each point from the contour, positive to the left.
    pub residuals: Vec<f64>,
    /// Number of the segment of each point.
    pub labels: Vec<u32>,
}

/// A segment.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SegmentRecord {
    /// Line, arc or spline, with what it is known by.
    #[serde(flatten)]
    pub geometry: GeometryRecord,
    /// Where it starts.
    pub start: [f64; 2],
    /// Where it ends.
    pub end: [f64; 2],
    /// Its length.
    pub length: f64,
    /// Points that belong to it.
    pub count: u64,
    /// Root mean square of their distances.
    pub rms: f64,
    /// Greatest magnitude of their distances.
    pub max: f64,
    /// Curvature at its start and end, positive where it turns to the left.
    pub curvature: [f64; 2],
}

/// What a segment is.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum GeometryRecord {
    /// From its start straight to its end.
    Line {
        /// Angle of its direction with the first axis.
        angle: f64,
    },
    /// Part of a circle.
    Arc {
        /// Center of the circle.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
        /// Angle of the start, seen from the center.
        start_angle: f64,
        /// Angle run through, positive counter-clockwise.
        sweep: f64,
    },
    /// A B-spline.
    Spline {
        /// Its degree.
        degree: u64,
        /// Its knots, the ends `degree + 1` times.
        knots: Vec<f64>,
        /// Its control points.
        control_points: Vec<[f64; 2]>,
        /// Greatest distance from the curve that was fitted.
        deviation: f64,
    },
}

/// A join.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct JoinRecord {
    /// The place.
    pub point: [f64; 2],
    /// The same place in space.
    pub position: [f64; 3],
    /// `g0` (a corner), `g1` (a common tangent) or `g2` (and, as far as the data can tell, a common curvature).
    pub continuity: String,
    /// The join lies between these two places, at the confidence `level`.
    pub interval: [[f64; 2]; 2],
    /// Standard uncertainty along the contour; of a corner, the greatest of any direction.
    pub std_uncertainty: f64,
    /// Whether the data allow the join beyond an end of the interval, which was not followed farther.
    pub interval_open: [bool; 2],
    /// Angle of the corner, positive to the left; 0 of a tangent join.
    pub turn: f64,
}

impl FrameRecord {
    /// A place of the plane, in space.
    pub fn place(&self, p: [f64; 2]) -> [f64; 3] {
        std::array::from_fn(|k| self.origin[k] + p[0] * self.x[k] + p[1] * self.y[k])
    }
}

impl SectionDocument {
    /// The document of the contours found in the file of `inputs`.
    pub fn new(
        contours: &[Contour],
        frame: FrameRecord,
        inputs: Vec<InputRecord>,
        options: &Options,
    ) -> SectionDocument {
        SectionDocument {
            schema: SCHEMA.into(),
            version: VERSION.into(),
            units: UNITS.into(),
            inputs,
            level: options.level,
            noise_given: options.noise,
            continuity_given: options.continuity.map(|c| c.name().into()),
            frame,
            contours: contours.iter().map(|c| contour(c, &frame)).collect(),
        }
    }
}

fn contour(found: &Contour, frame: &FrameRecord) -> ContourRecord {
    let numbers = |list: &[usize]| list.iter().map(|i| *i as u64).collect();
    let joins: Vec<JoinRecord> = found
        .joins
        .iter()
        .map(|join| JoinRecord {
            point: join.point,
            position: frame.place(join.point),
            continuity: join.continuity.name().into(),
            interval: join.interval,
            std_uncertainty: join.uncertainty,
            interval_open: join.open,
            turn: join.turn,
        })
        .collect();
    let reason = match &found.segments[..] {
        [one] if one.geometry.kind() != trueness_geom::section::Kind::Line => {
            Some("one segment fits all points; no line segment found")
        }
        [_] => Some("one line fits all points"),
        _ => None,
    };
    ContourRecord {
        closed: found.closed,
        length: found.length(),
        noise: found.noise,
        spacing: found.spacing,
        points: found.labels.len() as u64,
        segments: found.segments.iter().map(segment).collect(),
        joins,
        joins_reason: reason.map(Into::into),
        outliers: numbers(&found.outliers),
        repeated: numbers(&found.repeated),
        gaps: numbers(&found.gaps),
        residuals: found.residuals.clone(),
        labels: found.labels.clone(),
    }
}

fn segment(found: &Segment) -> SegmentRecord {
    let (start, end) = (found.start, found.end);
    let geometry = match &found.geometry {
        Geometry::Line => GeometryRecord::Line { angle: found.angle() },
        Geometry::Arc { center, radius, start, sweep } => {
            GeometryRecord::Arc { center: *center, radius: *radius, start_angle: *start, sweep: *sweep }
        }
        Geometry::Spline { curve, deviation } => GeometryRecord::Spline {
            degree: curve.knots().degree() as u64,
            knots: curve.knots().values().to_vec(),
            control_points: curve.points().to_vec(),
            deviation: *deviation,
        },
    };
    SegmentRecord {
        geometry,
        start,
        end,
        length: found.length,
        count: found.count as u64,
        rms: found.rms,
        max: found.max,
        curvature: found.curvature,
    }
}

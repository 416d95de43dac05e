//! A contour and its parts.

use super::chain::SegmentKind;
use trueness_geom::spline::curve::Curve;

/// The line, arc or curve of a segment.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// From the segment's start to its end.
    Line,
    /// Part of a circle; a whole one where the sweep is a whole turn.
    Arc {
        /// Center of the circle.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
        /// Angle of the start, seen from the center.
        start: f64,
        /// Angle run through, positive counter-clockwise.
        sweep: f64,
    },
    /// A cubic B-spline that keeps within `deviation` of the curve found.
    Spline {
        /// The curve; its parameter runs from 0 to 1.
        curve: Curve<[f64; 2]>,
        /// Greatest distance from the curve whose curvature was fitted.
        deviation: f64,
    },
}

impl Geometry {
    /// Line, arc or spline.
    pub fn kind(&self) -> SegmentKind {
        match self {
            Geometry::Line => SegmentKind::Line,
            Geometry::Arc { .. } => SegmentKind::Arc,
            Geometry::Spline { .. } => SegmentKind::Spline,
        }
    }
}

/// Standard uncertainties of a segment's parameters, from the scatter of the points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Uncertainty {
    /// Uncertainties of a line.
    Line {
        /// Deviation of the angle of its direction, radians.
        angle: f64,
    },
    /// Uncertainties of an arc.
    Arc {
        /// Deviation of the coordinates of its center.
        center: [f64; 2],
        /// Deviation of its radius.
        radius: f64,
    },
}

impl Uncertainty {
    /// All of them so many times as large.
    pub(crate) fn times(self, factor: f64) -> Uncertainty {
        match self {
            Uncertainty::Line { angle } => Uncertainty::Line { angle: factor * angle },
            Uncertainty::Arc { center, radius } => {
                Uncertainty::Arc { center: center.map(|x| factor * x), radius: factor * radius }
            }
        }
    }
}

/// A segment of a contour.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Its line, arc or curve.
    pub geometry: Geometry,
    /// Where it starts: at a join, or at the foot of the first point.
    pub start: [f64; 2],
    /// Where it ends.
    pub end: [f64; 2],
    /// Length along it.
    pub length: f64,
    /// Number of points that belong to it.
    pub count: usize,
    /// Root mean square of their distances.
    pub rms: f64,
    /// Greatest magnitude of their distances.
    pub max: f64,
    /// Curvature at its start and end, positive where it turns to the left.
    pub curvature: [f64; 2],
    /// How well the points determine the line or arc; `None` of a spline, of exact facets, and where the points hardly
    /// determine it.
    pub uncertainty: Option<Uncertainty>,
    /// Standard uncertainty of its length; `None` of exact facets, where an end is that of the row, and where the points hardly
    /// determine it.
    pub length_uncertainty: Option<f64>,
}

/// Places of a drawn curve for each of its control points, by which its length is measured.
const DRAWN_PLACES_PER_CONTROL_POINT: usize = 16;
/// A curve drawn so many times as long as it is does not follow its piece.
const MAX_DRAWN_LENGTH_RATIO: f64 = 1.5;

impl Segment {
    /// Whether a free curve is drawn much longer than it is: it turns too fast for its points to hold it.
    pub(crate) fn is_overlong(&self) -> bool {
        let Geometry::Spline { curve, .. } = &self.geometry else { return false };
        let steps = DRAWN_PLACES_PER_CONTROL_POINT * curve.points().len();
        let (from, to) = curve.domain();
        let place = |i: usize| curve.at(from + (to - from) * i as f64 / steps as f64);
        let step = |i: usize| {
            let (a, b) = (place(i), place(i + 1));
            libm::hypot(b[0] - a[0], b[1] - a[1])
        };
        (0..steps).map(step).sum::<f64>() > MAX_DRAWN_LENGTH_RATIO * self.length
    }

    /// Distance of a point from the line or circle as it is drawn; 0 of a free curve.
    pub(crate) fn off_drawn(&self, p: [f64; 2]) -> f64 {
        match self.geometry {
            Geometry::Line => {
                let (a, b) = (self.start, self.end);
                let d = [b[0] - a[0], b[1] - a[1]];
                let length = libm::hypot(d[0], d[1]).max(f64::MIN_POSITIVE);
                ((d[0] * (p[1] - a[1]) - d[1] * (p[0] - a[0])) / length).abs()
            }
            Geometry::Arc { center, radius, .. } => {
                (libm::hypot(p[0] - center[0], p[1] - center[1]) - radius).abs()
            }
            Geometry::Spline { .. } => 0.0,
        }
    }

    /// How far beyond an end of the line or arc as it is drawn the foot of a point lies, along it. 0 for a free curve.
    pub(crate) fn ahead_of_drawn(&self, p: [f64; 2]) -> f64 {
        if self.geometry.kind() == SegmentKind::Spline {
            return 0.0;
        }
        let foot = self.nearest(p);
        if foot.share > 0.0 && foot.share < 1.0 {
            return 0.0;
        }
        let (d, along) = ([p[0] - foot.place[0], p[1] - foot.place[1]], foot.along);
        let size = libm::hypot(along[0], along[1]).max(f64::MIN_POSITIVE);
        ((d[0] * along[0] + d[1] * along[1]) / size).abs()
    }

    /// Angle of the direction from start to end with the first axis, radians.
    pub fn angle(&self) -> f64 {
        libm::atan2(self.end[1] - self.start[1], self.end[0] - self.start[0])
    }
}

/// How smoothly two segments join.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Continuity {
    /// At a corner.
    G0,
    /// With a common tangent.
    G1,
    /// With a common tangent and, as far as the data can tell, curvature.
    G2,
}

impl Continuity {
    /// All of them.
    pub const ALL: [Continuity; 3] = [Continuity::G0, Continuity::G1, Continuity::G2];

    /// The word for it: `g0`, `g1`, `g2`.
    pub fn name(self) -> &'static str {
        match self {
            Continuity::G0 => "g0",
            Continuity::G1 => "g1",
            Continuity::G2 => "g2",
        }
    }
}

/// Where two segments join.
#[derive(Clone, Debug, PartialEq)]
pub struct Join {
    /// The place.
    pub point: [f64; 2],
    /// How smoothly.
    pub continuity: Continuity,
    /// The join may lie between these two places, at the confidence asked for; of a corner, across its greatest uncertainty.
    pub interval: [[f64; 2]; 2],
    /// Standard uncertainty along the contour; of a corner, the greatest of any direction.
    pub uncertainty: f64,
    /// Whether the data allow the join beyond the interval's ends, which were not followed farther.
    pub open: [bool; 2],
    /// Angle of the corner, positive to the left; 0 of a tangent join.
    pub turn: f64,
}

/// The kind of row that the points of a contour are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RowKind {
    /// Measured points in order.
    #[default]
    Row,
    /// Where a plane cuts the exact facets of a drawing.
    Facets,
    /// Where a plane cuts the facets of a scan.
    Scan,
}

impl RowKind {
    /// All of them.
    pub const ALL: [RowKind; 3] = [RowKind::Row, RowKind::Facets, RowKind::Scan];

    /// The word for it: `row`, `facets`, `scan`.
    pub fn name(self) -> &'static str {
        match self {
            RowKind::Row => "row",
            RowKind::Facets => "facets",
            RowKind::Scan => "scan",
        }
    }
}

/// A contour as lines, arcs and curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contour {
    /// The kind of row that its points are.
    pub row_kind: RowKind,
    /// Whether the end is the start.
    pub closed: bool,
    /// Segments in the order of the points. The first segment of a closed contour is the one that the first point
    /// belongs to.
    pub segments: Vec<Segment>,
    /// The joins: number `i` between segments `i` and `i + 1`; of a closed contour the last between the last and the first.
    pub joins: Vec<Join>,
    /// Standard deviation of the points about the contour; of exact facets, which carry no noise, the root mean square of their distances
    /// from it.
    pub noise: f64,
    /// Number of unknowns that were found from the points; 0 of exact facets.
    pub unknowns: f64,
    /// Mean distance between neighboring points.
    pub spacing: f64,
    /// Segment that each point belongs to.
    pub labels: Vec<u32>,
    /// Signed distance of each point, positive to the left.
    pub residuals: Vec<f64>,
    /// Length along the contour from the start of the first segment to the foot of each point.
    pub stations: Vec<f64>,
    /// Points that were left out as outliers, by their numbers.
    pub outliers: Vec<usize>,
    /// Crossings of a scan's edges, by their numbers, where its facets pass a corner of the part by: they belong to no segment.
    pub bevels: Vec<usize>,
    /// Places of a scan's crossings on the surface that its facets stand for: those that residuals are of. Empty of other points.
    pub moved: Vec<[f64; 2]>,
    /// Independent points that the points tell as much as; 0 of exact facets.
    pub independent: f64,
    /// Points that may be strays, by their numbers. The step to them is many times as long as any other, and does not
    /// go straight on. They were kept.
    pub doubtful: Vec<usize>,
    /// Points as far from the rest of the row, by their numbers, that lie where the row leads straight on. They were kept.
    pub straight_on: Vec<usize>,
    /// Its few points may be the corners of a polygon, or of a curve, as well. They do not tell which of the two is
    /// meant.
    pub may_be_polygon: bool,
    /// Points of a cloud may be of both faces of a wall about so thick, which they do not tell apart.
    pub layered: Option<f64>,
    /// Points that repeat the one before, by their numbers; they were left out.
    pub repeated: Vec<usize>,
    /// Gaps along the contour between neighboring points of more than five times the median distance, outliers passed over: the number
    /// of the point before.
    pub gaps: Vec<usize>,
    /// Where the contour crosses itself: at most a hundred places. A closed one that does has no inside.
    pub crossings: Vec<[f64; 2]>,
    /// Segments that do not run along their points, by their numbers. They lie too far off, or are much longer or
    /// shorter than the way through the points. They tell nothing of the part.
    pub unreliable: Vec<usize>,
    /// The search for number and kinds of the segments took too long and ended before all was tried.
    pub cut_short: bool,
}

impl Contour {
    /// Root mean square distance of the points from the contour, outliers left out.
    pub(crate) fn rms(&self) -> f64 {
        let kept = self.residuals.iter().enumerate().filter(|(i, _)| self.outliers.binary_search(i).is_err());
        let (sum, count) = kept.fold((0.0, 0.0), |(sum, count), (_, r)| (sum + r * r, count + 1.0));
        (sum / f64::max(count, 1.0)).sqrt()
    }

    /// How many independent points those of a segment tell as much as: one at least.
    pub(crate) fn independent_of(&self, segment: usize) -> f64 {
        let counted = self.segments.iter().map(|s| s.count).sum::<usize>() as f64;
        let share = if self.independent > 0.0 { (self.independent / counted).min(1.0) } else { 1.0 };
        (share * self.segments[segment].count as f64).max(1.0)
    }
}

/// Options for a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Standard deviation of the points across the contour; found from the data where it is not given.
    pub noise: Option<f64>,
    /// Continuity of all joins; told from the data where it is not given.
    pub continuity: Option<Continuity>,
    /// Whether the contour is closed; told from the gap between the last and the first point where it is not given.
    pub closed: Option<bool>,
    /// Confidence of the intervals.
    pub level: f64,
    /// Distances below this are not told from 0, whatever the noise; a ten-thousandth of the spacing where it is not given.
    pub resolution: Option<f64>,
    /// The points are known to be in order: rows that do not look so are taken all the same.
    pub ordered: bool,
}

impl Default for Options {
    fn default() -> Options {
        Options { noise: None, continuity: None, closed: None, level: 0.95, resolution: None, ordered: false }
    }
}

/// Why there is no contour.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SectionError {
    /// Fewer than four different points.
    #[error("a section needs at least 4 different points, there are {found}")]
    TooFewPoints {
        /// Different points given.
        found: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is not a finite number; remove it")]
    NotFinite {
        /// Index of the first such point.
        index: usize,
    },
    /// The points do not follow each other along a contour.
    #[error(
        "the points are not in order along a contour: each is {ratio:.0} times as far from the next in the row as from \
         the nearest; sort them"
    )]
    Unordered {
        /// Median distance of neighbors in the row over that of nearest points.
        ratio: f64,
    },
    /// The row comes to the same places again.
    #[error(
        "most points lie where others do that do not follow them in the row: it runs along the contour more than once; give each place \
         once"
    )]
    PlacesAgain,
    /// Joins were to be tangent throughout, and no such curve runs along the points.
    #[error(
        "no curve whose joins are all tangent runs along the points: they have corners; leave --continuity out"
    )]
    Unreliable,
    /// Neither end of the row is a line that a curve follows.
    #[error(
        "no line segment found: neither end of the row is straight and goes on as a curve; leave --search and --interval out"
    )]
    NoLine,
    /// A plane without direction.
    #[error("the normal of the plane has no direction")]
    NoDirection,
    /// An option has no meaning.
    #[error("{name} {value}: it must be {allowed}")]
    WrongOption {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The values that are allowed.
        allowed: &'static str,
    },
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] trueness_geom::progress::Cancelled),
}

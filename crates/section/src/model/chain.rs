//! A chain of pieces that join with a common tangent, and where it runs.
//!
//! The chain is its curvature along its length: 0 on a line, constant on an arc, a B-spline on a free piece. So the joins
//! are tangent by construction. Its unknowns are the pose of its start, the lengths of the pieces and their curvatures.

use super::free::{self, Table};

/// The kind of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SegmentKind {
    /// Straight.
    Line,
    /// Part of a circle.
    Arc,
    /// Free: a spline.
    Spline,
}

impl SegmentKind {
    /// The word for it: `line`, `arc`, `spline`.
    pub fn name(self) -> &'static str {
        match self {
            SegmentKind::Line => "line",
            SegmentKind::Arc => "arc",
            SegmentKind::Spline => "spline",
        }
    }
}

/// A piece of a chain.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Piece {
    pub kind: SegmentKind,
    pub length: f64,
    /// None for a line, the curvature of an arc, the coefficients of the curvature of a free piece.
    pub coefficients: Vec<f64>,
}

impl Piece {
    pub fn line(length: f64) -> Piece {
        Piece { kind: SegmentKind::Line, length, coefficients: vec![] }
    }
    pub fn arc(length: f64, curvature: f64) -> Piece {
        Piece { kind: SegmentKind::Arc, length, coefficients: vec![curvature] }
    }
    /// Whether so many points let a free piece be any curve through them: its unknowns are its coefficients, where it starts and heads.
    pub fn is_loose(&self, points: usize) -> bool {
        self.kind == SegmentKind::Spline && self.coefficients.len() + 2 >= points
    }
    /// Curvature at the share `t` of its length.
    pub fn curvature(&self, t: f64) -> f64 {
        match self.kind {
            SegmentKind::Line => 0.0,
            SegmentKind::Arc => self.coefficients[0],
            SegmentKind::Spline => free::curvature(&self.coefficients, t),
        }
    }
}

/// Where a curve passes and which way it heads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub at: [f64; 2],
    /// Angle of its direction with the first axis, not reduced.
    pub heading: f64,
    /// The direction.
    pub along: [f64; 2],
}

impl Pose {
    pub fn new(at: [f64; 2], heading: f64) -> Pose {
        let (sin, cos) = libm::sincos(heading);
        Pose { at, heading, along: [cos, sin] }
    }
    /// To the left of its direction.
    pub fn normal(&self) -> [f64; 2] {
        [-self.along[1], self.along[0]]
    }
    /// A vector in this frame, seen from outside.
    pub fn out(&self, v: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.along;
        [c * v[0] - s * v[1], s * v[0] + c * v[1]]
    }
    /// A vector from outside, in this frame.
    pub fn into_frame(self, v: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.along;
        [c * v[0] + s * v[1], c * v[1] - s * v[0]]
    }
    /// A place of this frame, seen from outside.
    pub fn place(&self, p: [f64; 2]) -> [f64; 2] {
        let v = self.out(p);
        [self.at[0] + v[0], self.at[1] + v[1]]
    }
}

/// Chains of more pieces are searched by pieces near each other.
const MAX_PIECES_SEARCHED_WHOLE: usize = 16;

/// A chain of pieces.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chain {
    pub start: [f64; 2],
    pub heading: f64,
    pub pieces: Vec<Piece>,
    /// The end is the start, with the same tangent: the last piece joins the first.
    pub closed: bool,
    /// At joins of free pieces the curvature does not jump.
    pub even: bool,
    /// Where the chain is part of a longer one, the quantities that stay as they are at its ends.
    pub ends: Ends,
}

/// Quantities that stay as they are at the ends of a chain: by itself nothing does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Ends {
    /// The pose of the start does not move.
    pub start: bool,
    /// The pose in which it has to end.
    pub end: Option<Pose>,
}

impl Chain {
    /// Length from the start to the start of each piece, and of all.
    pub fn stations(&self) -> Vec<f64> {
        let mut sum = 0.0;
        let mut all = vec![0.0];
        for piece in &self.pieces {
            sum += piece.length;
            all.push(sum);
        }
        all
    }
    /// Whether it is searched by pieces near each other.
    pub fn is_long(&self) -> bool {
        self.pieces.len() > MAX_PIECES_SEARCHED_WHOLE
    }
    /// Number of joins.
    pub fn joins(&self) -> usize {
        self.pieces.len() - usize::from(!self.closed)
    }
    /// Curvature at a length from the start.
    pub fn curvature(&self, stations: &[f64], s: f64) -> f64 {
        let g = stations.partition_point(|x| *x <= s).clamp(1, self.pieces.len()) - 1;
        let piece = &self.pieces[g];
        piece.curvature(((s - stations[g]) / piece.length).clamp(0.0, 1.0))
    }
    /// Mean curvature over a part of it.
    pub fn mean_curvature(&self, stations: &[f64], from: f64, to: f64) -> f64 {
        (0..5).map(|i| self.curvature(stations, from + (to - from) * (f64::from(i) + 0.5) / 5.0)).sum::<f64>()
            / 5.0
    }
}

/// A chain laid out: the poses of its pieces, and the tables of the free ones.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    /// Start of each piece, then the end.
    pub poses: Vec<Pose>,
    /// Tables of free pieces; those of others are empty.
    pub tables: Vec<Table>,
}

impl Layout {
    /// Lays the chain out.
    pub fn fill(&mut self, chain: &Chain) {
        self.poses.clear();
        self.tables.resize_with(chain.pieces.len(), Table::default);
        let mut pose = Pose::new(chain.start, chain.heading);
        self.poses.push(pose);
        for (piece, table) in chain.pieces.iter().zip(&mut self.tables) {
            let (end, turn) = match piece.kind {
                SegmentKind::Line => ([piece.length, 0.0], 0.0),
                SegmentKind::Arc => {
                    let turn = piece.length * piece.coefficients[0];
                    (arc_end(piece.length, turn), turn)
                }
                SegmentKind::Spline => {
                    table.fill(&piece.coefficients, piece.length);
                    (table.end().at, table.turn)
                }
            };
            pose = Pose::new(pose.place(end), pose.heading + turn);
            self.poses.push(pose);
        }
    }
}

/// The length along an arc from the origin of a frame, which it leaves along the first axis, to the foot of a place.
pub(crate) fn arc_to(place: [f64; 2], curvature: f64) -> f64 {
    let angle = libm::atan2(curvature * place[0], 1.0 - curvature * place[1]);
    if angle.abs() < 1e-9 { place[0] } else { angle / curvature }
}

/// The end of an arc in the frame of its start. By the half angle: no digits are lost where it is nearly straight.
pub(crate) fn arc_end(length: f64, turn: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(0.5 * turn);
    let chord =
        if turn.abs() < 1e-4 { length * (1.0 - turn * turn / 24.0) } else { length * sin / (0.5 * turn) };
    [chord * cos, chord * sin]
}

/// Length of an arc over a chord; of chords longer than its diameter about half a turn.
pub(crate) fn arc_over(chord: f64, curvature: f64) -> f64 {
    let bend = (0.5 * curvature.abs() * chord).min(0.999);
    if bend > 1e-6 { 2.0 * libm::asin(bend) / curvature.abs() } else { chord }
}

//! Closed lines in the parameters of a surface.

use super::chart::{Chart, Side};
use super::strand::Strand;
use crate::curve::Span;

/// Why a straight piece is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Straight {
    /// Two edges meet in space up to the gaps of the file.
    Joint,
    /// Along a side that is a single place.
    Pole(Side),
    /// Where a surface that closes was cut open at a value of this parameter; the face goes on at the other side of the cut.
    Cut(usize),
    /// Where a face ends without an edge.
    Side,
}

/// A part of a ring.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// A part of an edge.
    Edge(Strand),
    /// Straight in the parameters.
    Straight {
        /// Start and end.
        ends: [[f64; 2]; 2],
        /// Why.
        kind: Straight,
    },
}

/// A closed line; the face is on its left as `u` points right and `v` up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ring {
    /// Each begins where the one before ends.
    pub pieces: Vec<Piece>,
    /// By how many periods of each parameter the end is ahead of the start. Once a face is cut open it is 0.
    pub winding: [i32; 2],
}

impl Piece {
    /// Parameters at its start and its end.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        match self {
            Piece::Edge(strand) => strand.ends(),
            Piece::Straight { ends, .. } => *ends,
        }
    }

    /// Moves it by whole periods.
    pub fn shift(&mut self, by: [f64; 2]) {
        match self {
            Piece::Edge(strand) => strand.shift(by),
            Piece::Straight { ends, .. } => ends.iter_mut().for_each(|e| (0..2).for_each(|k| e[k] += by[k])),
        }
    }

    /// Places with what its line may be off the straight one to the next place.
    pub fn places(&self) -> Vec<([f64; 2], [f64; 2])> {
        match self {
            Piece::Edge(strand) => strand.samples.iter().map(|s| (s.at, s.band)).collect(),
            Piece::Straight { ends, .. } => ends.iter().map(|e| (*e, [0.0; 2])).collect(),
        }
    }

    /// Parameters and their derivatives at a share of the way, 0 to 1.
    pub fn moving(&self, chart: &Chart, spans: &[Span], share: f64) -> ([f64; 2], [f64; 2]) {
        match self {
            Piece::Edge(strand) => {
                let [from, to] = strand.shares();
                let span = &spans[strand.slot];
                let (at, rate) = strand.moving(chart, span, from + share * (to - from));
                (at, rate.map(|r| r * (to - from)))
            }
            Piece::Straight { ends: [a, b], .. } => {
                let way = [b[0] - a[0], b[1] - a[1]];
                ([a[0] + share * way[0], a[1] + share * way[1]], way)
            }
        }
    }
}

impl Ring {
    /// Its corners and samples, each once.
    pub fn places(&self) -> Vec<([f64; 2], [f64; 2])> {
        let mut all = vec![];
        for piece in &self.pieces {
            let own = piece.places();
            all.extend_from_slice(&own[..own.len() - 1]);
        }
        all
    }

    /// Moves it by whole periods.
    pub fn shift(&mut self, by: [f64; 2]) {
        self.pieces.iter_mut().for_each(|piece| piece.shift(by));
    }
}

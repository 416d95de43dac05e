//! Where a profile ends: which end is the trailing one, and whether it is sharp, blunt or round.

use super::error::AirfoilError;
use super::tail::{Tail, tail};
use crate::model::flat::distance;
use crate::search::parts::noise_beyond_form;

/// The ends of an open row are no farther apart than this share of the chord.
const MAX_END_GAP_OF_CHORD: f64 = 0.2;

/// The kind of the trailing edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrailingEdge {
    /// A corner.
    Sharp,
    /// Cut off: two corners that are so far apart.
    Blunt(f64),
    /// Without corner.
    Round,
    /// Open: the row ends there, its ends are so far apart.
    Open(f64),
}

impl TrailingEdge {
    /// The word for it: `sharp`, `blunt`, `round`, `open`.
    pub fn name(self) -> &'static str {
        match self {
            TrailingEdge::Sharp => "sharp",
            TrailingEdge::Blunt(_) => "blunt",
            TrailingEdge::Round => "round",
            TrailingEdge::Open(_) => "open",
        }
    }
}

/// A profile from its trailing edge over the leading one and back.
pub(super) struct TurnedProfile {
    /// The points. At a sharp trailing edge first and last are the same; at a round one the row goes on beyond it at
    /// both ends.
    pub row: Vec<[f64; 2]>,
    /// The points that it begins and ends at, by their numbers in the row given; of a round trailing edge that of the seam.
    pub ends: [usize; 2],
    /// So many points at either end are those of the other.
    pub over: usize,
    pub trailing: TrailingEdge,
}

impl TurnedProfile {
    /// The profile of a row.
    pub fn new(row: &[[f64; 2]], closed: bool) -> Result<TurnedProfile, AirfoilError> {
        if !closed {
            let (a, b) = (row[0], row[row.len() - 1]);
            let (middle, gap) = ([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])], distance(a, b));
            let chord = row.iter().map(|p| distance(*p, middle)).fold(0.0, f64::max);
            if gap > MAX_END_GAP_OF_CHORD * chord {
                return Err(AirfoilError::Open { gap, chord });
            }
            return Ok(TurnedProfile {
                row: row.to_vec(),
                ends: [0, row.len() - 1],
                over: 0,
                trailing: TrailingEdge::Open(gap),
            });
        }
        let n = row.len();
        let noise = noise_beyond_form(row, true);
        let Tail { ends: [before, after], round, tip } = tail(row, noise);
        let run = |from: usize, count: usize| -> Vec<[f64; 2]> {
            (from..=from + count).map(|i| row[i % n]).collect()
        };
        if round {
            let over = n / 16 + 1;
            let row = run(tip + n - over, n + 2 * over);
            return Ok(TurnedProfile { row, ends: [tip; 2], over, trailing: TrailingEdge::Round });
        }
        if before == after {
            return Ok(TurnedProfile {
                row: run(before, n),
                ends: [before; 2],
                over: 0,
                trailing: TrailingEdge::Sharp,
            });
        }
        let trailing = TrailingEdge::Blunt(distance(row[before], row[after]));
        Ok(TurnedProfile {
            row: run(after, (before + n - after) % n),
            ends: [after, before],
            over: 0,
            trailing,
        })
    }
}

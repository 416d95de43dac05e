//! How often a surface winds around a place beside one of its pieces: counted exactly along a ray.
//!
//! The ray goes in the direction of x, through a point of two numbers that lies strictly inside of the piece as seen along x.
//! The facets that it passes behind the piece are found and ordered by exact signs, as in the nesting of shells.

use super::cut::Piece;
use super::points::{Place, Points, orient};
use crate::check::nesting::Container;
use crate::mesh::Mesh;
use crate::space::{Point, times};
use std::collections::BTreeMap;

/// The facets of closed shells, ready for rays.
pub(super) struct Rays<'a> {
    shell_of: &'a [u32],
    points: &'a Points<'a>,
    all: Container<'a>,
}

/// Shells with their winding numbers beside a place, those of 0 left out.
pub type Around = Vec<(u32, i32)>;

impl<'a> Rays<'a> {
    pub fn new(mesh: &'a Mesh, shell_of: &'a [u32], points: &'a Points<'a>) -> Rays<'a> {
        let facets = (0..).zip(shell_of).filter(|(_, s)| **s != u32::MAX).map(|(f, _)| f);
        Rays { shell_of, points, all: Container::new(mesh, &facets.collect::<Vec<u32>>(), 0) }
    }

    /// Winding numbers of all shells, as far as they are not 0, beside one of these pieces: which one, whether where it looks
    /// to (0) or where it comes from (1), shells and numbers. `None` if no piece holds a point that numbers can name.
    pub fn count(&self, pieces: &[Piece], of_part: &[u32]) -> Option<(usize, usize, Around)> {
        let size = |p: &u32| {
            let [a, b, c] = pieces[*p as usize].corners.map(|q| self.points.rough(q));
            ((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])).abs()
        };
        let best = of_part.iter().copied().max_by(|p, q| size(p).total_cmp(&size(q)).then(q.cmp(p)))?;
        let first = self.target(&pieces[best as usize]).map(|t| (best, t));
        let all = || of_part.iter().find_map(|p| Some((*p, self.target(&pieces[*p as usize])?)));
        let (piece, (target, turn)) = first.or_else(all)?;
        let around = self.behind(pieces[piece as usize].facet, &target);
        Some((piece as usize, usize::from(turn < 0), around))
    }

    /// A place whose y and z lie strictly inside of the piece, and whether the piece looks to growing x (1) or back (−1).
    fn target(&self, piece: &Piece) -> Option<(Point, i32)> {
        let at = piece.corners.map(|p| self.points.at(p));
        let rough = piece.corners.map(|p| self.points.rough(p));
        let turn = orient(0, [&at[0], &at[1], &at[2]]);
        if turn == 0 {
            return None;
        }
        let weights = [[1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [1.0, 2.0, 1.0], [1.0, 1.0, 2.0]];
        let place = |w: [f64; 3]| -> Point {
            let sum = [0, 1, 2].map(|k| w[0] * rough[0][k] + w[1] * rough[1][k] + w[2] * rough[2][k]);
            times(1.0 / (w[0] + w[1] + w[2]), sum)
        };
        let inside = |p: &Point| {
            let p = Place::of(*p);
            (0..3).all(|k| orient(0, [&at[k], &at[(k + 1) % 3], &p]) == turn)
        };
        weights.into_iter().map(place).find(inside).map(|p| (p, turn))
    }

    /// The facets that a ray from facet `from` at `target` passes, by shell.
    fn behind(&self, from: u32, target: &Point) -> Vec<(u32, i32)> {
        let mut sums: BTreeMap<u32, i32> = BTreeMap::new();
        self.all
            .behind(from, target, |f, around| *sums.entry(self.shell_of[f as usize]).or_default() += around);
        sums.into_iter().filter(|s| s.1 != 0).collect()
    }
}

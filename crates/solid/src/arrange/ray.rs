//! How often a surface winds around a place beside one of its pieces: counted exactly along a ray.
//!
//! The ray goes in the direction of x, through a point of two numbers that lies strictly inside of the piece as seen along x.
//! The facets that it passes behind the piece are found and ordered by exact signs, as in the nesting of shells.

use super::cut::Piece;
use super::points::{ExactPoint, Points, orient};
use std::collections::BTreeMap;
use trueness_geom::check::nesting::Container;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Point, times};

/// The facets of closed shells, to be asked about by rays.
pub(super) struct Rays<'a> {
    mesh: &'a Mesh,
    shell_of: &'a [u32],
    points: &'a Points<'a>,
}

/// Shells with their winding numbers beside a place, those of 0 left out.
pub type ShellWindings = Vec<(u32, i32)>;

/// A place beside a piece: the piece, its side, and y and z. The side is where the piece looks to (0) or where it comes
/// from (1).
struct Target {
    piece: u32,
    side: usize,
    at: Point,
}

impl<'a> Rays<'a> {
    pub fn new(mesh: &'a Mesh, shell_of: &'a [u32], points: &'a Points<'a>) -> Rays<'a> {
        Rays { mesh, shell_of, points }
    }

    /// For each of these parts the winding numbers of all shells, as far as they are not 0, beside one of its pieces.
    /// An entry has the piece, its side, shells and numbers; the side is where it looks to (0) or where it comes from
    /// (1). The number of a part where no piece holds a point that numbers can name.
    pub fn count(
        &self,
        pieces: &[Piece],
        parts: &[Vec<u32>],
    ) -> Result<Vec<(usize, usize, ShellWindings)>, usize> {
        let targets = parts.par_iter().enumerate().map(|(n, part)| self.target_of(pieces, part).ok_or(n));
        let found: Vec<Result<Target, usize>> = targets.collect();
        let targets: Vec<Target> = found.into_iter().collect::<Result<_, usize>>()?;
        let facets: Vec<u32> =
            (0..).zip(self.shell_of).filter(|(_, s)| **s != u32::MAX).map(|(f, _)| f).collect();
        let places: Vec<Point> = targets.iter().map(|t| t.at).collect();
        let all = Container::at(self.mesh, &facets, 0, &places);
        let counted = targets.into_par_iter().map(|Target { piece, side, at }| {
            let around = self.behind(&all, pieces[piece as usize].facet, &at);
            (piece as usize, side, around)
        });
        Ok(counted.collect())
    }

    /// A place beside one of these pieces, the largest as seen along x if that will do.
    fn target_of(&self, pieces: &[Piece], part: &[u32]) -> Option<Target> {
        let size = |p: &u32| {
            let [a, b, c] = pieces[*p as usize].corners.map(|q| self.points.rough(q));
            ((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])).abs()
        };
        let sized = part.par_iter().map(|p| (size(p), *p));
        let (_, best) = sized.max_by(|p, q| p.0.total_cmp(&q.0).then(q.1.cmp(&p.1)))?;
        let first = self.target(&pieces[best as usize]).map(|t| (best, t));
        let any = || part.iter().find_map(|p| Some((*p, self.target(&pieces[*p as usize])?)));
        let (piece, (at, turn)) = first.or_else(any)?;
        Some(Target { piece, side: usize::from(turn < 0), at })
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
            let p = ExactPoint::of(*p);
            (0..3).all(|k| orient(0, [&at[k], &at[(k + 1) % 3], &p]) == turn)
        };
        weights.into_iter().map(place).find(inside).map(|p| (p, turn))
    }

    /// The facets that a ray from facet `from` at `target` passes, by shell.
    fn behind(&self, all: &Container, from: u32, target: &Point) -> ShellWindings {
        let mut sums: BTreeMap<u32, i32> = BTreeMap::new();
        all.facets_behind(from, target, |f, around| {
            *sums.entry(self.shell_of[f as usize]).or_default() += around
        });
        sums.into_iter().filter(|s| s.1 != 0).collect()
    }
}

//! Facets around an edge that very many have in common, by their angle: a *book* with its pages around the *spine*.
//!
//! Seen from an end of the spine, all pages contain the direction of the spine, so boxes of directions exclude nothing. Angles
//! around the spine do: two pages meet only if they have the same angle. Any other facet meets only pages at angles between
//! those of its corners.

use crate::mesh::Mesh;
use crate::space::{Point, cross, dot, minus, norm, times, unit};
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Rounding may turn the angle of a corner by more than this: such a corner tells nothing.
const MAX_CLEAR_TURN: f64 = 1e-6;
/// Facets that reach this far around the spine may hold a part of it.
const MAX_FACET_TURN: f64 = PI - 1e-3;

/// Pages around a spine.
pub(super) struct Book {
    ends: [u32; 2],
    from: Point,
    size: f64,
    axis: Point,
    /// Directions of the angles 0 and, but for its length, a quarter turn.
    frame: Option<(Point, Point)>,
    /// Angle from −π to π, and the facet, in order.
    pages: Vec<(f64, u32)>,
    /// Pages so low that their angle is not known: compared with all.
    vague: Vec<u32>,
}

impl Book {
    pub fn new(mesh: &Mesh, ends: [u32; 2], facets: &[u32]) -> Book {
        let at = |v: u32| mesh.positions[v as usize];
        let (from, to) = (at(ends[0]), at(ends[1]));
        let size = minus(to, from).iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let axis = unit(times(1.0 / size, minus(to, from))).map_or([0.0; 3], |(axis, _)| axis);
        let mut book = Book { ends, from, size, axis, frame: None, pages: vec![], vague: vec![] };
        for facet in facets {
            let third = mesh.faces[*facet as usize].into_iter().find(|v| !ends.contains(v));
            match third.and_then(|v| book.arm(at(v))) {
                Some(arm) => {
                    book.frame.get_or_insert((arm, cross(axis, arm)));
                    book.pages.extend(book.angle(arm).map(|angle| (angle, *facet)));
                }
                None => book.vague.push(*facet),
            }
        }
        book.pages.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        book
    }

    /// The way from the axis to a place; `None` where that is too short to tell an angle.
    fn arm(&self, place: Point) -> Option<Point> {
        let way = times(1.0 / self.size, minus(place, self.from));
        let arm = minus(way, times(dot(way, self.axis), self.axis));
        let turn = 1e-14 * (1.0 + norm(way)) / norm(arm);
        (turn < MAX_CLEAR_TURN).then_some(arm)
    }

    fn angle(&self, arm: Point) -> Option<f64> {
        self.frame.map(|(x, y)| libm::atan2(dot(arm, y), dot(arm, x)))
    }

    /// Calls `decide` with all pairs of pages whose angles are equal to rounding, until that says no.
    pub fn pairs(&self, decide: &mut impl FnMut(u32, u32) -> bool) -> bool {
        // Once more behind the end: angles go round.
        let again =
            self.pages.iter().take_while(|p| p.0 < 2.0 * MAX_CLEAR_TURN - PI).map(|p| (p.0 + TAU, p.1));
        let round: Vec<(f64, u32)> = self.pages.iter().copied().chain(again).collect();
        (0..self.pages.len()).all(|i| {
            let (angle, page) = self.pages[i];
            let near = round[i + 1..].iter().take_while(|p| p.0 <= angle + 2.0 * MAX_CLEAR_TURN);
            near.filter(|p| p.1 != page).all(|p| decide(page, p.1))
        }) && (0..self.vague.len()).all(|i| {
            let others = self.vague[i + 1..].iter().copied().chain(self.pages.iter().map(|p| p.1));
            others.into_iter().all(|other| decide(self.vague[i], other))
        })
    }

    /// The pages that may meet a facet; `None` where its corners do not tell, or that is a large part of them.
    pub fn near(&self, mesh: &Mesh, facet: u32) -> Option<impl Iterator<Item = u32>> {
        /// One page of so many, or more, is found as fast by boxes.
        const BOX_PAGES_DIVISOR: usize = 8;
        let mut angles = vec![];
        for v in mesh.faces[facet as usize] {
            // An end of the spine lies on the axis whatever rounding says: from there the facet reaches to its other corners.
            if !self.ends.contains(&v) {
                angles.push(self.angle(self.arm(mesh.positions[v as usize])?)?);
            }
        }
        angles.sort_by(f64::total_cmp);
        let n = angles.len();
        let gap = |i: usize| angles[(i + 1) % n] - angles[i] + if i + 1 == n { TAU } else { 0.0 };
        let widest = (0..n).max_by(|a, b| gap(*a).total_cmp(&gap(*b)))?;
        if TAU - gap(widest) > MAX_FACET_TURN {
            return None;
        }
        let low = angles[(widest + 1) % n] - 2.0 * MAX_CLEAR_TURN;
        let high = low + TAU - gap(widest) + 4.0 * MAX_CLEAR_TURN;
        let ranges = [-TAU, 0.0, TAU].map(|turn| self.between(low + turn, high + turn));
        let count: usize = ranges.iter().map(Range::len).sum();
        let pages = ranges.into_iter().flat_map(|r| self.pages[r].iter().map(|p| p.1));
        (count + self.vague.len() <= 64.max(self.pages.len() / BOX_PAGES_DIVISOR))
            .then(|| pages.chain(self.vague.iter().copied()))
    }

    fn between(&self, low: f64, high: f64) -> Range<usize> {
        self.pages.partition_point(|p| p.0 < low)..self.pages.partition_point(|p| p.0 <= high)
    }
}

//! Spreading over neighbors.

use super::pieces::PieceGraph;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Which pieces were looked at; kept between floods so that a small one costs little on a large surface.
#[derive(Debug)]
pub(super) struct Marks {
    seen: Vec<bool>,
    touched: Vec<u32>,
}

impl Marks {
    pub(super) fn new(surface: &PieceGraph) -> Marks {
        Marks { seen: vec![false; surface.len()], touched: Vec::new() }
    }
    /// Whether this is the first time since the last flood.
    fn first(&mut self, piece: u32) -> bool {
        let fresh = !self.seen[piece as usize];
        if fresh {
            self.seen[piece as usize] = true;
            self.touched.push(piece);
        }
        fresh
    }
    fn clear(&mut self) {
        for piece in self.touched.drain(..) {
            self.seen[piece as usize] = false;
        }
    }
}

/// The pieces reached from `starts` over neighbors for which `accept` says yes, nearest rings first, until there are
/// `most`. `accept` gets the piece and the one it is reached from.
pub(super) fn flood(
    surface: &PieceGraph,
    starts: &[u32],
    most: usize,
    marks: &mut Marks,
    accept: impl Fn(u32, u32) -> bool,
) -> Vec<u32> {
    let mut reached: Vec<u32> = Vec::new();
    for &start in starts {
        if reached.len() < most && marks.first(start) && accept(start, start) {
            reached.push(start);
        }
    }
    let mut next = 0;
    'spread: while next < reached.len() {
        let from = reached[next];
        next += 1;
        for &piece in surface.neighbors(from) {
            if reached.len() >= most {
                break 'spread;
            }
            if marks.first(piece) && accept(piece, from) {
                reached.push(piece);
            }
        }
    }
    marks.clear();
    reached
}

/// The pieces for which `free` says yes in the first two rings around `pieces`, the inner ring first.
pub(super) fn rings(
    surface: &PieceGraph,
    pieces: &[u32],
    marks: &mut Marks,
    free: impl Fn(u32) -> bool,
) -> Vec<u32> {
    for &piece in pieces {
        marks.first(piece);
    }
    let mut ring = |from: &[u32]| -> Vec<u32> {
        let around = from.iter().flat_map(|&p| surface.neighbors(p)).copied();
        around.filter(|&p| marks.first(p) && free(p)).collect()
    };
    let mut found = ring(pieces);
    let outer = ring(&found);
    found.extend(outer);
    marks.clear();
    found
}

/// About `most` free pieces around `seed` without a crease between neighbors.
pub(super) fn patch(
    surface: &PieceGraph,
    seed: u32,
    most: usize,
    crease: f64,
    marks: &mut Marks,
    free: impl Fn(u32) -> bool,
) -> Vec<u32> {
    flood(surface, &[seed], most, marks, |piece, from| {
        surface.counts(piece) && free(piece) && surface.turn(piece, from) >= crease
    })
}

/// Which neighbor a strip takes next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Order {
    /// The one that turns least.
    Turn,
    /// The one across the longest edge.
    Edge,
    /// The neighbor whose area is most like that of the piece it is reached from. That leads from chord to chord of a fillet,
    /// not onto the adjacent face.
    Alike,
}

/// Neighbors of a piece beyond which a strip does not go on from it: around one vertex with so many facets there is no strip.
const MAX_STRIP_NEIGHBORS: usize = 1000;

/// About `most` free facets from `seed` on, each across an edge without a crease from one before, in the given order. Programs
/// that draw parts write facets as long as their face. There this stays on the face when [`patch`] does not: along a cylinder
/// of two circles of corners, along a narrow plane.
pub(super) fn strip(
    surface: &PieceGraph,
    seed: u32,
    (most, order): (usize, Order),
    crease: f64,
    marks: &mut Marks,
    free: impl Fn(u32) -> bool,
) -> Vec<u32> {
    let mut reached = vec![];
    // Bits of positive numbers are in the order of the numbers; of equals the first piece comes first.
    let mut open = BinaryHeap::from([(0u64, Reverse(seed))]);
    while let Some((_, Reverse(from))) = open.pop().filter(|_| reached.len() < most) {
        if !marks.first(from) {
            continue;
        }
        reached.push(from);
        let around = surface.neighbors(from);
        for &piece in around.iter().filter(|_| around.len() <= MAX_STRIP_NEIGHBORS) {
            let across = surface.turn(piece, from);
            let joins =
                surface.counts(piece) && free(piece) && across >= crease && !marks.seen[piece as usize];
            if let Some(edge) = surface.edge(piece, from).filter(|_| joins) {
                let first = match order {
                    Order::Turn => across,
                    Order::Edge => edge,
                    Order::Alike => surface.likeness(piece, from),
                };
                open.push((first.to_bits(), Reverse(piece)));
            }
        }
    }
    marks.clear();
    reached
}

#[cfg(test)]
mod tests {
    use super::super::{
        facets,
        tests::parts::{bored, sleeve},
    };
    use super::*;

    /// Number of steps over neighbors from any of `pieces` to each piece.
    fn steps(surface: &PieceGraph, pieces: &[u32]) -> Vec<usize> {
        let mut steps = vec![usize::MAX; surface.len()];
        pieces.iter().for_each(|&p| steps[p as usize] = 0);
        for ring in 0..surface.len() {
            for p in 0..surface.len() as u32 {
                if steps[p as usize] == ring {
                    let fresh = surface.neighbors(p).iter().filter(|&&n| steps[n as usize] == usize::MAX);
                    fresh.copied().collect::<Vec<u32>>().iter().for_each(|&n| steps[n as usize] = ring + 1);
                }
            }
        }
        steps
    }

    #[test]
    fn a_flood_takes_the_nearest_and_rings_are_the_next_two() {
        let part = bored(16);
        let surface = facets::surface(&part.mesh);
        let mut marks = Marks::new(&surface);
        let reached = flood(&surface, &[40], 30, &mut marks, |_, _| true);
        let all = steps(&surface, &[40]);
        let farthest = reached.iter().map(|&p| all[p as usize]).max();
        assert_eq!(reached.len(), 30);
        assert!((0..surface.len()).all(|p| reached.contains(&(p as u32)) || Some(all[p]) >= farthest));
        let mut around = rings(&surface, &reached, &mut marks, |_| true);
        around.sort_unstable();
        let beyond = steps(&surface, &reached);
        let expected: Vec<u32> =
            (0..surface.len() as u32).filter(|&p| (1..=2).contains(&beyond[p as usize])).collect();
        assert_eq!(around, expected);
    }

    #[test]
    fn a_patch_ends_at_an_edge() {
        let part = bored(16);
        let surface = facets::surface(&part.mesh);
        let mut marks = Marks::new(&surface);
        // Facets of the bore are turned by 22.5 degrees against each other, by 90 against the faces.
        let patch = patch(&surface, 0, usize::MAX, 30f64.to_radians().cos(), &mut marks, |_| true);
        assert!(patch.iter().all(|&p| part.labels[p as usize] == part.labels[0]));
        assert_eq!(patch.len(), part.labels.iter().filter(|&&l| l == part.labels[0]).count());
    }

    /// On a sleeve of two circles of corners a face, a patch goes onto the fillet beside, a strip does not.
    #[test]
    fn a_strip_stays_on_a_face_that_is_one_facet_wide() {
        let part = sleeve([8.0, 12.0, 20.0], Some((1.0, 6)), 60);
        let surface = facets::surface(&part.mesh);
        let mut marks = Marks::new(&surface);
        let crease = 30f64.to_radians().cos();
        let seed = part.labels.iter().position(|l| *l == 0).unwrap() as u32;
        let own = |pieces: &[u32]| pieces.iter().filter(|p| part.labels[**p as usize] == 0).count();
        let around = patch(&surface, seed, 40, crease, &mut marks, |_| true);
        assert!(own(&around) < 30, "{}", own(&around));
        for order in [Order::Turn, Order::Edge] {
            let strip = strip(&surface, seed, (40, order), crease, &mut marks, |_| true);
            assert_eq!((strip.len(), own(&strip)), (40, 40), "{order:?}");
        }
    }
}

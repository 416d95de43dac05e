//! The stages of the search, one after the other, for blocks of sixteen points. See the module `query` for the plan.
//!
//! SAFETY, here and for every function: the caller promises that the processor has the instructions of the types.
#![expect(unsafe_code, reason = "loads of vector types need their instructions")]

use crate::closest::block::{LENGTH_UP, POINTS_PER_BLOCK, PointBlock, SurfacePoint};
use crate::closest::decide::{Undecided, decide};
use crate::closest::hit::Hit;
use crate::closest::prune::{Survivors, prune};
use crate::closest::tree::Tree;
use crate::closest::{leaf_triangles, lockstep, triangle};
use crate::memory::prefetch;
use crate::simd::lanes::{Lanes, Real};
use crate::space::Point;

/// Takes the answers of a block: items, and as many hits. Not generic, so that the search is compiled once for each
/// instruction set and not once more for everybody who asks.
pub type Sink<'a> = &'a dyn Fn(&[u64], &[Hit]);

/// The state that one thread keeps from block to block: the memory of each stage, and where to begin.
#[derive(Default)]
pub struct Scratch {
    /// Slot of the triangle closest to the last point answered: the next block begins there. (The answers do not depend on
    /// it.)
    last_winner: u32,
    survivors: Survivors,
    leaf_triangles: leaf_triangles::Buffers,
    lockstep: lockstep::Buffers,
    undecided: Vec<Undecided>,
}

/// Answers the points named by `items` (their low 32 bits), in that order. Beyond `max_distance` an answer may be
/// missing ([`Hit::NONE`]) or too far.
#[inline(always)]
pub unsafe fn answer<V: Lanes<8>, W: Lanes<16>, D: Real>(
    tree: &Tree,
    points: &[Point],
    items: &[u64],
    max_distance: f64,
    s: &mut Scratch,
    sink: Sink,
) {
    for (n, part) in items.chunks(POINTS_PER_BLOCK).enumerate() {
        // The points lie scattered in memory, a third of them across two cache lines: ask early for the block after next.
        if let Some(next) = items.get((n + 2) * POINTS_PER_BLOCK..) {
            for &i in &next[..next.len().min(POINTS_PER_BLOCK)] {
                let p = &points[i as u32 as usize];
                prefetch(p);
                prefetch(&p[2]);
            }
        }
        let mut p = [[0.0; 3]; POINTS_PER_BLOCK];
        for (p, &i) in p.iter_mut().zip(part) {
            *p = points[i as u32 as usize];
        }
        let mut hits = [Hit::NONE; POINTS_PER_BLOCK];
        unsafe { answer_block::<V, W, D>(tree, &p[..part.len()], max_distance, s, &mut hits) };
        sink(part, &hits[..part.len()]);
    }
}

/// Answers up to sixteen points.
#[inline(always)]
unsafe fn answer_block<V: Lanes<8>, W: Lanes<16>, D: Real>(
    tree: &Tree,
    points: &[Point],
    max_distance: f64,
    s: &mut Scratch,
    hits: &mut [Hit; POINTS_PER_BLOCK],
) {
    let b = PointBlock::new(tree, points);
    if !b.in_range() {
        for (p, h) in points.iter().zip(hits) {
            *h = try_all(tree, p);
        }
        return;
    }
    // Rounded up; in single precision it may become infinite.
    let limit = (max_distance * tree.scale * f64::from(LENGTH_UP)) as f32;
    let Scratch { survivors, undecided, .. } = s;
    unsafe {
        // Any point of the surface will do; one near the block leaves little to look at.
        let near = SurfacePoint::new(tree, &b, s.last_winner);
        prune::<V>(tree, &b, &near, limit, survivors);
        undecided.clear();
        if survivors.are_few() {
            leaf_triangles::test_all::<V, W>(tree, &b, &survivors.leaves, &mut s.leaf_triangles, undecided);
        } else {
            lockstep::search::<V>(tree, &b, &near, limit, survivors, &mut s.lockstep, undecided);
        }
        decide::<D>(tree, &b, undecided, hits);
    }
    // Where nothing was near enough, the start of this block serves on.
    if let Some(last) = hits.iter().rev().find(|h| h.face != Hit::NONE.face) {
        s.last_winner = last.slot;
    }
}

/// All triangles in double precision, for points so far away that single precision overflows.
#[cold]
#[inline(never)]
fn try_all(tree: &Tree, p: &Point) -> Hit {
    let mut best = Hit::NONE;
    for (slot, &face) in (0..).zip(&tree.face) {
        let (d, height) = triangle::squared_distance(p, &tree.triangle(slot));
        if d < best.distance_squared || (d == best.distance_squared && face < best.face) {
            best = Hit { distance_squared: d, face, slot, height };
        }
    }
    best
}

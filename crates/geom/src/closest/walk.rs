//! The work on one block of sixteen points: walk, gather, test, settle. See the module `query` for the plan.
//!
//! SAFETY, here and for every function: the caller promises that the processor has the instructions of the types.
#![expect(unsafe_code, reason = "loads of vector types need their instructions")]

use crate::closest::block::{BLOCK, Block, DENSE, Near, Scratch};
use crate::closest::hit::Hit;
use crate::closest::tree::Tree;
use crate::closest::triangle;
use crate::closest::{dense::dense, front, settle::settle, wave::wave};
use crate::memory::prefetch;
use crate::simd::lanes::{Lanes, Real};
use crate::space::Point;

/// Takes the answers of a block: items, and as many hits. Not generic, so that the search is compiled once for each
/// instruction set and not once more for everybody who asks.
pub type Sink<'a> = &'a dyn Fn(&[u64], &[Hit]);

/// Answers the points named by `items` (their low 32 bits), in that order. Beyond `max_distance` an answer may be
/// missing ([`Hit::NONE`]) or too far.
#[inline(always)]
pub unsafe fn all<V: Lanes<8>, W: Lanes<16>, D: Real>(
    tree: &Tree,
    points: &[Point],
    items: &[u64],
    max_distance: f64,
    s: &mut Scratch,
    sink: Sink,
) {
    for (n, part) in items.chunks(BLOCK).enumerate() {
        // The points lie scattered in memory, a third of them across two cache lines: ask early for the block after next.
        if let Some(next) = items.get((n + 2) * BLOCK..) {
            for &i in &next[..next.len().min(BLOCK)] {
                let p = &points[i as u32 as usize];
                prefetch(p);
                prefetch(&p[2]);
            }
        }
        let mut p = [[0.0; 3]; BLOCK];
        for (p, &i) in p.iter_mut().zip(part) {
            *p = points[i as u32 as usize];
        }
        let mut hits = [Hit::NONE; BLOCK];
        unsafe { block::<V, W, D>(tree, &p[..part.len()], max_distance, s, &mut hits) };
        sink(part, &hits[..part.len()]);
    }
}

/// Answers up to sixteen points.
#[inline(always)]
unsafe fn block<V: Lanes<8>, W: Lanes<16>, D: Real>(
    tree: &Tree,
    points: &[Point],
    max_distance: f64,
    s: &mut Scratch,
    hits: &mut [Hit; BLOCK],
) {
    let b = Block::new(tree, points);
    if !b.in_range() {
        for (p, h) in points.iter().zip(hits) {
            *h = everything(tree, p);
        }
        return;
    }
    // Rounded up; in single precision it may become infinite.
    let limit = (max_distance * tree.scale * 1.000001) as f32;
    unsafe {
        // Any point of the surface will do; one near the block leaves little to look at.
        let x = Near::new(tree, &b, s.warm);
        front::gather::<V>(tree, &b, &x, limit, s);
        s.pairs.clear();
        if s.open.is_empty() && s.leaves.len() <= DENSE {
            dense::<V, W>(tree, &b, s);
        } else {
            front::plant(tree, s);
            wave::<V>(tree, &b, &x, limit, s);
        }
        settle::<D>(tree, &b, s, hits);
    }
    // Where nothing was near enough, the start of the block before serves on.
    s.warm = hits.iter().rev().find(|h| h.face != Hit::NONE.face).map_or(s.warm, |h| h.slot);
}

/// All triangles in double precision, for points so far away that single precision overflows.
#[cold]
#[inline(never)]
fn everything(tree: &Tree, p: &Point) -> Hit {
    let mut best = Hit::NONE;
    for (slot, &face) in (0..).zip(&tree.face) {
        let (d, height) = triangle::squared_distance(p, &tree.triangle(slot));
        if d < best.distance_squared || (d == best.distance_squared && face < best.face) {
            best = Hit { distance_squared: d, face, slot, height };
        }
    }
    best
}

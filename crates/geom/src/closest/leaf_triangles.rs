//! Second stage where few leaves are left: their triangles against all sixteen points of the block at once.
#![expect(unsafe_code, reason = "loads of vector types need their instructions")]

use crate::closest::block::{POINTS_PER_BLOCK, PointBlock, SQUARE_UP, norm};
use crate::closest::decide::Undecided;
use crate::closest::kernel;
use crate::closest::prune::{ChildRef, MAX_LEAVES_TESTED_SINGLY};
use crate::closest::tree::Tree;
use crate::num::rounding::SINGLE_DISTANCE_ROUNDING;
use crate::simd::lanes::Lanes;

/// A triangle that may be the closest to some point of the block.
#[derive(Clone, Copy)]
struct Candidate {
    leaf: u32,
    lane: u32,
    /// The block's center in the triangle's frame.
    center: [f32; 3],
}

/// Memory of this stage, kept from block to block.
#[derive(Default)]
pub struct Buffers {
    candidates: Vec<Candidate>,
    /// Squared distances, candidates x points.
    table: Vec<[f32; POINTS_PER_BLOCK]>,
}

/// Tests the triangles of `leaves` that are near enough to the block against all its points. There are at most
/// [`MAX_LEAVES_TESTED_SINGLY`] leaves. Lists in `undecided` the triangles that may be the closest.
///
/// # Safety
/// The processor has the instructions of both types.
#[inline(always)]
pub unsafe fn test_all<V: Lanes<8>, W: Lanes<16>>(
    tree: &Tree,
    b: &PointBlock,
    leaves: &[ChildRef],
    s: &mut Buffers,
    undecided: &mut Vec<Undecided>,
) {
    let mut error: f32 = 0.0;
    for found in leaves {
        let leaf = &tree.leaves[!found.child as usize];
        error = error
            .max(SINGLE_DISTANCE_ROUNDING * (norm(b.relative(tree, leaf.origin)) + b.reach + leaf.radius));
    }
    // SAFETY: the caller's promise.
    unsafe {
        select::<V>(tree, b, 2.0 * b.reach + 4.0 * error, leaves, &mut s.candidates);
        let d = [W::load(&b.offset[0]), W::load(&b.offset[1]), W::load(&b.offset[2])];
        let mut least = W::splat(f32::INFINITY);
        s.table.resize(s.table.len().max(s.candidates.len()), [0.0; 16]);
        for (c, row) in s.candidates.iter().zip(&mut s.table) {
            let leaf = &tree.leaves[c.leaf as usize];
            let r = kernel::triangle_distance2::<W>(leaf, c.lane as usize, c.center, d);
            least = least.min(r);
            r.store(row);
        }
        // Up to `(sqrt least + 2 error)²` a triangle may be nearer than the nearest found.
        let limit = least.sqrt() + W::splat(2.0 * error);
        let limit = limit * limit * W::splat(SQUARE_UP);
        let live = (1u32 << b.len) - 1;
        for (c, row) in s.candidates.iter().zip(&s.table) {
            let mut mask = W::load(row).le(limit) & live;
            let slot = tree.leaves[c.leaf as usize].first + c.lane;
            while mask != 0 {
                undecided.push(Undecided { point: mask.trailing_zeros(), slot });
                mask &= mask - 1;
            }
        }
    }
}

/// Lists the triangles that can be nearest to some point: up to `reach` farther from the block's center than the nearest of
/// all.
#[inline(always)]
unsafe fn select<V: Lanes<8>>(
    tree: &Tree,
    b: &PointBlock,
    reach: f32,
    leaves: &[ChildRef],
    candidates: &mut Vec<Candidate>,
) {
    // SAFETY: the caller's promise.
    unsafe {
        let mut tested = [([[0f32; 8]; 3], [0f32; 8]); MAX_LEAVES_TESTED_SINGLY];
        let mut least = V::splat(f32::INFINITY);
        for (found, (center, distance2)) in leaves.iter().zip(&mut tested) {
            let leaf = &tree.leaves[!found.child as usize];
            let c = kernel::into_frames::<V>(leaf, b.relative(tree, leaf.origin));
            let d = kernel::leaf_distance2(leaf, c);
            least = least.min(d);
            for (c, out) in c.iter().zip(center) {
                c.store(out);
            }
            d.store(distance2);
        }
        let limit = least.least().sqrt() + reach;
        let limit = V::splat(limit * limit * SQUARE_UP);
        candidates.clear();
        for (found, ([x, y, z], distance2)) in leaves.iter().zip(&tested) {
            let mut mask = V::load(distance2).le(limit);
            while mask != 0 {
                let lane = mask.trailing_zeros();
                let j = lane as usize & 7;
                mask &= mask - 1;
                candidates.push(Candidate { leaf: !found.child as u32, lane, center: [x[j], y[j], z[j]] });
            }
        }
    }
}

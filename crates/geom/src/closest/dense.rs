//! Few leaves: every triangle that survives against all sixteen points of the block at once.
#![expect(unsafe_code, reason = "loads of vector types need their instructions")]

use crate::closest::block::{Block, Candidate, DENSE, ROUNDING, Scratch, norm};
use crate::closest::kernel;
use crate::closest::tree::Tree;
use crate::simd::lanes::Lanes;

/// Finds, in `s.leaves`, the triangles near enough to the block, tests each against all points, and lists in `s.pairs`
/// those worth settling.
///
/// # Safety
/// The processor has the instructions of both types.
#[inline(always)]
pub unsafe fn dense<V: Lanes<8>, W: Lanes<16>>(tree: &Tree, b: &Block, s: &mut Scratch) {
    let mut error: f32 = 0.0;
    for seed in &s.leaves {
        let l = !seed.child as u32;
        let leaf = &tree.leaves[l as usize];
        error = error.max(ROUNDING * (norm(b.relative(tree, leaf.origin)) + b.reach + leaf.radius));
    }
    // SAFETY: the caller's promise.
    unsafe {
        candidates::<V>(tree, b, 2.0 * b.reach + 4.0 * error, s);
        let d = [W::load(&b.offset[0]), W::load(&b.offset[1]), W::load(&b.offset[2])];
        let mut least = W::splat(f32::INFINITY);
        s.table.resize(s.table.len().max(s.candidates.len()), [0.0; 16]);
        for (c, row) in s.candidates.iter().zip(&mut s.table) {
            let leaf = &tree.leaves[c.leaf as usize];
            let r = kernel::triangle_distance2::<W>(leaf, c.lane as usize, c.centre, d);
            least = least.min(r);
            r.store(row);
        }
        // A rival of `least` must be settled up to `(sqrt least + 2 error)²`.
        let limit = least.sqrt() + W::splat(2.0 * error);
        let limit = limit * limit * W::splat(1.00001);
        let live = (1u32 << b.len) - 1;
        for (c, row) in s.candidates.iter().zip(&s.table) {
            let mut mask = W::load(row).le(limit) & live;
            let slot = tree.leaves[c.leaf as usize].first + c.lane;
            while mask != 0 {
                s.pairs.push((mask.trailing_zeros(), slot));
                mask &= mask - 1;
            }
        }
    }
}

/// Lists in `s.candidates` the triangles that can be nearest to some point: up to `reach` farther from the block's centre than
/// the nearest of all.
#[inline(always)]
unsafe fn candidates<V: Lanes<8>>(tree: &Tree, b: &Block, reach: f32, s: &mut Scratch) {
    // SAFETY: the caller's promise.
    unsafe {
        let mut tested = [([[0f32; 8]; 3], [0f32; 8]); DENSE];
        let mut least = V::splat(f32::INFINITY);
        for (seed, (centre, distance2)) in s.leaves.iter().zip(&mut tested) {
            let leaf = &tree.leaves[!seed.child as usize];
            let c = kernel::into_frames::<V>(leaf, b.relative(tree, leaf.origin));
            let d = kernel::leaf_distance2(leaf, c);
            least = least.min(d);
            for (c, out) in c.iter().zip(centre) {
                c.store(out);
            }
            d.store(distance2);
        }
        let limit = least.least().sqrt() + reach;
        let limit = V::splat(limit * limit * 1.00001);
        s.candidates.clear();
        for (seed, ([x, y, z], distance2)) in s.leaves.iter().zip(&tested) {
            let mut mask = V::load(distance2).le(limit);
            while mask != 0 {
                let lane = mask.trailing_zeros();
                let j = lane as usize & 7;
                mask &= mask - 1;
                s.candidates.push(Candidate { leaf: !seed.child as u32, lane, centre: [x[j], y[j], z[j]] });
            }
        }
    }
}

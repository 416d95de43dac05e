//! Many leaves: the sixteen points walk the tree independently but in step.
//!
//! A single walk waits most of the time for its own last result; sixteen independent ones, level by level and without
//! branches that depend on data, keep the processor busy. All begin at the front that the block has gathered. First every
//! point descends greedily to one leaf, which gives it a bound. Then a queue of (point, node) pairs is worked off, level
//! by level; surviving children are appended by a vector compress, inner nodes to the queue, leaves to a list. The leaves
//! of a level are tested before the next level is entered, with the bounds they have tightened.
//!
//! SAFETY, here and for every function: the caller promises that the processor has the instructions of `V`.
#![expect(
    unsafe_code,
    reason = "loads of vector types need their instructions; growing lists without a branch"
)]

use crate::closest::block::{BLOCK, Block, FRONT, Near, ROUNDING, Row, Scratch};
use crate::closest::kernel;
use crate::closest::layout::Node;
use crate::closest::tree::Tree;
use crate::memory::prefetch;
use crate::simd::lanes::Lanes;

/// What is known of a point's distance.
#[derive(Clone, Copy, Default)]
struct Known {
    /// Square of the least distance found.
    best2: f32,
    /// Bound of the rounding error of the distances found.
    error: f32,
}

/// Lists in `s.pairs` the triangles worth settling for each point. `near` is a point of the surface; `limit` the greatest
/// (scaled) distance that matters.
#[inline(always)]
pub unsafe fn wave<V: Lanes<8>>(tree: &Tree, b: &Block, near: &Near, limit: f32, s: &mut Scratch) {
    unsafe {
        let mut place = [[0f32; 3]; BLOCK];
        for (i, q) in place.iter_mut().enumerate() {
            *q = b.place(i);
        }
        // Distances to the boxes of the front, and the nearest of its children.
        let mut boxes = [[[0f32; 8]; FRONT / 8]; BLOCK];
        let mut here = [0; BLOCK];
        for i in 0..b.len {
            let q = kernel::splat::<V>(place[i]);
            let mut least = f32::INFINITY;
            for (node, out) in s.front.iter().zip(&mut boxes[i]) {
                let d = kernel::box_distance2::<V>(node, q);
                d.store(out);
                let l = d.least();
                let nearest = node.child[d.le(V::splat(l)).trailing_zeros() as usize & 7];
                here[i] = if l < least { nearest } else { here[i] };
                least = if l < least { l } else { least };
            }
        }
        descend::<V>(tree, &place[..b.len], &mut here);
        let x: [f32; 3] = std::array::from_fn(|k| ((near.point[k] - b.centre[k]) * tree.scale) as f32);
        s.rows.clear();
        let (mut known, mut bound) = ([Known::default(); BLOCK], [0f32; BLOCK]);
        for i in 0..b.len {
            let to_x: [f32; 3] = std::array::from_fn(|k| b.offset[k][i] - x[k]);
            known[i].best2 = to_x.iter().map(|e| e * e).sum::<f32>() * 1.00001;
            known[i].error = near.off;
            probe::<V>(tree, b, i, !here[i] as u32, s, &mut known[i]);
            bound[i] = b.bound(i, known[i].best2.sqrt().min(limit), known[i].error);
        }
        s.queue.clear();
        s.found.clear();
        for i in 0..b.len {
            for (node, d) in s.front.iter().zip(&boxes[i]) {
                let mask = V::load(d).le(V::splat(bound[i]));
                let leaf = V::negative(&node.child);
                push::<V>(mask & !leaf, i as i32, node, &mut s.queue);
                push::<V>(mask & leaf, i as i32, node, &mut s.found);
            }
        }
        let (mut next, mut at) = (0, 0);
        loop {
            let level = s.queue.len();
            while next < level {
                let [i, n] = s.queue[next];
                next += 1;
                let node = &tree.nodes[n as usize];
                let q = kernel::splat::<V>(place[i as usize % BLOCK]);
                let mask = kernel::box_distance2::<V>(node, q).le(V::splat(bound[i as usize % BLOCK]));
                let leaf = V::negative(&node.child);
                push::<V>(mask & !leaf, i, node, &mut s.queue);
                push::<V>(mask & leaf, i, node, &mut s.found);
            }
            let tested = at;
            while let Some(&[i, c]) = s.found.get(at) {
                at += 1;
                let i = i as usize % BLOCK;
                if c != here[i] {
                    probe::<V>(tree, b, i, !c as u32, s, &mut known[i]);
                }
            }
            if next == s.queue.len() {
                break;
            }
            if tested < at {
                for i in 0..b.len {
                    bound[i] = b.bound(i, known[i].best2.sqrt().min(limit), known[i].error);
                }
            }
        }
        settle_rows::<V>(&known, s);
    }
}
/// Replaces each point's node by the leaf (as a child number) that a greedy walk down from it ends in.
#[inline(always)]
unsafe fn descend<V: Lanes<8>>(tree: &Tree, places: &[[f32; 3]], here: &mut [i32; BLOCK]) {
    loop {
        let mut moved = false;
        for (h, q) in here.iter_mut().zip(places) {
            if *h >= 0 {
                let node = &tree.nodes[*h as usize];
                // SAFETY: the caller's promise.
                let nearest = unsafe {
                    let d = kernel::box_distance2::<V>(node, kernel::splat(*q));
                    d.le(V::splat(d.least()))
                };
                *h = node.child[nearest.trailing_zeros() as usize & 7];
                moved = true;
            }
        }
        if !moved {
            return;
        }
    }
}

/// Appends `(i, child)` for the children in `mask`.
#[inline(always)]
unsafe fn push<V: Lanes<8>>(mask: u32, i: i32, node: &Node, list: &mut Vec<[i32; 2]>) {
    list.reserve(8);
    let n = list.len();
    // SAFETY: there is room for eight, of which `compress` fills the front; the caller's promise.
    unsafe {
        V::compress(mask, i, &node.child, list.as_mut_ptr().add(n));
        list.set_len(n + mask.count_ones() as usize);
    }
}

/// Tests leaf `l` against point `i`: notes the eight squared distances in `s.rows`, and what is `known` of the point.
#[inline(always)]
unsafe fn probe<V: Lanes<8>>(tree: &Tree, b: &Block, i: usize, l: u32, s: &mut Scratch, known: &mut Known) {
    let leaf = &tree.leaves[l as usize];
    // If it wins, its corners are needed next.
    prefetch(&tree.slots[leaf.first as usize]);
    let r = b.relative(tree, leaf.origin);
    let r: [f32; 3] = std::array::from_fn(|k| r[k] + b.offset[k][i % BLOCK]);
    // SAFETY: the caller's promise.
    let d = unsafe { kernel::leaf_distance2(leaf, kernel::into_frames::<V>(leaf, r)) };
    s.rows.push(Row { distance2: d.array(), first: leaf.first, point: i as u32 });
    let least = d.least();
    known.best2 = if least < known.best2 { least } else { known.best2 };
    // The sum is no less than the length of `r`, and needs no root.
    let e = ROUNDING * (r[0].abs() + r[1].abs() + r[2].abs() + 2.0 * b.reach + leaf.radius);
    known.error = if e > known.error { e } else { known.error };
}

/// From the tested leaves to the triangles worth settling.
#[inline(always)]
unsafe fn settle_rows<V: Lanes<8>>(known: &[Known; BLOCK], s: &mut Scratch) {
    let limit = known.map(|k| {
        let l = k.best2.sqrt() + 2.0 * k.error;
        l * l * 1.00001
    });
    for row in &s.rows {
        // SAFETY: the caller's promise.
        let mut mask = unsafe { V::load(&row.distance2).le(V::splat(limit[row.point as usize % BLOCK])) };
        while mask != 0 {
            s.pairs.push((row.point, row.first + mask.trailing_zeros()));
            mask &= mask - 1;
        }
    }
}

//! Second stage where many leaves are left: each point of the block searches on its own, all in lockstep.
//!
//! One search alone waits most of the time for its own last result. Sixteen independent ones, level by level and without
//! branches that depend on data, keep the processor busy. All begin at what pruning has left.
//! 1. Every point descends to the nearest child, down to one leaf, which gives it a bound.
//! 2. A queue of (point, node) pairs is worked off level by level. Children within the bound are appended by a vector
//!    compress: inner nodes to the queue, leaves to a list.
//! 3. The leaves of a level are tested before the next level is entered, with the bounds they have tightened.
//!
//! SAFETY, here and for every function: the caller promises that the processor has the instructions of `V`.
#![expect(
    unsafe_code,
    reason = "loads of vector types need their instructions; growing lists without a branch"
)]

use crate::closest::block::{POINTS_PER_BLOCK, PointBlock, SQUARE_UP, SurfacePoint};
use crate::closest::decide::Undecided;
use crate::closest::kernel;
use crate::closest::layout::Node;
use crate::closest::prune::{MAX_SURVIVORS, Survivors};
use crate::closest::tree::Tree;
use crate::memory::prefetch;
use crate::num::rounding::SINGLE_DISTANCE_ROUNDING;
use crate::simd::lanes::Lanes;

/// The bounds known for a point's distance.
#[derive(Clone, Copy, Default)]
struct Best {
    /// Square of the least distance found.
    distance2: f32,
    /// Bound of the rounding error of the distances found.
    error: f32,
}

/// A leaf tested against one point.
#[derive(Clone, Copy)]
struct LeafDistances {
    distance2: [f32; 8],
    /// First slot of the leaf.
    first: u32,
    /// Number of the point in the block.
    point: u32,
}

/// Memory of this stage, kept from block to block.
#[derive(Default)]
pub struct Buffers {
    /// The survivors of pruning, as children of nodes of their own.
    start: Vec<Node>,
    /// (point, node) and (point, leaf) pairs.
    queue: Vec<[i32; 2]>,
    found: Vec<[i32; 2]>,
    tested: Vec<LeafDistances>,
}

/// Lists in `undecided` the triangles that may be the closest of each point. `near` is a point of the surface; `limit` the
/// greatest (scaled) distance that matters.
#[inline(always)]
pub unsafe fn search<V: Lanes<8>>(
    tree: &Tree,
    b: &PointBlock,
    near: &SurfacePoint,
    limit: f32,
    survivors: &Survivors,
    s: &mut Buffers,
    undecided: &mut Vec<Undecided>,
) {
    gather_start(tree, survivors, &mut s.start);
    unsafe {
        let mut place = [[0f32; 3]; POINTS_PER_BLOCK];
        for (i, q) in place.iter_mut().enumerate() {
            *q = b.place(i);
        }
        let mut boxes = [[[0f32; 8]; MAX_SURVIVORS / 8]; POINTS_PER_BLOCK];
        let mut here = [0; POINTS_PER_BLOCK];
        nearest_children::<V>(&s.start, &place[..b.len], &mut boxes, &mut here);
        descend::<V>(tree, &place[..b.len], &mut here);
        let x: [f32; 3] = std::array::from_fn(|k| ((near.point[k] - b.center[k]) * tree.scale) as f32);
        s.tested.clear();
        let (mut best, mut bound) = ([Best::default(); POINTS_PER_BLOCK], [0f32; POINTS_PER_BLOCK]);
        for i in 0..b.len {
            let to_x: [f32; 3] = std::array::from_fn(|k| b.offset[k][i] - x[k]);
            best[i].distance2 = to_x.iter().map(|e| e * e).sum::<f32>() * SQUARE_UP;
            best[i].error = near.off;
            test_leaf::<V>(tree, b, i, !here[i] as u32, &mut s.tested, &mut best[i]);
            bound[i] = b.bound(i, best[i].distance2.sqrt().min(limit), best[i].error);
        }
        s.queue.clear();
        s.found.clear();
        for i in 0..b.len {
            for (node, d) in s.start.iter().zip(&boxes[i]) {
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
                let q = kernel::splat::<V>(place[i as usize % POINTS_PER_BLOCK]);
                let mask =
                    kernel::box_distance2::<V>(node, q).le(V::splat(bound[i as usize % POINTS_PER_BLOCK]));
                let leaf = V::negative(&node.child);
                push::<V>(mask & !leaf, i, node, &mut s.queue);
                push::<V>(mask & leaf, i, node, &mut s.found);
            }
            let tested = at;
            while let Some(&[i, c]) = s.found.get(at) {
                at += 1;
                let i = i as usize % POINTS_PER_BLOCK;
                if c != here[i] {
                    test_leaf::<V>(tree, b, i, !c as u32, &mut s.tested, &mut best[i]);
                }
            }
            if next == s.queue.len() {
                break;
            }
            if tested < at {
                for i in 0..b.len {
                    bound[i] = b.bound(i, best[i].distance2.sqrt().min(limit), best[i].error);
                }
            }
        }
        list_undecided::<V>(&best, &s.tested, undecided);
    }
}

/// Squared distances of each place from the boxes that it begins with, and the child whose box is nearest.
///
/// # Safety
/// The processor has the instructions of `V`.
#[inline(always)]
unsafe fn nearest_children<V: Lanes<8>>(
    start: &[Node],
    place: &[[f32; 3]],
    boxes: &mut [[[f32; 8]; MAX_SURVIVORS / 8]; POINTS_PER_BLOCK],
    here: &mut [i32; POINTS_PER_BLOCK],
) {
    for (i, place) in place.iter().enumerate() {
        // SAFETY: the caller's promise.
        let q = unsafe { kernel::splat::<V>(*place) };
        let mut least = f32::INFINITY;
        for (node, out) in start.iter().zip(&mut boxes[i]) {
            // SAFETY: the caller's promise.
            let (d, l) = unsafe {
                let d = kernel::box_distance2::<V>(node, q);
                (d, d.least())
            };
            d.store(out);
            // SAFETY: the caller's promise.
            let nearest = node.child[d.le(unsafe { V::splat(l) }).trailing_zeros() as usize & 7];
            here[i] = if l < least { nearest } else { here[i] };
            least = if l < least { l } else { least };
        }
    }
}

/// Makes what is left the children of nodes of their own, unused ones empty.
#[inline(always)]
fn gather_start(tree: &Tree, survivors: &Survivors, start: &mut Vec<Node>) {
    start.clear();
    let mut all = survivors.leaves.iter().chain(&survivors.open);
    loop {
        let mut node = Node::EMPTY;
        let mut n = 0;
        for (j, found) in all.by_ref().take(8).enumerate() {
            let parent = &tree.nodes[found.parent as usize];
            for side in 0..6 {
                node.bounds[side][j] = parent.bounds[side][found.lane as usize & 7];
            }
            node.child[j] = found.child;
            n += 1;
        }
        if n == 0 {
            break;
        }
        start.push(node);
    }
}

/// Replaces each point's node by the leaf (as a child number) that a greedy walk down from it ends in.
#[inline(always)]
unsafe fn descend<V: Lanes<8>>(tree: &Tree, places: &[[f32; 3]], here: &mut [i32; POINTS_PER_BLOCK]) {
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

/// Tests leaf `l` against point `i`: keeps the eight squared distances, and the least of them in `best`.
#[inline(always)]
unsafe fn test_leaf<V: Lanes<8>>(
    tree: &Tree,
    b: &PointBlock,
    i: usize,
    l: u32,
    tested: &mut Vec<LeafDistances>,
    best: &mut Best,
) {
    let leaf = &tree.leaves[l as usize];
    // If it wins, its corners are needed next.
    prefetch(&tree.slots[leaf.first as usize]);
    let r = b.relative(tree, leaf.origin);
    let r: [f32; 3] = std::array::from_fn(|k| r[k] + b.offset[k][i % POINTS_PER_BLOCK]);
    // SAFETY: the caller's promise.
    let d = unsafe { kernel::leaf_distance2(leaf, kernel::into_frames::<V>(leaf, r)) };
    tested.push(LeafDistances { distance2: d.array(), first: leaf.first, point: i as u32 });
    let least = d.least();
    best.distance2 = if least < best.distance2 { least } else { best.distance2 };
    // The sum is no less than the length of `r`, and needs no root.
    let e = SINGLE_DISTANCE_ROUNDING * (r[0].abs() + r[1].abs() + r[2].abs() + 2.0 * b.reach + leaf.radius);
    best.error = if e > best.error { e } else { best.error };
}

/// From the tested leaves to the triangles that may be the closest.
#[inline(always)]
unsafe fn list_undecided<V: Lanes<8>>(
    best: &[Best; POINTS_PER_BLOCK],
    tested: &[LeafDistances],
    undecided: &mut Vec<Undecided>,
) {
    let limit = best.map(|k| {
        let l = k.distance2.sqrt() + 2.0 * k.error;
        l * l * SQUARE_UP
    });
    for leaf in tested {
        // SAFETY: the caller's promise.
        let mut mask =
            unsafe { V::load(&leaf.distance2).le(V::splat(limit[leaf.point as usize % POINTS_PER_BLOCK])) };
        while mask != 0 {
            undecided.push(Undecided { point: leaf.point, slot: leaf.first + mask.trailing_zeros() });
            mask &= mask - 1;
        }
    }
}

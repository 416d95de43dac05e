//! What a block of points needs of the tree: the few leaves and nodes that can hold the closest triangle of some point.
//!
//! SAFETY, here and for every function: the caller promises that the processor has the instructions of `V`.
#![expect(unsafe_code, reason = "loads of vector types need their instructions")]

use crate::closest::block::{Block, FRONT, Near, ROUNDING, Scratch, Seed, norm};
use crate::closest::kernel::{self, Rival};
use crate::closest::layout::{Leaf, Node};
use crate::closest::tree::Tree;
use crate::memory::prefetch;
use crate::simd::lanes::Lanes;

/// Finds the leaves that the surface point `near` does not dominate for the whole block, breadth first, as long as they are
/// few: in `s.leaves` those found, in `s.open` the nodes whose children would have made them more than [`FRONT`]. What is
/// farther than `limit` from every point of the block is left out.
#[inline(always)]
pub unsafe fn gather<V: Lanes<8>>(tree: &Tree, b: &Block, near: &Near, limit: f32, s: &mut Scratch) {
    let x: [f32; 3] = std::array::from_fn(|k| ((near.point[k] - tree.centre[k]) * tree.scale) as f32);
    // Of x, of the block's place, of the boxes.
    let error = near.off + ROUNDING * x.iter().chain(&b.at).fold(1.0, |m: f32, v| m.max(v.abs()));
    let far = norm(std::array::from_fn(|k| b.at[k] - x[k])) + error + b.reach;
    let limit = limit + b.reach + 4.0 * (error + ROUNDING * (b.reach + limit));
    s.leaves.clear();
    s.open.clear();
    if tree.root < 0 {
        s.leaves.push(Seed { child: tree.root, parent: 0, lane: 0 });
        return;
    }
    // SAFETY: the caller's promise.
    unsafe {
        let slack = V::splat(4.0 * error * far + error * error + 32.0 * ROUNDING * far * far);
        let rival = Rival::<V>::new(b.at, b.half.map(|h| h + error), x);
        let centre = kernel::splat::<V>(b.at);
        let mut n = tree.root;
        let mut next = 0;
        loop {
            let node = &tree.nodes[n as usize];
            let mut mask = kernel::advantage::<V>(node, &rival).le(slack);
            if limit < far {
                mask &= kernel::box_distance2::<V>(node, centre).le(V::splat(limit * limit));
            }
            if s.leaves.len() + s.open.len() - next + mask.count_ones() as usize > FRONT {
                next -= 1; // `n` stays unopened
                break;
            }
            while mask != 0 {
                let lane = mask.trailing_zeros();
                mask &= mask - 1;
                let child = node.child[lane as usize & 7];
                let seed = Seed { child, parent: n as u32, lane };
                if child < 0 { s.leaves.push(seed) } else { s.open.push(seed) }
            }
            match s.open.get(next) {
                Some(seed) => n = seed.child,
                None => break,
            }
            next += 1;
        }
        s.open.drain(..next);
    }
    for l in &s.leaves {
        prefetch_leaf(&tree.leaves[!l.child as usize]);
    }
}

/// Makes what [`gather`] found the children of nodes of their own, `s.front`, unused ones empty.
#[inline(always)]
pub fn plant(tree: &Tree, s: &mut Scratch) {
    s.front.clear();
    let mut seeds = s.leaves.iter().chain(&s.open);
    loop {
        let mut node = Node::EMPTY;
        let mut n = 0;
        for (j, seed) in seeds.by_ref().take(8).enumerate() {
            let parent = &tree.nodes[seed.parent as usize];
            for side in 0..6 {
                node.bounds[side][j] = parent.bounds[side][seed.lane as usize & 7];
            }
            node.child[j] = seed.child;
            n += 1;
        }
        if n == 0 {
            break;
        }
        s.front.push(node);
    }
}

#[inline(always)]
fn prefetch_leaf(leaf: &Leaf) {
    for f in leaf.field.iter().step_by(2) {
        prefetch(f);
    }
    prefetch(&leaf.origin);
}

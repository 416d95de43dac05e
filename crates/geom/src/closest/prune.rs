//! First stage: exclude what cannot matter to any point of a block.
//!
//! The few leaves and nodes remain that can hold the closest triangle of some point.
//!
//! SAFETY, here and for every function: the caller promises that the processor has the instructions of `V`.
#![expect(unsafe_code, reason = "loads of vector types need their instructions")]

use crate::closest::block::{PointBlock, SurfacePoint, norm};
use crate::closest::kernel::{self, Domination};
use crate::closest::layout::Leaf;
use crate::closest::tree::Tree;
use crate::memory::prefetch;
use crate::num::rounding::SINGLE_DISTANCE_ROUNDING;
use crate::simd::lanes::Lanes;

/// Up to so many leaves, and no open node, the block is tested triangle by triangle. (8 and 12 are slower.)
pub const MAX_LEAVES_TESTED_SINGLY: usize = 10;
/// Most leaves and open nodes: the children of two nodes. (24 are slower.)
pub const MAX_SURVIVORS: usize = 16;

/// A child of a node: what it is, and where its box stands.
#[derive(Clone, Copy)]
pub struct ChildRef {
    /// Index of a node, or `!index` of a leaf.
    pub child: i32,
    /// Node and lane that hold its box.
    pub parent: u32,
    pub lane: u32,
}

/// The leaves and nodes that are not excluded for a block.
#[derive(Default)]
pub struct Survivors {
    /// Leaves that can hold the closest triangle of some point.
    pub leaves: Vec<ChildRef>,
    /// Nodes that can hold further ones; together with the leaves at most [`MAX_SURVIVORS`].
    pub open: Vec<ChildRef>,
}

impl Survivors {
    /// So few triangles are left that all of them are tested against all points.
    #[inline(always)]
    pub fn are_few(&self) -> bool {
        self.open.is_empty() && self.leaves.len() <= MAX_LEAVES_TESTED_SINGLY
    }
}

/// Finds the leaves that the surface point `near` does not dominate for the whole block, breadth first. A node whose children
/// would make the list longer than [`MAX_SURVIVORS`] stays open. Nodes farther than `limit` (scaled) from every point of the
/// block are left out.
#[inline(always)]
pub unsafe fn prune<V: Lanes<8>>(
    tree: &Tree,
    b: &PointBlock,
    near: &SurfacePoint,
    limit: f32,
    s: &mut Survivors,
) {
    let x: [f32; 3] = std::array::from_fn(|k| ((near.point[k] - tree.center[k]) * tree.scale) as f32);
    // The error of x, of the block's place, of the boxes.
    let error =
        near.off + SINGLE_DISTANCE_ROUNDING * x.iter().chain(&b.at).fold(1.0, |m: f32, v| m.max(v.abs()));
    let far = norm(std::array::from_fn(|k| b.at[k] - x[k])) + error + b.reach;
    let limit = limit + b.reach + 4.0 * (error + SINGLE_DISTANCE_ROUNDING * (b.reach + limit));
    s.leaves.clear();
    s.open.clear();
    if tree.root < 0 {
        s.leaves.push(ChildRef { child: tree.root, parent: 0, lane: 0 });
        return;
    }
    // SAFETY: the caller's promise.
    unsafe {
        let slack = V::splat(4.0 * error * far + error * error + 32.0 * SINGLE_DISTANCE_ROUNDING * far * far);
        let domination = Domination::<V>::new(b.at, b.half.map(|h| h + error), x);
        let center = kernel::splat::<V>(b.at);
        let mut n = tree.root;
        let mut next = 0;
        loop {
            let node = &tree.nodes[n as usize];
            let mut mask = kernel::domination_margin::<V>(node, &domination).le(slack);
            if limit < far {
                mask &= kernel::box_distance2::<V>(node, center).le(V::splat(limit * limit));
            }
            if s.leaves.len() + s.open.len() - next + mask.count_ones() as usize > MAX_SURVIVORS {
                next -= 1; // `n` stays unopened
                break;
            }
            while mask != 0 {
                let lane = mask.trailing_zeros();
                mask &= mask - 1;
                let child = node.child[lane as usize & 7];
                let found = ChildRef { child, parent: n as u32, lane };
                if child < 0 { s.leaves.push(found) } else { s.open.push(found) }
            }
            match s.open.get(next) {
                Some(open) => n = open.child,
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

#[inline(always)]
fn prefetch_leaf(leaf: &Leaf) {
    for f in leaf.field.iter().step_by(2) {
        prefetch(f);
    }
    prefetch(&leaf.origin);
}

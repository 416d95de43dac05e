//! The work on one block of sixteen points: walk, gather, test, settle. See the module `query` for the plan.
//!
//! SAFETY, here and for every function: the caller promises that the processor has the instructions of the types.
#![expect(unsafe_code, reason = "loads of vector types need their instructions; prefetching")]

use crate::closest::block::{BLOCK, Block, DENSE, ROUNDING, Scratch, norm};
use crate::closest::kernel::{self, Rival};
use crate::closest::lanes::{Lanes, Real};
use crate::closest::query::Hit;
use crate::closest::tree::{Leaf, Node, Tree};
use crate::closest::triangle;
use crate::closest::{dense::dense, settle::settle, wave::wave};
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

#[inline(always)]
fn prefetch<T>(p: &T) {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: every x86-64 processor has the instruction, and it has no effect but on the cache.
    unsafe {
        std::arch::x86_64::_mm_prefetch::<{ std::arch::x86_64::_MM_HINT_T0 }>(std::ptr::from_ref(p).cast())
    };
    let _ = p;
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
        let Some(slot) = nearest::<V>(tree, &b, limit, s) else { return };
        let x = triangle::closest_point(&b.centre, &tree.triangle(slot)).point;
        let near = gather::<V>(tree, &b, x, s);
        s.pairs.clear();
        match near {
            Some(near) => dense::<V, W>(tree, &b, near, s),
            None => wave::<V>(tree, &b, x, limit, s),
        }
        settle::<D>(tree, &b, s, hits);
    }
    // Where nothing was near enough, the start of the block before serves on.
    s.warm = hits.iter().rev().find(|h| h.face != Hit::NONE.face).map(|h| h.slot).or(s.warm);
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

/// Slot of the triangle nearest to the block's centre (to single precision: any nearby surface point would do), or `None`
/// if every point of the block is farther than `limit` from the mesh.
#[inline(always)]
unsafe fn nearest<V: Lanes<8>>(tree: &Tree, b: &Block, limit: f32, s: &mut Scratch) -> Option<u32> {
    let mut slot = s.warm.unwrap_or(0);
    let (d, _) = triangle::squared_distance(&b.centre, &tree.triangle(slot));
    let mut best = (d * tree.scale * tree.scale) as f32;
    let mut found = true;
    // Farther than this from the centre, with room for the rounding of the places involved, is too far for every point.
    let size = b.at.iter().fold(1.0, |m: f32, x| m.max(x.abs()));
    let limit = limit + b.reach + 4.0 * ROUNDING * (size + b.reach + limit);
    if limit * limit < best {
        (best, found) = (limit * limit, false);
    }
    unsafe {
        let q = kernel::splat::<V>(b.at);
        s.stack.clear();
        let mut here = tree.root;
        loop {
            if here < 0 {
                let leaf = &tree.leaves[!here as usize];
                let c = kernel::into_frames::<V>(leaf, b.relative(tree, leaf.origin));
                let d = kernel::leaf_distance2(leaf, c);
                let mut mask = d.le(V::splat(best));
                if mask != 0 {
                    let out = d.array();
                    while mask != 0 {
                        let j = mask.trailing_zeros();
                        mask &= mask - 1;
                        if out[j as usize & 7] <= best {
                            best = out[j as usize & 7];
                            slot = leaf.first + j;
                            found = true;
                        }
                    }
                }
            } else {
                let node = &tree.nodes[here as usize];
                let d = kernel::box_distance2::<V>(node, q);
                stack_children(d, d.le(V::splat(best)), node, &mut s.stack);
            }
            here = loop {
                match s.stack.pop() {
                    None => return found.then_some(slot),
                    Some((d, n)) if d <= best => break n,
                    Some(_) => {}
                }
            };
        }
    }
}

/// Lists in `s.leaves` every leaf that the surface point `x` does not dominate, and returns the distance from the centre
/// to `x`; `None` if there are more than [`DENSE`]. In `s.cut`, the deepest node that holds them all.
#[inline(always)]
unsafe fn gather<V: Lanes<8>>(tree: &Tree, b: &Block, x: Point, s: &mut Scratch) -> Option<f32> {
    let x: [f32; 3] = std::array::from_fn(|k| ((x[k] - tree.centre[k]) * tree.scale) as f32);
    // Of x, of the block's place, of the boxes.
    let error = ROUNDING * x.iter().chain(&b.at).fold(1.0, |m: f32, v| m.max(v.abs()));
    let near = norm(std::array::from_fn(|k| b.at[k] - x[k])) + error;
    let far = near + b.reach;
    s.leaves.clear();
    s.cut = tree.root;
    if tree.root < 0 {
        s.leaves.push(!tree.root as u32);
        return Some(near);
    }
    s.stack.clear();
    s.stack.push((0.0, tree.root));
    unsafe {
        let slack = V::splat(4.0 * error * far + error * error + 32.0 * ROUNDING * far * far);
        let rival = Rival::<V>::new(b.at, b.half.map(|h| h + error), x);
        while let Some((_, n)) = s.stack.pop() {
            let node = &tree.nodes[n as usize];
            let mut mask = kernel::advantage::<V>(node, &rival).le(slack);
            if s.cut == n && mask.is_power_of_two() && node.child[mask.trailing_zeros() as usize & 7] >= 0 {
                s.cut = node.child[mask.trailing_zeros() as usize & 7];
            }
            while mask != 0 {
                let c = node.child[mask.trailing_zeros() as usize & 7];
                mask &= mask - 1;
                if c < 0 {
                    s.leaves.push(!c as u32);
                } else {
                    s.stack.push((0.0, c));
                }
            }
            if s.leaves.len() > DENSE {
                return None;
            }
        }
    }
    for &l in &s.leaves {
        prefetch_leaf(&tree.leaves[l as usize]);
    }
    Some(near)
}

#[inline(always)]
fn prefetch_leaf(leaf: &Leaf) {
    for f in leaf.field.iter().step_by(2) {
        prefetch(f);
    }
    prefetch(&leaf.origin);
}

/// Puts the children in `mask` on the stack, the nearest on top.
#[inline(always)]
fn stack_children<V: Lanes<8>>(d: V, mut mask: u32, node: &Node, stack: &mut Vec<(f32, i32)>) {
    if mask == 0 {
        return;
    }
    let out = d.array();
    let base = stack.len();
    while mask != 0 {
        let j = mask.trailing_zeros() as usize & 7;
        mask &= mask - 1;
        let e = (out[j], node.child[j]);
        stack.push(e);
        let mut i = stack.len() - 1;
        while i > base && stack[i - 1].0 < e.0 {
            stack[i] = stack[i - 1];
            i -= 1;
        }
        stack[i] = e;
    }
}

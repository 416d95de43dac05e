//! Triangles in space-filling order, eight to a leaf, leaves eight to a node, and so on: no pointers.
//!
//! Coordinates are kept in single precision. Where those of the mesh are single precision (any STL), that is exact. Otherwise
//! they are moved and scaled (by a power of two) into [−1, 1] before they are rounded, and `slack` bounds that rounding. Boxes
//! are that much larger, and the filter that much more careful.
#![expect(unsafe_code, reason = "arrays written by several threads, each place once")]
#![expect(clippy::needless_range_loop, reason = "axes and lanes are indices into several arrays at once")]

use crate::memory::{Shared, large_pages, prefetch};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::space::{Aabb, Point};
use crate::topology::Topology;

/// Triangles of a leaf, children of a node: what one vector holds.
pub(super) const TREE_WIDTH: usize = 8;
/// Buckets of the first pass of the sort, as a power of two.
const SORT_BUCKET_BITS: u32 = 12;
/// Keys that one task makes and sorts into buckets.
const KEYS_PER_TASK: usize = 1 << 15;
/// Leaves of one task.
const LEAVES_PER_TASK: usize = 1 << 9;
/// Key of a face that stays out.
const EXCLUDED_KEY: u64 = u64::MAX;

/// Boxes of the children of a node (least and greatest coordinates); empty boxes fill up.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Boxes(pub [[f32; TREE_WIDTH]; 6]);

/// Triangles: nine coordinates, three corners, face.
#[derive(Clone, Copy)]
#[repr(align(32))]
pub(super) struct Leaf {
    pub at: [[[f32; TREE_WIDTH]; 3]; 3],
    pub corner: [[u32; TREE_WIDTH]; 3],
    pub face: [u32; TREE_WIDTH],
}

/// From the mesh to single precision: `(p - origin) * scale`, off by at most `slack` in each coordinate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub origin: Point,
    pub scale: f64,
    pub slack: f32,
}

/// `levels[0][i]` holds the boxes of the triangles of leaf `i`, `levels[k][i]` those of `levels[k - 1][8 i..]`.
pub(super) struct Tree {
    pub leaves: Vec<Leaf>,
    pub levels: Vec<Vec<Boxes>>,
    pub frame: Frame,
    /// For each node of each level the children (bit by bit) that hold a facet of `selected`; nothing at all where all do.
    pub asked: Vec<Vec<u32>>,
}

impl Frame {
    /// The frame for vertices at finite places.
    fn of(mesh: &Mesh, bounds: &Aabb) -> Frame {
        // Far enough from the ends of single precision that products of three differences stay inside.
        const MAX_SINGLE_COORDINATE: f64 = 1e9;
        let single =
            |x: &f64| x.abs() < MAX_SINGLE_COORDINATE && f64::from(*x as f32) == *x || !x.is_finite();
        if mesh.positions.par_iter().all(|p| p.iter().all(single)) {
            return Frame { origin: [0.0; 3], scale: 1.0, slack: 0.0 };
        }
        let origin: Point = std::array::from_fn(|k| bounds.min[k] / 2.0 + bounds.max[k] / 2.0);
        let reach =
            (0..3).map(|k| bounds.max[k] / 2.0 - bounds.min[k] / 2.0).fold(f64::MIN_POSITIVE, f64::max);
        // 2^-23 is four times the rounding of a number below 1.
        Frame {
            origin,
            scale: 0.5 * 2f64.powi(-(libm::log2(reach).ceil() as i32)),
            slack: 1.0 / (1 << 23) as f32,
        }
    }

    /// A place in the frame, not rounded yet.
    #[inline(always)]
    pub fn place(&self, p: &Point) -> Point {
        std::array::from_fn(|k| (p[k] - self.origin[k]) * self.scale)
    }
}

/// The least and the greatest of three numbers, none of them NaN: as plain comparisons, which are one instruction each.
#[inline(always)]
fn extremes<T: Copy + PartialOrd>([a, b, c]: [T; 3]) -> (T, T) {
    let least = |a: T, b: T| if b < a { b } else { a };
    let greatest = |a: T, b: T| if b > a { b } else { a };
    (least(least(a, b), c), greatest(greatest(a, b), c))
}

/// Spreads twelve bits, two places between them.
fn spread(x: u32) -> u64 {
    let x = u64::from(x);
    let x = (x | x << 16) & 0xFF00_00FF;
    let x = (x | x << 8) & 0x00F0_0F00_F00F;
    let x = (x | x << 4) & 0x0C30_C30C_30C3;
    (x | x << 2) & 0x2492_4924_9249
}

/// Faces that are `wanted`, sorted by the Morton code of the centers of their boxes, as keys. The low bits of a key, so many,
/// are the face.
fn sorted(
    mesh: &Mesh,
    frame: &Frame,
    bounds: &Aabb,
    wanted: impl Fn(usize) -> bool + Sync,
) -> (Vec<u64>, u32) {
    // 28 bits for the face and 36 for the place, or 31 and 33.
    let face_bits = if mesh.faces.len() <= 1 << 28 { 28 } else { 31 };
    let extent = bounds.sides().into_iter().fold(f64::MIN_POSITIVE, f64::max) * frame.scale;
    let low = frame.place(&bounds.min);
    let factor = f64::from(1 << 12) * 0.99999 / extent * 0.5;
    let key = |i: usize, face: &[u32; 3]| {
        let p = face.map(|v| frame.place(&mesh.positions[v as usize]));
        let cell = |k: usize| {
            let (a, b) = extremes([p[0][k], p[1][k], p[2][k]]);
            spread((((a - low[k]) + (b - low[k])) * factor) as u32 & 0xFFF)
        };
        let code = cell(0) << 2 | cell(1) << 1 | cell(2);
        (code >> (face_bits - 28)) << face_bits | i as u64
    };
    let bucket = |k: u64| (k >> (64 - SORT_BUCKET_BITS)) as usize;
    let mut keys = large_pages(vec![0u64; mesh.faces.len()]);
    let counts: Vec<Vec<u32>> =
        (keys.par_chunks_mut(KEYS_PER_TASK).zip(mesh.faces.par_chunks(KEYS_PER_TASK)).enumerate())
            .map(|(i, (keys, faces))| {
                let mut count = vec![0; 1 << SORT_BUCKET_BITS];
                for (j, (k, f)) in keys.iter_mut().zip(faces).enumerate() {
                    let face = i * KEYS_PER_TASK + j;
                    *k = if wanted(face) { key(face, f) } else { EXCLUDED_KEY };
                    count[bucket(*k)] += u32::from(*k != EXCLUDED_KEY);
                }
                count
            })
            .collect();
    let (mut ends, mut total) = (vec![0; 1 << SORT_BUCKET_BITS], 0);
    let mut starts = counts;
    for (b, end) in ends.iter_mut().enumerate() {
        for s in &mut starts {
            total += std::mem::replace(&mut s[b], total);
        }
        *end = total as usize;
    }
    let mut out = large_pages(vec![0u64; total as usize]);
    let to = Shared::of(&mut out);
    keys.par_chunks(KEYS_PER_TASK).zip(starts).for_each(|(keys, mut at)| {
        for &k in keys.iter().filter(|&&k| k != EXCLUDED_KEY) {
            let a = &mut at[bucket(k)];
            // SAFETY: the counts above give every key a place of its own below `total`.
            unsafe { to.at(*a as usize).write(k) };
            *a += 1;
        }
    });
    let (mut rest, mut parts, mut start) = (&mut out[..], vec![], 0);
    for e in ends {
        let (part, later) = rest.split_at_mut(e - start);
        (rest, start) = (later, e);
        parts.push(part);
    }
    parts.into_par_iter().for_each(|p| p.sort_unstable());
    (out, face_bits)
}

const NOTHING: Boxes = Boxes([
    [f32::INFINITY; TREE_WIDTH],
    [f32::INFINITY; TREE_WIDTH],
    [f32::INFINITY; TREE_WIDTH],
    [f32::NEG_INFINITY; TREE_WIDTH],
    [f32::NEG_INFINITY; TREE_WIDTH],
    [f32::NEG_INFINITY; TREE_WIDTH],
]);

/// A leaf and its boxes. The places of the triangles without area, `flat`, stay empty, and these are never found.
fn leaf(mesh: &Mesh, frame: &Frame, flat: &[u32], faces: impl Iterator<Item = usize>) -> (Leaf, Boxes) {
    let mut leaf = Leaf {
        at: [[[0.0; TREE_WIDTH]; 3]; 3],
        corner: [[u32::MAX; TREE_WIDTH]; 3],
        face: [u32::MAX; TREE_WIDTH],
    };
    let mut boxes = NOTHING;
    for (i, number) in faces.enumerate() {
        let face = mesh.faces[number];
        let p = face.map(|v| frame.place(&mesh.positions[v as usize]).map(|x| x as f32));
        if flat.is_empty() || flat.binary_search(&(number as u32)).is_err() {
            for k in 0..3 {
                let (least, greatest) = extremes([p[0][k], p[1][k], p[2][k]]);
                boxes.0[k][i] = least - frame.slack;
                boxes.0[k + 3][i] = greatest + frame.slack;
            }
        }
        leaf.face[i] = number as u32;
        for j in 0..3 {
            leaf.corner[j][i] = face[j];
            for k in 0..3 {
                leaf.at[j][k][i] = p[j][k];
            }
        }
    }
    (leaf, boxes)
}

/// Box of all children.
fn hull(b: &Boxes) -> [f32; 6] {
    let mut hull = b.0.map(|row| row[0]);
    for i in 1..TREE_WIDTH {
        for k in 0..3 {
            let (low, high) = (b.0[k][i], b.0[k + 3][i]);
            hull[k] = if low < hull[k] { low } else { hull[k] };
            hull[k + 3] = if high > hull[k + 3] { high } else { hull[k + 3] };
        }
    }
    hull
}

/// One bit each, the first the lowest.
fn bits(flags: impl Iterator<Item = bool>) -> u32 {
    (0..).zip(flags).fold(0, |bits, (i, flag)| bits | u32::from(flag) << i)
}

/// Which facets of each leaf are among `selected`.
fn asked(leaves: &[Leaf], selected: &[bool]) -> Vec<u32> {
    let flag = |facet: u32| selected.get(facet as usize).copied().unwrap_or(false);
    leaves.par_iter().map(|leaf| bits(leaf.face.into_iter().map(flag))).collect()
}

impl Tree {
    /// The tree of the facets that are `wanted`. Uses the current rayon pool; worth nothing where `progress` says that it
    /// is cancelled.
    pub fn build(
        mesh: &Mesh,
        topology: &Topology,
        wanted: &[bool],
        selected: Option<&[bool]>,
        progress: &dyn Progress,
    ) -> Tree {
        let bounds = mesh.finite_bounds();
        let frame = Frame::of(mesh, &bounds);
        let alone = |f: usize| wanted[f];
        let (keys, face_bits) = sorted(mesh, &frame, &bounds, alone);
        let face = |key: &u64| (key & ((1 << face_bits) - 1)) as usize;
        let n = keys.len().div_ceil(TREE_WIDTH);
        let mut leaves: Vec<Leaf> = large_pages(Vec::with_capacity(n));
        let mut boxes: Vec<Boxes> = large_pages(Vec::with_capacity(n));
        let (l, b) = (Shared::of(&mut leaves), Shared::of(&mut boxes));
        keys.par_chunks(TREE_WIDTH * LEAVES_PER_TASK).enumerate().for_each(|(i, keys)| {
            // Faces and corners lie anywhere: those of the next leaves are sent for.
            let ahead = |leaf: usize| keys.iter().skip(leaf * TREE_WIDTH).take(TREE_WIDTH).map(face);
            let stopped = progress.cancelled();
            for (j, part) in keys.chunks(TREE_WIDTH).enumerate() {
                let part = if stopped { &[] } else { part };
                ahead(j + 4).for_each(|f| prefetch(&mesh.faces[f]));
                ahead(j + 2).flat_map(|f| mesh.faces[f]).for_each(|v| prefetch(&mesh.positions[v as usize]));
                let (leaf, boxes) = leaf(mesh, &frame, &topology.collinear, part.iter().map(face));
                let at = i * LEAVES_PER_TASK + j;
                // SAFETY: each of the `n` places allocated is written once.
                unsafe { (l.at(at).write(leaf), b.at(at).write(boxes)) };
            }
        });
        // SAFETY: all written above.
        unsafe { (leaves.set_len(n), boxes.set_len(n)) };
        let mut asked: Vec<Vec<u32>> =
            selected.map(|selected| asked(&leaves, selected)).into_iter().collect();
        let mut levels = vec![boxes];
        while levels[levels.len() - 1].len() > 1 {
            let up = levels[levels.len() - 1].par_chunks(TREE_WIDTH).map(|part| {
                let mut b = NOTHING;
                for (i, c) in part.iter().enumerate() {
                    for (k, x) in hull(c).into_iter().enumerate() {
                        b.0[k][i] = x;
                    }
                }
                b
            });
            levels.push(up.collect());
            if let Some(below) = asked.last() {
                let up = below.chunks(TREE_WIDTH).map(|part| bits(part.iter().map(|b| *b != 0))).collect();
                asked.push(up);
            }
        }
        Tree { leaves, levels, frame, asked }
    }

    /// Whether child `a` of node `i` holds a facet of `selected`: then its pairs with all others are asked for.
    #[inline(always)]
    pub fn is_asked(&self, level: usize, i: usize, a: usize) -> bool {
        self.asked.get(level).is_none_or(|asked| asked[i] >> a & 1 == 1)
    }

    /// The facets whose boxes reach into `bounds`, in the order of the tree.
    pub fn reaching(&self, bounds: &Aabb) -> Vec<u32> {
        let overlaps = self.overlaps(bounds);
        let top = self.levels.len() - 1;
        let (mut stack, mut found) = (vec![(top, 0)], vec![]);
        while let Some((level, node)) = stack.pop() {
            let Some(boxes) = self.levels[level].get(node) else { continue };
            for i in (0..TREE_WIDTH).filter(|&i| overlaps(boxes, i)) {
                match level {
                    0 => found.push(self.leaves[node].face[i]),
                    _ => stack.push((level - 1, node * TREE_WIDTH + i)),
                }
            }
        }
        found
    }

    /// The facets whose boxes reach into some of `bounds`, each once. Nodes of which all are found are not entered again.
    pub fn reaching_any(&self, bounds: &[Aabb], progress: &dyn Progress) -> Vec<u32> {
        // For each node the children that hold facets not found yet.
        let is_full = |b: &Boxes| bits((0..TREE_WIDTH).map(|i| b.0[0][i] <= b.0[3][i]));
        let mut left: Vec<Vec<u32>> =
            self.levels.iter().map(|level| level.iter().map(is_full).collect()).collect();
        let top = self.levels.len() - 1;
        let (mut stack, mut found) = (vec![], vec![]);
        for (n, bounds) in bounds.iter().enumerate() {
            if n % (1 << 10) == 0 && progress.cancelled() {
                break;
            }
            let overlaps = self.overlaps(bounds);
            stack.push((top, 0));
            while let Some((level, node)) = stack.pop() {
                let Some(boxes) = self.levels[level].get(node) else { continue };
                let open = left[level][node];
                for i in (0..TREE_WIDTH).filter(|&i| open >> i & 1 == 1 && overlaps(boxes, i)) {
                    if level > 0 {
                        stack.push((level - 1, node * TREE_WIDTH + i));
                        continue;
                    }
                    found.push(self.leaves[node].face[i]);
                    let (mut level, mut child) = (0, node * TREE_WIDTH + i);
                    while level <= top {
                        let of = &mut left[level][child / TREE_WIDTH];
                        *of &= !(1 << (child % TREE_WIDTH));
                        if *of != 0 {
                            break;
                        }
                        (level, child) = (level + 1, child / TREE_WIDTH);
                    }
                }
            }
        }
        found
    }

    /// Whether a box of a node reaches into `bounds`.
    fn overlaps(&self, bounds: &Aabb) -> impl Fn(&Boxes, usize) -> bool {
        // Rounded outwards: a place may be off by the slack, and once more by rounding.
        let place = [bounds.min, bounds.max].map(|p| self.frame.place(&p));
        let low: [f32; 3] = std::array::from_fn(|k| (place[0][k] as f32).next_down() - self.frame.slack);
        let high: [f32; 3] = std::array::from_fn(|k| (place[1][k] as f32).next_up() + self.frame.slack);
        move |b: &Boxes, i: usize| (0..3).all(|k| b.0[k][i] <= high[k] && low[k] <= b.0[k + 3][i])
    }
}

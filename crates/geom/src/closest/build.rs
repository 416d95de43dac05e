//! Building the tree: parallel binned surface-area heuristic, straight into nodes of eight.
//!
//! A range of triangles is split in two where the *surface-area heuristic* (MacDonald & Booth 1990), evaluated at
//! 16 bins per axis (Wald 2007), is least; the cost of a side is its box area times the number of full leaves it
//! needs, which favours splits at multiples of eight. To make a node of eight children, the child with the largest
//! box is split again until there are eight (Wald, Benthin & Boulos 2008); no binary tree is ever stored.
//! Large children are built in parallel and their node lists joined in a fixed order, so the tree does not depend
//! on the number of threads.

use crate::closest::frame;
use crate::closest::tree::{Node, Tree};
use crate::mesh::Mesh;
use crate::space::Aabb;
use rayon::prelude::*;

/// Triangles per leaf at most.
const LEAF: usize = 8;
const BINS: usize = 16;
/// Ranges larger than this are boxed and binned by several threads: blocks of this many items, merged in any order,
/// because least, most and count do not depend on it.
const SHARE: usize = 1 << 16;
/// Ranges larger than this are built by a task of their own.
const TASK: usize = 8192;
/// Boxes are widened by this (scaled units), more than the rounding of a corner to single precision.
const PAD: f32 = 1.2e-7;

/// Added to a face id that travels as a float, so that it is never a denormal or NaN (both can be slow).
const ID: u32 = 0x3f80_0000;

/// Box of a triangle or of many, and the face id in the fourth place of `lo`.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
struct Bounds {
    lo: [f32; 4],
    hi: [f32; 4],
}

#[inline(always)]
fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}
#[inline(always)]
fn most(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

impl Bounds {
    const EMPTY: Bounds = Bounds { lo: [f32::INFINITY; 4], hi: [f32::NEG_INFINITY; 4] };

    #[inline(always)]
    fn add(&mut self, o: &Bounds) {
        for k in 0..4 {
            self.lo[k] = least(self.lo[k], o.lo[k]);
            self.hi[k] = most(self.hi[k], o.hi[k]);
        }
    }
    /// Twice the centre, in the first three places.
    #[inline(always)]
    fn centre2(&self) -> [f32; 4] {
        std::array::from_fn(|k| self.lo[k] + self.hi[k])
    }
    /// Half the surface area.
    fn area(&self) -> f32 {
        let [x, y, z] = std::array::from_fn(|k| self.hi[k] - self.lo[k]);
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }
}

/// A triangle while the tree is built.
type Item = Bounds;

/// Box and number of the items in each bin of each axis.
type Bins = [[(Bounds, u32); BINS]; 3];

/// A range of items, with the boxes of the items and of their doubled centres.
struct Range<'a> {
    items: &'a mut [Item],
    /// Index of the first item in the whole.
    start: usize,
    bounds: Bounds,
    centres: Bounds,
}

impl<'a> Range<'a> {
    fn new(items: &'a mut [Item], start: usize) -> Self {
        let of = |part: &[Item]| {
            let mut r = (Bounds::EMPTY, Bounds::EMPTY);
            for i in part {
                r.0.add(i);
                let c = i.centre2();
                r.1.add(&Bounds { lo: c, hi: c });
            }
            r
        };
        let merge = |mut a: (Bounds, Bounds), b: (Bounds, Bounds)| {
            a.0.add(&b.0);
            a.1.add(&b.1);
            a
        };
        let (bounds, centres) = if items.len() <= SHARE {
            of(items)
        } else {
            items.par_chunks(SHARE).map(of).reduce(|| (Bounds::EMPTY, Bounds::EMPTY), merge)
        };
        Range { items, start, bounds, centres }
    }

    /// The best of 3 x 15 planes: axis, bin, and the factors that give an item's bin.
    fn best_plane(&self) -> Option<(usize, usize, f32, f32)> {
        let origin: [f32; 3] = std::array::from_fn(|k| self.centres.lo[k]);
        let factor: [f32; 3] = std::array::from_fn(|k| {
            let e = self.centres.hi[k] - self.centres.lo[k];
            if e > 0.0 { BINS as f32 * 0.99999 / e } else { 0.0 }
        });
        const EMPTY: Bins = [[(Bounds::EMPTY, 0); BINS]; 3];
        let of = |mut bin: Bins, part: &[Item]| {
            for i in part {
                let c = i.centre2();
                for k in 0..3 {
                    let b = &mut bin[k][bin_of(c[k], origin[k], factor[k])];
                    b.0.add(i);
                    b.1 += 1;
                }
            }
            bin
        };
        let merge = |mut a: Bins, b: Bins| {
            for (a, b) in a.iter_mut().flatten().zip(b.iter().flatten()) {
                a.0.add(&b.0);
                a.1 += b.1;
            }
            a
        };
        let bin = if self.items.len() <= SHARE {
            of(EMPTY, self.items)
        } else {
            self.items.par_chunks(SHARE).map(|p| of(EMPTY, p)).reduce(|| EMPTY, merge)
        };
        let mut best = (f32::INFINITY, None);
        for k in (0..3).filter(|&k| factor[k] > 0.0) {
            let mut right = [(0.0, 0); BINS];
            let (mut box_, mut n) = (Bounds::EMPTY, 0);
            for j in (1..BINS).rev() {
                box_.add(&bin[k][j].0);
                n += bin[k][j].1;
                right[j] = (box_.area(), n);
            }
            (box_, n) = (Bounds::EMPTY, 0);
            for j in 0..BINS - 1 {
                box_.add(&bin[k][j].0);
                n += bin[k][j].1;
                let (area, m) = right[j + 1];
                let cost =
                    box_.area() * n.div_ceil(LEAF as u32) as f32 + area * m.div_ceil(LEAF as u32) as f32;
                if n > 0 && m > 0 && cost < best.0 {
                    best = (cost, Some((k, j, origin[k], factor[k])));
                }
            }
        }
        best.1
    }

    /// Splits in two non-empty ranges.
    fn split(self) -> (Range<'a>, Range<'a>) {
        let middle = match self.best_plane() {
            Some((k, j, o, f)) => partition(self.items, |i| bin_of(i.centre2()[k], o, f) <= j),
            None => self.items.len() / 2, // all centres coincide: any half will do
        };
        let (a, b) = self.items.split_at_mut(middle);
        (Range::new(a, self.start), Range::new(b, self.start + middle))
    }
}

#[inline(always)]
fn bin_of(centre2: f32, origin: f32, factor: f32) -> usize {
    // The cast saturates, and makes 0 of the NaN that denormal extents can give.
    (((centre2 - origin) * factor) as i32 as usize).min(BINS - 1)
}

/// Moves the items with `left` to the front; returns their number. Every item is swapped, whatever its side: a branch
/// here would be mispredicted every other time, which costs more than the copies.
fn partition(items: &mut [Item], left: impl Fn(&Item) -> bool) -> usize {
    let mut middle = 0;
    for i in 0..items.len() {
        let x = items[i];
        items.swap(i, middle);
        middle += left(&x) as usize;
    }
    middle
}

/// Nodes (children before or after, indices local to this list) and leaf ranges `(first slot, count)`.
#[derive(Default)]
struct Subtree {
    nodes: Vec<Node>,
    leaves: Vec<(u32, u32)>,
}

impl Subtree {
    /// Appends the tree of `range`; returns its child reference.
    fn grow(&mut self, range: Range) -> i32 {
        if range.items.len() <= LEAF {
            self.leaves.push((range.start as u32, range.items.len() as u32));
            return !(self.leaves.len() as i32 - 1);
        }
        let mut parts = Vec::with_capacity(8);
        let (a, b) = range.split();
        parts.extend([a, b]);
        while parts.len() < 8 {
            let widest = (0..parts.len())
                .filter(|&i| parts[i].items.len() > LEAF)
                .max_by(|&i, &j| parts[i].bounds.area().total_cmp(&parts[j].bounds.area()));
            let Some(i) = widest else { break };
            let (a, b) = parts.swap_remove(i).split();
            parts.extend([a, b]);
        }
        parts.sort_by_key(|p| p.start);
        let me = self.nodes.len();
        let mut node = Node { bounds: [[f32::INFINITY; 8]; 6], child: [0; 8] };
        for k in 0..3 {
            node.bounds[k + 3] = [f32::NEG_INFINITY; 8];
            for (j, p) in parts.iter().enumerate() {
                node.bounds[k][j] = p.bounds.lo[k] - PAD;
                node.bounds[k + 3][j] = p.bounds.hi[k] + PAD;
            }
        }
        self.nodes.push(node);
        let large = parts.iter().any(|p| p.items.len() > TASK);
        if large {
            let grown: Vec<(Subtree, i32)> = parts
                .into_par_iter()
                .map(|p| {
                    let mut t = Subtree::default();
                    let root = t.grow(p);
                    (t, root)
                })
                .collect();
            for (j, (t, root)) in grown.into_iter().enumerate() {
                self.nodes[me].child[j] = self.join(t, root);
            }
        } else {
            for (j, p) in parts.into_iter().enumerate() {
                let c = self.grow(p);
                self.nodes[me].child[j] = c;
            }
        }
        me as i32
    }

    /// Appends another list, shifting its references.
    fn join(&mut self, t: Subtree, root: i32) -> i32 {
        let (n, l) = (self.nodes.len() as i32, self.leaves.len() as i32);
        let shift = |c: i32| if c < 0 { c - l } else { c + n };
        self.leaves.extend(t.leaves);
        self.nodes.extend(t.nodes.into_iter().map(|mut x| {
            x.child = x.child.map(shift);
            x
        }));
        shift(root)
    }
}

/// Builds the tree of a mesh that [`check_mesh`](super::limits::check_mesh) has passed.
pub fn build(mesh: &Mesh) -> Tree {
    let limits = limits(mesh);
    let centre: [f64; 3] = std::array::from_fn(|k| 0.5 * limits.min[k] + 0.5 * limits.max[k]);
    let extent = limits.sides().into_iter().fold(0.0, f64::max);
    let scale = if extent > 1e-300 { (-extent.log2().ceil()).clamp(-1000.0, 1000.0).exp2() } else { 1.0 };
    let item = |(i, f): (usize, &[u32; 3])| {
        let mut b = Bounds::EMPTY;
        for v in f.map(|v| mesh.positions[v as usize]) {
            for k in 0..3 {
                let x = ((v[k] - centre[k]) * scale) as f32;
                b.lo[k] = least(b.lo[k], x);
                b.hi[k] = most(b.hi[k], x);
            }
        }
        b.lo[3] = f32::from_bits(ID + i as u32);
        b
    };
    let mut items: Vec<Item> = mesh.faces.par_iter().enumerate().map(item).collect();
    let mut t = Subtree::default();
    let root = t.grow(Range::new(&mut items, 0));
    let face: Vec<u32> = items.par_iter().map(|i| i.lo[3].to_bits() - ID).collect();
    drop(items);
    let leaf =
        |&(first, n): &(u32, u32)| frame::leaf(mesh, &face[first as usize..][..n as usize], first, scale);
    let leaves = t.leaves.par_iter().map(leaf).collect();
    let (slots, corners) = frame::renumber(mesh, &face);
    Tree { nodes: t.nodes, leaves, root, centre, scale, slots, corners, face }
}

/// Box of all vertices that faces use.
fn limits(mesh: &Mesh) -> Aabb {
    let of = |part: &[[u32; 3]]| Aabb::of(part.iter().flatten().map(|&v| &mesh.positions[v as usize]));
    mesh.faces.par_chunks(1 << 14).map(of).reduce(|| Aabb::EMPTY, |a, b| a.union(&b))
}

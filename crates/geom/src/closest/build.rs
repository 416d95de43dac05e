//! Building the tree: parallel binned surface-area heuristic, straight into nodes of eight.
//!
//! A range of triangles is split in two where the *surface-area heuristic* is least (MacDonald & Booth 1990), evaluated at 16
//! bins per axis (Wald 2007). The cost of a side is its box area times the number of full leaves it needs, which favors splits
//! at multiples of eight. A large range is judged by a sample. A small one is judged along the axes of its largest extent
//! alone. A few triangles are sorted and every cut is tried, which costs less than bins. To make a node of eight children, the
//! child with the largest box is split again until there are eight (Wald, Benthin & Boulos 2008). No binary tree is ever
//! stored. Large children are built in parallel and their node lists are joined in a fixed order. So the tree does not depend
//! on the number of threads.

use crate::closest::frame;
use crate::closest::layout::Node;
use crate::closest::limits::{self, MeshError};
use crate::closest::tree::{Arrays, Tree};
use crate::memory::large_pages;
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress, Silent};
use crate::space::Aabb;

/// Most triangles of a leaf.
const MAX_TRIANGLES_PER_LEAF: usize = 8;
/// Bins in which the places to split a range are counted.
const SPLIT_BINS: usize = 16;
/// Ranges with more items are boxed by several threads. They take blocks of this many items, merged in any order: least and
/// most do not depend on it.
const BOXED_ITEMS_PER_TASK: usize = 1 << 16;
/// Ranges with more items are built by a task of their own.
const MAX_ITEMS_BUILT_ALONE: usize = 1 << 15;
/// Before larger ranges are divided it is asked whether to go on.
const MAX_ITEMS_UNASKED: usize = 1 << 12;
/// Boxes are widened by this (scaled units), more than the rounding of a corner to single precision.
const BOX_PADDING: f32 = 1.2e-7;

/// Added to a face id that travels as a float, so that it is never a denormal or NaN (both can be slow).
const FACE_ID_OFFSET: u32 = 0x3f80_0000;

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
    /// Twice the center, in the first three places.
    #[inline(always)]
    fn center2(&self) -> [f32; 4] {
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

/// Items looked at, about, to choose a plane: of larger ranges every n-th.
const PLANE_SAMPLE_ITEMS: usize = 1024;

/// Ranges up to this size are sorted along the axis of their largest extent, and every place to split is tried.
const MAX_SORTED_ITEMS: usize = 16;
/// Ranges up to this size are split on one of the two axes of largest extent.
const MAX_TWO_AXES_ITEMS: usize = 256;

/// A plane between two bins of an axis.
#[derive(Clone, Copy)]
struct Plane {
    axis: usize,
    /// Items in bins up to this one lie to its left.
    bin: usize,
    /// Where the centers begin and how far they reach; twice the coordinate, like all centers here.
    origin: f32,
    extent: f32,
}

impl Plane {
    /// Bins per length.
    fn factor(&self) -> f32 {
        SPLIT_BINS as f32 * 0.99999 / self.extent
    }
    /// The bin of an item on this axis.
    #[inline(always)]
    fn bin_of(&self, item: &Item, factor: f32) -> usize {
        // The cast saturates, and makes 0 of the NaN that denormal extents can give.
        (((item.lo[self.axis] + item.hi[self.axis] - self.origin) * factor) as i32 as usize)
            .min(SPLIT_BINS - 1)
    }
}

/// A range of items, with the boxes of the items and of their doubled centers.
struct Range<'a> {
    items: &'a mut [Item],
    /// Index of the first item in the whole.
    start: usize,
    bounds: Bounds,
    centers: Bounds,
}

impl<'a> Range<'a> {
    fn new(items: &'a mut [Item], start: usize) -> Self {
        let of = |part: &[Item]| {
            let mut r = (Bounds::EMPTY, Bounds::EMPTY);
            for i in part {
                r.0.add(i);
                let c = i.center2();
                r.1.add(&Bounds { lo: c, hi: c });
            }
            r
        };
        let merge = |mut a: (Bounds, Bounds), b: (Bounds, Bounds)| {
            a.0.add(&b.0);
            a.1.add(&b.1);
            a
        };
        let (bounds, centers) = if items.len() <= BOXED_ITEMS_PER_TASK {
            of(items)
        } else {
            items.par_chunks(BOXED_ITEMS_PER_TASK).map(of).reduce(|| (Bounds::EMPTY, Bounds::EMPTY), merge)
        };
        Range { items, start, bounds, centers }
    }

    /// The best plane that the items, or of many items a sample, can tell; `None` if all centers coincide.
    fn best_plane(&self) -> Option<Plane> {
        let step = self.items.len().div_ceil(PLANE_SAMPLE_ITEMS);
        self.best_plane_of_every(step).or_else(|| if step > 1 { self.best_plane_of_every(1) } else { None })
    }

    /// The best of 15 planes on each axis, judged by every `step`-th item. Few items are parts of a smooth surface more
    /// often than not: the axes along which they extend the most will do.
    fn best_plane_of_every(&self, step: usize) -> Option<Plane> {
        let mut axes: [Plane; 3] = std::array::from_fn(|axis| {
            let extent = self.centers.hi[axis] - self.centers.lo[axis];
            Plane { axis, bin: 0, origin: self.centers.lo[axis], extent }
        });
        axes.sort_by(|a, b| b.extent.total_cmp(&a.extent));
        let tried = if self.items.len() <= MAX_TWO_AXES_ITEMS { 2 } else { 3 };
        let mut best = (f32::INFINITY, None);
        for plane in axes[..tried].iter().filter(|plane| plane.extent > 0.0) {
            let (cost, bin) = self.cheapest(plane, step);
            if cost < best.0 {
                best = (cost, Some(Plane { bin, ..*plane }));
            }
        }
        best.1
    }

    /// The cost of the best plane along the axis of `plane`, and its bin; infinite if one side would be empty.
    fn cheapest(&self, plane: &Plane, step: usize) -> (f32, usize) {
        let (mut boxes, mut counts) = ([Bounds::EMPTY; SPLIT_BINS], [0; SPLIT_BINS]);
        let factor = plane.factor();
        for i in self.items.iter().step_by(step) {
            let bin = plane.bin_of(i, factor);
            boxes[bin].add(i);
            counts[bin] += 1;
        }
        let mut right = [f32::INFINITY; SPLIT_BINS];
        let (mut bounds, mut n) = (Bounds::EMPTY, 0);
        for j in (1..SPLIT_BINS).rev() {
            bounds.add(&boxes[j]);
            n += counts[j];
            right[j] = if n > 0 { bounds.area() * leaves(n) } else { f32::INFINITY };
        }
        let mut best = (f32::INFINITY, 0);
        (bounds, n) = (Bounds::EMPTY, 0);
        for j in 0..SPLIT_BINS - 1 {
            bounds.add(&boxes[j]);
            n += counts[j];
            let cost = bounds.area() * leaves(n) + right[j + 1];
            if n > 0 && cost < best.0 {
                best = (cost, j);
            }
        }
        best
    }

    /// Sorts a few items along the axis of their largest extent; returns how many to take to the left.
    fn sort_and_cut(&mut self) -> usize {
        let extent = |k: usize| self.centers.hi[k] - self.centers.lo[k];
        let k = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
        let items = &mut self.items[..];
        items.sort_unstable_by(|a, b| (a.lo[k] + a.hi[k]).total_cmp(&(b.lo[k] + b.hi[k])));
        let n = items.len();
        let mut right = [0.0; MAX_SORTED_ITEMS + 1];
        let mut bounds = Bounds::EMPTY;
        for i in (1..n).rev() {
            bounds.add(&items[i]);
            right[i] = bounds.area() * leaves(n - i);
        }
        let mut best = (f32::INFINITY, n / 2);
        bounds = Bounds::EMPTY;
        for i in 1..n {
            bounds.add(&items[i - 1]);
            let cost = bounds.area() * leaves(i) + right[i];
            if cost < best.0 {
                best = (cost, i);
            }
        }
        best.1
    }

    /// Splits in two non-empty ranges.
    fn split(mut self) -> (Range<'a>, Range<'a>) {
        let middle = if self.items.len() <= MAX_SORTED_ITEMS {
            self.sort_and_cut()
        } else if let Some(plane) = self.best_plane() {
            let factor = plane.factor();
            partition(self.items, |i| plane.bin_of(i, factor) <= plane.bin)
        } else {
            self.items.len() / 2 // all centers coincide: any half will do
        };
        let (a, b) = self.items.split_at_mut(middle);
        (Range::new(a, self.start), Range::new(b, self.start + middle))
    }
}

/// Leaves that `n` items need.
fn leaves(n: usize) -> f32 {
    n.div_ceil(MAX_TRIANGLES_PER_LEAF) as f32
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

/// Nodes (parents before their children, indices local to this list) and leaf ranges `(first slot, count)`.
#[derive(Default)]
struct Subtree {
    nodes: Vec<Node>,
    leaves: Vec<(u32, u32)>,
}

impl Subtree {
    /// Appends the tree of `range`; returns its child reference. Worth nothing where `progress` says that it is cancelled.
    fn grow(&mut self, range: Range, progress: &dyn Progress) -> i32 {
        if range.items.len() <= MAX_TRIANGLES_PER_LEAF
            || range.items.len() > MAX_ITEMS_UNASKED && progress.cancelled()
        {
            self.leaves.push((range.start as u32, range.items.len() as u32));
            return !(self.leaves.len() as i32 - 1);
        }
        let mut parts = Vec::with_capacity(8);
        let (a, b) = range.split();
        parts.extend([a, b]);
        while parts.len() < 8 {
            let widest = (0..parts.len())
                .filter(|&i| parts[i].items.len() > MAX_TRIANGLES_PER_LEAF)
                .max_by(|&i, &j| parts[i].bounds.area().total_cmp(&parts[j].bounds.area()));
            let Some(i) = widest else { break };
            let (a, b) = parts.swap_remove(i).split();
            parts.extend([a, b]);
        }
        parts.sort_by_key(|p| p.start);
        let me = self.nodes.len();
        let mut node = Node::EMPTY;
        for k in 0..3 {
            for (j, p) in parts.iter().enumerate() {
                node.bounds[k][j] = p.bounds.lo[k] - BOX_PADDING;
                node.bounds[k + 3][j] = p.bounds.hi[k] + BOX_PADDING;
            }
        }
        self.nodes.push(node);
        let large = parts.iter().any(|p| p.items.len() > MAX_ITEMS_BUILT_ALONE);
        if large {
            let grown: Vec<(Subtree, i32)> = parts
                .into_par_iter()
                .map(|p| {
                    // Room for more than it will have: memory that is not touched costs nothing, moving the list does.
                    let mut t = Subtree {
                        nodes: Vec::with_capacity(p.items.len() / 16),
                        leaves: Vec::with_capacity(p.items.len() / 4),
                    };
                    let root = t.grow(p, progress);
                    (t, root)
                })
                .collect();
            for (j, (t, root)) in grown.into_iter().enumerate() {
                self.nodes[me].child[j] = self.join(t, root);
            }
        } else {
            for (j, p) in parts.into_iter().enumerate() {
                let c = self.grow(p, progress);
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

impl Tree {
    /// Prepares `mesh`, whose faces may be degenerate, doubled or crossing; vertices that no face uses do not count.
    ///
    /// Runs on the current rayon pool; the tree does not depend on its size. Cost: `n log n`, about 0.3 s and 200 MB for
    /// a million faces on two cores.
    ///
    /// # Errors
    /// [`MeshError`], if there are no faces or too many, or one names a vertex that does not exist. Also if a vertex is not
    /// finite or beyond [`MAX_VERTEX`](crate::closest::MAX_VERTEX). Also if the faces extend over less than
    /// [`MIN_EXTENT`](crate::closest::MIN_EXTENT), for which the powers in distances would lose their digits.
    pub fn build(mesh: &Mesh) -> Result<Tree, MeshError> {
        Tree::build_watched(mesh, &Silent)
    }

    /// As [`Tree::build`], asking `progress` whether to go on.
    ///
    /// # Errors
    /// The errors of [`Tree::build`], and [`MeshError::Cancelled`].
    pub fn build_watched(mesh: &Mesh, progress: &dyn Progress) -> Result<Tree, MeshError> {
        limits::check_mesh(mesh)?;
        Ok(build(mesh, progress)?)
    }
}

/// Builds the tree of a mesh that [`check_mesh`](super::limits::check_mesh) has passed.
fn build(mesh: &Mesh, progress: &dyn Progress) -> Result<Tree, Cancelled> {
    let limits = limits(mesh);
    let center: [f64; 3] = std::array::from_fn(|k| 0.5 * limits.min[k] + 0.5 * limits.max[k]);
    let extent = limits.sides().into_iter().fold(0.0, f64::max);
    let scale =
        if extent > 1e-300 { libm::exp2((-libm::log2(extent).ceil()).clamp(-1000.0, 1000.0)) } else { 1.0 };
    let item = |(i, f): (usize, &[u32; 3])| {
        let mut b = Bounds::EMPTY;
        for v in mesh.places(f) {
            for k in 0..3 {
                let x = ((v[k] - center[k]) * scale) as f32;
                b.lo[k] = least(b.lo[k], x);
                b.hi[k] = most(b.hi[k], x);
            }
        }
        b.lo[3] = f32::from_bits(FACE_ID_OFFSET + i as u32);
        b
    };
    let mut items: Vec<Item> = large_pages(Vec::with_capacity(mesh.faces.len()));
    mesh.faces.par_iter().enumerate().map(item).collect_into_vec(&mut items);
    let mut t = Subtree::default();
    let root = t.grow(Range::new(&mut items, 0), progress);
    if progress.cancelled() {
        return Err(Cancelled);
    }
    let face: Vec<u32> = items.par_iter().map(|i| i.lo[3].to_bits() - FACE_ID_OFFSET).collect();
    drop(items);
    let leaf = |&(first, n): &(u32, u32)| {
        // Where the work is stopped, leaves stay empty.
        let n = if progress.cancelled() { 0 } else { n };
        frame::leaf(mesh, &face[first as usize..][..n as usize], first, scale)
    };
    let mut leaves = large_pages(Vec::with_capacity(t.leaves.len()));
    let fill = || t.leaves.par_iter().map(leaf).collect_into_vec(&mut leaves);
    // The numbers follow each other: one thread gives them while the others fill leaves.
    let ((slots, corners), ()) = rayon::join(|| frame::renumber(mesh, &face, progress), fill);
    if progress.cancelled() {
        return Err(Cancelled);
    }
    Ok(Tree::new(Arrays { nodes: t.nodes, leaves, root, center, scale, slots, corners, face }))
}

/// Box of all vertices that faces use.
fn limits(mesh: &Mesh) -> Aabb {
    let of = |part: &[[u32; 3]]| Aabb::of(part.iter().flatten().map(|&v| &mesh.positions[v as usize]));
    mesh.faces.par_chunks(1 << 14).map(of).reduce(|| Aabb::EMPTY, |a, b| a.union(&b))
}

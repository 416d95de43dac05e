//! All pairs of facets that cross, touch or overlap where they should not.
//!
//! *Tree*: each node inherits the list of nodes of its own level whose boxes overlap its parent's, and passes on those
//! that overlap its children; eight boxes in one comparison. No walk ever starts at the root. At the bottom the
//! children are triangles. *Filter*: most of the pairs left are settled in single precision, neighbours and strangers
//! alike (see `filter`). *Exact*: the rest is decided by `meet`. *Hubs*: vertices with very many facets, whose boxes all
//! overlap, are searched in a way of their own (see `hub`), and the walk passes over the pairs found there.
#![allow(unsafe_code, reason = "vector instructions that the processor is known to have")]

mod filter;
mod hub;
mod masks;
mod meet;
#[cfg(test)]
mod tests;
mod tree;

use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::simd::Level;
use crate::simd::lanes::Plain;
#[cfg(target_arch = "x86_64")]
use crate::simd::lanes_x86::A8;
use crate::topology::Topology;
use hub::Hub;
use masks::Masks;
use rayon::prelude::*;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;
use tree::{Boxes, Leaf, Tree, W};

const EVERYWHERE: [f32; 6] = {
    let i = f32::INFINITY;
    [-i, -i, -i, i, i, i]
};

/// Pairs of facets of a welded mesh that meet anywhere else than in the vertices or the edge they share: the lower
/// facet first, sorted.
///
/// Decided exactly for coordinates between 1e-80 and 1e60 in magnitude. Facets without area and facets with the
/// same three vertices (duplicates) are not looked at. Time grows with the number of pairs of overlapping boxes, about six
/// a facet on a scan; n facets around one vertex take n log n, two such fans that lie upon each other the product of
/// their facets. Facets done are told to `progress`. The result is the same for any number of threads.
///
/// # Errors
/// [`Cancelled`].
pub fn self_intersections(
    mesh: &Mesh,
    topology: &Topology,
    progress: &dyn Progress,
) -> Result<Vec<[u32; 2]>, Cancelled> {
    first_self_intersections(mesh, topology, usize::MAX, progress).map(|all| all.first)
}

/// How many pairs of facets meet where they should not, and the first of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Crossings {
    /// Their number.
    pub count: usize,
    /// The least of them, as many as were asked for, sorted.
    pub first: Vec<[u32; 2]>,
}

/// As [`self_intersections`], keeping `limit` pairs only: memory stays bounded where a mesh is one tangle, in which
/// the number of pairs grows with the square of that of the facets.
///
/// # Errors
/// [`Cancelled`].
pub fn first_self_intersections(
    mesh: &Mesh,
    topology: &Topology,
    limit: usize,
    progress: &dyn Progress,
) -> Result<Crossings, Cancelled> {
    with(&Search { mesh, topology, some: None, limit, most: usize::MAX }, progress, Level::detect())
}

/// As [`self_intersections`], but only pairs of which at least one facet is among `some` (a flag for each facet): what
/// has changed against everything, say. `None` if there are more than `most`: the search ends where that is known.
///
/// # Errors
/// [`Cancelled`].
pub fn few_self_intersections(
    mesh: &Mesh,
    topology: &Topology,
    some: &[bool],
    most: usize,
    progress: &dyn Progress,
) -> Result<Option<Vec<[u32; 2]>>, Cancelled> {
    let search = Search { mesh, topology, some: Some(some), limit: usize::MAX, most };
    let found = with(&search, progress, Level::detect())?;
    Ok((found.count <= most).then_some(found.first))
}

/// What is searched.
struct Search<'a> {
    mesh: &'a Mesh,
    topology: &'a Topology,
    /// Flags of the facets of which each pair has one; `None`: all.
    some: Option<&'a [bool]>,
    /// How many of the pairs are listed.
    limit: usize,
    /// Beyond so many pairs there is no need to find more.
    most: usize,
}

fn with(search: &Search, progress: &dyn Progress, level: Level) -> Result<Crossings, Cancelled> {
    let &Search { mesh, topology, some, limit, most } = search;
    let hubs = hub::hubs(mesh, topology);
    let tree = Tree::build(mesh, topology, &hubs.iter().map(Hub::facets).collect::<Vec<_>>(), some);
    let walk = Walk { mesh, tree: &tree, progress, most, found: AtomicUsize::new(0) };
    let top = tree.levels.len() - 1;
    let mut pairs = Pairs { limit, count: 0, first: vec![] };
    let asked =
        |[a, b]: [u32; 2]| some.is_none_or(|some| some[a as usize] || some[b as usize]) && !walk.has_enough();
    let mut found = |pair| {
        walk.found.fetch_add(1, Relaxed);
        pairs.push(pair);
    };
    hubs.iter().for_each(|hub| hub.pairs(mesh, progress, &asked, &mut found));
    if !tree.leaves.is_empty() {
        let mut all = vec![0];
        tree.without_own_group(top, 0, &mut all);
        match level {
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 | Level::Avx512 => avx2(&walk, top, 0, &all, &mut pairs),
            _ => plain(&walk, top, 0, &all, &mut pairs),
        }
    }
    if progress.cancelled() {
        return Err(Cancelled);
    }
    pairs.cut(0);
    pairs.first.par_sort_unstable();
    Ok(Crossings { count: pairs.count, first: pairs.first })
}

/// Nodes up to this level are not worth the work of several threads.
const ALONE: usize = 2;

struct Walk<'a> {
    mesh: &'a Mesh,
    tree: &'a Tree,
    progress: &'a dyn Progress,
    most: usize,
    /// Pairs found so far, wherever.
    found: AtomicUsize,
}

/// Pairs found so far, of which the `limit` least are of interest.
struct Pairs {
    limit: usize,
    count: usize,
    /// Those, and perhaps others that are not yet sorted out.
    first: Vec<[u32; 2]>,
}

impl Pairs {
    fn push(&mut self, pair: [u32; 2]) {
        self.count += 1;
        self.first.push(pair);
        self.cut(self.limit);
    }

    /// Takes in what another part of the tree gave.
    fn append(&mut self, part: Pairs) {
        self.count += part.count;
        self.first.extend(part.first);
        self.cut(self.limit);
    }

    /// Drops what is not of interest, once there are more than `slack` (and a few) beyond those asked for.
    fn cut(&mut self, slack: usize) {
        /// Never sorted out sooner: most meshes have few pairs.
        const FEW: usize = 1 << 10;
        let few = if slack == 0 { 0 } else { FEW };
        if self.first.len() > self.limit.saturating_add(slack).saturating_add(few) {
            if self.limit > 0 {
                self.first.select_nth_unstable(self.limit - 1);
            }
            self.first.truncate(self.limit);
        }
    }
}

type Deeper = fn(&Walk, usize, usize, &[u32], &mut Pairs);

fn plain(walk: &Walk, level: usize, i: usize, list: &[u32], out: &mut Pairs) {
    // SAFETY: plain Rust.
    unsafe { walk.descend::<Plain<W>>(level, i, list, out, plain) }
}

#[cfg(target_arch = "x86_64")]
fn avx2(walk: &Walk, level: usize, i: usize, list: &[u32], out: &mut Pairs) {
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,popcnt")]
    fn run(walk: &Walk, level: usize, i: usize, list: &[u32], out: &mut Pairs) {
        // SAFETY: the instructions are those of this function.
        unsafe { walk.descend::<A8>(level, i, list, out, avx2) }
    }
    // SAFETY: reached from `with` only, for a level that the processor has.
    unsafe { run(walk, level, i, list, out) }
}

#[inline(always)]
fn lane(b: &Boxes, i: usize) -> [f32; 6] {
    std::array::from_fn(|k| b.0[k][i])
}

impl Walk<'_> {
    fn has_enough(&self) -> bool {
        self.found.load(Relaxed) > self.most
    }

    /// Everything below node `i` of `level` against itself and the later nodes of `list`, which holds `i` too.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn descend<L: Masks>(
        &self,
        level: usize,
        i: usize,
        list: &[u32],
        out: &mut Pairs,
        deeper: Deeper,
    ) {
        if level == 0 {
            // SAFETY: handed on.
            return unsafe { self.leaf_pairs::<L>(i, list, out) };
        }
        let children = 0..W.min(self.tree.levels[level - 1].len() - i * W);
        if level <= ALONE {
            if self.progress.cancelled() {
                return;
            }
            let mut next = vec![];
            for a in children.clone() {
                next.clear();
                // SAFETY: handed on.
                unsafe { self.inherit::<L>(level, i, a, list, &mut next) };
                deeper(self, level - 1, i * W + a, &next, out);
            }
            if level == 1 {
                self.progress.advance((children.len() * W) as u64);
            }
            return;
        }
        let mut lists = vec![];
        for a in children {
            let mut next = vec![];
            // SAFETY: handed on.
            unsafe { self.inherit::<L>(level, i, a, list, &mut next) };
            lists.push((i * W + a, next));
        }
        let limit = out.limit;
        let parts = lists.into_par_iter().map(|(child, next)| {
            let mut part = Pairs { limit, count: 0, first: vec![] };
            deeper(self, level - 1, child, &next, &mut part);
            part
        });
        parts.collect::<Vec<_>>().into_iter().for_each(|part| out.append(part));
    }

    /// The list of child `a` of node `i`, made from the node's.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn inherit<L: Masks>(&self, level: usize, i: usize, a: usize, list: &[u32], next: &mut Vec<u32>) {
        let b = lane(&self.tree.levels[level][i], a);
        let any = self.tree.is_asked(level, i, a);
        for &j in list {
            // SAFETY: handed on.
            let mut m = unsafe { filter::overlap::<L>(&self.tree.levels[level][j as usize], &b) };
            if !any {
                m &= self.tree.asked[level][j as usize];
            }
            if i == j as usize {
                m &= u32::MAX << a;
            }
            while m != 0 {
                next.push(j * W as u32 + m.trailing_zeros());
                m &= m - 1;
            }
        }
        self.tree.without_own_group(level - 1, i * W + a, next);
    }

    /// Pairs between leaf `i` and the leaves of `list`.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn leaf_pairs<L: Masks>(&self, i: usize, list: &[u32], out: &mut Pairs) {
        if self.has_enough() {
            return;
        }
        let before = out.count;
        let t = self.tree;
        let (l, own) = (&t.leaves[i], &t.levels[0][i]);
        let planes = filter::planes(self.mesh, &t.frame, l);
        for j in list.iter().map(|&j| j as usize) {
            let (q, boxes) = (&t.leaves[j], &t.levels[0][j]);
            // Box of the other leaf; unknown where there is one leaf only, and then all is decided exactly.
            let other = t.levels.get(1).map_or(EVERYWHERE, |up| lane(&up[j / W], j % W));
            // SAFETY: handed on.
            let mut rows = unsafe { filter::overlap::<L>(own, &other) };
            while rows != 0 {
                let a = rows.trailing_zeros() as usize;
                rows &= rows - 1;
                let b = lane(own, a);
                // SAFETY: handed on.
                let mut among = unsafe { filter::overlap::<L>(boxes, &b) };
                if i == j {
                    among &= u32::MAX << a << 1;
                }
                if !t.is_asked(0, i, a) {
                    among &= t.asked[0][j];
                }
                if among == 0 || b[0] > b[3] {
                    continue; // an empty box has no area, or fills up
                }
                let mut reach = 0.0;
                for k in 0..3 {
                    reach += if other[k + 3] > b[k + 3] { other[k + 3] } else { b[k + 3] }
                        - if other[k] < b[k] { other[k] } else { b[k] };
                }
                // SAFETY: handed on.
                let left = unsafe { filter::left_over::<L>((l, a, &planes), q, reach, t.frame.slack, among) };
                self.decide((l, a), q, left, out);
            }
        }
        if out.count > before {
            self.found.fetch_add(out.count - before, Relaxed);
        }
    }

    /// Decides exactly about the pairs of triangle `a` of leaf `l` and those of leaf `q` that are `left`.
    #[inline(always)]
    fn decide(&self, (l, a): (&Leaf, usize), q: &Leaf, mut left: u32, out: &mut Pairs) {
        let triangle = |leaf: &Leaf, i: usize| {
            let face = self.mesh.faces[leaf.face[i] as usize];
            (face.map(|v| self.mesh.positions[v as usize]), face)
        };
        while left != 0 {
            let c = left.trailing_zeros() as usize;
            left &= left - 1;
            if meet::meet(&triangle(l, a), &triangle(q, c)) {
                let (x, y) = (l.face[a], q.face[c]);
                out.push([x.min(y), x.max(y)]);
            }
        }
    }
}

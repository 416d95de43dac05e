//! All pairs of facets that cross, touch or overlap where they should not.
//!
//! The search has four parts:
//! 1. *Tree.* A node gets from its parent the list of nodes of its own level whose boxes overlap the parent's box. It keeps
//!    those that overlap its own; eight boxes in one comparison. So no search begins at the root. The children of the lowest
//!    nodes are triangles.
//! 2. *Filter.* Most of the pairs left are excluded in single precision, whether the triangles share corners or not (`filter`).
//! 3. *Exact.* The rest is decided by `meet`.
//! 4. *Hubs.* The boxes of all facets at a vertex overlap there. Facets at a vertex with very many are therefore not in the
//!    tree. They are searched separately, among each other and against the facets of the tree (`hub`).
//! 5. *Crowds.* Where far too many boxes overlap, the search ends and begins again with further hubs (`crowd`). These are
//!    facets that end near one place, but not at one vertex.
//!
//! Only the first of several facets with the same three corners is searched (`pairs`).
#![allow(unsafe_code, reason = "vector instructions that the processor is known to have")]

mod book;
mod crowd;
mod filter;
mod hub;
mod masks;
mod meet;
mod pairs;
pub mod reaching;
pub mod seen;
#[cfg(test)]
mod tests;
mod tree;
pub mod views;
mod walls;

use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::simd::Level;
use crate::simd::lanes::Plain;
#[cfg(target_arch = "x86_64")]
use crate::simd::lanes_x86::A8;
use crate::topology::Topology;
use hub::Hub;
use masks::Masks;
use pairs::{Copies, Pairs, Wanted};
pub use reaching::{reaching, reaching_any};
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;
use tree::{Boxes, Leaf, TREE_WIDTH, Tree};

const EVERYWHERE: [f32; 6] = {
    let i = f32::INFINITY;
    [-i, -i, -i, i, i, i]
};

/// Pairs of facets of a welded mesh that meet anywhere else than in the vertices or the edge they share: the lower
/// facet first, sorted.
///
/// Decided exactly for coordinates between 1e-80 and 1e60 in magnitude. Facets without area and facets with the same three
/// vertices (duplicates) are not looked at. Time grows with the number of pairs of overlapping boxes, about six a facet on a
/// scan. Take n facets around one vertex or edge, or upon each other: they cost n log n and the time for the pairs they find.
/// Facets done are told to `progress`. The result is the same for any number of threads.
///
/// # Errors
/// [`Cancelled`].
pub fn self_intersections(
    mesh: &Mesh,
    topology: &Topology,
    progress: &dyn Progress,
) -> Result<Vec<[u32; 2]>, Cancelled> {
    let search = Search { mesh, topology, selected: None, limit: usize::MAX, most: usize::MAX, alone: false };
    with(&search, progress, Level::detect()).map(|all| all.first)
}

/// How many pairs of facets meet where they should not, and some of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Crossings {
    /// Their number.
    pub count: usize,
    /// There are more than `count`: the search was given up.
    pub at_least: bool,
    /// As many as were asked for, sorted: the least of them, or if the search was given up, those found first.
    pub first: Vec<[u32; 2]>,
}

impl Crossings {
    /// The result of [`first_self_intersections`] where these, sorted, are all pairs; `None` where it would have given up.
    pub fn of_all(pairs: &[[u32; 2]], limit: usize) -> Option<Crossings> {
        let first = pairs[..limit.min(pairs.len())].to_vec();
        let known = pairs.len() <= MAX_PAIRS_TO_FIRST.max(limit);
        known.then_some(Crossings { count: pairs.len(), at_least: false, first })
    }
}

/// Pairs beyond which the search for the first is given up: a tangle of 20,000 facets may have a hundred million.
const MAX_PAIRS_TO_FIRST: usize = 1_000_000;

/// As [`self_intersections`], but keeps `limit` pairs only, and counts up to a million. In a tangle the number of pairs grows
/// with the square of that of the facets. Memory and time stay bounded, and the result says so.
///
/// # Errors
/// [`Cancelled`].
pub fn first_self_intersections(
    mesh: &Mesh,
    topology: &Topology,
    limit: usize,
    progress: &dyn Progress,
) -> Result<Crossings, Cancelled> {
    let search =
        Search { mesh, topology, selected: None, limit, most: MAX_PAIRS_TO_FIRST.max(limit), alone: false };
    let found = with(&search, progress, Level::detect())?;
    if found.count <= search.most {
        return Ok(found);
    }
    // Which pairs were found before the end depends on the threads. So it is searched once more, on one thread and in a fixed order, for
    // as many pairs as are listed.
    let first_only = Search { most: limit.saturating_sub(1), alone: true, ..search };
    let first = with(&first_only, progress, Level::detect())?.first;
    Ok(Crossings { count: search.most, at_least: true, first })
}

/// As [`self_intersections`], but only pairs of which at least one facet is among `selected` (a flag for each facet): what
/// has changed against everything, say. `None` if there are more than `most`: the search ends where that is known.
///
/// # Errors
/// [`Cancelled`].
pub fn selected_self_intersections(
    mesh: &Mesh,
    topology: &Topology,
    selected: &[bool],
    most: usize,
    progress: &dyn Progress,
) -> Result<Option<Vec<[u32; 2]>>, Cancelled> {
    let search = Search { mesh, topology, selected: Some(selected), limit: usize::MAX, most, alone: false };
    let found = with(&search, progress, Level::detect())?;
    Ok((found.count <= most).then_some(found.first))
}

/// Whether any two facets meet where they should not: ends with the first pair found.
///
/// # Errors
/// [`Cancelled`].
pub fn any_self_intersection(
    mesh: &Mesh,
    topology: &Topology,
    progress: &dyn Progress,
) -> Result<bool, Cancelled> {
    let search = Search { mesh, topology, selected: None, limit: 0, most: 0, alone: false };
    Ok(with(&search, progress, Level::detect())?.count > 0)
}

/// The request of a search.
struct Search<'a> {
    mesh: &'a Mesh,
    topology: &'a Topology,
    /// Flags of the facets of which each pair has one; `None`: all.
    selected: Option<&'a [bool]>,
    /// How many of the pairs are listed.
    limit: usize,
    /// Beyond so many pairs there is no need to find more.
    most: usize,
    /// On one thread, in a fixed order: where the search ends early, it has found the same pairs every time.
    alone: bool,
}

/// Pairs of boxes that overlap, for each facet, beyond which crowds are looked for. A scan has six, a mesh of needles some
/// tens.
const MAX_OVERLAPS_PER_FACET: usize = 64;

fn with(search: &Search, progress: &dyn Progress, level: Level) -> Result<Crossings, Cancelled> {
    let &Search { mesh, topology, .. } = search;
    let copies = Copies::new(topology);
    let mut free: Vec<bool> = topology.shell_of.iter().map(|shell| *shell != u32::MAX).collect();
    let mut hubs = hub::hubs(mesh, topology, |f| copies.later(f));
    hubs.iter().flat_map(Hub::facets).for_each(|f| free[f as usize] = false);
    topology.duplicate_facets.iter().for_each(|d| free[d[1] as usize] = false);
    let limits = [MAX_OVERLAPS_PER_FACET * (mesh.faces.len() + 1000), usize::MAX];
    for enough in limits {
        if let Some(found) = attempt(search, (&copies, &hubs, &free), enough, progress, level)? {
            return Ok(found);
        }
        hubs.extend(crowd::crowds(mesh, &mut free));
    }
    Err(Cancelled)
}

/// The search with these hubs, and with the facets that are `free` in the tree; `None` where more than `enough` boxes overlap.
fn attempt(
    search: &Search,
    (copies, hubs, free): (&Copies, &[Hub], &[bool]),
    enough: usize,
    progress: &dyn Progress,
    level: Level,
) -> Result<Option<Crossings>, Cancelled> {
    let &Search { mesh, topology, limit, most, alone, .. } = search;
    let joined = search.selected.map(|selected| copies.joined(selected));
    let selected = joined.as_deref();
    let tree = Tree::build(mesh, topology, free, selected, progress);
    let wanted = Wanted { copies, selected: search.selected, limit };
    let [found, tried] = [0, 0].map(AtomicUsize::new);
    let walk = Walk { mesh, tree: &tree, progress, most, enough, alone, found, tried };
    let mut pairs = Pairs::new(wanted);
    around_hubs(&walk, hubs, selected, &mut pairs);
    if !tree.leaves.is_empty() && !walk.is_over() {
        let top = tree.levels.len() - 1;
        match level.min(Level::detect()) {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: `Level::detect` found these instructions.
            Level::Avx2 | Level::Avx512 => unsafe { avx2(&walk, top, 0, &[0], &mut pairs) },
            _ => plain(&walk, top, 0, &[0], &mut pairs),
        }
    }
    if progress.cancelled() {
        return Err(Cancelled);
    }
    // A search that found too many pairs has told all that is asked for.
    if walk.is_crowded() && pairs.count <= most {
        return Ok(None);
    }
    pairs.cut(0);
    pairs.first.par_sort_unstable();
    Ok(Some(Crossings { count: pairs.count, at_least: false, first: pairs.first }))
}

/// Finds the pairs of which one facet is at a hub.
fn around_hubs<'a>(walk: &Walk, hubs: &[Hub], selected: Option<&[bool]>, pairs: &mut Pairs<'a>) {
    /// Facets of one task.
    const INTERSECTED_FACETS_PER_TASK: usize = 1 << 10;
    let wanted = pairs.wanted;
    let triangle = |facet: u32| {
        let face = walk.mesh.faces[facet as usize];
        (walk.mesh.places(&face), face)
    };
    let asked = |a: u32, b: u32| selected.is_none_or(|selected| selected[a as usize] || selected[b as usize]);
    // Each answer says whether to go on.
    let decide = |part: &mut Pairs<'a>, a: u32, b: u32| {
        if asked(a, b) && meet::meet(&triangle(a), &triangle(b)) {
            let before = part.count;
            part.push(a, b);
            walk.found.fetch_add(part.count - before, Relaxed);
        }
        !walk.is_over()
    };
    for (i, hub) in hubs.iter().enumerate() {
        if !hub.pairs(&mut |a, b| decide(pairs, a, b)) || walk.is_over() {
            return;
        }
        let mut others = walk.tree.reaching(&hub.bounds());
        hubs[i + 1..].iter().for_each(|other| others.extend(other.facets()));
        let part = |others: &[u32]| {
            let mut part = Pairs::new(wanted);
            let go_on = |other: &&u32| {
                hub.against(walk.mesh, **other, &mut |a, b| decide(&mut part, a, b)) && !walk.is_over()
            };
            others.iter().take_while(go_on).for_each(drop);
            part
        };
        if walk.alone {
            others.chunks(INTERSECTED_FACETS_PER_TASK).for_each(|others| pairs.append(part(others)));
        } else {
            let parts: Vec<Pairs> = others.par_chunks(INTERSECTED_FACETS_PER_TASK).map(part).collect();
            parts.into_iter().for_each(|part| pairs.append(part));
        }
    }
}

/// Nodes up to this level are not worth the work of several threads.
const MAX_SEQUENTIAL_LEVEL: usize = 2;

struct Walk<'a> {
    mesh: &'a Mesh,
    tree: &'a Tree,
    progress: &'a dyn Progress,
    most: usize,
    alone: bool,
    /// Beyond so many pairs of boxes it is another search's turn.
    enough: usize,
    /// Pairs found so far, wherever.
    found: AtomicUsize,
    /// Pairs of boxes compared so far.
    tried: AtomicUsize,
}

/// [`Walk::descend`] for one level of instructions.
///
/// # Safety
/// The processor has these instructions.
type Descend = for<'a> unsafe fn(&Walk, usize, usize, &[u32], &mut Pairs<'a>);

fn plain<'a>(walk: &Walk, level: usize, i: usize, list: &[u32], out: &mut Pairs<'a>) {
    // SAFETY: plain Rust.
    unsafe { walk.descend::<Plain<TREE_WIDTH>>(level, i, list, out, plain) }
}

/// # Safety
/// The processor has the instructions named here.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,popcnt")]
unsafe fn avx2(walk: &Walk, level: usize, i: usize, list: &[u32], out: &mut Pairs) {
    // SAFETY: the instructions are those of this function.
    unsafe { walk.descend::<A8>(level, i, list, out, avx2) }
}

#[inline(always)]
fn lane(b: &Boxes, i: usize) -> [f32; 6] {
    std::array::from_fn(|k| b.0[k][i])
}

impl Walk<'_> {
    fn is_over(&self) -> bool {
        self.found.load(Relaxed) > self.most || self.is_crowded() || self.progress.cancelled()
    }

    fn is_crowded(&self) -> bool {
        self.tried.load(Relaxed) > self.enough
    }

    /// Everything below node `i` of `level` against itself and the later nodes of `list`, which holds `i` too.
    ///
    /// # Safety
    /// The processor has the instructions of `L` and of `descend_below`.
    #[inline(always)]
    unsafe fn descend<L: Masks>(
        &self,
        level: usize,
        i: usize,
        list: &[u32],
        out: &mut Pairs,
        descend_below: Descend,
    ) {
        if level == 0 {
            // SAFETY: handed on.
            return unsafe { self.leaf_pairs::<L>(i, list, out) };
        }
        let children = 0..TREE_WIDTH.min(self.tree.levels[level - 1].len() - i * TREE_WIDTH);
        if level <= MAX_SEQUENTIAL_LEVEL {
            let mut next = vec![];
            for a in children.clone() {
                next.clear();
                // SAFETY: handed on.
                unsafe { self.inherit::<L>(level, i, a, list, &mut next) };
                // SAFETY: the instructions of `descend_below` are those of `L`.
                unsafe { descend_below(self, level - 1, i * TREE_WIDTH + a, &next, out) };
            }
            if level == 1 {
                self.progress.advance((children.len() * TREE_WIDTH) as u64);
            }
            return;
        }
        let mut lists = vec![];
        for a in children {
            let mut next = vec![];
            // SAFETY: handed on.
            unsafe { self.inherit::<L>(level, i, a, list, &mut next) };
            lists.push((i * TREE_WIDTH + a, next));
        }
        if self.alone {
            // SAFETY: as above.
            let one = |(child, next): (usize, Vec<u32>)| unsafe {
                descend_below(self, level - 1, child, &next, out)
            };
            return lists.into_iter().for_each(one);
        }
        let wanted = out.wanted;
        let parts = lists.into_par_iter().map(|(child, next)| {
            let mut part = Pairs::new(wanted);
            // SAFETY: as above.
            unsafe { descend_below(self, level - 1, child, &next, &mut part) };
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
                next.push(j * TREE_WIDTH as u32 + m.trailing_zeros());
                m &= m - 1;
            }
        }
    }

    /// Pairs between leaf `i` and the leaves of `list`.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn leaf_pairs<L: Masks>(&self, i: usize, list: &[u32], out: &mut Pairs) {
        if self.is_over() {
            return;
        }
        let (mut before, mut tried) = (out.count, 0);
        let t = self.tree;
        let (l, own) = (&t.leaves[i], &t.levels[0][i]);
        let planes = filter::planes(self.mesh, &t.frame, l);
        for j in list.iter().map(|&j| j as usize) {
            let (q, boxes) = (&t.leaves[j], &t.levels[0][j]);
            // Box of the other leaf; unknown where there is one leaf only, and then all is decided exactly.
            let other = t.levels.get(1).map_or(EVERYWHERE, |up| lane(&up[j / TREE_WIDTH], j % TREE_WIDTH));
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
                tried += among.count_ones() as usize;
                let mut reach = 0.0;
                for k in 0..3 {
                    reach += if other[k + 3] > b[k + 3] { other[k + 3] } else { b[k + 3] }
                        - if other[k] < b[k] { other[k] } else { b[k] };
                }
                // SAFETY: handed on.
                let left =
                    unsafe { filter::unseparated::<L>((l, a, &planes), q, reach, t.frame.slack, among) };
                self.decide((l, a), q, left, out);
            }
            // A leaf may have very many neighbors.
            if out.count > before || tried > TREE_WIDTH * TREE_WIDTH * TREE_WIDTH {
                self.found.fetch_add(out.count - before, Relaxed);
                self.tried.fetch_add(std::mem::take(&mut tried), Relaxed);
                before = out.count;
                if self.is_over() {
                    return;
                }
            }
        }
        self.tried.fetch_add(tried, Relaxed);
    }

    /// Decides exactly about the pairs of triangle `a` of leaf `l` and those of leaf `q` that are `left`.
    #[inline(always)]
    fn decide(&self, (l, a): (&Leaf, usize), q: &Leaf, mut left: u32, out: &mut Pairs) {
        let triangle = |leaf: &Leaf, i: usize| {
            let face = self.mesh.faces[leaf.face[i] as usize];
            (self.mesh.places(&face), face)
        };
        while left != 0 {
            let c = left.trailing_zeros() as usize;
            left &= left - 1;
            if meet::meet(&triangle(l, a), &triangle(q, c)) {
                out.push(l.face[a], q.face[c]);
            }
        }
    }
}

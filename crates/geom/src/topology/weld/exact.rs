//! Exact weld: corners at the same position become one vertex, numbered by first appearance.
//!
//! Positions are the same when all three coordinates have the same bits, −0 counting as 0 (and a NaN as itself).
//!
//! One open-addressing table serves all threads. A slot holds one more than the number of the item that stands for its
//! position. Coordinates are compared where they lie (in the caller's file, for example), so a slot is four bytes. A thread may
//! meet a position represented by a later item than its own. It takes the slot over and leaves a forwarding entry; following
//! those at the end leads to the first item, whatever the threads did. Slots are prefetched a batch ahead. The table is larger
//! than any cache, and most of the time of a weld is spent waiting for memory.

use super::bits::Bits;
use super::error::{MAX_FACETS, WeldError};
use crate::memory::{PAGE_BYTES, atomics, large_pages, prefetch, triples};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::space::Point;
use std::sync::atomic::{
    AtomicU32, AtomicUsize,
    Ordering::{AcqRel, Acquire, Relaxed},
};

/// Slots in a page of memory.
const SLOTS_PER_PAGE: usize = PAGE_BYTES / size_of::<AtomicU32>();
/// Items hashed and prefetched together.
const ITEMS_PER_BATCH: usize = 96;
/// Items of one task.
const WELDED_ITEMS_PER_TASK: usize = 128 * ITEMS_PER_BATCH;

/// A position as it lies in memory or in a file: three numbers of either precision.
pub trait Position: Copy + Send + Sync + Bits {}
impl Position for [f32; 3] {}
impl Position for [f64; 3] {}

/// Mesh of `facets` facets given by the positions of their corners, as an STL file has them.
///
/// `corner(facet, k)` is asked several times for each `k` in `0..3`, from several threads, and must answer the same
/// each time. Face `i` of the result is facet `i`; vertices are numbered by first appearance, whatever the number of
/// threads. Facets with equal corners stay, as faces with a repeated vertex. Fast when `corner` reads from an array of
/// fixed-size records. Uses the current rayon pool.
///
/// # Errors
/// [`WeldError::TooManyFacets`].
pub fn corners<P: Position>(
    facets: usize,
    corner: impl Fn(usize, usize) -> P + Sync,
) -> Result<Mesh, WeldError> {
    if facets > MAX_FACETS {
        return Err(WeldError::TooManyFacets { facets });
    }
    let item = |c: usize| corner(c / 3, c % 3).normal();
    // A closed mesh has half as many vertices as facets.
    Ok(number(&item, first_of_its_kind(3 * facets, facets / 2, &item)))
}

/// A mesh whose vertices are distinct positions, and where the vertices of the mesh it was made from have gone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Welded {
    /// The same facets in the same order.
    pub mesh: Mesh,
    /// For each vertex of the original its number in `mesh`, or [`u32::MAX`] if no face uses it.
    pub vertex_of: Vec<u32>,
}

/// Makes one vertex of all vertices at the same position, and drops those that no face uses.
///
/// Vertices are numbered by first appearance in the faces. A mesh made by [`corners`] comes out as it went in.
/// Uses the current rayon pool.
///
/// # Errors
/// [`WeldError::NoSuchVertex`], [`WeldError::TooManyFacets`].
pub fn mesh(mesh: &Mesh) -> Result<Welded, WeldError> {
    check_corners(mesh)?;
    let vertices = mesh.positions.len();
    // More positions than corners can name are more than faces can use.
    let named = vertices.min(u32::MAX as usize - 1);
    let item = |v: usize| mesh.positions[v].normal();
    let first = first_of_its_kind(named, named, &item);
    let first_of = |v: u32| first[v as usize].load(Relaxed);
    Ok(renumbered(mesh, first_of))
}

/// The mesh in which each vertex `v` has become `first_of(v)`, which stands for itself; numbered by first appearance.
pub(super) fn renumbered(mesh: &Mesh, first_of: impl Fn(u32) -> u32) -> Welded {
    let mut vertex_of = vec![u32::MAX; mesh.positions.len()];
    let mut positions = Vec::new();
    let faces = mesh.faces.iter().map(|face| {
        face.map(|v| {
            let first = first_of(v) as usize;
            if vertex_of[first] == u32::MAX {
                vertex_of[first] = positions.len() as u32;
                positions.push(mesh.positions[first].normal());
            }
            let number = vertex_of[first];
            vertex_of[v as usize] = number;
            number
        })
    });
    let faces = faces.collect();
    Welded { mesh: Mesh { positions, faces }, vertex_of }
}

/// That every corner of `mesh` can be numbered and names a vertex that is there.
pub fn check_corners(mesh: &Mesh) -> Result<(), WeldError> {
    let (facets, vertices) = (mesh.faces.len(), mesh.positions.len());
    if facets > MAX_FACETS {
        return Err(WeldError::TooManyFacets { facets });
    }
    // Nearly always all numbers are in range, and the largest of them shows it fastest.
    let largest = |part: &[[u32; 3]]| part.as_flattened().iter().fold(0, |most: u32, v| most.max(*v));
    let largest = mesh.faces.par_chunks(WELDED_ITEMS_PER_TASK).map(largest).max();
    if largest.is_none_or(|v| (v as usize) < vertices) {
        return Ok(());
    }
    let bad = |v: &&u32| **v as usize >= vertices;
    let first = |(facet, f): (usize, &[u32; 3])| f.iter().find(bad).map(|&v| (facet, v));
    match mesh.faces.par_iter().enumerate().find_map_first(first) {
        Some((facet, vertex)) => Err(WeldError::NoSuchVertex { facet, vertex, vertices }),
        None => Ok(()),
    }
}

/// The numbers of those points that are the first at their place, ascending. At most [`MAX_FACETS`] points.
///
/// Cost: linear; one pass over a table of places.
/// ```
/// let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, -0.0, 0.0]];
/// assert_eq!(trueness_geom::topology::weld::first_at_their_places(&points), [0, 1]);
/// ```
pub fn first_at_their_places(points: &[Point]) -> Vec<u32> {
    let item = |i: usize| points[i].normal();
    let first = first_of_its_kind(points.len(), points.len(), &item);
    (0u32..)
        .zip(&first)
        .filter(|(number, first)| first.load(Relaxed) == *number)
        .map(|(number, _)| number)
        .collect()
}

/// For each of `n` items the first one equal to it. `expected` is a guess at the number of different ones.
fn first_of_its_kind<P: Position>(
    n: usize,
    expected: usize,
    item: &(impl Fn(usize) -> P + Sync),
) -> Vec<AtomicU32> {
    let first = atomics(n);
    // A table that is found too full still takes in the chunks under way, one for each thread. It must have room for them above
    // its limit, or be large enough for everything.
    let under_way = rayon::current_num_threads() * WELDED_ITEMS_PER_TASK;
    let mut size = (2 * expected).max(3 * under_way).min(2 * n).max(2).next_power_of_two();
    while !enter(size, item, &first) {
        size *= 4;
    }
    (0..n.div_ceil(WELDED_ITEMS_PER_TASK)).into_par_iter().for_each(|i| {
        for c in i * WELDED_ITEMS_PER_TASK..n.min((i + 1) * WELDED_ITEMS_PER_TASK) {
            let mut at = c as u32;
            loop {
                // Entries only ever become smaller and end at one that names itself, so racing with the other tasks
                // that shorten paths here is harmless.
                let next = first[at as usize].load(Relaxed);
                if next == at {
                    break;
                }
                at = next;
            }
            first[c].store(at, Relaxed);
        }
    });
    first
}

/// Writes for each item an equal one that is not later. False if the table of `size` slots became too full.
fn enter<P: Position>(size: usize, item: &(impl Fn(usize) -> P + Sync), first: &[AtomicU32]) -> bool {
    let table = atomics(size);
    // A page that is read before it is written is mapped twice, and the second time all threads are interrupted.
    table.par_chunks(SLOTS_PER_PAGE).for_each(|page| page[0].store(0, Relaxed));
    let shift = 64 - size.trailing_zeros();
    let used = AtomicUsize::new(0);
    let limit = size / 8 * 5;
    first.par_chunks(WELDED_ITEMS_PER_TASK).enumerate().for_each(|(i, part)| {
        if used.load(Relaxed) > limit {
            return;
        }
        let mut new = 0;
        let mut batch = [(item(i * WELDED_ITEMS_PER_TASK), 0usize); ITEMS_PER_BATCH];
        for (j, part) in part.chunks(ITEMS_PER_BATCH).enumerate() {
            let start = i * WELDED_ITEMS_PER_TASK + j * ITEMS_PER_BATCH;
            for (k, b) in batch[..part.len()].iter_mut().enumerate() {
                let p = item(start + k);
                *b = (p, (p.hash() >> shift) as usize);
                prefetch(&table[b.1]);
            }
            for (k, (p, slot)) in batch[..part.len()].iter().enumerate() {
                new += usize::from(insert(&table, *slot, (start + k) as u32, p, item, first));
            }
        }
        used.fetch_add(new, Relaxed);
    });
    used.into_inner() <= limit
}

/// Enters item `c` at position `p`, starting at slot `at`. True if it is the first there.
#[inline(always)]
fn insert<P: Position>(
    table: &[AtomicU32],
    mut at: usize,
    c: u32,
    p: &P,
    item: &impl Fn(usize) -> P,
    first: &[AtomicU32],
) -> bool {
    first[c as usize].store(c, Relaxed);
    loop {
        // Acquire and release: that `found` stands for itself was written before it was entered.
        let found = table[at].load(Acquire);
        if found == 0 {
            if table[at].compare_exchange(0, c + 1, AcqRel, Relaxed).is_ok() {
                return true;
            }
            continue;
        }
        let found = found - 1;
        if !item(found as usize).same(p) {
            at = (at + 1) & (table.len() - 1);
        } else if found < c {
            first[c as usize].store(found, Relaxed);
            return false;
        } else if table[at].compare_exchange(found + 1, c + 1, AcqRel, Relaxed).is_ok() {
            first[found as usize].store(c, Relaxed);
            return false;
        }
    }
}

/// Numbers the vertices by first appearance: `first` becomes the faces.
fn number<P: Position>(item: &(impl Fn(usize) -> P + Sync), first: Vec<AtomicU32>) -> Mesh {
    let n = first.len();
    let range = |i: usize| i * WELDED_ITEMS_PER_TASK..n.min((i + 1) * WELDED_ITEMS_PER_TASK);
    let is_first = |c: &usize| first[*c].load(Relaxed) as usize == *c;
    let chunks = n.div_ceil(WELDED_ITEMS_PER_TASK);
    let lists: Vec<Vec<u32>> =
        (0..chunks).into_par_iter().map(|i| range(i).filter(is_first).map(|c| c as u32).collect()).collect();
    let mut positions = large_pages(vec![[0.0; 3]; lists.iter().map(Vec::len).sum()]);
    let id = atomics(n);
    let mut jobs = Vec::with_capacity(chunks);
    let (mut rest, mut total) = (&mut positions[..], 0);
    for list in lists {
        let (mine, later) = rest.split_at_mut(list.len());
        rest = later;
        jobs.push((total, mine, list));
        total += jobs[jobs.len() - 1].2.len();
    }
    jobs.into_par_iter().for_each(|(start, mine, list)| {
        for (i, (c, place)) in list.into_iter().zip(mine).enumerate() {
            id[c as usize].store((start + i) as u32, Relaxed);
            *place = item(c as usize).point();
        }
    });
    (0..chunks).into_par_iter().for_each(|i| {
        for c in range(i) {
            let f = first[c].load(Relaxed) as usize;
            if f != c {
                id[c].store(id[f].load(Relaxed), Relaxed);
            }
        }
    });
    Mesh { positions, faces: triples(id) }
}

/// Whether no two vertices are at one place.
fn are_distinct(mesh: &Mesh) -> Result<bool, WeldError> {
    check_corners(mesh)?;
    // Faces cannot name more.
    let named = mesh.positions.len().min(u32::MAX as usize - 1);
    let first = first_of_its_kind(named, named, &|v: usize| mesh.positions[v].normal());
    Ok(first.par_iter().enumerate().all(|(v, first)| first.load(Relaxed) as usize == v))
}

/// The mesh itself if its vertices are distinct places that facets use; else welded.
pub fn as_it_is(this: &Mesh) -> Result<Mesh, WeldError> {
    let mut used = vec![false; this.positions.len()];
    if are_distinct(this)? {
        this.faces.iter().flatten().for_each(|v| used[*v as usize] = true);
        if !used.contains(&false) {
            return Ok(this.clone());
        }
    }
    let welded = mesh(this)?.mesh;
    Ok(if welded.positions.len() == this.positions.len() { this.clone() } else { welded })
}

/// The mesh whose facets name the first of several vertices at one place. Far from the origin, rounding can put a vertex that was
/// added beside another at the same place.
pub fn rejoined(mut of: Mesh) -> Result<Mesh, WeldError> {
    if are_distinct(&of)? {
        return Ok(of);
    }
    let vertex_of = mesh(&of)?.vertex_of;
    let mut first = vec![u32::MAX; of.positions.len()];
    for (v, number) in (0..).zip(&vertex_of).filter(|(_, number)| **number != u32::MAX) {
        let first = &mut first[*number as usize];
        *first = v.min(*first);
    }
    of.faces.iter_mut().for_each(|f| *f = f.map(|v| first[vertex_of[v as usize] as usize]));
    Ok(of)
}

/// The mesh without the vertices that no facet uses, but always with the first `keep`; the others keep their order.
pub fn compact(mesh: Mesh, keep: usize) -> Mesh {
    let mut number: Vec<u32> = vec![u32::MAX; mesh.positions.len()];
    mesh.faces.iter().flatten().for_each(|v| number[*v as usize] = 0);
    let mut positions: Vec<Point> = vec![];
    for (v, p) in mesh.positions.into_iter().enumerate() {
        if v < keep || number[v] == 0 {
            number[v] = positions.len() as u32;
            positions.push(p);
        }
    }
    Mesh { positions, faces: mesh.faces.iter().map(|f| f.map(|v| number[v as usize])).collect() }
}

#[cfg(test)]
mod tests;

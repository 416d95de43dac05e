//! Gaps between edges that were meant as one.
//!
//! 1. Vertices on the boundary within the gap of one another become one.
//! 2. Each boundary edge is joined with a partner whose two ends lie near its own. The distance allowed grows fourfold from pass
//!    to pass up to the limit, so that the nearest partner is taken first. It is never more than a quarter of the length of either
//!    edge, so that the ends of an edge cannot become one.

use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use trueness_geom::check::Known;
use trueness_geom::check::{self, near::Near};
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{minus, norm, plus, times};
use trueness_geom::topology::union::Sets;

pub(super) const STEP: Step = Step {
    name: "stitch",
    about: "Joins boundary vertices within the gap of one another, and boundary edges whose ends lie nearer to each other than \
            the stitching distance and than a quarter of their length.",
    removes: Removes::Nothing,
};

/// Stitching distance by default, as a share of the diagonal of the mesh.
const DEFAULT_REACH_OF_DIAGONAL: f64 = 1e-4;
/// By how much the distance grows from pass to pass.
const REACH_GROWTH: f64 = 4.0;
/// Only so many of the edges near one are looked at in a pass, those with the nearest middles. In a heap of edges each
/// lies near all others.
const MAX_EDGES_NEAR: usize = 64;
/// The best so many of them are considered.
const MAX_PARTNERS: usize = 8;

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    if work.known()?.topology.boundary_edges.is_empty() {
        return Ok(());
    }
    let mut groups = work.find(check::UNSHARED_VERTICES)?;
    let known = work.known()?;
    let sets = Sets::new(work.mesh().positions.len());
    let is_kept_apart = |v: &u32| work.state.handover.kept_apart.contains(v);
    groups.retain(|g| !g.vertices.iter().any(is_kept_apart));
    groups.iter().for_each(|g| g.vertices.iter().for_each(|&v| sets.join(v, g.vertices[0])));
    let members = groups.into_iter().flat_map(|g| g.vertices).collect();
    merge(work, &known, &sets, members);
    let diagonal = work.known()?.properties.bounds.diagonal();
    let limit = work.options.stitch.unwrap_or(DEFAULT_REACH_OF_DIAGONAL * diagonal);
    let mut reach = work.gap;
    if reach >= limit || reach <= 0.0 {
        return Ok(());
    }
    // Nothing is joined at less than the distance of the first pair that would be joined at the limit. In a smaller
    // reach each edge has the nearest of its partners there, in the same order.
    let known = work.known()?;
    let least = partners(work, &known, limit).into_iter().find(|(_, [a, b])| a != b).map(|found| found.0);
    let Some(least) = least else { return Ok(()) };
    while reach < limit {
        reach = (REACH_GROWTH * reach).min(limit);
        if reach < least {
            continue;
        }
        let known = work.known()?;
        if known.topology.boundary_edges.is_empty() {
            break;
        }
        let sets = Sets::new(work.mesh().positions.len());
        let mut members = vec![];
        for (_, [a, b]) in partners(work, &known, reach).into_iter().filter(|(_, [a, b])| a != b) {
            sets.join(a, b);
            members.extend([a, b]);
        }
        merge(work, &known, &sets, members);
    }
    Ok(())
}

/// Lets each set of vertices become that one of its members which has the most facets.
fn merge(work: &mut Work, known: &Known, sets: &Sets, members: Vec<u32>) {
    let weight = |v: u32| (known.topology.facets_at_vertex(v).len(), std::cmp::Reverse(v));
    let mut all: Vec<(u32, u32)> = members.into_iter().map(|v| (sets.root(v), v)).collect();
    all.sort_unstable();
    all.dedup();
    let mut renamed = vec![];
    for group in all.chunk_by(|a, b| a.0 == b.0) {
        let Some(&(_, kept)) = group.iter().max_by_key(|(_, v)| weight(*v)) else { continue };
        let far = |v: u32| norm(minus(work.at(v), work.at(kept)));
        let farthest = group.iter().map(|(_, v)| far(*v)).fold(0.0, f64::max);
        work.log(&STEP, "vertices joined", work.at(kept), group.len(), farthest);
        renamed.extend(group.iter().filter(|(_, v)| *v != kept).map(|&(_, v)| (v, kept)));
    }
    if renamed.is_empty() {
        return;
    }
    renamed.sort_unstable();
    work.rename(|_, v| renamed.binary_search_by_key(&v, |r| r.0).map_or(v, |i| renamed[i].1));
}

/// Pairs of vertices to be joined so that boundary edges within `reach` of each other become one. The nearest edges
/// come first, with the distance of the edges, mm.
fn partners(work: &Work, known: &Known, reach: f64) -> Vec<(f64, [u32; 2])> {
    let edges = &known.topology.boundary_edges;
    let ends = |e: u32| edges[e as usize].vertices;
    let length = |e: u32| norm(minus(work.at(ends(e)[0]), work.at(ends(e)[1])));
    let middle = |e: u32| times(0.5, plus(work.at(ends(e)[0]), work.at(ends(e)[1])));
    let near = Near::new((0..edges.len() as u32).map(|e| (middle(e), e)).collect());
    let apart = |a: u32, b: u32| norm(minus(work.at(a), work.at(b)));
    type Found = (f64, u32, u32, [[u32; 2]; 2]);
    let nearer = |x: &Found, y: &Found| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2)));
    let of_edge = |e: u32| {
        let (at, [a, b]) = (middle(e), ends(e));
        let counts = |f: u32| edges[f as usize].facet != edges[e as usize].facet;
        let mut own: Vec<Found> = vec![];
        for f in near.nearest(at, reach, MAX_EDGES_NEAR, counts) {
            let [c, d] = ends(f);
            let limit = reach.min(0.25 * length(e).min(length(f)));
            for pairs in [[[a, d], [b, c]], [[a, c], [b, d]]] {
                let distance = apart(pairs[0][0], pairs[0][1]).max(apart(pairs[1][0], pairs[1][1]));
                if distance <= limit && distance.is_finite() {
                    own.push((distance, e.min(f), e.max(f), pairs));
                }
            }
        }
        own.sort_unstable_by(nearer);
        own.truncate(MAX_PARTNERS);
        own
    };
    let mut found: Vec<Found> = (0..edges.len() as u32)
        .into_par_iter()
        .map(|e| if work.progress.cancelled() { vec![] } else { of_edge(e) })
        .collect::<Vec<_>>()
        .concat();
    found.sort_unstable_by(nearer);
    let is_kept_apart = |v: &u32| work.state.handover.kept_apart.contains(v);
    let mut used = vec![false; edges.len()];
    let mut pairs = vec![];
    for (distance, e, f, joined) in found {
        let free = !used[e as usize] && !used[f as usize] && !joined.iter().flatten().any(is_kept_apart);
        let apart = |[a, b]: &[u32; 2]| a == b || !known.topology.has_edge(work.mesh(), [*a, *b]);
        if free && joined.iter().all(apart) {
            (used[e as usize], used[f as usize]) = (true, true);
            pairs.extend(joined.map(|pair| (distance, pair)));
        }
    }
    pairs
}

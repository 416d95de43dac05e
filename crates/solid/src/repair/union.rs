//! Closed shells that cross, touch in faces or contain each other: replaced by the boundary of the material that they
//! enclose together.
//!
//! Shells at whose edges as many facets run the one way as the other enclose material. They meet, or one lies in the
//! material of another. Then [`outer_boundary`](crate::arrange::outer_boundary) tells exactly which parts of them bound
//! the material. Sheets and shells with holes take no part; once their holes are filled they do.

use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use crate::arrange::{ArrangeError, Boundary, Input, Options, any_at_edges, boundary_of};
use trueness_geom::check;
use trueness_geom::check::finding::area;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::Point;
use trueness_geom::topology::Topology;
use trueness_geom::topology::union::Sets;
use trueness_geom::topology::weld::{self, Welded};

pub(super) const STEP: Step = Step {
    name: "union",
    about: "Unites closed shells that cross, coincide or lie in each other's material; what lies inside is cut away, cavities \
            stay. Decided exactly.",
    removes: Removes::Nothing,
};

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    let solid = solid_shells(work.mesh(), &known.topology);
    let is_solid = |f: u32| solid.get(known.topology.shell_of[f as usize] as usize) == Some(&true);
    let facets: Vec<u32> = (0..work.mesh().faces.len() as u32).filter(|f| is_solid(*f)).collect();
    if facets.is_empty() || !has_work(work, &known.topology, &is_solid)? {
        return Ok(());
    }
    let faces = facets.iter().map(|f| work.mesh().faces[*f as usize]).collect();
    let Welded { mesh, vertex_of } = weld::mesh(&Mesh { positions: work.mesh().positions.clone(), faces })?;
    // The first vertex at each place.
    let mut first = vec![u32::MAX; mesh.positions.len()];
    for (v, number) in (0..).zip(&vertex_of).filter(|(_, number)| **number != u32::MAX) {
        let first = &mut first[*number as usize];
        *first = v.min(*first);
    }
    let options = Options { single: work.options.single, turn: true };
    let pairs = pairs(work, &facets, &vertex_of, mesh.positions.len())?;
    let all = pairs.is_some() && facets.len() == work.mesh().faces.len();
    let input = Input { mesh: mesh.clone(), topology: all.then_some(&known.topology), pairs };
    match boundary_of(input, &options, work.progress) {
        Ok(boundary) => {
            work.state.handover.not_united = None;
            replace(work, (&facets, &first), &mesh, boundary);
        }
        Err(ArrangeError::Weld(e)) => return Err(e.into()),
        Err(ArrangeError::Cancelled(e)) => return Err(e.into()),
        Err(e) => work.state.handover.not_united = Some(e),
    }
    Ok(())
}

/// The pairs among `facets` that meet where they should not, by their places in that list. `None` where they must be
/// looked for, because the weld that numbered vertices by `vertex_of`, below `numbers`, has joined some of them.
fn pairs(
    work: &mut Work,
    facets: &[u32],
    vertex_of: &[u32],
    numbers: usize,
) -> Result<Option<Vec<[u32; 2]>>, RepairError> {
    if vertex_of.iter().filter(|number| **number != u32::MAX).count() != numbers {
        return Ok(None);
    }
    let place = |f: u32| facets.binary_search(&f).ok().map(|i| i as u32);
    let pair = |[a, b]: &[u32; 2]| Some([place(*a)?, place(*b)?]);
    Ok(work.all_crossings()?.map(|all| all.iter().filter_map(pair).collect()))
}

/// Shells with as many facets one way as the other at every edge.
pub(super) fn solid_shells(mesh: &Mesh, topology: &Topology) -> Vec<bool> {
    let mut solid = vec![true; topology.shells];
    for e in topology.boundary_edges.iter().chain(&topology.inconsistent_edges) {
        solid[topology.shell_of[e.facet as usize] as usize] = false;
    }
    for e in &topology.non_manifold_edges {
        let [a, b] = e.vertices;
        let runs = |f: &u32| {
            let face = mesh.faces[*f as usize];
            (0..3).any(|k| face[k] == a && face[(k + 1) % 3] == b)
        };
        let facets = topology.facets_at_edge(mesh, e.vertices);
        if 2 * facets.iter().filter(|f| runs(f)).count() != facets.len() {
            solid[topology.shell_of[e.facet as usize] as usize] = false;
        }
    }
    solid
}

/// Whether solid shells cross, coincide, or one lies in the material of another, or in a shell that is inside out.
fn has_work(
    work: &mut Work,
    topology: &Topology,
    is_solid: &impl Fn(u32) -> bool,
) -> Result<bool, RepairError> {
    if topology.duplicate_facets.iter().any(|[a, b]| is_solid(*a) && is_solid(*b)) {
        return Ok(true);
    }
    if any_at_edges(work.mesh(), topology, work.options.single) {
        return Ok(true);
    }
    let wrong = work.find(check::INSIDE_OUT_SHELLS)?;
    if wrong.iter().any(|finding| finding.measures.iter().any(|(name, x)| *name == "depth" && *x != 0.0)) {
        return Ok(true);
    }
    // Nothing is known of a tangle; the union says so.
    Ok(work
        .crossings(|f, _| is_solid(f))?
        .is_none_or(|pairs| pairs.iter().any(|[a, b]| is_solid(*a) && is_solid(*b))))
}

/// Puts the boundary in the place of the facets that `mesh` is made of, given with the names of its vertices.
fn replace(work: &mut Work, (facets, first): (&[u32], &[u32]), mesh: &Mesh, boundary: Boundary) {
    let old = work.mesh().positions.len() as u32;
    let name = |v: u32| first.get(v as usize).copied().unwrap_or_else(|| old + v - first.len() as u32);
    let mut pieces: Vec<(u32, [u32; 3])> = vec![];
    let (mut is_kept, mut is_cut) = (vec![false; facets.len()], vec![false; facets.len()]);
    let mut turned = vec![];
    for (face, source) in boundary.mesh.faces.iter().zip(&boundary.source) {
        let [a, b, c] = mesh.faces[*source as usize];
        if *face == [a, b, c] {
            is_kept[*source as usize] = true;
        } else if *face == [a, c, b] {
            is_kept[*source as usize] = true;
            turned.push(facets[*source as usize]);
        } else {
            is_cut[*source as usize] = true;
            pieces.push((*source, face.map(name)));
        }
    }
    // In the order of the facets that they are pieces of, and of one in their own.
    pieces.sort_by_key(|piece| piece.0);
    let dropped: Vec<u32> = (0..).zip(&is_kept).filter(|(_, kept)| !**kept).map(|(f, _)| f).collect();
    log(work, mesh, &dropped, &is_cut);
    if !turned.is_empty() {
        let place = work.middle(turned[0]);
        let size = turned.iter().map(|f| area(work.corners(*f))).sum();
        work.log(&STEP, "facets of shells that were inside out turned over", place, turned.len(), size);
        work.turn(turned);
    }
    if dropped.is_empty() {
        return;
    }
    work.append(&boundary.mesh.positions[first.len()..]);
    let removed: Vec<u32> = dropped.iter().map(|f| facets[*f as usize]).collect();
    work.replace(&removed, &pieces.into_iter().map(|piece| piece.1).collect::<Vec<_>>());
}

/// Tells each place where facets were cut, and each where whole facets lay inside. Facets that share a vertex are one place.
fn log(work: &mut Work, mesh: &Mesh, dropped: &[u32], is_cut: &[bool]) {
    let places = Sets::new(dropped.len());
    // For each vertex the first of the facets there that are gone, of those that were cut and of the others.
    let mut first = vec![[u32::MAX; 2]; mesh.positions.len()];
    for (i, f) in (0..).zip(dropped) {
        for v in mesh.faces[*f as usize] {
            let first = &mut first[v as usize][usize::from(is_cut[*f as usize])];
            *first = i.min(*first);
            places.join(i, *first);
        }
    }
    let mut members: Vec<(u32, u32)> = (0..).zip(dropped).map(|(i, f)| (places.root(i), *f)).collect();
    members.par_sort_unstable();
    let corners = |f: u32| mesh.corners(f);
    let mut changes: Vec<(&'static str, Point, usize, f64)> = vec![];
    for place in members.chunk_by(|a, b| a.0 == b.0) {
        let facet = place[0].1;
        let [a, b, c] = corners(facet);
        let middle = std::array::from_fn(|k| a[k] / 3.0 + b[k] / 3.0 + c[k] / 3.0);
        let what = match is_cut[facet as usize] {
            true => "facets cut where shells meet, and united",
            false => "facets inside the material removed",
        };
        let size = place.iter().map(|m| area(corners(m.1))).sum();
        changes.push((what, middle, place.len(), size));
    }
    for (what, place, facets, size) in changes {
        work.log(&STEP, what, place, facets, size);
    }
}

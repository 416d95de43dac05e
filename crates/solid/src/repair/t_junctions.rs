//! Vertices that lie on somebody else's edge: the facet there is cut, so that both sides share the vertex.

use super::degenerate::cut;
use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use std::collections::BTreeSet;
use trueness_geom::check;
use trueness_geom::space::{dot, minus, norm};

pub(super) const STEP: Step = Step {
    name: "t_junctions",
    about: "Cuts facets at boundary vertices that lie within the gap of their boundary edge.",
    removes: Removes::Nothing,
};

/// A vertex lies on one edge as a rule, on two where three sheets meet. Where they lie on more than so many on average, sheets lie
/// upon each other, and cutting would only make more that cross.
const MAX_EDGES_PER_VERTEX: usize = 2;

/// A vertex on an edge of a facet: facet, ends of the edge, place along it, vertex.
type On = (u32, [u32; 2], f64, u32);

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let mut all: Vec<On> = vec![];
    for finding in work.find(check::T_JUNCTIONS)? {
        let [vertex, a, b] = finding.vertices[..] else { continue };
        let along = minus(work.at(b), work.at(a));
        let place = dot(minus(work.at(vertex), work.at(a)), along);
        all.push((finding.facets[0], [a, b], place, vertex));
    }
    let vertices: BTreeSet<u32> = all.iter().map(|on| on.3).collect();
    if all.is_empty() || all.len() > work.room().min(MAX_EDGES_PER_VERTEX * vertices.len()) {
        return Ok(());
    }
    all.sort_unstable_by(|x, y| (x.0, x.1).cmp(&(y.0, y.1)).then(x.2.total_cmp(&y.2)).then(x.3.cmp(&y.3)));
    let (mut removed, mut added) = (vec![], vec![]);
    for on in all.chunk_by(|x, y| x.0 == y.0) {
        work.go_on()?;
        let facet = on[0].0;
        let parts = parts(work.mesh().faces[facet as usize], on);
        if parts.len() > 1 {
            let [a, b] = on[0].1;
            let length = norm(minus(work.at(b), work.at(a)));
            work.log(&STEP, "facet cut at vertices on its edge", work.at(on[0].3), parts.len(), length);
            removed.push(facet);
            added.extend(parts);
        }
    }
    if !removed.is_empty() {
        work.replace(&removed, &added);
    }
    Ok(())
}

/// The parts of `face` when its edges are cut at these vertices, sorted along each edge. Each vertex cuts once. Linear in the vertices.
fn parts(face: [u32; 3], on: &[On]) -> Vec<[u32; 3]> {
    let mut parts = vec![face];
    let mut corners = BTreeSet::from(face);
    for edge in on.chunk_by(|x, y| x.1 == y.1) {
        let [mut from, to] = edge[0].1;
        let has_edge = |p: &[u32; 3]| p.contains(&from) && p.contains(&to);
        let Some(mut last) = parts.iter().position(has_edge) else { continue };
        for &(_, _, _, vertex) in edge {
            if !corners.insert(vertex) {
                continue;
            }
            let halves = cut(parts[last], [from, to], vertex);
            // The rest of the edge is at the half with its end.
            let [done, rest] = if halves[0].contains(&to) { [halves[1], halves[0]] } else { halves };
            parts[last] = done;
            last = parts.len();
            parts.push(rest);
            from = vertex;
        }
    }
    parts
}

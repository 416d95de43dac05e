//! Facets without area.
//!
//! A facet with a repeated vertex holds nothing together and goes. One with three different vertices on a line does: its
//! middle vertex sits on the long edge of its neighbor. The neighbor is cut in two there, then the facet can go.

use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use trueness_geom::space::{Point, dot, minus};
use trueness_geom::topology::Topology;

pub(super) const STEP: Step = Step {
    name: "degenerate",
    about: "Removes facets without area. Where three vertices lie on a line, the neighbor at the long edge is cut at the \
            middle one.",
    removes: Removes::Nothing,
};

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    let repeated = known.topology.repeated_vertex.clone();
    let flat = known.topology.collinear.clone();
    for &f in &repeated {
        let place = work.at(work.mesh().faces[f as usize][0]);
        work.log(&STEP, "facet with a repeated vertex removed", place, 1, 0.0);
    }
    let (mut removed, mut added) = (repeated, vec![]);
    let mut touched = vec![false; work.mesh().faces.len()];
    for f in flat {
        let [a, b, middle] = with_middle_last(work, f);
        let neighbor = neighbor(work, &known.topology, f, [a, b]);
        // A neighbor that has changed in this pass is looked at in the next.
        if touched[f as usize] || neighbor.is_some_and(|n| touched[n as usize]) {
            continue;
        }
        touched[f as usize] = true;
        removed.push(f);
        work.log(&STEP, "facet on a line removed", work.at(middle), 1, 0.0);
        if let Some(n) = neighbor {
            touched[n as usize] = true;
            removed.push(n);
            added.extend(cut(work.mesh().faces[n as usize], [a, b], middle));
        }
    }
    if !removed.is_empty() {
        work.replace(&removed, &added);
    }
    Ok(())
}

/// The corners with the one between the others last.
fn with_middle_last(work: &Work, facet: u32) -> [u32; 3] {
    let [a, b, c] = work.mesh().faces[facet as usize];
    let span = |p: Point, q: Point| dot(minus(p, q), minus(p, q));
    let of = |[p, q, _]: [u32; 3]| span(work.at(p), work.at(q));
    let turns = [[a, b, c], [b, c, a], [c, a, b]];
    turns.into_iter().max_by(|x, y| of(*x).total_cmp(&of(*y))).unwrap_or([a, b, c])
}

/// The only other facet at the edge, if it does not have the middle vertex itself.
fn neighbor(work: &Work, topology: &Topology, facet: u32, edge: [u32; 2]) -> Option<u32> {
    let others = topology.facets_at_edge(work.mesh(), edge);
    match others[..] {
        [f, g] | [g, f] if f == facet && g != facet => {
            let shared = work.mesh().faces[facet as usize].iter();
            (shared.filter(|v| work.mesh().faces[g as usize].contains(v)).count() == 2).then_some(g)
        }
        _ => None,
    }
}

/// The two parts of `face` when its edge between `ends` is cut at `middle`.
pub(super) fn cut(face: [u32; 3], ends: [u32; 2], middle: u32) -> [[u32; 3]; 2] {
    let [a, b, c] = face;
    let turns = [[a, b, c], [b, c, a], [c, a, b]];
    let [a, b, c] = turns.into_iter().find(|t| !ends.contains(&t[2])).unwrap_or(face);
    [[a, middle, c], [middle, b, c]]
}

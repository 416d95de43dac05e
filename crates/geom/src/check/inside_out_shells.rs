//! Closed shells that look the wrong way.

use super::islands::shell_bounds;
use super::near::Near;
use super::nesting::Container;
use super::{Finding, Inspected, Kind, Severity};
use crate::space::Aabb;
use rayon::prelude::*;

pub(super) const KIND: Kind = Kind {
    name: "inside_out_shells",
    severity: Severity::Error,
    about: "Closed, consistently oriented shells that look inwards, or outwards where they bound a cavity: inside an odd \
            number of others a shell must look inwards. Facets: the first of the shell.",
    size: "volume enclosed, mm³",
    find: |m| {
        let closed = closed_shells(m);
        let bounds = shell_bounds(m);
        let depth = depths(m, &closed, &bounds);
        let wrong = |s: &usize| {
            let outward = m.properties.shell_volumes[*s] > 0.0;
            closed[*s] && outward != depth[*s].is_multiple_of(2)
        };
        let shells: Vec<usize> = (0..closed.len()).filter(wrong).collect();
        m.each(&shells, |&s| {
            let (first, bounds) = bounds[s];
            let position = std::array::from_fn(|k| bounds.min[k] / 2.0 + bounds.max[k] / 2.0);
            let measures = vec![("shell", s as f64), ("depth", f64::from(depth[s]))];
            let size = m.properties.shell_volumes[s].abs();
            Finding { facets: vec![first], vertices: vec![], position, bounds, size, measures }
        })
    },
};

/// Which shells are closed surfaces, all facets running the same way round.
fn closed_shells(m: &Inspected) -> Vec<bool> {
    let mut closed = vec![true; m.topology.shells];
    let t = m.topology;
    for e in t.boundary_edges.iter().chain(&t.inconsistent_edges).chain(&t.non_manifold_edges) {
        closed[t.shell_of[e.facet as usize] as usize] = false;
    }
    closed
}

/// How many closed shells each closed shell lies in.
fn depths(m: &Inspected, closed: &[bool], bounds: &[(u32, Aabb)]) -> Vec<u32> {
    let mut depth = vec![0; closed.len()];
    let corner = |s: usize| (bounds[s].1.min, s as u32);
    let near = Near::new((0..closed.len()).filter(|&s| closed[s]).map(corner).collect());
    if closed.len() < 2 {
        return depth;
    }
    let contains = |outer: &Aabb, inner: &Aabb| {
        (0..3).all(|k| outer.min[k] <= inner.min[k] && inner.max[k] <= outer.max[k])
    };
    let inside = |s: usize| {
        let (own, mut inner) = (bounds[s].1, vec![]);
        let reaches = |b: &Aabb| (0..3).all(|k| b.min[k] <= own.max[k] && own.min[k] <= b.max[k]);
        near.visit(reaches, |_, other| {
            if other as usize != s && contains(&own, &bounds[other as usize].1) {
                inner.push(other);
            }
        });
        inner
    };
    let shells = 0..closed.len();
    let outer: Vec<usize> = shells.into_par_iter().filter(|&s| closed[s] && !inside(s).is_empty()).collect();
    if outer.is_empty() {
        return depth;
    }
    let facets = by_shell(&m.topology.shell_of, closed.len());
    // One after the other: all lists together might have as many entries as there are pairs of shells.
    for s in outer {
        let container = Container::new(m.mesh, &facets[s]);
        let held = inside(s).into_par_iter().filter(|&s| lies_in(m, &facets[s as usize], &container));
        held.collect::<Vec<u32>>().into_iter().for_each(|s| depth[s as usize] += 1);
    }
    depth
}

/// Asks about corners of the shell until one does not lie on the container.
fn lies_in(m: &Inspected, shell: &[u32], container: &Container) -> bool {
    /// Shells that touch in more corners than this are taken to lie side by side.
    const TRIES: usize = 64;
    let corners = shell.iter().take(TRIES).map(|&f| m.corners(f)[0]);
    corners.into_iter().find_map(|p| container.winding(&p)).is_some_and(|w| w != 0)
}

/// The facets of each shell, ascending.
fn by_shell(shell_of: &[u32], shells: usize) -> Vec<Vec<u32>> {
    let mut facets = vec![vec![]; shells];
    for (f, &shell) in (0..).zip(shell_of) {
        if let Some(list) = facets.get_mut(shell as usize) {
            list.push(f);
        }
    }
    facets
}

//! Vertices that were likely meant to be one.

use super::{Kind, Severity};
use crate::space::{Aabb, minus, norm};
use crate::topology::union::Sets;
use rayon::prelude::*;

pub(super) const KIND: Kind = Kind {
    name: "unshared_vertices",
    severity: Severity::Error,
    about: "Groups of vertices on the boundary that lie within the gap of one another, directly or through others of the \
            group, and are not joined by an edge: were they one, facets would be neighbours.",
    size: "diagonal of their box, mm",
    find: |m| {
        let near = m.free_edges.near(m.mesh);
        let vertices = m.free_edges.vertices();
        let sets = Sets::new(vertices.len());
        (0..vertices.len() as u32).into_par_iter().for_each(|i| {
            if m.progress.cancelled() {
                return;
            }
            let v = vertices[i as usize];
            let at = m.mesh.positions[v as usize];
            let reaches = |b: &Aabb| (0..3).all(|k| at[k] >= b.min[k] - m.gap && at[k] <= b.max[k] + m.gap);
            near.visit(reaches, |p, other| {
                let close = other > v && norm(minus(*p, at)) <= m.gap;
                if close && m.topology.facets_at_edge(m.mesh, [v, other]).is_empty() {
                    sets.join(i, vertices.partition_point(|x| *x < other) as u32);
                }
            });
        });
        let mut members: Vec<(u32, u32)> = (0..vertices.len() as u32).map(|i| (sets.root(i), i)).collect();
        members.sort_unstable();
        let groups: Vec<&[(u32, u32)]> =
            members.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1).collect();
        m.each(&groups, |group| {
            let mut finding =
                m.finding(vec![], group.iter().map(|(_, i)| vertices[*i as usize]).collect(), 0.0);
            finding.size = finding.bounds.diagonal();
            finding
        })
    },
};

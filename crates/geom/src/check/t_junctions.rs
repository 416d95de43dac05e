//! Vertices that lie on somebody else's edge.

use super::near::{farthest, segment_reaches};
use super::{DefectKind, Found, Inspected, Measure, Severity, Shows};
use crate::parallel::prelude::*;
use crate::space::{Point, dot, minus, norm, plus, times};
use crate::topology::EdgeAt;

/// Edges of one task.
const BOUNDARY_EDGES_PER_TASK: usize = 1 << 9;

pub(super) const KIND: DefectKind = DefectKind {
    name: "t_junctions",
    severity: Severity::Error,
    about: "Vertices on the boundary that lie within the gap of a boundary edge of another facet, away from its ends. \
            Vertices: the one, then the ends of the edge.",
    size: "distance, mm",
    measure: Measure::Distance,
    shows: Shows::PointAndLine,
    follows: false,
    missing: None,
    find: |m| {
        let near = m.boundary.near(m.mesh);
        let at_edge = |e: &EdgeAt| {
            let [a, b] = e.vertices.map(|v| m.mesh.positions[v as usize]);
            let mut found = vec![];
            near.visit(
                // A point that near to an end is none: very many vertices may be.
                |bounds| {
                    segment_reaches(a, b, m.gap, bounds)
                        && [a, b].iter().all(|end| farthest(*end, bounds) * (1.0 + 1e-12) > m.gap)
                },
                |p, vertex| {
                    let distance = offset(*p, a, b, m.gap).filter(|_| !e.vertices.contains(&vertex));
                    found.extend(distance.map(|d| Junction {
                        vertex,
                        edge: e.vertices,
                        facet: e.facet,
                        distance: d,
                    }));
                },
            );
            found.sort_unstable_by_key(|j| j.vertex);
            found
        };
        // No more is kept of each part than can be listed: a wide gap may bring very many.
        let part = |edges: &[EdgeAt]| {
            let (mut count, mut first) = (0, vec![]);
            for found in edges.iter().take_while(|_| !m.progress.cancelled()).map(at_edge) {
                count += found.len();
                first.extend(found.into_iter().take(m.options.limit - first.len()));
            }
            (count, first)
        };
        let parts: Vec<(usize, Vec<Junction>)> =
            m.topology.boundary_edges.par_chunks(BOUNDARY_EDGES_PER_TASK).map(part).collect();
        let count = parts.iter().map(|p| p.0).sum();
        let first = parts.iter().flat_map(|p| &p.1).take(m.options.limit);
        Some(Found { count, at_least: false, items: first.map(|j| junction(m, j)).collect() })
    },
};

struct Junction {
    vertex: u32,
    edge: [u32; 2],
    facet: u32,
    distance: f64,
}

fn junction(m: &Inspected, j: &Junction) -> super::Finding {
    let mut finding = m.finding(vec![j.facet], vec![j.vertex, j.edge[0], j.edge[1]], j.distance);
    finding.position = m.mesh.positions[j.vertex as usize];
    finding
}

/// Distance of `p` from the line of `a` and `b` if it is at most `gap`. The point must be farther than that from both ends and
/// between them.
fn offset(p: Point, a: Point, b: Point, gap: f64) -> Option<f64> {
    let (along, to) = (minus(b, a), minus(p, a));
    let t = dot(to, along) / dot(along, along);
    let distance = norm(minus(p, plus(a, times(t, along))));
    let away = norm(to) > gap && norm(minus(p, b)) > gap;
    (t > 0.0 && t < 1.0 && distance <= gap && away).then_some(distance)
}

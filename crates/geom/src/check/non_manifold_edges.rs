//! Edges with more than two facets.

use super::{DefectKind, Measure, Severity, Shows};

pub(super) const KIND: DefectKind = DefectKind {
    name: "non_manifold_edges",
    severity: Severity::Error,
    about: "Edges with more than two facets: walls meet there, or facets are doubled.",
    size: "length, mm",
    measure: Measure::Length,
    shows: Shows::Line,
    follows: false,
    missing: None,
    find: |m| {
        m.each(&m.topology.non_manifold_edges, |e| {
            let facets = m.topology.facets_at_edge(m.mesh, e.vertices);
            m.finding(facets, e.vertices.to_vec(), m.distance(e.vertices))
        })
    },
};

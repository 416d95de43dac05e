//! Vertices at which parts of the surface touch.

use super::{DefectKind, Measure, Severity, Shows};

pub(super) const KIND: DefectKind = DefectKind {
    name: "non_manifold_vertices",
    severity: Severity::Error,
    about: "Vertices whose facets are not all connected through edges there: parts of the surface touch in a point.",
    size: "number of facets",
    measure: Measure::Facets,
    shows: Shows::Points,
    follows: false,
    missing: None,
    find: |m| {
        m.each(&m.topology.non_manifold_vertices, |&v| {
            let facets = m.topology.facets_at_vertex(v);
            let size = facets.len() as f64;
            m.finding(facets, vec![v], size)
        })
    },
};

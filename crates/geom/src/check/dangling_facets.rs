//! Facets with fewer than three neighbors.

use super::{DefectKind, Measure, Severity, Shows};

pub(super) const KIND: DefectKind = DefectKind {
    name: "dangling_facets",
    severity: Severity::Error,
    about: "Facets with fewer than three neighbors.",
    size: "neighbors missing",
    measure: Measure::Missing,
    shows: Shows::Facets,
    follows: true,
    missing: None,
    find: |m| {
        let mut facets: Vec<u32> = m.topology.boundary_edges.iter().map(|e| e.facet).collect();
        facets.sort_unstable();
        let missing: Vec<&[u32]> = facets.chunk_by(|a, b| a == b).collect();
        m.each(&missing, |f| m.finding(vec![f[0]], vec![], f.len() as f64))
    },
};

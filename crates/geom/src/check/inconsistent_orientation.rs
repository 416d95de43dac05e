//! Neighbors that face different ways.

use super::{DefectKind, Measure, Severity, Shows};

pub(super) const KIND: DefectKind = DefectKind {
    name: "inconsistent_orientation",
    severity: Severity::Error,
    about: "Edges whose two facets run along them in the same direction: one of them looks inwards.",
    size: "length, mm",
    measure: Measure::Length,
    shows: Shows::Line,
    follows: false,
    missing: None,
    find: |m| {
        m.each(&m.topology.inconsistent_edges, |e| {
            let facets = m.topology.facets_at_edge(m.mesh, e.vertices);
            m.finding(facets, e.vertices.to_vec(), m.distance(e.vertices))
        })
    },
};

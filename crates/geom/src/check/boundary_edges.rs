//! Edges with one facet only.

use super::{DefectKind, Measure, Severity, Shows};

pub(super) const KIND: DefectKind = DefectKind {
    name: "boundary_edges",
    severity: Severity::Error,
    about: "Edges with one facet: the surface has a rim there. Vertices run as the facet does.",
    size: "length, mm",
    measure: Measure::Length,
    shows: Shows::Line,
    follows: true,
    missing: None,
    find: |m| {
        m.each(&m.topology.boundary_edges, |e| {
            m.finding(vec![e.facet], e.vertices.to_vec(), m.distance(e.vertices))
        })
    },
};

//! Facets without area.

use super::{DefectKind, Measure, Severity, Shows};

pub(super) const KIND: DefectKind = DefectKind {
    name: "degenerate_facets",
    severity: Severity::Error,
    about: "Facets without area, decided exactly: with a repeated vertex, or with three different ones on one line.",
    size: "longest edge, mm",
    measure: Measure::Length,
    shows: Shows::Facets,
    follows: false,
    missing: None,
    find: |m| {
        let mut facets = [&m.topology.repeated_vertex[..], &m.topology.collinear].concat();
        facets.sort_unstable();
        m.each(&facets, |&f| {
            let [a, b, c] = m.mesh.faces[f as usize];
            let longest = [[a, b], [b, c], [c, a]].map(|e| m.distance(e)).into_iter().fold(0.0, f64::max);
            let different = 1 + usize::from(b != a) + usize::from(c != a && c != b);
            let mut finding = m.finding(vec![f], vec![], longest);
            finding.measures = vec![("different_vertices", different as f64)];
            finding
        })
    },
};

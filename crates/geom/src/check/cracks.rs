//! Chains of boundary edges that do not close.

use super::{DefectKind, Measure, Severity, Shows};

pub(super) const KIND: DefectKind = DefectKind {
    name: "cracks",
    severity: Severity::Error,
    about: "Chains of boundary edges that do not close to a ring: they end at edges with more than two facets. \
            Vertices go from end to end.",
    size: "length, mm",
    measure: Measure::Length,
    shows: Shows::Line,
    follows: false,
    missing: None,
    find: |m| {
        m.each(&m.boundary.chains, |chain| {
            let length = chain.windows(2).map(|p| m.distance([p[0], p[1]])).sum();
            let mut finding = m.finding(vec![], chain.clone(), length);
            finding.measures = vec![("edges", (chain.len() - 1) as f64)];
            finding
        })
    },
};

//! Facets that cross, touch or overlap.

use super::intersect::Crossings;
use super::{DefectKind, Finding, Found, Inspected, Measure, Severity, Shows};
use crate::space::Aabb;

pub(super) const KIND: DefectKind = DefectKind {
    name: "self_intersections",
    severity: Severity::Error,
    about: "Pairs of facets that meet anywhere else than in the vertices or the edge they share, decided exactly.",
    size: "diagonal of the box that the two have in common, mm",
    measure: Measure::Diagonal,
    shows: Shows::Facets,
    follows: false,
    missing: Some("not asked for"),
    find: |m| {
        let Crossings { count, at_least, first } = m.crossings?;
        let items = first.iter().map(|pair| crossing(m, *pair)).collect();
        Some(Found { count: *count, at_least: *at_least, items })
    },
};

fn crossing(m: &Inspected, pair: [u32; 2]) -> Finding {
    let mut finding = m.finding(pair.to_vec(), vec![], 0.0);
    let [a, b] = pair.map(|f| Aabb::of(&m.corners(f)));
    let common = Aabb {
        min: std::array::from_fn(|k| a.min[k].max(b.min[k])),
        max: std::array::from_fn(|k| a.max[k].min(b.max[k])),
    };
    finding.bounds = common;
    finding.position = std::array::from_fn(|k| common.min[k] / 2.0 + common.max[k] / 2.0);
    finding.size = common.diagonal();
    finding
}

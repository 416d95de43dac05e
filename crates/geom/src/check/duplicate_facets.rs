//! Facets that are there twice.

use super::finding::area;
use super::{DefectKind, Measure, Severity, Shows};

pub(super) const KIND: DefectKind = DefectKind {
    name: "duplicate_facets",
    severity: Severity::Error,
    about: "Facets with the same three vertices as an earlier one, in either orientation. Facets: the first, this one.",
    size: "area, mm²",
    measure: Measure::Area,
    shows: Shows::Facets,
    follows: false,
    missing: None,
    find: |m| m.each(&m.topology.duplicate_facets, |d| m.finding(d.to_vec(), vec![], area(m.corners(d[1])))),
};

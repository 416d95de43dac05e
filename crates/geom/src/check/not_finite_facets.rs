//! Facets at no place.

use super::{DefectKind, Finding, Measure, Severity, Shows};
use crate::space::Aabb;

pub(super) const KIND: DefectKind = DefectKind {
    name: "not_finite_facets",
    severity: Severity::Error,
    about: "Facets with a coordinate that is NaN or infinite. They are left out of everything else.",
    size: "always 0",
    measure: Measure::Length,
    shows: Shows::Facets,
    follows: false,
    missing: None,
    find: |m| {
        m.each(&m.topology.not_finite, |&f| {
            // There is no place to show: the middle of the whole stands in.
            let bounds = m.properties.bounds;
            let position = std::array::from_fn(|k| bounds.min[k] / 2.0 + bounds.max[k] / 2.0);
            Finding {
                facets: vec![f],
                vertices: vec![],
                position,
                bounds: Aabb::EMPTY,
                size: 0.0,
                measures: vec![],
            }
        })
    },
};

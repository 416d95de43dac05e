//! Normals in the file that contradict the order of the vertices.

use super::finding::area;
use super::{DefectKind, Measure, Severity, Shows};
use crate::parallel::prelude::*;
use crate::space::{cross, dot, minus};

pub(super) const KIND: DefectKind = DefectKind {
    name: "reversed_normals",
    severity: Severity::Warning,
    about: "Facets whose stored normal makes a right angle or more with the one that the order of their vertices gives. \
            A stored normal that is zero or not a number says nothing.",
    size: "area, mm²",
    measure: Measure::Area,
    shows: Shows::Facets,
    follows: false,
    missing: Some("the file stores no normals"),
    find: |m| {
        let stored = m.stored_normals?;
        let contradicts = |(face, normal): (&[u32; 3], &[f32; 3])| {
            let [a, b, c] = m.mesh.places(face);
            let computed = cross(minus(b, a), minus(c, a));
            let says = normal.iter().all(|x| x.is_finite()) && normal.iter().any(|x| *x != 0.0);
            says && computed != [0.0; 3] && dot(normal.map(f64::from), computed) <= 0.0
        };
        let facets = m.mesh.faces.par_iter().zip(stored).enumerate();
        let facets: Vec<u32> =
            facets.filter(|(_, facet)| contradicts(*facet)).map(|(f, _)| f as u32).collect();
        m.each(&facets, |&f| m.finding(vec![f], vec![], area(m.corners(f))))
    },
};

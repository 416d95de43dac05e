//! Normals in the file that contradict the order of the vertices.

use super::finding::area;
use super::{Kind, Severity};
use crate::space::{cross, dot, minus};

pub(super) const KIND: Kind = Kind {
    name: "reversed_normals",
    severity: Severity::Warning,
    about: "Facets whose stored normal makes a right angle or more with the one that the order of their vertices gives. \
            A stored normal that is zero or not a number says nothing.",
    size: "area, mm²",
    find: |m| {
        let stored = m.stored_normals?;
        let mut facets = vec![];
        for (f, (face, normal)) in (0..).zip(m.mesh.faces.iter().zip(stored)) {
            let [a, b, c] = face.map(|v| m.mesh.positions[v as usize]);
            let computed = cross(minus(b, a), minus(c, a));
            let says = normal.iter().all(|x| x.is_finite()) && normal.iter().any(|x| *x != 0.0);
            if says && computed != [0.0; 3] && dot(normal.map(f64::from), computed) <= 0.0 {
                facets.push(f);
            }
        }
        m.each(&facets, |&f| m.finding(vec![f], vec![], area(m.corners(f))))
    },
};

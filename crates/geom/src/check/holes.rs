//! Closed rings of boundary edges.

use super::{DefectKind, Finding, Inspected, Measure, Severity, Shows};
use crate::space::{cross, minus, norm, plus, times};

pub(super) const KIND: DefectKind = DefectKind {
    name: "holes",
    severity: Severity::Error,
    about: "Closed rings of boundary edges. Vertices go once round; a ring that touches itself is taken apart. \
            The area is that of the ring seen from where it looks largest.",
    size: "perimeter, mm",
    measure: Measure::Perimeter,
    shows: Shows::Ring,
    follows: false,
    missing: None,
    find: |m| m.each(&m.boundary.rings, |ring| hole(m, ring)),
};

fn hole(m: &Inspected, ring: &[u32]) -> Finding {
    let at = |i: usize| m.mesh.positions[ring[i % ring.len()] as usize];
    let from = at(0);
    let sides = (0..ring.len()).map(|i| m.distance([ring[i], ring[(i + 1) % ring.len()]]));
    let perimeter: f64 = sides.sum();
    let fan = (1..ring.len()).map(|i| cross(minus(at(i), from), minus(at(i + 1), from)));
    let area = 0.5 * norm(fan.fold([0.0; 3], plus));
    let mut finding = m.finding(vec![], ring.to_vec(), perimeter);
    let middle = times(1.0 / ring.len() as f64, (0..ring.len()).map(at).fold([0.0; 3], plus));
    finding.position = middle;
    finding.measures = vec![("edges", ring.len() as f64), ("perimeter", perimeter), ("area", area)];
    finding
}

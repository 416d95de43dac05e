//! Facets too thin to have a normal worth the name.

use super::{DefectKind, Inspected, Measure, Severity, Shows, spacing};
use crate::parallel::prelude::*;
use crate::space::{Point, cross, minus, norm};

pub(super) const KIND: DefectKind = DefectKind {
    name: "sliver_facets",
    severity: Severity::Warning,
    about: "Facets with an area, but a smaller angle than the one given, or lower than the spacing of the coordinates.",
    size: "height over the longest edge, mm",
    measure: Measure::Height,
    shows: Shows::Facets,
    follows: false,
    missing: None,
    find: |m| {
        let (sine, lowest) = (libm::sin(m.options.sliver_angle), spacing(&m.properties.bounds));
        let is_sliver = |f: usize| {
            let shape = Slenderness::of(m.corners(f as u32));
            shape.sine < sine || shape.height < lowest
        };
        let without_area = |f: u32| m.topology.collinear.binary_search(&f).is_ok();
        let facets: Vec<u32> = (0..m.mesh.faces.len())
            .into_par_iter()
            .filter(|&f| m.topology.shell_of[f] != u32::MAX && is_sliver(f) && !without_area(f as u32))
            .map(|f| f as u32)
            .collect();
        m.each(&facets, |&f| sliver(m, f))
    },
};

struct Slenderness {
    /// Sine of the smallest angle.
    sine: f64,
    height: f64,
}

impl Slenderness {
    fn of([a, b, c]: [Point; 3]) -> Slenderness {
        let twice_area = norm(cross(minus(b, a), minus(c, a)));
        let mut lengths = [minus(b, a), minus(c, b), minus(a, c)].map(norm);
        lengths.sort_unstable_by(f64::total_cmp);
        // The smallest angle lies between the two longer edges.
        Slenderness { sine: twice_area / (lengths[1] * lengths[2]), height: twice_area / lengths[2] }
    }
}

fn sliver(m: &Inspected, facet: u32) -> super::Finding {
    let shape = Slenderness::of(m.corners(facet));
    let mut finding = m.finding(vec![facet], vec![], shape.height);
    finding.measures = vec![("smallest_angle", libm::asin(shape.sine))];
    finding
}

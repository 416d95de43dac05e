//! Places of a nominal that determine its element.

use std::f64::consts::TAU;
use trueness_geom::feature::Nominal;
use trueness_geom::space::{Point, Vector, cross, dot, least_axis, minus, plus, times, unit};

/// Places around in a section.
const PLACES_PER_SECTION: u32 = 12;
/// Where the sections lie, as shares of the length: as far from one end as from the other, so that their middle is the feature's. A cone may
/// begin at its tip, where it has no section.
const SECTION_POSITIONS: [f64; 3] = [0.1, 0.5, 0.9];

/// Places of a nominal; none where it has a direction without length.
pub(super) fn places(nominal: &Nominal) -> Vec<Point> {
    match nominal {
        Nominal::Plane { point, normal, boundary } => {
            let Some((normal, _)) = unit(*normal) else { return vec![] };
            boundary.iter().map(|p| minus(*p, times(dot(minus(*p, *point), normal), normal))).collect()
        }
        Nominal::Cylinder { point, direction, radius, length } => {
            rings(*point, *direction, |share| (share * length, *radius))
        }
        Nominal::Cone { apex, direction, half_angle, between: [from, to] } => {
            let slope = libm::tan(*half_angle);
            rings(*apex, *direction, |share| {
                let along = from + share * (to - from);
                (along, along * slope)
            })
        }
        Nominal::Sphere { center, radius } => {
            let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let both = |d: Vector| [1.0, -1.0].map(|sign| plus(*center, times(sign * radius, d)));
            axes.into_iter().flat_map(both).collect()
        }
        Nominal::Edge { point, direction, length, .. } => {
            let Some((direction, _)) = unit(*direction) else { return vec![] };
            SECTION_POSITIONS.map(|share| plus(*point, times(share * length, direction))).to_vec()
        }
    }
}

/// Circles across an axis: how far along it, and their radii, by shares of the length.
fn rings(point: Point, direction: Vector, section: impl Fn(f64) -> (f64, f64)) -> Vec<Point> {
    let Some((z, _)) = unit(direction) else { return vec![] };
    let Some((x, _)) = unit(cross(z, least_axis(z))) else { return vec![] };
    let y = cross(z, x);
    let at = |share: f64, k: u32| {
        let (along, radius) = section(share);
        let angle = TAU * f64::from(k) / f64::from(PLACES_PER_SECTION);
        let out = plus(times(radius * libm::cos(angle), x), times(radius * libm::sin(angle), y));
        plus(point, plus(times(along, z), out))
    };
    SECTION_POSITIONS
        .into_iter()
        .flat_map(|share| (0..PLACES_PER_SECTION).map(move |k| (share, k)))
        .map(|(s, k)| at(s, k))
        .collect()
}

//! The rules that make a facet or a point part of a nominal feature.

use super::bounds::Polygon;
use super::{FeatureError, Nearness, Nominal};
use crate::rigid::Rigid;
use crate::space::{Aabb, Point, Vector, cross, dot, least_axis, minus, norm, plus, times, unit};

/// A nominal feature, ready to be asked.
pub(super) struct Rules<'a> {
    near: &'a Nearness,
    kind: CheckedNominal,
}

/// Share of the coordinates by which boxes are widened: far more than rounding takes.
const BOX_WIDENING: f64 = 1e-9;

enum CheckedNominal {
    Plane { point: Point, normal: Vector, boundary: Polygon },
    Cylinder { point: Point, direction: Vector, radius: f64, length: f64 },
    Cone { apex: Point, direction: Vector, half_angle: f64, between: [f64; 2] },
    Sphere { center: Point, radius: f64 },
    Edge { point: Point, direction: Vector, length: f64, normals: [Vector; 2] },
}

fn checked_direction(what: &'static str, v: Vector) -> Result<Vector, FeatureError> {
    if v.iter().any(|x| !x.is_finite()) {
        return Err(FeatureError::NotFinite);
    }
    unit(v).map(|u| u.0).ok_or(FeatureError::NoDirection { what })
}

fn checked_size(what: &'static str, value: f64) -> Result<f64, FeatureError> {
    match value {
        _ if !value.is_finite() => Err(FeatureError::NotFinite),
        _ if value > 0.0 => Ok(value),
        _ => Err(FeatureError::Size { what, value }),
    }
}

fn place(p: Point) -> Result<Point, FeatureError> {
    if p.iter().all(|x| x.is_finite()) { Ok(p) } else { Err(FeatureError::NotFinite) }
}

impl<'a> Rules<'a> {
    pub(super) fn new(nominal: &Nominal, near: &'a Nearness) -> Result<Rules<'a>, FeatureError> {
        let kind = match nominal {
            Nominal::Plane { point, normal, boundary } => {
                for corner in boundary {
                    place(*corner)?;
                }
                let normal = checked_direction("normal", *normal)?;
                let boundary = Polygon::new(*point, normal, boundary).ok_or(FeatureError::Boundary)?;
                CheckedNominal::Plane { point: place(*point)?, normal, boundary }
            }
            Nominal::Cylinder { point, direction, radius, length } => CheckedNominal::Cylinder {
                point: place(*point)?,
                direction: checked_direction("direction", *direction)?,
                radius: checked_size("radius", *radius)?,
                length: checked_size("length", *length)?,
            },
            Nominal::Cone { apex, direction, half_angle, between: [from, to] } => CheckedNominal::Cone {
                apex: place(*apex)?,
                direction: checked_direction("direction", *direction)?,
                half_angle: checked_size("half angle", *half_angle)?,
                between: [from.min(*to), checked_size("end", from.max(*to))?],
            },
            Nominal::Sphere { center, radius } => {
                CheckedNominal::Sphere { center: place(*center)?, radius: checked_size("radius", *radius)? }
            }
            Nominal::Edge { point, direction, length, normals: [a, b] } => CheckedNominal::Edge {
                point: place(*point)?,
                direction: checked_direction("direction", *direction)?,
                length: checked_size("length", *length)?,
                normals: [checked_direction("first normal", *a)?, checked_direction("second normal", *b)?],
            },
        };
        Ok(Rules { near, kind })
    }

    /// A box around all places near the feature and within its bounds.
    pub(super) fn bounds(&self) -> Aabb {
        let Nearness { distance, margin, .. } = *self.near;
        let beyond = (-margin).max(0.0);
        // Discs across an axis.
        let around = |discs: [(Point, f64); 2], axis: Vector| {
            let all = discs.map(|(center, radius)| {
                // Along an axis of its own a disc has no extent, however large it is.
                let across = axis.map(|d| (1.0 - d * d).max(0.0).sqrt());
                let reach = across.map(|share| if share > 0.0 { radius.max(0.0) * share } else { 0.0 });
                Aabb { min: minus(center, reach), max: plus(center, reach) }
            });
            all[0].union(&all[1])
        };
        let bounds = match &self.kind {
            CheckedNominal::Plane { normal, boundary, .. } => {
                let flat = Aabb::of(&boundary.around(beyond));
                // Across an axis along which the plane lies it has no extent, however far it reaches.
                let off = normal.map(|n| if n == 0.0 { 0.0 } else { distance * n.abs() });
                Aabb { min: minus(flat.min, off), max: plus(flat.max, off) }
            }
            CheckedNominal::Cylinder { point, direction, radius, length } => {
                let ends = [-beyond, length + beyond].map(|along| plus(*point, times(along, *direction)));
                around(ends.map(|end| (end, radius + distance)), *direction)
            }
            CheckedNominal::Cone { apex, direction, half_angle, between: [from, to] } => {
                let disc = |along: f64| {
                    let radius = (distance + along * libm::sin(*half_angle)) / libm::cos(*half_angle);
                    (plus(*apex, times(along, *direction)), radius)
                };
                around([from - beyond, to + beyond].map(disc), *direction)
            }
            CheckedNominal::Sphere { center, radius } => Aabb::of([center]).widened(radius + distance),
            CheckedNominal::Edge { point, direction, length, .. } => {
                let ends = [-beyond, length + beyond].map(|along| plus(*point, times(along, *direction)));
                around(ends.map(|end| (end, distance)), *direction)
            }
        };
        let greatest = bounds.min.iter().chain(&bounds.max).fold(0.0, |m: f64, x| m.max(x.abs()));
        bounds.widened(BOX_WIDENING * greatest)
    }

    /// Whether a facet with this unit normal belongs to the feature.
    pub(super) fn facet(&self, corners: [Point; 3], facing: Vector) -> bool {
        corners.iter().all(|p| self.point(*p)) && {
            let center = times(1.0 / 3.0, plus(corners[0], plus(corners[1], corners[2])));
            self.faces(center, facing, self.near.angle)
        }
    }

    /// Whether a place is near the feature and within its bounds.
    pub(super) fn point(&self, p: Point) -> bool {
        let Nearness { distance, margin, .. } = *self.near;
        let within = |x: f64, low: f64, high: f64| x >= low + margin && x <= high - margin;
        match &self.kind {
            CheckedNominal::Plane { point, normal, boundary } => {
                dot(minus(p, *point), *normal).abs() <= distance && boundary.holds(p, margin)
            }
            CheckedNominal::Cylinder { point, direction, radius, length } => {
                let (off, along) = polar(p, *point, *direction);
                (off - radius).abs() <= distance && within(along, 0.0, *length)
            }
            CheckedNominal::Cone { apex, direction, half_angle, between: [from, to] } => {
                let (off, along) = polar(p, *apex, *direction);
                let away = off * libm::cos(*half_angle) - along * libm::sin(*half_angle);
                away.abs() <= distance && within(along, *from, *to)
            }
            CheckedNominal::Sphere { center, radius } => (norm(minus(p, *center)) - radius).abs() <= distance,
            CheckedNominal::Edge { point, direction, length, .. } => {
                let (off, along) = polar(p, *point, *direction);
                off <= distance && within(along, 0.0, *length)
            }
        }
    }

    /// How far a place lies within the bounds of the feature, along it; below zero beyond them, infinite where it has none.
    pub(super) fn within(&self, p: Point) -> f64 {
        let between = |along: f64, low: f64, high: f64| (along - low).min(high - along);
        match &self.kind {
            CheckedNominal::Plane { boundary, .. } => boundary.within(p),
            CheckedNominal::Cylinder { point, direction, length, .. }
            | CheckedNominal::Edge { point, direction, length, .. } => {
                between(polar(p, *point, *direction).1, 0.0, *length)
            }
            CheckedNominal::Cone { apex, direction, half_angle, between: [from, to] } => {
                let (off, along) = polar(p, *apex, *direction);
                // Along the surface, from its foot there.
                let (sine, cosine) = (libm::sin(*half_angle), libm::cos(*half_angle));
                between(along * cosine + off * sine, from / cosine, to / cosine)
            }
            CheckedNominal::Sphere { .. } => f64::INFINITY,
        }
    }

    /// Whether a facet about `center` faces as the feature does there, within `angle`.
    fn faces(&self, center: Point, facing: Vector, angle: f64) -> bool {
        // Inwards in a bore, outwards on a boss.
        let round = |outward: Vector| match self.near.inward {
            Some(true) => -dot(outward, facing),
            Some(false) => dot(outward, facing),
            None => dot(outward, facing).abs(),
        };
        match &self.kind {
            CheckedNominal::Plane { normal, .. } => dot(*normal, facing) >= libm::cos(angle),
            CheckedNominal::Cylinder { point, direction, .. } => {
                across(center, *point, *direction).is_some_and(|radial| round(radial) >= libm::cos(angle))
            }
            CheckedNominal::Cone { apex, direction, half_angle, .. } => across(center, *apex, *direction)
                .is_some_and(|radial| {
                    let normal = minus(
                        times(libm::cos(*half_angle), radial),
                        times(libm::sin(*half_angle), *direction),
                    );
                    round(normal) >= libm::cos(angle)
                }),
            CheckedNominal::Sphere { center: middle, .. } => {
                unit(minus(center, *middle)).is_some_and(|(radial, _)| round(radial) >= libm::cos(angle))
            }
            CheckedNominal::Edge { direction, normals: [a, b], .. } => {
                // Between the two normals, turning about the edge.
                let turn = cross(*a, *b);
                let about = if dot(turn, *direction) < 0.0 { times(-1.0, *direction) } else { *direction };
                let sideways = dot(facing, *direction).abs() <= libm::sin(angle);
                let slack = libm::sin(angle.min(0.1));
                sideways && dot(cross(*a, facing), about) >= slack && dot(cross(facing, *b), about) >= slack
            }
        }
    }

    /// Places of the nominal feature to start from.
    pub(super) fn starts(&self) -> Vec<Point> {
        /// Places of a ring.
        const RING_PLACES: usize = 12;
        let about = |axis: Vector| -> [Vector; 2] {
            let frame = Rigid::into_frame([0.0; 3], axis, least_axis(axis)).unwrap_or(Rigid::IDENTITY);
            [frame.rotation()[0], frame.rotation()[1]]
        };
        let ring = |center: Point, axis: Vector, radius: f64| -> Vec<Point> {
            let [u, v] = about(axis);
            let at = |k: usize| {
                let phi = std::f64::consts::TAU * k as f64 / RING_PLACES as f64;
                plus(times(radius * libm::cos(phi), u), times(radius * libm::sin(phi), v))
            };
            (0..RING_PLACES).map(|k| plus(center, at(k))).collect()
        };
        /// Shares of the length at which rings lie, the middle first.
        const RING_LEVELS: [f64; 3] = [0.5, 0.2, 0.8];
        match &self.kind {
            CheckedNominal::Plane { boundary, .. } => boundary.places(),
            CheckedNominal::Cylinder { point, direction, radius, length } => RING_LEVELS
                .iter()
                .flat_map(|t| ring(plus(*point, times(t * length, *direction)), *direction, *radius))
                .collect(),
            CheckedNominal::Cone { apex, direction, half_angle, between: [from, to] } => RING_LEVELS
                .iter()
                .flat_map(|t| {
                    let z = from + t * (to - from);
                    ring(plus(*apex, times(z, *direction)), *direction, z * libm::tan(*half_angle))
                })
                .collect(),
            CheckedNominal::Sphere { center, radius } => [-0.8f64, -0.4, 0.0, 0.4, 0.8]
                .iter()
                .flat_map(|t| {
                    let axis = [0.0, 0.0, 1.0];
                    ring(plus(*center, times(t * radius, axis)), axis, radius * (1.0 - t * t).sqrt())
                })
                .collect(),
            CheckedNominal::Edge { point, direction, length, .. } => {
                (0..9).map(|k| plus(*point, times(length * (f64::from(k) + 0.5) / 9.0, *direction))).collect()
            }
        }
    }
}

/// Distance from an axis, and place along it.
fn polar(p: Point, point: Point, direction: Vector) -> (f64, f64) {
    let q = minus(p, point);
    (norm(cross(q, direction)), dot(q, direction))
}

/// Unit vector away from an axis.
fn across(p: Point, point: Point, direction: Vector) -> Option<Vector> {
    let q = minus(p, point);
    unit(minus(q, times(dot(q, direction), direction))).map(|u| u.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closest::tests::TestRandom;

    /// The box holds every place near a feature and within its bounds, and is not much larger than these.
    #[test]
    fn a_box_holds_what_is_near_a_feature() {
        let mut random = TestRandom(3);
        for k in 0..40 {
            let way = random.direction();
            let point = random.point(5.0);
            let [side, up] = {
                let frame = Rigid::into_frame([0.0; 3], way, least_axis(way)).unwrap();
                [frame.rotation()[0], frame.rotation()[1]]
            };
            let corner = |a: f64, b: f64| plus(point, plus(times(a, side), times(b, up)));
            let boundary = vec![corner(-2.0, -1.0), corner(3.0, -1.0), corner(0.0, 4.0)];
            let all = [
                Nominal::Plane { point, normal: way, boundary },
                Nominal::Cylinder { point, direction: way, radius: 1.5, length: 4.0 },
                Nominal::Cone { apex: point, direction: way, half_angle: 0.6, between: [1.0, 4.0] },
                Nominal::Sphere { center: point, radius: 2.0 },
                Nominal::Edge { point, direction: way, length: 4.0, normals: [side, up] },
            ];
            let margin = [-0.5, 0.0, 0.3][k % 3];
            let near = Nearness { distance: 0.4, angle: 0.2, margin, rim: true, inward: None };
            for nominal in &all {
                let rules = Rules::new(nominal, &near).unwrap();
                let bounds = rules.bounds();
                let places = (0..40_000).map(|_| plus(point, random.point(5.5)));
                let kept: Vec<Point> = places.filter(|p| rules.point(*p)).collect();
                assert!(kept.len() > 20 && kept.iter().all(|p| bounds.holds(p)), "{nominal:?}");
                let tight = Aabb::of(&kept).widened(3.0);
                assert!(
                    tight.holds(&bounds.min) && tight.holds(&bounds.max),
                    "{nominal:?} {bounds:?} {tight:?}"
                );
            }
        }
    }
}

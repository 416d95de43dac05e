//! Places and derivatives of surfaces.

use super::Jet;
use super::kinds::{Surface, SurfaceKind};
use crate::frame::Frame;
use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_geom::space::{Point, Vector, cross, dot, minus, plus, times, unit};
use trueness_geom::spline::surface::Nurbs;

impl Surface {
    /// The place at `u`, `v`; on a spline outside of its domain that of its nearest border.
    pub fn at(&self, u: f64, v: f64) -> Point {
        self.jet(u, v).place
    }

    /// Place, first and second derivatives. Those of an offset are NaN where its basis has no normal.
    pub fn jet(&self, u: f64, v: f64) -> Jet {
        match self {
            Surface::Plane(frame) => Jet {
                place: frame.place([u, v, 0.0]),
                first: [frame.axes[0], frame.axes[1]],
                second: [[0.0; 3]; 3],
            },
            Surface::Cylinder { frame, radius } => turned(frame, u, [*radius, v], [0.0, 1.0], [0.0; 2]),
            Surface::Cone { frame, radius, half_angle } => {
                let slope = libm::tan(*half_angle);
                turned(frame, u, [radius + v * slope, v], [slope, 1.0], [0.0; 2])
            }
            Surface::Sphere { frame, radius } => round(frame, u, v, 0.0, *radius),
            Surface::Torus { frame, major, minor } => round(frame, u, v, *major, *minor),
            Surface::Spline(nurbs) => spline(nurbs, u, v),
            Surface::Extrusion { curve, direction } => {
                let [place, first, second] = curve.derivatives(u);
                Jet {
                    place: plus(place, times(v, *direction)),
                    first: [first, *direction],
                    second: [second, [0.0; 3], [0.0; 3]],
                }
            }
            Surface::Revolution { curve, origin, axis } => {
                let [place, first, second] = curve.derivatives(v);
                let arm = minus(place, *origin);
                let (along, flat) = split(arm, *axis);
                let spin = |w: Vector| cross(*axis, w);
                let turn = |w: Vector| {
                    let (along, flat) = split(w, *axis);
                    plus(along, rotated(flat, spin(flat), u))
                };
                let across = rotated(spin(flat), times(-1.0, flat), u);
                let (_, rise) = split(first, *axis);
                Jet {
                    place: plus(*origin, plus(along, rotated(flat, spin(flat), u))),
                    first: [across, turn(first)],
                    second: [
                        rotated(times(-1.0, flat), times(-1.0, spin(flat)), u),
                        rotated(spin(rise), times(-1.0, rise), u),
                        turn(second),
                    ],
                }
            }
            Surface::Offset { basis, distance } => offset(basis, *distance, u, v),
        }
    }

    /// Unit normal `∂u × ∂v`; `None` where the derivatives span no plane, as at a pole.
    pub fn normal(&self, u: f64, v: f64) -> Option<Vector> {
        let [du, dv] = self.jet(u, v).first;
        unit(cross(du, dv)).map(|(n, _)| n)
    }

    /// First and last `u`, first and last `v`; infinite where the surface has no border.
    pub fn domain(&self) -> [[f64; 2]; 2] {
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        let turn = [0.0, TAU];
        match self {
            Surface::Plane(_) => [all, all],
            Surface::Cylinder { .. } | Surface::Cone { .. } => [turn, all],
            Surface::Sphere { .. } => [turn, [-FRAC_PI_2, FRAC_PI_2]],
            Surface::Torus { major, minor, .. } if major < minor => {
                let pole = libm::acos((-major / minor).clamp(-1.0, 1.0));
                [turn, [-pole, pole]]
            }
            Surface::Torus { .. } => [turn, turn],
            Surface::Spline(nurbs) => nurbs.knots().each_ref().map(|k| k.domain().into()),
            Surface::Extrusion { curve, .. } => [curve.domain(), all],
            Surface::Revolution { curve, .. } => [turn, curve.domain()],
            Surface::Offset { basis, .. } => basis.domain(),
        }
    }

    /// What it is.
    pub fn kind(&self) -> SurfaceKind {
        match self {
            Surface::Plane(_) => SurfaceKind::Plane,
            Surface::Cylinder { .. } => SurfaceKind::Cylinder,
            Surface::Cone { .. } => SurfaceKind::Cone,
            Surface::Sphere { .. } => SurfaceKind::Sphere,
            Surface::Torus { .. } => SurfaceKind::Torus,
            Surface::Spline(_) => SurfaceKind::Spline,
            Surface::Extrusion { .. } => SurfaceKind::Extrusion,
            Surface::Revolution { .. } => SurfaceKind::Revolution,
            Surface::Offset { .. } => SurfaceKind::Offset,
        }
    }
}

/// The parts of a vector along a unit vector and at right angles to it.
fn split(w: Vector, axis: Vector) -> (Vector, Vector) {
    let along = times(dot(w, axis), axis);
    (along, minus(w, along))
}

/// `a·cos u + b·sin u`.
fn rotated(a: Vector, b: Vector, u: f64) -> Vector {
    let (c, s) = (libm::cos(u), libm::sin(u));
    std::array::from_fn(|k| c * a[k] + s * b[k])
}

/// A profile of radius and height, turned by `u` about the third axis; with its derivatives by `v`.
fn turned(frame: &Frame, u: f64, [r, h]: [f64; 2], [r1, h1]: [f64; 2], [r2, h2]: [f64; 2]) -> Jet {
    let (c, s) = (libm::cos(u), libm::sin(u));
    Jet {
        place: frame.place([r * c, r * s, h]),
        first: [frame.vector([-r * s, r * c, 0.0]), frame.vector([r1 * c, r1 * s, h1])],
        second: [
            frame.vector([-r * c, -r * s, 0.0]),
            frame.vector([-r1 * s, r1 * c, 0.0]),
            frame.vector([r2 * c, r2 * s, h2]),
        ],
    }
}

/// A circle of radius `minor` whose center is `major` away from the axis, turned about it.
fn round(frame: &Frame, u: f64, v: f64, major: f64, minor: f64) -> Jet {
    let (c, s) = (minor * libm::cos(v), minor * libm::sin(v));
    turned(frame, u, [major + c, s], [-s, c], [-c, -s])
}

fn spline(nurbs: &Nurbs, u: f64, v: f64) -> Jet {
    let all = match nurbs {
        Nurbs::Plain(surface) => Some(surface.derivatives(u, v, 2)),
        Nurbs::Rational(surface) => surface.derivatives(u, v, 2),
    };
    let entry = |i: usize, j: usize| {
        all.as_ref().and_then(|rows| rows.get(i)?.get(j).copied()).unwrap_or([f64::NAN; 3])
    };
    Jet {
        place: entry(0, 0),
        first: [entry(1, 0), entry(0, 1)],
        second: [entry(2, 0), entry(1, 1), entry(0, 2)],
    }
}

/// Along the normal of another surface; its derivatives by those of the normal, up to the first order exactly, and the second
/// by differences of these.
fn offset(basis: &Surface, distance: f64, u: f64, v: f64) -> Jet {
    let first = |u: f64, v: f64| {
        let jet = basis.jet(u, v);
        let [du, dv] = jet.first;
        let [uu, uv, vv] = jet.second;
        let wide = cross(du, dv);
        let (n, length) = unit(wide).unwrap_or(([f64::NAN; 3], f64::NAN));
        // The derivative of a unit vector is at right angles to it.
        let slope = |wide: Vector| times(1.0 / length, split(wide, n).1);
        let by_u = slope(plus(cross(uu, dv), cross(du, uv)));
        let by_v = slope(plus(cross(uv, dv), cross(du, vv)));
        let along = |w: Vector, by: Vector| plus(w, times(distance, by));
        (along(jet.place, n), along(du, by_u), along(dv, by_v))
    };
    let (place, du, dv) = first(u, v);
    let step = OFFSET_STEP * (1.0 + u.abs().max(v.abs()));
    let difference = |a: Vector, b: Vector| times(0.5 / step, minus(a, b));
    let (right, left, above, below) =
        (first(u + step, v), first(u - step, v), first(u, v + step), first(u, v - step));
    let second = [difference(right.1, left.1), difference(above.1, below.1), difference(above.2, below.2)];
    Jet { place, first: [du, dv], second }
}

/// Step of the differences for second derivatives of an offset, of the size of the parameter: the third root of a rounding error.
const OFFSET_STEP: f64 = 6e-6;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Curve;
    use trueness_geom::space::norm;
    use trueness_geom::spline::basis::Knots;

    /// One of each kind.
    fn surfaces() -> Vec<Surface> {
        let frame = Frame::new([1.0, -2.0, 0.5], [0.3, 0.4, 1.0], Some([1.0, 0.2, 0.0])).unwrap();
        let knots = || Knots::uniform(2, 2, 0.0, 1.0);
        let points: Vec<_> = (0..16)
            .map(|k| ([f64::from(k / 4), f64::from(k % 4), f64::from(k * k % 7)], 1.0 + f64::from(k % 3)))
            .collect();
        let ellipse = Curve::Ellipse { frame, radii: [0.4, 1.1] };
        let torus = Surface::Torus { frame, major: 3.0, minor: 1.2 };
        vec![
            Surface::Plane(frame),
            Surface::Cylinder { frame, radius: 2.0 },
            Surface::Cone { frame, radius: 2.0, half_angle: -0.4 },
            Surface::Sphere { frame, radius: 1.5 },
            torus.clone(),
            Surface::Spline(Box::new(Nurbs::weighted([knots(), knots()], &points).unwrap())),
            Surface::Extrusion { curve: Box::new(ellipse.clone()), direction: [0.3, 0.1, 2.0] },
            Surface::Revolution { curve: Box::new(ellipse), origin: [9.0, 0.0, 1.0], axis: frame.axes[2] },
            Surface::Offset { basis: Box::new(torus), distance: -0.3 },
        ]
    }

    #[test]
    fn derivatives_are_those_of_the_places() {
        let step = 1e-5;
        for surface in surfaces() {
            for [u, v] in [[0.3, 0.2], [0.9, 0.7], [0.6, 0.11]] {
                let jet = surface.jet(u, v);
                let slope = |a: Vector, b: Vector| times(0.5 / step, minus(a, b));
                let (right, left) = (surface.jet(u + step, v), surface.jet(u - step, v));
                let (above, below) = (surface.jet(u, v + step), surface.jet(u, v - step));
                let pairs = [
                    (jet.first[0], slope(right.place, left.place)),
                    (jet.first[1], slope(above.place, below.place)),
                    (jet.second[0], slope(right.first[0], left.first[0])),
                    (jet.second[1], slope(above.first[0], below.first[0])),
                    (jet.second[2], slope(above.first[1], below.first[1])),
                ];
                for (own, difference) in pairs {
                    assert!(norm(minus(own, difference)) < 1e-6 * (1.0 + norm(own)), "{:?}", surface.kind());
                }
            }
        }
    }

    /// The spindle torus of radii 1 and 2 meets its axis at ±√3: there the apple and the lemon have their poles.
    #[test]
    fn parts_of_a_spindle_torus_end_on_the_axis() {
        let frame = Frame::new([0.0; 3], [0.0, 0.0, 1.0], Some([1.0, 0.0, 0.0])).unwrap();
        for (major, widest) in [(1.0, 3.0), (-1.0, 1.0)] {
            let surface = Surface::Torus { frame, major, minor: 2.0 };
            let [_, [from, to]] = surface.domain();
            for (v, z) in [(from, -3f64.sqrt()), (to, 3f64.sqrt())] {
                assert!(norm(minus(surface.at(0.7, v), [0.0, 0.0, z])) < 1e-15);
            }
            assert!(norm(minus(surface.at(0.0, 0.0), [widest, 0.0, 0.0])) < 1e-15);
            assert_eq!(surface.normal(0.0, 0.0), Some([1.0, 0.0, 0.0]));
        }
    }

    #[test]
    fn placed_surfaces_pass_through_placed_places() {
        let rows = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let at = crate::frame::Placement { rows, scale: 2.0, shift: [1.0, 5.0, -3.0] };
        for surface in surfaces() {
            let placed = surface.placed(&at);
            let [su, sv] = surface.parameter_scales(at.scale);
            for [u, v] in [[0.3, 0.2], [0.9, 0.7]] {
                let [a, b] = [at.point(surface.at(u, v)), placed.at(su * u, sv * v)];
                assert!(norm(minus(a, b)) < 1e-13, "{:?}", surface.kind());
                // The mirror turns the normal.
                let n = at.direction(surface.normal(u, v).unwrap());
                assert!(dot(n, placed.normal(su * u, sv * v).unwrap()) < -0.999_999, "{:?}", surface.kind());
            }
        }
    }
}

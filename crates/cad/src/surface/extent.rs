//! How far a part of a surface reaches, lines of equal parameters, and descents to a near place.

use super::foot::Foot;
use super::kinds::Surface;
use super::seams::iso_curve;
use crate::curve::{Curve, CurveFeet};
use crate::frame::{Frame, Placement};
use std::f64::consts::{PI, TAU};
use trueness_geom::space::{Aabb, Point, Vector, cross, dot, minus, norm, plus, times, unit};
use trueness_geom::spline::surface::{Direction, descend};

impl Surface {
    /// The place that a descent from these parameters comes to: the nearest one around. Parameters may leave the domain where they have a
    /// period, or the surface no border.
    pub fn foot_from(&self, p: Point, start: [f64; 2]) -> Foot {
        let (periods, own) = (self.periods(), self.domain());
        let is_spline = matches!(self, Surface::Spline(_));
        let domain = [0, 1].map(|k| match periods[k] {
            Some(_) if !is_spline => (f64::NEG_INFINITY, f64::INFINITY),
            _ => own[k].into(),
        });
        let (foot, _) = descend(|[u, v]| self.jet(u, v), domain, p, start);
        Foot { parameters: foot.parameters, place: foot.place, distance: foot.distance }
    }

    /// A box around the part between first and last `u`, first and last `v`: the smallest one for planes, quadrics, tori and extrusions.
    pub fn bounds(&self, [[u0, u1], [v0, v1]]: [[f64; 2]; 2]) -> Aabb {
        match self {
            Surface::Plane(frame) => {
                Aabb::of(&[[u0, v0], [u0, v1], [u1, v0], [u1, v1]].map(|[u, v]| frame.place([u, v, 0.0])))
            }
            Surface::Cylinder { frame, radius } => {
                turned(frame, [u0, u1], |g, z| range([v0, v1].map(|v| radius * g + v * z).into_iter()))
            }
            Surface::Cone { frame, radius, half_angle } => {
                let slope = libm::tan(*half_angle);
                turned(frame, [u0, u1], |g, z| {
                    range([v0, v1].map(|v| (radius + v * slope) * g + v * z).into_iter())
                })
            }
            Surface::Sphere { frame, radius } => turned(frame, [u0, u1], |g, z| {
                let [low, high] = wave([g, z], [v0, v1]);
                [radius * low, radius * high]
            }),
            Surface::Torus { frame, major, minor } => {
                turned(frame, [u0, u1], |g, z| wave([g, z], [v0, v1]).map(|w| major * g + minor * w))
            }
            Surface::Spline(nurbs) => {
                let part = nurbs.within([(u0, u1), (v0, v1)]);
                Aabb::of(&part.control_points().into_iter().map(|p| p.0).collect::<Vec<_>>())
            }
            Surface::Extrusion { curve, direction } => {
                let base = CurveFeet::new(curve, [u0, u1]).exact_bounds();
                let moved = |v: f64| Aabb {
                    min: plus(base.min, times(v, *direction)),
                    max: plus(base.max, times(v, *direction)),
                };
                moved(v0).union(&moved(v1))
            }
            Surface::Revolution { curve, origin, axis } => {
                revolved(curve, *origin, *axis, [[u0, u1], [v0, v1]])
            }
            Surface::Offset { basis, distance } => basis.bounds([[u0, u1], [v0, v1]]).widened(distance.abs()),
        }
    }

    /// The line along which parameter 0 (`u`) or 1 (`v`) has a value; its parameter is the other one. `None` for offsets, whose lines are
    /// no curve of a kind.
    pub fn iso_curve(&self, held: usize, at: f64) -> Option<Curve> {
        let line = |origin: Point, direction: Vector| Curve::Line { origin, direction };
        let (c, s) = (libm::cos(at), libm::sin(at));
        let around = |frame: &Frame, height: f64, radius: f64| {
            let [x, y, z] = frame.axes;
            let sense = if radius < 0.0 { -1.0 } else { 1.0 };
            let axes = [times(sense, x), times(sense, y), z];
            Curve::Circle {
                frame: Frame { origin: frame.place([0.0, 0.0, height]), axes },
                radius: radius.abs(),
            }
        };
        let meridian = |frame: &Frame, major: f64, radius: f64| {
            let way = frame.vector([c, s, 0.0]);
            let axes = [way, frame.axes[2], frame.vector([s, -c, 0.0])];
            Curve::Circle { frame: Frame { origin: plus(frame.origin, times(major, way)), axes }, radius }
        };
        Some(match (self, held) {
            (Surface::Plane(frame), 0) => line(frame.place([at, 0.0, 0.0]), frame.axes[1]),
            (Surface::Plane(frame), _) => line(frame.place([0.0, at, 0.0]), frame.axes[0]),
            (Surface::Cylinder { frame, radius }, 0) => {
                line(frame.place([radius * c, radius * s, 0.0]), frame.axes[2])
            }
            (Surface::Cylinder { frame, radius }, _) => around(frame, at, *radius),
            (Surface::Cone { frame, radius, half_angle }, 0) => {
                let slope = libm::tan(*half_angle);
                line(frame.place([radius * c, radius * s, 0.0]), frame.vector([slope * c, slope * s, 1.0]))
            }
            (Surface::Cone { frame, radius, half_angle }, _) => {
                around(frame, at, radius + at * libm::tan(*half_angle))
            }
            (Surface::Sphere { frame, radius }, 0) => meridian(frame, 0.0, *radius),
            (Surface::Sphere { frame, radius }, _) => around(frame, radius * s, radius * c),
            (Surface::Torus { frame, major, minor }, 0) => meridian(frame, *major, *minor),
            (Surface::Torus { frame, major, minor }, _) => around(frame, minor * s, major + minor * c),
            (Surface::Spline(nurbs), 0) => iso_curve(nurbs, Direction::U, at),
            (Surface::Spline(nurbs), _) => iso_curve(nurbs, Direction::V, at),
            (Surface::Extrusion { curve, direction }, 0) => line(curve.at(at), *direction),
            (Surface::Extrusion { curve, direction }, _) => {
                curve.placed(&Placement { shift: times(at, *direction), ..Placement::IDENTITY })
            }
            (Surface::Revolution { curve, origin, axis }, 0) => curve.placed(&turn(*origin, *axis, at)),
            (Surface::Revolution { curve, origin, axis }, _) => {
                let arm = minus(curve.at(at), *origin);
                let center = plus(*origin, times(dot(arm, *axis), *axis));
                let (way, radius) = unit(minus(curve.at(at), center))
                    .unwrap_or((trueness_geom::space::least_axis(*axis), 0.0));
                let frame = Frame { origin: center, axes: [way, cross(*axis, way), *axis] };
                Curve::Circle { frame, radius }
            }
            (Surface::Offset { .. }, _) => return None,
        })
    }
}

/// The rotation by an angle about an axis.
fn turn(origin: Point, axis: Vector, angle: f64) -> Placement {
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    let image = |v: Vector| {
        let along = times(dot(v, axis), axis);
        let flat = minus(v, along);
        plus(along, plus(times(c, flat), times(s, cross(axis, flat))))
    };
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(image);
    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| columns[j][i]));
    let about = Placement { rows, scale: 1.0, shift: [0.0; 3] };
    Placement { shift: minus(origin, about.vector(origin)), ..about }
}

/// Least and greatest of numbers.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// Least and greatest of `a·cos t + b·sin t` between two values of `t`.
fn wave([a, b]: [f64; 2], [from, to]: [f64; 2]) -> [f64; 2] {
    let at = |t: f64| a * libm::cos(t) + b * libm::sin(t);
    let [mut low, mut high] = range([from, to].map(at).into_iter());
    let (top, most) = (libm::atan2(b, a), libm::hypot(a, b));
    let holds = |t: f64| t + TAU * ((from - t) / TAU).ceil() <= to;
    if holds(top) {
        high = most;
    }
    if holds(top + PI) {
        low = -most;
    }
    [low, high]
}

/// The box of a profile turned between two angles: `of` says the range of a coordinate by what the radius and the height are multiplied with,
/// and is linear in the first.
fn turned(frame: &Frame, turn: [f64; 2], of: impl Fn(f64, f64) -> [f64; 2]) -> Aabb {
    let [x, y, z] = frame.axes;
    let sides = [0, 1, 2].map(|k| {
        let [low, high] = wave([x[k], y[k]], turn);
        range([low, high].into_iter().flat_map(|g| of(g, z[k]))).map(|s| frame.origin[k] + s)
    });
    Aabb { min: sides.map(|s| s[0]), max: sides.map(|s| s[1]) }
}

/// The box of a part of a turned curve: of all products of the ranges of its coordinates in the plane of the axis and across.
fn revolved(curve: &Curve, origin: Point, axis: Vector, [turn, part]: [[f64; 2]; 2]) -> Aabb {
    let feet = CurveFeet::new(curve, part);
    let far = feet.support().into_iter().map(|p| minus(p, origin));
    let flat = far.map(|arm| minus(arm, times(dot(arm, axis), axis)));
    let way = flat.reduce(|a, b| if norm(b) > norm(a) { b } else { a }).and_then(unit);
    let Some(frame) = Frame::new(origin, axis, way.map(|w| w.0)) else { return Aabb::EMPTY };
    let home = Frame { origin: [0.0; 3], axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };
    let own = CurveFeet::new(&curve.placed(&Placement::between(&frame, &home)), part).exact_bounds();
    let [x, y, z] = frame.axes;
    let products = |a: [f64; 2], b: [f64; 2]| range(a.into_iter().flat_map(|p| b.map(|q| p * q)));
    let sides = [0, 1, 2].map(|k| {
        let along = products([own.min[0], own.max[0]], wave([x[k], y[k]], turn));
        let across = products([own.min[1], own.max[1]], wave([y[k], -x[k]], turn));
        let height = products([own.min[2], own.max[2]], [z[k], z[k]]);
        [0, 1].map(|end| origin[k] + (along[end] + across[end] + height[end]))
    });
    Aabb { min: sides.map(|s| s[0]), max: sides.map(|s| s[1]) }
}

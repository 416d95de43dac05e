//! A fitted element as something to draw: a body, its rim and its axis.

use crate::Mark;
use std::f64::consts::TAU;
use trueness_document::fit::Extent;
use trueness_geom::mesh::Mesh;
use trueness_geom::shape::{Coordinate, Shape};
use trueness_geom::space::{Point, plus, times};

/// Steps of a full turn.
const STEPS_PER_TURN: f64 = 144.0;
/// Share of its length by which an axis reaches beyond the body.
const AXIS_OVERHANG: f64 = 0.1;

/// Body (empty for a curve) and lines of the part of `shape` that `extent` tells.
pub fn element(shape: &Shape, extent: &Extent) -> (Mesh, Mark) {
    let place = |u: f64, v: f64| place(shape, extent, u, v);
    let ([u0, u1], [v0, v1]) = (extent.u, extent.v);
    let full = u1 - u0 >= TAU;
    let steps = |[from, to]: [f64; 2]| {
        (((to - from) / TAU * STEPS_PER_TURN).ceil() as usize).clamp(1, STEPS_PER_TURN as usize)
    };
    let across = |v: f64, n: usize| -> Vec<Point> { between(extent.u, n).map(|u| place(u, v)).collect() };
    let up = |u: f64, n: usize| -> Vec<Point> { between(extent.v, n).map(|v| place(u, v)).collect() };
    let mut lines = Mark::default();
    let (n, m) = match shape.kind().coordinates() {
        [Coordinate::None, _] => {
            lines.add_line(&up(0.0, 1), false);
            return (Mesh::default(), lines);
        }
        [_, Coordinate::None] => {
            lines.add_line(&across(0.0, steps(extent.u)), false);
            return (Mesh::default(), lines);
        }
        kinds => {
            let steps = |k: usize, range| if kinds[k] == Coordinate::Length { 1 } else { steps(range) };
            (steps(0, extent.u), steps(1, extent.v))
        }
    };
    for v in [v0, v1] {
        lines.add_line(&across(v, n), false);
    }
    // Where there is no rim, four lines show how it is round.
    let sides: Vec<f64> =
        if full { (0..4).map(|k| u0 + f64::from(k) * TAU / 4.0).collect() } else { vec![u0, u1] };
    sides.into_iter().for_each(|u| lines.add_line(&up(u, m), false));
    let [round, along] = shape.kind().coordinates();
    if along == Coordinate::Latitude && v0 < 0.0 {
        lines.add_line(&across(0.0, n), false);
    }
    if (round, along) == (Coordinate::Turn, Coordinate::Length) {
        let more = AXIS_OVERHANG * (v1 - v0);
        let at = |v: f64| plus(extent.origin, times(v, extent.axes[2]));
        lines.add_line(&[at(v0 - more), at(v1 + more)], false);
    }
    (body(extent, n, m, place), lines)
}

/// A sheet of `n` × `m` squares over both coordinates.
fn body(extent: &Extent, n: usize, m: usize, place: impl Fn(f64, f64) -> Point) -> Mesh {
    let mut mesh = Mesh::default();
    for v in between(extent.v, m) {
        mesh.positions.extend(between(extent.u, n).map(|u| place(u, v)));
    }
    let at = |i: usize, j: usize| (j * (n + 1) + i) as u32;
    for (i, j) in (0..m).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        mesh.faces.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}

/// `n + 1` numbers from one end of a range to the other.
fn between([from, to]: [f64; 2], n: usize) -> impl Iterator<Item = f64> {
    (0..=n).map(move |i| from + (to - from) * i as f64 / n as f64)
}

fn place(shape: &Shape, extent: &Extent, u: f64, v: f64) -> Point {
    let [x, y, z] = shape.at([u, v]);
    let [a, b, w] = extent.axes;
    plus(extent.origin, plus(plus(times(x, a), times(y, b)), times(z, w)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_measure::fit::extent;

    /// Whatever is drawn of an element lies on the element.
    #[test]
    fn the_body_lies_on_the_shape() {
        let w = [0.6, 0.0, 0.8];
        let shapes = [
            Shape::Plane { point: [1.0, 2.0, 3.0], normal: w },
            Shape::Circle { center: [1.0, 2.0, 3.0], normal: w, radius: 4.0 },
            Shape::Cylinder { point: [1.0, 2.0, 3.0], direction: w, radius: 4.0 },
            Shape::Cone {
                apex: [1.0, 2.0, 3.0],
                direction: w,
                half_angle: 0.3,
                point: plus([1.0, 2.0, 3.0], times(10.0, w)),
                radius: 10.0 * 0.3f64.tan(),
            },
            Shape::Sphere { center: [1.0, 2.0, 3.0], radius: 4.0 },
            Shape::Torus { center: [1.0, 2.0, 3.0], direction: w, major_radius: 9.0, minor_radius: 2.0 },
            Shape::Ellipse2 {
                center: [1.0, 2.0, 0.0],
                direction: [0.8, 0.6, 0.0],
                major_radius: 5.0,
                minor_radius: 2.0,
            },
        ];
        let points: Vec<Point> = (0..500)
            .map(|i| f64::from(i) * 0.7)
            .map(|t| [8.0 * t.sin(), 9.0 * (1.3 * t).cos(), 7.0 * (0.4 * t).sin()])
            .collect();
        for shape in shapes {
            let (mesh, lines) = element(&shape, &extent(&shape, &points).unwrap());
            assert!(!lines.segments.is_empty());
            for p in &mesh.positions {
                assert!(shape.distance(*p).abs() < 1e-9, "{shape:?} {p:?}");
            }
            // The axis of a cylinder or cone is the last line.
            let rim = lines.segments.len()
                - usize::from(matches!(shape, Shape::Cylinder { .. } | Shape::Cone { .. }));
            for p in lines.segments[..rim].iter().flatten() {
                assert!(shape.distance(*p).abs() < 1e-9, "{shape:?} {p:?}");
            }
        }
    }
}

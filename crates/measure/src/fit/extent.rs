//! The part of an element that its points lie on.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_document::fit::Extent;
use trueness_geom::shape::{Coordinate, Shape, axes_along};
use trueness_geom::space::{Point, Vector, cross, dot, minus, plus, times, unit};

/// Cells of the circle in which points are looked for.
const CIRCLE_CELLS: usize = 360;
/// A gap of at most this angle is none.
const MAX_IGNORED_GAP: f64 = 20.0 * PI / 180.0;
/// A cap of a sphere that reaches this far below its equator is the whole.
const WHOLE_SPHERE_LATITUDE: f64 = -50.0 * PI / 180.0;

/// The extent of the points on a shape; `None` without points.
pub fn extent(shape: &Shape, points: &[Point]) -> Option<Extent> {
    let first = points.first()?;
    let (origin, axes) = frame(shape, points);
    let local = move |p: &Point| {
        let q = minus(*p, origin);
        shape.coordinates(axes.map(|a| dot(q, a)))
    };
    let all = |k: usize| points.iter().map(move |p| local(p)[k]);
    let of = |k: usize, coordinate: Coordinate| match coordinate {
        Coordinate::None => [0.0; 2],
        Coordinate::Length => range(all(k), local(first)[k]),
        Coordinate::Turn => arc(all(k), points.len()),
        Coordinate::Latitude => {
            let low = all(k).fold(FRAC_PI_2, f64::min);
            [if low < WHOLE_SPHERE_LATITUDE { -FRAC_PI_2 } else { low }, FRAC_PI_2]
        }
    };
    let [u, v] = shape.kind().coordinates();
    // A cap goes all round.
    let around = if v == Coordinate::Latitude { [0.0, TAU] } else { of(0, u) };
    Some(Extent { origin, axes, u: around, v: of(1, v) })
}

/// Where the element's coordinates are counted from: of a plane along the points, of a sphere from the equator under them.
fn frame(shape: &Shape, points: &[Point]) -> (Point, [Vector; 3]) {
    let (origin, axes) = shape.frame();
    match shape.kind().coordinates() {
        [Coordinate::Length, Coordinate::Length] => (origin, longest_first(axes, origin, points)),
        [_, Coordinate::Latitude] => {
            let middle = points.iter().fold([0.0; 3], |sum, p| plus(sum, minus(*p, origin)));
            (origin, unit(middle).map_or(axes, |(w, _)| axes_along(w)))
        }
        _ => (origin, axes),
    }
}

/// Turned about the last axis so that the points spread most along the first.
fn longest_first([a, b, w]: [Vector; 3], origin: Point, points: &[Point]) -> [Vector; 3] {
    let mut mean = [0.0; 2];
    let mut sums = [0.0; 3];
    for (n, p) in (1u32..).zip(points) {
        let q = minus(*p, origin);
        let (x, y) = (dot(q, a), dot(q, b));
        let old = mean;
        mean = [mean[0] + (x - mean[0]) / f64::from(n), mean[1] + (y - mean[1]) / f64::from(n)];
        sums[0] += (x - old[0]) * (x - mean[0]);
        sums[1] += (x - old[0]) * (y - mean[1]);
        sums[2] += (y - old[1]) * (y - mean[1]);
    }
    let angle = 0.5 * libm::atan2(2.0 * sums[1], sums[0] - sums[2]);
    let (sine, cosine) = libm::sincos(angle);
    let u = plus(times(cosine, a), times(sine, b));
    [u, cross(w, u), w]
}

fn range(values: impl Iterator<Item = f64>, first: f64) -> [f64; 2] {
    values.fold([first; 2], |[low, high], x| [low.min(x), high.max(x)])
}

/// From where to where angles reach, without the largest gap between them; a full turn where the gap is small, or no
/// wider than few points leave everywhere.
fn arc(angles: impl Iterator<Item = f64>, count: usize) -> [f64; 2] {
    let width = TAU / CIRCLE_CELLS as f64;
    let mut filled = [false; CIRCLE_CELLS];
    for a in angles.filter(|a| a.is_finite()) {
        filled[((a.rem_euclid(TAU) / width) as usize).min(CIRCLE_CELLS - 1)] = true;
    }
    // The longest run of empty cells, over the end of the circle too.
    let (mut longest, mut end, mut run) = (0, 0, 0);
    for i in 0..2 * CIRCLE_CELLS {
        run = if filled[i % CIRCLE_CELLS] { 0 } else { run + 1 };
        if run > longest && run < CIRCLE_CELLS {
            (longest, end) = (run, i);
        }
    }
    let gap = longest as f64 * width;
    if gap <= MAX_IGNORED_GAP.max(2.5 * TAU / count.max(1) as f64) {
        return [0.0, TAU];
    }
    let start = (((end + 1) % CIRCLE_CELLS) as f64) * width;
    [start, start + TAU - gap]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(degrees: std::ops::Range<u32>) -> Vec<Point> {
        let at = |d: u32| f64::from(d).to_radians();
        degrees.flat_map(|d| [-3.0, 7.0].map(|z| [5.0 * at(d).cos(), 5.0 * at(d).sin(), z])).collect()
    }

    #[test]
    fn a_cylinder_is_as_long_and_as_far_round_as_its_points() {
        let shape = Shape::Cylinder { point: [0.0; 3], direction: [0.0, 0.0, 1.0], radius: 5.0 };
        let part = extent(&shape, &turned(30..121)).unwrap();
        assert_eq!(part.v, [-3.0, 7.0]);
        assert!((part.u[1] - part.u[0] - 91f64.to_radians()).abs() < 1.5f64.to_radians(), "{part:?}");
        let full = extent(&shape, &turned(0..350)).unwrap();
        assert_eq!(full.u, [0.0, TAU]);
        // Where the arc begins is where the points begin, in the frame's own angle.
        let [a, b, _] = part.axes;
        let middle = 0.5 * (part.u[0] + part.u[1]);
        let place = plus(times(middle.cos(), a), times(middle.sin(), b));
        assert!((place[1].atan2(place[0]) - 75f64.to_radians()).abs() < 0.03, "{place:?}");
    }

    #[test]
    fn a_plane_lies_along_its_points() {
        let (s, c) = 0.4f64.sin_cos();
        let points: Vec<Point> = (0..40)
            .flat_map(|i| (0..10).map(move |j| (f64::from(i) - 20.0, f64::from(j))))
            .map(|(x, y)| [c * x - s * y, s * x + c * y, 1.0])
            .collect();
        let part =
            extent(&Shape::Plane { point: [0.0, 0.0, 1.0], normal: [0.0, 0.0, 1.0] }, &points).unwrap();
        assert!(
            (part.u[1] - part.u[0] - 39.0).abs() < 1e-9 && (part.v[1] - part.v[0] - 9.0).abs() < 1e-9,
            "{part:?}"
        );
    }

    #[test]
    fn a_cap_and_a_whole_sphere() {
        let sphere = Shape::Sphere { center: [1.0, 2.0, 3.0], radius: 2.0 };
        let ring = |z: f64| {
            (0..36).map(move |i| {
                let (s, c) = (f64::from(i) * 10f64.to_radians()).sin_cos();
                let r = (4.0 - z * z).sqrt();
                [1.0 + z, 2.0 + r * c, 3.0 + r * s]
            })
        };
        let cap: Vec<Point> = ring(1.0).chain(ring(1.5)).collect();
        let part = extent(&sphere, &cap).unwrap();
        assert!(
            (part.axes[2][0] - 1.0).abs() < 1e-12 && (part.v[0] - 0.5f64.asin()).abs() < 1e-12,
            "{part:?}"
        );
        let whole: Vec<Point> = ring(1.9).chain(ring(-1.8)).collect();
        assert_eq!(extent(&sphere, &whole).unwrap().v, [-FRAC_PI_2, FRAC_PI_2]);
    }

    #[test]
    fn few_points_all_round_make_a_full_turn() {
        let points: Vec<Point> =
            (0..5).map(|i| f64::from(i) * TAU / 5.0).map(|a| [a.cos(), a.sin(), 0.0]).collect();
        let circle = Shape::Circle2 { center: [0.0; 3], radius: 1.0 };
        assert_eq!(extent(&circle, &points).unwrap().u, [0.0, TAU]);
    }
}

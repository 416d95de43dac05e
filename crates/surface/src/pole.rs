//! The axis of a sphere whose poles lie far from the points.
//!
//! At a pole the parameters of a sphere crowd, and a surface over them is torn or creased. The two poles of the axis
//! sought are farthest from all points. Among all unit vectors `z` it has the least greatest `|z ·
//! d|` over the directions `d` of the points. That greatest value is the half width of the convex hull of all
//! `±d` along `z`. The least of all widths is across a facet, so it is the hull's facet nearest to the center. A
//! stereographic projection from one of the directions takes circles to circles. In it those facets are the triangles
//! of Delaunay between the others, and the sides of their hull.

use spade::{DelaunayTriangulation, Point2, Triangulation};
use trueness_geom::space::{Point, Vector, cross, dot, least_axis, minus, norm, plus, times, unit};

/// Up to so many directions all are looked at; else one for each cell is (0.2°).
const MAX_DIRECTIONS: usize = 50_000;
/// Width of those cells.
const DIRECTION_CELL: f64 = 1.0 / 256.0;
/// Facets along whose normals the width is taken at most.
const MAX_WIDTHS: usize = 1000;
/// Directions nearer than this to another one or its opposite are that one: so near, the rounding of the projection tells their
/// circles.
const SAME_DIRECTION: f64 = 1e-9;

/// The unit vector along the axis whose poles are farthest from all points, seen from the center; `None` if the directions do not
/// determine one.
pub(super) fn axis(points: &[Point], center: Point) -> Option<Vector> {
    let directions = directions(points, center);
    let first = *directions.first()?;
    // All directions and their opposites but the one that is seen from.
    let (x, _) = unit(cross(least_axis(first), first))?;
    let y = cross(first, x);
    let mut seen = DelaunayTriangulation::<Point2<f64>>::new();
    let mut places = vec![];
    for d in directions.iter().flat_map(|d| [*d, times(-1.0, *d)]) {
        // 1 − d · first without a difference of near numbers.
        let away = minus(d, first);
        let depth = 0.5 * dot(away, away);
        if depth > SAME_DIRECTION * SAME_DIRECTION {
            places.push(Point2::new(dot(d, x) / depth, dot(d, y) / depth));
        }
    }
    if places.len() > 2 {
        seen = DelaunayTriangulation::bulk_load_stable(places).ok()?;
    }
    let back = |p: Point2<f64>| {
        // The direction with this projection.
        let square = p.x * p.x + p.y * p.y;
        let by = 2.0 / (1.0 + square);
        let up = 1.0 - by;
        plus(times(by * p.x, x), plus(times(by * p.y, y), times(up, first)))
    };
    let mut facets: Vec<(f64, Vector)> = vec![];
    let mut facet = |a: Vector, b: Vector, c: Vector| {
        if let Some((normal, _)) = unit(cross(minus(b, a), minus(c, a))) {
            facets.push((dot(normal, a).abs(), normal));
        }
    };
    for face in seen.inner_faces() {
        let [a, b, c] = face.vertices().map(|v| back(v.position()));
        facet(a, b, c);
    }
    for edge in seen.convex_hull() {
        let [a, b] = edge.positions().map(back);
        facet(a, b, first);
    }
    let normal = nearest(facets, &directions)?;
    let largest = normal.into_iter().fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
    Some(times(largest.signum(), normal))
}

/// The normal of the facet nearest to the center. A needle may have any normal, so that the width is taken along it: it is never less than
/// that of a true facet.
fn nearest(mut facets: Vec<(f64, Vector)>, directions: &[Vector]) -> Option<Vector> {
    facets.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(order(&a.1, &b.1)));
    let mut best: Option<(f64, Vector)> = None;
    for (offset, normal) in facets.into_iter().take(MAX_WIDTHS) {
        if best.is_some_and(|(least, _)| offset >= least) {
            break;
        }
        let width = directions.iter().map(|d| dot(*d, normal).abs()).fold(0.0, f64::max);
        if best.is_none_or(|(least, _)| width < least) {
            best = Some((width, normal));
        }
    }
    best.map(|b| b.1)
}

fn order(a: &Vector, b: &Vector) -> std::cmp::Ordering {
    (0..3).fold(std::cmp::Ordering::Equal, |found, k| found.then(a[k].total_cmp(&b[k])))
}

/// Directions of the points from the center, none twice, in an order of their own.
fn directions(points: &[Point], center: Point) -> Vec<Vector> {
    let mut all: Vec<Vector> = points.iter().filter_map(|p| unit(minus(*p, center)).map(|d| d.0)).collect();
    all.sort_unstable_by(order);
    if all.len() > MAX_DIRECTIONS {
        let cell = |d: &Vector| d.map(|x| (x / DIRECTION_CELL).round() as i32);
        all.sort_by_key(cell);
        all.dedup_by_key(|d| cell(d));
    }
    all.dedup_by(|a, b| norm(minus(*a, *b)) <= SAME_DIRECTION);
    all
}

//! Surfaces without area, and edges without length.

use super::{Direction, Nurbs};
use crate::space::{Aabb, Point, cross, minus, norm, unit};
use std::fmt;

/// The defect of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Degenerate {
    /// All control points lie at one place.
    Place,
    /// All control points lie on one line.
    Line,
    /// Control points coincide along a direction: the surface is a curve.
    Curve(Direction),
    /// The first, or the last, line of a direction is a single place, as a pole is.
    Edge(Direction, bool),
}

/// Share of the coordinates below which a size is that of their rounding: twelve digits are written.
const NO_SIZE_DIGITS: f64 = 1e-12;
/// Share of the size below which control points lie at one place or on one line: coordinates written with ten digits are
/// rounded so far.
const SAME_POINT_SHARE: f64 = 1e-9;

impl Nurbs {
    /// The defects of the surface: none of a sound one, one entry where it has no area. Else there is one for each edge that is
    /// a single place.
    ///
    /// ```
    /// use trueness_geom::spline::{basis::Knots, surface::{Degenerate, Direction, Nurbs}};
    /// let knots = || Knots::uniform(1, 1, 0.0, 1.0);
    /// let triangle = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0]];
    /// let found = Nurbs::weighted([knots(), knots()], &triangle.map(|p| (p, 1.0))).unwrap().degenerate();
    /// assert_eq!(found, [Degenerate::Edge(Direction::U, false)]);
    /// ```
    pub fn degenerate(&self) -> Vec<Degenerate> {
        let points: Vec<Point> = self.control_points().iter().map(|p| p.0).collect();
        let (bounds, [m, n]) = (Aabb::of(&points), self.counts());
        let greatest = bounds.min.iter().chain(&bounds.max).fold(0.0, |g: f64, x| g.max(x.abs()));
        let size = bounds.diagonal();
        if size <= NO_SIZE_DIGITS * greatest {
            return vec![Degenerate::Place];
        }
        let near = SAME_POINT_SHARE * size;
        let far = points.iter().map(|p| minus(*p, points[0]));
        let far = far.reduce(|a, b| if norm(b) > norm(a) { b } else { a });
        if let Some((along, _)) = far.and_then(unit)
            && points.iter().all(|p| norm(cross(minus(*p, points[0]), along)) <= near)
        {
            return vec![Degenerate::Line];
        }
        let same = |a: usize, b: usize| norm(minus(points[a], points[b])) <= near;
        let line = |k: usize, at: usize, i: usize| if k == 0 { at * n + i } else { i * n + at };
        let is_place = |k: usize, at: usize| (0..[n, m][k]).all(|i| same(line(k, at, i), line(k, at, 0)));
        let directions = [Direction::U, Direction::V];
        for k in 0..2 {
            if (0..[m, n][k]).all(|at| is_place(k, at)) {
                return vec![Degenerate::Curve(directions[1 - k])];
            }
        }
        let edges = directions.into_iter().flat_map(|d| [(d, false), (d, true)]);
        let is_edge = |(d, last): &(Direction, bool)| {
            let k = *d as usize;
            is_place(k, if *last { [m, n][k] - 1 } else { 0 })
        };
        edges.filter(is_edge).map(|(d, last)| Degenerate::Edge(d, last)).collect()
    }
}

impl fmt::Display for Degenerate {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let name = |d: &Direction| match d {
            Direction::U => "u",
            Direction::V => "v",
        };
        let no_area = "it has no area and no normal, and deviations from it are distances without a sign";
        match self {
            Degenerate::Place => write!(f, "all its control points lie at one place: {no_area}"),
            Degenerate::Line => write!(f, "all its control points lie on one line: {no_area}"),
            Degenerate::Curve(d) => write!(f, "its control points coincide along {}: {no_area}", name(d)),
            Degenerate::Edge(d, last) => write!(
                f,
                "its edge at the {} of {} is a single place, where it has no normal of its own",
                if *last { "end" } else { "start" },
                name(d)
            ),
        }
    }
}

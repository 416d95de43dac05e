//! The place of a surface nearest to a point.

use super::patches::Jet;
use super::{Patches, Surface};
use crate::space::{Aabb, Point, Vector, cross, dot, minus, norm, unit};

/// The place of a surface nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceFoot {
    /// Its parameters.
    pub parameters: [f64; 2],
    /// The place.
    pub place: Point,
    /// Its distance from the point.
    pub distance: f64,
    /// Unit normal there: the derivative by `u` times that by `v`. `None` where they span no plane.
    pub normal: Option<Vector>,
    /// Whether the difference stands at right angles to the surface, or the place lies on the edge with the point outside of it.
    pub settled: bool,
}

impl SurfaceFoot {
    /// The distance, positive on the side that the normal points to; without a normal, without a sign.
    pub fn signed(&self, point: Point) -> f64 {
        let side = self.normal.map_or(1.0, |n| dot(n, minus(point, self.place)));
        if side < 0.0 { -self.distance } else { self.distance }
    }
}

/// Most steps of Newton's method.
const MAX_NEWTON_STEPS: usize = 30;
/// Length of a step, relative to the place, after which the next one is rounding.
const LAST_STEP_SHARE: f64 = 1e-9;

impl Patches {
    /// The place nearest to `point` that a descent from the parameters `start` comes to.
    ///
    /// Newton's method on the squared distance, kept within the domain. Where the distance is not convex, the method of Gauss
    /// and Newton takes its place. Steps that do not lead nearer are halved. Cost: some evaluations.
    pub fn foot_from(&self, point: Point, start: [f64; 2]) -> SurfaceFoot {
        descend(|at| self.jet(at[0], at[1]), self.domain(), point, start).0
    }
}

/// [`Patches::foot_from`] on any surface that has derivatives, and what it is like there. The domain may be infinite.
#[inline]
pub fn descend(
    jet_at: impl Fn([f64; 2]) -> Jet,
    domain: [(f64, f64); 2],
    point: Point,
    start: [f64; 2],
) -> (SurfaceFoot, Jet) {
    let clamp = |p: [f64; 2]| [p[0].clamp(domain[0].0, domain[0].1), p[1].clamp(domain[1].0, domain[1].1)];
    let mut at = clamp(start);
    let mut jet = jet_at(at);
    let mut away = minus(jet.place, point);
    let mut square = dot(away, away);
    let mut settled = false;
    for _ in 0..MAX_NEWTON_STEPS {
        let (step, newton) = step(&jet, away, at, domain);
        let scale = [norm(jet.first[0]), norm(jet.first[1])];
        // A move below the rounding of the place itself.
        let rounding = 4.0 * f64::EPSILON * (norm(jet.place) + norm(away));
        let mut factor = 1.0;
        let mut next = None;
        while factor > 1e-6 {
            let tried = clamp([at[0] + factor * step[0], at[1] + factor * step[1]]);
            let moved = ((tried[0] - at[0]) * scale[0]).abs().max(((tried[1] - at[1]) * scale[1]).abs());
            if moved <= rounding {
                settled = true;
                break;
            }
            let new = jet_at(tried);
            let to = minus(new.place, point);
            // A step of Newton's that moves so little has one of its square after it: it is the last one.
            let last = newton && factor == 1.0 && moved <= LAST_STEP_SHARE * (norm(jet.place) + norm(away));
            if last && dot(to, to) <= square * (1.0 + 1e-9) {
                (at, jet, away) = (tried, new, to);
                square = dot(away, away);
                settled = true;
                break;
            }
            if dot(to, to) < square {
                next = Some((tried, new, to));
                break;
            }
            factor *= 0.25;
        }
        let Some((tried, new, to)) = next else { break };
        (at, jet, away) = (tried, new, to);
        square = dot(away, away);
    }
    let foot = SurfaceFoot {
        parameters: at,
        place: jet.place,
        distance: square.sqrt(),
        normal: unit(cross(jet.first[0], jet.first[1])).map(|(n, _)| n),
        settled,
    };
    (foot, jet)
}

/// The step to the least of a quadratic model, and whether the model is Newton's. It goes along an edge of the domain where it
/// would leave it there.
fn step(jet: &Jet, away: Vector, at: [f64; 2], domain: [(f64, f64); 2]) -> ([f64; 2], bool) {
    let [su, sv] = jet.first;
    let gradient = [dot(away, su), dot(away, sv)];
    let gauss = [dot(su, su), dot(su, sv), dot(sv, sv)];
    let newton: [f64; 3] = std::array::from_fn(|k| gauss[k] + dot(away, jet.second[k]));
    let convex =
        newton[0] > 0.0 && newton[0] * newton[2] - newton[1] * newton[1] > 1e-6 * newton[0] * newton[2].abs();
    let [a, b, c] = if convex { newton } else { gauss };
    let held = |k: usize| {
        let (from, to) = domain[k];
        at[k] <= from && gradient[k] > 0.0 || at[k] >= to && gradient[k] < 0.0
    };
    let single = |g: f64, curvature: f64, fallback: f64| {
        let by = if curvature > 0.0 { curvature } else { fallback };
        if by > 0.0 { -g / by } else { 0.0 }
    };
    let found = match (held(0), held(1)) {
        (true, true) => [0.0, 0.0],
        (true, false) => [0.0, single(gradient[1], newton[2], gauss[2])],
        (false, true) => [single(gradient[0], newton[0], gauss[0]), 0.0],
        (false, false) => {
            let determinant = a * c - b * b;
            if determinant > 1e-14 * a * c {
                let found = [
                    (b * gradient[1] - c * gradient[0]) / determinant,
                    (b * gradient[0] - a * gradient[1]) / determinant,
                ];
                let leaves = |k: usize| {
                    (at[k] <= domain[k].0 && found[k] < 0.0) || (at[k] >= domain[k].1 && found[k] > 0.0)
                };
                // On an edge that the common step leaves, the other parameter has a step of its own.
                match (leaves(0), leaves(1)) {
                    (true, _) => [0.0, single(gradient[1], newton[2], gauss[2])],
                    (_, true) => [single(gradient[0], newton[0], gauss[0]), 0.0],
                    _ => found,
                }
            } else {
                [single(gradient[0], gauss[0], 1.0), single(gradient[1], gauss[2], 1.0)]
            }
        }
    };
    (found, convex)
}

/// A part of a surface over which all control points are known.
struct Cell {
    bound: f64,
    surface: Surface<Point>,
    depth: u32,
}

/// How often a cell is cut in four before its starts are trusted.
const MAX_CELL_DEPTH: u32 = 3;

impl Surface<Point> {
    /// The place nearest to `point`.
    ///
    /// The surface lies within the box of its control points, also part by part. Parts are cut in four, three times over, and
    /// those whose box is no nearer than the best place are left out. In the others Newton's method starts from the middle and
    /// the corners. Places equally far may be taken for one another. Cost: some hundred evaluations for each part that is near;
    /// for many points near the surface take [`Patches::foot_from`].
    pub fn closest(&self, point: Point) -> SurfaceFoot {
        let patches = Patches::new(self);
        let [(u0, u1), (v0, v1)] = self.domain();
        let mut best = patches.foot_from(point, [0.5 * (u0 + u1), 0.5 * (v0 + v1)]);
        let mut stack: Vec<Cell> = self.beziers().into_iter().map(|s| Cell::new(s, point, 0)).collect();
        // The nearest box is looked at first: it lies last.
        stack.sort_by(|a, b| b.bound.total_cmp(&a.bound));
        while let Some(cell) = stack.pop() {
            if cell.bound >= best.distance {
                continue;
            }
            let [(a, b), (c, d)] = cell.surface.domain();
            let starts = [[0.5 * (a + b), 0.5 * (c + d)], [a, c], [a, d], [b, c], [b, d]];
            let starts = if cell.depth == MAX_CELL_DEPTH { &starts[..] } else { &starts[..1] };
            for start in starts {
                let found = patches.foot_from(point, *start);
                if found.distance < best.distance {
                    best = found;
                }
            }
            if cell.depth < MAX_CELL_DEPTH {
                let mut parts: Vec<Cell> = cell
                    .surface
                    .quarters()
                    .into_iter()
                    .map(|s| Cell::new(s, point, cell.depth + 1))
                    .collect();
                parts.sort_by(|a, b| b.bound.total_cmp(&a.bound));
                stack.extend(parts);
            }
        }
        best
    }

    /// The surface in parts of one span each.
    fn beziers(&self) -> Vec<Surface<Point>> {
        let inner = |k: usize| {
            let all = self.knots()[k].distinct();
            all[1..all.len() - 1].to_vec()
        };
        let cut = |whole: Surface<Point>, direction, at: &[f64]| {
            let mut rest = whole;
            let mut parts = vec![];
            for t in at {
                if let Ok([a, b]) = rest.split(direction, *t) {
                    parts.push(a);
                    rest = b;
                }
            }
            parts.push(rest);
            parts
        };
        let rows = cut(self.clone(), super::Direction::U, &inner(0));
        rows.into_iter().flat_map(|row| cut(row, super::Direction::V, &inner(1))).collect()
    }

    /// The surface cut in the middle of both directions.
    fn quarters(&self) -> Vec<Surface<Point>> {
        let [(a, b), (c, d)] = self.domain();
        let halves = self.split(super::Direction::U, 0.5 * (a + b)).map_or(vec![], Vec::from);
        halves
            .iter()
            .flat_map(|h| h.split(super::Direction::V, 0.5 * (c + d)).map_or(vec![], Vec::from))
            .collect()
    }
}

impl Cell {
    fn new(surface: Surface<Point>, point: Point, depth: u32) -> Cell {
        let hull = Aabb::of(surface.points());
        let away: Vector =
            std::array::from_fn(|k| (hull.min[k] - point[k]).max(point[k] - hull.max[k]).max(0.0));
        Cell { bound: norm(away), surface, depth }
    }
}

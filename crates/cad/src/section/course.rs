//! The section of a surface as a cubic spline.
//!
//! A piece has the places and tangents of the section at its ends; its handles are those of a circle with these tangents. It is halved until
//! some of its places lie within the tolerance, measured to the section itself.

use crate::curve::{Curve, Span};
use crate::trim::Trim;
use trueness_geom::plane::Plane;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::Curve as Spline;

/// What a curve is followed by.
pub struct Course<'a> {
    pub trim: &'a Trim,
    pub plane: &'a Plane,
    /// How far a cubic may lie from the section, millimeters.
    pub within: f64,
    /// Places nearer than that are one.
    pub same: f64,
}

/// A place of the section.
#[derive(Clone, Copy)]
struct Node {
    at: [f64; 2],
    place: Point,
    /// Unit vector; its sense is arbitrary.
    tangent: Vector,
}

/// Steps of Newton's method at most.
const MAX_STEPS_ON_COURSE: usize = 20;
/// Halvings between two places at most.
const MAX_HALVINGS_OF_COURSE: usize = 16;
/// Cosine of the greatest angle between the tangents of a piece.
const MIN_TURN_COSINE: f64 = 0.5;
/// The way along a piece over its chord at most; that of a circle by the angle above is 1.05.
const MAX_DETOUR: f64 = 1.2;
/// Shares of the way along a piece where it is measured.
const MEASURED_SHARES: [f64; 5] = [0.15, 0.35, 0.5, 0.65, 0.85];

impl Course<'_> {
    /// The spline from the first place to the last, through those between; `None` where no two of them are on the section.
    pub fn span(&self, places: &[Point]) -> Option<Span> {
        let mut nodes: Vec<Node> = vec![];
        for place in places {
            let near = nodes.last().map(|n| n.at);
            let Some(node) = self.node(self.trim.chart.parameters(*place, near)) else { continue };
            if nodes.last().is_none_or(|last| norm(minus(node.place, last.place)) > self.same) {
                nodes.push(node);
            }
        }
        if nodes.len() < 2 {
            return None;
        }
        let steps = nodes.windows(2).map(|w| norm(minus(w[1].place, w[0].place)));
        let ways: Vec<f64> = std::iter::once(0.0)
            .chain(steps.scan(0.0, |sum, step| {
                *sum += step;
                Some(*sum)
            }))
            .collect();
        let mut controls = vec![nodes[0].place];
        let mut knots = vec![0.0];
        let mut open = vec![(0, nodes.len() - 1)];
        while let Some((i, j)) = open.pop() {
            if let Some(cubic) = self.piece(&nodes[i], &nodes[j], ways[j] - ways[i]) {
                add(cubic, &mut controls, &mut knots);
            } else if j > i + 1 {
                let middle = usize::midpoint(i, j);
                open.extend([(middle, j), (i, middle)]);
            } else {
                self.halved(&nodes[i], &nodes[j], MAX_HALVINGS_OF_COURSE, &mut controls, &mut knots);
            }
        }
        let last = knots[knots.len() - 1];
        let inner: Vec<f64> =
            knots[1..knots.len() - 1].iter().flat_map(|t| std::iter::repeat_n(*t, 3)).collect();
        let knots = Knots::clamped(3, 0.0, &inner, last).ok()?;
        let spline = Spline::new(knots, controls).ok()?;
        Some(Span { curve: Curve::Spline(spline), range: [0.0, last] })
    }

    /// Pieces between two places with none between.
    fn halved(&self, a: &Node, b: &Node, depth: usize, controls: &mut Vec<Point>, knots: &mut Vec<f64>) {
        if let Some(cubic) = self.piece(a, b, 0.0) {
            return add(cubic, controls, knots);
        }
        match self.between(a, b).filter(|_| depth > 0) {
            Some(middle) => {
                self.halved(a, &middle, depth - 1, controls, knots);
                self.halved(&middle, b, depth - 1, controls, knots);
            }
            None => add(straight(a, b), controls, knots),
        }
    }

    /// A place about halfway between two.
    fn between(&self, a: &Node, b: &Node) -> Option<Node> {
        let node = self.node([0, 1].map(|k| 0.5 * (a.at[k] + b.at[k])))?;
        let [way, arm] = [minus(b.place, a.place), minus(node.place, a.place)];
        let along = dot(way, arm);
        (along > 0.0 && along < dot(way, way)).then_some(node)
    }

    /// The place of the section next to parameters: both move at right angles to where the height stays, until it is 0.
    fn node(&self, mut at: [f64; 2]) -> Option<Node> {
        let n = self.plane.normal;
        for _ in 0..MAX_STEPS_ON_COURSE {
            let jet = self.trim.chart.jet(at);
            let height = self.plane.height(&jet.place);
            let [du, dv] = jet.first;
            let [e, f, g] = [dot(du, du), dot(du, dv), dot(dv, dv)];
            let [p, q] = [dot(n, du), dot(n, dv)];
            let determinant = e * g - f * f;
            let [x, y] = [(g * p - f * q) / determinant, (e * q - f * p) / determinant];
            let slope = p * x + q * y;
            let by = height / slope;
            if !(by * x).is_finite() || !(by * y).is_finite() {
                return None;
            }
            at = [at[0] - by * x, at[1] - by * y];
            if height.abs() <= f64::EPSILON * norm(jet.place) {
                break;
            }
        }
        let jet = self.trim.chart.jet(at);
        let [du, dv] = jet.first;
        let (tangent, _) = unit(cross(n, cross(du, dv)))?;
        (self.plane.height(&jet.place).abs() <= self.within).then_some(Node { at, place: jet.place, tangent })
    }

    /// A cubic from one place to another, if it keeps to the section; `way` is about its length.
    fn piece(&self, a: &Node, b: &Node, way: f64) -> Option<[Point; 4]> {
        let chord = minus(b.place, a.place);
        let length = norm(chord);
        let ahead = |tangent: Vector| if dot(tangent, chord) < 0.0 { times(-1.0, tangent) } else { tangent };
        let [from, to] = [ahead(a.tangent), ahead(b.tangent)];
        let cosine = dot(from, to);
        if cosine < MIN_TURN_COSINE || length <= self.same || way > MAX_DETOUR * length {
            return None;
        }
        // Of a circle: a third of the chord over the squared cosine of a quarter of the turn.
        let handle = length / (3.0 * 0.5 * (1.0 + ((1.0 + cosine) / 2.0).max(0.0).sqrt()));
        let cubic = [a.place, plus(a.place, times(handle, from)), minus(b.place, times(handle, to)), b.place];
        let is_near = |t: f64| {
            let p = at(&cubic, t);
            let guess = [0, 1].map(|k| a.at[k] + t * (b.at[k] - a.at[k]));
            let node = self.node(self.trim.chart.parameters(p, Some(guess)));
            node.is_some_and(|node| norm(minus(node.place, p)) <= self.within)
        };
        MEASURED_SHARES.into_iter().all(is_near).then_some(cubic)
    }
}

fn straight(a: &Node, b: &Node) -> [Point; 4] {
    let third = times(1.0 / 3.0, minus(b.place, a.place));
    [a.place, plus(a.place, third), minus(b.place, third), b.place]
}

fn at([a, b, c, d]: &[Point; 4], t: f64) -> Point {
    let s = 1.0 - t;
    let w = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    std::array::from_fn(|k| w[0] * a[k] + w[1] * b[k] + w[2] * c[k] + w[3] * d[k])
}

fn add([a, b, c, d]: [Point; 4], controls: &mut Vec<Point>, knots: &mut Vec<f64>) {
    let last = knots.last().copied().unwrap_or(0.0);
    knots.push(last + norm(minus(d, a)));
    controls.extend([b, c, d]);
}

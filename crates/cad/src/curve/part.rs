//! The pieces of a curve, each of one kind.

use super::bezier::Bezier;
use super::conic::Conic;
use super::kinds::Curve;
use std::f64::consts::TAU;
use trueness_geom::space::{Aabb, Point, Vector, dot, minus, norm, times};
use trueness_geom::spline::curve::Curve as Spline;
use trueness_geom::spline::value::Mass;

/// A place of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Its parameter.
    pub parameter: f64,
    /// The place.
    pub place: Point,
    /// Its distance from the point that was asked for.
    pub distance: f64,
}

/// A piece of one kind.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) shape: Shape,
    /// First and last parameter of the whole curve.
    pub(super) range: [f64; 2],
    /// First and last parameter of the shape; infinite where those of the curve are.
    pub(super) own: [f64; 2],
    /// Around it; of splines around the control points.
    pub(super) bounds: Aabb,
}

/// What is known of a piece.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// A line.
    Line { origin: Point, direction: Vector },
    /// An ellipse, hyperbola or parabola.
    Conic(Conic),
    /// A span of a spline.
    Bezier(Bezier),
}

/// What is done to all places of a curve first.
#[derive(Clone, Copy)]
pub(super) enum View {
    /// Nothing.
    Space,
    /// They are moved along a unit vector into the plane through the origin at right angles to it.
    Along(Vector),
}

impl View {
    pub(super) fn vector(&self, v: Vector) -> Vector {
        match self {
            View::Space => v,
            View::Along(n) => minus(v, times(dot(v, *n), *n)),
        }
    }
}

impl Part {
    pub(super) fn new(shape: Shape, range: [f64; 2], own: [f64; 2]) -> Part {
        let mut part = Part { shape, range, own, bounds: Aabb::EMPTY };
        part.bounds = part.bounds_of();
        part
    }

    /// The part between two parameters of the whole curve.
    pub(super) fn within(&self, kept: [f64; 2]) -> Part {
        let shares = kept.map(|t| (t - self.range[0]) / (self.range[1] - self.range[0]));
        let cut = shares.map(|s| self.own[0] + s * (self.own[1] - self.own[0]));
        match &self.shape {
            Shape::Bezier(bezier) => {
                let part = bezier.part(cut[0].min(cut[1]), cut[0].max(cut[1]));
                let own = if self.own[0] > self.own[1] { [1.0, 0.0] } else { [0.0, 1.0] };
                Part::new(Shape::Bezier(part), kept, own)
            }
            shape => Part::new(shape.clone(), kept, cut),
        }
    }

    /// The place at a parameter of the shape.
    pub(super) fn at(&self, t: f64) -> Point {
        match &self.shape {
            Shape::Line { origin, direction } => std::array::from_fn(|k| origin[k] + t * direction[k]),
            Shape::Conic(conic) => conic.at(t),
            Shape::Bezier(bezier) => bezier.at(t),
        }
    }

    /// The parameter of the whole curve.
    pub(super) fn parameter(&self, t: f64) -> f64 {
        if self.own == self.range {
            return t;
        }
        let share = (t - self.own[0]) / (self.own[1] - self.own[0]);
        self.range[0] + share * (self.range[1] - self.range[0])
    }

    fn foot(&self, t: f64, p: Point) -> Foot {
        let place = self.at(t);
        Foot { parameter: self.parameter(t), place, distance: norm(minus(place, p)) }
    }

    /// Hands over both ends, the one on which the way begins first, and the minima between them that are nearer than `limit`, which the
    /// callback says anew; says the last one.
    pub(super) fn candidates(
        &self,
        p: Point,
        mut limit: f64,
        is_reversed: bool,
        visit: &mut impl FnMut(Foot) -> f64,
    ) -> f64 {
        let ends = if is_reversed { [self.own[1], self.own[0]] } else { self.own };
        for end in ends.into_iter().filter(|t| t.is_finite()) {
            limit = visit(self.foot(end, p));
        }
        let [low, high] = [self.own[0].min(self.own[1]), self.own[0].max(self.own[1])];
        match &self.shape {
            Shape::Line { origin, direction } => {
                let t = dot(minus(p, *origin), *direction) / dot(*direction, *direction);
                if t > low && t < high {
                    limit = visit(self.foot(t, p));
                }
            }
            Shape::Conic(conic) => conic.minima(p, |t| {
                for t in representatives(conic, t, [low, high]) {
                    limit = visit(self.foot(t, p));
                }
            }),
            Shape::Bezier(bezier) => bezier.minima(p, limit, |t| {
                limit = visit(self.foot(t, p));
                limit
            }),
        }
        limit
    }
}

/// All parameters within a range that stand for the same place.
pub(super) fn representatives(conic: &Conic, t: f64, [low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    let period = if conic.is_periodic() { TAU } else { f64::INFINITY };
    let first = if conic.is_periodic() { t + TAU * ((low - t) / TAU).ceil() } else { t };
    let is_within = move |t: &f64| *t >= low && *t <= high;
    [first, first + period].into_iter().filter(is_within)
}

/// Adds the pieces of a curve from `low` to `high`.
pub(super) fn add(curve: &Curve, range: [f64; 2], view: View, parts: &mut Vec<Part>) {
    let mut push = |shape: Shape, own: [f64; 2]| parts.push(Part::new(shape, range, own));
    let scaled = |s: f64, v: Vector| view.vector(times(s, v));
    match curve {
        Curve::Line { origin, direction } => {
            push(Shape::Line { origin: view.vector(*origin), direction: view.vector(*direction) }, range)
        }
        Curve::Circle { frame, radius } => {
            let [a, b] = [0, 1].map(|k| scaled(*radius, frame.axes[k]));
            push(Shape::Conic(Conic::ellipse(view.vector(frame.origin), a, b)), range);
        }
        Curve::Ellipse { frame, radii } => {
            let [a, b] = [0, 1].map(|k| scaled(radii[k], frame.axes[k]));
            push(Shape::Conic(Conic::ellipse(view.vector(frame.origin), a, b)), range);
        }
        Curve::Hyperbola { frame, radii } => {
            let [a, b] = [0, 1].map(|k| scaled(radii[k], frame.axes[k]));
            push(Shape::Conic(Conic::hyperbola(view.vector(frame.origin), a, b)), range);
        }
        Curve::Parabola { frame, focal } => {
            let [a, b] = [scaled(*focal, frame.axes[0]), scaled(2.0 * focal, frame.axes[1])];
            push(Shape::Conic(Conic::parabola(view.vector(frame.origin), a, b)), range);
        }
        Curve::Spline(spline) => {
            let masses = spline.points().iter().map(|p| Mass::new(view.vector(*p), 1.0)).collect();
            if let Ok(masses) = Spline::new(spline.knots().clone(), masses) {
                add_spline(&masses, range, parts);
            }
        }
        Curve::Rational(rational) => {
            let own = rational.masses();
            let seen = |m: &Mass<3>| Mass { moment: view.vector(m.moment), mass: m.mass };
            if let Ok(masses) = Spline::new(own.knots().clone(), own.points().iter().map(seen).collect()) {
                add_spline(&masses, range, parts);
            }
        }
        Curve::Polyline(points) => add_chain(points.len().saturating_sub(1), range, parts, |k, parts| {
            let side = minus(points[k + 1], points[k]);
            let line = Curve::Line { origin: points[k], direction: side };
            add(&line, [0.0, 1.0], view, parts);
            [0.0, 1.0]
        }),
        Curve::Joined(spans) => add_chain(spans.len(), range, parts, |k, parts| {
            let [from, to] = spans[k].range;
            add(&spans[k].curve, [from.min(to), from.max(to)], view, parts);
            [from, to]
        }),
    }
}

/// Adds the members of a chain, each over one unit of the parameter, and cuts them to the range. `member` adds one and says its own range.
fn add_chain(
    count: usize,
    [low, high]: [f64; 2],
    parts: &mut Vec<Part>,
    member: impl Fn(usize, &mut Vec<Part>) -> [f64; 2],
) {
    for k in 0..count {
        let unit = [k as f64, (k + 1) as f64];
        if unit[1] <= low && k + 1 < count || unit[0] >= high && k > 0 {
            continue;
        }
        let mut own = vec![];
        let [from, to] = member(k, &mut own);
        let lift = |t: f64| unit[0] + (t - from) / (to - from);
        if from > to {
            own.reverse();
        }
        for mut part in own {
            part.range = part.range.map(lift);
            if part.range[0] > part.range[1] {
                part.range.reverse();
                part.own.reverse();
            }
            let kept = [part.range[0].max(low), part.range[1].min(high)];
            if kept == part.range {
                parts.push(part);
            } else if kept[0] < kept[1] {
                parts.push(part.within(kept));
            }
        }
    }
}

/// Adds the pieces of a spline between its knots.
fn add_spline(masses: &Spline<Mass<3>>, [low, high]: [f64; 2], parts: &mut Vec<Part>) {
    let knots = masses.knots();
    let (distinct, degree) = (knots.distinct(), knots.degree());
    let clamped = masses.part(distinct[0], distinct[distinct.len() - 1]);
    let points = clamped.as_ref().unwrap_or(masses).bezier();
    for (k, pair) in distinct.windows(2).enumerate() {
        let kept = [pair[0].max(low), pair[1].min(high)];
        let Some(own) = points.get(k * degree..=(k + 1) * degree) else { continue };
        if kept[0] >= kept[1] {
            continue;
        }
        let [a, b] = kept.map(|t| (t - pair[0]) / (pair[1] - pair[0]));
        let whole = Bezier { points: own.to_vec() };
        let bezier = if [a, b] == [0.0, 1.0] { whole } else { whole.part(a, b) };
        parts.push(Part::new(Shape::Bezier(bezier), kept, [0.0, 1.0]));
    }
}

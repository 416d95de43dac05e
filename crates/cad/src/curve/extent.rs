//! How far a curve reaches, and how long it is.

use super::feet::CurveFeet;
use super::kinds::{Curve, Span};
use super::part::{Part, Shape, representatives};
use trueness_geom::space::{Aabb, norm};

/// Places and weights of Gauss and Legendre's rule with five places, on −1 … 1; the mirrored ones are left out.
const GAUSS: [(f64, f64); 3] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];
/// Share of its length up to which two halves and the whole of a piece may differ.
const LENGTH_PRECISION: f64 = 1e-13;
/// Halvings of a piece at most.
const LENGTH_DEPTH: u32 = 40;

impl CurveFeet {
    /// The smallest box around the range.
    pub fn exact_bounds(&self) -> Aabb {
        self.parts.iter().fold(Aabb::EMPTY, |b, part| b.union(&part.exact_bounds()))
    }
}

impl Part {
    /// Where a coordinate is extreme, and both ends.
    fn exact_bounds(&self) -> Aabb {
        let Shape::Bezier(bezier) = &self.shape else { return self.bounds_of() };
        let mut bounds = Aabb::of(&self.own.map(|t| self.at(t)));
        (0..3).for_each(|k| bezier.extremes(k, |t| bounds = bounds.union(&Aabb::of(&[self.at(t)]))));
        bounds
    }

    /// A box around it; of splines around the control points.
    pub(super) fn bounds_of(&self) -> Aabb {
        let mut bounds = match &self.shape {
            Shape::Bezier(bezier) => return Aabb::of(&bezier.places().collect::<Vec<_>>()),
            Shape::Line { direction, .. } => unbounded(self.own, |k| direction[k] == 0.0),
            Shape::Conic(_) => unbounded(self.own, |_| false),
        };
        let mut add = |t: f64| bounds = bounds.union(&Aabb::of(&[self.at(t)]));
        let [low, high] = [self.own[0].min(self.own[1]), self.own[0].max(self.own[1])];
        [low, high].into_iter().filter(|t| t.is_finite()).for_each(&mut add);
        match &self.shape {
            Shape::Conic(conic) => (0..3).for_each(|k| {
                conic.extremes(k, |t| representatives(conic, t, [low, high]).for_each(&mut add));
            }),
            Shape::Line { .. } if !low.is_finite() && !high.is_finite() => add(0.0),
            _ => {}
        }
        bounds
    }
}

/// The box of all space where a range has no end, flat along coordinates that stay the same.
fn unbounded(own: [f64; 2], is_flat: impl Fn(usize) -> bool) -> Aabb {
    if own.iter().all(|t| t.is_finite()) {
        return Aabb::EMPTY;
    }
    let side = |far: f64| std::array::from_fn(|k| if is_flat(k) { -far } else { far });
    Aabb { min: side(f64::NEG_INFINITY), max: side(f64::INFINITY) }
}

impl Span {
    /// The smallest box around the span.
    pub fn bounds(&self) -> Aabb {
        self.feet().exact_bounds()
    }

    /// Its length, to about twelve digits.
    pub fn length(&self) -> f64 {
        let [from, to] = self.range;
        match &self.curve {
            Curve::Line { direction, .. } => (to - from).abs() * norm(*direction),
            Curve::Circle { radius, .. } => (to - from).abs() * radius,
            curve => self.feet().pieces().map(|(_, range)| length(curve, range)).sum(),
        }
    }
}

/// Length of a smooth piece.
fn length(curve: &Curve, [from, to]: [f64; 2]) -> f64 {
    let speed = |t: f64| norm(curve.derivatives(t)[1]);
    let rule = |from: f64, to: f64| {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let both = |x: f64| match x == 0.0 {
            true => speed(middle),
            false => speed(middle - half * x) + speed(middle + half * x),
        };
        half * GAUSS.iter().map(|(x, w)| w * both(*x)).sum::<f64>()
    };
    let mut open = vec![(from, to, rule(from, to), LENGTH_DEPTH)];
    let mut sum = 0.0;
    while let Some((from, to, whole, depth)) = open.pop() {
        let middle = 0.5 * (from + to);
        let (a, b) = (rule(from, middle), rule(middle, to));
        let off = (a + b - whole).abs();
        let least = LENGTH_PRECISION * (a + b).max(sum);
        if depth == 0 || off.is_nan() || off <= least {
            sum += a + b;
        } else {
            open.push((middle, to, b, depth - 1));
            open.push((from, middle, a, depth - 1));
        }
    }
    sum
}

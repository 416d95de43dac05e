//! Length and curvature.

use super::super::value::Value;
use super::b_spline::Curve;

/// Places and weights of Gauss and Legendre's rule with five places, on −1 … 1; the mirrored ones are left out.
const GAUSS: [(f64, f64); 3] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Roundings of the greatest coordinate that the length of a span is uncertain by.
const LENGTH_ROUNDINGS: f64 = 16.0;

impl<const D: usize> Curve<[f64; D]> {
    /// Length of the curve between two parameters, to about twelve digits; negative where `to < from`.
    ///
    /// Each span is halved until two halves and the whole agree, or differ by no more than the rounding of the control points'
    /// coordinates. Fewer digits are known of a curve far shorter than it is away from the origin. Not a number, where a
    /// control point is none.
    pub fn length(&self, from: f64, to: f64) -> f64 {
        if to < from {
            return -self.length(to, from);
        }
        let mut places = vec![from];
        places.extend(self.knots.distinct().into_iter().filter(|k| *k > from && *k < to));
        places.push(to);
        let greatest = self.points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        let lost = LENGTH_ROUNDINGS * f64::EPSILON * greatest;
        places.windows(2).map(|w| self.halved(w[0], w[1], self.rule(w[0], w[1]), lost, 40)).sum()
    }

    fn speed(&self, t: f64) -> f64 {
        self.derivative(t, 1).iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    fn rule(&self, from: f64, to: f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let pair = |x: f64| match x == 0.0 {
            true => self.speed(middle),
            false => self.speed(middle - half * x) + self.speed(middle + half * x),
        };
        half * GAUSS.iter().map(|(x, w)| w * pair(*x)).sum::<f64>()
    }

    fn halved(&self, from: f64, to: f64, whole: f64, lost: f64, depth: u32) -> f64 {
        let middle = 0.5 * (from + to);
        let (a, b) = (self.rule(from, middle), self.rule(middle, to));
        let off = (a + b - whole).abs();
        if depth == 0 || off.is_nan() || off <= (1e-13 * (a + b)).max(lost) {
            return a + b;
        }
        self.halved(from, middle, a, lost, depth - 1) + self.halved(middle, to, b, lost, depth - 1)
    }

    /// The parameter at which the curve is `length` long from its start; the ends where it is shorter or negative.
    pub fn parameter_at_length(&self, length: f64) -> f64 {
        let (from, to) = self.domain();
        let (mut low, mut high) = (from, to);
        let mut t = from + (to - from) * (length / self.length(from, to)).clamp(0.0, 1.0);
        for _ in 0..60 {
            let off = self.length(from, t) - length;
            if off > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let newton = t - off / self.speed(t);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - t).abs() <= 4.0 * f64::EPSILON * (to - from) {
                return next;
            }
            t = next;
        }
        t
    }
}

impl Curve<[f64; 2]> {
    /// Curvature at `t`, positive where the curve turns to the left; `None` where the curve stands still.
    pub fn curvature(&self, t: f64) -> Option<f64> {
        let mut d = [[0.0; 2]; 3];
        self.derivatives_into(t, &mut d);
        let speed = libm::hypot(d[1][0], d[1][1]);
        let k = (d[1][0] * d[2][1] - d[1][1] * d[2][0]) / (speed * speed * speed);
        k.is_finite().then_some(k)
    }
}

impl<V: Value> Curve<V> {
    /// `count` values at equal steps of the parameter, both ends included; at least two.
    pub fn sample(&self, count: usize) -> Vec<V> {
        let (from, to) = self.domain();
        let last = count.max(2) - 1;
        (0..=last).map(|i| self.at(from + (to - from) * i as f64 / last as f64)).collect()
    }
}

//! Where the distance from a polynomial or rational piece of a curve has minima.
//!
//! With `Y = X − p·w` the squared distance is `Y·Y / w²`, and its derivative has the sign of `D = (Y·Y)′·w − 2·(Y·Y)·w′`. All are
//! polynomials in Bernstein form. A piece is nowhere nearer than `r` where no coefficient of `Y·Y − r²·w²` is below 0. It holds no place
//! where the distance stands still, but at its ends, where the coefficients of `D` have one sign; and one such place where they change
//! sign once. Else it is halved (Lane and Riesenfeld, Bounds on a polynomial, BIT 21, 1981).

use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};
use trueness_geom::spline::value::{Mass, Value};

/// Roundings of a coefficient as a share of the greatest: it is the sum of some dozens of products.
const NOISE: f64 = 64.0 * f64::EPSILON;
/// Halvings at most; by then a part is as short as a rounding of its parameter.
const DEPTH: u32 = 50;
/// Coefficients of a polynomial that is evaluated without allocating, at most.
const MAX_COEFFICIENTS_ON_STACK: usize = 24;
/// Steps of bisection with Newton's at most.
const ROOT_STEPS: usize = 100;

/// Control points with masses of a piece over the parameters 0 to 1.
#[derive(Clone, Debug)]
pub(super) struct Bezier {
    pub(super) points: Vec<Mass<3>>,
}

/// A polynomial in Bernstein form.
type Bernstein = Vec<f64>;

impl Bezier {
    /// The place at a share of the way.
    pub(super) fn at(&self, t: f64) -> Point {
        let end = if t == 0.0 { self.points.first() } else { self.points.last().filter(|_| t == 1.0) };
        if let Some(end) = end {
            return end.place().unwrap_or([f64::NAN; 3]);
        }
        let mut level = [Mass::<3>::ZERO; 16];
        let n = self.points.len();
        if n > level.len() {
            let mut level = self.points.clone();
            return collapse(&mut level, t);
        }
        level[..n].copy_from_slice(&self.points);
        collapse(&mut level[..n], t)
    }

    /// Hands over parameters within where the distance from `p` may have a minimum of less than `limit`; the ends are not among them unless
    /// one is. The callback says a new limit. Where the distance is the same everywhere, some parameter within.
    pub(super) fn minima(&self, p: Point, mut limit: f64, mut visit: impl FnMut(f64) -> f64) {
        if self.is_beyond(p, limit) || self.is_left_behind(p) {
            return;
        }
        let about: Vec<Mass<3>> =
            self.points.iter().map(|m| Mass { moment: m.moment.plus(-m.mass, p), mass: m.mass }).collect();
        let square = product(&about, &about, |a, b| dot(a.moment, b.moment));
        let masses: Bernstein = about.iter().map(|m| m.mass).collect();
        let weights = product(&masses, &masses, |a, b| a * b);
        let slope = slope(&square, &masses);
        let lost = NOISE * greatest(&square);
        let noise = [lost, lost * (square.len() - 1) as f64 * greatest(&masses)];
        let mut open = vec![(0.0, 1.0, square, weights, slope, 0)];
        while let Some((from, to, square, weights, slope, depth)) = open.pop() {
            let beyond = limit * limit;
            if square.iter().zip(&weights).all(|(s, w)| *s > beyond * w + noise[0]) {
                continue;
            }
            if greatest(&slope) <= noise[1] || depth > DEPTH {
                limit = visit(0.5 * (from + to));
                continue;
            }
            match changes(&slope, noise[1]) {
                (0, _) => {}
                (1, true) => limit = visit(from + (to - from) * root(&slope)),
                (1, false) => {}
                _ => {
                    let halves = [&square, &weights, &slope].map(halves);
                    let [[s0, s1], [w0, w1], [d0, d1]] = halves;
                    let middle = 0.5 * (from + to);
                    if d1.first().is_some_and(|d| d.abs() <= noise[1]) {
                        limit = visit(middle);
                    }
                    open.push((middle, to, s1, w1, d1, depth + 1));
                    open.push((from, middle, s0, w0, d0, depth + 1));
                }
            }
        }
    }

    /// Whether all control points lie beyond a plane at this distance across the way to the middle of the chord.
    fn is_beyond(&self, p: Point, limit: f64) -> bool {
        let [Some(a), Some(b)] = [self.points.first(), self.points.last()].map(|m| m.and_then(Mass::place))
        else {
            return false;
        };
        let Some((way, _)) = unit(minus(plus(times(0.5, a), times(0.5, b)), p)) else { return false };
        let height = dot(p, way) + limit;
        self.points.iter().all(|m| dot(m.moment, way) > height * m.mass)
    }

    /// Whether the distance only grows, or only falls. The way from the point is a mean of the ways to the control points, and the
    /// derivative a sum of the sides between these with factors not below 0 (Floater, Derivatives of rational Bézier curves, Computer
    /// Aided Geometric Design 9, 1992): no product of both has another sign.
    fn is_left_behind(&self, p: Point) -> bool {
        if self.points.iter().any(|m| m.mass <= 0.0) {
            return false;
        }
        let mut sense = 0.0;
        for w in self.points.windows(2) {
            let side = plus(times(w[0].mass, w[1].moment), times(-w[1].mass, w[0].moment));
            let length = norm(side);
            for m in &self.points {
                let way = plus(m.moment, times(-m.mass, p));
                let product = dot(way, side);
                let noise = NOISE * length * (norm(m.moment) + m.mass.abs() * norm(p));
                if product.abs() <= noise || product * sense < 0.0 {
                    return false;
                }
                sense = product;
            }
        }
        sense != 0.0
    }

    /// Hands over parameters within where coordinate `k` has its extremes.
    pub(super) fn extremes(&self, k: usize, mut visit: impl FnMut(f64)) {
        let [own, masses] = [|m: &Mass<3>, k: usize| m.moment[k], |m: &Mass<3>, _| m.mass]
            .map(|of| self.points.iter().map(|m| of(m, k)).collect::<Bernstein>());
        let multiply = |a: &[f64], b: &[f64]| product(a, b, |x, y| x * y);
        let (first, second) = (multiply(&difference(&own), &masses), multiply(&own, &difference(&masses)));
        let slope: Bernstein = first.iter().zip(&second).map(|(a, b)| a - b).collect();
        let noise = NOISE * self.points.len() as f64 * greatest(&own) * greatest(&masses);
        let mut open = vec![(0.0, 1.0, slope, 0)];
        while let Some((from, to, slope, depth)) = open.pop() {
            let middle = 0.5 * (from + to);
            match changes(&slope, noise) {
                (0, _) if greatest(&slope) > noise || depth > 0 => {}
                (1, is_rising) => {
                    let sense = if is_rising { 1.0 } else { -1.0 };
                    let rising: Bernstein = slope.iter().map(|d| sense * d).collect();
                    visit(from + (to - from) * root(&rising));
                }
                _ if depth > DEPTH => visit(middle),
                _ => {
                    visit(middle);
                    let [first, second] = halves(&slope);
                    open.push((middle, to, second, depth + 1));
                    open.push((from, middle, first, depth + 1));
                }
            }
        }
    }

    /// How far the piece may be from the chord between its ends, and how far its direction may turn: by its control points.
    pub(super) fn bend(&self) -> [f64; 2] {
        let places: Vec<Point> = self.places().collect();
        let [Some(first), Some(last)] = [places.first(), places.last()] else { return [f64::INFINITY; 2] };
        let off = |p: &Point| off_chord(p, first, last);
        let legs: Vec<Vector> =
            places.windows(2).filter_map(|w| unit(minus(w[1], w[0])).map(|(d, _)| d)).collect();
        let turn = |w: &[Vector]| libm::atan2(norm(cross(w[0], w[1])), dot(w[0], w[1]));
        [places.iter().map(off).fold(0.0, f64::max), legs.windows(2).map(turn).sum()]
    }

    /// The part between two shares of the way.
    pub(super) fn part(&self, from: f64, to: f64) -> Bezier {
        let right = split(&self.points, from)[1].clone();
        let share = if from < 1.0 { (to - from) / (1.0 - from) } else { 1.0 };
        let [points, _] = split(&right, share);
        Bezier { points }
    }

    /// Its control points.
    pub(super) fn places(&self) -> impl Iterator<Item = Point> + '_ {
        self.points.iter().filter_map(Mass::place)
    }
}

/// Distance of a place from the straight line between two others.
pub(super) fn off_chord(p: &Point, start: &Point, end: &Point) -> f64 {
    let (chord, arm) = (minus(*end, *start), minus(*p, *start));
    let share = (dot(arm, chord) / dot(chord, chord)).clamp(0.0, 1.0);
    norm(minus(arm, times(if share.is_finite() { share } else { 0.0 }, chord)))
}

fn collapse(level: &mut [Mass<3>], t: f64) -> Point {
    for k in 1..level.len() {
        for i in 0..level.len() - k {
            level[i] = level[i].between(t, level[i + 1]);
        }
    }
    level.first().and_then(Mass::place).unwrap_or([f64::NAN; 3])
}

/// Both parts of control points, by the pyramid of de Casteljau.
fn split<V: Value>(points: &[V], t: f64) -> [Vec<V>; 2] {
    let (mut first, mut second) = (points.to_vec(), points.to_vec());
    let n = points.len();
    for (level, end) in first.iter_mut().enumerate().skip(1) {
        for i in 0..n - level {
            second[i] = second[i].between(t, second[i + 1]);
        }
        *end = second[0];
    }
    [first, second]
}

fn halves(coefficients: &Bernstein) -> [Bernstein; 2] {
    let (mut first, mut second) = (coefficients.clone(), coefficients.clone());
    let n = coefficients.len();
    for (level, end) in first.iter_mut().enumerate().skip(1) {
        for i in 0..n - level {
            second[i] = 0.5 * (second[i] + second[i + 1]);
        }
        *end = second[0];
    }
    [first, second]
}

/// The product of two polynomials in Bernstein form.
fn product<A: Copy>(a: &[A], b: &[A], by: impl Fn(A, A) -> f64) -> Bernstein {
    let (m, n) = (a.len() - 1, b.len() - 1);
    let [cm, cn, all] = [m, n, m + n].map(binomials);
    let mut out = vec![0.0; m + n + 1];
    for i in 0..=m {
        for j in 0..=n {
            out[i + j] += cm[i] * cn[j] / all[i + j] * by(a[i], b[j]);
        }
    }
    out
}

/// `D` of the squares and masses.
fn slope(square: &[f64], masses: &[f64]) -> Bernstein {
    let by = difference(square);
    if masses.windows(2).all(|w| w[0] == w[1]) {
        return by.iter().map(|d| d * masses[0]).collect();
    }
    let multiply = |a: &[f64], b: &[f64]| product(a, b, |x, y| x * y);
    let (first, second) = (multiply(&by, masses), multiply(square, &difference(masses)));
    first.iter().zip(&second).map(|(a, b)| a - 2.0 * b).collect()
}

/// The coefficients of the derivative.
fn difference(c: &[f64]) -> Bernstein {
    c.windows(2).map(|w| (c.len() - 1) as f64 * (w[1] - w[0])).collect()
}

fn greatest(coefficients: &[f64]) -> f64 {
    coefficients.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// How often the coefficients change their sign, and whether they end above 0.
fn changes(coefficients: &[f64], noise: f64) -> (usize, bool) {
    let mut signs = coefficients.iter().filter(|x| x.abs() > noise).map(|x| *x > 0.0);
    let Some(mut last) = signs.next() else { return (0, false) };
    let mut count = 0;
    for sign in signs {
        count += usize::from(sign != last);
        last = sign;
    }
    (count, last)
}

/// The only root of a polynomial that is below 0 before it and above 0 after it.
fn root(coefficients: &[f64]) -> f64 {
    let (mut low, mut high, mut t) = (0.0, 1.0, 0.5);
    for _ in 0..ROOT_STEPS {
        let [value, by] = value(coefficients, t);
        if value > 0.0 {
            high = t
        } else {
            low = t
        }
        let newton = t - value / by;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - t).abs() <= f64::EPSILON * t || value == 0.0 {
            return t;
        }
        t = next;
    }
    t
}

/// A polynomial and its derivative.
fn value(coefficients: &[f64], t: f64) -> [f64; 2] {
    let n = coefficients.len() - 1;
    let mut inline = [0.0; MAX_COEFFICIENTS_ON_STACK];
    let mut many;
    let level: &mut [f64] = if n < MAX_COEFFICIENTS_ON_STACK {
        inline[..=n].copy_from_slice(coefficients);
        &mut inline[..=n]
    } else {
        many = coefficients.to_vec();
        &mut many
    };
    for k in 1..n {
        for i in 0..=n - k {
            level[i] += t * (level[i + 1] - level[i]);
        }
    }
    match *level {
        [a, b, ..] => [a + t * (b - a), n as f64 * (b - a)],
        _ => [level[0], 0.0],
    }
}

/// Row `n` of Pascal's triangle.
fn binomials(n: usize) -> Vec<f64> {
    let mut row = vec![1.0; n + 1];
    for k in 1..=n {
        row[k] = row[k - 1] * (n + 1 - k) as f64 / k as f64;
    }
    row
}

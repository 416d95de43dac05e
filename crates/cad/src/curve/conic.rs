//! Where the distance from a line or a conic stands still.
//!
//! With `E`, half the derivative of the squared distance by the parameter, in the axes of the conic:
//!
//! | kind | `E` | between its breakpoints |
//! |---|---|---|
//! | ellipse | `(b² − a²)·sin·cos + a·X·sin − b·Y·cos` | `a·X / cos − b·Y / sin` is monotone in a quadrant but for one place, `tan³ = −b·Y / (a·X)` |
//! | hyperbola | `(a² + b²)·sinh·cosh − a·X·sinh − b·Y·cosh` | the same with `tanh³` |
//! | parabola | `2·a²·t³ + (b² − 2·a·X)·t − b·Y` | its derivative has two roots |
//!
//! So `E` has at most one root between two breakpoints, and bisection with Newton's steps finds each. No quartic is solved.
//!
//! Images under a linear map keep their form `center + A·f(t) + B·g(t)`, though `A` and `B` are no longer at right angles: a shift
//! of the parameter makes them so.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::space::{Point, Vector, dot, minus, norm, plus, times, unit};

/// What `f` and `g` are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// `cos`, `sin`.
    Ellipse,
    /// `cosh`, `sinh`.
    Hyperbola,
    /// `t²`, `t`.
    Parabola,
}

/// A conic `center + radii[0]·f(t − shift)·axes[0] + radii[1]·g(t − shift)·axes[1]`.
#[derive(Clone, Debug)]
pub(super) struct Conic {
    form: Form,
    center: Point,
    /// Of length 1, or 0 along with its radius; at right angles.
    axes: [Vector; 2],
    radii: [f64; 2],
    shift: f64,
}

/// Roundings of the terms of `E` below which it is taken for 0.
const NOISE: f64 = 8.0 * f64::EPSILON;
/// Most breakpoints: four quadrants, two between them, and the first one again.
const BREAKPOINTS: usize = 7;
/// Steps of bisection at most: as many as a number has bits, and some of Newton's between them.
const ROOT_STEPS: usize = 100;

impl Conic {
    /// `center + a·cos t + b·sin t`, whatever `a` and `b` are.
    pub(super) fn ellipse(center: Point, a: Vector, b: Vector) -> Conic {
        let turned =
            if is_across(a, b) { 0.0 } else { 0.5 * libm::atan2(2.0 * dot(a, b), dot(a, a) - dot(b, b)) };
        let (c, s) = (libm::cos(turned), libm::sin(turned));
        let axes = [plus(times(c, a), times(s, b)), plus(times(-s, a), times(c, b))];
        Conic::of(Form::Ellipse, center, axes, turned)
    }

    /// `center + a·cosh t + b·sinh t`.
    pub(super) fn hyperbola(center: Point, a: Vector, b: Vector) -> Conic {
        let ratio = -2.0 * dot(a, b) / (dot(a, a) + dot(b, b));
        let shift = if is_across(a, b) || ratio.abs() >= 1.0 { 0.0 } else { 0.5 * libm::atanh(ratio) };
        let (c, s) = (libm::cosh(shift), libm::sinh(shift));
        let axes = [plus(times(c, a), times(s, b)), plus(times(s, a), times(c, b))];
        Conic::of(Form::Hyperbola, center, axes, shift)
    }

    /// `center + a·t² + b·t`.
    pub(super) fn parabola(center: Point, a: Vector, b: Vector) -> Conic {
        let shift = if is_across(a, b) || norm(a) == 0.0 { 0.0 } else { -0.5 * dot(a, b) / dot(a, a) };
        let vertex = plus(center, times(shift, plus(times(shift, a), b)));
        Conic::of(Form::Parabola, vertex, [a, plus(b, times(2.0 * shift, a))], shift)
    }

    fn of(form: Form, center: Point, axes: [Vector; 2], shift: f64) -> Conic {
        let pairs = axes.map(|a| unit(a).unwrap_or(([0.0; 3], 0.0)));
        Conic { form, center, axes: pairs.map(|p| p.0), radii: pairs.map(|p| p.1), shift }
    }

    /// The place at `t`.
    pub(super) fn at(&self, t: f64) -> Point {
        let t = t - self.shift;
        let pair = match self.form {
            Form::Ellipse => [libm::cos(t), libm::sin(t)],
            Form::Hyperbola => [libm::cosh(t), libm::sinh(t)],
            Form::Parabola => [t * t, t],
        };
        let [a, b] = [0, 1].map(|k| self.radii[k] * pair[k]);
        std::array::from_fn(|k| self.center[k] + (a * self.axes[0][k] + b * self.axes[1][k]))
    }

    /// Greatest length of the second derivative between two parameters.
    pub(super) fn bend(&self, [low, high]: [f64; 2]) -> f64 {
        let [a, b] = self.radii;
        match self.form {
            Form::Ellipse => a.max(b),
            Form::Hyperbola => {
                let most = (low - self.shift).abs().max((high - self.shift).abs());
                libm::hypot(a * libm::cosh(most), b * libm::sinh(most))
            }
            Form::Parabola => 2.0 * a,
        }
    }

    /// The derivative at `t`.
    pub(super) fn direction(&self, t: f64) -> Vector {
        let t = t - self.shift;
        let pair = match self.form {
            Form::Ellipse => [-libm::sin(t), libm::cos(t)],
            Form::Hyperbola => [libm::sinh(t), libm::cosh(t)],
            Form::Parabola => [2.0 * t, 1.0],
        };
        let [a, b] = [0, 1].map(|k| times(self.radii[k] * pair[k], self.axes[k]));
        plus(a, b)
    }

    /// Center and vectors that span the plane, and whatever else it takes to span all that the curve passes.
    pub(super) fn support(&self) -> [Point; 3] {
        let [a, b] = [0, 1].map(|k| plus(self.center, times(self.radii[k], self.axes[k])));
        [self.center, a, b]
    }

    /// Whether it repeats after a turn.
    pub(super) fn is_periodic(&self) -> bool {
        self.form == Form::Ellipse
    }

    /// Hands over parameters where coordinate `k` stands still.
    pub(super) fn extremes(&self, k: usize, mut visit: impl FnMut(f64)) {
        let [a, b] = [0, 1].map(|i| self.radii[i] * self.axes[i][k]);
        match self.form {
            Form::Ellipse => {
                let t = libm::atan2(b, a) + self.shift;
                visit(t);
                visit(t + PI);
            }
            Form::Hyperbola if b.abs() < a.abs() => visit(libm::atanh(-b / a) + self.shift),
            Form::Parabola if a != 0.0 => visit(-0.5 * b / a + self.shift),
            _ => {}
        }
    }

    /// Hands over all parameters where the distance from a point has a minimum, of an ellipse those of one turn. Places at which it is
    /// doubtful whether there is one are among them. Where the distance is the same everywhere, as on the axis of a circle, some.
    pub(super) fn minima(&self, p: Point, mut visit: impl FnMut(f64)) {
        let away = minus(p, self.center);
        let flat = self.axes.map(|axis| dot(axis, away));
        let [a, b] = self.radii;
        let scaled = [a * flat[0], b * flat[1]];
        if self.form == Form::Ellipse && a == b {
            visit(libm::atan2(flat[1], flat[0]) + self.shift);
            return;
        }
        let mut breaks = [f64::NAN; BREAKPOINTS];
        let count = self.breakpoints(scaled, &mut breaks);
        let (mut before, mut at_first) = (self.slope(scaled, breaks[0]), true);
        for pair in breaks[..count].windows(2) {
            let after = self.slope(scaled, pair[1]);
            if at_first && before.is_nothing() {
                visit(pair[0] + self.shift);
            }
            at_first = false;
            if before.to_the_right() < 0.0 && after.to_the_left() > 0.0 {
                visit(root(|t| self.slope(scaled, t), pair[0], pair[1]) + self.shift);
            }
            if after.is_nothing() {
                visit(pair[1] + self.shift);
            }
            before = after;
        }
    }

    /// Ascending numbers between which `E` has at most one root, first and last those that hold all roots.
    fn breakpoints(&self, [x, y]: [f64; 2], out: &mut [f64; BREAKPOINTS]) -> usize {
        let [a, b] = self.radii;
        let mut count = 0;
        let mut push = |t: f64| {
            out[count] = t;
            count += 1;
        };
        match self.form {
            Form::Ellipse => {
                let between = libm::atan2(libm::cbrt(-y), libm::cbrt(x)).rem_euclid(PI);
                let early = between.min(FRAC_PI_2);
                [0.0, early, between.max(FRAC_PI_2), PI, PI + early, PI + between.max(FRAC_PI_2), TAU]
                    .into_iter()
                    .for_each(&mut push);
            }
            Form::Hyperbola => {
                let most = x.abs().max(y.abs()) / (a * a + b * b);
                let end = libm::asinh(2.0 * most) + 1.0;
                let between = libm::atanh(libm::cbrt(-y / x));
                let between = if between.is_finite() { between.clamp(-end, end) } else { 0.0 };
                [-end, between.min(0.0), between.max(0.0), end].into_iter().for_each(&mut push);
            }
            Form::Parabola => {
                let (linear, constant) = ((b * b - 2.0 * x) / (2.0 * a * a), y / (2.0 * a * a));
                let end = 2.0 * linear.abs().sqrt().max(libm::cbrt(constant.abs())) + f64::MIN_POSITIVE;
                let between = (-linear / 3.0).max(0.0).sqrt();
                [-end, -between, between, end].into_iter().for_each(&mut push);
            }
        }
        count
    }

    /// `E` and its derivative.
    fn slope(&self, [x, y]: [f64; 2], t: f64) -> Slope {
        let [a, b] = self.radii;
        let [f, g, constant] = match self.form {
            Form::Ellipse => {
                let (c, s) = (libm::cos(t), libm::sin(t));
                let k = b * b - a * a;
                let by = k * (c * c - s * s) + x * c + y * s;
                return Slope::new([k * s * c, x * s, -y * c], by);
            }
            Form::Hyperbola => {
                let (c, s) = (libm::cosh(t), libm::sinh(t));
                let k = a * a + b * b;
                let by = k * (c * c + s * s) - x * c - y * s;
                return Slope::new([k * s * c, -x * s, -y * c], by);
            }
            Form::Parabola => [2.0 * a * a, b * b - 2.0 * x, -y],
        };
        Slope::new([f * t * t * t, g * t, constant], 3.0 * f * t * t + g)
    }
}

/// A value, its derivative, and how large the terms are that it is the sum of.
struct Slope {
    value: f64,
    by: f64,
    noise: f64,
}

impl Slope {
    fn new(terms: [f64; 3], by: f64) -> Slope {
        let noise = NOISE * terms.iter().map(|x| x.abs()).sum::<f64>();
        Slope { value: terms.iter().sum(), by, noise }
    }
    fn is_nothing(&self) -> bool {
        self.value.abs() <= self.noise
    }
    /// The sign that it has a little further on.
    fn to_the_right(&self) -> f64 {
        if self.is_nothing() { self.by } else { self.value }
    }
    /// The sign that it had a little before.
    fn to_the_left(&self) -> f64 {
        if self.is_nothing() { -self.by } else { self.value }
    }
}

/// The root of a function that is below 0 at `low` and above it at `high`.
fn root(slope: impl Fn(f64) -> Slope, mut low: f64, mut high: f64) -> f64 {
    let mut t = 0.5 * (low + high);
    for _ in 0..ROOT_STEPS {
        let own = slope(t);
        if own.value > 0.0 {
            high = t
        } else {
            low = t
        }
        let newton = t - own.value / own.by;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - t).abs() <= f64::EPSILON * t.abs() || own.value == 0.0 {
            return t;
        }
        t = next;
    }
    t
}

/// Whether two vectors are at right angles but for rounding: then axes are kept as they are.
fn is_across(a: Vector, b: Vector) -> bool {
    dot(a, b).abs() <= NOISE * norm(a) * norm(b)
}

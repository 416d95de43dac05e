//! The free piece: curvature as a B-spline along the length.
//!
//! A piece of length `ℓ` with coefficients `c` has the curvature `κ(t) = Σ cⱼ Bⱼ(t)` for `t = s / ℓ` from 0 to 1. So
//! its heading is `θ(t) = ℓ Σ cⱼ Kⱼ(t)` with `Kⱼ = ∫ Bⱼ`, exactly. Places are integrals of the heading's direction, by
//! Gauss and Legendre's rule over panels, and quintic between the ends of panels. Their motions with the unknowns are
//! cubic there. All is in the frame of the piece: it starts at 0 along the first axis.

use std::sync::OnceLock;
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::{self, Ends};

/// Most coefficients of a free piece.
pub(crate) const MAX_COEFFICIENTS: usize = 48;
/// Fewest panels over a piece, and per span of its knots.
const MIN_PANELS_PER_PIECE_AND_SPAN: (usize, usize) = (14, 4);
/// Gauss and Legendre's rule with four places on 0 … 1.
const GAUSS_LEGENDRE: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// The functions `Bⱼ` and `Kⱼ` of one number of coefficients, where they are needed.
pub(super) struct Basis {
    count: usize,
    panels: usize,
    /// `Kⱼ` at the ends of panels.
    integrals: Vec<f64>,
    /// `Bⱼ` there.
    values: Vec<f64>,
    /// `Kⱼ` at the places of the rule.
    inner: Vec<f64>,
    /// The same in columns: for each coefficient all of `inner`, `integrals` and `values`.
    columns: Vec<f64>,
}

/// Degree of the curvature of a piece with so many coefficients.
fn degree(count: usize) -> usize {
    3.min(count - 1)
}

/// Spans between the knots of the curvature of a piece with so many coefficients.
pub(crate) fn spans(count: usize) -> usize {
    count - degree(count)
}

/// The curvature at `t`.
pub(super) fn curvature(coefficients: &[f64], t: f64) -> f64 {
    let degree = degree(coefficients.len());
    let (first, values) = Knots::uniform(degree, coefficients.len() - degree, 0.0, 1.0).basis(t);
    values.iter().zip(&coefficients[first..]).map(|(b, c)| b * c).sum()
}

/// Where each coefficient acts most.
pub(crate) fn places(count: usize) -> Vec<f64> {
    let degree = degree(count);
    Knots::uniform(degree, count - degree, 0.0, 1.0).greville()
}

/// So many coefficients with nearly the curvatures given, the means over parts of equal length: least squares.
pub(crate) fn near(count: usize, curvatures: &[f64]) -> Vec<f64> {
    let degree = degree(count);
    let knots = Knots::uniform(degree, count - degree, 0.0, 1.0);
    let share = |i: usize| (i as f64 + 0.5) / curvatures.len() as f64;
    let at: Vec<f64> = (0..curvatures.len()).map(share).collect();
    let values: Vec<[f64; 1]> = curvatures.iter().map(|c| [*c]).collect();
    match curve::fit(&values, &at, &knots, Ends::FREE, 0.0) {
        Ok(fitted) => fitted.curve.points().iter().map(|p| p[0]).collect(),
        Err(_) => vec![0.0; count],
    }
}

impl Basis {
    /// The functions for `count` coefficients, 2 to [`MAX_COEFFICIENTS`].
    pub(super) fn of(count: usize) -> &'static Basis {
        static ALL: [OnceLock<Basis>; MAX_COEFFICIENTS + 1] =
            [const { OnceLock::new() }; MAX_COEFFICIENTS + 1];
        ALL[count].get_or_init(|| Basis::new(count))
    }

    fn new(count: usize) -> Basis {
        let degree = degree(count);
        let spans = count - degree;
        let knots = Knots::uniform(degree, spans, 0.0, 1.0);
        let panels =
            spans * MIN_PANELS_PER_PIECE_AND_SPAN.1.max(MIN_PANELS_PER_PIECE_AND_SPAN.0.div_ceil(spans));
        let dense = |t: f64| {
            let (first, values) = knots.basis(t);
            let mut all = vec![0.0; count];
            all[first..first + values.len()].copy_from_slice(&values);
            all
        };
        // Exact for the cubic pieces of the functions.
        let integral = |from: f64, to: f64| {
            let mut sum = vec![0.0; count];
            for (x, w) in GAUSS_LEGENDRE {
                for (s, b) in sum.iter_mut().zip(dense(from + (to - from) * x)) {
                    *s += w * (to - from) * b;
                }
            }
            sum
        };
        let plus = |a: &[f64], b: Vec<f64>| -> Vec<f64> { a.iter().zip(b).map(|(x, y)| x + y).collect() };
        let mut basis = Basis {
            count,
            panels,
            integrals: vec![0.0; count],
            values: dense(0.0),
            inner: vec![],
            columns: vec![],
        };
        let mut now = vec![0.0; count];
        for k in 0..panels {
            let (from, to) = (k as f64 / panels as f64, (k + 1) as f64 / panels as f64);
            for (x, _) in GAUSS_LEGENDRE {
                basis.inner.extend(plus(&now, integral(from, from + (to - from) * x)));
            }
            now = plus(&now, integral(from, to));
            basis.integrals.extend_from_slice(&now);
            basis.values.extend(dense(to));
        }
        for j in 0..count {
            for rows in [&basis.inner, &basis.integrals, &basis.values] {
                basis.columns.extend(rows[j..].iter().step_by(count));
            }
        }
        basis
    }
}

/// A place of a free piece.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CurvePlace {
    /// Where.
    pub at: [f64; 2],
    /// Direction of the curve.
    pub along: [f64; 2],
    /// Curvature.
    pub curvature: f64,
}

/// A free piece in its own frame: places, and how they move with its length and coefficients.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    count: usize,
    panels: usize,
    length: f64,
    places: Vec<CurvePlace>,
    /// Headings there.
    headings: Vec<f64>,
    /// Sums over the coefficients, one for each entry of a column of the basis.
    sums: Vec<f64>,
    /// Heading at the end.
    pub turn: f64,
    /// Quintics over the panels, x and y.
    quintics: Vec<[[f64; 2]; 6]>,
    /// For each end of a panel the motion with the length, then with each coefficient.
    motions: Vec<[f64; 2]>,
}

impl Table {
    /// Products that filling it takes: a sine takes about as long as so many.
    pub(super) fn products(&self) -> f64 {
        /// Products in the time of one sine.
        const PRODUCTS_PER_SINE: usize = 50;
        (4 * self.panels * (4 * self.count + PRODUCTS_PER_SINE)) as f64
    }

    /// Computes all for the piece.
    pub(super) fn fill(&mut self, coefficients: &[f64], length: f64) {
        let basis = Basis::of(coefficients.len());
        let n = basis.count;
        (self.count, self.panels, self.length) = (n, basis.panels, length);
        // Column by column: many sums at a time, each in the order of the coefficients.
        let rows = basis.columns.len() / n;
        self.sums.clear();
        self.sums.resize(rows, 0.0);
        for (c, column) in coefficients.iter().zip(basis.columns.chunks_exact(rows)) {
            self.sums.iter_mut().zip(column).for_each(|(s, k)| *s += k * c);
        }
        let (angles, ends) = self.sums.split_at(4 * basis.panels);
        let (integrals, values) = ends.split_at(basis.panels + 1);
        self.places.clear();
        self.motions.clear();
        self.quintics.clear();
        let step = 1.0 / basis.panels as f64;
        let mut at = [0.0; 2];
        let mut stretch = [0.0; 2];
        let first = self.motions.len();
        self.motions.resize(first + n + 1, [0.0; 2]);
        let place = |k: usize, at: [f64; 2]| {
            let theta = length * integrals[k];
            let (sin, cos) = libm::sincos(theta);
            CurvePlace { at, along: [cos, sin], curvature: values[k] }
        };
        self.places.push(place(0, at));
        for k in 0..basis.panels {
            let last = self.motions.len() - n - 1;
            self.motions.extend_from_within(last..);
            let now = last + n + 1;
            for (g, (_, weight)) in GAUSS_LEGENDRE.iter().enumerate() {
                let inner = &basis.inner[(4 * k + g) * n..(4 * k + g + 1) * n];
                let angle = angles[4 * k + g];
                let (sin, cos) = libm::sincos(length * angle);
                let w = weight * step;
                at = [at[0] + w * length * cos, at[1] + w * length * sin];
                stretch = [
                    stretch[0] + w * (cos - length * angle * sin),
                    stretch[1] + w * (sin + length * angle * cos),
                ];
                let (u, v) = (-w * length * length * sin, w * length * length * cos);
                for (m, k) in self.motions[now + 1..].iter_mut().zip(inner) {
                    *m = [m[0] + u * k, m[1] + v * k];
                }
            }
            self.motions[now] = stretch;
            self.places.push(place(k + 1, at));
            self.quintics.push(quintic(&self.places[k], &self.places[k + 1], length * step));
        }
        self.headings.clear();
        self.headings.extend(integrals.iter().map(|k| length * k));
        self.turn = length * integrals[basis.panels];
    }

    /// The knots of the curvature, each once.
    pub(crate) fn spans(&self) -> Vec<f64> {
        let degree = degree(self.count);
        Knots::uniform(degree, self.count - degree, 0.0, 1.0).distinct()
    }

    /// The end.
    pub(super) fn end(&self) -> CurvePlace {
        self.places[self.panels]
    }

    /// Motions of the end with the length and the coefficients.
    pub(super) fn end_motions(&self) -> &[[f64; 2]] {
        &self.motions[self.panels * (self.count + 1)..]
    }

    /// How the heading of the end turns with each coefficient.
    pub(super) fn end_turns(&self) -> impl Iterator<Item = f64> + '_ {
        let basis = Basis::of(self.count);
        basis.integrals[self.panels * self.count..].iter().map(|k| self.length * k)
    }

    /// The panel around `t` and how far into it `t` is, from 0 to 1; beyond the ends, less or more.
    fn panel(&self, t: f64) -> (usize, f64) {
        let x = t * self.panels as f64;
        let k = (x.max(0.0) as usize).min(self.panels - 1);
        (k, x - k as f64)
    }

    /// The nearest place to `point` near `t`: its parameter, the place.
    pub(super) fn foot(&self, point: [f64; 2], mut t: f64) -> (f64, CurvePlace) {
        let width = self.length / self.panels as f64;
        let inverse = 1.0 / width;
        for _ in 0..4 {
            let (at, slope, curvature) = self.on_panel(t);
            let d = [point[0] - at[0], point[1] - at[1]];
            // The slope over a panel is as long as the panel, nearly: near enough for a step.
            let tangential = (d[0] * slope[0] + d[1] * slope[1]) * inverse;
            if tangential.abs() < 1e-9 * width {
                break;
            }
            let normal = (d[1] * slope[0] - d[0] * slope[1]) * inverse;
            let step = tangential / (1.0 - curvature * normal).max(0.3);
            t = (t + step.clamp(-2.0 * width, 2.0 * width) / self.length).clamp(-0.5, 1.5);
            // Newton's method squares a small error: the next step would be below the resolution.
            if tangential.abs() < 1e-3 * width {
                break;
            }
        }
        (t, self.place(t))
    }

    /// The place at `t`.
    pub(crate) fn place(&self, t: f64) -> CurvePlace {
        let (at, slope, curvature) = self.on_panel(t);
        let inverse = 1.0 / (slope[0] * slope[0] + slope[1] * slope[1]).sqrt();
        CurvePlace { at, along: [slope[0] * inverse, slope[1] * inverse], curvature }
    }

    /// The place at `t`, its derivative by the share of the panel, the curvature.
    #[inline]
    fn on_panel(&self, t: f64) -> ([f64; 2], [f64; 2], f64) {
        let (k, f) = self.panel(t);
        let q = &self.quintics[k];
        let (mut at, mut slope) = (q[5], [0.0; 2]);
        for c in q[..5].iter().rev() {
            slope = [slope[0] * f + at[0], slope[1] * f + at[1]];
            at = [at[0] * f + c[0], at[1] * f + c[1]];
        }
        (at, slope, (1.0 - f) * self.places[k].curvature + f * self.places[k + 1].curvature)
    }

    /// Motions at `t` with the length and with each coefficient, along `normal`. They are cubic between the ends of
    /// panels, where they and their rates are known, and straight beyond the ends of the piece.
    #[inline]
    pub(super) fn motions_along(&self, t: f64, normal: [f64; 2], out: &mut [f64]) {
        let (k, f) = self.panel(t);
        let basis = Basis::of(self.count);
        let width = self.count + 1;
        let (a, b) = self.motions[k * width..].split_at(width);
        let (from, to) = (&basis.integrals[k * self.count..], &basis.integrals[(k + 1) * self.count..]);
        let (p, q) = (&self.places[k], &self.places[k + 1]);
        let [u, v, m, n] = hermite(f);
        let left = |p: &CurvePlace| p.along[0] * normal[1] - p.along[1] * normal[0];
        let ahead = |p: &CurvePlace| p.along[0] * normal[0] + p.along[1] * normal[1];
        // Rates over a panel. The length moves along the direction, and turns the heading to the left. A coefficient
        // moves by the length's square and the integral of its function, to the left.
        let step = 1.0 / self.panels as f64;
        let (m, n) = (m * step, n * step);
        out[0] = u * (a[0][0] * normal[0] + a[0][1] * normal[1])
            + v * (b[0][0] * normal[0] + b[0][1] * normal[1])
            + m * (ahead(p) + self.headings[k] * left(p))
            + n * (ahead(q) + self.headings[k + 1] * left(q));
        let (m, n) = (m * self.length * self.length * left(p), n * self.length * self.length * left(q));
        let both = a[1..].iter().zip(b[1..].iter()).zip(from.iter().zip(to));
        for (o, ((a, b), (i, j))) in out[1..].iter_mut().zip(both) {
            let x = u * a[0] + v * b[0];
            let y = u * a[1] + v * b[1];
            *o = x * normal[0] + y * normal[1] + (m * i + n * j);
        }
    }
}

/// Weights of the values at the ends of a panel, and of the rates there, in a cubic over it. Beyond, they are those of
/// the straight line that goes on from it.
fn hermite(f: f64) -> [f64; 4] {
    let (g, beyond) = (f.clamp(0.0, 1.0), f - f.clamp(0.0, 1.0));
    let h = 1.0 - g;
    let rise = 6.0 * g * h;
    [
        h * h * (1.0 + 2.0 * g) - beyond * rise,
        g * g * (1.0 + 2.0 * h) + beyond * rise,
        g * h * h + beyond * h * (1.0 - 3.0 * g),
        -g * g * h + beyond * g * (1.0 - 3.0 * h),
    ]
}

/// The quintic between two places that has their directions and curvatures; `h` is the length between them.
fn quintic(a: &CurvePlace, b: &CurvePlace, h: f64) -> [[f64; 2]; 6] {
    let mut q = [[0.0; 2]; 6];
    for k in 0..2 {
        let normal = |p: &CurvePlace| if k == 0 { -p.along[1] } else { p.along[0] };
        let (v0, v1) = (h * a.along[k], h * b.along[k]);
        let (a0, a1) = (h * h * a.curvature * normal(a), h * h * b.curvature * normal(b));
        let d = b.at[k] - a.at[k];
        q[0][k] = a.at[k];
        q[1][k] = v0;
        q[2][k] = 0.5 * a0;
        q[3][k] = 10.0 * d - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1;
        q[4][k] = -15.0 * d + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1;
        q[5][k] = 6.0 * d - 3.0 * v0 - 3.0 * v1 - 0.5 * a0 + 0.5 * a1;
    }
    q
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Motions are the differences of places, within the piece and beyond its ends by a share of a panel.
    #[test]
    fn motions_are_differences_of_places() {
        let (coefficients, length) = ([0.3, -0.4, 0.9, 0.2, -0.7, 0.5], 4.0);
        let table = |coefficients: &[f64], length: f64| {
            let mut table = Table::default();
            table.fill(coefficients, length);
            table
        };
        let (own, step) = (table(&coefficients, length), 1e-5);
        for i in 0..=1000 {
            let t = f64::from(i) / 1000.0;
            let normal = [0.6, 0.8];
            let mut motions = [0.0; 7];
            own.motions_along(t, normal, &mut motions);
            for (k, motion) in motions.iter().enumerate() {
                let moved = |step: f64| {
                    let mut coefficients = coefficients;
                    if k > 0 {
                        coefficients[k - 1] += step;
                    }
                    let at = table(&coefficients, if k == 0 { length + step } else { length }).place(t).at;
                    at[0] * normal[0] + at[1] * normal[1]
                };
                let difference = (moved(step) - moved(-step)) / (2.0 * step);
                assert!((motion - difference).abs() < 1e-4, "{t} {k}: {motion} {difference}");
            }
        }
        // Straight beyond an end.
        let at = |t: f64| {
            let mut motions = [0.0; 7];
            own.motions_along(t, [0.6, 0.8], &mut motions);
            motions
        };
        let (inside, end, beyond) = (at(1.0 - 1e-7), at(1.0), at(1.02));
        for k in 0..7 {
            let slope = (end[k] - inside[k]) / 1e-7;
            assert!((beyond[k] - end[k] - 0.02 * slope).abs() < 1e-5, "{k}");
        }
    }
}

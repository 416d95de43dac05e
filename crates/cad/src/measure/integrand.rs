//! What is integrated along the border of a face: integrals across it.

use super::rule::gauss;
use crate::curve::Curve;
use crate::surface::Surface;
use crate::trim::{Piece, Trim, crossing};
use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_geom::space::{Point, cross, minus, norm};

/// Area; `x` by area; `x·n` along each axis; `x²·n/2` along each axis; `n`.
pub const TERMS: usize = 13;
type Terms = [f64; TERMS];

/// The integral across a face, from a base line to the border.
pub struct Inner<'a> {
    trim: &'a Trim,
    center: Point,
    /// The parameter that is integrated over.
    across: usize,
    /// Where it begins; an end of the window.
    base: f64,
    /// The step may not go beyond these values.
    limits: Vec<f64>,
    /// Parts of each step, and the rule for a part.
    parts: usize,
    rule: Vec<[f64; 2]>,
    /// Pieces along which the other parameter changes: ring and number.
    pub pieces: Vec<(usize, usize)>,
}

/// Places of the rule for a parameter that the surface is a polynomial of low degree in: exact up to the degree 9.
const POLYNOMIAL: usize = 5;
/// Places of the rule for a quarter of a turn: of the third harmonic less than a rounding error is missed.
const QUARTER: usize = 16;
/// Places of the rule for a span between knots.
const SPAN: usize = 10;
/// Parts of a span at most.
const MAX_PARTS: usize = 32;
/// Parts are halved until that changes less, as a share of the sum.
const SAME: f64 = 1e-13;
/// Lines on which the parts are tried.
const TRIED_LINES: usize = 7;

/// How a surface depends on one of its parameters.
enum Along {
    Polynomial,
    Harmonic,
    Knots(Vec<f64>),
}

fn along(surface: &Surface, k: usize) -> Along {
    let curve = |curve: &Curve| match curve {
        Curve::Line { .. } => Along::Polynomial,
        Curve::Circle { .. } => Along::Harmonic,
        Curve::Ellipse { .. } => Along::Knots((0..16).map(|i| 0.125 * TAU * f64::from(i)).collect()),
        other => {
            let [a, b] = other.domain();
            let mut knots = other.corners();
            knots.extend([a, b].into_iter().filter(|x| x.is_finite()));
            knots.sort_by(f64::total_cmp);
            Along::Knots(knots)
        }
    };
    match (surface, k) {
        (Surface::Plane(_), _)
        | (Surface::Cylinder { .. } | Surface::Cone { .. } | Surface::Extrusion { .. }, 1) => {
            Along::Polynomial
        }
        (Surface::Extrusion { curve: c, .. }, _) => curve(c),
        (Surface::Revolution { curve: c, .. }, 1) => curve(c),
        (Surface::Spline(nurbs), k) => Along::Knots(nurbs.knots()[k].distinct()),
        (Surface::Offset { basis, .. }, k) => match along(basis, k) {
            Along::Polynomial => Along::Knots(vec![]),
            other => other,
        },
        _ => Along::Harmonic,
    }
}

impl<'a> Inner<'a> {
    pub fn new(trim: &'a Trim, center: Point) -> Inner<'a> {
        let surface = trim.chart.surface();
        let across = match (along(surface, 0), along(surface, 1)) {
            (Along::Harmonic, Along::Knots(_)) => 0,
            (Along::Knots(u), Along::Knots(v)) if u.len() < v.len() => 0,
            _ => 1,
        };
        let [from, to] = trim.window[across];
        let (limits, count) = match along(surface, across) {
            Along::Polynomial => (vec![], POLYNOMIAL),
            Along::Harmonic => {
                ((1..5).map(|i| from + FRAC_PI_2 * f64::from(i)).filter(|x| *x < to).collect(), QUARTER)
            }
            Along::Knots(knots) => (repeated(&knots, trim, across), SPAN),
        };
        let mut pieces = vec![];
        for (i, ring) in trim.rings.iter().enumerate() {
            for (j, piece) in ring.pieces.iter().enumerate() {
                let [a, b] = piece.ends();
                let is_across = matches!(piece, Piece::Straight { .. }) && a[1 - across] == b[1 - across];
                if !is_across {
                    pieces.push((i, j));
                }
            }
        }
        // From a pole, where there is one: there the integral is 0, as it must be where the border turns around the pole.
        let poles = trim.chart.poles[across];
        let is_at = |end: usize| {
            poles[end].is_some()
                && (trim.window[across][end] - trim.chart.domain[across][end]).abs() < 1e-9 * (to - from)
        };
        let base = if is_at(1) && !is_at(0) { to } else { from };
        let mut inner = Inner { trim, center, across, base, limits, parts: 1, rule: gauss(count), pieces };
        if count == SPAN {
            inner.plan_parts();
        }
        inner
    }

    /// So many parts of a span that more change nothing.
    fn plan_parts(&mut self) {
        let [from, to] = self.trim.window[1 - self.across];
        let base = self.base;
        let end = self.trim.window[self.across].into_iter().find(|x| *x != base).unwrap_or(base);
        let lines: Vec<f64> =
            (0..TRIED_LINES).map(|i| from + (to - from) * (i as f64 + 0.37) / TRIED_LINES as f64).collect();
        let sums = |own: &Inner| -> Vec<Terms> { lines.iter().map(|x| own.across_to(*x, end)).collect() };
        let mut last = sums(self);
        while self.parts < MAX_PARTS {
            self.parts *= 2;
            let next = sums(self);
            // Area and flux decide; the others are as smooth.
            let is_same = last.iter().zip(&next).all(|(a, b)| (a[0] - b[0]).abs() <= SAME * b[0].abs());
            if is_same {
                self.parts /= 2;
                break;
            }
            last = next;
        }
    }

    fn at(&self, outer: f64, inner: f64) -> [f64; 2] {
        if self.across == 0 { [inner, outer] } else { [outer, inner] }
    }

    /// The terms at a place, by area of parameters.
    fn density(&self, at: [f64; 2]) -> Terms {
        let jet = self.trim.chart.jet(at);
        let n = cross(jet.first[0], jet.first[1]);
        let x = minus(jet.place, self.center);
        let size = norm(n);
        let mut out = [0.0; TERMS];
        out[0] = size;
        for k in 0..3 {
            out[1 + k] = x[k] * size;
            out[4 + k] = x[k] * n[k];
            out[7 + k] = 0.5 * x[k] * x[k] * n[k];
            out[10 + k] = n[k];
        }
        out
    }

    /// From the base to a value, on the line of the other parameter.
    fn across_to(&self, outer: f64, to: f64) -> Terms {
        let mut sum = [0.0; TERMS];
        let (low, high, sense) = if to >= self.base { (self.base, to, 1.0) } else { (to, self.base, -1.0) };
        let mut from = low;
        let inside = self.limits.iter().copied().filter(|x| *x > low && *x < high).chain([high]);
        for limit in inside {
            let width = (limit - from) / self.parts as f64;
            for part in 0..self.parts {
                let middle = from + width * (part as f64 + 0.5);
                for [x, w] in &self.rule {
                    let own = self.density(self.at(outer, middle + 0.5 * width * x));
                    (0..TERMS).for_each(|n| sum[n] += 0.5 * width * w * own[n]);
                }
            }
            from = limit;
        }
        sum.map(|s| sense * s)
    }

    /// What is integrated along a piece, at a share of the way.
    pub fn along(&self, piece: &Piece, share: f64) -> Terms {
        let (at, rate) = piece.moving(&self.trim.chart, &self.trim.spans, share);
        let (outer, inner) = (1 - self.across, self.across);
        // With the inside on the left, `∮ F dv` is above 0 and `∮ G du` below.
        let rate = if inner == 0 { rate[outer] } else { -rate[outer] };
        if rate == 0.0 {
            return [0.0; TERMS];
        }
        self.across_to(at[outer], at[inner]).map(|x| rate * x)
    }

    /// Shares of a piece, from 0 to 1, between which the integrand is smooth: corners of the edge, and knots of the surface.
    pub fn breaks(&self, piece: &Piece) -> Vec<f64> {
        let outer = 1 - self.across;
        let mut shares = vec![0.0, 1.0];
        let surface = self.trim.chart.surface();
        let knots = match along(surface, outer) {
            Along::Knots(knots) => repeated(&knots, self.trim, outer),
            _ => vec![],
        };
        match piece {
            Piece::Straight { ends: [a, b], .. } => {
                shares.extend(knots.iter().map(|x| (x - a[outer]) / (b[outer] - a[outer])));
            }
            Piece::Edge(strand) => {
                let [from, to] = strand.shares();
                let span = &self.trim.spans[strand.slot];
                let [first, last] = span.range;
                let corners = span.curve.corners().into_iter().map(|t| (t - first) / (last - first));
                shares.extend(corners.map(|s| (s - from) / (to - from)));
                for w in strand.samples.windows(2) {
                    let (a, b) = (w[0].at[outer], w[1].at[outer]);
                    for x in knots.iter().filter(|x| (**x > a) != (**x > b)) {
                        let between = [w[0].share, w[1].share];
                        let (share, _) = crossing(strand, (&self.trim.chart, span), between, (outer, *x));
                        shares.push((share - from) / (to - from));
                    }
                }
                // A curve that turns much is better begun in parts.
                let n = strand.samples.len() - 1;
                shares.extend((8..n).step_by(8).map(|i| (strand.samples[i].share - from) / (to - from)));
            }
        }
        shares.retain(|s| (0.0..=1.0).contains(s));
        shares.sort_by(f64::total_cmp);
        shares.dedup_by(|a, b| *a - *b < 1e-9);
        if let Some(last) = shares.last_mut() {
            *last = 1.0;
        }
        shares
    }
}

/// Knots within the window, where they repeat in all periods.
fn repeated(knots: &[f64], trim: &Trim, k: usize) -> Vec<f64> {
    let [from, to] = trim.window[k];
    let mut all: Vec<f64> = match trim.chart.periods[k] {
        None => knots.to_vec(),
        Some(period) => {
            let turns = |x: f64| ((from - x) / period).ceil();
            knots.iter().flat_map(|x| [0.0, 1.0].map(|n| x + period * (turns(*x) + n))).collect()
        }
    };
    all.retain(|x| *x > from && *x < to);
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

//! Edges in the parameters of a surface.

use super::chart::{Chart, Side};
use crate::curve::Span;
use trueness_geom::space::{Point, dot, minus, norm};

/// A place of an edge, with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Share of the way along the edge, from its own start.
    pub share: f64,
    /// Parameters, without jumps from one sample to the next.
    pub at: [f64; 2],
    /// How far the edge, up to the next sample, may lie from the straight line between both, in parameters.
    pub band: [f64; 2],
}

/// A part of an edge in the parameters of a surface, in the direction of its loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Strand {
    /// The edge.
    pub edge: u32,
    /// The place of its curve among those of the trim.
    pub slot: usize,
    /// Places so dense that the edge between two of them is nearly straight.
    pub samples: Vec<Sample>,
    /// The pole that it begins or ends at.
    pub poles: [Option<Side>; 2],
}

/// An edge with what its parameters are found by.
#[derive(Clone, Copy)]
pub struct Sampler<'a> {
    pub chart: &'a Chart,
    pub span: &'a Span,
    pub edge: u32,
    pub slot: usize,
    /// A place nearer than that to a pole is the pole.
    pub reach: f64,
}

/// A sample before poles part the edge.
#[derive(Clone, Copy)]
struct Raw {
    share: f64,
    place: Point,
    at: [f64; 2],
    pole: Option<Side>,
}

/// Halvings between two first samples at most: what turns faster is a corner, or goes past a pole.
const MAX_HALVINGS: usize = 24;
/// First samples of a curve without knots.
const FIRST_SAMPLES: usize = 8;
/// Distance of the middle of an edge's part from its chord, as a share of the chord, that calls for halving.
const MAX_BULGE: f64 = 0.02;
/// Steps over a period that leave no doubt about the way around.
const MAX_TURN: f64 = 0.125;
/// The distance at the middle of a chord is three quarters of the greatest one or more, where the third derivative adds no more than
/// half of what the second one does.
const BAND_OF_BULGE: f64 = 1.5;

impl Sampler<'_> {
    fn place(&self, share: f64) -> Point {
        self.span.derivatives(share)[0]
    }

    fn raw(&self, share: f64, near: Option<[f64; 2]>) -> Raw {
        let place = self.place(share);
        let pole = self.chart.pole(place, self.reach, near);
        let mut at = match (pole, near) {
            (Some(_), Some(near)) => near,
            _ => self.chart.parameters(place, near),
        };
        if let Some((k, end)) = pole {
            at[k] = self.chart.domain[k][end];
        }
        Raw { share, place, at, pole }
    }

    /// The strands of an edge from its first share to its last: one, or several that meet at poles.
    pub fn strands(&self, reversed: bool, near: Option<[f64; 2]>) -> Vec<Strand> {
        let mut shares = self.first_shares();
        if reversed {
            shares.reverse();
        }
        let mut first = self.raw(shares[0], near);
        if first.pole.is_some() {
            // The parameter along the pole is the one that the edge leaves it with.
            let along = self.raw(shares[0] + 0.5 * (shares[1] - shares[0]), near);
            first.pole = self.chart.pole(first.place, self.reach, Some(along.at));
            let (k, end) = first.pole.unwrap_or_default();
            first.at = along.at;
            first.at[k] = self.chart.domain[k][end];
        }
        let mut all = vec![first];
        for share in &shares[1..] {
            let last = all[all.len() - 1];
            let next = self.raw(*share, Some(last.at));
            self.refine(last, next, MAX_HALVINGS, &mut all);
        }
        self.parted(all)
    }

    /// Shares to begin with: the ends, the knots, and some between.
    fn first_shares(&self) -> Vec<f64> {
        let [from, to] = self.span.range;
        let mut shares: Vec<f64> = (0..=FIRST_SAMPLES).map(|i| i as f64 / FIRST_SAMPLES as f64).collect();
        let knots = self.span.curve.corners();
        shares.extend(knots.iter().map(|t| (t - from) / (to - from)).filter(|s| *s > 0.0 && *s < 1.0));
        shares.sort_by(f64::total_cmp);
        shares.dedup_by(|a, b| *a - *b < 1e-12);
        shares
    }

    /// Adds samples up to `b`, so many that nothing between them is missed.
    fn refine(&self, a: Raw, b: Raw, depth: usize, all: &mut Vec<Raw>) {
        // A pole takes the parameter along it from its neighbor.
        let b = match (a.pole, b.pole) {
            (_, None) | (None, Some(_)) => b,
            (Some(_), Some((k, end))) => {
                let mut at = a.at;
                at[k] = self.chart.domain[k][end];
                Raw { at, ..b }
            }
        };
        let middle = self.raw(0.5 * (a.share + b.share), Some(halfway(a.at, b.at)));
        let middle = if a.pole.is_some() && middle.pole.is_none() {
            // The other side of a pole may lie anywhere around it.
            Raw { at: self.chart.beside(middle.at, a.at), ..middle }
        } else {
            middle
        };
        let b = if b.pole.is_none() { Raw { at: self.chart.beside(b.at, middle.at), ..b } } else { b };
        if depth == 0 || self.is_fine(&a, &middle, &b) {
            all.push(b);
            return;
        }
        self.refine(a, middle, depth - 1, all);
        let middle = all[all.len() - 1];
        let b = if b.pole.is_none() {
            Raw { at: self.chart.beside(b.at, middle.at), ..b }
        } else {
            self.raw(b.share, Some(middle.at))
        };
        self.refine(middle, b, depth - 1, all);
    }

    /// Whether the edge between two samples is nearly straight, in parameters and in space.
    fn is_fine(&self, a: &Raw, m: &Raw, b: &Raw) -> bool {
        if norm(minus(b.place, a.place)).max(norm(minus(m.place, a.place))) <= self.reach {
            return true;
        }
        if a.pole.is_some() || b.pole.is_some() {
            // At a pole the other parameter has no size: the edge must leave it straight.
            return m.pole.is_none()
                && (0..2).all(|k| {
                    self.chart.periods[k].is_none() || {
                        let far = if a.pole.is_some() { b.at[k] } else { a.at[k] };
                        (m.at[k] - far).abs() < 1e-3
                    }
                });
        }
        let turns = |k: usize| {
            self.chart.periods[k].is_some_and(|p| {
                (b.at[k] - m.at[k]).abs().max((m.at[k] - a.at[k]).abs()) > 0.5 * MAX_TURN * p
            })
        };
        if turns(0) || turns(1) {
            return false;
        }
        let sizes = self.chart.jet(m.at).first.map(norm);
        let length = |d: [f64; 2]| libm::hypot(sizes[0] * d[0], sizes[1] * d[1]);
        length(bulge([a.at, m.at, b.at], sizes)) <= MAX_BULGE * length([b.at[0] - a.at[0], b.at[1] - a.at[1]])
    }

    /// Cuts at poles in between, and bounds the distance from the chords.
    fn parted(&self, raw: Vec<Raw>) -> Vec<Strand> {
        let mut strands: Vec<Strand> = vec![];
        let mut own: Vec<Raw> = vec![];
        let last = raw.len() - 1;
        for (i, sample) in raw.iter().enumerate() {
            own.push(*sample);
            let parts = i == last || (i > 0 && sample.pole.is_some());
            if parts && own.len() > 1 {
                // Samples that all lie at the pole are no edge.
                if own.iter().any(|s| s.pole.is_none()) {
                    strands.push(self.strand(&mut own));
                }
                own = vec![*sample];
            }
        }
        strands
    }

    fn strand(&self, own: &mut [Raw]) -> Strand {
        let n = own.len();
        for (end, beside) in [(0, 1), (n - 1, n - 2)] {
            if let Some((k, side)) = own[end].pole {
                own[end].at = own[beside].at;
                own[end].at[k] = self.chart.domain[k][side];
            }
        }
        let sample = |i: usize| {
            let (a, b) = (own[i], own[(i + 1).min(n - 1)]);
            let m = self.chart.parameters(self.place(0.5 * (a.share + b.share)), Some(halfway(a.at, b.at)));
            let sizes = self.chart.jet(m).first.map(norm);
            let band = if i + 1 < n {
                bulge([a.at, m, b.at], sizes).map(|x| BAND_OF_BULGE * x.abs())
            } else {
                [0.0; 2]
            };
            Sample { share: a.share, at: a.at, band }
        };
        Strand {
            edge: self.edge,
            slot: self.slot,
            samples: (0..n).map(sample).collect(),
            poles: [own[0].pole, own[n - 1].pole],
        }
    }
}

impl Strand {
    /// Parameters at its start and its end.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.samples[0].at, self.samples[self.samples.len() - 1].at]
    }

    /// Shares of the edge at its start and its end.
    pub fn shares(&self) -> [f64; 2] {
        [self.samples[0].share, self.samples[self.samples.len() - 1].share]
    }

    /// The sample before a share, and the share of the way to the next one.
    fn locate(&self, share: f64) -> (usize, f64) {
        let [from, to] = self.shares();
        let is_before = |s: &Sample| if to > from { s.share <= share } else { s.share >= share };
        let i = self.samples.partition_point(is_before).clamp(1, self.samples.len() - 1) - 1;
        let [a, b] = [self.samples[i].share, self.samples[i + 1].share];
        (i, ((share - a) / (b - a)).clamp(0.0, 1.0))
    }

    /// Parameters at a share of the edge.
    pub fn at(&self, chart: &Chart, span: &Span, share: f64) -> [f64; 2] {
        let (i, part) = self.locate(share);
        let [a, b] = [self.samples[i].at, self.samples[i + 1].at];
        if (part == 0.0 && (i > 0 || self.poles[0].is_some())) || (part == 1.0 && self.poles[1].is_some()) {
            return if part == 0.0 { a } else { b };
        }
        let guess = [0, 1].map(|k| a[k] + part * (b[k] - a[k]));
        chart.parameters(span.derivatives(share)[0], Some(guess))
    }

    /// Parameters and their derivatives by the share of the edge. The foot of the edge on the surface moves as the edge does, up to
    /// how the surface bends over the distance between them.
    pub fn moving(&self, chart: &Chart, span: &Span, share: f64) -> ([f64; 2], [f64; 2]) {
        let at = self.at(chart, span, share);
        let [place, tangent, _] = span.derivatives(share);
        let jet = chart.jet(at);
        let off = minus(place, jet.place);
        let [du, dv] = jet.first;
        let [e, f, g] = [dot(du, du), dot(du, dv), dot(dv, dv)];
        let [uu, uv, vv] = jet.second.map(|w| dot(off, w));
        let [a, b, c] = [e - uu, f - uv, g - vv];
        let [x, y] = [dot(du, tangent), dot(dv, tangent)];
        let det = a * c - b * b;
        if det.abs() > f64::EPSILON * e * g {
            (at, [(c * x - b * y) / det, (a * y - b * x) / det])
        } else {
            (at, [if e > 0.0 { x / e } else { 0.0 }, if g > 0.0 { y / g } else { 0.0 }])
        }
    }

    /// Moves it by whole periods.
    pub fn shift(&mut self, by: [f64; 2]) {
        for sample in &mut self.samples {
            (0..2).for_each(|k| sample.at[k] += by[k]);
        }
    }

    /// Both parts at a share between two samples, where the parameters are `at`.
    pub fn split(&self, share: f64, at: [f64; 2]) -> [Strand; 2] {
        let (i, _) = self.locate(share);
        let cut = Sample { share, at, band: self.samples[i].band };
        let mut first = self.samples[..=i].to_vec();
        first.push(Sample { band: [0.0; 2], ..cut });
        let mut second = vec![cut];
        second.extend_from_slice(&self.samples[i + 1..]);
        [
            Strand { edge: self.edge, slot: self.slot, samples: first, poles: [self.poles[0], None] },
            Strand { edge: self.edge, slot: self.slot, samples: second, poles: [None, self.poles[1]] },
        ]
    }
}

/// The share at which a parameter of a strand has a value, between two shares on whose sides it lies on different sides of it.
pub fn crossing(
    strand: &Strand,
    (chart, span): (&Chart, &Span),
    [mut low, mut high]: [f64; 2],
    (k, value): (usize, f64),
) -> (f64, [f64; 2]) {
    let [start, end] = [low, high].map(|s| strand.at(chart, span, s)[k]);
    let is_past = |x: f64| if end > start { x > value } else { x < value };
    let mut middle = 0.5 * (low + high);
    // The bits of a share.
    for _ in 0..60 {
        middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        if is_past(strand.at(chart, span, middle)[k]) { high = middle } else { low = middle }
    }
    let mut at = strand.at(chart, span, middle);
    at[k] = value;
    (middle, at)
}

fn halfway(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

/// How far the middle of three places is from the line through the others, along both parameters. Where it lies along that line says
/// nothing of its form; what is at right angles to it depends on the sizes of the parameters.
fn bulge([a, m, b]: [[f64; 2]; 3], sizes: [f64; 2]) -> [f64; 2] {
    let [chord, off] = [b, m].map(|p| [p[0] - a[0], p[1] - a[1]]);
    let product = |p: [f64; 2], q: [f64; 2]| (0..2).map(|k| sizes[k] * sizes[k] * p[k] * q[k]).sum::<f64>();
    let square = product(chord, chord);
    let share = if square > 0.0 { (product(off, chord) / square).clamp(0.0, 1.0) } else { 0.0 };
    [off[0] - share * chord[0], off[1] - share * chord[1]]
}

/// Distance of an edge from its surface at its samples.
pub fn gap(strand: &Strand, chart: &Chart, span: &Span) -> f64 {
    let off = |s: &Sample| norm(minus(span.derivatives(s.share)[0], chart.place(s.at)));
    strand.samples.iter().map(off).fold(0.0, f64::max)
}

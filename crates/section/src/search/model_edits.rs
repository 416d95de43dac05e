//! The model that others are built on, with its points along it, or two that follow each other. Also the models one
//! step from it.

use crate::model::chain::{Chain, SegmentKind};
use crate::model::criterion::{Model, PieceSpec};
use crate::model::free;
use crate::model::least::State;

/// Samples of the curvature to a coefficient of a free piece.
const SAMPLES_PER_COEFFICIENT: usize = 4;
/// Shares of a free piece that go to a line or arc beside it.
const HANDED_OVER_SHARES: [f64; 3] = [0.05, 0.12, 0.3];
/// Fewest points to a coefficient of a free piece over two.
const MIN_POINTS_PER_COEFFICIENT: usize = 2;
/// A model with the places of its joins and points along it.
pub(crate) struct PlacedModel {
    pub model: Model,
    pub stations: Vec<f64>,
    /// Lengths to the points, in the order of the chain.
    pub order: Vec<f64>,
    pub specs: Vec<PieceSpec>,
    /// Where two chains follow each other, and how far the row turns there.
    seam: Option<(f64, f64)>,
    /// How far short arcs along the points turn from the start to each end; else empty.
    turns: Vec<f64>,
}

impl PlacedModel {
    /// A model with the lengths from its start to the feet of all points.
    pub fn new(model: Model, all: &[f64]) -> PlacedModel {
        let n = all.len();
        let first = model.state.breaks[0];
        let mut order: Vec<f64> = (0..n).map(|i| all[(first + i) % n]).collect();
        rising(&mut order);
        let stations = model.state.chain.stations();
        let specs = specs(&model.state.chain, &stations);
        PlacedModel { model, stations, order, specs, seam: None, turns: vec![] }
    }

    /// Two chains of a row as one, whose order along each is given, with a `turn` and a `gap` from one to the next. It is none that runs along the
    /// points: models are to be built on it.
    pub fn of_both([a, b]: [(&State, Vec<f64>); 2], turn: f64, gap: f64) -> PlacedModel {
        let ((first, mut order), (second, after)) = (a, b);
        let mut pieces = first.chain.pieces.clone();
        let (n, last) = (first.feet.len(), pieces.len() - 1);
        let mut lengths = [order.last(), after.first()].map(|s| s.copied().unwrap_or(0.0));
        let before: f64 = pieces[..last].iter().map(|p| p.length).sum();
        // Both end in the middle between their points.
        lengths = [lengths[0] + 0.5 * gap, lengths[1] - 0.5 * gap];
        let whole = lengths[0].max(before + gap);
        pieces[last].length = whole - before;
        order.extend(after.iter().map(|s| s - lengths[1] + whole));
        pieces.extend(second.chain.pieces.iter().cloned());
        pieces[last + 1].length = (pieces[last + 1].length - lengths[1]).max(gap);
        rising(&mut order);
        let chain = Chain { pieces, ..first.chain.clone() };
        let feet = first.feet.iter().chain(&second.feet).copied().collect();
        let breaks = first.breaks.iter().copied().chain(second.breaks[1..].iter().map(|b| b + n)).collect();
        let stations = chain.stations();
        let specs = specs(&chain, &stations);
        let state = State { chain, breaks, feet, sum: 0.0 };
        PlacedModel {
            model: Model { state, cost: f64::INFINITY },
            stations,
            order,
            specs,
            seam: Some((whole, turn)),
            turns: vec![],
        }
    }

    /// Short arcs along the points, which lie in this order, with plans of other pieces.
    pub fn of_arcs(model: Model, stations: Vec<f64>, order: Vec<f64>, specs: Vec<PieceSpec>) -> PlacedModel {
        let mut order = order;
        rising(&mut order);
        let mut turns = vec![0.0];
        for (k, arc) in model.state.chain.pieces.iter().enumerate() {
            turns.push(turns[k] + arc.length * arc.curvature(0.0));
        }
        PlacedModel { model, stations, order, specs, seam: None, turns }
    }

    /// Coefficients of a free piece: nearly those with the curvature of the pieces there (least squares), so that it
    /// turns as much as they do. Between two chains they are the mean curvature about each of its places, and at the
    /// seam the turn there.
    pub fn coefficients(&self, spec: &PieceSpec) -> Vec<f64> {
        if self.seam.is_none() {
            let cells = SAMPLES_PER_COEFFICIENT * spec.count;
            let ends = |i: usize| spec.from + (spec.to - spec.from) * i as f64 / cells as f64;
            let all: Vec<f64> = (0..cells).map(|i| self.mean_curvature(ends(i), ends(i + 1))).collect();
            return free::near(spec.count, &all);
        }
        let chain = &self.model.state.chain;
        let width = (spec.to - spec.from) / (2.0 * spec.count as f64);
        let at: Vec<f64> =
            free::places(spec.count).iter().map(|t| spec.from + t * (spec.to - spec.from)).collect();
        let around = |s: &f64| ((s - width).max(spec.from), (s + width).min(spec.to));
        let mean = |s: &f64| {
            let (a, b) = around(s);
            chain.mean_curvature(&self.stations, a, b)
        };
        let mut all: Vec<f64> = at.iter().map(mean).collect();
        let inside = |seam: &(f64, f64)| spec.from < seam.0 && seam.0 < spec.to;
        if let Some((seam, turn)) = self.seam.filter(inside) {
            let off = |k: &usize| (at[*k] - seam).abs();
            let nearest = (0..at.len()).min_by(|j, k| off(j).total_cmp(&off(k))).unwrap_or(0);
            let (a, b) = around(&at[nearest]);
            all[nearest] += turn / (b - a);
        }
        all
    }

    /// Mean curvature over a part. It is exact for short arcs, so that the turns of free pieces do not add up to
    /// something else.
    fn mean_curvature(&self, from: f64, to: f64) -> f64 {
        if self.turns.is_empty() {
            return self.model.state.chain.mean_curvature(&self.stations, from, to);
        }
        let turn = |s: f64| {
            let k = self.stations.partition_point(|x| *x <= s).clamp(1, self.stations.len() - 1);
            let share = (s - self.stations[k - 1]) / (self.stations[k] - self.stations[k - 1]);
            self.turns[k - 1] + share * (self.turns[k] - self.turns[k - 1])
        };
        (turn(to) - turn(from)) / (to - from)
    }

    /// The chains as they are, tangent to each other; then one line or arc where they meet. Then come a line or an arc
    /// beside the corner, which a free piece around it may hide, and one free piece there.
    pub fn joined(&self, first: usize) -> Vec<Vec<PieceSpec>> {
        use SegmentKind::{Arc, Line, Spline};
        let [a, b] = [self.specs[first], self.specs[first + 1]];
        let most = (a.count + b.count).clamp(2, free::MAX_COEFFICIENTS);
        let with = |new: &[PieceSpec]| [&self.specs[..first], new, &self.specs[first + 2..]].concat();
        let over = |kind, count| with(&[PieceSpec { kind, count, from: a.from, to: b.to }]);
        let plain = [(Line, 0), (Arc, 1)];
        let both = plain.map(|(kind, count)| over(kind, count));
        let before = plain.map(|(kind, count)| with(&[PieceSpec { kind, count, ..a }, b]));
        let after = plain.map(|(kind, count)| with(&[a, PieceSpec { kind, count, ..b }]));
        let own = self.model.state.breaks[first + 2] - self.model.state.breaks[first];
        let counts =
            [3, 4, 6, 8, 12, most].into_iter().filter(|count| MIN_POINTS_PER_COEFFICIENT * count <= own);
        let free = counts.map(|count| over(Spline, count));
        std::iter::once(self.specs.clone()).chain(both).chain(before).chain(after).chain(free).collect()
    }

    /// Every model one step away: as lists of plans.
    pub fn changes(&self, kinds: [bool; 2], spacing: f64) -> Vec<Vec<PieceSpec>> {
        let specs = &self.specs[..];
        let mut all = vec![];
        let n = specs.len();
        let replace = |i: usize, j: usize, new: &[PieceSpec]| [&specs[..i], new, &specs[j + 1..]].concat();
        let [arcs, splines] = kinds;
        let allowed = |kind: SegmentKind| match kind {
            SegmentKind::Line => true,
            SegmentKind::Arc => arcs,
            SegmentKind::Spline => splines,
        };
        let mut one = |i: usize, j: usize, kind: SegmentKind, count: usize| {
            let spec = PieceSpec { kind, count, from: specs[i].from, to: specs[j].to };
            if allowed(kind) {
                all.push(replace(i, j, &[spec]));
            }
        };
        for i in 0..n {
            match specs[i].kind {
                SegmentKind::Line => one(i, i, SegmentKind::Arc, 1),
                SegmentKind::Arc => one(i, i, SegmentKind::Line, 0),
                SegmentKind::Spline => {
                    one(i, i, SegmentKind::Line, 0);
                    one(i, i, SegmentKind::Arc, 1);
                }
            }
            if specs[i].kind == SegmentKind::Spline {
                let count = specs[i].count;
                for more in [count.wrapping_sub(1), count + 1, count + 2, count + count / 2 + 1] {
                    if (2..=free::MAX_COEFFICIENTS).contains(&more) {
                        one(i, i, SegmentKind::Spline, more);
                    }
                }
            } else {
                [2, 3, 4, 5, 6].into_iter().for_each(|count| one(i, i, SegmentKind::Spline, count));
            }
            if i + 1 < n {
                one(i, i + 1, SegmentKind::Line, 0);
                one(i, i + 1, SegmentKind::Arc, 1);
                [3, 4, 6, 8].into_iter().for_each(|count| one(i, i + 1, SegmentKind::Spline, count));
                let most = specs[i].count.max(specs[i + 1].count);
                let both = specs[i].count + specs[i + 1].count;
                if most > 1 {
                    [most + 2, both]
                        .into_iter()
                        .filter(|c| *c <= free::MAX_COEFFICIENTS)
                        .for_each(|c| one(i, i + 1, SegmentKind::Spline, c));
                }
            }
        }
        for (i, j) in runs(specs) {
            if j > i + 1 {
                let longest = (j - i + 3).min(free::MAX_COEFFICIENTS);
                [3, 4, 5, 6, 8, 10].into_iter().for_each(|count| one(i, j, SegmentKind::Spline, count));
                if longest > 10 {
                    one(i, j, SegmentKind::Spline, longest);
                }
            }
        }
        for i in 0..n {
            splits(i, specs, kinds[0], spacing, &mut all);
            shorter(i, specs, spacing, &mut all);
        }
        all
    }
}

/// A free piece beside a line or arc with a part of it given to this, and fewer coefficients. It may have them only to
/// follow that.
fn shorter(i: usize, specs: &[PieceSpec], spacing: f64, all: &mut Vec<Vec<PieceSpec>>) {
    let spec = specs[i];
    let width = spec.to - spec.from;
    if spec.kind != SegmentKind::Spline || spec.count < 3 || width < 8.0 * spacing {
        return;
    }
    let is_simple = |k: &usize| specs.get(*k).is_some_and(|p| p.kind != SegmentKind::Spline);
    let neighbors = [i.checked_sub(1).filter(is_simple), Some(i + 1).filter(is_simple)];
    for (k, other) in neighbors.into_iter().enumerate() {
        let Some(other) = other else { continue };
        for share in HANDED_OVER_SHARES {
            let at = if k == 0 { spec.from + share * width } else { spec.to - share * width };
            for count in [2, spec.count / 2 + 1, part_of(spec.count, 1.0 - share), spec.count - 1]
                .into_iter()
                .filter(|c| *c < spec.count)
            {
                let mut new = specs.to_vec();
                new[i].count = count;
                if k == 0 {
                    (new[other].to, new[i].from) = (at, at);
                } else {
                    (new[other].from, new[i].to) = (at, at);
                }
                all.push(new);
            }
        }
    }
}

/// Coefficients of a part of a piece that has so many: as many to a length.
fn part_of(count: usize, share: f64) -> usize {
    ((share * count as f64).ceil() as usize).max(2)
}

/// A piece cut in two.
fn splits(i: usize, specs: &[PieceSpec], arcs: bool, spacing: f64, all: &mut Vec<Vec<PieceSpec>>) {
    use SegmentKind::{Arc, Line, Spline};
    let spec = specs[i];
    let width = spec.to - spec.from;
    if width < 8.0 * spacing {
        return;
    }
    let ways: &[(SegmentKind, SegmentKind, f64)] = match spec.kind {
        Spline => &[
            (Line, Spline, 0.12),
            (Line, Spline, 0.25),
            (Line, Spline, 0.4),
            (Spline, Line, 0.88),
            (Spline, Line, 0.75),
            (Spline, Line, 0.6),
            (Arc, Spline, 0.3),
            (Spline, Arc, 0.7),
            (Line, Arc, 0.3),
            (Line, Arc, 0.5),
            (Arc, Line, 0.5),
            (Arc, Line, 0.7),
        ],
        Arc => &[(Line, Arc, 0.3), (Line, Arc, 0.5), (Arc, Line, 0.5), (Arc, Line, 0.7), (Arc, Arc, 0.5)],
        Line => &[(Line, Arc, 0.5), (Line, Arc, 0.75), (Arc, Line, 0.25), (Arc, Line, 0.5)],
    };
    for (a, b, share) in ways {
        let at = spec.from + share * width;
        if [*a, *b].contains(&Arc) && !arcs {
            continue;
        }
        // A free piece that lost a part needs fewer coefficients.
        let left = if *a == Spline { *share } else { 1.0 - share };
        let fewer = [spec.count / 2 + 1, part_of(spec.count, left)];
        let fewer = fewer.into_iter().filter(|_| spec.count > 4 && [*a, *b].contains(&Spline));
        for free in std::iter::once(spec.count.max(2)).chain(fewer) {
            let count = |kind: SegmentKind| match kind {
                Line => 0,
                Arc => 1,
                Spline => free,
            };
            let first = PieceSpec { kind: *a, count: count(*a), from: spec.from, to: at };
            let second = PieceSpec { kind: *b, count: count(*b), from: at, to: spec.to };
            all.push([&specs[..i], &[first, second], &specs[i + 1..]].concat());
        }
    }
}

/// The plans of a chain's own pieces.
fn specs(chain: &Chain, stations: &[f64]) -> Vec<PieceSpec> {
    let each = chain.pieces.iter().zip(stations.windows(2));
    each.map(|(p, w)| PieceSpec { kind: p.kind, count: p.coefficients.len(), from: w[0], to: w[1] }).collect()
}

/// Noise may swap neighbors; the order of the row stands.
fn rising(order: &mut [f64]) {
    let mut greatest = f64::NEG_INFINITY;
    for s in order {
        greatest = greatest.max(*s);
        *s = greatest;
    }
}

/// First and last of each run of pieces that are no lines.
fn runs(specs: &[PieceSpec]) -> Vec<(usize, usize)> {
    let mut all = vec![];
    let mut start = None;
    for (i, spec) in specs.iter().enumerate() {
        match (spec.kind, start) {
            (SegmentKind::Line, Some(from)) => {
                all.push((from, i - 1));
                start = None;
            }
            (SegmentKind::Line, None) => {}
            (_, None) => start = Some(i),
            _ => {}
        }
    }
    all.extend(start.map(|from| (from, specs.len() - 1)));
    all
}

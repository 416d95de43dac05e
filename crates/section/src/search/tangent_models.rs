//! Models that a search begins with: the lines and arcs of a first partition, joined with a common tangent.

use super::near::mended;
use super::parts::Part;
use super::rounds::Search;
use crate::model::chain::{Chain, Ends, Piece, SegmentKind, arc_over};
use crate::model::criterion::Model;
use crate::model::flat::angle;
use crate::model::least::{State, Stop};

/// Fewest parts whose headings may add up to one far off.
const MIN_PARTS_TO_CORRECT: usize = 3;
/// Times that long chains are mended, of which pieces have lost their points.
const MAX_MENDINGS: usize = 6;
/// Two parts touch each other no farther from the middle between their points than so many times the distance of these.
const MAX_TOUCHING_GAPS: f64 = 4.0;

impl Search<'_> {
    /// The cheapest model of the parts that dynamic programming found. One has the curvatures and lengths that they
    /// have by themselves. Where the headings of many add up to one far off, parts are lost on the way back. So another
    /// turns from one part to the next as they do by themselves. A third goes from join to join as lines and arcs by
    /// themselves tell these.
    pub fn first(&mut self, parts: &[Part], closed: bool) -> Model {
        let plain = self.plain(parts, closed);
        self.cheapest(plain, parts, closed)
    }

    /// The model of the parts with the curvatures and lengths that they have by themselves.
    pub fn plain(&mut self, parts: &[Part], closed: bool) -> Model {
        let lengths = self.lengths(parts, closed);
        let part = &parts[0];
        let heading = libm::atan2(part.along[1], part.along[0]) - 0.5 * part.curvature * lengths[0];
        let own: Vec<f64> = parts.iter().map(|p| p.curvature).collect();
        self.first_of(parts, &lengths, &own, heading, closed)
    }

    /// That one, or a cheaper one of the same parts.
    pub fn cheapest(&mut self, plain: Model, parts: &[Part], closed: bool) -> Model {
        let mut best = plain;
        if parts.len() < MIN_PARTS_TO_CORRECT {
            return best;
        }
        let bent = without_bends(parts);
        let fewer = (bent.len() < parts.len()).then_some(&bent[..]);
        for parts in std::iter::once(parts).chain(fewer) {
            for lengths in [Some(self.lengths(parts, closed)), self.lengths_between_joins(parts, closed)] {
                let Some(lengths) = lengths else { continue };
                let (heading, turning) = self.turning(parts, &lengths);
                let other = self.first_of(parts, &lengths, &turning, heading, closed);
                if other.cost < best.cost {
                    best = other;
                }
            }
        }
        best
    }

    /// Lengths of parts between the places where they touch each other; `None` where two do not near the row.
    fn lengths_between_joins(&self, parts: &[Part], closed: bool) -> Option<Vec<f64>> {
        let (points, m) = (self.row.points, parts.len());
        let n = points.len();
        let join = |k: usize| {
            let (a, b) = (&parts[k], &parts[(k + 1) % m]);
            let ends = [points[(a.to - 1) % n], points[b.from % n]];
            let near = [0, 1].map(|k| 0.5 * (ends[0][k] + ends[1][k]));
            let at = touching(a, b, near)?;
            let reach = MAX_TOUCHING_GAPS
                * libm::hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]).max(self.spacing);
            (libm::hypot(at[0] - near[0], at[1] - near[1]) <= reach).then_some(at)
        };
        let (first, last) = (points[parts[0].from % n], points[(parts[m - 1].to - 1) % n]);
        let mut places = vec![first];
        for k in 0..m - 1 {
            places.push(join(k)?);
        }
        places.push(if closed { first } else { last });
        let length = |(part, w): (&Part, &[[f64; 2]])| {
            let d = [w[1][0] - w[0][0], w[1][1] - w[0][1]];
            let way = if part.kind == SegmentKind::Line {
                part.along[0] * d[0] + part.along[1] * d[1]
            } else {
                angle(part.heading(w[0]), part.heading(w[1])).abs() / part.curvature.abs()
            };
            way.max(self.shortest * self.spacing)
        };
        Some(parts.iter().zip(places.windows(2)).map(length).collect())
    }

    /// Lengths of parts: chords of a smoothed row, as noise makes the row itself longer.
    fn lengths(&self, parts: &[Part], closed: bool) -> Vec<f64> {
        let points = self.row.points;
        let n = points.len();
        let chord = |i: usize, j: usize| {
            libm::hypot(points[j % n][0] - points[i % n][0], points[j % n][1] - points[i % n][1])
        };
        let length = |(g, part): (usize, &Part)| {
            let (from, to) = (part.from, part.to + usize::from(g + 1 < parts.len() || closed));
            let stride = ((to - from) / 6).max(1);
            let (mut i, mut length) = (from, 0.0);
            while i < to - 1 {
                let j = (i + stride).min(to - 1);
                length += arc_over(chord(i, j), part.curvature);
                i = j;
            }
            length.max(2.0 * self.spacing)
        };
        parts.iter().enumerate().map(length).collect()
    }

    /// The heading at the start, and curvatures with which parts of these lengths turn from one to the next as the
    /// parts by themselves do. Their own curvatures do not count: lines tell where the arcs beside them begin and end.
    fn turning(&self, parts: &[Part], lengths: &[f64]) -> (f64, Vec<f64>) {
        let points = self.row.points;
        let (n, last) = (points.len(), parts.len() - 1);
        let angle = |part: &Part, i: usize| {
            let [x, y] = part.heading(points[i % n]);
            libm::atan2(y, x)
        };
        let heading = angle(&parts[0], parts[0].from);
        let mut before = heading;
        let mut turned = |g: usize| {
            let part = &parts[g];
            let own = part.curvature * lengths[g];
            let end = angle(part, part.to - 1);
            let after = match (part.kind, parts.get(g + 1)) {
                (SegmentKind::Line, _) => angle(part, part.from),
                (_, Some(next)) if next.kind == SegmentKind::Line => angle(next, next.from),
                (_, Some(next)) => end + 0.5 * wrapped(angle(next, next.from) - end),
                (_, None) => end,
            };
            let turn = own + wrapped(after - before - own);
            before = after;
            if part.kind == SegmentKind::Line { 0.0 } else { turn / lengths[g] }
        };
        (heading, (0..=last).map(&mut turned).collect())
    }

    /// The model of parts of these lengths and curvatures.
    fn first_of(
        &mut self,
        parts: &[Part],
        lengths: &[f64],
        curvatures: &[f64],
        heading: f64,
        closed: bool,
    ) -> Model {
        let points = self.row.points;
        let n = points.len();
        let piece = |((part, length), curvature): ((&Part, &f64), &f64)| match part.kind {
            SegmentKind::Line => Piece::line(*length),
            _ => Piece::arc(*length, *curvature),
        };
        let pieces = parts.iter().zip(lengths).zip(curvatures).map(piece).collect();
        let mut breaks: Vec<usize> = parts.iter().map(|p| p.from).collect();
        breaks.push(breaks[0] + n);
        let start = points[parts[0].from % n];
        let chain = Chain { start, heading, pieces, closed: false, even: false, ends: Ends::default() };
        let feet = vec![0.5; n];
        let mut state = State { chain, breaks, feet, sum: 0.0 };
        let stop = self.stop(60, 1e-6);
        let before = state.chain.is_long().then(|| state.clone());
        self.improved(&mut state, &stop);
        if let Some(before) = before.filter(|_| !self.is_near(&state)) {
            let mut grown = self.grown(&before);
            self.improved(&mut grown, &stop);
            if self.criterion.cost(&grown) < self.criterion.cost(&state) {
                state = grown;
            }
        }
        if closed || self.even {
            // Nearly closed by the points alone, it is closed by force.
            (state.chain.closed, state.chain.even) = (closed, self.even);
            state.breaks.iter_mut().for_each(|b| *b += if closed { n } else { 0 });
            self.work.improve(&self.row, &mut state, None, &stop);
        }
        self.model(state)
    }

    /// Improves a state; a long one is mended where pieces have lost their points.
    fn improved(&mut self, state: &mut State, stop: &Stop) {
        self.work.improve(&self.row, state, None, stop);
        for _ in 0..MAX_MENDINGS {
            let sound = mended(state);
            if !sound.chain.is_long() || sound.chain == state.chain {
                break;
            }
            *state = sound;
            self.work.improve(&self.row, state, None, stop);
        }
    }
}

/// Where two parts touch. That is the foot of an arc's center on a line, or where the line through two centers meets
/// the arcs. Two lines touch where they cross. `near` tells which of two.
fn touching(a: &Part, b: &Part, near: [f64; 2]) -> Option<[f64; 2]> {
    let center = |p: &Part| [p.center[0] - p.along[1] / p.curvature, p.center[1] + p.along[0] / p.curvature];
    let foot = |line: &Part, c: [f64; 2]| {
        let s = (c[0] - line.center[0]) * line.along[0] + (c[1] - line.center[1]) * line.along[1];
        [0, 1].map(|k| line.center[k] + s * line.along[k])
    };
    match (a.kind, b.kind) {
        (SegmentKind::Line, SegmentKind::Line) => {
            let turn = a.along[0] * b.along[1] - a.along[1] * b.along[0];
            let d = [b.center[0] - a.center[0], b.center[1] - a.center[1]];
            let s = (d[0] * b.along[1] - d[1] * b.along[0]) / turn;
            let at = [0, 1].map(|k| a.center[k] + s * a.along[k]);
            at[0].is_finite().then_some(at)
        }
        (SegmentKind::Line, _) => Some(foot(a, center(b))),
        (_, SegmentKind::Line) => Some(foot(b, center(a))),
        _ => {
            let (c, d) = (center(a), center(b));
            let way = [d[0] - c[0], d[1] - c[1]];
            let size = libm::hypot(way[0], way[1]);
            let far = |p: &[f64; 2]| libm::hypot(p[0] - near[0], p[1] - near[1]);
            let on = |c: [f64; 2], part: &Part, sign: f64| {
                [0, 1].map(|k| c[k] + sign * way[k] / (size * part.curvature.abs()))
            };
            let nearest = |c: [f64; 2], part: &Part| {
                [1.0, -1.0].map(|sign| on(c, part, sign)).into_iter().min_by(|p, q| far(p).total_cmp(&far(q)))
            };
            let (p, q) = (nearest(c, a)?, nearest(d, b)?);
            let at = [0, 1].map(|k| 0.5 * (p[k] + q[k]));
            at[0].is_finite().then_some(at)
        }
    }
}

/// The parts without lines that follow a line: of two, the shorter belongs to its other neighbor, or to the longer.
fn without_bends(parts: &[Part]) -> Vec<Part> {
    let mut all: Vec<Part> = parts.to_vec();
    let is_line = |part: Option<&Part>| part.is_some_and(|p| p.kind == SegmentKind::Line);
    while let Some(k) = (1..all.len()).find(|k| is_line(all.get(*k)) && is_line(all.get(k - 1))) {
        let count = |k: usize| all[k].to - all[k].from;
        if count(k - 1) < count(k) {
            let gone = all.remove(k - 1);
            match k.checked_sub(2) {
                Some(before) => all[before].to = gone.to,
                None => all[0].from = gone.from,
            }
        } else {
            let gone = all.remove(k);
            match all.get_mut(k) {
                Some(after) => after.from = gone.from,
                None => all[k - 1].to = gone.to,
            }
        }
    }
    all
}

/// An angle from −π to π.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}

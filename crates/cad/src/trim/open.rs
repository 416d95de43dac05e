//! Cuts a face open along a parameter that repeats.
//!
//! A surface that closes is laid into the plane by a cut at one value `c` of the parameter. All that a face crosses the cut with is
//! read off the line of the cut: edges that cross it in one direction begin an inside, those that cross it in the other one end it, and where
//! there is none before, or none after, the face reaches the pole. So faces need no seams in their loops, and which loop is the outer one
//! is never asked. For a cut along `u` the other coordinate is `y = v`, for one along `v` it is `y = −u`: both turn the same way.

use super::chart::Chart;
use super::cut::best_cut;
use super::error::TrimError;
use super::ring::{Piece, Ring, Straight};
use super::strand::crossing;
use crate::curve::Span;

/// Where a ring crosses the cut.
struct Crossing {
    /// Along the cut; within one period of it where it closes.
    y: f64,
    /// Whether the inside begins there.
    enters: bool,
    /// The arc that ends there, and the one that begins there.
    arcs: [usize; 2],
}

/// A part of a ring between two crossings.
struct Arc {
    pieces: Vec<Piece>,
    /// The crossings that it begins and ends at.
    crossings: [usize; 2],
}

/// An inside on the cut, from `y` to `y`; crossings, or the poles where there is none.
struct Inside {
    ends: [Option<usize>; 2],
    ys: [f64; 2],
}

/// A cut, and what it needs to know of the surface.
pub struct Opener<'a> {
    pub chart: &'a Chart,
    pub spans: &'a [Span],
    /// The parameter that is constant along the cut.
    pub k: usize,
    /// Its period.
    pub period: f64,
    /// The period of the other parameter, unless the face is cut open along it already.
    pub other: Option<f64>,
}

impl Opener<'_> {
    /// Where it is cut, and the rings of the face cut open: all between `c` and `c + period`, and none around.
    pub fn open(&self, rings: Vec<Ring>) -> Result<(f64, Vec<Ring>), TrimError> {
        if rings.iter().any(|r| r.winding[self.k].abs() > 1) {
            return Err(TrimError::Contradiction);
        }
        let c = best_cut(self.chart, self.k, self.period, &rings);
        let (mut whole, mut arcs, mut crossings) = (vec![], vec![], vec![]);
        for ring in rings {
            self.part(ring, c, &mut whole, &mut arcs, &mut crossings)?;
        }
        let insides = self.insides(&crossings, &whole, c)?;
        let mut out = whole;
        self.link(c, arcs, &crossings, &insides, &mut out)?;
        Ok((c, out))
    }

    fn sign(&self) -> f64 {
        if self.k == 0 { 1.0 } else { -1.0 }
    }

    fn y(&self, at: [f64; 2]) -> f64 {
        self.sign() * at[1 - self.k]
    }

    fn at(&self, x: f64, y: f64) -> [f64; 2] {
        if self.k == 0 { [x, y] } else { [-y, x] }
    }

    /// Lowest and highest `y` of the domain.
    fn ys(&self) -> [f64; 2] {
        let [a, b] = self.chart.domain[1 - self.k];
        if self.k == 0 { [a, b] } else { [-b, -a] }
    }

    /// The side at the lowest (0) or highest (1) `y`, if it is a pole.
    fn pole(&self, end: usize) -> Option<Straight> {
        let end = if self.k == 0 { end } else { 1 - end };
        self.chart.poles[1 - self.k][end].map(|_| Straight::Pole((1 - self.k, end)))
    }

    /// Cuts a ring where it crosses; a ring that does not is moved between both sides.
    fn part(
        &self,
        ring: Ring,
        c: f64,
        whole: &mut Vec<Ring>,
        arcs: &mut Vec<Arc>,
        crossings: &mut Vec<Crossing>,
    ) -> Result<(), TrimError> {
        let mut parts: Vec<Vec<Piece>> = vec![vec![]];
        let mut found: Vec<(f64, bool)> = vec![];
        for piece in ring.pieces {
            self.cut_piece(piece, c, &mut parts, &mut found);
        }
        let home = |pieces: &mut Vec<Piece>| {
            let xs: Vec<f64> = pieces.iter().flat_map(Piece::places).map(|(at, _)| at[self.k]).collect();
            let low = xs.iter().copied().fold(f64::INFINITY, f64::min);
            let high = xs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let turns = ((0.5 * (low + high) - c) / self.period).floor();
            let mut by = [0.0; 2];
            by[self.k] = -turns * self.period;
            pieces.iter_mut().for_each(|p| p.shift(by));
        };
        if found.is_empty() {
            if ring.winding[self.k] != 0 {
                return Err(TrimError::Contradiction);
            }
            let mut pieces = parts.swap_remove(0);
            home(&mut pieces);
            whole.push(Ring { pieces, winding: ring.winding });
            return Ok(());
        }
        // The part after the last crossing goes on to the first one.
        let (first_arc, first_crossing, n) = (arcs.len(), crossings.len(), found.len());
        let mut start = parts.remove(0);
        if let Some(last) = parts.last_mut() {
            if let (Some(end), Some(begin)) =
                (last.last().map(|p| p.ends()[1]), start.first().map(|p| p.ends()[0]))
            {
                let turns = |k: usize, p: f64| p * ((end[k] - begin[k]) / p).round();
                let by = [0, 1].map(|k| self.chart.periods[k].map_or(0.0, |p| turns(k, p)));
                start.iter_mut().for_each(|p| p.shift(by));
            }
            last.extend(start);
        }
        for (i, (y, enters)) in found.into_iter().enumerate() {
            let before = first_arc + (i + n - 1) % n;
            crossings.push(Crossing { y, enters, arcs: [before, first_arc + i] });
        }
        for (i, mut pieces) in parts.into_iter().enumerate() {
            home(&mut pieces);
            let to = first_crossing + (i + 1) % n;
            arcs.push(Arc { pieces, crossings: [first_crossing + i, to] });
        }
        Ok(())
    }

    /// Adds a piece to the last part, and begins a new part at each crossing of the cut.
    fn cut_piece(&self, piece: Piece, c: f64, parts: &mut Vec<Vec<Piece>>, found: &mut Vec<(f64, bool)>) {
        let k = self.k;
        let index = |at: [f64; 2]| ((at[k] - c) / self.period).floor();
        let mut rest = piece;
        // The strip between two copies of the cut that the rest begins in: a place on the cut itself may lie in either.
        let mut strip = index(rest.ends()[0]);
        loop {
            let places = rest.places();
            let Some(i) = (1..places.len()).find(|i| index(places[*i].0) != strip) else { break };
            let rises = index(places[i].0) > strip;
            let value = c + self.period * if rises { strip + 1.0 } else { strip };
            let (first, at);
            match rest {
                Piece::Edge(strand) => {
                    let between = [strand.samples[i - 1].share, strand.samples[i].share];
                    let share;
                    (share, at) =
                        crossing(&strand, (self.chart, &self.spans[strand.slot]), between, (k, value));
                    let [a, b] = strand.split(share, at);
                    (first, rest) = (Piece::Edge(a), Piece::Edge(b));
                }
                Piece::Straight { ends: [from, to], kind } => {
                    let share = ((value - from[k]) / (to[k] - from[k])).clamp(0.0, 1.0);
                    let mut on_cut = [0, 1].map(|j| from[j] + share * (to[j] - from[j]));
                    on_cut[k] = value;
                    at = on_cut;
                    first = Piece::Straight { ends: [from, at], kind };
                    rest = Piece::Straight { ends: [at, to], kind };
                }
            }
            strip += if rises { 1.0 } else { -1.0 };
            found.push((self.y(at), rises));
            if let Some(part) = parts.last_mut() {
                part.push(first);
            }
            parts.push(vec![]);
        }
        if let Some(part) = parts.last_mut() {
            part.push(rest);
        }
    }

    /// What of the cut is inside, in pairs of crossings.
    fn insides(&self, crossings: &[Crossing], whole: &[Ring], c: f64) -> Result<Vec<Inside>, TrimError> {
        let other = self.other;
        let [low, high] = self.ys();
        let circle = other.map(|q| if low.is_finite() { [low, low + q] } else { [0.0, q] });
        if crossings.is_empty() {
            // Rings on the right of the cut have an area below 0 if the inside begins at the cut.
            let area: f64 = whole.iter().map(|ring| self.area_from(ring, c)).sum();
            if area > 0.0 {
                return Ok(vec![]);
            }
            let ys = circle.unwrap_or([low, high]);
            let is_whole = circle.is_some() || (self.pole(0).is_some() && self.pole(1).is_some());
            return if is_whole {
                Ok(vec![Inside { ends: [None, None], ys }])
            } else if whole.is_empty() {
                Err(TrimError::NoBorder)
            } else {
                Err(TrimError::Contradiction)
            };
        }
        let reduced = |i: usize| match (other, circle) {
            (Some(q), Some([first, _])) => crossings[i].y - q * ((crossings[i].y - first) / q).floor(),
            _ => crossings[i].y,
        };
        let mut order: Vec<usize> = (0..crossings.len()).collect();
        order.sort_by(|a, b| reduced(*a).total_cmp(&reduced(*b)));
        let n = order.len();
        if (0..n - 1).any(|i| crossings[order[i]].enters == crossings[order[i + 1]].enters) {
            return Err(TrimError::Contradiction);
        }
        let mut all = vec![];
        let (first, last) = (order[0], order[n - 1]);
        if let Some(q) = other {
            if crossings[first].enters == crossings[last].enters {
                return Err(TrimError::Contradiction);
            }
            let starts = if crossings[first].enters { 0 } else { 1 };
            for i in (starts..n + starts).step_by(2) {
                let [a, b] = [order[i % n], order[(i + 1) % n]];
                let end = reduced(b) + if reduced(b) > reduced(a) { 0.0 } else { q };
                all.push(Inside { ends: [Some(a), Some(b)], ys: [reduced(a), end] });
            }
            return Ok(all);
        }
        let mut from = (None, low);
        let mut is_inside = !crossings[first].enters;
        if is_inside && self.pole(0).is_none() {
            return Err(TrimError::Contradiction);
        }
        for i in order {
            let y = crossings[i].y;
            if is_inside {
                all.push(Inside { ends: [from.0, Some(i)], ys: [from.1, y] });
            }
            (from, is_inside) = ((Some(i), y), !is_inside);
        }
        if is_inside {
            self.pole(1).ok_or(TrimError::Contradiction)?;
            all.push(Inside { ends: [from.0, None], ys: [from.1, high] });
        }
        Ok(all)
    }

    /// The area between the cut and a ring.
    fn area_from(&self, ring: &Ring, c: f64) -> f64 {
        let of = |piece: &Piece| -> f64 {
            let places = piece.places();
            let part = |w: &[([f64; 2], [f64; 2])]| {
                let (a, b) = (w[0].0, w[1].0);
                (0.5 * (a[self.k] + b[self.k]) - c) * (self.y(b) - self.y(a))
            };
            places.windows(2).map(part).sum()
        };
        ring.pieces.iter().map(of).sum()
    }

    /// Rings of arcs and sides of the cut.
    fn link(
        &self,
        c: f64,
        arcs: Vec<Arc>,
        crossings: &[Crossing],
        insides: &[Inside],
        out: &mut Vec<Ring>,
    ) -> Result<(), TrimError> {
        let right = c + self.period;
        let mut gone = vec![false; arcs.len()];
        let mut arcs: Vec<Option<Arc>> = arcs.into_iter().map(Some).collect();
        for first in 0..arcs.len() {
            let mut ring: Vec<Piece> = vec![];
            let mut at = first;
            while !gone[at] {
                gone[at] = true;
                let Some(arc) = arcs[at].take() else { break };
                let end = ring.last().map(|p| p.ends()[1]);
                let mut pieces = arc.pieces;
                if let (Some(end), Some(start)) = (end, pieces.first().map(|p| p.ends()[0])) {
                    let by = self.at(0.0, self.y(end) - self.y(start));
                    pieces.iter_mut().for_each(|p| p.shift(by));
                }
                ring.extend(pieces);
                let arrived = arc.crossings[1];
                let inside = insides.iter().find(|i| i.ends.contains(&Some(arrived)));
                let inside = inside.ok_or(TrimError::Contradiction)?;
                let y = ring.last().map_or(0.0, |p| self.y(p.ends()[1]));
                // The inside as seen from where the ring has come to.
                let rises = crossings[arrived].enters;
                let by = y - if rises { inside.ys[0] } else { inside.ys[1] };
                let [low, high] = inside.ys.map(|x| x + by);
                at = self.along_cut(&mut ring, [c, right], [low, high], inside, rises, crossings);
            }
            if !ring.is_empty() {
                out.push(self.ring(ring));
            }
        }
        // Insides that no crossing ends have rings of their own.
        for inside in insides.iter().filter(|i| i.ends == [None, None]) {
            let [low, high] = inside.ys;
            let cut = |from: [f64; 2], to: [f64; 2]| Piece::Straight {
                ends: [from, to],
                kind: Straight::Cut(self.k),
            };
            let up = cut(self.at(right, low), self.at(right, high));
            let down = cut(self.at(c, high), self.at(c, low));
            if self.other.is_some() {
                out.push(self.ring(vec![up]));
                out.push(self.ring(vec![down]));
            } else if let (Some(bottom), Some(top)) = (self.pole(0), self.pole(1)) {
                let top = Piece::Straight { ends: [self.at(right, high), self.at(c, high)], kind: top };
                let bottom = Piece::Straight { ends: [self.at(c, low), self.at(right, low)], kind: bottom };
                out.push(self.ring(vec![up, top, down, bottom]));
            }
        }
        Ok(())
    }

    /// Goes along the cut from the crossing that an arc has come to, to the arc that begins at its other end.
    fn along_cut(
        &self,
        ring: &mut Vec<Piece>,
        [c, right]: [f64; 2],
        [low, high]: [f64; 2],
        inside: &Inside,
        rises: bool,
        crossings: &[Crossing],
    ) -> usize {
        let kind = Straight::Cut(self.k);
        let arrived = inside.ends[if rises { 0 } else { 1 }];
        let other = inside.ends[if rises { 1 } else { 0 }];
        // Up on the right, down on the left.
        let (side, other_side) = if rises { (right, c) } else { (c, right) };
        let (from, to) = if rises { (low, high) } else { (high, low) };
        ring.push(Piece::Straight { ends: [self.at(side, from), self.at(side, to)], kind });
        if let Some(other) = other {
            return crossings[other].arcs[1];
        }
        if let Some(kind) = self.pole(if rises { 1 } else { 0 }) {
            ring.push(Piece::Straight { ends: [self.at(side, to), self.at(other_side, to)], kind });
        }
        ring.push(Piece::Straight { ends: [self.at(other_side, to), self.at(other_side, from)], kind });
        arrived.map_or(0, |a| crossings[a].arcs[1])
    }

    /// A closed ring, with its winding along the cut.
    fn ring(&self, pieces: Vec<Piece>) -> Ring {
        let mut winding = [0; 2];
        let o = 1 - self.k;
        if let (Some(q), Some(first), Some(last)) = (self.other, pieces.first(), pieces.last()) {
            winding[o] = ((last.ends()[1][o] - first.ends()[0][o]) / q).round() as i32;
        }
        Ring { pieces, winding }
    }
}

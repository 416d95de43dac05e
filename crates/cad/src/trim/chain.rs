//! The loops of a face as closed lines in the parameters of its surface.

use super::chart::{Chart, Side};
use super::error::TrimError;
use super::ring::{Piece, Ring, Straight};
use super::strand::{Sampler, Strand};
use crate::brep::{EdgeUse, Loop};
use crate::curve::Span;
use trueness_geom::space::{minus, norm};

/// Uses of edges that bound the face, loop by loop.
///
/// An edge that is used once in either direction bounds nothing: the face lies on both sides of it, as at the seam of a cylinder. Without
/// such edges the loops are what they would be had the file no seams: some go around, some are cut off from others.
pub fn bounding_uses(loops: &[Loop], reversed: bool) -> Result<Vec<Vec<EdgeUse>>, TrimError> {
    let mut uses: Vec<EdgeUse> = vec![];
    let mut next: Vec<usize> = vec![];
    for edges in loops.iter().filter_map(|l| if let Loop::Edges(edges) = l { Some(edges) } else { None }) {
        let first = uses.len();
        let turned = |u: &EdgeUse| EdgeUse { edge: u.edge, reversed: u.reversed != reversed };
        if reversed {
            uses.extend(edges.iter().rev().map(turned));
        } else {
            uses.extend(edges);
        }
        next.extend(first + 1..=uses.len());
        if let Some(last) = next.last_mut().filter(|_| !edges.is_empty()) {
            *last = first;
        }
    }
    let mut before = vec![0; next.len()];
    next.iter().enumerate().for_each(|(i, n)| before[*n] = i);
    let mut by_edge: Vec<usize> = (0..uses.len()).collect();
    by_edge.sort_by_key(|i| uses[*i].edge);
    let mut gone = vec![false; uses.len()];
    for same in by_edge.chunk_by(|a, b| uses[*a].edge == uses[*b].edge) {
        match *same {
            [_] => {}
            [a, b] if uses[a].reversed != uses[b].reversed => {
                // What came before one goes on after the other.
                let [to_a, to_b, after_a, after_b] = [before[a], before[b], next[a], next[b]];
                (next[to_a], before[after_b]) = (after_b, to_a);
                (next[to_b], before[after_a]) = (after_a, to_b);
                (gone[a], gone[b]) = (true, true);
            }
            _ => return Err(TrimError::SameDirection(uses[same[0]].edge)),
        }
    }
    let mut chains = vec![];
    for first in 0..uses.len() {
        let mut chain = vec![];
        let mut at = first;
        while !gone[at] {
            gone[at] = true;
            chain.push(uses[at]);
            at = next[at];
        }
        if !chain.is_empty() {
            chains.push(chain);
        }
    }
    Ok(chains)
}

/// What loops are laid into parameters with.
pub struct Chainer<'a> {
    pub chart: &'a Chart,
    /// Edges of the face with their curves, by ascending number.
    pub edges: &'a [u32],
    pub spans: &'a [Span],
    /// A place nearer than that to a pole is the pole; an edge shorter than that is none.
    pub reach: f64,
    /// An edge that begins farther than that from the end of the one before leaves the border open.
    pub most_open: f64,
}

impl Chainer<'_> {
    /// The ring of one loop; `None` where all its edges are places.
    pub fn ring(&self, uses: &[EdgeUse]) -> Result<Option<Ring>, TrimError> {
        let mut strands: Vec<Strand> = vec![];
        for edge in uses {
            let slot = self.edges.binary_search(&edge.edge).map_err(|_| TrimError::NoEdge(edge.edge))?;
            let sampler = Sampler {
                chart: self.chart,
                span: &self.spans[slot],
                edge: edge.edge,
                slot,
                reach: self.reach,
            };
            let near = strands.last().map(|s| s.ends()[1]);
            strands.extend(sampler.strands(edge.reversed, near));
        }
        let mut ring = Ring::default();
        let Some(first) = strands.first().cloned() else { return Ok(None) };
        let mut end: Option<([f64; 2], Option<Side>, f64, usize)> = None;
        for mut strand in strands {
            if strand.samples.iter().any(|s| !s.at.iter().all(|x| x.is_finite())) {
                return Err(TrimError::NotFinite(strand.edge));
            }
            if let Some(end) = end {
                let [start, _] = strand.ends();
                let to = self.join(&mut ring, end, &strand)?;
                strand.shift([to[0] - start[0], to[1] - start[1]]);
            }
            end = Some((strand.ends()[1], strand.poles[1], strand.shares()[1], strand.slot));
            ring.pieces.push(Piece::Edge(strand));
        }
        let start = first.ends()[0];
        if let Some(end) = end {
            let to = self.join(&mut ring, end, &first)?;
            let turns = |k: usize| self.chart.periods[k].map_or(0.0, |p| ((to[k] - start[k]) / p).round());
            ring.winding = [turns(0) as i32, turns(1) as i32];
        }
        Ok(Some(ring))
    }

    /// Goes from the end of one strand to the start of the next; where that start then is.
    fn join(
        &self,
        ring: &mut Ring,
        (end, end_pole, share, slot): ([f64; 2], Option<Side>, f64, usize),
        next: &Strand,
    ) -> Result<[f64; 2], TrimError> {
        let start = next.ends()[0];
        let (to, kind) = match (end_pole, next.poles[0]) {
            (Some(side), Some(other)) if side == other => {
                (self.along_pole(end, start, side), Straight::Pole(side))
            }
            (Some(side), Some(other)) if side.0 != other.0 => {
                // Both sides are one place: over the corner between them.
                let mut corner = end;
                corner[other.0] = self.chart.domain[other.0][other.1];
                ring.pieces.push(Piece::Straight { ends: [end, corner], kind: Straight::Pole(side) });
                ring.pieces.push(Piece::Straight { ends: [corner, start], kind: Straight::Pole(other) });
                return Ok(start);
            }
            // From one pole to the opposite one at the same place: the surface touches itself, and the face goes on nowhere.
            (Some(_), Some(_)) => return Err(TrimError::Contradiction),
            _ => (self.chart.beside(start, end), Straight::Joint),
        };
        if kind == Straight::Joint {
            let place = self.spans[slot].derivatives(share)[0];
            let own = self.spans[next.slot].derivatives(next.shares()[0])[0];
            let distance = norm(minus(place, own));
            if distance.is_nan() || distance > self.most_open {
                return Err(TrimError::Open { edge: next.edge, distance });
            }
            let off = norm(minus(self.chart.place(end), self.chart.place(to)));
            // Places that are one on the surface are not one in its parameters: the border jumps over a side that does not repeat.
            let is_near = off <= self.most_open + 2.0 * distance;
            if !is_near || self.is_jump(end, to) {
                return Err(TrimError::Open { edge: next.edge, distance: off });
            }
        }
        if to != end {
            ring.pieces.push(Piece::Straight { ends: [end, to], kind });
        }
        Ok(to)
    }

    /// Whether two parameters of nearly one place are far apart.
    fn is_jump(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        (0..2).any(|k| {
            let [first, last] = self.chart.domain[k];
            self.chart.periods[k].is_none()
                && (last - first).is_finite()
                && (b[k] - a[k]).abs() > 0.5 * (last - first)
                && !self.chart.has_poles()
        })
    }

    /// Where the next strand starts if the border goes along a pole to it: with the face on the left.
    fn along_pole(&self, end: [f64; 2], start: [f64; 2], (k, is_last): Side) -> [f64; 2] {
        let o = 1 - k;
        let sign = if (k == 0) == (is_last == 1) { 1.0 } else { -1.0 };
        let mut to = start;
        if let Some(period) = self.chart.periods[o] {
            let ahead = sign * (start[o] - end[o]) / period;
            let share = ahead - ahead.floor();
            // A turn of nothing, give or take rounding.
            let is_nothing = !(SAME_DIRECTION..=1.0 - SAME_DIRECTION).contains(&share);
            let share = if is_nothing { 0.0 } else { share };
            to[o] = if share == 0.0 { end[o] } else { end[o] + sign * share * period };
        }
        to
    }
}

/// Edges that leave a pole within this share of a turn go the same way: their directions are known to the share of an edge over which they
/// are sampled.
const SAME_DIRECTION: f64 = 1e-6;

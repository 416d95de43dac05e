//! Rows of the ends of lines and the vertices of arcs, exact to the digits of their file. Drawings and programs for
//! machine tools give outlines so.
//!
//! A line has no points there but its ends, which its neighbors share, and joins lie at points. No search by likelihood
//! tells a line of two points from a gap. But exact points show a model by the points that it explains. Every interior
//! point of a line or an arc saves a coordinate, and every join that turns out tangent a direction. A circle costs its
//! curvature. The cheapest cover of the row by lines and arcs that share their ends is found by dynamic programming. It
//! is taken where its savings are no chance, and where each of its segments ends for certain.

use super::assembly::Joined;
use super::candidate::{Candidate, Question};
use super::clean::{Clean, size};
use super::evidence::{Piece, is_evident};
use super::facets::{Item, LineOrArc, MAX_TANGENT_CHORD_TURN, Polygon, SHARP_TURN, round};
use super::sheet::Sheet;
use crate::model::flat::{angle, distance};
use crate::model::result::{Contour, RowKind, SectionError};
use trueness_geom::progress::Progress;

/// Longer rows tell their segments themselves.
const MAX_VERTICES: usize = 2000;
/// Decimals of files that are looked for.
const DECIMALS: std::ops::RangeInclusive<i32> = 1..=9;
/// Points in other units, or of a plane in space, keep no decimals: their coordinates are exact to these shares of the size.
const ROUNDING_SHARES_OF_VERTICES: [f64; 2] = [1e-7, 1e-6];
/// Digits coarser than this share of the median chord tell no arc.
const MAX_STEP_PER_CHORD: f64 = 0.02;
/// Chords of an arc that turn by more than in a circle of eleven sides are even to this factor. Others are sides of a
/// polygon.
const MAX_EVEN_CHORD_RATIO: f64 = 1.5;
/// The cost of uneven chords, by the logarithm of their ratio: the more even one is taken of covers that save as much.
const UNEVEN_CHORD_COST: f64 = 0.05;
/// A direction is uncertain by so many roundings over the length of an arc, and of a line.
const TURN_ROUNDINGS: [f64; 2] = [8.0, 2.0];
/// Items from one vertex are the longest arc and so many shorter ones: rounding may have let it run too far.
const SHORTER_ARCS_TRIED: usize = 2;
/// Covers of a closed row are looked for from both ends of so many of its longest pieces.
const LONGEST_PIECES_TRIED: usize = 4;

/// The lines and arcs of a row, and the rounding of its coordinates.
#[derive(Debug)]
pub(crate) struct Vertices {
    pub polygon: Polygon,
    pub items: Vec<Item>,
    pub rounding: f64,
}

/// The contour of a row of the ends of lines and the vertices of arcs, where it is one.
pub(super) fn propose(
    question: &Question,
    best: Option<&Contour>,
    _: &dyn Progress,
) -> Result<Option<Candidate>, SectionError> {
    if best.is_some() || !question.may_be_exact() || question.partition().exact {
        return Ok(None);
    }
    let clean = &question.clean;
    let original: Vec<[f64; 2]> = clean.numbers.iter().map(|i| question.points[*i]).collect();
    let Some(found) =
        vertices(&clean.points, &original, clean.closed, question.options.closed == Some(false))
    else {
        return Ok(None);
    };
    let (rounding, polygon) = (found.rounding, found.polygon);
    let closed = polygon.closed;
    let contour =
        Sheet { points: &clean.points, polygon, rounding, options: question.options }.exact(&found.items);
    let mut all = Joined::of(Contour { row_kind: RowKind::Row, ..contour });
    all.finish(&Clean { closed, ..clean.clone() }, 0, question.points.len(), vec![]);
    Ok(Candidate::beyond_chance(all.contour))
}

/// The lines and arcs whose ends and vertices the points are; `original` are the same in the coordinates of the file. An open row closes where its
/// end goes on to its start with the direction of both, unless it is known to be `open`.
pub(crate) fn vertices(
    points: &[[f64; 2]],
    original: &[[f64; 2]],
    closed: bool,
    open: bool,
) -> Option<Vertices> {
    if !(4..=MAX_VERTICES).contains(&points.len()) {
        return None;
    }
    let mut chords: Vec<f64> = points.windows(2).map(|w| distance(w[0], w[1])).collect();
    chords.sort_by(f64::total_cmp);
    let most = MAX_STEP_PER_CHORD * chords[chords.len() / 2];
    // Finer than their digits points tell nothing.
    let shares = || ROUNDING_SHARES_OF_VERTICES.map(|share| share * size(points)).to_vec();
    let levels = step(original).map_or_else(shares, |step| vec![step]).into_iter().filter(|q| *q <= most);
    let mut levels = levels;
    levels.find_map(|rounding| within(points, rounding, closed, open))
}

/// The step of the decimals that all coordinates have.
fn step(points: &[[f64; 2]]) -> Option<f64> {
    let has = |k: &i32| {
        let unit = 10.0_f64.powi(*k);
        points.iter().flatten().all(|x| (x * unit).round() / unit == *x)
    };
    DECIMALS.into_iter().find(has).map(|k| 10.0_f64.powi(-k))
}

fn within(points: &[[f64; 2]], rounding: f64, closed: bool, open: bool) -> Option<Vertices> {
    let polygon =
        |closed: bool| Polygon { at: points.to_vec(), numbers: (0..points.len()).collect(), closed };
    let found = |closed: bool| {
        let cover = Cover { polygon: polygon(closed), rounding };
        let pieces = cover.best()?;
        is_evident(&cover.polygon, &pieces, rounding).then_some((cover.polygon, pieces))
    };
    let closing = || {
        let (polygon, pieces) = found(true)?;
        // The chord from the last point to the first is a line that is tangent to an arc at either end.
        let n = pieces.len();
        let last = pieces.iter().position(|p| p.item.to == points.len() || p.item.to % points.len() == 0)?;
        let (a, b, c) = (&pieces[(last + n - 1) % n], &pieces[last], &pieces[(last + 1) % n]);
        let line = !b.is_arc() && b.chords() == 1;
        (line && a.is_tangent(b) && b.is_tangent(c)).then_some((polygon, pieces))
    };
    let (polygon, pieces) = match (closed, open) {
        (true, _) => found(true)?,
        (false, true) => found(false)?,
        (false, false) => closing().or_else(|| found(false))?,
    };
    let items = pieces.iter().map(|p| p.item).collect();
    Some(Vertices { polygon, items, rounding })
}

/// A row that is to be covered.
struct Cover {
    polygon: Polygon,
    rounding: f64,
}

/// The cheapest way to a piece: its savings, and the piece before.
#[derive(Clone, Copy)]
struct CoverStep {
    saves: f64,
    before: Option<usize>,
}

impl Cover {
    /// The cover that saves most. A closed one is looked for from its longest chord, then from both ends of the longest
    /// pieces found. A cover from there does not know how much a piece over the start saves.
    fn best(&self) -> Option<Vec<Piece>> {
        let n = self.polygon.at.len();
        if !self.polygon.closed {
            return Some(self.from(0)?.1);
        }
        let longest =
            (0..n).max_by(|a, b| self.polygon.facet_length(*a).total_cmp(&self.polygon.facet_length(*b)))?;
        let (saves, first) = self.from(longest)?;
        let mut by_length: Vec<&Piece> = first.iter().collect();
        by_length.sort_by_key(|p| std::cmp::Reverse(p.chords()));
        let ends =
            by_length.into_iter().take(LONGEST_PIECES_TRIED).flat_map(|p| [p.item.from % n, p.item.to % n]);
        let others: Vec<(f64, Vec<Piece>)> = ends.filter_map(|start| self.from(start)).collect();
        let best = others.into_iter().fold((saves, first), |a, b| if b.0 > a.0 { b } else { a });
        Some(best.1)
    }

    /// The same with a piece that starts at a vertex.
    fn from(&self, start: usize) -> Option<(f64, Vec<Piece>)> {
        let last = start + self.polygon.facets();
        let pieces: Vec<Piece> = (start..last).flat_map(|from| self.pieces(from, last)).collect();
        let mut ways: Vec<CoverStep> = vec![];
        let mut ending: Vec<Vec<usize>> = vec![vec![]; last - start + 1];
        for (k, piece) in pieces.iter().enumerate() {
            let own = piece.saves - piece.uneven;
            let via = |before: usize| {
                let tangent = f64::from(u8::from(pieces[before].is_tangent(piece)));
                CoverStep { saves: ways[before].saves + own + tangent, before: Some(before) }
            };
            let before = ending[piece.item.from - start].iter().map(|k| via(*k));
            let first = (piece.item.from == start).then_some(CoverStep { saves: own, before: None });
            let best = before.chain(first).max_by(|a, b| a.saves.total_cmp(&b.saves))?;
            ways.push(best);
            ending[piece.item.to - start].push(k);
        }
        let over_seam = |k: &usize| {
            let mut first = *k;
            while let Some(before) = ways[first].before {
                first = before;
            }
            let tangent = self.polygon.closed && pieces[*k].is_tangent(&pieces[first]);
            ways[*k].saves + f64::from(u8::from(tangent))
        };
        let mut at =
            ending[last - start].iter().copied().max_by(|a, b| over_seam(a).total_cmp(&over_seam(b)));
        let saves = over_seam(&at?);
        let mut all = vec![];
        while let Some(k) = at {
            all.push(pieces[k]);
            at = ways[k].before;
        }
        all.reverse();
        Some((saves, all))
    }

    /// The lines and arcs that start at a vertex, in the order of their ends.
    fn pieces(&self, from: usize, last: usize) -> Vec<Piece> {
        let mut all = vec![];
        let mut to = from + 1;
        while let Some(line) = self.line(from, to).filter(|_| to <= last) {
            all.push(line);
            to += 1;
        }
        // Lines but the longest and the chord are parts of these.
        if all.len() > 2 {
            all.drain(1..all.len() - 1);
        }
        let most = last.min(from + self.polygon.at.len() - 1);
        if from + 2 > most {
            return all;
        }
        all.extend(self.arc(from, from + 2));
        let (mut best, mut fails, mut step) = (from + 2, most + 1, 1);
        while best < most && step > 0 {
            let to = (best + step).min(fails - 1);
            if to == best {
                break;
            }
            match self.arc(from, to) {
                Some(_) => (best, step) = (to, 2 * step),
                None => (fails, step) = (to, 1.max((to - best) / 2)),
            }
        }
        let shorter = (from + 3).max(best.saturating_sub(SHORTER_ARCS_TRIED));
        all.extend((shorter..=best).filter_map(|to| self.arc(from, to)));
        all
    }

    fn line(&self, from: usize, to: usize) -> Option<Piece> {
        let (a, b) = (self.polygon.vertex(from), self.polygon.vertex(to));
        let whole = distance(a, b);
        let along = [(b[0] - a[0]) / whole, (b[1] - a[1]) / whole];
        let seen = |i: usize| {
            let p = self.polygon.vertex(i);
            let d = [p[0] - a[0], p[1] - a[1]];
            (along[0] * d[0] + along[1] * d[1], (along[0] * d[1] - along[1] * d[0]).abs())
        };
        let mut way = 0.0;
        for i in from + 1..=to {
            let (ahead, off) = seen(i);
            if !(ahead > way && off <= self.rounding) {
                return None;
            }
            way = ahead;
        }
        let item = Item { shape: LineOrArc::Line, from, to };
        let slack = TURN_ROUNDINGS[1] * self.rounding / whole;
        Some(Piece { item, along: [along; 2], slack, saves: (to - from - 1) as f64, uneven: 0.0 })
    }

    /// The arc through these vertices. Three lie on a circle by themselves.
    fn arc(&self, from: usize, to: usize) -> Option<Piece> {
        let points: Vec<[f64; 2]> = (from..=to).map(|i| self.polygon.vertex(i)).collect();
        let (center, radius) = round(&points)?;
        let out = |p: [f64; 2]| [p[0] - center[0], p[1] - center[1]];
        let off = points.iter().map(|p| (distance(center, *p) - radius).abs()).fold(0.0, f64::max);
        let turns: Vec<f64> = points.windows(2).map(|w| angle(out(w[0]), out(w[1]))).collect();
        let turned: f64 = turns.iter().sum();
        let widest = turns.iter().fold(0.0_f64, |m, t| m.max(t.abs()));
        let least = turns.iter().fold(f64::INFINITY, |m, t| m.min(t.abs()));
        let way = radius * turned.abs();
        let slack = TURN_ROUNDINGS[0] * self.rounding / way;
        let one_way = turns.iter().all(|t| t * turned > 0.0);
        let is_wide = widest > SHARP_TURN;
        if off > self.rounding
            || !one_way
            || widest > MAX_TANGENT_CHORD_TURN + slack
            || turned.abs() >= std::f64::consts::TAU - 0.5 * least
            || is_wide && widest > MAX_EVEN_CHORD_RATIO * least
        {
            return None;
        }
        // Bent by no more than rounding it is a line.
        let sagitta = radius * (1.0 - libm::cos(0.5 * turned.abs().min(std::f64::consts::PI)));
        let along = [points[0], points[points.len() - 1]].map(|p| {
            let r = out(p);
            [-r[1] * turned.signum(), r[0] * turned.signum()]
        });
        let item = Item { shape: LineOrArc::Arc(center, turned.signum() / radius), from, to };
        // Even chords that wide are those of a regular polygon as well; two are told by tangents alone.
        let saves = (to - from) as f64 - 2.0 - f64::from(u8::from(is_wide && to - from > 2));
        let uneven = UNEVEN_CHORD_COST * libm::log(widest / least);
        (sagitta > 4.0 * self.rounding).then_some(Piece { item, along, slack, saves, uneven })
    }
}

//! Which end of a closed profile is the trailing one, and the kind of its edge.
//!
//! An outline turns by half a turn, less its wedge, at either end. The edge is the shortest stretch that takes most of
//! that turn. It is one point of a sharp edge, the face between two corners of a blunt one, or an arc of a round one. A
//! face has points on it or none. So the sides end where their own points end, and are led no farther. The trailing end
//! is the thinner one: how the sides behind it turn tells nothing of a strongly cambered profile.

use crate::model::flat::{angle, distance, off_line};

/// The part of the turn at its end that an edge takes, radians: two thirds of half a turn. Wedges turn by less than the
/// rest, and one corner of a face by less than this.
const MIN_EDGE_TURN: f64 = 2.1;
/// The outline between the corners of a face is off the line between them by less than this share of its length. An arc that takes
/// most of the turn is off by 0.29, its middle one of three corners by 0.18.
const MAX_BULGE_SHARE: f64 = 0.12;
/// Points are passed over that lie no farther off the line between others than so many standard deviations of their
/// noise. A point lies off that line by four.
const PASSED_OVER_SIGMAS: f64 = 5.0;
/// The widths of the ends are compared at this share of the chord.
const WIDTH_STATION_OF_CHORD: f64 = 0.05;
/// An edge lies within this share of the chord from the end.
const END_CHORD_SHARE: f64 = 0.15;

/// The stretch of a trailing edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tail {
    /// The last point of the side before it, in the order of the row, and the first of the side behind it. Both are the
    /// same at a sharp edge.
    pub ends: [usize; 2],
    /// Its turn is not at its ends.
    pub round: bool,
    /// The point farthest from the leading edge.
    pub tip: usize,
}

/// The trailing edge of a closed row whose points scatter by `noise`; a round one where it does not turn back within a short stretch.
pub(super) fn tail(row: &[[f64; 2]], noise: f64) -> Tail {
    let (a, b) = diameter(row);
    let chord = distance(row[a], row[b]);
    let outline = Outline { row, at: simplified(row, [a, b], PASSED_OVER_SIGMAS * noise), chord };
    let tip = if width(row, b, a) <= width(row, a, b) { b } else { a };
    outline.edge(tip).unwrap_or(Tail { ends: [tip; 2], round: true, tip })
}

/// Width of the profile across the chord, near the end `own` of it.
fn width(row: &[[f64; 2]], own: usize, other: usize) -> f64 {
    let (o, e) = (row[own], row[other]);
    let chord = distance(o, e);
    let along = [(e[0] - o[0]) / chord, (e[1] - o[1]) / chord];
    let local = |p: [f64; 2]| {
        let d = [p[0] - o[0], p[1] - o[1]];
        (
            d[0] * along[0] + d[1] * along[1] - WIDTH_STATION_OF_CHORD * chord,
            along[0] * d[1] - along[1] * d[0],
        )
    };
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..row.len() {
        let ((s, h), (t, g)) = (local(row[i]), local(row[(i + 1) % row.len()]));
        if (s < 0.0) != (t < 0.0) {
            let at = h + (g - h) * s / (s - t);
            (low, high) = (low.min(at), high.max(at));
        }
    }
    high - low
}

/// The corners of an outline.
struct Outline<'a> {
    row: &'a [[f64; 2]],
    at: Vec<usize>,
    chord: f64,
}

impl Outline<'_> {
    fn place(&self, k: usize) -> [f64; 2] {
        self.row[self.at[k % self.at.len()]]
    }

    /// Turn at a corner, positive for all of a convex outline.
    fn turn(&self, k: usize) -> f64 {
        let n = self.at.len();
        let [a, b, c] = [k + n - 1, k, k + 1].map(|k| self.place(k));
        angle([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]])
    }

    /// The shortest stretch near the end `tip` that takes most of the turn.
    fn edge(&self, tip: usize) -> Option<Tail> {
        let n = self.at.len();
        let middle = self.at.iter().position(|i| *i == tip)?;
        let all: f64 = (0..n).map(|k| self.turn(k)).sum();
        let near = |k: &usize| distance(self.place(*k), self.row[tip]) < END_CHORD_SHARE * self.chord;
        let back = (0..n / 2).take_while(|k| near(&(middle + n - k))).last()?;
        let on = (0..n / 2).take_while(|k| near(&(middle + k))).last()?;
        let range = (middle + n - back)..=(middle + n + on);
        let mut best: Option<(f64, f64, usize, usize)> = None;
        for from in range.clone() {
            let (mut turned, mut length) = (0.0, 0.0);
            for to in from..=*range.end() {
                length += if to > from { distance(self.place(to - 1), self.place(to)) } else { 0.0 };
                turned += self.turn(to) * all.signum();
                if turned >= MIN_EDGE_TURN {
                    if best.is_none_or(|b| length < b.0 || length == b.0 && turned > b.1) {
                        best = Some((length, turned, from, to));
                    }
                    break;
                }
            }
        }
        let (_, _, from, to) = best?;
        let (a, b) = (self.place(from), self.place(to));
        let off = (from + 1..to).map(|k| off_line([a, b], self.place(k))).fold(0.0, f64::max);
        let round = off > MAX_BULGE_SHARE * distance(a, b);
        Some(Tail { ends: [self.at[from % n], self.at[to % n]], round, tip })
    }
}

/// The points of a closed row between which all others lie within `reach` of straight lines, from two of them on (Ramer, Douglas and
/// Peucker).
fn simplified(row: &[[f64; 2]], anchors: [usize; 2], reach: f64) -> Vec<usize> {
    let n = row.len();
    let (a, b) = (anchors[0].min(anchors[1]), anchors[0].max(anchors[1]));
    let mut kept = vec![a, b];
    let mut open = vec![(a, b), (b, a + n)];
    while let Some((from, to)) = open.pop() {
        let (p, q) = (row[from % n], row[to % n]);
        let along = [q[0] - p[0], q[1] - p[1]];
        let length = libm::hypot(along[0], along[1]).max(f64::MIN_POSITIVE);
        let off = |i: &usize| {
            let d = [row[i % n][0] - p[0], row[i % n][1] - p[1]];
            let share = ((d[0] * along[0] + d[1] * along[1]) / (length * length)).clamp(0.0, 1.0);
            libm::hypot(d[0] - share * along[0], d[1] - share * along[1])
        };
        let Some(most) = (from + 1..to).max_by(|i, j| off(i).total_cmp(&off(j))) else { continue };
        if off(&most) > reach {
            kept.push(most % n);
            open.extend([(from, most), (most, to)]);
        }
    }
    kept.sort_unstable();
    kept
}

/// Two points as far apart as any, nearly: each the farthest from the other.
fn diameter(row: &[[f64; 2]]) -> (usize, usize) {
    let farthest = |from: usize| {
        let far = |i: &usize| distance(row[*i], row[from]);
        (0..row.len()).max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
    };
    let (mut a, mut b) = (0, farthest(0));
    for _ in 0..10 {
        let c = farthest(b);
        if c == a {
            break;
        }
        (a, b) = (b, c);
    }
    (a, b)
}

#[cfg(test)]
mod tests;

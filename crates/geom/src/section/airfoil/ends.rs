//! Where a profile ends: which end is the trailing one, and whether it is sharp, blunt or round.

use super::super::polygon::turn;
use super::super::start::noise;
use super::error::AirfoilError;

/// A turn by more than this at one point is a corner, radians.
const CORNER: f64 = 0.6;
/// Turns are looked at between points that scatter by no more than this share of their distance.
const STEADY: f64 = 0.05;
/// A turn is told from chance by so many standard deviations.
const SURE: f64 = 3.0;
/// They lie within this share of the chord from the end.
const NEAR: f64 = 0.03;
/// Noises that two corners of a blunt edge are apart, at least.
const FACE: f64 = 5.0;
/// Share of the distance of two points within which a corner lies amid them.
const AMID: f64 = 0.25;
/// Distances of the points before it beyond which a corner has none of its sides' points near it.
const NEXT: f64 = 1.2;
/// The widths of both ends are compared at this share of the chord.
const STATION: f64 = 0.05;
/// The ends of an open row are no farther apart than this share of the chord.
const APART: f64 = 0.2;

/// What the trailing edge is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrailingEdge {
    /// A corner.
    Sharp,
    /// Cut off: two corners that are so far apart.
    Blunt(f64),
    /// Without corner.
    Round,
    /// Open: the row ends there, its ends are so far apart.
    Open(f64),
}

impl TrailingEdge {
    /// The word for it: `sharp`, `blunt`, `round`, `open`.
    pub fn name(self) -> &'static str {
        match self {
            TrailingEdge::Sharp => "sharp",
            TrailingEdge::Blunt(_) => "blunt",
            TrailingEdge::Round => "round",
            TrailingEdge::Open(_) => "open",
        }
    }
}

pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

/// A profile from its trailing edge over the leading one and back.
pub(super) struct Around {
    /// The points; at a sharp trailing edge first and last are the same, at a round one the row goes on beyond it at both ends.
    pub row: Vec<[f64; 2]>,
    /// The points that it begins and ends at, by their numbers in the row given; of a round trailing edge that of the seam.
    pub ends: [usize; 2],
    /// So many points at either end are those of the other.
    pub over: usize,
    pub trailing: TrailingEdge,
}

impl Around {
    /// Of a row, whose corners are `known`, or told by its points.
    pub fn new(row: &[[f64; 2]], closed: bool, known: Option<&[[f64; 2]]>) -> Result<Around, AirfoilError> {
        if !closed {
            let (a, b) = (row[0], row[row.len() - 1]);
            let (middle, gap) = ([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])], distance(a, b));
            let chord = row.iter().map(|p| distance(*p, middle)).fold(0.0, f64::max);
            if gap > APART * chord {
                return Err(AirfoilError::Open { gap, chord });
            }
            return Ok(Around {
                row: row.to_vec(),
                ends: [0, row.len() - 1],
                over: 0,
                trailing: TrailingEdge::Open(gap),
            });
        }
        let (mut head, mut tail) = diameter(row);
        if width(row, head, tail) < width(row, tail, head) {
            (head, tail) = (tail, head);
        }
        let corners = match known {
            Some(known) => known_corners(row, head, tail, known),
            None => corners(row, head, tail),
        };
        let n = row.len();
        let run = |from: usize, count: usize| -> Vec<[f64; 2]> {
            (from..=from + count).map(|i| row[i % n]).collect()
        };
        // Two points side by side may be the corners of a face that has no others.
        let face = match (&corners[..], known) {
            ([one], Some(known)) => face(row, *one, known),
            _ => None,
        };
        Ok(match face.as_ref().unwrap_or(&corners)[..] {
            [one] => Around { row: run(one, n), ends: [one; 2], over: 0, trailing: TrailingEdge::Sharp },
            [before, after] => {
                let trailing = TrailingEdge::Blunt(distance(row[before], row[after]));
                Around { row: run(after, (before + n - after) % n), ends: [after, before], over: 0, trailing }
            }
            _ => {
                let over = n / 16 + 1;
                Around {
                    row: run(tail + n - over, n + 2 * over),
                    ends: [tail; 2],
                    over,
                    trailing: TrailingEdge::Round,
                }
            }
        })
    }
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

/// Width of the profile across the chord, near the end `own` of it.
fn width(row: &[[f64; 2]], own: usize, other: usize) -> f64 {
    let (o, e) = (row[own], row[other]);
    let chord = distance(o, e);
    let along = [(e[0] - o[0]) / chord, (e[1] - o[1]) / chord];
    let local = |p: [f64; 2]| {
        let d = [p[0] - o[0], p[1] - o[1]];
        (d[0] * along[0] + d[1] * along[1] - STATION * chord, along[0] * d[1] - along[1] * d[0])
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

/// The points nearest to corners near the end `tail`, as [`corners`] tells them.
fn known_corners(row: &[[f64; 2]], head: usize, tail: usize, known: &[[f64; 2]]) -> Vec<usize> {
    let (n, chord) = (row.len(), distance(row[head], row[tail]));
    let near = known.iter().filter(|c| distance(**c, row[tail]) < NEAR * chord);
    let nearest = |c: &[f64; 2]| {
        let off = |i: &usize| distance(row[*i], *c);
        (0..n).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(tail)
    };
    let mut found: Vec<usize> = near.map(nearest).collect();
    found.sort_by_key(|i| (i + n + n / 2 - tail) % n);
    found.dedup();
    if found.len() > 2 { vec![] } else { found }
}

/// The two points between which the corner nearest to point `at` lies, in the order of the row, where the profile ends with the face between
/// them: the corner lies amid them, or farther beyond them than the next point of either side would, if the sides ran on to meet.
fn face(row: &[[f64; 2]], at: usize, known: &[[f64; 2]]) -> Option<Vec<usize>> {
    let (n, (noise, _)) = (row.len(), noise(row, true));
    let corner = known.iter().min_by(|a, b| distance(**a, row[at]).total_cmp(&distance(**b, row[at])))?;
    let is_face = |[a, b]: &[usize; 2]| {
        let (p, q) = (row[*a], row[*b]);
        let (gap, middle) = (distance(p, q), [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])]);
        let step = distance(p, row[(a + n - 1) % n]).max(distance(q, row[(b + 1) % n]));
        let beyond = distance(*corner, middle);
        gap > FACE * noise && (beyond < AMID * gap || beyond > gap.max(NEXT * step))
    };
    [[(at + n - 1) % n, at], [at, (at + 1) % n]].into_iter().find(is_face).map(Vec::from)
}

/// The corners near the end `tail`: none, or one, or the first and the last of two, in the order of the row; none, too, where there
/// are more: then too few points tell a round edge.
fn corners(row: &[[f64; 2]], head: usize, tail: usize) -> Vec<usize> {
    let n = row.len();
    let (noise, _) = noise(row, true);
    let chord = distance(row[head], row[tail]);
    let direction = |i: usize, j: usize| {
        let (a, b) = (row[i % n], row[j % n]);
        [b[0] - a[0], b[1] - a[1]]
    };
    let half = n / 4;
    let near = |i: &usize| distance(row[*i % n], row[tail]) < NEAR * chord;
    let order: Vec<usize> = (tail + n - half..=tail + n + half).filter(near).collect();
    // The turn between points so far apart that their scatter hardly turns the way between them.
    let apart = noise / STEADY;
    let reach = |i: usize, step: usize| {
        let far = |k: &usize| distance(row[i % n], row[(i + k * step) % n]) >= apart;
        (1..half.max(2)).find(far).unwrap_or(1)
    };
    let turned = |i: usize| {
        let (before, after) = (i + (n - 1) * reach(i, n - 1), i + reach(i, 1));
        turn(direction(before, i), direction(i, after)).abs()
    };
    let scatter = if apart > 0.0 { noise * 6.0_f64.sqrt() / apart } else { 0.0 };
    let sharp = |i: &usize| {
        let own = turned(*i);
        // The greatest turn among the neighbors that share its way.
        let (after, before) = (reach(*i, 1), reach(*i, n - 1));
        own > CORNER + SURE * scatter
            && (1..after).all(|k| own >= turned(i + k))
            && (1..before).all(|k| own > turned(i + (n - 1) * k))
    };
    let found: Vec<usize> = order.into_iter().filter(sharp).map(|i| i % n).collect();
    if found.len() > 2 { vec![] } else { found }
}

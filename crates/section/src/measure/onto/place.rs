//! The places of the nominal nearest to points, with the directions in which distances grow.

use super::super::nominal::{OffNominal, Outline};
use crate::model::result::{Geometry, Segment};

/// A point with the place nearest to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Number of the point in its row.
    pub index: usize,
    pub point: [f64; 2],
    pub place: [f64; 2],
    /// Distance along the normal.
    pub distance: f64,
    /// Unit direction in which the distance grows.
    pub normal: [f64; 2],
    /// Unit normal of the curve that the outline's chords follow.
    pub smooth: [f64; 2],
    /// The place is a corner: the distance is always that to this place, whichever way the point goes.
    pub is_corner: bool,
}

impl Place {
    /// The direction across the normal.
    pub fn across(&self) -> [f64; 2] {
        [-self.normal[1], self.normal[0]]
    }
}

/// The places of a row.
#[derive(Debug)]
pub(super) struct Row {
    pub places: Vec<Place>,
}

/// The places of all rows.
#[derive(Debug)]
pub(super) struct Places {
    pub rows: Vec<Row>,
}

impl Places {
    pub fn all(&self) -> impl Iterator<Item = &Place> {
        self.rows.iter().flat_map(|r| &r.places)
    }

    pub fn distances(&self) -> impl Iterator<Item = f64> {
        self.all().map(|p| p.distance)
    }

    /// Points that have a place in both: their numbers among all here, the place here, the place there.
    fn pairs<'a>(&'a self, other: &'a Places) -> impl Iterator<Item = (usize, &'a Place, &'a Place)> {
        let mut number = 0;
        self.rows.iter().zip(&other.rows).flat_map(move |(own, other)| {
            let mut other = other.places.iter().peekable();
            let first = number;
            number += own.places.len();
            (first..).zip(&own.places).filter_map(move |(n, p)| {
                while other.next_if(|o| o.index < p.index).is_some() {}
                Some((n, p, other.next_if(|o| o.index == p.index)?))
            })
        })
    }

    /// Whether the weighted squares of the distances are less in `other`, of the points that have a place in both.
    pub fn come_nearer(&self, other: &Places, weights: &[f64]) -> bool {
        let grown = |(n, own, other): (usize, &Place, &Place)| {
            weights[n] * (other.distance * other.distance - own.distance * own.distance)
        };
        self.pairs(other).map(grown).sum::<f64>() <= 0.0
    }

    /// Root mean square of the distances here, of the points that are within reach in `other`.
    pub fn rms_of(&self, other: &Places, reach: f64) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for (_, own, _) in self.pairs(other).filter(|(_, _, other)| other.distance.abs() <= reach) {
            sum += own.distance * own.distance;
            count += 1.0;
        }
        (sum / f64::max(count, 1.0)).sqrt()
    }
}

/// Lags of a row over which its distances may go together.
const MAX_LAGS: usize = 1000;

impl Row {
    pub fn new(points: &[[f64; 2]], found: &[Option<OffNominal>], outlines: &[Outline]) -> Row {
        let ends: Vec<Vec<f64>> = outlines.iter().map(ends).collect();
        let each = |(index, (point, off)): (usize, (&[f64; 2], &Option<OffNominal>))| {
            let off = (*off)?;
            let (outline, ends) = (&outlines[off.outline], &ends[off.outline]);
            let number = number(outline, ends, &off, *point)?;
            let segment = &outline.segments[number];
            let foot = segment.nearest(*point);
            let left = unit([-foot.along[1], foot.along[0]])?;
            let inner = foot.share > 0.0 && foot.share < 1.0;
            let d = [point[0] - foot.place[0], point[1] - foot.place[1]];
            let (distance, normal, at_end) = match unit(d) {
                Some(out) if !inner => (foot.distance.abs(), out, true),
                _ => (foot.distance, left, false),
            };
            let smooth = smooth(outline, number, foot.share).unwrap_or(left);
            let is_corner = at_end && is_sharp(outline, number, foot.share > 0.0);
            Some(Place { index, point: *point, place: foot.place, distance, normal, smooth, is_corner })
        };
        Row { places: points.iter().zip(found).enumerate().filter_map(each).collect() }
    }

    /// So many successive points tell as much as one that scatters alone. It is 1 and twice the sum of the
    /// correlations, as far as pairs of them are above 0 (C. J. Geyer 1992).
    pub fn correlated(&self, reach: f64) -> f64 {
        let d: Vec<f64> = self.places.iter().map(|p| p.distance).filter(|d| d.abs() <= reach).collect();
        let n = d.len();
        let mean = d.iter().sum::<f64>() / n.max(1) as f64;
        let together = |lag: usize| (lag..n).map(|i| (d[i] - mean) * (d[i - lag] - mean)).sum::<f64>();
        let variance = together(0);
        if variance <= 0.0 {
            return 1.0;
        }
        let mut sum = -1.0;
        for lag in (0..(n / 4).min(MAX_LAGS)).step_by(2) {
            let pair = (together(lag) + together(lag + 1)) / variance;
            if pair <= 0.0 {
                break;
            }
            sum += 2.0 * pair;
        }
        f64::max(sum, 1.0)
    }
}

/// Lengths of an outline to the end of each segment.
fn ends(outline: &Outline) -> Vec<f64> {
    let sums = outline.segments.iter().scan(0.0, |sum, s| {
        *sum += s.length;
        Some(*sum)
    });
    sums.collect()
}

/// The segment that the nearest place is on.
fn number(outline: &Outline, ends: &[f64], off: &OffNominal, point: [f64; 2]) -> Option<usize> {
    let at = ends.partition_point(|end| *end < off.along);
    let candidates = at.saturating_sub(1)..(at + 2).min(ends.len());
    let far = |k: &usize| outline.segments[*k].nearest(point).distance.abs();
    candidates.min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// Chords that turn by less than this follow a curve, radians: as where facets are taken for an arc.
const MAX_FACET_TURN: f64 = 0.6;

/// The normal of the curve that a chord follows, at a share of it. It lies between those of its ends, where chords of
/// about a circle's meet. Each counts with the other's length, which is exact on a circle. Other segments have their
/// own.
fn smooth(outline: &Outline, number: usize, share: f64) -> Option<[f64; 2]> {
    let (all, n) = (&outline.segments, outline.segments.len());
    let segment = &all[number];
    if segment.geometry != Geometry::Line {
        return None;
    }
    let own = along(segment)?;
    let direction_towards = |next: bool| -> [f64; 2] {
        let k = if next { number + 1 } else { number + n - 1 };
        let is_end = if next { number + 1 == n } else { number == 0 };
        let other = all.get(k % n).filter(|o| (outline.closed || !is_end) && o.geometry == Geometry::Line);
        let met = other.and_then(|other| {
            let a = along(other)?;
            let gentle = libm::atan2(own[0] * a[1] - own[1] * a[0], own[0] * a[0] + own[1] * a[1]).abs()
                < MAX_FACET_TURN;
            gentle.then(|| unit([0, 1].map(|k| own[k] * other.length + a[k] * segment.length)))?
        });
        met.unwrap_or(own)
    };
    let [a, b] = [direction_towards(false), direction_towards(true)];
    let [x, y] = [0, 1].map(|k| a[k] * (1.0 - share) + b[k] * share);
    unit([-y, x])
}

/// Whether the outline turns at an end of a segment by more than chords of a curve do.
fn is_sharp(outline: &Outline, number: usize, at_its_end: bool) -> bool {
    let (all, n) = (&outline.segments, outline.segments.len());
    let [before, after] =
        if at_its_end { [number, (number + 1) % n] } else { [(number + n - 1) % n, number] };
    let is_joined = after != 0 || outline.closed;
    let (a, b) = (&all[before], &all[after]);
    let [a, b] = [a.nearest(a.end).along, b.nearest(b.start).along];
    let turn = libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    is_joined && turn.abs() >= MAX_FACET_TURN
}

fn along(segment: &Segment) -> Option<[f64; 2]> {
    unit([0, 1].map(|k| segment.end[k] - segment.start[k]))
}

fn unit(v: [f64; 2]) -> Option<[f64; 2]> {
    let size = libm::hypot(v[0], v[1]);
    (size > 0.0).then(|| v.map(|x| x / size))
}

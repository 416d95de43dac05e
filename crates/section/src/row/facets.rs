//! The straight runs of a polyline cut from facets, and the arcs whose chords they are.
//!
//! The points of such a polyline carry no random noise. The edge of a flat face is straight to rounding, however long; the
//! chords of an arc have their ends on the circle. So a polyline is first reduced to its vertices: points on a straight run
//! are passed over. Then vertices on one circle are looked for, from each vertex on as far as they go. An arc needs three
//! chords: four vertices on a circle are one more than determine it. Two wide chords, or a few, are an arc where its tangents at
//! both ends are the facets before and after.

use crate::model::flat::{angle, distance, minus};
use crate::search::parts::circle;

/// A chord turns by no more than this, 34.4 degrees. It is midway between regular polygons of ten sides, which are
/// polygons, and of eleven, which are circles.
pub(crate) const SHARP_TURN: f64 = 0.6;
/// Turns that differ from the sharp one by less than this factor are near it. Where some chords of a circle turn by less and others
/// by more, all are lines.
const NEAR_SHARP_RATIO: f64 = 1.15;
/// A chord of an arc that is tangent to the facets beside may turn by a right angle.
pub(super) const MAX_TANGENT_CHORD_TURN: f64 = std::f64::consts::FRAC_PI_2;
/// Three chords of an arc are not more uneven than this.
const MAX_CHORD_RATIO: f64 = 3.0;
/// Most chords of an arc that is known by its tangents.
const MAX_FILLET_CHORDS: usize = 8;
/// The middle of an arc lies off its chord by at least so many distances that are lost in rounding.
const MIN_SAGITTA_ROUNDINGS: f64 = 4.0;

/// The vertices of a polyline.
#[derive(Clone, Debug, Default)]
pub(crate) struct Polygon {
    pub at: Vec<[f64; 2]>,
    /// Their numbers among the points.
    pub numbers: Vec<usize>,
    pub closed: bool,
}

/// The shape of facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LineOrArc {
    Line,
    /// Center, and the curvature, left turns positive.
    Arc([f64; 2], f64),
}

/// Consecutive facets: from one vertex to another, on a closed polygon beyond the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Item {
    pub shape: LineOrArc,
    pub from: usize,
    pub to: usize,
}

/// The directions in which a straight run may go on: all its points lie within a tolerance of it.
struct Cone {
    apex: [f64; 2],
    tolerance: f64,
    /// The first direction, and the least and greatest angle with it.
    range: Option<([f64; 2], f64, f64)>,
    farthest: f64,
}

impl Cone {
    fn new(apex: [f64; 2], tolerance: f64) -> Cone {
        Cone { apex, tolerance, range: None, farthest: 0.0 }
    }
    fn takes(&mut self, p: [f64; 2]) -> bool {
        let d = distance(self.apex, p);
        if d <= self.tolerance {
            return self.farthest <= self.tolerance;
        }
        let v = minus(p, self.apex);
        let width = libm::asin((self.tolerance / d).min(1.0));
        let Some((first, low, high)) = self.range else {
            self.range = Some((v, -width, width));
            self.farthest = d;
            return true;
        };
        let turn = angle(first, v);
        if turn < low || turn > high || d < self.farthest - self.tolerance {
            return false;
        }
        self.range = Some((first, low.max(turn - width), high.min(turn + width)));
        self.farthest = self.farthest.max(d);
        true
    }
}

impl Polygon {
    /// The vertices of a polyline whose points lie within `tolerance` of it. Linear in the number of points.
    pub fn new(points: &[[f64; 2]], closed: bool, tolerance: f64) -> Polygon {
        let n = points.len();
        let middle = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n as f64);
        // The point farthest from the middle is a vertex.
        let far = |i: &usize| distance(middle, points[*i]);
        let start = if closed { (0..n).max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0) } else { 0 };
        let point = |k: usize| points[(start + k) % n];
        let last = if closed { n } else { n - 1 };
        let mut kept = vec![0];
        let mut cone = Cone::new(point(0), tolerance);
        for k in 1..=last {
            if !cone.takes(point(k)) {
                kept.push(k - 1);
                cone = Cone::new(point(k - 1), tolerance);
                cone.takes(point(k));
            }
        }
        if !closed {
            kept.push(last);
        }
        let mut polygon = Polygon {
            at: kept.iter().map(|k| point(*k)).collect(),
            numbers: kept.iter().map(|k| (start + k) % n).collect(),
            closed,
        };
        if closed {
            // The longest facet comes first: no arc goes on over its start, unless all is one arc.
            let facets = polygon.at.len();
            let size = |i: &usize| distance(polygon.vertex(*i), polygon.vertex(i + 1));
            let by = (0..facets).max_by(|a, b| size(a).total_cmp(&size(b)).then(b.cmp(a))).unwrap_or(0);
            polygon.at.rotate_left(by);
            polygon.numbers.rotate_left(by);
        }
        polygon
    }

    /// Number of facets.
    pub fn facets(&self) -> usize {
        self.at.len() - usize::from(!self.closed)
    }
    pub fn vertex(&self, i: usize) -> [f64; 2] {
        self.at[i % self.at.len()]
    }
    /// From a vertex to the next.
    pub fn facet(&self, i: usize) -> [f64; 2] {
        minus(self.vertex(i + 1), self.vertex(i))
    }
    pub fn facet_length(&self, i: usize) -> f64 {
        distance(self.vertex(i), self.vertex(i + 1))
    }
    /// Turn at a vertex between two facets.
    pub fn turn(&self, i: usize) -> f64 {
        let before = if i == 0 { self.at.len() - 1 } else { i - 1 };
        angle(self.facet(before), self.facet(i))
    }

    /// The facets as lines and arcs.
    pub fn items(&self, tolerance: f64) -> Vec<Item> {
        let m = self.facets();
        let turns: Vec<f64> =
            (0..m).map(|i| if i == 0 && !self.closed { 0.0 } else { self.turn(i) }).collect();
        // Last vertex up to which the turns have one sense and are no corners.
        let mut reach = vec![m; m + 1];
        for i in (0..m).rev() {
            let next = i + 1;
            reach[i] = if next >= m {
                m
            } else if turns[next] == 0.0 || turns[next].abs() > SHARP_TURN {
                next
            } else if next + 1 < m && turns[next] * turns[next + 1] > 0.0 {
                reach[next]
            } else {
                next + 1
            };
        }
        let mut items = vec![];
        let mut i = 0;
        while i < m {
            let item = match self.arc_from(i, reach[i], tolerance) {
                Some(item) => item,
                None => Item { shape: LineOrArc::Line, from: i, to: i + 1 },
            };
            items.push(item);
            i = item.to;
        }
        self.join_seam(&mut items, tolerance);
        self.dissolve(&mut items, tolerance);
        self.fillets(&mut items, tolerance);
        items
    }

    /// The longest arc of at least three chords that starts at a vertex.
    fn arc_from(&self, from: usize, reach: usize, tolerance: f64) -> Option<Item> {
        if reach < from + 3 {
            return None;
        }
        let mut best = self.arc(from, from + 3, SHARP_TURN, tolerance)?;
        let (mut step, mut fails) = (1, reach + 1);
        while best.to < reach {
            let to = (best.to + step).min(fails - 1);
            if to == best.to {
                break;
            }
            match self.arc(from, to, SHARP_TURN, tolerance) {
                Some(longer) => (best, step) = (longer, 2 * step),
                None => (fails, step) = (to, 1.max((to - best.to) / 2)),
            }
        }
        // The corners of any symmetric trapezoid lie on a circle.
        let sizes = || (best.from..best.to).map(|i| self.facet_length(i));
        let uneven = sizes().fold(0.0, f64::max) > MAX_CHORD_RATIO * sizes().fold(f64::INFINITY, f64::min);
        (best.to > best.from + 3 || !uneven).then_some(best)
    }

    /// The arc through these vertices, where they lie on a circle and no chord turns by more than `widest`.
    fn arc(&self, from: usize, to: usize, widest: f64, tolerance: f64) -> Option<Item> {
        let points: Vec<[f64; 2]> = (from..=to).map(|i| self.vertex(i)).collect();
        let (center, radius) = round(&points)?;
        let off = points.iter().map(|p| (distance(center, *p) - radius).abs()).fold(0.0, f64::max);
        let chord = points.windows(2).map(|w| distance(w[0], w[1])).fold(0.0, f64::max);
        let turned: f64 = points.windows(2).map(|w| angle(minus(w[0], center), minus(w[1], center))).sum();
        let sagitta = radius * (1.0 - libm::cos(0.5 * turned.abs().min(std::f64::consts::PI)));
        let widest = 2.0 * radius * libm::sin(0.5 * widest);
        let fits = off <= tolerance
            && chord <= widest * (1.0 + 1e-9)
            && sagitta >= MIN_SAGITTA_ROUNDINGS * tolerance;
        // Once round is enough.
        let fits = fits && turned.abs() <= std::f64::consts::TAU * (1.0 + 1e-6);
        fits.then(|| Item { shape: LineOrArc::Arc(center, turned.signum() / radius), from, to })
    }

    /// The last and the first item of a closed polygon, if they are one arc.
    fn join_seam(&self, items: &mut Vec<Item>, tolerance: f64) {
        if !self.closed || items.len() < 2 {
            return;
        }
        let (first, last) = (items[0], items[items.len() - 1]);
        let arcs = [first, last].iter().all(|i| i.shape != LineOrArc::Line);
        if let Some(whole) =
            self.arc(last.from, first.to + self.facets(), SHARP_TURN, tolerance).filter(|_| arcs)
        {
            items.pop();
            items[0] = whole;
            items.rotate_left(1);
        }
    }

    /// Some arcs have chords that turn by nearly as much as a corner. They become lines where chords of the same circle
    /// beside them turn by little more. Else rounding would decide which are arcs there, and which lines.
    fn dissolve(&self, items: &mut Vec<Item>, tolerance: f64) {
        let mut k = 0;
        while k < items.len() {
            let n = items.len();
            let (item, neighbors) = (items[k], [items[(k + n - 1) % n], items[(k + 1) % n]]);
            let LineOrArc::Arc(center, curvature) = item.shape else {
                k += 1;
                continue;
            };
            let turn = |i: usize| libm::asin((0.5 * curvature * self.facet_length(i)).abs().min(1.0)) * 2.0;
            let widest = (item.from..item.to).map(turn).fold(0.0, f64::max);
            let off =
                |i: usize| (distance(center, self.vertex(i)) * curvature.abs() - 1.0).abs() / curvature.abs();
            let doubtful = |other: &Item| {
                let on = off(other.from).max(off(other.to)) <= 2.0 * tolerance;
                other.shape == LineOrArc::Line && on && turn(other.from) <= NEAR_SHARP_RATIO * SHARP_TURN
            };
            let whole = item.to - item.from == self.facets();
            if widest * NEAR_SHARP_RATIO < SHARP_TURN || whole || !neighbors.iter().any(doubtful) {
                k += 1;
                continue;
            }
            let line = |from: usize| Item { shape: LineOrArc::Line, from, to: from + 1 };
            items.splice(k..=k, (item.from..item.to).map(line));
            // Arcs before may touch lines now.
            k = 0;
        }
    }

    /// Whether a line item and those after it, short ones between longer ones, are the chords of an arc tangent to these.
    fn fillet(&self, items: &[Item], k: usize, count: usize, tolerance: f64) -> Option<Item> {
        let n = items.len();
        let inner = self.closed || k > 0 && k + count < n;
        if !inner || k + count > n || n < count + 2 {
            return None;
        }
        let chords = &items[k..k + count];
        let (before, after) = (items[(k + n - 1) % n], items[(k + count) % n]);
        if chords.iter().chain([&before, &after]).any(|i| i.shape != LineOrArc::Line) {
            return None;
        }
        let sizes = || chords.iter().map(|i| self.facet_length(i.from));
        let shorter_neighbor = self.facet_length(before.from).min(self.facet_length(after.from));
        let bent = chords[1..].iter().map(|i| self.turn(i.from % self.at.len()).abs()).fold(0.0, f64::max);
        if sizes().fold(0.0, f64::max) >= shorter_neighbor || bent > MAX_TANGENT_CHORD_TURN {
            return None;
        }
        let arc = self.arc(chords[0].from, chords[count - 1].to, MAX_TANGENT_CHORD_TURN, tolerance)?;
        let LineOrArc::Arc(center, curvature) = arc.shape else { return None };
        let slack = self.slack(sizes().fold(f64::INFINITY, f64::min), tolerance);
        let along = |i: usize| {
            let r = minus(self.vertex(i), center);
            [-r[1] * curvature, r[0] * curvature]
        };
        let tangent = angle(self.facet(before.from), along(arc.from)).abs() < slack
            && angle(along(arc.to), self.facet(after.from)).abs() < slack;

        tangent.then_some(arc)
    }

    /// Two or a few short facets between longer ones that are the chords of an arc tangent to these.
    fn fillets(&self, items: &mut Vec<Item>, tolerance: f64) {
        let mut k = 0;
        while k + 1 < items.len() {
            let found =
                (2..=MAX_FILLET_CHORDS).rev().find_map(|c| Some((c, self.fillet(items, k, c, tolerance)?)));
            if let Some((count, arc)) = found {
                items.splice(k..k + count, [arc]);
            }
            k += 1;
        }
    }

    /// Number of vertices that lie on one circle with the three after them, however wide the chords.
    pub fn round(&self, tolerance: f64) -> usize {
        let last = if self.closed { self.at.len() } else { self.at.len().saturating_sub(3) };
        (0..last).filter(|i| self.arc(*i, i + 3, std::f64::consts::PI, tolerance).is_some()).count()
    }

    /// Angle up to which two directions are the same where the shorter facet beside has this length.
    pub fn slack(&self, shortest: f64, tolerance: f64) -> f64 {
        (12.0 * tolerance / shortest.max(f64::MIN_POSITIVE)).clamp(1e-4, 0.05)
    }
}

/// The circle nearest to points, by Taubin's method.
pub(super) fn round(points: &[[f64; 2]]) -> Option<([f64; 2], f64)> {
    let n = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let mut sums = [0.0; 7];
    let mut squares = 0.0;
    for p in points {
        let [x, y] = minus(*p, mean);
        let z = x * x + y * y;
        let terms = [x * x, x * y, y * y, x * z, y * z];
        (0..5).for_each(|k| sums[k] += terms[k]);
        squares += z;
    }
    sums[6] = squares / n;
    sums[5] = (points.iter().map(|p| minus(*p, mean)))
        .map(|[x, y]| (x * x + y * y - sums[6]) * (x * x + y * y - sums[6]))
        .sum();
    let (_, center, radius) = circle(n, sums)?;
    Some(([center[0] + mean[0], center[1] + mean[1]], radius))
}

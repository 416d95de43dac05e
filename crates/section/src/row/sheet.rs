//! Polylines of exact lines and arcs as contours: each segment from one vertex to another.

use super::facets::{Item, LineOrArc, Polygon};
use crate::model::flat::angle;
use crate::model::result::{Continuity, Contour, Geometry, Join, Options, RowKind, Segment};
use trueness_geom::num::special::student_quantile;

/// Lengths before each segment.
pub(crate) fn starts(segments: &[Segment]) -> Vec<f64> {
    segments
        .iter()
        .scan(0.0, |sum, s| {
            *sum += s.length;
            Some(*sum - s.length)
        })
        .collect()
}

/// The nearest of these segments to a point: its number, the station and the distance.
pub(crate) fn nearest(
    segments: &[Segment],
    starts: &[f64],
    among: impl Iterator<Item = u32>,
    point: [f64; 2],
) -> (u32, f64, f64) {
    let mut best = (0, 0.0, f64::INFINITY);
    for label in among {
        let (station, off) = segments[label as usize].foot(point);
        if off.abs() < best.2.abs() {
            best = (label, starts[label as usize] + station, off);
        }
    }
    best
}

/// A polyline of exact facets.
pub(crate) struct Sheet<'a> {
    pub points: &'a [[f64; 2]],
    pub polygon: Polygon,
    pub rounding: f64,
    pub options: &'a Options,
}

impl Sheet<'_> {
    /// The contour of these lines and arcs, whatever they may be the chords of.
    pub fn exact(&self, items: &[Item]) -> Contour {
        let segments: Vec<Segment> = items.iter().map(|i| self.segment(i)).collect();
        let joins = if self.polygon.closed { items.len() } else { items.len() - 1 };
        let join = |k: usize| self.join(&segments[k], &segments[(k + 1) % items.len()], items[k].to, 0.0);
        let joins = (0..joins).map(join).collect();
        let owners: Vec<_> = items.iter().enumerate().map(|(k, i)| (*i, k..k + 1)).collect();
        self.finish(segments, joins, &owners)
    }

    /// Whether two segments have a common tangent at a vertex, where their directions are uncertain by `slack` at least.
    pub fn is_tangent(&self, before: &Segment, after: &Segment, vertex: usize, slack: f64) -> bool {
        let turn = angle(before.directions()[1], after.directions()[0]);
        turn.abs() <= slack.max(self.polygon.slack(self.shorter_facet_at(vertex), self.rounding))
    }

    /// Length of the shorter facet beside a vertex.
    pub fn shorter_facet_at(&self, vertex: usize) -> f64 {
        let n = self.polygon.at.len();
        self.polygon.facet_length((vertex + n - 1) % n).min(self.polygon.facet_length(vertex % n))
    }

    pub fn segment(&self, item: &Item) -> Segment {
        let (start, end) = (self.polygon.vertex(item.from), self.polygon.vertex(item.to));
        let base = Segment::line(start, end);
        let LineOrArc::Arc(center, curvature) = item.shape else { return base };
        let out = |i: usize| {
            let p = self.polygon.vertex(i);
            [p[0] - center[0], p[1] - center[1]]
        };
        let whole = self.polygon.closed && item.to - item.from == self.polygon.facets();
        let turned: f64 = (item.from..item.to).map(|i| angle(out(i), out(i + 1))).sum();
        let sweep = if whole { std::f64::consts::TAU * turned.signum() } else { turned };
        let radius = 1.0 / curvature.abs();
        let at = libm::atan2(out(item.from)[1], out(item.from)[0]);
        let geometry = Geometry::Arc { center, radius, start: at, sweep };
        Segment { geometry, length: radius * sweep.abs(), curvature: [curvature; 2], ..base }
    }

    /// The join of two exact segments at a vertex, or of one with a curve whose direction there is uncertain by `slack`.
    pub fn join(&self, before: &Segment, after: &Segment, vertex: usize, slack: f64) -> Join {
        let turn = angle(before.directions()[1], after.directions()[0]);
        let shorter_facet_at = self.shorter_facet_at(vertex);
        let smooth = self.is_tangent(before, after, vertex, slack);
        // Where the two are no farther apart than rounding loses.
        let uncertainty = match smooth {
            true => {
                let jump = (before.curvature[1] - after.curvature[0]).abs();
                (2.0 * self.rounding / jump.max(f64::MIN_POSITIVE)).sqrt().min(shorter_facet_at)
            }
            false => self.rounding / libm::sin(0.5 * turn.abs()).max(1e-3),
        };
        let [along, next] = [before.directions()[1], after.directions()[0]].map(|v| {
            let size = libm::hypot(v[0], v[1]).max(f64::MIN_POSITIVE);
            [v[0] / size, v[1] / size]
        });
        let along = if smooth { along } else { [along[0] - next[0], along[1] - next[1]] };
        let size = libm::hypot(along[0], along[1]).max(f64::MIN_POSITIVE);
        let reach = student_quantile(1.0 - self.options.level, 1e6) * uncertainty / size;
        let point = self.polygon.vertex(vertex);
        Join {
            point,
            continuity: if smooth { Continuity::G1 } else { Continuity::G0 },
            interval: [-reach, reach].map(|x| [point[0] + x * along[0], point[1] + x * along[1]]),
            uncertainty,
            open: [false; 2],
            turn: if smooth { 0.0 } else { turn },
        }
    }

    /// Puts the contour together: each segment with the statistics of its points.
    pub fn finish(
        &self,
        segments: Vec<Segment>,
        joins: Vec<Join>,
        owners: &[(Item, std::ops::Range<usize>)],
    ) -> Contour {
        let count = self.points.len();
        let mut all = Contour { closed: self.polygon.closed, segments, joins, ..Contour::default() };
        all.row_kind = RowKind::Facets;
        (all.labels, all.residuals, all.stations) = (vec![0; count], vec![0.0; count], vec![0.0; count]);
        let starts = starts(&all.segments);
        for (item, range) in owners {
            let number = |i: usize| self.polygon.numbers[i % self.polygon.at.len()];
            let (from, to) = (number(item.from), number(item.to));
            let whole = self.polygon.closed && item.to - item.from == self.polygon.facets();
            let steps = if whole { count } else { (to + count - from) % count };
            // The last point of all belongs to the last segment, that of others to the next.
            let steps = steps + usize::from(!self.polygon.closed && to + 1 == count);
            for i in (from..from + steps).map(|i| i % count) {
                let among = range.clone().map(|l| l as u32);
                (all.labels[i], all.stations[i], all.residuals[i]) =
                    nearest(&all.segments, &starts, among, self.points[i]);
            }
        }
        all.segments.iter_mut().for_each(|s| (s.count, s.rms, s.max) = (0, 0.0, 0.0));
        for (label, off) in all.labels.iter().zip(&all.residuals) {
            let segment = &mut all.segments[*label as usize];
            segment.count += 1;
            segment.rms += off * off;
            segment.max = segment.max.max(off.abs());
        }
        all.segments.iter_mut().for_each(|s| s.rms = (s.rms / s.count.max(1) as f64).sqrt());
        let sum: f64 = all.residuals.iter().map(|r| r * r).sum();
        all.noise = (sum / count as f64).sqrt();
        all.spacing = all.length() / count as f64;
        all
    }
}

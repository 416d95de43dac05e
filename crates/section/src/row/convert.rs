//! Pieces of a chain as lines, arcs and B-splines.

use crate::model::chain::{Layout, Piece, SegmentKind, arc_end, arc_to};
use crate::model::result::{Continuity, Contour, Geometry, Join, Segment, Uncertainty};
use crate::search::span::{Found, single};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::{self, Curve, End, Ends};
use trueness_geom::spline::value::Value;

/// Segments of one chain, and the joins between them.
pub(super) struct Parts {
    pub segments: Vec<Segment>,
    pub joins: Vec<Join>,
    /// Length of all.
    pub length: f64,
    /// The length from the start of the first segment to the foot of each point of the chain.
    pub stations: Vec<f64>,
}

/// A jump of curvature below so many standard deviations is none.
const MIN_JUMP_SIGMAS: f64 = 2.0;

/// The segments of a chain whose ends are the corners given, or else the feet of its first and last point.
pub(super) fn segments(found: &Found, corners: [Option<[f64; 2]>; 2], spacing: f64) -> Parts {
    let pieces = found.pieces();
    let closed = found.state.chain.closed;
    let n = pieces.len();
    let count = found.span.points.len();
    // Lengths that the first and last piece are longer by.
    let along = |join: usize, at: [f64; 2]| {
        let pose = found.layout.poses[join];
        let bend = if join == 0 { pieces[0].curvature(0.0) } else { pieces[join - 1].curvature(1.0) };
        arc_to(pose.into_frame([at[0] - pose.at[0], at[1] - pose.at[1]]), bend)
    };
    let (mut before, mut after) = (0.0, 0.0);
    if found.circle {
        after = std::f64::consts::TAU / pieces[0].curvature(0.0).abs() - pieces[0].length;
    } else if !closed {
        before = corners[0].map_or(-found.first_foot(), |c| -along(0, c));
        after = corners[1].map_or(found.last_foot(), |c| along(n, c));
    }
    let mut segments: Vec<Segment> = vec![];
    let mut stations = vec![0.0; count];
    let (mut way, mut own_way) = (0.0, 0.0);
    for (g, piece) in pieces.iter().enumerate() {
        let from = if g == 0 { -before } else { 0.0 };
        let to = piece.length + if g + 1 == n { after } else { 0.0 };
        let at = [corners[0].filter(|_| g == 0), corners[1].filter(|_| g + 1 == n)];
        let tolerance = found.noise.max(1e-4 * spacing);
        let mut segment = segment(&found.layout, g, piece, [from, to], at, tolerance);
        // A free curve that is led to a corner is as long as it is drawn.
        let mut longer = vec![];
        if let (Geometry::Spline { curve, .. }, true) = (&segment.geometry, at.iter().any(Option::is_some)) {
            longer = lengths(curve);
            segment.length = longer[PARAMETER_SHARES];
            longer
                .iter_mut()
                .enumerate()
                .for_each(|(k, s)| *s -= (to - from) * k as f64 / PARAMETER_SHARES as f64);
        }
        for i in (found.state.breaks[g]..found.state.breaks[g + 1]).map(|i| i % count) {
            let s = found.stations[i] - own_way - from;
            stations[i] = way + s + interpolated(&longer, s / (to - from));
        }
        (way, own_way) = (way + segment.length, own_way + piece.length);
        let unit = found.spread.as_ref().and_then(|s| s.pieces[g]);
        segment.uncertainty = unit.map(|u| u.times(found.noise));
        segment.length_uncertainty = of_length(found, g);
        let own = (found.state.breaks[g]..found.state.breaks[g + 1]).map(|i| i % count);
        let distances: Vec<f64> =
            own.filter(|i| found.span.weights[*i] > 0.0).map(|i| found.residuals[i]).collect();
        segment.count = distances.len();
        segment.rms = (distances.iter().map(|d| d * d).sum::<f64>() / distances.len().max(1) as f64).sqrt();
        segment.max = distances.iter().fold(0.0, |m, d| m.max(d.abs()));
        segments.push(segment);
    }
    let joins = if single(&found.state) { vec![] } else { joins(found) };
    Parts { segments, joins, length: way, stations }
}

/// Equal shares of a free curve's parameter whose lengths are measured.
const PARAMETER_SHARES: usize = 64;

/// Length of a curve from its start to each of the shares of its parameter.
fn lengths(curve: &Curve<[f64; 2]>) -> Vec<f64> {
    let (start, end) = curve.domain();
    let at = |k: usize| start + (end - start) * k as f64 / PARAMETER_SHARES as f64;
    let mut all = vec![0.0];
    for k in 0..PARAMETER_SHARES {
        all.push(all[k] + curve.length(at(k), at(k + 1)));
    }
    all
}

/// The value at a share of the way through values at equal steps; 0 of none.
fn interpolated(values: &[f64], share: f64) -> f64 {
    let Some(last) = values.len().checked_sub(1) else { return 0.0 };
    let at = (share * last as f64).clamp(0.0, last as f64);
    let k = (at as usize).min(last - 1);
    values[k] + (at - k as f64) * (values[k + 1] - values[k])
}

/// Standard uncertainty of the length of piece `g` between the joins of its chain, as the intervals of these tell it.
fn of_length(found: &Found, g: usize) -> Option<f64> {
    let spread = found.spread.as_ref()?;
    if found.circle {
        let Some(Uncertainty::Arc { radius, .. }) = spread.pieces[g] else { return None };
        return Some(std::f64::consts::TAU * radius * found.noise);
    }
    if single(&found.state) {
        return None;
    }
    let (n, closed) = (found.pieces().len(), found.state.chain.closed);
    let first = usize::from(!closed);
    let ends = [(closed || g > 0).then_some(g), (closed || g + 1 < n).then_some((g + 1) % n)];
    // Standard uncertainties of its joins by the covariance, and by their intervals.
    let own: Vec<[f64; 2]> = (ends.into_iter().flatten())
        .map(|join| join - first)
        .map(|k| [spread.places[k] * found.noise, found.intervals[k].uncertainty])
        .collect();
    let linear = spread.lengths[g] * found.noise;
    Some(between(&own, linear)).filter(|u| u.is_finite())
}

/// Standard uncertainty of the length between joins. Each join has an uncertainty by the covariance and one by its
/// interval. The covariance of that length tells how the joins go together. Where a curvature grows from that of the
/// neighbor the covariance alone holds nothing. The join moves by the square root of the points' slack, and intervals
/// are far shorter than it says.
fn between(joins: &[[f64; 2]], linear: f64) -> f64 {
    let ratio = |[by_covariance, own]: [f64; 2]| own / by_covariance.max(f64::MIN_POSITIVE);
    match joins {
        [one] => linear * ratio(*one),
        [[a, x], [b, y]] => {
            let together = (a * a + b * b - linear * linear) / (2.0 * a * b).max(f64::MIN_POSITIVE);
            (x * x + y * y - 2.0 * together.clamp(-1.0, 1.0) * x * y).max(0.0).sqrt()
        }
        _ => linear,
    }
}

impl Contour {
    /// Lengths that end at corners are as uncertain as these, too; those that end where the row does, have no uncertainty.
    pub(super) fn end_lengths(&mut self) {
        if self.joins.is_empty() && self.closed {
            return;
        }
        let count = self.segments.len();
        for k in 0..count {
            let before = match k {
                0 if self.closed => self.joins.last(),
                0 => None,
                _ => self.joins.get(k - 1),
            };
            let after = self.joins.get(k);
            let segment = &mut self.segments[k];
            let corner = |j: &Join| if j.continuity == Continuity::G0 { j.uncertainty } else { 0.0 };
            segment.length_uncertainty = (before.zip(after).zip(segment.length_uncertainty))
                .map(|((a, b), own)| libm::hypot(own, libm::hypot(corner(a), corner(b))));
        }
    }
}

fn joins(found: &Found) -> Vec<Join> {
    let pieces = found.pieces();
    let n = pieces.len();
    let first = usize::from(!found.state.chain.closed);
    (first..n)
        .map(|g| {
            let (before, after) = (&pieces[(g + n - 1) % n], &pieces[g]);
            let jump = after.curvature(0.0) - before.curvature(1.0);
            let free = [before, after].iter().any(|p| p.kind == SegmentKind::Spline);
            let spread = found.spread.as_ref().map_or(0.0, |s| s.jumps[g - first] * found.noise);
            let smooth = free && jump.abs() < MIN_JUMP_SIGMAS * spread;
            let interval = found.intervals[g - first];
            Join {
                point: found.layout.poses[g].at,
                continuity: if smooth { Continuity::G2 } else { Continuity::G1 },
                interval: interval.ends,
                uncertainty: interval.uncertainty,
                open: interval.open,
                turn: 0.0,
            }
        })
        .collect()
}

/// Piece `g` from one length along it to another; its ends are the `corners`, where these are given.
fn segment(
    layout: &Layout,
    g: usize,
    piece: &Piece,
    [from, to]: [f64; 2],
    corners: [Option<[f64; 2]>; 2],
    tolerance: f64,
) -> Segment {
    let pose = layout.poses[g];
    let length = to - from;
    let at = |s: f64| match piece.kind {
        SegmentKind::Spline => {
            let table = &layout.tables[g];
            pose.place(table.place(s / piece.length).at)
        }
        _ => {
            let k = piece.coefficients.first().copied().unwrap_or(0.0);
            pose.place(arc_end(s, s * k))
        }
    };
    let [start, end] = [corners[0].unwrap_or(at(from)), corners[1].unwrap_or(at(to))];
    let geometry = match piece.kind {
        SegmentKind::Line => Geometry::Line,
        SegmentKind::Arc => {
            let curvature = piece.coefficients[0];
            let normal = pose.normal();
            let center = [pose.at[0] + normal[0] / curvature, pose.at[1] + normal[1] / curvature];
            let radius = 1.0 / curvature.abs();
            let angle = libm::atan2(start[1] - center[1], start[0] - center[0]);
            Geometry::Arc { center, radius, start: angle, sweep: length * curvature }
        }
        SegmentKind::Spline => spline(layout, g, piece, [from, to], [start, end], 0.05 * tolerance),
    };
    let ends = [from, to].map(|s| piece.curvature((s / piece.length).clamp(0.0, 1.0)));
    // Below 0 where an unreliable chain runs against its points.
    Segment::bare(geometry, [start, end], length.abs(), ends)
}

/// How many times finer the places are sampled where the curve does not keep its tolerance.
const SAMPLING_FACTORS: [usize; 3] = [1, 4, 16];

/// Power with which the ends of a free piece lead to its corners.
const END_BLEND_POWER: i32 = 8;

/// A cubic B-spline along a free piece, with these ends and the directions there.
fn spline(
    layout: &Layout,
    g: usize,
    piece: &Piece,
    [from, to]: [f64; 2],
    [start, end]: [[f64; 2]; 2],
    tolerance: f64,
) -> Geometry {
    let (pose, table) = (&layout.poses[g], &layout.tables[g]);
    let place = |t: f64| table.place((from + (to - from) * t) / piece.length);
    // A corner lies a little beside the piece: its ends lead there, with powers of the share of the length, which few knots
    // can follow. A step at the end would take as many knots as there may be.
    let off = |to: [f64; 2], at: [f64; 2]| [to[0] - at[0], to[1] - at[1]];
    let (first, last) = (off(start, pose.place(place(0.0).at)), off(end, pose.place(place(1.0).at)));
    let led = |t: f64| {
        let (p, u, v) = (pose.place(place(t).at), (1.0 - t).powi(END_BLEND_POWER), t.powi(END_BLEND_POWER));
        [p[0] + u * first[0] + v * last[0], p[1] + u * first[1] + v * last[1]]
    };
    let along = |t: f64, shift: [f64; 2], sign: f64| {
        let (way, rate) = (pose.out(place(t).along), sign * f64::from(END_BLEND_POWER) / (to - from));
        [way[0] + rate * shift[0], way[1] + rate * shift[1]]
    };
    let ends = Ends {
        start: End::Tangent(start, along(0.0, first, -1.0)),
        end: End::Tangent(end, along(1.0, last, 1.0)),
    };
    let mut best: Option<(Curve<[f64; 2]>, f64)> = None;
    for finer in SAMPLING_FACTORS {
        let steps = finer * (16 * piece.coefficients.len() + 32);
        // The places follow each other at steps of the length; where the curvature has knots the curve may change the most.
        let parameters: Vec<f64> = (0..=steps).map(|i| i as f64 / steps as f64).collect();
        let points: Vec<[f64; 2]> = parameters.iter().map(|t| led(*t)).collect();
        let Ok(fitted) = curve::divided(&points, &parameters, 3, &table.spans(), ends, tolerance) else {
            continue;
        };
        // Between the places too: a curve that keeps to them may leave the piece there.
        let between = parameters.windows(2).map(|w| 0.5 * (w[0] + w[1])).map(|t| {
            let d = off(fitted.curve.at(t), led(t));
            libm::hypot(d[0], d[1])
        });
        let deviation = between.fold(fitted.max, f64::max);
        if best.as_ref().is_none_or(|(_, least)| deviation < *least) {
            best = Some((fitted.curve, deviation));
        }
        if deviation <= tolerance {
            break;
        }
    }
    // Points of a curve are different: there is always one.
    best.map_or(Geometry::Line, |(curve, deviation)| Geometry::Spline { curve, deviation })
}

impl Segment {
    /// Lets it start and end at places beside its own ends; a free curve is led there.
    pub(crate) fn end_at(&mut self, start: [f64; 2], end: [f64; 2]) {
        (self.start, self.end) = (start, end);
        let Geometry::Spline { curve, deviation } = &mut self.geometry else { return };
        let last = curve.points().len() - 1;
        let off = |to: [f64; 2], at: [f64; 2]| [to[0] - at[0], to[1] - at[1]];
        let ends = [off(start, curve.points()[0]), off(end, curve.points()[last])];
        let led = |(i, p): (usize, &[f64; 2])| {
            let t = i as f64 / last as f64;
            p.plus((1.0 - t).powi(END_BLEND_POWER), ends[0]).plus(t.powi(END_BLEND_POWER), ends[1])
        };
        let points = curve.points().iter().enumerate().map(led).collect();
        if let Ok(moved) = Curve::new(curve.knots().clone(), points) {
            *curve = moved;
            let (from, to) = curve.domain();
            self.length = curve.length(from, to);
            *deviation += ends.iter().map(|d| libm::hypot(d[0], d[1])).fold(0.0, f64::max);
        }
    }
}

impl Contour {
    /// All places moved by `by`.
    pub(super) fn shift(&mut self, by: [f64; 2]) {
        let moved = |p: &mut [f64; 2]| *p = p.plus(1.0, by);
        for segment in &mut self.segments {
            moved(&mut segment.start);
            moved(&mut segment.end);
            match &mut segment.geometry {
                Geometry::Line => {}
                Geometry::Arc { center, .. } => moved(center),
                Geometry::Spline { curve, .. } => {
                    let knots: Knots = curve.knots().clone();
                    let points = curve.points().iter().map(|p| p.plus(1.0, by)).collect();
                    if let Ok(shifted) = Curve::new(knots, points) {
                        *curve = shifted;
                    }
                }
            }
        }
        for join in &mut self.joins {
            moved(&mut join.point);
            join.interval.iter_mut().for_each(moved);
        }
    }

    /// Length of all segments.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|s| s.length).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between the shares too: of a curve whose parameter runs fast and slowly.
    #[test]
    fn lengths_of_shares_are_those_of_the_curve() {
        let points = vec![[0.0, 0.0], [0.2, 1.0], [3.0, 2.0], [4.0, -1.0], [9.0, 0.5], [10.0, 0.0]];
        let curve = Curve::new(Knots::uniform(3, 3, 0.0, 1.0), points).unwrap();
        let all = lengths(&curve);
        for k in 0..100 {
            let t = f64::from(k) / 99.0;
            let off = interpolated(&all, t) - curve.length(0.0, t);
            assert!(off.abs() < 2e-3 && (k > 0 || off == 0.0), "{t}: {off}");
        }
        assert_eq!(interpolated(&[], 0.3), 0.0);
    }
}

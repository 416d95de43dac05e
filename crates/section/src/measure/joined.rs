//! Outlines of the segments of a drawing, which come in any order and direction.

use super::nominal::Outline;
use crate::model::flat::distance;
use crate::model::result::{Geometry, Segment};
use std::collections::HashMap;
use std::f64::consts::TAU;
use trueness_geom::spline::curve::{self, Curve, End, Ends};
use trueness_geom::spline::rational::Rational;

/// Weights that differ by less than this share are the same.
const EQUAL_WEIGHT_SHARE: f64 = 1e-14;
/// Places of a rational curve for each of its spans, by which it is followed.
const PLACES_PER_RATIONAL_SPAN: usize = 256;

impl Segment {
    /// A line from a place to another, which no points belong to.
    pub fn straight(start: [f64; 2], end: [f64; 2]) -> Segment {
        Segment::line(start, end)
    }

    /// Part of a circle, by its center, radius, the angle of its start, and the angle run through, positive counter-clockwise.
    pub fn arc(center: [f64; 2], radius: f64, start: f64, sweep: f64) -> Segment {
        let at = |angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            [center[0] + radius * cos, center[1] + radius * sin]
        };
        let curvature = sweep.signum() / radius;
        let ends = [at(start), at(start + sweep)];
        let geometry = Geometry::Arc { center, radius, start, sweep };
        Segment::bare(geometry, ends, radius * sweep.abs(), [curvature; 2])
    }

    /// A B-spline in the plane of the first two coordinates. A rational one is followed by a cubic within about
    /// `tolerance`, and its deviation says how far. `None` where it has no place, or the cubic cannot follow.
    pub fn curve(rational: &Rational<3>, tolerance: f64) -> Option<Segment> {
        let masses = rational.masses();
        let first = masses.points().first()?.mass;
        let (curve, deviation) =
            match masses.points().iter().all(|m| (m.mass - first).abs() <= EQUAL_WEIGHT_SHARE * first) {
                true => {
                    let points =
                        masses.points().iter().map(|m| [0, 1].map(|k| m.moment[k] / m.mass)).collect();
                    (Curve::new(masses.knots().clone(), points).ok()?, 0.0)
                }
                false => followed(rational, tolerance)?,
            };
        Some(Segment::of_curve(curve, deviation))
    }

    /// A curve, which no points belong to.
    pub(crate) fn of_curve(curve: Curve<[f64; 2]>, deviation: f64) -> Segment {
        let (from, to) = curve.domain();
        let ends = [curve.at(from), curve.at(to)];
        let bend = |t: f64| {
            let d = curve.derivatives(t, 2);
            let size = libm::hypot(d[1][0], d[1][1]).max(f64::MIN_POSITIVE);
            (d[1][0] * d[2][1] - d[1][1] * d[2][0]) / (size * size * size)
        };
        let (length, curvature) = (curve.length(from, to), [bend(from), bend(to)]);
        Segment::bare(Geometry::Spline { curve, deviation }, ends, length, curvature)
    }

    /// Whether it is a whole circle.
    fn is_whole(&self) -> bool {
        matches!(self.geometry, Geometry::Arc { sweep, .. } if sweep.abs() >= TAU * (1.0 - EQUAL_WEIGHT_SHARE))
    }
}

/// A cubic along a rational curve, and its greatest distance from it.
fn followed(rational: &Rational<3>, tolerance: f64) -> Option<(Curve<[f64; 2]>, f64)> {
    let knots = rational.masses().knots();
    let spans = knots.distinct();
    let flat = |p: [f64; 3]| [p[0], p[1]];
    let mut parameters: Vec<f64> = vec![];
    for w in spans.windows(2) {
        parameters.extend(
            (0..PLACES_PER_RATIONAL_SPAN)
                .map(|i| w[0] + (w[1] - w[0]) * i as f64 / PLACES_PER_RATIONAL_SPAN as f64),
        );
    }
    parameters.extend(spans.last());
    let points: Vec<[f64; 2]> =
        parameters.iter().map(|t| rational.at(*t).map(flat)).collect::<Option<_>>()?;
    let tangent = |t: f64| rational.derivatives(t, 1).map(|d| flat(d[1]));
    let (from, to) = knots.domain();
    let ends = Ends {
        start: End::Tangent(points[0], tangent(from)?),
        end: End::Tangent(points[points.len() - 1], tangent(to)?),
    };
    let curve = curve::divided(&points, &parameters, 3, &spans, ends, tolerance).ok()?.curve;
    let off = |t: f64| Some(distance(curve.at(t), rational.at(t).map(flat)?));
    let middle = parameters.windows(2).map(|w| off(0.5 * (w[0] + w[1])));
    let deviation = middle.chain(parameters.iter().map(|t| off(*t))).collect::<Option<Vec<f64>>>()?;
    Some((curve, deviation.into_iter().fold(0.0, f64::max)))
}

/// Ends of segments by the cells that they lie in.
struct EndIndex {
    cell: f64,
    at: HashMap<[i64; 2], Vec<(usize, bool)>>,
}

impl EndIndex {
    fn new(segments: &[Segment], gap: f64) -> EndIndex {
        let mut all = EndIndex { cell: 2.0 * gap.max(f64::MIN_POSITIVE), at: HashMap::new() };
        for (i, s) in segments.iter().enumerate().filter(|(_, s)| !s.is_whole()) {
            for (at_end, p) in [(false, s.start), (true, s.end)] {
                all.at.entry(all.key(p)).or_default().push((i, at_end));
            }
        }
        all
    }

    fn key(&self, p: [f64; 2]) -> [i64; 2] {
        p.map(|x| (x / self.cell).floor() as i64)
    }

    /// The unused end nearest to a place, within `gap`; of equally near ones that of the first segment.
    fn near(&self, segments: &[Segment], used: &[bool], p: [f64; 2], gap: f64) -> Option<(usize, bool)> {
        let [x, y] = self.key(p);
        let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [x.saturating_add(i), y.saturating_add(j)]));
        let ends = around.filter_map(|key| self.at.get(&key)).flatten().filter(|(i, _)| !used[*i]);
        let far = |(i, at_end): &(usize, bool)| {
            distance(p, if *at_end { segments[*i].end } else { segments[*i].start })
        };
        ends.map(|e| (far(e), *e))
            .filter(|(d, _)| *d <= gap)
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map(|(_, e)| e)
    }
}

/// The outlines that segments in any order and direction make up. Segments whose ends lie within `gap` of each other
/// follow each other, in the direction of the first. A segment that is drawn twice counts once. Cost: about linear.
///
/// ```
/// use trueness_section::{joined, Segment};
/// let sides = [[[0.0, 0.0], [4.0, 0.0]], [[0.0, 3.0], [0.0, 0.0]], [[0.0, 3.0], [4.0, 0.0]]];
/// let found = joined(sides.iter().map(|[a, b]| Segment::straight(*a, *b)).collect(), 1e-6);
/// assert!(found.len() == 1 && found[0].closed && found[0].segments.len() == 3);
/// ```
pub fn joined(segments: Vec<Segment>, gap: f64) -> Vec<Outline> {
    let segments = once(segments, gap);
    let ends = EndIndex::new(&segments, gap);
    let mut used = vec![false; segments.len()];
    let mut all = vec![];
    for first in 0..segments.len() {
        if used[first] {
            continue;
        }
        used[first] = true;
        if segments[first].is_whole() {
            all.push(Outline { segments: vec![segments[first].clone()], closed: true });
            continue;
        }
        let mut chain = std::collections::VecDeque::from([segments[first].clone()]);
        let mut closed = false;
        for forward in [true, false] {
            while !closed {
                let (start, end) = (chain[0].start, chain[chain.len() - 1].end);
                closed =
                    distance(start, end) <= gap && chain.iter().map(|s| s.length).sum::<f64>() > 2.0 * gap;
                let from = if forward { end } else { start };
                let Some((next, at_end)) = ends.near(&segments, &used, from, gap).filter(|_| !closed) else {
                    break;
                };
                used[next] = true;
                let segment = segments[next].clone();
                // Forward it begins where the chain ends, backward it ends where the chain begins.
                let segment = if at_end == forward { segment.reversed() } else { segment };
                if forward { chain.push_back(segment) } else { chain.push_front(segment) }
            }
        }
        all.push(Outline { segments: chain.into(), closed });
    }
    all
}

/// The segments without those drawn a second time: with the same ends, either way round, and the same middle.
fn once(segments: Vec<Segment>, gap: f64) -> Vec<Segment> {
    let key = |p: [f64; 2]| p.map(|x| (x / gap.max(f64::MIN_POSITIVE)).round() as i64);
    let mut seen = std::collections::HashSet::new();
    let mut new = |s: &Segment| {
        let (a, b) = (key(s.start), key(s.end));
        let middle = key(s.place(0.5));
        // Whole circles begin anywhere.
        match s.geometry {
            Geometry::Arc { center, radius, .. } if s.is_whole() => {
                seen.insert([key(center), key([radius, 0.0]), [0; 2]])
            }
            _ => seen.insert([a.min(b), a.max(b), middle]),
        }
    };
    segments.into_iter().filter(|s| new(s)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::num::random::Random;

    /// A plate with a slot and a circle, and an open way; shuffled and turned round anyhow.
    #[test]
    fn shuffled_segments_make_up_their_outlines() {
        let half = std::f64::consts::PI;
        let plate = [
            Segment::straight([0.0, 0.0], [10.0, 0.0]),
            Segment::arc([10.0, 2.0], 2.0, -0.5 * half, half),
            Segment::straight([10.0, 4.0], [0.0, 4.0]),
            Segment::straight([0.0, 4.0], [0.0, 0.0]),
        ];
        let slot = [
            Segment::arc([4.0, 2.0], 0.5, 0.5 * half, half),
            Segment::straight([4.0, 1.5], [6.0, 1.5]),
            Segment::arc([6.0, 2.0], 0.5, -0.5 * half, half),
            Segment::straight([6.0, 2.5], [4.0, 2.5]),
        ];
        let open = [Segment::straight([20.0, 0.0], [21.0, 0.0]), Segment::straight([21.0, 0.0], [21.0, 1.0])];
        let circle = Segment::arc([2.0, 2.0], 0.3, 1.0, TAU);
        let random = &mut Random::new(5);
        for _ in 0..40 {
            let mut all: Vec<Segment> = plate.iter().chain(&slot).chain(&open).cloned().collect();
            all.extend([circle.clone(), circle.clone().reversed(), plate[2].clone().reversed()]);
            (1..all.len()).rev().for_each(|i| all.swap(i, random.below(i as u64 + 1) as usize));
            for s in &mut all {
                if random.unit() < 0.5 {
                    *s = s.clone().reversed();
                }
            }
            let found = joined(all, 1e-6);
            let mut shape: Vec<(usize, bool)> = found.iter().map(|o| (o.segments.len(), o.closed)).collect();
            shape.sort_unstable();
            assert_eq!(shape, [(1, true), (2, false), (4, true), (4, true)]);
            for outline in &found {
                for w in outline.segments.windows(2) {
                    assert!(distance(w[0].end, w[1].start) < 1e-9);
                }
            }
        }
    }

    /// A rational quarter of an ellipse is followed within the tolerance; a polynomial one is itself.
    #[test]
    fn rational_curves_are_followed() {
        use trueness_geom::spline::basis::Knots;
        let root = 0.5_f64.sqrt();
        let points = [([3.0, 0.0, 0.0], 1.0), ([3.0, 1.0, 0.0], root), ([0.0, 1.0, 0.0], 1.0)];
        let quarter = Rational::new(Knots::uniform(2, 1, 0.0, 1.0), &points).unwrap();
        let found = Segment::curve(&quarter, 1e-7).unwrap();
        let Geometry::Spline { deviation, .. } = found.geometry else { panic!() };
        assert!(deviation < 1e-6, "{deviation}");
        for i in 0..=100 {
            let [x, y] = found.place(f64::from(i) / 100.0);
            // Off the ellipse, measured along the steeper axis.
            assert!((libm::hypot(x / 3.0, y) - 1.0).abs() < 1e-6, "{x} {y}");
        }
        assert!((found.curvature[0] - 3.0).abs() < 0.01 && (found.curvature[1] - 1.0 / 9.0).abs() < 1e-3);
        let points = points.map(|(p, _)| (p, 2.0));
        let plain = Rational::new(Knots::uniform(2, 1, 0.0, 1.0), &points).unwrap();
        let found = Segment::curve(&plain, 1e-7).unwrap();
        assert_eq!(found.place(0.5), [2.25, 0.75]);
    }
}

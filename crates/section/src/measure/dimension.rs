//! Dimensions between the segments of one plane, as a drawing has them: angles, widths, distances of centers, gaps.
//!
//! Uncertainties are those of the segments put together by the rule for independent ones. The evidence of a row about
//! two segments of one chain is only nearly independent. Each is known by its own points for the most part.

use crate::model::chain::SegmentKind;
use crate::model::flat::{angle, distance};
use crate::model::result::{Contour, Geometry, Join, Segment, Uncertainty};
use trueness_geom::num::golden::golden;

/// The kind of a dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DimensionKind {
    /// The angle that a line and the next line of a contour enclose, radians. It is half a turn where the second goes
    /// on as the first, and 0 where it comes back.
    Angle,
    /// The distance of two lines that are parallel as far as their points tell, and that face each other. It goes
    /// across them, at the middle of where they do.
    Width,
    /// The distance of the centers of two arcs.
    Centers,
    /// The least distance of two contours; 0 where they meet.
    Gap,
}

impl DimensionKind {
    /// All of them.
    pub const ALL: [DimensionKind; 4] =
        [DimensionKind::Angle, DimensionKind::Width, DimensionKind::Centers, DimensionKind::Gap];

    /// The word for it: `angle`, `width`, `centers`, `gap`.
    pub fn name(self) -> &'static str {
        match self {
            DimensionKind::Angle => "angle",
            DimensionKind::Width => "width",
            DimensionKind::Centers => "centers",
            DimensionKind::Gap => "gap",
        }
    }
}

/// A dimension between two segments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimension {
    /// Its kind.
    pub kind: DimensionKind,
    /// Number of the contour, and of the segment in it, of either side.
    pub of: [[usize; 2]; 2],
    /// Its value.
    pub value: f64,
    /// Its standard uncertainty, where the points determine it: not of exact facets, nor of gaps beside splines and parts of
    /// circles.
    pub uncertainty: Option<f64>,
    /// The two places between which it is measured; of an angle, the end of the first line and the start of the next.
    pub between: [[f64; 2]; 2],
}

/// Directions that differ by fewer standard uncertainties than this are taken for parallel.
const PARALLEL_SIGMAS: f64 = 3.0;
/// Radians between lines that are never parallel, however uncertain their directions are.
const MAX_PARALLEL_ANGLE: f64 = 0.05;
/// Places of a segment from which its least distance from another is looked for.
const DISTANCE_STARTS: usize = 16;
/// Lines, and arcs, of one plane whose pairs are looked at.
const MAX_SEGMENTS_IN_PAIRS: usize = 1000;
/// Steps of the golden section: the place is then known to 1e-10 of the way between two starts.
const GOLDEN_STEPS: usize = 48;

/// The dimensions between the segments of contours in one plane. They are all angles between a line and the next of its
/// contour, and all widths and distances of centers. Each contour has the gap to the nearest other, too. Each list in
/// the order of the segments. Segments that do not run along their points have none.
///
/// Lines of exact facets are parallel as far as the joins at their ends tell. Widths and centers are of pairs: where there are
/// more than a thousand lines, or arcs, they are those of the thousand longest.
///
/// ```
/// use trueness_section::{contour, dimensions, DimensionKind, Options};
/// let row = |y: f64| (0..40).map(move |i| [0.5 * f64::from(i), y]);
/// let side = |x: f64| (1..20).map(move |i| [x, 0.5 * f64::from(i)]);
/// let points: Vec<[f64; 2]> = row(0.0).chain(side(19.5)).chain(row(10.0).map(|[x, y]| [19.5 - x, y])).collect();
/// let options = Options { closed: Some(false), ..Options::default() };
/// let found = contour(&points, &options, &trueness_geom::progress::Silent).unwrap();
/// let all = dimensions(&[found]);
/// assert_eq!(all.iter().map(|d| d.kind.name()).collect::<Vec<_>>(), ["angle", "angle", "width"]);
/// assert!((all[0].value - std::f64::consts::FRAC_PI_2).abs() < 1e-9 && (all[2].value - 10.0).abs() < 1e-9);
/// ```
pub fn dimensions(contours: &[Contour]) -> Vec<Dimension> {
    let sound = |c: usize, k: usize| !contours[c].unreliable.contains(&k);
    let lines = known(contours, |c, k| {
        Line::of(&contours[c], k).filter(|_| sound(c, k)).map(|l| (l.length, ([c, k], l)))
    });
    let arcs = known(contours, |c, k| {
        let segment = &contours[c].segments[k];
        Arc::of(segment).filter(|_| sound(c, k)).map(|a| (segment.length, ([c, k], a)))
    });
    let mut all = vec![];
    for (c, contour) in contours.iter().enumerate() {
        let of = |k: usize| Line::of(contour, k).map(|l| ([c, k], l));
        let own: Vec<([usize; 2], Line)> = (0..contour.segments.len()).filter_map(of).collect();
        let over = contour.closed && own.len() > 2;
        for i in 0..(own.len() + usize::from(over)).saturating_sub(1) {
            let pair = [&own[i], &own[(i + 1) % own.len()]];
            let angle = if pair.iter().all(|l| sound(c, l.0[1])) { enclosed(pair[0], pair[1]) } else { None };
            all.extend(angle);
        }
    }
    for (i, a) in lines.iter().enumerate() {
        all.extend(lines[i + 1..].iter().filter_map(|b| width(a, b)));
    }
    for (i, a) in arcs.iter().enumerate() {
        all.extend(arcs[i + 1..].iter().map(|b| centers(a, b)));
    }
    all.extend(gaps(contours));
    all
}

/// The known values of the segments, each with its length; only the longest where there are very many.
fn known<T>(contours: &[Contour], of: impl Fn(usize, usize) -> Option<(f64, T)>) -> Vec<T> {
    let each = |(c, contour): (usize, &Contour)| (0..contour.segments.len()).map(move |k| (c, k));
    let mut all: Vec<(f64, T)> =
        contours.iter().enumerate().flat_map(each).filter_map(|(c, k)| of(c, k)).collect();
    if all.len() > MAX_SEGMENTS_IN_PAIRS {
        let mut lengths: Vec<f64> = all.iter().map(|(length, _)| *length).collect();
        lengths.sort_by(|a, b| b.total_cmp(a));
        all.retain(|(length, _)| *length >= lengths[MAX_SEGMENTS_IN_PAIRS - 1]);
        all.truncate(MAX_SEGMENTS_IN_PAIRS);
    }
    all.into_iter().map(|(_, one)| one).collect()
}

/// A line, how well its direction is known, and how well its place is across it in the middle of its points.
struct Line {
    start: [f64; 2],
    end: [f64; 2],
    length: f64,
    angle: f64,
    across: Option<f64>,
    measured: bool,
}

impl Line {
    fn of(contour: &Contour, k: usize) -> Option<Line> {
        let segment = &contour.segments[k];
        if segment.geometry.kind() != SegmentKind::Line || segment.length <= 0.0 {
            return None;
        }
        let (start, end, length) = (segment.start, segment.end, segment.length);
        let (angle, measured) = match segment.uncertainty {
            Some(Uncertainty::Line { angle }) => (angle, true),
            _ => (by_joins(contour, k) / length, false),
        };
        let across = measured.then(|| contour.noise / contour.independent_of(k).sqrt());
        Some(Line { start, end, length, angle, across, measured })
    }

    fn along(&self) -> [f64; 2] {
        [0, 1].map(|k| (self.end[k] - self.start[k]) / self.length)
    }

    /// Standard uncertainty across the line at a length from its start.
    fn at(&self, s: f64) -> Option<f64> {
        self.across.map(|a| libm::hypot(a, (s - 0.5 * self.length) * self.angle))
    }
}

/// How far the ends of a segment are uncertain by their joins.
fn by_joins(contour: &Contour, k: usize) -> f64 {
    let n = contour.segments.len();
    let before = if contour.closed || k > 0 { contour.joins.get((k + n - 1) % n) } else { None };
    let uncertainty = |join: Option<&Join>| join.map_or(0.0, |j| j.uncertainty);
    libm::hypot(uncertainty(before), uncertainty(contour.joins.get(k)))
}

fn enclosed((of, a): &([usize; 2], Line), (with, b): &([usize; 2], Line)) -> Option<Dimension> {
    let turn = angle(a.along(), b.along()).abs();
    let uncertainty = libm::hypot(a.angle, b.angle);
    let value = std::f64::consts::PI - turn;
    // Parallel lines that come back have a width instead.
    (value > PARALLEL_SIGMAS * uncertainty).then(|| Dimension {
        kind: DimensionKind::Angle,
        of: [*of, *with],
        value,
        uncertainty: (a.measured && b.measured).then_some(uncertainty),
        between: [a.end, b.start],
    })
}

fn width((of, a): &([usize; 2], Line), (with, b): &([usize; 2], Line)) -> Option<Dimension> {
    let along = a.along();
    let sense = if along[0] * b.along()[0] + along[1] * b.along()[1] < 0.0 { -1.0 } else { 1.0 };
    let turn = angle(along, b.along().map(|x| sense * x));
    if turn.abs() > (PARALLEL_SIGMAS * libm::hypot(a.angle, b.angle)).min(MAX_PARALLEL_ANGLE) {
        return None;
    }
    // The mean direction of the two, each as long as it is.
    let (sin, cos) = libm::sincos(turn * b.length / (a.length + b.length));
    let along = [along[0] * cos - along[1] * sin, along[0] * sin + along[1] * cos];
    let seen = |p: [f64; 2]| {
        let d = [p[0] - a.start[0], p[1] - a.start[1]];
        (along[0] * d[0] + along[1] * d[1], along[0] * d[1] - along[1] * d[0])
    };
    let (b_start, b_end) = (seen(b.start), seen(b.end));
    let (low, high) = (b_start.0.min(b_end.0).max(0.0), b_start.0.max(b_end.0).min(seen(a.end).0));
    if low >= high {
        return None;
    }
    let middle = 0.5 * (low + high);
    let height = |from: (f64, f64), to: (f64, f64)| {
        let share = (middle - from.0) / (to.0 - from.0);
        (from.1 + share * (to.1 - from.1), share)
    };
    let (own, share) = height((0.0, 0.0), seen(a.end));
    let (other, part) = height(b_start, b_end);
    let place = |h: f64| [0, 1].map(|k| a.start[k] + middle * along[k] + h * [-along[1], along[0]][k]);
    let spread = a.at(share * a.length).zip(b.at(part * b.length));
    Some(Dimension {
        kind: DimensionKind::Width,
        of: [*of, *with],
        value: (other - own).abs(),
        uncertainty: spread.map(|(x, y)| libm::hypot(x, y)),
        between: [place(own), place(other)],
    })
}

struct Arc {
    center: [f64; 2],
    uncertainty: Option<[f64; 2]>,
}

impl Arc {
    fn of(segment: &Segment) -> Option<Arc> {
        let Geometry::Arc { center, .. } = segment.geometry else { return None };
        let uncertainty = match segment.uncertainty {
            Some(Uncertainty::Arc { center, .. }) => Some(center),
            _ => None,
        };
        Some(Arc { center, uncertainty })
    }
}

fn centers((of, a): &([usize; 2], Arc), (with, b): &([usize; 2], Arc)) -> Dimension {
    let value = distance(a.center, b.center);
    let d = [0, 1].map(|k| b.center[k] - a.center[k]);
    let uncertainty = a.uncertainty.zip(b.uncertainty).map(|(u, v)| {
        let each = [0, 1].map(|k| libm::hypot(u[k], v[k]));
        // The distance of one center is as uncertain as the farther coordinate.
        match value > 0.0 {
            true => libm::hypot(d[0] * each[0], d[1] * each[1]) / value,
            false => each[0].max(each[1]),
        }
    });
    Dimension {
        kind: DimensionKind::Centers,
        of: [*of, *with],
        value,
        uncertainty,
        between: [a.center, b.center],
    }
}

/// The gap of each contour to the nearest other, each pair once.
fn gaps(contours: &[Contour]) -> Vec<Dimension> {
    let boxes: Vec<[[f64; 2]; 2]> = contours.iter().map(around).collect();
    let mut all: Vec<Dimension> = vec![];
    for i in 0..contours.len() {
        let mut others: Vec<(f64, usize)> =
            (0..contours.len()).filter(|j| *j != i).map(|j| (apart(&boxes[i], &boxes[j]), j)).collect();
        others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut best: Option<Dimension> = None;
        for (least, j) in others {
            if best.is_some_and(|b| b.value <= least) {
                break;
            }
            let [c, d] = [i.min(j), i.max(j)];
            let found = gap([c, d], [&contours[c], &contours[d]], best.map_or(f64::INFINITY, |b| b.value));
            best = found.or(best);
        }
        let sound = |b: &Dimension| b.of.iter().all(|[c, k]| !contours[*c].unreliable.contains(k));
        let new = best.filter(sound).filter(|b| all.iter().all(|a| a.of.map(|o| o[0]) != b.of.map(|o| o[0])));
        all.extend(new);
    }
    all
}

/// A box around all points of a contour.
fn around(contour: &Contour) -> [[f64; 2]; 2] {
    let mut range = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    let mut add = |p: [f64; 2]| {
        for k in 0..2 {
            range[0][k] = range[0][k].min(p[k]);
            range[1][k] = range[1][k].max(p[k]);
        }
    };
    contour.segments.iter().flat_map(Segment::hull).for_each(&mut add);
    range
}

fn apart(a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]) -> f64 {
    let gap = [0, 1].map(|k| (a[0][k] - b[1][k]).max(b[0][k] - a[1][k]).max(0.0));
    libm::hypot(gap[0], gap[1])
}

/// The gap between two contours, where it is below `limit`.
fn gap(numbers: [usize; 2], contours: [&Contour; 2], limit: f64) -> Option<Dimension> {
    let mut best: Option<Dimension> = None;
    let [a, b] = contours;
    for (i, s) in a.segments.iter().enumerate() {
        for (j, t) in b.segments.iter().enumerate() {
            let (value, between) = nearest(s, t);
            if value < best.map_or(limit, |b| b.value) {
                let of = [[numbers[0], i], [numbers[1], j]];
                best = Some(Dimension { kind: DimensionKind::Gap, of, value, uncertainty: None, between });
            }
        }
    }
    best.map(|b| Dimension {
        uncertainty: across(a, b.of[0][1], b.between[0])
            .zip(across(contours[1], b.of[1][1], b.between[1]))
            .map(|(x, y)| libm::hypot(x, y)),
        ..b
    })
}

/// Standard uncertainty across a contour at a place of one of its segments. It is that of a line, or of a whole circle,
/// whose center and radius are independent.
fn across(contour: &Contour, k: usize, place: [f64; 2]) -> Option<f64> {
    if let Some(line) = Line::of(contour, k) {
        return line.at(distance(line.start, place));
    }
    match (&contour.segments[k].geometry, contour.segments[k].uncertainty) {
        (Geometry::Arc { center: c, radius: r, sweep, .. }, Some(Uncertainty::Arc { center, radius }))
            if sweep.abs() >= std::f64::consts::TAU * (1.0 - 1e-9) =>
        {
            let out = [0, 1].map(|k| (place[k] - c[k]) / r);
            Some(libm::hypot(libm::hypot(out[0] * center[0], out[1] * center[1]), radius))
        }
        _ => None,
    }
}

/// The least distance of two segments, and where it is. It is found from places of either to the nearest of the other,
/// by golden section around the best.
fn nearest(a: &Segment, b: &Segment) -> (f64, [[f64; 2]; 2]) {
    let (x, p) = from_places(a, b);
    let (y, q) = from_places(b, a);
    let (value, share, turned) = if x <= y { (x, p, false) } else { (y, q, true) };
    let (from, to) = if turned { (b, a) } else { (a, b) };
    let place = from.place(share);
    let foot = to.nearest(place).place;
    (value, if turned { [foot, place] } else { [place, foot] })
}

/// The least distance of places of one segment from another, and at which share it is.
fn from_places(from: &Segment, to: &Segment) -> (f64, f64) {
    let distance = |share: f64| to.nearest(from.place(share)).distance.abs();
    let share = |i: usize| i as f64 / DISTANCE_STARTS as f64;
    let mut best = (f64::INFINITY, 0.0);
    let all: Vec<f64> = (0..=DISTANCE_STARTS).map(|i| distance(share(i))).collect();
    for i in 0..=DISTANCE_STARTS {
        if all[i] < best.0 {
            best = (all[i], share(i));
        }
    }
    let lowest =
        |i: &usize| all[*i] <= all[i.saturating_sub(1)] && all[*i] <= all[(i + 1).min(DISTANCE_STARTS)];
    for i in (0..=DISTANCE_STARTS).filter(lowest) {
        let (low, high) = (share(i.saturating_sub(1)), share((i + 1).min(DISTANCE_STARTS)));
        let (at, value) = golden(&distance, low, high, GOLDEN_STEPS);
        if value < best.0 {
            best = (value, at);
        }
    }
    best
}

#[cfg(test)]
mod tests;

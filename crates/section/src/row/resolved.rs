//! Rows of a curve without noise: smooth between corners, and no lines and arcs.
//!
//! The noise of local fits is the curve's own form there. A search by likelihood takes it for exact, and follows it by
//! lines and arcs by the dozen. It makes corners where the arcs do not follow. Such a row tells more: its points lie on
//! the curve. So a corner is a turn from one chord to the next that the turns beside do not lead up to. The points must
//! tell it from a bend. Between corners B-splines keep within a ten-thousandth of the distance between points, over as
//! few spans as that takes.

use super::assembly::Joined;
use super::candidate::{Candidate, Question, is_cornered};
use super::clean::{Clean, size};
use super::noise_levels::Partition;
use super::polygon::MIN_CORNER_TURN;
use super::spline_through_points::{FOLLOWED_TOLERANCES, chord, followed};
use crate::model::chain::SegmentKind;
use crate::model::flat::{angle, distance, off_circle, off_line};
use crate::model::result::{Continuity, Contour, Geometry, Join, Options, SectionError, Segment};
use crate::search::parts::{Part, noise_beyond_form};
use trueness_geom::num::special::student_quantile;
use trueness_geom::progress::Progress;
use trueness_geom::spline::curve::{End, Ends};

/// Fewest points of such a row, and of a stretch between corners.
const MIN_POINTS_OF_ROW_AND_STRETCH: (usize, usize) = (24, 4);
/// Longer rows are left to the search, which thins them.
const MAX_POINTS_OF_RESOLVED_ROW: usize = 1_000_000;
/// Noise below this share of the distance between points is that of rounded coordinates.
const MAX_ROUNDING_NOISE_SPACINGS: f64 = 1e-3;
/// Noise that local fits tell is form where polynomials of higher degree tell no more than this share of it. Up to twice the
/// noise of rounded coordinates it hides nothing then.
const MAX_FORM_NOISE_SHARE: f64 = 0.2;
/// Up to this share of the distance between points corners are told from bends in spite of noise.
const MAX_CORNER_NOISE_SPACINGS: f64 = 1e-2;
/// Coordinates tell distances to this share of the size.
const ROUNDING_SHARE: f64 = 1e-12;
/// A row is one of lines and arcs of which this share lies on these exactly.
const MAX_EXACT_SHARE: f64 = 0.15;
/// Such lines and arcs have so many points each.
const POINTS_PER_EXACT_PART: usize = 16;
/// A row with one line or arc of so many exact points is one of these, too.
const POINTS_OF_LONG_EXACT_PART: usize = 32;
/// Hardly one point that scatters is farther off than so many standard deviations.
const MAX_SCATTER_SIGMAS: f64 = 4.0;
/// Points lie on lines and arcs exactly that are no farther off than so many times the noise of polynomials.
const EXACT_OFFSET_SIGMAS_OF_FORM: f64 = 6.0;
/// A corner turns more than so many times the turn that the turns beside lead up to.
const MIN_CORNER_TURN_RATIO: f64 = 2.0;
/// Curvature grows from point to point by no more than this, as far as points tell a bend.
const MAX_CURVATURE_GROWTH: f64 = 4.0;
/// More corners than one for so many points are none: the points do not tell the curve.
const MIN_POINTS_PER_CORNER: usize = 12;
/// Distances below this share of the size of all are none.
const ZERO_DISTANCE_SHARE: f64 = 1e-6;
/// A contour misses the points that scatter about it so many times as much as about one that keeps to them.
const MAX_MISS_RATIO: f64 = 5.0;

/// The contour of a row of curves without noise, of which no lines and arcs are to be found: there is nothing to search.
pub(super) fn propose(
    question: &Question,
    best: Option<&Contour>,
    _: &dyn Progress,
) -> Result<Option<Candidate>, SectionError> {
    if best.is_some() || !question.is_free() {
        return Ok(None);
    }
    let found = resolved(question.partition(), question.options, Case::Rows);
    Ok(found.and_then(|found| Candidate::beyond_chance(found.whole(question.points.len()))))
}

/// Such a contour in place of one with corners, or that misses its points, where these speak for it.
pub(super) fn propose_instead(
    question: &Question,
    best: Option<&Contour>,
    _: &dyn Progress,
) -> Result<Option<Candidate>, SectionError> {
    let is_asked = |found: &&Contour| question.is_free() && (is_cornered(found) || misses(found, 0.0));
    let Some(other) = best.filter(is_asked) else { return Ok(None) };
    let found = resolved(question.partition(), question.options, Case::Contours);
    let better = found.filter(|found| found.is_better_than(other));
    Ok(better.and_then(|found| Candidate::instead(found.whole(question.points.len()))))
}

/// The contour of a row of points that lie on smooth curves without noise. `None` where they do not, where lines and
/// arcs do, or where the points are too few for the curve.
fn resolved(partition: &Partition, options: &Options, case: Case) -> Option<Resolved> {
    let clean = &partition.clean;
    let n = clean.points.len();
    if !(MIN_POINTS_OF_ROW_AND_STRETCH.0..=MAX_POINTS_OF_RESOLVED_ROW).contains(&n)
        || partition.exact
        || !partition.outliers.is_empty()
        || partition.parts.len() < 2
        || partition.step > 1
    {
        return None;
    }
    let noise = noise_beyond_form(&clean.points, clean.closed).max(clean.rounding);
    let is_form = noise <= MAX_FORM_NOISE_SHARE * partition.own;
    let quiet = noise <= MAX_ROUNDING_NOISE_SPACINGS * clean.spacing
        || noise <= 2.0 * MAX_ROUNDING_NOISE_SPACINGS * clean.spacing && is_form;
    if !quiet && noise > MAX_CORNER_NOISE_SPACINGS * clean.spacing {
        return None;
    }
    // Noise that is form is none of lines and arcs.
    let most = if is_form {
        FOLLOWED_TOLERANCES[0]
    } else {
        EXACT_OFFSET_SIGMAS_OF_FORM * MAX_CORNER_NOISE_SPACINGS
    };
    let off = (EXACT_OFFSET_SIGMAS_OF_FORM * noise)
        .clamp(ROUNDING_SHARE * size(&clean.points), most * clean.spacing);
    let on = |p: &&Part| lies_on(&clean.points[p.from..p.to], p.kind, off);
    let exact = || partition.parts.iter().filter(on).map(|p| p.to - p.from);
    let curved = exact().sum::<usize>() as f64 <= MAX_EXACT_SHARE * n as f64
        && exact().all(|count| count < POINTS_OF_LONG_EXACT_PART);
    let is_candidate = match case {
        Case::Rows => quiet && curved,
        Case::Contours => quiet || curved,
    };
    if !is_candidate {
        return None;
    }
    let own = if is_form { 0.0 } else { MAX_SCATTER_SIGMAS * noise };
    let mut clean = clean.clone();
    // The row as it came.
    clean.points.rotate_right(partition.turned % n);
    let mut corners = corners(&clean);
    if MIN_POINTS_PER_CORNER * corners.len() > n {
        return None;
    }
    // A closed row begins at a corner.
    let mut turned = 0;
    if clean.closed
        && let Some(first) = corners.first().map(|c| c.after)
    {
        turned = first;
        clean.points.rotate_left(first);
        corners.iter_mut().for_each(|c| c.after -= first);
    }
    let least = (ZERO_DISTANCE_SHARE * size(&clean.points)).max(options.resolution.unwrap_or(0.0)).max(own);
    let contour = drawn(&clean, &corners, least, options.level)?;
    Some(Resolved { contour, clean, turned, noise })
}

/// The cases in which such a contour is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Case {
    /// Rows of which no lines and arcs are to be found: there is nothing to search.
    Rows,
    /// A contour of the search is there to compare it with.
    Contours,
}

/// A contour, and the row that its numbers are those of.
struct Resolved {
    contour: Contour,
    clean: Clean,
    turned: usize,
    /// Standard deviation of the points about local polynomials.
    noise: f64,
}

/// Points to a control point of a curve, at least, where their residuals tell their noise.
const MIN_POINTS_TO_TELL_NOISE: usize = 2;

impl Resolved {
    /// Whether it is better than a contour of segments that do not run along their points, or miss them. It is so too
    /// where that has corners and the points tell none.
    pub fn is_better_than(&self, other: &Contour) -> bool {
        let corners = other.joins.iter().filter(|j| j.continuity == Continuity::G0).count();
        !other.unreliable.is_empty()
            || corners > self.contour.joins.len()
            || misses(other, self.contour.noise)
    }

    /// The contour of the row given, of so many points.
    pub fn whole(self, count: usize) -> Contour {
        let mut contour = self.contour;
        let runs_through = |s: &Segment| match &s.geometry {
            Geometry::Spline { curve, .. } => MIN_POINTS_TO_TELL_NOISE * curve.points().len() > s.count,
            _ => false,
        };
        // A curve with nearly as many control points runs through its points, whatever their noise: local polynomials tell more of it.
        if contour.segments.iter().any(runs_through) {
            contour.noise = contour.noise.max(self.noise);
        }
        let mut all = Joined::of(contour);
        all.finish(&self.clean, self.turned, count, vec![]);
        all.contour
    }
}

/// Whether the points of a row of this noise scatter about its contour for other reasons.
fn misses(contour: &Contour, noise: f64) -> bool {
    contour.noise > MAX_MISS_RATIO * (noise + MAX_ROUNDING_NOISE_SPACINGS * contour.spacing)
}

/// Whether the points of a part lie on a line, or an arc, no farther off than so much. A quarter at either end may lie
/// beside it.
fn lies_on(points: &[[f64; 2]], kind: SegmentKind, off: f64) -> bool {
    let n = points.len();
    let own = &points[n / 4..n - n / 4];
    let [a, b, c] = [own[0], own[own.len() / 2], own[own.len() - 1]];
    let near = |p: &[f64; 2]| match kind {
        SegmentKind::Line => off_line([a, c], *p) <= off,
        _ => off_circle([a, b, c], *p) <= off,
    };
    n >= POINTS_PER_EXACT_PART && own.iter().all(near)
}

/// A corner: the first point after it. It is this point, or between it and the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    after: usize,
    on_point: bool,
}

/// The turns of a row's chords.
struct Turns<'a> {
    clean: &'a Clean,
    /// At each point the angle from the chord before to the one after, and the mean of their lengths; of an open row's ends `None`.
    all: Vec<Option<(f64, f64)>>,
}

impl Turns<'_> {
    fn new(clean: &Clean) -> Turns<'_> {
        let (points, n) = (&clean.points, clean.points.len());
        let of = |i: usize| {
            let inside = clean.closed || i > 0 && i + 1 < n;
            let [a, b, c] = [(i + n - 1) % n, i, (i + 1) % n].map(|k| points[k]);
            inside.then(|| (angle(chord(a, b), chord(b, c)), 0.5 * (distance(a, b) + distance(b, c))))
        };
        Turns { clean, all: (0..n).map(of).collect() }
    }

    /// Curvature at so many points after another.
    fn curvature(&self, i: usize, by: isize) -> Option<f64> {
        let (n, at) = (self.all.len() as isize, i as isize + by);
        let at = if self.clean.closed { at.rem_euclid(n) } else { at };
        let (turn, width) = (*self.all.get(usize::try_from(at).ok()?)?)?;
        Some(turn / width.max(f64::MIN_POSITIVE))
    }

    /// The curvature that the points beside lead up to, `from` being the nearest of them.
    /// Turns to the other side lead to none of this `sign`.
    fn led_up_to(&self, i: usize, from: isize, sign: f64) -> f64 {
        let bend = |k: isize| self.curvature(i, from + k * from.signum()).map(|c| (sign * c).max(0.0));
        let Some(near) = bend(0) else { return 0.0 };
        let growth =
            bend(1).map_or(1.0, |far| (near / far.max(f64::MIN_POSITIVE)).clamp(1.0, MAX_CURVATURE_GROWTH));
        near * growth
    }

    /// Whether a turn over `width` points is more than those beside lead up to.
    fn is_corner(&self, i: usize, width: isize) -> bool {
        let n = self.all.len();
        let mut own = (0..width as usize).map(|k| self.all[(i + k) % n]);
        let add =
            |(turn, way): (f64, f64), own: Option<(f64, f64)>| own.map(|own| (turn + own.0, way + own.1));
        let Some((turn, way)) = own.try_fold((0.0, 0.0), add) else {
            return false;
        };
        let led_up = self.led_up_to(i, -1, turn.signum()).max(self.led_up_to(i, width, turn.signum()));
        f64::abs(turn) > MIN_CORNER_TURN_RATIO * led_up * way + MIN_CORNER_TURN
    }
}

/// The corners of a row in its order: at a point, or between two.
fn corners(clean: &Clean) -> Vec<Corner> {
    let turns = Turns::new(clean);
    let n = clean.points.len();
    let at: Vec<bool> = (0..n).map(|i| turns.is_corner(i, 1)).collect();
    let pairs = if clean.closed { n } else { n - 1 };
    let between = |i: &usize| !at[*i] && !at[(i + 1) % n] && turns.is_corner(*i, 2);
    let mut all: Vec<Corner> =
        (0..n).filter(|i| at[*i]).map(|after| Corner { after, on_point: true }).collect();
    all.extend((0..pairs).filter(between).map(|i| Corner { after: (i + 1) % n, on_point: false }));
    all.sort_unstable_by_key(|c| c.after);
    all
}

/// A stretch between corners.
struct Stretch {
    /// Its points, and the corners that are none.
    points: Vec<[f64; 2]>,
    ends: Ends<2>,
    /// Number of its first own point, and of own points; so many corners before these.
    first: usize,
    count: usize,
    before: usize,
}

impl Stretch {
    /// The line that its points lie on to within rounding.
    fn straight(&self, rounding: f64) -> Option<Segment> {
        let (a, b) = (self.points.first()?, self.points.last()?);
        let on = |p: &[f64; 2]| off_line([*a, *b], *p) <= rounding;
        (distance(*a, *b) > rounding && self.points.iter().all(on)).then(|| Segment::line(*a, *b))
    }
}

/// Direction of the circle through three points at the last of them.
fn heading(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> [f64; 2] {
    let (u, v, w) = (chord(a, b), chord(b, c), chord(a, c));
    // The angle between chord and tangent is that of the triangle at the far end.
    let by = angle(u, v) - angle(u, w);
    let (sin, cos) = libm::sincos(by);
    let size = distance(b, c).max(f64::MIN_POSITIVE);
    [(v[0] * cos - v[1] * sin) / size, (v[0] * sin + v[1] * cos) / size]
}

/// Curvature of the circle through three points, positive to the left.
fn bend(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    2.0 * libm::sin(angle(chord(a, b), chord(b, c))) / distance(a, c).max(f64::MIN_POSITIVE)
}

/// Where a corner is: at its point, or where parabolas from both sides cross between two, in the middle where they do not.
fn place(clean: &Clean, corner: &Corner) -> [f64; 2] {
    let (points, n) = (&clean.points, clean.points.len());
    let at = |by: usize| points[(corner.after + n + by - 3) % n];
    let (a, b) = (at(2), at(3));
    if corner.on_point {
        return b;
    }
    let (u, v) = (heading(at(0), at(1), a), heading(at(5), at(4), b));
    let bends = [bend(at(0), at(1), a), bend(at(5), at(4), b)];
    // A place of a parabola and its direction there.
    let on = |from: [f64; 2], u: [f64; 2], bend: f64, s: f64| {
        let normal = [-u[1], u[0]];
        let place = [0, 1].map(|k| from[k] + s * u[k] + 0.5 * s * s * bend * normal[k]);
        (place, [0, 1].map(|k| u[k] + s * bend * normal[k]))
    };
    let (gap, middle) = (distance(a, b), [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
    let (mut s, mut t) = (0.5 * gap, 0.5 * gap);
    for _ in 0..20 {
        let ((p, u), (q, v)) = (on(a, u, bends[0], s), on(b, v, bends[1], t));
        let d = [q[0] - p[0], q[1] - p[1]];
        let det = u[0] * v[1] - u[1] * v[0];
        s += (d[0] * v[1] - d[1] * v[0]) / det;
        t += (d[0] * u[1] - d[1] * u[0]) / det;
    }
    let inside = |s: f64| (0.0..=2.0 * gap).contains(&s);
    if inside(s) && inside(t) { on(a, u, bends[0], s).0 } else { middle }
}

/// The stretches of a row between corners. `None` where one has too few points.
fn stretches(clean: &Clean, corners: &[Corner]) -> Option<Vec<Stretch>> {
    let (points, n) = (&clean.points, clean.points.len());
    if clean.closed && corners.is_empty() {
        // It begins and ends at its first point, in the direction of the curve there.
        let (back, on) =
            (heading(points[n - 2], points[n - 1], points[0]), heading(points[2], points[1], points[0]));
        let along = [back[0] - on[0], back[1] - on[1]];
        let ends = Ends { start: End::Tangent(points[0], along), end: End::Tangent(points[0], along) };
        let all = points.iter().copied().chain([points[0]]).collect();
        return Some(vec![Stretch { points: all, ends, first: 0, count: n, before: 0 }]);
    }
    let mut starts: Vec<Option<Corner>> = corners.iter().copied().map(Some).collect();
    if !clean.closed {
        starts.insert(0, None);
    }
    let stretch = |k: usize| {
        let own = starts[k];
        let next = if k + 1 < starts.len() { starts[k + 1] } else { starts[0] };
        let first = own.map_or(0, |c| c.after);
        let to = if k + 1 < starts.len() { next.map_or(n, |c| c.after) } else { n };
        let (start, end) = (own.map(|c| place(clean, &c)), next.map(|c| place(clean, &c)));
        let before = own.is_some_and(|c| !c.on_point);
        let mut all: Vec<[f64; 2]> = start.filter(|_| before).into_iter().collect();
        all.extend_from_slice(&points[first..to]);
        all.extend(end);
        let kept = |at: Option<[f64; 2]>| at.map_or(End::Free, End::Through);
        let ends = Ends { start: kept(start), end: kept(end) };
        let count = to - first;
        (count >= MIN_POINTS_OF_ROW_AND_STRETCH.1 || all.len() == 2).then_some(Stretch {
            points: all,
            ends,
            first,
            count,
            before: usize::from(before),
        })
    };
    (0..starts.len()).map(stretch).collect()
}

/// The contour of the stretches. `None` where a curve does not keep the tolerance.
fn drawn(clean: &Clean, corners: &[Corner], least: f64, level: f64) -> Option<Contour> {
    let n = clean.points.len();
    let mut contour = Contour {
        closed: clean.closed,
        spacing: clean.spacing,
        labels: vec![0; n],
        residuals: vec![0.0; n],
        stations: vec![0.0; n],
        ..Contour::default()
    };
    let mut way = 0.0;
    for (k, stretch) in stretches(clean, corners)?.iter().enumerate() {
        if let Some(side) = stretch.straight(ROUNDING_SHARE * size(&clean.points)) {
            for (i, p) in stretch.points[stretch.before..].iter().take(stretch.count).enumerate() {
                contour.labels[stretch.first + i] = k as u32;
                contour.stations[stretch.first + i] = way + distance(side.start, *p);
            }
            way += side.length;
            contour.segments.push(Segment { count: stretch.count, ..side });
            continue;
        }
        let (curve, parameters) = followed(&stretch.points, stretch.ends, clean.spacing, least)?;
        let (from, to) = curve.domain();
        let whole = curve.length(from, to);
        let (mut square, mut max): (f64, f64) = (0.0, 0.0);
        for j in 0..stretch.count {
            let (p, t) = (stretch.points[j + stretch.before], parameters[j + stretch.before]);
            let foot = curve.closest_from(p, t, (from, to));
            let (d, along) = ([0, 1].map(|k| p[k] - foot.place[k]), curve.derivative(foot.parameter, 1));
            let left = along[0] * d[1] - along[1] * d[0] >= 0.0;
            let i = stretch.first + j;
            contour.labels[i] = k as u32;
            contour.residuals[i] = if left { foot.distance } else { -foot.distance };
            // The parameter is the share of the length, as near as the points tell it.
            contour.stations[i] = way + whole * foot.parameter;
            square += foot.distance * foot.distance;
            max = max.max(foot.distance);
        }
        contour.unknowns += 2.0 * curve.points().len() as f64;
        contour.noise += square / n as f64;
        way += whole;
        let ends = [curve.at(from), curve.at(to)];
        let bend = [from, to].map(|t| curve.curvature(t).unwrap_or(0.0));
        let mut segment = Segment::bare(Geometry::Spline { curve, deviation: 0.0 }, ends, whole, bend);
        (segment.count, segment.max) = (stretch.count, max);
        segment.rms = (square / stretch.count as f64).sqrt();
        contour.segments.push(segment);
    }
    contour.noise = contour.noise.sqrt();
    contour.joins = corners
        .iter()
        .map(|c| join(clean, c, least.max(FOLLOWED_TOLERANCES[0] * clean.spacing), level))
        .collect();
    if clean.closed && !corners.is_empty() {
        // The first corner is where the last segment ends.
        contour.joins.rotate_left(1);
    }
    let count = contour.segments.len();
    for k in 0..contour.joins.len() {
        let (a, b) =
            (direction(&contour.segments[k], 1.0), direction(&contour.segments[(k + 1) % count], 0.0));
        contour.joins[k].turn = angle(a, b);
    }
    Some(contour)
}

/// Direction of a segment at a share of it.
fn direction(segment: &Segment, share: f64) -> [f64; 2] {
    let Geometry::Spline { curve, .. } = &segment.geometry else {
        return [0, 1].map(|k| segment.end[k] - segment.start[k]);
    };
    let (from, to) = curve.domain();
    curve.derivative(from + share * (to - from), 1)
}

/// A corner at a point is as uncertain as the curves keep to it; one between two points is anywhere between them.
fn join(clean: &Clean, corner: &Corner, tolerance: f64, level: f64) -> Join {
    let n = clean.points.len();
    let point = place(clean, corner);
    let [a, b] = [(corner.after + n - 1) % n, corner.after].map(|i| clean.points[i]);
    let quantile = student_quantile(1.0 - level, n as f64);
    let width = distance(a, b);
    let along = [0, 1].map(|k| (b[k] - a[k]) / width.max(f64::MIN_POSITIVE));
    let end = |sign: f64| [0, 1].map(|k| point[k] + sign * quantile * tolerance * along[k]);
    let (interval, uncertainty) = match corner.on_point || width <= tolerance {
        true => ([end(-1.0), end(1.0)], tolerance),
        false => ([a, b], width * (1.0_f64 / 12.0).sqrt()),
    };
    let open = [!corner.on_point && width > tolerance; 2];
    Join { point, continuity: Continuity::G0, interval, uncertainty, open, turn: 0.0 }
}

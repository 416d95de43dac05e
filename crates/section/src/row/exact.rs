//! Sparse rows without noise whose points lie on lines and on arcs tangent to them; and fits that miss points that are exact.
//!
//! Corners of a few points tell a search by likelihood nothing: there are as many unknowns as points. But lines of
//! three points and more are known exactly, and an arc that is tangent to two of them has one unknown, its radius. A
//! second point of it, or another arc of the same radius, proves it.

use super::clean::{Clean, size};
use super::polygon::{MIN_CORNER_TURN, MIN_POINTS_PER_LINE};
use crate::model::chain::SegmentKind;
use crate::model::flat::{angle, distance, dot, left, minus, off_circle, off_line};
use crate::model::prior::NEGLIGIBLE_OFFSET_SPACINGS;
use crate::model::result::Contour;
use crate::search::parts::Part;

/// Longer rows tell their segments themselves.
const MAX_POINTS_OF_EXACT_ROW: usize = 200;
/// Points lie on an arc as well as on lines, but for this factor: its radius comes from one of them.
const ARC_TOLERANCE_FACTOR: f64 = 20.0;
/// Radii that agree to this share prove each other.
const EQUAL_RADIUS_SHARE: f64 = 1e-4;

/// A line of a run of points, and the points after it up to the next run.
struct Run {
    from: usize,
    to: usize,
    along: [f64; 2],
}

/// Center and curvature of an arc between two lines; `None` where they meet in a corner.
type Between = Option<([f64; 2], f64)>;

/// Coordinates in files are rounded: to within the first of these shares of the size, or the second.
const ROUNDING_SHARES: [f64; 2] = [1e-6, 1e-5];

/// The lines and arcs of a row whose points lie on them exactly, to within `least` or the rounding of coordinates.
/// Every arc is tangent to the lines beside it. Also where the row is turned to, so that it begins with a line.
pub(super) fn rounded(clean: &Clean, least: f64) -> Option<(usize, Vec<Part>)> {
    ROUNDING_SHARES.iter().find_map(|share| within(clean, least.max(share * size(&clean.points))))
}

/// The same to within `tolerance`.
fn within(clean: &Clean, tolerance: f64) -> Option<(usize, Vec<Part>)> {
    let n = clean.points.len();
    if !(2 * MIN_POINTS_PER_LINE..=MAX_POINTS_OF_EXACT_ROW).contains(&n) {
        return None;
    }
    let straight = |i: usize| {
        let [a, b, c] = [i, i + 1, i + 2].map(|k| clean.points[k % n]);
        let size = distance(a, c);
        size > 0.0 && left(b, a, minus(c, a).map(|x| x / size)).abs() <= tolerance
    };
    let by = if clean.closed { (0..n).find(|i| straight(*i) && !straight((i + n - 1) % n))? } else { 0 };
    let mut points = clean.points.clone();
    points.rotate_left(by);
    let runs = runs(&points, tolerance);
    let ends = runs.first()?.from == 0 && (clean.closed || runs.last()?.to == n);
    let last = if clean.closed { runs.len() } else { runs.len() - 1 };
    if !ends || runs.len() < 2 {
        return None;
    }
    let mut arcs = vec![];
    for k in 0..last {
        let (a, b) = (&runs[k], &runs[(k + 1) % runs.len()]);
        let end = if k + 1 < runs.len() { b.from } else { n };
        arcs.push((a.to, end, arc(&points, a, b, end, tolerance)?));
    }
    let proven = |k: usize| {
        let (from, to, radius) = (arcs[k].0, arcs[k].1, arcs[k].2.map(|(_, c)| 1.0 / c.abs()));
        let same = |r: f64, (i, j, other): &(usize, usize, Between)| {
            j > i && other.is_some_and(|(_, c)| (r * c.abs() - 1.0).abs() <= EQUAL_RADIUS_SHARE)
        };
        to - from != 1 || radius.is_some_and(|r| arcs.iter().filter(|a| same(r, a)).count() > 1)
    };
    // Rows of corners alone are polygons.
    if !(0..last).all(proven) || arcs.iter().all(|a| a.2.is_none()) {
        return None;
    }
    Some((by, parts(&points, &runs, &arcs)))
}

/// Runs of points on a line, each as long as it goes.
fn runs(points: &[[f64; 2]], tolerance: f64) -> Vec<Run> {
    let n = points.len();
    let fits = |from: usize, to: usize| {
        let size = distance(points[from], points[to]);
        let along = minus(points[to], points[from]).map(|x| x / size);
        let near = |p: &[f64; 2]| left(*p, points[from], along).abs() <= tolerance;
        let onward = |w: &[[f64; 2]]| dot(minus(w[1], w[0]), along) > 0.0;
        let all = &points[from..=to];
        (size > 0.0 && all.iter().all(near) && all.windows(2).all(onward)).then_some(along)
    };
    let mut all = vec![];
    let mut i = 0;
    while i + MIN_POINTS_PER_LINE <= n {
        let Some(mut along) = fits(i, i + MIN_POINTS_PER_LINE - 1) else {
            i += 1;
            continue;
        };
        let mut to = i + MIN_POINTS_PER_LINE;
        while to < n
            && let Some(longer) = fits(i, to)
        {
            (along, to) = (longer, to + 1);
        }
        all.push(Run { from: i, to, along });
        i = to;
    }
    all
}

/// The arc tangent to two lines through the points between them: its center and curvature. `Some(None)` without points: a corner.
/// `None` where the points lie on no such arc.
fn arc(points: &[[f64; 2]], a: &Run, b: &Run, end: usize, tolerance: f64) -> Option<Between> {
    let between = &points[a.to..end];
    let turn = angle(a.along, b.along);
    let (last, first) = (points[a.to - 1], points[b.from]);
    if between.is_empty() {
        // A run that rounding broke has no corner.
        return (turn.abs() > MIN_CORNER_TURN).then_some(None);
    }
    // The center lies as far to the left of both lines, by the radius with the sense of the turn. One point more tells
    // how far.
    let half = 0.5 * (std::f64::consts::PI - turn.abs());
    let sense = if half < 1e-6 { left(first, last, a.along).signum() } else { turn.signum() };
    let normals = [a, b].map(|r| [-sense * r.along[1], sense * r.along[0]]);
    let middle = between[between.len() / 2];
    let (center, radius) = if half < 1e-6 {
        let radius = 0.5 * dot(minus(first, last), normals[0]);
        let along = dot(minus(middle, last), a.along);
        let up = dot(minus(middle, last), normals[0]) - radius;
        let x = along - (radius * radius - up * up).max(0.0).sqrt();
        ([0, 1].map(|k| last[k] + x * a.along[k] + radius * normals[0][k]), radius)
    } else {
        let det = a.along[0] * b.along[1] - a.along[1] * b.along[0];
        let d = minus(first, last);
        let s = (d[0] * b.along[1] - d[1] * b.along[0]) / det;
        let apex = [0, 1].map(|k| last[k] + s * a.along[k]);
        let (sin, cos) = libm::sincos(half);
        let inward = [0, 1].map(|k| (b.along[k] - a.along[k]) / (2.0 * cos));
        let p = minus(middle, apex);
        let root = dot(p, inward).powi(2) - cos * cos * dot(p, p);
        let far = (dot(p, inward) + root.max(0.0).sqrt()) / (cos * cos);
        ([0, 1].map(|k| apex[k] + far * inward[k]), far * sin)
    };
    let slack = ARC_TOLERANCE_FACTOR * tolerance;
    let near = |p: &[f64; 2]| (distance(*p, center) - radius).abs() <= slack;
    // The points where it leaves the lines lie between the points of these and its own.
    let is_between =
        dot(minus(center, last), a.along) >= -slack && dot(minus(first, center), b.along) >= -slack;
    (radius > slack && is_between && between.iter().all(near)).then_some(Some((center, sense / radius)))
}

fn parts(points: &[[f64; 2]], runs: &[Run], arcs: &[(usize, usize, Between)]) -> Vec<Part> {
    let mut all = vec![];
    for (k, run) in runs.iter().enumerate() {
        let center = [0, 1].map(|i| 0.5 * (points[run.from][i] + points[run.to - 1][i]));
        let base = Part {
            kind: SegmentKind::Line,
            from: run.from,
            to: run.to,
            curvature: 0.0,
            along: run.along,
            center,
        };
        all.push(base);
        if let Some((from, to, Some((center, curvature)))) = arcs.get(k).copied() {
            let out = minus(points[(from + to) / 2], center);
            let size = distance([0.0; 2], out).max(f64::MIN_POSITIVE);
            let unit = out.map(|x| x / size);
            let along = [-curvature.signum() * unit[1], curvature.signum() * unit[0]];
            let center = [0, 1].map(|i| center[i] + unit[i] / curvature.abs());
            all.push(Part { kind: SegmentKind::Arc, from, to, curvature, along, center });
        }
    }
    all
}

/// Points are exact that lie nearer than this share of the noise found to the line through their neighbors. So are
/// those that lie as near to a circle through three of them. One noisy point in a hundred does.
const EXACT_OFFSET_SIGMAS: f64 = 0.01;
/// So many exact points, and this share of all, are no chance.
const MIN_EXACT_POINTS_AND_SHARE: (usize, f64) = (3, 0.15);
/// Distances below this share of the distance between points are none of a fit that misses its points; the second holds in
/// short rows.
const MISSED_OFFSET_SPACINGS: [f64; 2] = [NEGLIGIBLE_OFFSET_SPACINGS, 0.0005];
/// Points that scatter by more than this share of the distance between them follow each other across the contour.
const MAX_SCATTER_SPACINGS: f64 = 0.25;
/// Rows of up to so many points are short.
const MAX_POINTS_OF_SHORT_ROW: usize = 60;
/// A segment that scatters by this share of the noise takes part in it.
const MIN_SCATTER_SHARE: f64 = 0.2;

/// Segments that miss points which are exact themselves: the contour's noise is none.
pub(super) fn missed(points: &[[f64; 2]], contour: &Contour) -> Vec<usize> {
    let n = points.len();
    let noise = contour.noise;
    let least = MISSED_OFFSET_SPACINGS[usize::from(n <= MAX_POINTS_OF_SHORT_ROW)];
    if n < 8 || !(least..MAX_SCATTER_SPACINGS).contains(&(noise / contour.spacing)) || quantized(points) {
        return vec![];
    }
    let count = if contour.closed { n } else { n - 3 };
    let on = |i: usize| {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| points[(i + k) % n]);
        off_line([a, c], b).min(off_circle([a, b, d], c)) <= EXACT_OFFSET_SIGMAS * noise
    };
    let exact = (0..count).filter(|i| on(*i)).count();
    if exact < MIN_EXACT_POINTS_AND_SHARE.0 || (exact as f64) < MIN_EXACT_POINTS_AND_SHARE.1 * n as f64 {
        return vec![];
    }
    let scatters = |k: &usize| contour.segments[*k].rms > MIN_SCATTER_SHARE * noise;
    (0..contour.segments.len()).filter(scatters).collect()
}

/// Whether all coordinates are multiples of the least step, as of the outlines of pixels.
pub(super) fn quantized(points: &[[f64; 2]]) -> bool {
    let steps = || points.windows(2).flat_map(|w| [w[1][0] - w[0][0], w[1][1] - w[0][1]]).map(f64::abs);
    let greatest = steps().fold(0.0, f64::max);
    let least = steps().filter(|s| *s > 1e-9 * greatest).fold(f64::INFINITY, f64::min);
    steps().all(|s| (s / least - (s / least).round()).abs() < 1e-3)
}

//! One line and one free curve, and the join between them, by the steps of a paper.
//!
//! Feng, Zhang, Jin and Liu, Determination of the interval of segmentation points and their reconstruction with high
//! precision (in Chinese). The row is turned so that its straight part is level, and its ordinates are smoothed by
//! their mean. The interval of the join ends on the right where they leave three standard deviations of the straight
//! part. It ends on the left where a window of them correlates with the straight part. Within it a golden-section
//! search finds the join of least squares. The curve is fitted anew at each place, as a cubic B-spline that starts on
//! the line and along it. The paper compares with two methods.
//! `stepwise` takes the measured point at which the curvature leaves that of the line. `improved` searches an interval
//! about that point, where the paper has one picked by hand.
//!
//! The straight part, which the paper has marked by hand, is the longest that the noise of
//! [`contour`](crate::contour()) allows, less a tenth of it. See docs/section.md for the weak points in the rules of
//! the interval.

use crate::model::prior::NEGLIGIBLE_OFFSET_SPACINGS;
use crate::model::result::{Contour, Geometry, Options, SectionError, Segment};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::spline::curve::{self, Curve, End, Ends};

/// How the join is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// The measured point at which the curvature leaves that of the line.
    Stepwise,
    /// Golden-section search in an interval of four points about that one.
    Improved,
    /// Golden-section search in the interval found.
    Golden,
}

/// A segment whose points scatter by more than so many noises of the default's contour is unreliable.
const MAX_SEGMENT_RMS_SIGMAS: f64 = 4.0;

impl Search {
    /// All, in the order of the paper's table.
    pub const ALL: [Search; 3] = [Search::Stepwise, Search::Improved, Search::Golden];
    /// The word for it: `stepwise`, `improved`, `golden`.
    pub fn name(self) -> &'static str {
        match self {
            Search::Stepwise => "stepwise",
            Search::Improved => "improved",
            Search::Golden => "golden",
        }
    }
}

/// Result of one method.
#[derive(Clone, Debug, PartialEq)]
pub struct Method {
    /// Which it is.
    pub search: Search,
    /// The interval that it looked in, from the line to the curve; of `stepwise` the two measured points about the join.
    pub interval: [[f64; 2]; 2],
    /// The join, on the line.
    pub join: [f64; 2],
    /// A place of the line, and its direction towards the curve.
    pub line: ([f64; 2], [f64; 2]),
    /// The curve from the join on.
    pub curve: Curve<[f64; 2]>,
    /// Root mean square and greatest magnitude of the distances from the line.
    pub line_residuals: [f64; 2],
    /// The same from the curve.
    pub curve_residuals: [f64; 2],
    /// Points of the line.
    pub on_line: usize,
}

/// Points on either side of the mean that smoothes.
const SMOOTHING_POINTS_PER_SIDE: usize = 2;
/// Standard deviations that the straight part keeps within: the paper's.
const BAND_SIGMAS: f64 = 3.0;
/// A window belongs to the straight part whose correlation with it is above this: the paper's.
const MIN_STRAIGHT_CORRELATION: f64 = 0.5;
/// Fewest points of the straight part.
const MIN_STRAIGHT_POINTS: usize = 8;
/// Share of the straight part that is left out before the supposed join.
const JOIN_MARGIN_SHARE: f64 = 0.1;
/// The search ends at this share of the distance between points.
const SEARCH_END_SPACINGS: f64 = 1e-4;
/// Points of the interval about a measured point, to either side.
const INTERVAL_HALF_WIDTH_SPACINGS: f64 = 2.0;

/// The join of one line and one free curve by each of the paper's three methods. `interval` replaces the paper's rule for
/// the interval of `golden`, from the line to the curve.
///
/// Returns the methods in the order of [`Search::ALL`], and whether the row was run through from its end, as the line is
/// there.
///
/// # Errors
/// The errors of [`contour`](crate::contour()). [`SectionError::NoLine`] where neither end of the row is a line; a
/// closed row.
///
/// Cost: some sixty fits of the curve. See [`contour`](crate::contour()) for the default, which finds any number of segments.
pub fn line_and_curve(
    points: &[[f64; 2]],
    found: &Contour,
    interval: Option<[[f64; 2]; 2]>,
    progress: &dyn Progress,
) -> Result<(Vec<Method>, bool), SectionError> {
    let kept: Vec<usize> = (0..points.len())
        .filter(|i| found.outliers.binary_search(i).is_err() && found.repeated.binary_search(i).is_err())
        .collect();
    let mut row: Vec<[f64; 2]> = kept.iter().map(|i| points[*i]).collect();
    let noise = found.noise.max(1e-4 * found.spacing);
    let lines = [straight(&row, noise), {
        row.reverse();
        straight(&row, noise)
    }];
    // The longer of two straight ends is the line.
    let reversed = lines[1] > lines[0];
    if !reversed {
        row.reverse();
    }
    let on_line = lines[0].max(lines[1]);
    if found.closed || on_line < MIN_STRAIGHT_POINTS || row.len() < on_line + 4 {
        return Err(SectionError::NoLine);
    }
    let sure = on_line - ((on_line as f64 * JOIN_MARGIN_SHARE).ceil() as usize).max(1);
    let work = Work::new(row, sure, found.spacing);
    let point = work.leaves_by_curvature();
    let paper = match interval {
        Some([a, b]) => {
            let mut ends = [work.along(a), work.along(b)];
            ends.sort_by(f64::total_cmp);
            ends
        }
        None => work.interval_of_paper(),
    };
    let s = work.along(work.row[point]);
    let about = INTERVAL_HALF_WIDTH_SPACINGS * work.spacing;
    let count = work.control_points(s);
    let mut all = vec![];
    for search in Search::ALL {
        let (from, to) = match search {
            Search::Stepwise => (s, s),
            Search::Improved => (s - about, s + about),
            Search::Golden => (paper[0], paper[1]),
        };
        let at = work.golden(from, to, count, progress)?;
        let ends = if search == Search::Stepwise { [s - work.spacing, s + work.spacing] } else { [from, to] };
        all.push(work.method(search, ends, at, count)?);
    }
    Ok((all, reversed))
}

/// A row whose first points are a line.
struct Work {
    row: Vec<[f64; 2]>,
    spacing: f64,
    /// Points that are on the line for sure.
    sure: usize,
    /// The line through them: a place, and the direction towards the curve.
    base: [f64; 2],
    direction: [f64; 2],
    /// Heights over it, smoothed.
    heights: Vec<f64>,
}

/// How many points from the first on are straight. Their root mean square distance from a line is no greater than the
/// noise of the row, by more than chance.
fn straight(row: &[[f64; 2]], noise: f64) -> usize {
    let mut sums = [0.0; 5];
    let mut longest = 0;
    for (i, p) in row.iter().enumerate() {
        let (x, y) = (p[0] - row[0][0], p[1] - row[0][1]);
        let terms = [x, y, x * x, x * y, y * y];
        (0..5).for_each(|k| sums[k] += terms[k]);
        let n = (i + 1) as f64;
        let (xx, xy) = (sums[2] - sums[0] * sums[0] / n, sums[3] - sums[0] * sums[1] / n);
        let yy = sums[4] - sums[1] * sums[1] / n;
        let half = 0.5 * (xx - yy);
        let least = 0.5 * (xx + yy) - (half * half + xy * xy).sqrt();
        // Two standard deviations of a variance of so many degrees of freedom.
        let degrees = (n - 2.0).max(1.0);
        if least <= degrees * noise * noise * (1.0 + 2.0 * (2.0 / degrees).sqrt()) {
            longest = i + 1;
        } else if i >= 2 * MIN_STRAIGHT_POINTS.max(longest) {
            break;
        }
    }
    longest
}

/// The line of least squared distances through points, in their order.
fn line(points: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let n = points.len() as f64;
    let middle = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for p in points {
        let (x, y) = (p[0] - middle[0], p[1] - middle[1]);
        (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
    }
    let (sin, cos) = libm::sincos(0.5 * libm::atan2(2.0 * xy, xx - yy));
    let (first, last) = (points[0], points[points.len() - 1]);
    let forward = if (last[0] - first[0]) * cos + (last[1] - first[1]) * sin < 0.0 { -1.0 } else { 1.0 };
    (middle, [forward * cos, forward * sin])
}

fn mean_and_deviation(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let sum: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
    (mean, (sum / (n - 1.0).max(1.0)).sqrt())
}

impl Work {
    fn new(row: Vec<[f64; 2]>, sure: usize, spacing: f64) -> Work {
        let (base, direction) = line(&row[..sure]);
        let mut work = Work { row, spacing, sure, base, direction, heights: vec![] };
        let raw: Vec<f64> = work.row.iter().map(|p| work.height(*p)).collect();
        let n = raw.len();
        let mean = |i: usize| {
            let half = SMOOTHING_POINTS_PER_SIDE.min(i).min(n - 1 - i);
            raw[i - half..=i + half].iter().sum::<f64>() / (2 * half + 1) as f64
        };
        work.heights = (0..n).map(mean).collect();
        work
    }

    fn along(&self, p: [f64; 2]) -> f64 {
        (p[0] - self.base[0]) * self.direction[0] + (p[1] - self.base[1]) * self.direction[1]
    }
    fn height(&self, p: [f64; 2]) -> f64 {
        (p[1] - self.base[1]) * self.direction[0] - (p[0] - self.base[0]) * self.direction[1]
    }

    /// The first point from the end of the straight part on at which the curvature leaves that of the straight part, and stays.
    fn leaves_by_curvature(&self) -> usize {
        let n = self.row.len();
        let bend = |i: usize| {
            let (a, b, c) = (i - 1, i, i + 1);
            let [x, y, z] = [a, b, c].map(|k| self.along(self.row[k]));
            let [u, v, w] = [a, b, c].map(|k| self.heights[k]);
            ((w - v) / (z - y) - (v - u) / (y - x)) / (0.5 * (z - x))
        };
        let straight: Vec<f64> = (1..self.sure - 1).map(bend).filter(|b| b.is_finite()).collect();
        let (_, deviation) = mean_and_deviation(&straight);
        let off = |i: usize| bend(i).abs() > BAND_SIGMAS * deviation;
        (self.sure..n - 3).find(|i| (0..3).all(|k| off(i + k))).unwrap_or(self.sure)
    }

    /// The paper's interval: where the smoothed heights leave the band of the straight part, and back to where a window of
    /// them correlates with it.
    fn interval_of_paper(&self) -> [f64; 2] {
        let n = self.row.len();
        let straight = &self.heights[..self.sure];
        let (mean, deviation) = mean_and_deviation(straight);
        let outside = |i: &usize| (self.heights[*i] - mean).abs() > BAND_SIGMAS * deviation;
        let right = (self.sure..n).find(outside).unwrap_or(n - 1);
        let correlation = |end: usize| {
            let window = &self.heights[end + 1 - self.sure..=end];
            let (m, d) = mean_and_deviation(window);
            let product: f64 = window.iter().zip(straight).map(|(a, b)| (a - m) * (b - mean)).sum();
            product / ((self.sure as f64 - 1.0).max(1.0) * d * deviation).max(f64::MIN_POSITIVE)
        };
        let left = (self.sure - 1..right).rev().find(|end| correlation(*end) > MIN_STRAIGHT_CORRELATION);
        let left = left.unwrap_or(self.sure - 1);
        [self.along(self.row[left]), self.along(self.row[right])]
    }

    /// Line, place of the join and points before it, for a join at `s` along the first line.
    fn split(&self, s: f64) -> (([f64; 2], [f64; 2]), [f64; 2], usize) {
        let n = self.row.len();
        let before = self.row.iter().take_while(|p| self.along(**p) <= s).count().clamp(3, n - 3);
        let own = line(&self.row[..before]);
        let at = [0, 1].map(|k| self.base[k] + s * self.direction[k]);
        let t = (at[0] - own.0[0]) * own.1[0] + (at[1] - own.0[1]) * own.1[1];
        (own, [own.0[0] + t * own.1[0], own.0[1] + t * own.1[1]], before)
    }

    /// The curve from a join on: of so many control points, through the join, along the line.
    fn curve(&self, s: f64, count: usize) -> Result<Curve<[f64; 2]>, SectionError> {
        let (own, join, before) = self.split(s);
        let mut points = vec![join];
        points.extend_from_slice(&self.row[before..]);
        let ends = Ends { start: End::Tangent(join, own.1), end: End::Free };
        let mut parameters = curve::chord_parameters(&points).ok_or(SectionError::NoLine)?;
        let mut count = count.min(points.len() / 2).max(4);
        loop {
            let knots = curve::spread_knots(3, count, &parameters);
            match curve::corrected(&points, &mut parameters, &knots, ends) {
                Ok(fitted) => return Ok(fitted.curve),
                Err(_) if count > 4 => count -= 1,
                Err(_) => return Err(SectionError::NoLine),
            }
        }
    }

    /// Control points that keep the curve within three standard deviations of the straight part. Where points so few do
    /// not determine as many, it is half as many as points.
    fn control_points(&self, s: f64) -> usize {
        let (own, join, before) = self.split(s);
        let heights: Vec<f64> = self.row[..self.sure].iter().map(|p| self.height(*p)).collect();
        let tolerance = (BAND_SIGMAS * mean_and_deviation(&heights).1).max(1e-4 * self.spacing);
        let mut points = vec![join];
        points.extend_from_slice(&self.row[before..]);
        let ends = Ends { start: End::Tangent(join, own.1), end: End::Free };
        let fitted = curve::approximate(&points, 3, ends, tolerance);
        fitted.map_or(points.len() / 2, |f| f.curve.points().len())
    }

    /// Distances of all points, those of the line first.
    fn distances(&self, s: f64, curve: &Curve<[f64; 2]>) -> (Vec<f64>, Vec<f64>) {
        let ((middle, u), _, before) = self.split(s);
        let off = |p: &[f64; 2]| ((p[1] - middle[1]) * u[0] - (p[0] - middle[0]) * u[1]).abs();
        (
            self.row[..before].iter().map(off).collect(),
            self.row[before..].iter().map(|p| curve.closest(*p).distance).collect(),
        )
    }

    /// The sum of squares of a join; where there is no curve from it, infinite.
    fn cost(&self, s: f64, count: usize) -> f64 {
        self.curve(s, count).map_or(f64::INFINITY, |curve| {
            let (on, off) = self.distances(s, &curve);
            on.iter().chain(&off).map(|d| d * d).sum()
        })
    }

    /// The join of least squares between two places, by golden sections.
    fn golden(
        &self,
        mut from: f64,
        mut to: f64,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<f64, SectionError> {
        let share = 0.5 * (5.0_f64.sqrt() - 1.0);
        let at = |from: f64, to: f64| [to - share * (to - from), from + share * (to - from)];
        let [mut a, mut b] = at(from, to);
        if to - from <= SEARCH_END_SPACINGS * self.spacing {
            return Ok(0.5 * (from + to));
        }
        let (mut at_a, mut at_b) = (self.cost(a, count), self.cost(b, count));
        while to - from > SEARCH_END_SPACINGS * self.spacing {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            if at_a <= at_b {
                (to, b, at_b) = (b, a, at_a);
                a = at(from, to)[0];
                at_a = self.cost(a, count);
            } else {
                (from, a, at_a) = (a, b, at_b);
                b = at(from, to)[1];
                at_b = self.cost(b, count);
            }
        }
        Ok(0.5 * (from + to))
    }

    fn method(&self, search: Search, ends: [f64; 2], s: f64, count: usize) -> Result<Method, SectionError> {
        let curve = self.curve(s, count)?;
        let (line, join, on_line) = self.split(s);
        let (on, off) = self.distances(s, &curve);
        let rms_and_max = |d: &[f64]| {
            let square: f64 = d.iter().map(|x| x * x).sum();
            [(square / d.len().max(1) as f64).sqrt(), d.iter().copied().fold(0.0, f64::max)]
        };
        let interval = ends.map(|s| [0, 1].map(|k| self.base[k] + s * self.direction[k]));
        let (line_residuals, curve_residuals) = (rms_and_max(&on), rms_and_max(&off));
        Ok(Method { search, interval, join, line, curve, line_residuals, curve_residuals, on_line })
    }
}

/// The contour of one method: a line, and the curve as one segment.
///
/// Segments whose points are off by several times the noise that the default's contour leaves are unreliable. `found` is the contour of the default, and `reversed` as [`line_and_curve`] told it. The join's interval is the method's;
/// its standard uncertainty that of a value anywhere in the interval.
pub fn method_contour(
    points: &[[f64; 2]],
    found: &Contour,
    method: &Method,
    reversed: bool,
    options: &Options,
) -> Contour {
    use crate::model::result::{Continuity, Join};
    let n = points.len();
    let (middle, u) = method.line;
    let first = if reversed { points[n - 1] } else { points[0] };
    let t = (first[0] - middle[0]) * u[0] + (first[1] - middle[1]) * u[1];
    let start = [middle[0] + t * u[0], middle[1] + t * u[1]];
    let far = |a: [f64; 2], b: [f64; 2]| libm::hypot(b[0] - a[0], b[1] - a[1]);
    let (from, to) = method.curve.domain();
    let line = Segment::line(start, method.join);
    let bend = [from, to].map(|t| method.curve.curvature(t).unwrap_or(0.0));
    let length = method.curve.length(from, to);
    let spline = Geometry::Spline { curve: method.curve.clone(), deviation: 0.0 };
    let curve = Segment::bare(spline, [method.join, method.curve.at(to)], length, bend);
    let width = far(method.interval[0], method.interval[1]);
    let mut all = Contour { segments: vec![line, curve], ..found.clone() };
    all.joins = vec![Join {
        point: method.join,
        continuity: Continuity::G1,
        interval: method.interval,
        uncertainty: width * (1.0 / 12.0_f64).sqrt(),
        open: [false; 2],
        turn: 0.0,
    }];
    if reversed {
        all.segments = all.segments.into_iter().rev().map(Segment::reversed).collect();
        all.joins[0].interval.reverse();
    }
    let (on_line, kept) = (method.on_line, n - found.outliers.len() - found.repeated.len());
    let mut passed = 0;
    let before = all.segments[0].length;
    for i in 0..n {
        let left_out = found.outliers.binary_search(&i).is_ok() || found.repeated.binary_search(&i).is_ok();
        passed += usize::from(!left_out);
        let first = match reversed {
            true => passed <= kept - on_line,
            false => passed <= on_line,
        };
        let label = usize::from(!first);
        let (station, off) = all.segments[label].foot(points[i]);
        (all.labels[i], all.residuals[i]) = (label as u32, off);
        all.stations[i] = station + if first { 0.0 } else { before };
        if !left_out {
            let own = &mut all.segments[label];
            own.count += 1;
            own.rms += off * off;
            own.max = own.max.max(off.abs());
        }
    }
    let sum: f64 = all.segments.iter().map(|s| s.rms).sum();
    all.segments.iter_mut().for_each(|s| s.rms = (s.rms / s.count.max(1) as f64).sqrt());
    // A rule to stop may end far from where the line does: the points then tell the noise, not their residuals.
    let most = MAX_SEGMENT_RMS_SIGMAS * found.noise.max(NEGLIGIBLE_OFFSET_SPACINGS * found.spacing);
    all.unreliable = (0..all.segments.len()).filter(|k| all.segments[*k].rms > most).collect();
    all.noise = options.noise.unwrap_or((sum / kept.max(1) as f64).sqrt());
    all
}

#[cfg(test)]
mod tests;

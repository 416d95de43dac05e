//! Rows of points as they come: their faults, and the points that are passed over.

use crate::model::flat::distance;
use crate::model::result::{Options, SectionError};
use trueness_geom::num::median::median;

/// A row made fit for the search.
#[derive(Clone, Debug)]
pub(super) struct Clean {
    /// Points seen from `middle`, without repeated ones.
    pub points: Vec<[f64; 2]>,
    /// Their numbers in the row given.
    pub numbers: Vec<usize>,
    pub middle: [f64; 2],
    pub repeated: Vec<usize>,
    /// From this point on all repeat the first.
    pub ends_meet: Option<usize>,
    pub gaps: Vec<usize>,
    pub closed: bool,
    /// Median distance between neighbors.
    pub spacing: f64,
    /// Standard deviation that coordinates have for being rounded to a step; 0 where none is seen.
    pub rounding: f64,
}

/// Median step over median distance of nearest points from which on a row is no row.
const MAX_STEP_RATIO_OF_ROW: f64 = 12.0;
/// Steps of so many medians are gaps.
pub(crate) const GAP_SPACINGS: f64 = 5.0;
/// A contour closes over a gap of so many medians.
const CLOSING_GAP_SPACINGS: f64 = 3.0;

/// Nine points on two lines have a sum of squares of at most so many variances of the noise. One case in a thousand is
/// above (chi-squared, 5 degrees of freedom).
const MAX_CORNER_CHI_SQUARED: f64 = 20.5;

/// Outliers are looked for so many times.
const OUTLIER_PASSES: usize = 4;

/// Which points of a row count, and which repeat the one before.
pub(crate) struct DistinctPoints {
    pub numbers: Vec<usize>,
    pub repeated: Vec<usize>,
    /// From this point on all are where the first is; they are among the repeated ones.
    pub ends_meet: Option<usize>,
}

impl DistinctPoints {
    pub fn of(points: &[[f64; 2]], open: bool) -> DistinctPoints {
        let mut all = DistinctPoints { numbers: vec![], repeated: vec![], ends_meet: None };
        for (i, p) in points.iter().enumerate() {
            match all.numbers.last() {
                Some(last) if points[*last] == *p => all.repeated.push(i),
                _ => all.numbers.push(i),
            }
        }
        let at_start = |numbers: &[usize]| {
            numbers.len() > 1 && numbers.last().is_some_and(|l| points[*l] == points[numbers[0]])
        };
        // An open contour may come back to where it started.
        while !open && at_start(&all.numbers) {
            all.ends_meet = all.numbers.pop();
            all.repeated.extend(all.ends_meet);
        }
        all.repeated.sort_unstable();
        all
    }

    /// The points before gaps.
    pub fn gaps(&self, points: &[[f64; 2]]) -> Vec<usize> {
        let far = |w: &[usize]| distance(points[w[0]], points[w[1]]);
        let mut steps: Vec<f64> = self.numbers.windows(2).map(far).collect();
        let spacing = median(&mut steps).unwrap_or(0.0);
        let wide = self.numbers.windows(2).filter(|w| far(w) > GAP_SPACINGS * spacing);
        wide.map(|w| w[0]).collect()
    }
}

/// A row passes places again from which most of its points are this many times nearer to another than to the next.
const REPEATED_STEP_RATIO: f64 = 1e9;

impl Clean {
    /// Cleans a row whose coordinates are numbers.
    pub fn new(points: &[[f64; 2]], options: &Options) -> Result<Clean, SectionError> {
        let passed = DistinctPoints::of(points, options.closed == Some(false));
        let gaps = passed.gaps(points);
        let DistinctPoints { numbers, repeated, ends_meet } = passed;
        let mut all: Vec<[f64; 2]> = numbers.iter().map(|i| points[*i]).collect();
        let mut different = all.clone();
        different.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        different.dedup();
        if different.len() < 4 {
            return Err(SectionError::TooFewPoints { found: different.len() });
        }
        let steps: Vec<f64> = all.windows(2).map(|w| distance(w[0], w[1])).collect();
        let spacing = median(&mut steps.clone()).unwrap_or(0.0);
        let ratio = spacing / nearest(&all).max(f64::MIN_POSITIVE);
        if ratio > REPEATED_STEP_RATIO && all.len() > 8 {
            return Err(SectionError::PlacesAgain);
        }
        if ratio > MAX_STEP_RATIO_OF_ROW && all.len() > 8 && !options.ordered {
            return Err(SectionError::Unordered { ratio });
        }
        let found = ends_meet.is_some()
            || all.len() > 8 && distance(all[0], all[all.len() - 1]) <= CLOSING_GAP_SPACINGS * spacing;
        let closed = options.closed.unwrap_or(found);
        let n = all.len() as f64;
        let middle = [0, 1].map(|k| all.iter().map(|p| p[k] / n).sum::<f64>());
        let rounding = rounding(&all, spacing);
        all.iter_mut().for_each(|p| (0..2).for_each(|k| p[k] -= middle[k]));
        Ok(Clean { points: all, numbers, middle, repeated, ends_meet, gaps, closed, spacing, rounding })
    }

    /// Points that lie far off the curve of their neighbors on both sides, where these agree: eight times the noise.
    /// Neighbors are taken `step` points apart.
    pub fn outliers(&self, noise: f64, step: usize) -> Vec<usize> {
        let n = self.points.len();
        let limit = 8.0 * noise;
        if n < 12 * step || limit == 0.0 {
            return vec![];
        }
        let mut out = vec![false; n];
        // The outer ones of outliers near each other are found first; then they are no neighbors any more.
        for _ in 0..OUTLIER_PASSES {
            let before = out.clone();
            for i in (0..n).filter(|i| !before[*i]) {
                let near = self.around(i, step, &before);
                let Some((own, rest)) = off_parabola(&near, self.points[i]) else { continue };
                let limit = limit + bend(&near);
                let agreed = 3.0 * noise;
                let alone =
                    own > limit && (rest < agreed || without_two(&near, self.points[i], limit, agreed));
                out[i] = alone && !self.at_corner(i, step, &before, noise);
            }
            if out == before {
                break;
            }
        }
        (0..n).filter(|i| out[*i]).collect()
    }

    /// Puts outliers, ascending, on the straight way between the points beside them. They count nothing, and nothing
    /// that begins or ends with one is to be led there.
    pub fn bring_in(&mut self, outliers: &[usize]) {
        let n = self.points.len();
        let is_out = |i: &usize| outliers.binary_search(i).is_ok();
        for &i in outliers {
            let (most_back, most_on) = if self.closed { (n - 1, n - 1) } else { (i, n - 1 - i) };
            let before = (1..=most_back).find(|k| !is_out(&((i + n - k) % n)));
            let after = (1..=most_on).find(|k| !is_out(&((i + k) % n)));
            let back = |k: usize| self.points[(i + n - k) % n];
            let on = |k: usize| self.points[(i + k) % n];
            self.points[i] = match (before, after) {
                (Some(b), Some(c)) => {
                    let (from, to, share) = (back(b), on(c), b as f64 / (b + c) as f64);
                    [0, 1].map(|k| from[k] + share * (to[k] - from[k]))
                }
                (Some(b), None) => back(b),
                (None, Some(c)) => on(c),
                (None, None) => continue,
            };
        }
    }

    /// Whether a point and its neighbors lie on two lines, as they do around a corner. A parabola through the neighbors
    /// passes the corner by. An outlier lies in one of the two groups with four others at least, and leaves 0.4 of its
    /// square there.
    fn at_corner(&self, i: usize, step: usize, out: &[bool], noise: f64) -> bool {
        let mut all = self.around(i, step, out);
        let middle = all.len() / 2;
        if all.len() != 8 {
            return false;
        }
        all.insert(middle, self.points[i]);
        let two = |k: usize| off_line(&all[..k]) + off_line(&all[k..]);
        (2..=7).any(|k| two(k) <= MAX_CORNER_CHI_SQUARED * noise * noise)
    }

    /// Up to four points on either side of one, in order, `step` apart, without those that are `out`.
    fn around(&self, i: usize, step: usize, out: &[bool]) -> Vec<[f64; 2]> {
        let n = self.points.len();
        let side = |forward: bool| {
            let place = move |k: usize| {
                let j = if forward { i + 4 * n + k * step } else { (i + 4 * n).checked_sub(k * step)? };
                (self.closed || (4 * n..5 * n).contains(&j)).then_some(j % n)
            };
            (1..=8).map_while(place).filter(|j| !out[*j]).take(4).map(|j| self.points[j])
        };
        let mut near: Vec<[f64; 2]> = side(false).collect();
        near.reverse();
        near.extend(side(true));
        near
    }
}

/// How far a curve may be from the chord between a point's two neighbors. It turns there by as much as the neighbors on
/// either side differ in heading. The distance is a quarter of the chord's length times that angle. Beside gaps in a
/// bend no parabola tells where it runs.
fn bend(near: &[[f64; 2]]) -> f64 {
    let (left, right) = near.split_at(near.len() / 2);
    let heading = |part: &[[f64; 2]]| {
        let (a, b) = (part.first()?, part.last()?);
        Some([b[0] - a[0], b[1] - a[1]])
    };
    let Some((u, v)) = heading(left).zip(heading(right)) else { return 0.0 };
    let turn = libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
    let gap = left.last().zip(right.first()).map_or(0.0, |(a, b)| distance(*a, *b));
    0.25 * turn.abs() * gap
}

/// Whether a point lies farther than
/// `limit` off its neighbors where one or two of these, outliers themselves, are left out. Left out are those without which the others agree best. They must agree to within `agreed`.
fn without_two(near: &[[f64; 2]], point: [f64; 2], limit: f64, agreed: f64) -> bool {
    let n = near.len();
    let without = |(a, b): (usize, usize)| {
        let rest = near.iter().enumerate().filter(|(i, _)| *i != a && *i != b);
        off_parabola(&rest.map(|(_, p)| *p).collect::<Vec<_>>(), point)
    };
    let pairs = (0..n).flat_map(|a| (a..n).map(move |b| (a, b)));
    let enough = pairs.filter(|(a, b)| n - 1 - usize::from(a != b) >= 6);
    let best = enough.filter_map(without).min_by(|x, y| x.1.total_cmp(&y.1));
    best.is_some_and(|(own, rest)| own > limit && rest < agreed)
}

/// Coordinates are rounded to a step between these shares of the distance between points. A coarser one is the row's
/// own, as of pixels, and a finer one does not count.
const ROUNDING_STEP_SPACINGS: std::ops::RangeInclusive<f64> = 1e-4..=0.15;
/// A remainder of a step below this share of the distance between points is 0.
const ZERO_STEP_SPACINGS: f64 = 1e-6;

/// Standard deviation of coordinates that are all multiples of one step from each other, by Euclid's algorithm. Values
/// rounded to it lie anywhere in its width.
fn rounding(points: &[[f64; 2]], spacing: f64) -> f64 {
    let least = ZERO_STEP_SPACINGS * spacing;
    let common = |step: f64, other: f64| {
        let (mut a, mut b) = (step, other);
        while b > least {
            (a, b) = (b, (a - b * (a / b).round()).abs());
        }
        a
    };
    let mut step = 0.0;
    for w in points.windows(2) {
        for k in 0..2 {
            step = common(step, (w[1][k] - w[0][k]).abs());
        }
        if step > 0.0 && step < ROUNDING_STEP_SPACINGS.start() * spacing {
            return 0.0;
        }
    }
    if ROUNDING_STEP_SPACINGS.contains(&(step / spacing)) { step / 12.0_f64.sqrt() } else { 0.0 }
}

/// Length of the diagonal of the box around points.
pub(crate) fn size(points: &[[f64; 2]]) -> f64 {
    let range = |k: usize| {
        let (low, high) =
            points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p[k]), b.max(p[k])));
        high - low
    };
    libm::hypot(range(0), range(1))
}

/// Mean distance between neighbors, of means of five: noise makes the row itself longer.
pub(super) fn spacing(clean: &Clean, step: usize) -> f64 {
    let points: Vec<[f64; 2]> = clean.points.iter().step_by(step).copied().collect();
    let n = points.len();
    let smooth: Vec<[f64; 2]> = (0..n)
        .map(|i| {
            let k = i.min(n - 1 - i).min(2);
            let w = (2 * k + 1) as f64;
            [0, 1].map(|d| points[i - k..=i + k].iter().map(|p| p[d]).sum::<f64>() / w)
        })
        .collect();
    let length: f64 = smooth.windows(2).map(|w| libm::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1])).sum();
    (length / (n - 1) as f64 / step as f64).max(1e-3 * clean.spacing)
}

/// Checks the row before anything else.
pub(super) fn check_row(points: &[[f64; 2]], options: &Options) -> Result<(), SectionError> {
    match points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        Some(index) => Err(SectionError::NotFinite { index }),
        None => check(options),
    }
}

pub(crate) fn check(options: &Options) -> Result<(), SectionError> {
    let wrong = |name, value, allowed| Err(SectionError::WrongOption { name, value, allowed });
    if let Some(value) = options.noise.filter(|x| !(x.is_finite() && *x > 0.0)) {
        return wrong("noise", value, "a length above 0");
    }
    if let Some(value) = options.resolution.filter(|x| !(x.is_finite() && *x >= 0.0)) {
        return wrong("resolution", value, "a length, or 0");
    }
    match options.level > 0.0 && options.level < 1.0 {
        true => Ok(()),
        false => wrong("level", options.level, "between 0 and 1"),
    }
}

/// Median distance from a point to the nearest other, of up to 200 points.
fn nearest(points: &[[f64; 2]]) -> f64 {
    let stride = points.len().div_ceil(200);
    let of = |i: usize| {
        let others = points.iter().enumerate().filter(|(j, _)| *j != i);
        others
            .map(|(_, p)| (p[0] - points[i][0]).powi(2) + (p[1] - points[i][1]).powi(2))
            .fold(f64::INFINITY, f64::min)
    };
    let mut squares: Vec<f64> = (0..points.len()).step_by(stride).map(of).collect();
    median(&mut squares).unwrap_or(0.0).sqrt()
}

/// Sum of squared distances of points from the line nearest to them.
fn off_line(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let sum = |a: usize, b: usize| points.iter().map(|p| (p[a] - mean[a]) * (p[b] - mean[b])).sum::<f64>();
    let (xx, xy, yy) = (sum(0, 0), sum(0, 1), sum(1, 1));
    (0.5 * (xx + yy) - libm::hypot(0.5 * (xx - yy), xy)).max(0.0)
}

/// Distance of `point` from the parabola through `near`, across their chord, and the root mean square of theirs.
fn off_parabola(near: &[[f64; 2]], point: [f64; 2]) -> Option<(f64, f64)> {
    let (first, last) = (near.first()?, near.last()?);
    let length = distance(*first, *last);
    if near.len() < 6 || length == 0.0 {
        return None;
    }
    let (c, s) = ((last[0] - first[0]) / length, (last[1] - first[1]) / length);
    let local = |p: &[f64; 2]| {
        let (x, y) = (p[0] - point[0], p[1] - point[1]);
        ((c * x + s * y) / length, c * y - s * x)
    };
    let all: Vec<(f64, f64)> = near.iter().map(local).collect();
    let mut a = vec![vec![0.0; 3]; 3];
    let mut b = vec![0.0; 3];
    for (t, y) in &all {
        let row = [1.0, *t, t * t];
        for i in 0..3 {
            (0..3).for_each(|j| a[i][j] += row[i] * row[j]);
            b[i] += row[i] * y;
        }
    }
    let x = trueness_geom::num::dense::solve(a, b)?;
    let sum: f64 = all.iter().map(|(t, y)| (y - x[0] - x[1] * t - x[2] * t * t).powi(2)).sum();
    Some((x[0].abs(), (sum / (all.len() - 3) as f64).sqrt()))
}

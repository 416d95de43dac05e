//! Thin walls: points of two faces near each other that were put in order as one.
//!
//! Across one face points scatter by its noise about one course. Across a wall seen from both sides they lie on two
//! courses side by side. In windows along the row one parabola is fitted, and two of the same shape, one above the
//! other. Each point is on the nearer of the two. On one face, however its points scatter, the second fit leaves a
//! third of the variance (normal scatter) or a quarter (even scatter). On two faces it leaves that of the noise alone.
//! Windows at corners tell nothing and count little: there are few. Teeth, too, lie on two levels, but one after the
//! other, where points of two faces come as by chance.

use crate::model::flat::distance;
use trueness_geom::num::dense::solve;

/// Fewest points of a window.
const MIN_WINDOW_POINTS: usize = 24;
/// A window grows by so many powers of 2 at most.
const MAX_WINDOW_DOUBLINGS: u32 = 4;
/// Windows begin within this share of one.
const WINDOWS_PER_WIDTH: usize = 4;
/// Most windows are so many times as long as their points scatter: shorter ones do not tell along from across.
const MIN_WINDOW_ASPECT: f64 = 4.0;
/// Two faces leave less than this share of the variance of one.
const MAX_VARIANCE_LEFT: f64 = 1.0 / 14.0;
/// They do so in more than so large a share of the windows. Among 500 rows of one face with normal or even scatter the most was
/// 0.03 of them.
const MIN_TWO_FACED_SHARE: f64 = 0.6;
/// It is unclear from this share of windows on, and where half of them leave less than this.
const UNCLEAR_SHARE_AND_VARIANCE: (f64, f64) = (0.2, 1.0 / 6.5);
/// Points of two faces change from one to the other this share as often as by chance, at least.
const MIN_FACE_CHANGES: f64 = 0.55;
/// Rounds in which points choose the nearer face.
const FACE_ROUNDS: usize = 12;
/// Points farther off than so many standard deviations are of neither face, or of both.
const FAR_FROM_FACE_SIGMAS: f64 = 5.0;
/// No more of them than this share are left in silence.
const MAX_UNCLEAR_SHARE: f64 = 0.01;
/// A point beside a wall is of the nearer face where it lies off it by no more than this share of half the thickness.
const NEAR_FACE_SHARE: f64 = 0.5;
/// All points of a row but this share lie so near.
const MAX_FAR_SHARE: f64 = 0.1;
/// So many windows tell whether there are two faces.
const MAX_WINDOWS: usize = 2000;
/// Fewer windows tell nothing.
const MIN_WINDOWS: usize = 6;

/// Both courses of a wall, window by window.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wall {
    windows: Vec<Window>,
    noise: f64,
}

impl Wall {
    /// The face of each of other points, where nearly all lie on one.
    pub fn faces_of(&self, points: &[[f64; 2]]) -> Option<Vec<bool>> {
        let mut far = 0;
        let mut face = |p: &[f64; 2]| {
            let near = self.windows.iter().filter(|w| w.local(*p)[0].abs() <= 1.0);
            let window = near.min_by(|a, b| a.off(*p).0.total_cmp(&b.off(*p).0))?;
            let (off, upper) = window.off(*p);
            far += usize::from(off > (FAR_FROM_FACE_SIGMAS * self.noise).max(NEAR_FACE_SHARE * window.half));
            Some(upper)
        };
        let upper: Option<Vec<bool>> = points.iter().map(&mut face).collect();
        upper.filter(|_| far as f64 <= MAX_FAR_SHARE * points.len() as f64)
    }
}

/// The faces that a row runs along.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Faces {
    /// One face, as far as its points tell.
    One,
    /// Two, with the face of each place of the row, and how far they are apart where that is unclear for some.
    Two { upper: Vec<bool>, unclear: Option<f64>, wall: Wall },
    /// One that scatters, or two this far apart.
    Unclear { apart: f64 },
}

/// Two courses of one shape in a window of a row.
#[derive(Clone, Debug, PartialEq)]
struct Window {
    from: usize,
    count: usize,
    /// Middle, and direction of the row.
    middle: [f64; 2],
    along: [f64; 2],
    /// Half a length, by which the parabola's argument is scaled.
    reach: f64,
    shape: [f64; 3],
    half: f64,
    /// Share of the variance that two faces leave, and the variance.
    left: f64,
    variance: f64,
    /// Changes from face to face over those by chance.
    changes: f64,
}

impl Window {
    /// A window of points in the order of a row.
    fn of(from: usize, points: &[[f64; 2]]) -> Option<Window> {
        let n = points.len();
        let mean =
            |part: &[[f64; 2]]| [0, 1].map(|k| part.iter().map(|p| p[k]).sum::<f64>() / part.len() as f64);
        let (first, last, middle) = (mean(&points[..n / 3]), mean(&points[n - n / 3..]), mean(points));
        let reach = distance(first, last);
        let along = [(last[0] - first[0]) / reach, (last[1] - first[1]) / reach];
        let mut window = Window {
            from,
            count: n,
            middle,
            along,
            reach,
            shape: [0.0; 3],
            half: 0.0,
            left: 1.0,
            variance: 0.0,
            changes: 0.0,
        };
        if reach.is_nan() || reach <= 0.0 {
            return None;
        }
        let local: Vec<[f64; 2]> = points.iter().map(|p| window.local(*p)).collect();
        let one = fitted(&local, None)?;
        let off = |p: &[f64; 2], shape: &[f64]| p[1] - shape[0] - p[0] * (shape[1] + p[0] * shape[2]);
        let square = |value: f64| value * value;
        let single: f64 = local.iter().map(|p| square(off(p, &one))).sum();
        let mut upper: Vec<bool> = local.iter().map(|p| off(p, &one) > 0.0).collect();
        let mut two = vec![];
        for _ in 0..FACE_ROUNDS {
            two = fitted(&local, Some(&upper))?;
            let next: Vec<bool> = local.iter().map(|p| off(p, &two) > 0.0).collect();
            if next == upper {
                break;
            }
            upper = next;
        }
        let sign = |i: usize| if upper[i] { two[3] } else { -two[3] };
        let double: f64 = local.iter().enumerate().map(|(i, p)| square(off(p, &two) - sign(i))).sum();
        let above = upper.iter().filter(|u| **u).count() as f64;
        let by_chance = 2.0 * above * (n as f64 - above) / n as f64;
        let changes = upper.windows(2).filter(|w| w[0] != w[1]).count() as f64;
        window.shape = [two[0], two[1], two[2]];
        window.half = two[3].abs();
        window.variance = double / (n - 4) as f64;
        window.left = window.variance / (single / (n - 3) as f64).max(f64::MIN_POSITIVE);
        window.changes = changes / by_chance.max(f64::MIN_POSITIVE);
        (two[3] > 0.0 && above.min(n as f64 - above) >= 2.0).then_some(window)
    }

    fn local(&self, p: [f64; 2]) -> [f64; 2] {
        let d = [p[0] - self.middle[0], p[1] - self.middle[1]];
        let [c, s] = self.along;
        [(d[0] * c + d[1] * s) / self.reach, d[1] * c - d[0] * s]
    }

    /// How far a point lies above the middle of the two courses.
    fn above(&self, p: [f64; 2]) -> f64 {
        let [x, y] = self.local(p);
        y - self.shape[0] - x * (self.shape[1] + x * self.shape[2])
    }

    /// How far a point lies off the nearer course, and whether that is the upper one.
    fn off(&self, p: [f64; 2]) -> (f64, bool) {
        let above = self.above(p);
        ((above.abs() - self.half).abs(), above > 0.0)
    }

    /// How many times as long as its points scatter about one course.
    fn aspect(&self) -> f64 {
        self.reach / (self.variance / self.left).sqrt().max(f64::MIN_POSITIVE)
    }
}

/// The least-squares parabola of points, with half the distance of two where the upper ones are given.
fn fitted(points: &[[f64; 2]], upper: Option<&[bool]>) -> Option<Vec<f64>> {
    let m = if upper.is_some() { 4 } else { 3 };
    let (mut a, mut b) = (vec![vec![0.0; m]; m], vec![0.0; m]);
    for (i, [x, y]) in points.iter().enumerate() {
        let side = upper.map_or(0.0, |u| if u[i] { 1.0 } else { -1.0 });
        let row = [1.0, *x, x * x, side];
        for j in 0..m {
            (0..m).for_each(|k| a[j][k] += row[j] * row[k]);
            b[j] += row[j] * y;
        }
    }
    solve(a, b)
}

/// Whether a row of points runs along two faces at once.
pub(super) fn faces(row: &[[f64; 2]], closed: bool) -> Faces {
    let n = row.len();
    let mut all = vec![];
    for count in (0..=MAX_WINDOW_DOUBLINGS).map(|k| MIN_WINDOW_POINTS << k) {
        if n < count + count / WINDOWS_PER_WIDTH {
            break;
        }
        let windows = windows(row, closed, count, MAX_WINDOWS);
        if windows.len() < MIN_WINDOWS {
            break;
        }
        all = windows;
        if 2 * all.iter().filter(|w| w.aspect() >= MIN_WINDOW_ASPECT).count() >= all.len() {
            break;
        }
    }
    let Some(count) = all.first().map(|w| w.count) else { return Faces::One };
    let good: Vec<&Window> = all.iter().filter(|w| w.left < MAX_VARIANCE_LEFT).collect();
    let share = good.len() as f64 / all.len() as f64;
    if share >= MIN_TWO_FACED_SHARE && mixed(&good) {
        let mut windows = windows(row, closed, count, usize::MAX);
        windows.retain(|w| w.left < MAX_VARIANCE_LEFT);
        let apart = apart(&windows.iter().collect::<Vec<_>>());
        let noise = (windows.iter().map(|w| w.variance).sum::<f64>() / windows.len() as f64).sqrt();
        let (upper, off) = sides(row, closed, &windows);
        let far = off.iter().filter(|off| **off > FAR_FROM_FACE_SIGMAS * noise).count() as f64;
        let unclear = (far > MAX_UNCLEAR_SHARE * n as f64).then_some(apart);
        return Faces::Two { upper, unclear, wall: Wall { windows, noise } };
    }
    let mut lefts: Vec<f64> = all.iter().map(|w| w.left).collect();
    lefts.sort_by(f64::total_cmp);
    let every: Vec<&Window> = all.iter().collect();
    let (is_share_high, rest) =
        if share >= UNCLEAR_SHARE_AND_VARIANCE.0 { (true, &good) } else { (false, &every) };
    if (is_share_high || lefts[lefts.len() / 2] < UNCLEAR_SHARE_AND_VARIANCE.1) && mixed(rest) {
        return Faces::Unclear { apart: apart(rest) };
    }
    Faces::One
}

/// Mean distance of the courses.
fn apart(windows: &[&Window]) -> f64 {
    2.0 * windows.iter().map(|w| w.half).sum::<f64>() / windows.len() as f64
}

/// Whether points change from face to face as by chance.
fn mixed(windows: &[&Window]) -> bool {
    windows.iter().map(|w| w.changes.min(2.0)).sum::<f64>() >= MIN_FACE_CHANGES * windows.len() as f64
}

/// Windows of `count` points along a row, about `most` of them.
fn windows(row: &[[f64; 2]], closed: bool, count: usize, most: usize) -> Vec<Window> {
    let n = row.len();
    let starts = if closed { n } else { n - count + 1 };
    let points = |from: usize| (from..from + count).map(|i| row[i % n]).collect::<Vec<_>>();
    let stride = (count / WINDOWS_PER_WIDTH).max(starts / most);
    (0..starts).step_by(stride).filter_map(|i| Window::of(i, &points(i))).collect()
}

/// The face of each point, and how far it lies off that: that of the window near it whose courses it lies nearest to. Beyond its ends a window's courses lead on for as
/// long as it is: so they reach the corners, where windows tell nothing.
fn sides(row: &[[f64; 2]], closed: bool, windows: &[Window]) -> (Vec<bool>, Vec<f64>) {
    let n = row.len();
    let mut best: Vec<(f64, bool)> = vec![(f64::INFINITY, false); n];
    for window in windows {
        let (from, count) = (window.from as i64, window.count as i64);
        for i in from - count / 2..from + count + count / 2 {
            let i = match closed {
                true => i.rem_euclid(n as i64) as usize,
                false if (0..n as i64).contains(&i) => i as usize,
                false => continue,
            };
            let off = window.off(row[i]);
            if off.0 < best[i].0 {
                best[i] = off;
            }
        }
    }
    best.into_iter().map(|(off, upper)| (upper, off)).unzip()
}

#[cfg(test)]
mod tests;

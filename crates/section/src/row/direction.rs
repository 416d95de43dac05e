//! Rows are measured in one direction, whichever they are given in: a search by the likelihood may end elsewhere from the other end.

use super::clean::{DistinctPoints, GAP_SPACINGS};
use crate::model::flat::distance;
use crate::model::result::{Contour, Join, Segment};

/// Steps that differ by less than this share count as equal: rounding of a motion does not turn a row round.
const EQUAL_STEP_SHARE: f64 = 1e-9;

/// Whether a row is measured from its last point. The first pair of steps, counted from both ends, that differs tells
/// it; where none does, the coordinates do.
pub(crate) fn from_the_end(points: &[[f64; 2]]) -> bool {
    let n = points.len();
    let step = |i: usize| distance(points[i], points[i + 1]);
    let differ = |i: &usize| {
        let (a, b) = (step(*i), step(n - 2 - i));
        (a - b).abs() > EQUAL_STEP_SHARE * (a + b)
    };
    if let Some(i) = (0..n.saturating_sub(1) / 2).find(differ) {
        return step(i) < step(n - 2 - i);
    }
    let pairs = points.iter().flatten().zip(points.iter().rev().flat_map(|p| p.iter()));
    pairs.map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne()).is_some_and(std::cmp::Ordering::is_gt)
}

impl Contour {
    /// The contour of a row of so many points given the other way round.
    pub(crate) fn reversed(mut self, n: usize) -> Contour {
        let count = self.segments.len();
        let whole: f64 = self.segments.iter().map(|s| s.length).sum();
        self.segments = self.segments.into_iter().rev().map(Segment::reversed).collect();
        self.joins = self.joins.into_iter().rev().map(Join::reversed).collect();
        if self.closed && count > 0 && self.joins.len() == count {
            // The join over the seam is the last.
            self.joins.rotate_left(1);
        }
        let other = |l: u32| (count - 1) as u32 - l;
        self.labels = self.labels.into_iter().rev().map(other).collect();
        self.unreliable = self.unreliable.into_iter().rev().map(|s| count - 1 - s).collect();
        self.residuals = self.residuals.into_iter().rev().map(|r| 0.0 - r).collect();
        self.stations = self.stations.into_iter().rev().map(|s| whole - s).collect();
        self.moved.reverse();
        for list in self.lists_of_points() {
            list.iter_mut().for_each(|i| *i = n - 1 - *i);
            list.reverse();
        }
        // A gap is known by the point before it.
        self.gaps.iter_mut().for_each(|i| *i = (2 * n - 2 - *i) % n);
        self.gaps.sort_unstable();
        if let Some(first) = self.labels.first().filter(|_| self.closed) {
            self.begin_with(*first as usize);
        }
        self
    }

    fn lists_of_points(&mut self) -> [&mut Vec<usize>; 5] {
        [&mut self.outliers, &mut self.bevels, &mut self.repeated, &mut self.doubtful, &mut self.straight_on]
    }

    /// The contour of the row `points`, found from its last point, as from its first.
    pub(crate) fn turned_round(self, points: &[[f64; 2]]) -> Contour {
        let passed = DistinctPoints::of(points, !self.closed);
        let mut all = self.reversed(points.len());
        // The first of points at the same place stands for all.
        let first = |i: usize| {
            let of_the_end = passed.ends_meet.is_some_and(|from| i >= from);
            let before = (0..=i).rev().find(|k| *k == 0 || points[*k - 1] != points[i]);
            if of_the_end { 0 } else { before.unwrap_or(i) }
        };
        all.outliers.iter_mut().for_each(|i| *i = first(*i));
        all.outliers.sort_unstable();
        all.gaps = passed.gaps(points);
        all.repeated = passed.repeated;
        all
    }

    /// The contour of a closed row that begins so many points later.
    pub(crate) fn begun_later(mut self, by: usize) -> Contour {
        let n = self.labels.len();
        self.labels.rotate_left(by);
        self.residuals.rotate_left(by);
        self.stations.rotate_left(by);
        let moved = by.min(self.moved.len());
        self.moved.rotate_left(moved);
        for list in self.lists_of_points() {
            list.iter_mut().for_each(|i| *i = (*i + n - by) % n);
            list.sort_unstable();
        }
        self.gaps.iter_mut().for_each(|i| *i = (*i + n - by) % n);
        self.gaps.sort_unstable();
        if let Some(first) = self.labels.first() {
            self.begin_with(*first as usize);
        }
        self
    }

    /// Passes over wide steps that do not lead on along the contour, and those to outliers: these and scatter leave no gap.
    pub(crate) fn keep_gaps(&mut self, points: &[[f64; 2]]) {
        /// Share of a step that leads on along the contour where it is a gap.
        const MIN_ONWARD_SHARE: f64 = 0.5;
        if !self.unreliable.is_empty() {
            return;
        }
        let whole = self.length();
        let passed_over = |list: &[usize], i: &usize| list.binary_search(i).is_ok();
        let counts = |i: &usize| !passed_over(&self.repeated, i) && !passed_over(&self.outliers, i);
        let point_before = |gap: &usize| {
            let before = (0..=*gap).rev().find(counts)?;
            let next = (gap + 1..points.len()).find(counts)?;
            let along = (self.stations[next] - self.stations[before]).abs();
            let along = if self.closed { along.min(whole - along) } else { along };
            let step = distance(points[before], points[next]);
            (step > GAP_SPACINGS * self.spacing && along >= MIN_ONWARD_SHARE * step).then_some(before)
        };
        let mut kept: Vec<usize> = self.gaps.iter().filter_map(point_before).collect();
        kept.dedup();
        self.gaps = kept;
    }

    /// Lets a closed contour begin with this segment.
    pub(crate) fn begin_with(&mut self, first: usize) {
        let count = self.segments.len();
        if count < 2 {
            return;
        }
        let before: f64 = self.segments[..first].iter().map(|s| s.length).sum();
        let whole: f64 = self.segments.iter().map(|s| s.length).sum();
        self.segments.rotate_left(first);
        let joins = self.joins.len();
        self.joins.rotate_left(first.min(joins));
        self.labels.iter_mut().for_each(|l| *l = ((*l as usize + count - first) % count) as u32);
        self.unreliable.iter_mut().for_each(|s| *s = (*s + count - first) % count);
        self.unreliable.sort_unstable();
        self.stations.iter_mut().for_each(|s| *s = (*s - before).rem_euclid(whole));
    }
}

impl Join {
    fn reversed(self) -> Join {
        let ([a, b], [first, last]) = (self.interval, self.open);
        Join { interval: [b, a], open: [last, first], turn: 0.0 - self.turn, ..self }
    }
}

//! The contour of a row, put together from the chains between its corners.

use super::clean::Clean;
use super::convert::Parts;
use crate::model::prior::NEGLIGIBLE_OFFSET_SPACINGS;
use crate::model::result::{Contour, Segment};
use crate::search::span::Found;

/// A free piece whose points leave so many spans of its curvature after another without one may run anywhere there.
const MAX_EMPTY_SPANS: f64 = 3.0;

/// A contour while it is put together.
#[derive(Default)]
pub(super) struct Joined {
    pub(super) contour: Contour,
    length: f64,
}

impl Joined {
    /// One that is put together.
    pub(super) fn of(contour: Contour) -> Joined {
        Joined { contour, length: 0.0 }
    }

    pub(super) fn add(&mut self, found: &Found, parts: Parts, total: usize) {
        let contour = &mut self.contour;
        contour.labels.resize(total, 0);
        contour.residuals.resize(total, 0.0);
        contour.stations.resize(total, 0.0);
        let first = contour.segments.len();
        let n = found.span.points.len();
        for g in 0..found.pieces().len() {
            for i in found.state.breaks[g]..found.state.breaks[g + 1] {
                let number = found.span.numbers[i % n];
                contour.labels[number] = (first + g) as u32;
                contour.residuals[number] = found.residuals[i % n];
                contour.stations[number] = self.length + parts.stations[i % n];
            }
        }
        let is_unreliable_segment = |(k, s): &(usize, &Segment)| {
            found.unreliable
                || s.is_overlong()
                || found.pieces()[*k].is_loose(s.count)
                || found.widest(*k) > MAX_EMPTY_SPANS
        };
        let unreliable = parts.segments.iter().enumerate().filter(is_unreliable_segment);
        contour.unreliable.extend(unreliable.map(|(k, _)| first + k));
        self.length += parts.length;
        contour.segments.extend(parts.segments);
        contour.joins.extend(parts.joins);
    }

    /// Lines and arcs are unreliable, too, that pass their points by, because a corner at an end does not lie on them.
    /// So are those that end long before their points do.
    pub(super) fn misdrawn(&mut self, points: &[[f64; 2]], weights: &[f64], step: usize) {
        /// So many standard deviations of the noise beyond the farthest of its points from the line or arc found.
        const MAX_DRAWN_OFFSET_SIGMAS: f64 = 3.0;
        /// So many distances between points, and standard deviations, beyond an end of a line or arc.
        const MAX_DRAWN_OVERSHOOT_SPACINGS: f64 = 8.0;
        let contour = &mut self.contour;
        let mut off = vec![[0.0f64; 2]; contour.segments.len()];
        for ((p, label), _) in points.iter().zip(&contour.labels).zip(weights).filter(|(_, w)| **w > 0.0) {
            let (off, segment) = (&mut off[*label as usize], &contour.segments[*label as usize]);
            *off = [off[0].max(segment.off_drawn(*p)), off[1].max(segment.ahead_of_drawn(*p))];
        }
        let most = MAX_DRAWN_OVERSHOOT_SPACINGS * (contour.spacing * step as f64 + contour.noise);
        let far = |(k, [off, ahead]): &(usize, [f64; 2])| {
            *off > contour.segments[*k].max + MAX_DRAWN_OFFSET_SIGMAS * contour.noise || *ahead > most
        };
        let unreliable = off.into_iter().enumerate().filter(far).map(|(k, _)| k).collect();
        self.mark_unreliable(unreliable);
    }

    /// Segments that leave their points for a while, mostly at an end, are unreliable too. Points after another that
    /// tell as much as so many independent ones lie farther off to one side in the mean. They do so by more than so
    /// many standard deviations of the noise, as chance makes one run of 10^15.
    pub(super) fn leaving(&mut self, weights: &[f64]) {
        /// Weight of a run of points: that of so many independent ones.
        const LEAVING_RUN_WEIGHT: f64 = 4.0;
        /// So many standard deviations of the noise, which chance gives one run of 10^15.
        const LEAVING_RUN_SIGMAS: f64 = 4.0;
        let contour = &self.contour;
        let most = LEAVING_RUN_SIGMAS
            * contour.noise.max(NEGLIGIBLE_OFFSET_SPACINGS * contour.spacing / LEAVING_RUN_SIGMAS);
        let mut unreliable = vec![];
        // The sums over the window that ends before a point; windows lie in one segment.
        let (mut first, mut weight, mut sum) = (0, 0.0, 0.0);
        for i in 0..weights.len() {
            if contour.labels[i] != contour.labels[first] {
                (first, weight, sum) = (i, 0.0, 0.0);
            }
            weight += weights[i];
            sum += weights[i] * contour.residuals[i];
            while weight - weights[first] >= LEAVING_RUN_WEIGHT {
                weight -= weights[first];
                sum -= weights[first] * contour.residuals[first];
                first += 1;
            }
            if weight >= LEAVING_RUN_WEIGHT && sum.abs() > most * weight {
                unreliable.push(contour.labels[i] as usize);
            }
        }
        self.mark_unreliable(unreliable);
    }

    /// These segments are unreliable too.
    pub(super) fn mark_unreliable(&mut self, segments: Vec<usize>) {
        let all = &mut self.contour.unreliable;
        all.extend(segments);
        all.sort_unstable();
        all.dedup();
    }

    /// Back to the numbers and places of the row given.
    pub(super) fn finish(&mut self, clean: &Clean, turned: usize, total: usize, outliers: Vec<usize>) {
        let contour = &mut self.contour;
        let n = clean.points.len();
        let number = |i: usize| clean.numbers[(i + turned) % n];
        let mut labels = vec![0; total];
        let mut residuals = vec![0.0; total];
        let mut stations = vec![0.0; total];
        let mut known = vec![false; total];
        for i in 0..n {
            let k = number(i);
            (labels[k], residuals[k], stations[k]) =
                (contour.labels[i], contour.residuals[i], contour.stations[i]);
            known[k] = true;
        }
        // A repeated point is where the one it repeats is: before it, or at the start.
        for k in 0..total {
            if !known[k] {
                let at_start = k == 0 || clean.ends_meet.is_some_and(|from| k >= from);
                let like = if at_start { clean.numbers[0] } else { k - 1 };
                (labels[k], residuals[k], stations[k]) = (labels[like], residuals[like], stations[like]);
            }
        }
        (contour.labels, contour.residuals, contour.stations) = (labels, residuals, stations);
        if clean.closed {
            contour.begin_with(contour.labels[clean.numbers[0]] as usize);
        }
        // Outliers were found before the row was turned.
        contour.outliers = outliers.into_iter().map(|i| clean.numbers[i]).collect();
        (contour.repeated, contour.gaps) = (clean.repeated.clone(), clean.gaps.clone());
        contour.shift(clean.middle);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run of points to one side of a segment is no chance. A single one farther off may be, and points on either
    /// side are.
    #[test]
    fn segments_that_leave_their_points_are_unreliable() {
        let row = |off: &[f64]| {
            let mut all = Joined::default();
            let residuals: Vec<f64> = (0..40).map(|i| if i % 2 == 0 { 0.01 } else { -0.01 }).collect();
            all.contour.labels = (0..40).map(|i| u32::from(i >= 20)).collect();
            (all.contour.noise, all.contour.spacing, all.contour.residuals) = (0.01, 0.5, residuals);
            all.contour.residuals[16..16 + off.len()].copy_from_slice(off);
            all.leaving(&[1.0; 40]);
            all.contour.unreliable
        };
        assert_eq!(row(&[0.05, 0.045, 0.05, 0.055]), [0]);
        assert_eq!(row(&[-0.05, -0.045, -0.05, -0.055]), [0]);
        assert_eq!(row(&[0.05, -0.05, 0.05, -0.05]), [0; 0]);
        assert_eq!(row(&[0.01, 0.11, 0.02, 0.01]), [0; 0]);
        // Neither of two segments leaves its points for so long.
        assert_eq!(row(&[0.01, -0.01, 0.05, 0.05, 0.05, 0.05]), [0; 0]);
        assert_eq!(row(&[0.03; 8]), [0; 0]);
        // Points that share noise leave it together by chance: four that count as one are no more than one.
        let residuals = (0..40).map(|i| if (20..24).contains(&i) { 0.05 } else { 0.0 }).collect();
        let (labels, noise) = (vec![0; 40], 0.01);
        let mut all = Joined::of(Contour { labels, residuals, noise, spacing: 0.5, ..Contour::default() });
        all.leaving(&[0.25; 40]);
        assert!(all.contour.unreliable.is_empty());
        all.leaving(&[1.0; 40]);
        assert_eq!(all.contour.unreliable, [0]);
    }
}

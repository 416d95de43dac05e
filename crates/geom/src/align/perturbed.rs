//! The least greatest distance among the ends of local searches from several poses near each other.
//!
//! Beside an edge the nearest place of a point changes from one face to the other, and its distance is the lesser of two. A
//! search by linear programs ends where it can fall no further on the faces at hand. It might fall on with a point on the other
//! face. So the search is begun again from poses beside its end, with the points that stick out most, and goes on where these
//! end lower.

use super::AlignError;
use super::counting::unsettled;
use crate::num::random::Random;
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Aabb, Point, plus, times};
use crate::zone::datum::Freedom;
use crate::zone::motion::{Distance, Placed, Search, placed_from, placed_within};

/// Poses tried in a round.
const POSES_PER_ROUND: usize = 9;
/// Distances of these poses from the best one, in turn, as shares of the greatest distance that counts.
const POSE_OFFSET_SHARES: [f64; 3] = [0.3, 1.0, 2.0];
/// Most rounds; the last is the first that finds nothing lower.
const MAX_POSE_ROUNDS: usize = 4;
/// Points that stick out most, over which poses are tried.
const MAX_FARTHEST_POINTS: usize = 500;
/// Poses that end lowest over these points; they are tried over all points.
const MAX_LOWEST_ENDS: usize = 2;
/// Share of the greatest distance by which a pose must be lower to count as lower.
const MIN_FALL_SHARE: f64 = 1e-9;

/// The search: `distance` and `room` as for [`placed_within`].
pub(super) struct Searched<'a> {
    pub points: &'a [Point],
    pub distance: &'a Distance<'a>,
    pub room: &'a [f64],
    pub seed: u64,
}

/// The excess of the points at a pose.
struct Far {
    /// The points that stick out most, by their numbers.
    farthest: Vec<usize>,
    /// The greatest excess.
    excess: f64,
    /// The greatest distance, whatever its room.
    greatest: f64,
}

impl Searched<'_> {
    /// The lowest pose near `start`, no higher than that: takes the points to where their distances are told.
    pub fn lowest(&self, start: Rigid, progress: &dyn Progress) -> Result<Placed, AlignError> {
        let mut far = self.farthest_at(&start)?;
        let mut best = self.ended(start, &far.farthest, Freedom::ALL, progress)?;
        if best.half > far.excess {
            best = self.ended(start, &[], Freedom::NONE, progress)?;
        }
        for round in 0..MAX_POSE_ROUNDS as u64 {
            far = self.farthest_at(&best.motion)?;
            let low = best.half - MIN_FALL_SHARE * far.greatest;
            let mut ends = self.tried(&far, &best.motion, round, progress);
            ends.retain(|end| end.half < low);
            ends.sort_by(|a, b| a.half.total_cmp(&b.half));
            for end in ends.iter().take(MAX_LOWEST_ENDS) {
                let end = self.ended(end.motion, &far.farthest, Freedom::ALL, progress)?;
                if end.half < best.half {
                    best = end;
                }
            }
            if best.half >= low {
                break;
            }
        }
        Ok(best)
    }

    fn ended(
        &self,
        start: Rigid,
        first: &[usize],
        free: Freedom,
        progress: &dyn Progress,
    ) -> Result<Placed, AlignError> {
        let search = Search { free, ..from(start) };
        placed_from(self.points, self.distance, self.room, first, &search, progress).map_err(unsettled)
    }

    /// The points that stick out most at a pose.
    fn farthest_at(&self, motion: &Rigid) -> Result<Far, AlignError> {
        let far = |(i, p): (usize, &Point)| Some((self.distance)(i, motion.point(*p))?.0.abs());
        let far: Option<Vec<f64>> = self.points.par_iter().enumerate().map(far).collect();
        let far = far.ok_or(AlignError::NotSettled)?;
        let excess = |i: &usize| far[*i] - self.room.get(*i).copied().unwrap_or(0.0);
        let mut farthest: Vec<usize> = (0..far.len()).collect();
        farthest.sort_unstable_by(|i, j| excess(j).total_cmp(&excess(i)).then(i.cmp(j)));
        farthest.truncate(MAX_FARTHEST_POINTS);
        let most = farthest.first().map_or(f64::NEG_INFINITY, excess);
        Ok(Far { excess: most, farthest, greatest: far.into_iter().fold(0.0, f64::max) })
    }

    /// Where searches over `farthest` points end that begin beside a pose.
    fn tried(&self, far: &Far, pose: &Rigid, round: u64, progress: &dyn Progress) -> Vec<Placed> {
        let farthest = &far.farthest;
        let points: Vec<Point> = farthest.iter().map(|&i| self.points[i]).collect();
        let room: Vec<f64> = farthest.iter().filter_map(|&i| self.room.get(i).copied()).collect();
        let distance = |k: usize, p: Point| (self.distance)(farthest[k], p);
        let moved: Vec<Point> = self.points.iter().map(|p| pose.point(*p)).collect();
        let bounds = Aabb::of(&moved);
        let middle = times(0.5, plus(bounds.min, bounds.max));
        let radius = (0.5 * bounds.diagonal()).max(f64::MIN_POSITIVE);
        let one = |k: usize| {
            let mut random = Random::stream(self.seed, round * POSES_PER_ROUND as u64 + k as u64);
            let size = POSE_OFFSET_SHARES[k % POSE_OFFSET_SHARES.len()] * far.greatest;
            let mut random_vector =
                |size: f64| -> Point { std::array::from_fn(|_| size * (2.0 * random.unit() - 1.0)) };
            let turned = Rigid::rotation_about(middle, random_vector(size / radius));
            let start = Rigid::translation_by(random_vector(size)).after(&turned).after(pose);
            placed_within(&points, &distance, &room, &from(start), progress).ok()
        };
        let ends: Vec<Option<Placed>> = (0..POSES_PER_ROUND).into_par_iter().map(one).collect();
        ends.into_iter().flatten().collect()
    }
}

fn from(start: Rigid) -> Search {
    Search { start, free: Freedom::ALL, middle: 0.0, floating: false, outer: false }
}

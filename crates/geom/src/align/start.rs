//! Where to start: poses from all that could tell, tried by the hundred thousand on a grid, the best of them refined.

use super::features::{Oriented, PairFrame, PairTable};
use super::field::{Field, SAMPLES_PER_BLOCK, SampleBlock};
use super::icp::Problem;
use super::sample::{Moments, Samples, area, on_surface};
use super::{AlignError, Target};
use crate::num::random::Random;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::rigid::Rigid;
use crate::space::{Aabb, Point, Vector, cross, dot, minus, norm, plus, times};
use std::sync::Arc;

/// Places on the reference whose pairs are known.
const REFERENCE_PLACES: usize = 900;
/// Samples of the measured surface that a pose is tried on: first few, then all.
const SAMPLES_PER_STAGE: [usize; 3] = [24, 96, 400];
/// Share of the samples' score that a pose must have to be tried further.
const MIN_STAGE_SCORE: [f64; 2] = [0.25, 0.35];
/// Pairs of the measured surface that are looked up.
const MAX_LOOKUP_PAIRS: usize = 4000;
/// Poses tried of the rarest pairs, and as many of others.
const MAX_POSES: usize = 60_000;
/// Counterparts tried of each pair.
const MAX_COUNTERPARTS: usize = 300;
/// Pairs of either kind that are tried before it is asked whether they are enough.
const PAIRS_PER_ROUND: usize = 16;
/// Pairs that must lead to one pose to be enough.
const MIN_AGREEING_PAIRS: usize = 20;
/// Score that this pose must have.
const MIN_AGREED_SCORE: f64 = 0.7;
/// Share of the best score that others must have to be refined.
const MIN_REFINED_SCORE: f64 = 0.5;
/// Starts that are refined.
const MAX_REFINED_STARTS: usize = 32;
/// Starts whose refined pose is looked at closely.
const MAX_CLOSE_STARTS: usize = 12;
/// Steps after which starts with too low a score are dropped. A few steps take away the error of the pair of places, and with
/// it most of what a right start lacks.
const FIRST_START_STEPS: usize = 3;
/// Share of the best score there that a start must have to be refined further.
const MIN_LIVELY_SCORE: f64 = 0.7;
/// Share of the spacing within which places count where poses close together are told apart.
const APART_REACH_SPACINGS: f64 = 0.5;
/// Share of the spacing that the first steps take for zero: ten standard deviations are half a spacing then.
const START_ROUNDING_SPACINGS: f64 = 0.05 / 16.0;
/// Cost over that of the present pose up to which another may be the better one: the samples are few.
const MAX_RIVAL_COST_RATIO: f64 = 1.1;
/// Share of the spacing from which on poses are not the same.
const OTHER_POSE_SPACINGS: f64 = 0.05;

/// The search for a start.
pub(super) struct Search {
    /// A few hundred samples with normals, in random order.
    pub samples: Samples,
    /// The same about their mean, for trying.
    blocks: Vec<SampleBlock>,
    bounds: Aabb,
    known: Arc<Known>,
    /// Mean distance of neighbors among the places of the reference.
    pub spacing: f64,
    measured: Moments,
    seed: u64,
    /// Whether the search may end early. Where its result then does not lie on the reference as a whole, the search is made
    /// again in full.
    brief: bool,
}

/// The known facts about the reference.
struct Known {
    field: Field,
    table: PairTable,
    moments: Moments,
}

/// A pose and its score, from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub pose: Rigid,
    pub score: f64,
}

impl Search {
    /// Prepares the reference.
    pub fn new(
        target: &Target,
        samples: Samples,
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<Search, AlignError> {
        let bounds = target.bounds;
        let reference = on_surface(target.mesh, REFERENCE_PLACES, seed);
        let spacing = (area(target.mesh) / REFERENCE_PLACES as f64).sqrt().max(1e-3 * bounds.diagonal());
        let reach = 1.2 * spacing;
        let field = Field::new(target.tree, &bounds, reach, progress)?;
        let table = PairTable::new(&reference, spacing, 2.0 * spacing);
        let known = Arc::new(Known { field, table, moments: reference.moments() });
        Ok(Search::of(samples, bounds, known, spacing, seed, true))
    }

    fn of(samples: Samples, bounds: Aabb, known: Arc<Known>, spacing: f64, seed: u64, brief: bool) -> Search {
        let measured = samples.moments();
        let blocks = SampleBlock::of(&samples, measured.mean);
        Search { samples, blocks, bounds, known, spacing, measured, seed, brief }
    }

    /// Turns the normals of the samples round.
    pub fn turn(&mut self) {
        self.samples = self.samples.turned();
        self.blocks = SampleBlock::of(&self.samples, self.measured.mean);
    }

    /// The mean of the surface of the reference.
    pub fn reference_mean(&self) -> Point {
        self.known.moments.mean
    }

    /// The same seen in the mirrors across the principal axes of the reference. Where the reference is its own mirror image,
    /// these mirrors relate a pose of a mirrored part to one of the part.
    pub fn in_mirrors(&self, pose: &Rigid) -> Vec<Rigid> {
        let Moments { mean, axes, .. } = &self.known.moments;
        let seen = |axis: &Vector| {
            // x was reversed before: both together are a motion.
            let rows = pose.rotation().map(|[x, y, z]| [-x, y, z]);
            let across = |v: Vector| minus(v, times(2.0 * dot(v, *axis), *axis));
            let columns: [Vector; 3] = std::array::from_fn(|c| across([rows[0][c], rows[1][c], rows[2][c]]));
            let rows = std::array::from_fn(|r| [columns[0][r], columns[1][r], columns[2][r]]);
            let zero = plus(*mean, across(minus(pose.point([0.0; 3]), *mean)));
            Rigid::of_rotation(rows, [0.0; 3], zero)
        };
        axes.iter().map(seen).collect()
    }

    /// Root mean square radius of the measured over that of the reference.
    pub fn size_ratio(&self) -> f64 {
        self.measured.radius() / self.known.moments.radius()
    }

    /// The same for samples `factor` times as large.
    pub fn scaled(&self, factor: f64) -> Search {
        self.again(self.samples.scaled(factor), self.seed)
    }

    /// The same for other samples and random choices, in full.
    pub fn again(&self, samples: Samples, seed: u64) -> Search {
        Search::of(samples, self.bounds, self.known.clone(), self.spacing, seed, false)
    }

    /// The best poses, best first: no two nearly the same.
    pub fn candidates(
        &self,
        known_poses: &[Rigid],
        progress: &dyn Progress,
    ) -> Result<Vec<Candidate>, AlignError> {
        let mut all: Vec<Rigid> = known_poses.to_vec();
        all.extend(self.of_axes());
        let mut found: Vec<Candidate> =
            all.iter().map(|&pose| Candidate { pose, score: self.score(&pose) }).collect();
        found.extend(self.of_pairs(progress)?);
        Ok(self.distinct(found))
    }

    /// Middle on middle, axes along axes in all ways: 24 for the sides of a box.
    fn of_axes(&self) -> Vec<Rigid> {
        let (from, to) = (&self.measured, &self.known.moments);
        let quarter = |rows: [Vector; 3]| {
            let rotated = std::array::from_fn(|r| {
                (0..3).fold([0.0; 3], |s: Vector, k| {
                    std::array::from_fn(|c| {
                        s[c] + to.axes[k][r] * (0..3).map(|j| rows[k][j] * from.axes[j][c]).sum::<f64>()
                    })
                })
            });
            Rigid::of_rotation(rotated, from.mean, to.mean)
        };
        cube_rotations().into_iter().map(quarter).collect()
    }

    /// By pairs of samples that lie to each other as pairs of the reference do.
    fn of_pairs(&self, progress: &dyn Progress) -> Result<Vec<Candidate>, AlignError> {
        let random = &mut Random::stream(self.seed, 1);
        let size = self.bounds.diagonal().min(Aabb::of(&self.samples.points).diagonal());
        let all: Vec<Oriented> =
            self.samples.points.iter().copied().zip(self.samples.normals.iter().copied()).collect();
        let mut pairs = vec![];
        for _ in 0..8 * MAX_LOOKUP_PAIRS {
            let [i, j] = [(); 2].map(|()| random.below(all.len() as u64) as usize);
            let length = norm(minus(all[j].0, all[i].0));
            if pairs.len() < MAX_LOOKUP_PAIRS && length >= 0.25 * size && length <= 0.9 * size {
                pairs.push((i, j));
            }
        }
        // Normals without a side may point either way.
        let signs: &[[f64; 2]] = match self.samples.oriented {
            true => &[[1.0, 1.0]],
            false => &[[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]],
        };
        let facing = |(i, j): (usize, usize), s: &[f64; 2]| {
            let of = |k: usize, s: f64| (all[k].0, times(s, all[k].1));
            (of(i, s[0]), of(j, s[1]))
        };
        let mut rare: Vec<(usize, usize)> = (pairs.par_iter().enumerate())
            .map(|(k, &pair)| {
                let like = |s: &[f64; 2]| {
                    let (a, b) = facing(pair, s);
                    self.known.table.count_like(a, b)
                };
                (signs.iter().map(like).sum(), k)
            })
            .collect();
        rare.retain(|r| r.0 > 0);
        rare.sort_unstable();
        // The rarest tell most. Pairs that belong to no part are rare too: as many poses more come from pairs as they were
        // drawn.
        let poses = |pairs: &[(usize, usize)]| {
            let mut left = MAX_POSES;
            let fits = |r: &&(usize, usize)| {
                let cost = r.0.min(MAX_COUNTERPARTS * signs.len());
                left.checked_sub(cost).inspect(|l| left = *l).is_some()
            };
            pairs.iter().take_while(fits).count()
        };
        let rarest = poses(&rare);
        rare[rarest..].sort_unstable_by_key(|r| r.1);
        let drawn = poses(&rare[rarest..]);
        rare.truncate(rarest + drawn);
        let (rarest, drawn) = rare.split_at(rarest);
        let best = |&(_, k): &(usize, usize)| -> Vec<Candidate> {
            let of_sign = |s: &[f64; 2]| {
                let (a, b) = facing(pairs[k], s);
                self.best_of_pair(a, b)
            };
            signs.iter().flat_map(of_sign).collect()
        };
        let mut found: Vec<Vec<Candidate>> = vec![];
        for round in 0..rarest.len().max(drawn.len()).div_ceil(PAIRS_PER_ROUND) {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            let part = |all: &[(usize, usize)]| {
                let ends = [round, round + 1].map(|r| (r * PAIRS_PER_ROUND).min(all.len()));
                all[ends[0]..ends[1]].to_vec()
            };
            let pairs = [part(rarest), part(drawn)].concat();
            found.extend(pairs.par_iter().map(best).collect::<Vec<_>>());
            if self.brief && self.agreed(&found) {
                break;
            }
        }
        Ok(found.into_iter().flatten().collect())
    }

    /// Whether most samples lie on the reference at the best pose, and so many pairs lead there.
    fn agreed(&self, found: &[Vec<Candidate>]) -> bool {
        let all = found.iter().flatten();
        let Some(best) = all.max_by(|a, b| a.score.total_cmp(&b.score)) else { return false };
        let there = |pair: &&Vec<Candidate>| {
            pair.iter().any(|c| self.apart(&c.pose, &best.pose) < 2.0 * self.spacing)
        };
        best.score >= MIN_AGREED_SCORE
            && found.iter().filter(there).take(MIN_AGREEING_PAIRS).count() == MIN_AGREEING_PAIRS
    }

    /// The two best poses that lay this pair on one of the reference.
    fn best_of_pair(&self, a: Oriented, b: Oriented) -> Vec<Candidate> {
        let Some(frame) = PairFrame::best(a, b) else { return vec![] };
        let like = self.known.table.like(a, b);
        let every = like.len().div_ceil(MAX_COUNTERPARTS).max(1);
        let mut best: Vec<Candidate> = vec![];
        for &pair in like.iter().step_by(every) {
            let Some(pose) = self.known.table.pose(&frame, pair) else { continue };
            let score = self.score(&pose);
            if score > 0.0 && best.get(1).is_none_or(|b| score > b.score) {
                best.push(Candidate { pose, score });
                best.sort_by(|x, y| y.score.total_cmp(&x.score));
                best.truncate(2);
            }
        }
        best
    }

    /// Mean score of the samples at a pose; 0 as soon as it is clearly poor.
    pub fn score(&self, pose: &Rigid) -> f64 {
        let field = &self.known.field;
        let placed = field.placed(pose, self.measured.mean);
        let (mut sum, mut done) = (0.0, 0);
        for (stage, &until) in SAMPLES_PER_STAGE.iter().enumerate() {
            let until = until.min(self.samples.points.len());
            let blocks = &self.blocks[done / SAMPLES_PER_BLOCK..until.div_ceil(SAMPLES_PER_BLOCK)];
            sum += field.score(&placed, blocks, field.reach);
            done = until;
            if stage < 2 && sum < MIN_STAGE_SCORE[stage] * done as f64 {
                return 0.0;
            }
        }
        sum / done as f64
    }

    /// The best of each heap of nearly equal poses, best first.
    fn distinct(&self, mut all: Vec<Candidate>) -> Vec<Candidate> {
        all.sort_by(|x, y| y.score.total_cmp(&x.score));
        let mut kept: Vec<Candidate> = vec![];
        for c in all {
            let enough = kept.first().is_none_or(|best| c.score >= MIN_REFINED_SCORE * best.score);
            if enough
                && kept.len() < MAX_REFINED_STARTS
                && !kept.iter().any(|k| self.apart(&k.pose, &c.pose) < 2.0 * self.spacing)
            {
                kept.push(c);
            }
        }
        kept
    }

    /// How far two poses lay the measured points apart, root mean square.
    pub fn apart(&self, a: &Rigid, b: &Rigid) -> f64 {
        let m = &self.measured;
        let ends = (0..3).map(|k| {
            let p = std::array::from_fn(|i| m.mean[i] + m.variances[k].max(0.0).sqrt() * m.axes[k][i]);
            let d = minus(minus(a.point(p), a.point(m.mean)), minus(b.point(p), b.point(m.mean)));
            dot(d, d)
        });
        let d = minus(a.point(m.mean), b.point(m.mean));
        (dot(d, d) + ends.sum::<f64>()).sqrt()
    }

    /// Refines the candidates on the samples and sorts them anew by what is left, least first: pose and capped mean square
    /// distance. Candidates with a score far below that of the best of them, or than `known`, are left out.
    pub fn refine(
        &self,
        candidates: &[Candidate],
        known: f64,
        problem: &Problem,
        progress: &dyn Progress,
    ) -> Result<Vec<(f64, Rigid)>, AlignError> {
        let cap = 0.5 * self.spacing;
        let begun: Result<Vec<Candidate>, AlignError> = (candidates.par_iter())
            .map(|c| {
                let pose = problem.run(c.pose, 2.0 * self.spacing, FIRST_START_STEPS, progress)?.pose;
                Ok(Candidate { pose, score: self.score(&pose) })
            })
            .collect();
        let mut begun = begun?;
        let enough = MIN_LIVELY_SCORE * begun.iter().fold(known, |m, c| m.max(c.score));
        begun.retain(|c| c.score >= enough);
        let refined: Result<Vec<(f64, Rigid)>, AlignError> = (begun.par_iter())
            .map(|c| {
                let pose = problem.run(c.pose, 2.0 * self.spacing, 12 - FIRST_START_STEPS, progress)?.pose;
                Ok((problem.cost(&pose, cap, progress)?, pose))
            })
            .collect();
        let mut refined = refined?;
        refined.sort_by(|x, y| x.0.total_cmp(&y.0));
        let mut kept: Vec<(f64, Rigid)> = vec![];
        for (cost, pose) in refined {
            if kept.len() < MAX_CLOSE_STARTS && !kept.iter().any(|k| self.apart(&k.1, &pose) < self.spacing) {
                kept.push((cost, pose));
            }
        }
        Ok(kept)
    }

    /// The refined poses, out of many, that are other than `own` and not clearly worse, best first; they may lie close
    /// together. No distance counts for more than `cap`.
    pub fn nearest_of(
        &self,
        poses: &[Rigid],
        own: &Rigid,
        problem: &Problem,
        cap: f64,
        progress: &dyn Progress,
    ) -> Result<Vec<Rigid>, AlignError> {
        let reach = APART_REACH_SPACINGS * self.spacing;
        let mut tried: Vec<(f64, Rigid)> =
            poses.par_iter().map(|p| (self.score_within(p, reach), *p)).collect();
        tried.sort_by(|x, y| y.0.total_cmp(&x.0));
        tried.truncate(MAX_REFINED_STARTS);
        let wide = self.wide(problem);
        let refined: Result<Vec<(f64, Rigid)>, AlignError> = (tried.par_iter())
            .map(|(_, pose)| {
                let pose = wide.run(*pose, self.spacing, 8, progress)?.pose;
                let pose = problem.run(pose, self.spacing, 8, progress)?.pose;
                Ok((problem.cost(&pose, cap, progress)?, pose))
            })
            .collect();
        let mut refined = refined?;
        refined.sort_by(|x, y| x.0.total_cmp(&y.0));
        let most = MAX_RIVAL_COST_RATIO * problem.cost(own, cap, progress)?;
        let other = |a: &Rigid, b: &Rigid| self.apart(a, b) > OTHER_POSE_SPACINGS * self.spacing;
        let mut kept: Vec<Rigid> = vec![];
        for (_, pose) in refined.into_iter().filter(|r| r.0 <= most && other(&r.1, own)) {
            if kept.len() < MAX_CLOSE_STARTS / 2 && kept.iter().all(|k| other(k, &pose)) {
                kept.push(pose);
            }
        }
        Ok(kept)
    }

    /// The same where what is some way off counts as well: as outliers it would draw nothing.
    pub fn wide<'a>(&self, problem: &Problem<'a>) -> Problem<'a> {
        Problem { rounding: problem.rounding.max(START_ROUNDING_SPACINGS * self.spacing), ..*problem }
    }

    /// Mean score of all samples at a pose, within a reach of its own.
    fn score_within(&self, pose: &Rigid, reach: f64) -> f64 {
        let field = &self.known.field;
        let placed = field.placed(pose, self.measured.mean);
        field.score(&placed, &self.blocks, reach) / self.samples.points.len() as f64
    }

    /// Poses in which a part with the symmetries of common parts would fit as well as in `pose`. Turns about the principal axes
    /// of the reference go by halves, thirds, … twelfths, and by those of a cube. Turns about the axes of the measured go by
    /// quarters and halves: a part of a surface may have symmetries that the whole does not.
    pub fn symmetric(&self, pose: &Rigid) -> Vec<Candidate> {
        let center = self.known.moments.mean;
        let turn = |axis: Vector, angle: f64| Rigid::rotation_about(center, times(angle, axis)).after(pose);
        let mut all = vec![];
        for axis in self.known.moments.axes {
            for n in 2..=12 {
                for k in (1..n).filter(|k| (2..=*k).all(|d| k % d != 0 || n % d != 0)) {
                    all.push(turn(axis, std::f64::consts::TAU * f64::from(k) / f64::from(n)));
                }
            }
            let next = self.known.moments.axes.map(|a| cross(axis, a)).into_iter().filter(|a| norm(*a) > 0.5);
            let halves = next.map(|a| times(std::f64::consts::FRAC_1_SQRT_2, plus(axis, a)));
            all.extend(halves.map(|a| turn(a, std::f64::consts::PI)));
        }
        let middle = pose.point(self.measured.mean);
        for axis in self.measured.axes.map(|a| pose.vector(a)) {
            let quarters = [1.0, 2.0, 3.0].map(|k| times(0.5 * k * std::f64::consts::PI, axis));
            all.extend(quarters.map(|q| Rigid::rotation_about(middle, q).after(pose)));
        }
        let found = all.iter().map(|&pose| Candidate { pose, score: self.score(&pose) });
        let enough = 0.8 * self.score(pose);
        self.distinct(found.filter(|c| c.score > enough).collect())
    }
}

/// The 24 rotations of a cube: permutations of the axes with signs, of determinant 1.
fn cube_rotations() -> Vec<[Vector; 3]> {
    let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    let mut all = vec![];
    for order in orders {
        for signs in 0..8u32 {
            let rows: [Vector; 3] = std::array::from_fn(|k| {
                let mut row = [0.0; 3];
                row[order[k]] = if signs >> k & 1 == 1 { -1.0 } else { 1.0 };
                row
            });
            if dot(rows[0], cross(rows[1], rows[2])) > 0.0 {
                all.push(rows);
            }
        }
    }
    all
}

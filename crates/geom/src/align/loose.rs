//! Motions that the measured does not hold, and how far they go.
//!
//! A motion is held by points whose closest place lies inside a face. Rims hold it only once points lie beyond them: between
//! its ends the sum of squares is flat. Least squares end at a rim there. A point with noise that lies within the material is
//! nearer to the face beyond the rim than to its own. So motions that the insides of faces hardly hold are tried as finite
//! ones, with the closest places found anew. Rough ways find the middle of the poses that fit. From there exact ways tell how
//! far the sum of squares rises by no more than noise makes it.

use super::AlignError;
use super::freedom::{FREE_RISE_SHARE, FREEDOM_STEP_SHARE, HELD_MOTION_SHARE, MAX_SLIDE_ROTATION};
use super::icp::{MAX_ITERATIONS, Match, Problem, small_motion};
use super::rims::at_rims;
use super::system::{Six, Spectrum, eigen_six, padded, slope};
use super::twist::{Twist, inner};
use super::work::RIVAL_SAMPLES;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::minus;

/// Upper quartile of the size of normal errors, in standard deviations.
const UPPER_QUARTILE_SIGMAS: f64 = 1.15;
/// Standard deviations from a rim within which noise may decide which face is closest.
const RIM_SIGMAS: f64 = 6.0;
/// Variances by which two poses that fit as well may differ: noise brings three motions so far once in 900.
const INDISTINCT_VARIANCES: f64 = 16.0;
/// Root mean square rise per way that belongs to the path: a held motion moves along by its second order.
const PATH_RISE_SHARE: f64 = 1e-3;
/// Least length of a rough way, in standard deviations of a single distance. Noise at a rim lowers the root mean square by up
/// to 0.6, which is [`FREE_RISE_SHARE`] of this.
const MIN_ROUGH_SIGMAS: f64 = 30.0;
/// Standard deviations of a single distance from which on a range without hold is wide: noise of single points blurs its ends.
const MIN_WIDE_SIGMAS: f64 = 20.0;
/// Rounds by which the middle of a range is found.
const MIDDLE_ROUNDS: usize = 3;
/// Halvings of an end of a range in the search for its middle.
const ROUGH_HALVINGS: usize = 4;
/// Halvings of an end of a range that is reported.
const EXACT_HALVINGS: usize = 8;
/// Steps to the pose that moves least.
const LEAST_MOTION_STEPS: usize = 5;

/// Motions that the insides of faces hardly hold, in the frame of the reference.
#[derive(Clone, Debug, Default)]
pub(super) struct Loose {
    /// The free motions.
    pub free: Vec<Twist>,
    /// The motions that rims leave some way, and how far from end to end, root mean square, millimeters.
    pub slack: Vec<(Twist, f64)>,
    /// The motions that are held all the same.
    pub held: Vec<Twist>,
    /// Whether one of the free or slack ones has an end: then they stay where they were put.
    pub ends: bool,
}

impl Loose {
    /// The motions along which the points do not tell the pose.
    pub fn untold(&self) -> Vec<Twist> {
        self.free.iter().copied().chain(self.slack.iter().map(|s| s.0)).collect()
    }
}

/// The motions that are hardly held at `pose`, where least squares end, and the pose within their ranges. Each motion is
/// measured from `start`.
pub(super) fn explore(
    problem: &Problem,
    pose: &Rigid,
    start: &Rigid,
    progress: &dyn Progress,
) -> Result<(Rigid, Loose), AlignError> {
    let here = Place::new(problem, pose, progress)?;
    let mut loose = Loose::default();
    let flat = |six: &Six| here.goes_both_ways(six, progress);
    if here.weak.iter().map(flat).collect::<Result<Vec<bool>, AlignError>>()?.iter().all(|flat| *flat) {
        loose.free = here.twists(&here.weak);
        return Ok((*pose, loose));
    }
    let Some(middle) = here.middle(progress)? else {
        loose.held = here.twists(&here.weak);
        return Ok((*pose, loose));
    };
    let at = Place::new(problem, &middle, progress)?;
    let mut untold = vec![];
    for six in &at.weak {
        let twist = Twist::of(six, at.center, at.radius);
        let width: f64 = at.range(six, progress)?.iter().sum();
        if at.goes_both_ways(six, progress)? {
            loose.free.push(twist);
        } else if width > (MIN_WIDE_SIGMAS * at.sigma).max(64.0 * problem.rounding) {
            loose.slack.push((twist, width));
        } else {
            loose.held.push(twist);
            continue;
        }
        loose.ends |= !here.goes_both_ways(six, progress)?;
        untold.push(*six);
    }
    if !loose.ends {
        return Ok((*pose, loose));
    }
    let (nearest, way) = at.nearest(&untold, start);
    let fits = at.rise(&nearest, progress)? <= at.unseen(way);
    Ok((if fits { nearest } else { middle }, loose))
}

/// Whether the samples of `problem` fit as well when they slide or turn both ways by so much.
pub(super) fn is_symmetry(
    problem: &Problem,
    twist: &Twist,
    way: f64,
    progress: &dyn Progress,
) -> Result<bool, AlignError> {
    let six = twist.six(problem.mean, problem.radius);
    for sign in [-1.0, 1.0] {
        let there = small_motion(problem.mean, problem.radius, &six.map(|x| sign * way * x));
        if problem.cost(&there, way, progress)?.sqrt() > FREE_RISE_SHARE * way {
            return Ok(false);
        }
    }
    Ok(true)
}

/// A pose, and what the insides of faces hardly hold there.
struct Place<'a> {
    problem: &'a Problem<'a>,
    pose: Rigid,
    center: [f64; 3],
    radius: f64,
    /// How far motions are tried.
    step: f64,
    sigma: f64,
    count: f64,
    /// Mean square distance, none counted for more than the step or [`RIM_SIGMAS`] standard deviations.
    least: f64,
    /// The hardly held motions: slides before turns, the freest first.
    weak: Vec<Six>,
}

impl<'a> Place<'a> {
    fn new(problem: &'a Problem<'a>, pose: &Rigid, progress: &dyn Progress) -> Result<Place<'a>, AlignError> {
        let mut matches = problem.matches(pose, f64::INFINITY, progress)?;
        let sigma = spread(&matches);
        problem.weigh(&mut matches, sigma);
        let system = problem.system(&matches, pose);
        let (count, radius) = (system.count(), system.radius);
        let step = FREEDOM_STEP_SHARE * radius;
        matches.truncate(RIVAL_SAMPLES);
        let weight: f64 = matches.iter().map(|m| m.equation.weight).sum();
        let reach = (RIM_SIGMAS * sigma).max(64.0 * problem.rounding).min(step);
        let at_rims = at_rims(problem, &matches, reach, progress)?;
        for (m, _) in matches.iter_mut().zip(at_rims).filter(|(_, at_rim)| *at_rim) {
            m.equation.weight = 0.0;
        }
        let inside = problem.system_of_facets(&matches, pose);
        let spectrum = Spectrum::without(&inside, &problem.stays(&inside, pose));
        let center = inside.center;
        let weak = weak(&spectrum, HELD_MOTION_SHARE * weight);
        let mut place = Place { problem, pose: *pose, center, radius, step, sigma, count, least: 0.0, weak };
        if !place.weak.is_empty() {
            place.least = problem.cost(pose, place.cap(), progress)?;
        }
        Ok(place)
    }

    fn cap(&self) -> f64 {
        self.step.max(RIM_SIGMAS * self.sigma)
    }

    fn twists(&self, of: &[Six]) -> Vec<Twist> {
        of.iter().map(|six| Twist::of(six, self.center, self.radius)).collect()
    }

    fn moved(&self, six: &Six, way: f64) -> Rigid {
        small_motion(self.center, self.radius, &six.map(|x| way * x)).after(&self.pose)
    }

    /// How much the mean square rises to another pose.
    fn rise(&self, there: &Rigid, progress: &dyn Progress) -> Result<f64, AlignError> {
        Ok(self.problem.cost(there, self.cap(), progress)? - self.least)
    }

    /// The rise that tells nothing, of a way so long.
    fn unseen(&self, way: f64) -> f64 {
        let noise = self.sigma.max(self.problem.rounding);
        INDISTINCT_VARIANCES * noise * noise / self.count + (PATH_RISE_SHARE * way) * (PATH_RISE_SHARE * way)
    }

    /// Whether a step both ways costs next to nothing for its length.
    fn goes_both_ways(&self, six: &Six, progress: &dyn Progress) -> Result<bool, AlignError> {
        for way in [-self.step, self.step] {
            if self.rise(&self.moved(six, way), progress)? > (FREE_RISE_SHARE * way) * (FREE_RISE_SHARE * way)
            {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// How far it may go back and forth, up to the step, until what is seen is more than noise.
    fn range(&self, six: &Six, progress: &dyn Progress) -> Result<[f64; 2], AlignError> {
        let mut ends = [0.0; 2];
        for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
            let fits = |way: f64| -> Result<bool, AlignError> {
                Ok(self.rise(&self.moved(six, sign * way), progress)? <= self.unseen(way))
            };
            let (mut low, mut high) = (0.0, self.step);
            if fits(high)? {
                *end = high;
                continue;
            }
            for _ in 0..EXACT_HALVINGS {
                let middle = 0.5 * (low + high);
                if fits(middle)? { low = middle } else { high = middle }
            }
            *end = low;
        }
        Ok(ends)
    }

    /// The longest way, up to the step, that costs next to nothing for its length; none below what noise hides.
    fn rough_way(&self, six: &Six, progress: &dyn Progress) -> Result<f64, AlignError> {
        let fits = |way: f64| -> Result<bool, AlignError> {
            Ok(self.rise(&self.moved(six, way), progress)?
                <= (FREE_RISE_SHARE * way) * (FREE_RISE_SHARE * way))
        };
        let least = (MIN_ROUGH_SIGMAS * self.sigma).max(64.0 * self.problem.rounding);
        let mut way = self.step;
        while way >= least {
            if fits(way)? {
                let (mut low, mut high) = (way, (2.0 * way).min(self.step));
                for _ in 0..ROUGH_HALVINGS {
                    let middle = 0.5 * (low + high);
                    if fits(middle)? { low = middle } else { high = middle }
                }
                return Ok(low);
            }
            way *= 0.5;
        }
        Ok(0.0)
    }

    /// The middle of the poses that fit, roughly. It is found on chords along the weak directions, one after the other, or
    /// between them. A pose in a corner of the range has no such chords. `None` where there is no chord. The held motions
    /// follow.
    fn middle(&self, progress: &dyn Progress) -> Result<Option<Rigid>, AlignError> {
        let part = self.problem.samples.first(RIVAL_SAMPLES);
        let sampled = Problem { samples: &part, ..*self.problem };
        let mut between = vec![];
        for (i, a) in self.weak.iter().enumerate() {
            for b in &self.weak[..i] {
                for sign in [-1.0, 1.0] {
                    let sum = std::array::from_fn(|k| std::f64::consts::FRAC_1_SQRT_2 * (a[k] + sign * b[k]));
                    between.push(sum);
                }
            }
        }
        let mut pose = self.pose;
        let mut longest = 0.0_f64;
        let mut to_middles = |chords: &[Six]| -> Result<bool, AlignError> {
            let mut any = false;
            for six in chords {
                let mut at = Place { problem: &sampled, pose, weak: vec![], ..*self };
                at.least = sampled.cost(&pose, at.cap(), progress)?;
                let forth = at.rough_way(six, progress)?;
                let back = at.rough_way(&six.map(|x| -x), progress)?;
                any |= forth.max(back) > 0.0;
                longest = longest.max(forth.max(back));
                pose = at.moved(six, 0.5 * (forth - back));
            }
            Ok(any)
        };
        for _ in 0..MIDDLE_ROUNDS {
            if !to_middles(&self.weak)? && !to_middles(&between)? {
                break;
            }
        }
        if longest == 0.0 {
            return Ok(None);
        }
        let there = Place::new(self.problem, &pose, progress)?;
        let still = [self.problem.stay, &there.twists(&there.weak)].concat();
        let rest = Problem { stay: &still, ..*self.problem };
        Ok(Some(rest.run(pose, f64::INFINITY, MAX_ITERATIONS, progress)?.pose))
    }

    /// The pose that moves the samples least from `start`, of those that the directions lead to, and how far it is.
    fn nearest(&self, directions: &[Six], start: &Rigid) -> (Rigid, f64) {
        let mut at = self.pose;
        let mut way: Six = [0.0; 6];
        for _ in 0..LEAST_MOTION_STEPS {
            let (mut matrix, mut right) = ([[0.0; 6]; 6], [0.0; 6]);
            for (p, w) in self.problem.samples.points.iter().zip(&self.problem.samples.weights) {
                let (here, there) = (at.point(*p), start.point(*p));
                let away = minus(here, there);
                for axis in 0..3 {
                    let normal = std::array::from_fn(|k| f64::from(u8::from(k == axis)));
                    let row = slope(here, normal, self.center, self.radius);
                    let along: Vec<f64> = directions.iter().map(|d| inner(d, &row)).collect();
                    for (i, a) in along.iter().enumerate() {
                        right[i] -= w * a * away[axis];
                        for (j, b) in along.iter().enumerate() {
                            matrix[i][j] += w * a * b;
                        }
                    }
                }
            }
            let (values, rows) = eigen_six(&padded(directions.len(), &|i, j| matrix[i][j]));
            let mut step: Six = [0.0; 6];
            for k in 0..directions.len() {
                let share = inner(&rows[k], &right) / values[k];
                for (i, d) in directions.iter().enumerate() {
                    (0..6).for_each(|c| step[c] += share * rows[k][i] * d[c]);
                }
            }
            (0..6).for_each(|c| way[c] += step[c]);
            at = small_motion(self.center, self.radius, &step).after(&at);
        }
        (at, inner(&way, &way).sqrt())
    }
}

/// The standard deviation of the distances, from their upper quartile. Noise moves some points of a face out of a wall, and
/// half of these lie within it exactly.
fn spread(matches: &[Match]) -> f64 {
    let mut distances: Vec<f64> = matches.iter().map(|m| m.distance).filter(|d| d.is_finite()).collect();
    if distances.is_empty() {
        return 0.0;
    }
    let quarter = distances.len() * 3 / 4;
    *distances.select_nth_unstable_by(quarter, f64::total_cmp).1 / UPPER_QUARTILE_SIGMAS
}

/// The directions that are held by less than `enough`. Slides are parted from turns, and either are taken apart by how well they are held.
fn weak(spectrum: &Spectrum, enough: f64) -> Vec<Six> {
    let stay = spectrum.stay;
    let count = (stay..6).take_while(|k| spectrum.values[*k] < enough).count();
    let vectors = &spectrum.vectors[stay..stay + count];
    let turns = |i: usize, j: usize| (0..3).map(|k| vectors[i][k] * vectors[j][k]).sum::<f64>();
    let (shares, rows) = eigen_six(&padded(count, &turns));
    let slides = (0..count).filter(|&k| shares[k] < MAX_SLIDE_ROTATION).count();
    let mut all = vec![];
    for group in [&rows[..slides], &rows[slides..count]] {
        let held = |i: usize, j: usize| {
            (0..count).map(|k| group[i][k] * group[j][k] * spectrum.values[stay + k].max(0.0)).sum::<f64>()
        };
        let (_, parted) = eigen_six(&padded(group.len(), &held));
        for part in &parted[..group.len()] {
            let share = |k: usize| (0..group.len()).map(|i| part[i] * group[i][k]).sum::<f64>();
            let one = |d: usize| (0..count).map(|k| share(k) * vectors[k][d]).sum::<f64>();
            all.push(std::array::from_fn(one));
        }
    }
    all
}

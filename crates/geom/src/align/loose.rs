//! What the faces of the reference do not hold, and how far such motions may go.
//!
//! A motion is held by points whose closest place lies inside a face. Rims hold it only once points lie beyond them: between its ends the
//! sum of squares is flat. Least squares end at a rim there: a point with noise that lies within the material is nearer to the face beyond the
//! rim than to its own. So the motion is tried: the middle of where it fits, roughly, and from there the range in which the sum of squares
//! rises by no more than noise makes it. Within the range the pose is the one that moves the measured least where that fits, else the middle.

use super::AlignError;
use super::freedom::{BARELY, CAP, HELD, SLIDES, TRIED};
use super::icp::{Problem, small_motion};
use super::system::{Six, Spectrum, System, eigen_six, padded, slope};
use super::twist::{Twist, inner};
use super::work::PART;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::minus;

/// Standard deviations, squared, by which two poses that fit as well may differ: noise brings three motions so far once in 900.
const INDISTINCT: f64 = 16.0;
/// Standard deviations of a single distance that a range is wide where nothing holds: a single point that does would leave less.
const WIDE: f64 = 10.0;
/// Mean square over the least up to which a pose fits roughly: faces beyond rims take a third of it away (0.36 of a contour tilted to both rims).
const ROUGHLY: f64 = 2.0;
/// Rounds by which the middle of a range is found.
const ROUNDS: usize = 3;
/// How often an end of a range is halved, in the search for the middle and where it is told.
const ROUGH: usize = 4;
const EXACT: usize = 8;
/// Share of the step at which a range begins to be looked for, in the search for the middle.
const COARSE: f64 = 1.0 / 64.0;
/// Steps to the pose that moves least.
const STEPS: usize = 5;

/// Motions that faces hardly hold, in the frame of the reference.
#[derive(Clone, Debug, Default)]
pub(super) struct Loose {
    /// Those that are free.
    pub free: Vec<Twist>,
    /// Those that rims leave some way, and how far from end to end, root mean square, millimeters.
    pub slack: Vec<(Twist, f64)>,
    /// Those that are held all the same.
    pub held: Vec<Twist>,
    /// Whether one of the free or slack ones has an end: then they stay where they were put.
    pub ends: bool,
}

impl Loose {
    /// Those along which the pose is not one that the points tell.
    pub fn untold(&self) -> Vec<Twist> {
        self.free.iter().copied().chain(self.slack.iter().map(|s| s.0)).collect()
    }
}

/// The motions that are hardly held at `pose`, where least squares end, and the pose within their ranges; `start` is what a motion is
/// measured from.
pub(super) fn explore(
    problem: &Problem,
    pose: &Rigid,
    start: &Rigid,
    progress: &dyn Progress,
) -> Result<(Rigid, Loose), AlignError> {
    let at = Place::new(problem, pose, progress)?;
    let mut loose = Loose::default();
    if at.weak.is_empty() {
        return Ok((*pose, loose));
    }
    let here = Ground::new(problem, &at, 1.0, progress)?;
    let flat = |six: &Six| here.both_ways(&at, six, progress);
    if at.weak.iter().map(flat).collect::<Result<Vec<bool>, AlignError>>()?.iter().all(|flat| *flat) {
        loose.free = at.twists(&at.weak);
        return Ok((*pose, loose));
    }
    // Few samples find the middle.
    let part = problem.samples.first(PART);
    let few = Problem { samples: &part, ..*problem };
    let roughly = Ground::new(&few, &Place::new(&few, pose, progress)?, ROUGHLY, progress)?;
    let middle = roughly.middle(&at, progress)?;
    let at = Place::new(problem, &middle, progress)?;
    let ground = Ground::new(problem, &at, 1.0, progress)?;
    let first = (at.sigma / at.count.sqrt()).max(problem.rounding);
    let mut untold = vec![];
    for six in &at.weak {
        let width: f64 = ground.range(&at, six, first, EXACT, progress)?.iter().sum();
        let twist = Twist::of(six, at.center, at.radius);
        if width >= 2.0 * at.step || width >= at.step.max(WIDE * at.sigma) {
            loose.free.push(twist);
        } else if width > (WIDE * at.sigma).max(64.0 * problem.rounding) {
            loose.slack.push((twist, width));
        } else {
            loose.held.push(twist);
            continue;
        }
        loose.ends |= !here.both_ways(&Place { pose: *pose, weak: vec![], ..at }, six, progress)?;
        untold.push(*six);
    }
    if !loose.ends {
        return Ok((*pose, loose));
    }
    let nearest = nearest(problem, &at, &untold, start);
    Ok((if ground.fits(&nearest, 0.0, progress)? { nearest } else { middle }, loose))
}

/// A pose with the equations of the facets there.
struct Place {
    pose: Rigid,
    center: [f64; 3],
    radius: f64,
    /// How far motions are tried.
    step: f64,
    sigma: f64,
    count: f64,
    /// What facets hardly hold: slides before turns, the freest first.
    weak: Vec<Six>,
}

impl Place {
    fn new(problem: &Problem, pose: &Rigid, progress: &dyn Progress) -> Result<Place, AlignError> {
        let mut matches = problem.matches(pose, f64::INFINITY, progress)?;
        let sigma = problem.deviation(&matches);
        problem.weigh(&mut matches, sigma);
        let facets = problem.system_of_facets(&matches, pose);
        let spectrum = Spectrum::without(&facets, &problem.stays(&facets, pose));
        Ok(Place {
            pose: *pose,
            center: facets.center,
            radius: facets.radius,
            step: TRIED * facets.radius,
            sigma: problem.system(&matches, pose).rms(),
            count: facets.count(),
            weak: weak(&facets, &spectrum),
        })
    }

    fn twists(&self, of: &[Six]) -> Vec<Twist> {
        of.iter().map(|six| Twist::of(six, self.center, self.radius)).collect()
    }

    fn moved(&self, six: &Six, way: f64) -> Rigid {
        small_motion(self.center, self.radius, &six.map(|x| way * x)).after(&self.pose)
    }
}

/// The directions that the facets hardly hold. Slides are parted from turns, and either are taken apart by how well they are held.
fn weak(facets: &System, spectrum: &Spectrum) -> Vec<Six> {
    let stay = spectrum.stay;
    let hardly = |k: &usize| facets.weight > 0.0 && spectrum.values[*k] / facets.weight < HELD;
    let count = (stay..6).take_while(hardly).count();
    let vectors = &spectrum.vectors[stay..stay + count];
    let turns = |i: usize, j: usize| (0..3).map(|k| vectors[i][k] * vectors[j][k]).sum::<f64>();
    let (shares, rows) = eigen_six(&padded(count, &turns));
    let slides = (0..count).filter(|&k| shares[k] < SLIDES).count();
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

/// The sum of squares about a pose, by what is flat: a rise that noise makes, or none beside the way.
struct Ground<'a> {
    problem: &'a Problem<'a>,
    /// Distances that no distance counts for more than: many standard deviations, and the step.
    caps: [f64; 2],
    /// Mean squares at the pose.
    here: [f64; 2],
    /// The mean square up to which a pose fits as well.
    most: f64,
}

impl<'a> Ground<'a> {
    /// At a place; `times` as much fits besides what noise makes.
    fn new(
        problem: &'a Problem<'a>,
        at: &Place,
        times: f64,
        progress: &dyn Progress,
    ) -> Result<Ground<'a>, AlignError> {
        let sigma = at.sigma.max(problem.rounding);
        let caps = [CAP * sigma, at.step.max(CAP * sigma)];
        let mut ground = Ground { problem, caps, here: [0.0; 2], most: 0.0 };
        ground.here = ground.costs(&at.pose, progress)?;
        ground.most = times * ground.here[0] + INDISTINCT * sigma * sigma / at.count;
        Ok(ground)
    }

    fn costs(&self, pose: &Rigid, progress: &dyn Progress) -> Result<[f64; 2], AlignError> {
        let distances = self.problem.distances(pose, self.caps[1], progress)?;
        Ok(self.caps.map(|cap| self.problem.cost_of(distances.iter().copied(), cap)))
    }

    /// Whether a pose so far away fits as well.
    fn fits(&self, pose: &Rigid, way: f64, progress: &dyn Progress) -> Result<bool, AlignError> {
        let [near, wide] = self.costs(pose, progress)?;
        Ok(near <= self.most || wide - self.here[1] <= (BARELY * way) * (BARELY * way))
    }

    fn both_ways(&self, at: &Place, six: &Six, progress: &dyn Progress) -> Result<bool, AlignError> {
        let fits = |way: f64| self.fits(&at.moved(six, way), at.step, progress);
        Ok(fits(at.step)? && fits(-at.step)?)
    }

    /// How far it may go back and forth, up to the step.
    fn range(
        &self,
        at: &Place,
        six: &Six,
        first: f64,
        halvings: usize,
        progress: &dyn Progress,
    ) -> Result<[f64; 2], AlignError> {
        let mut ends = [0.0; 2];
        for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
            let fits = |way: f64| self.fits(&at.moved(six, sign * way), way, progress);
            if fits(at.step)? {
                *end = at.step;
                continue;
            }
            let (mut low, mut high) = (0.0, first.min(at.step));
            while high < at.step && fits(high)? {
                (low, high) = (high, 2.0 * high);
            }
            high = high.min(at.step);
            for _ in 0..halvings {
                let middle = 0.5 * (low + high);
                if fits(middle)? { low = middle } else { high = middle }
            }
            *end = low;
        }
        Ok(ends)
    }

    /// The middle of what fits: of chords along the weak directions and between them, one after the other. A pose in a corner of the range
    /// has no chord along some of them.
    fn middle(&self, from: &Place, progress: &dyn Progress) -> Result<Rigid, AlignError> {
        let mut chords = from.weak.clone();
        for (i, a) in from.weak.iter().enumerate() {
            for b in &from.weak[..i] {
                for sign in [-1.0, 1.0] {
                    let sum = std::array::from_fn(|k| std::f64::consts::FRAC_1_SQRT_2 * (a[k] + sign * b[k]));
                    chords.push(sum);
                }
            }
        }
        let mut pose = from.pose;
        for _ in 0..ROUNDS {
            for six in &chords {
                let at = Place { pose, weak: vec![], ..*from };
                let [back, forth] = self.range(&at, six, COARSE * at.step, ROUGH, progress)?;
                pose = at.moved(six, 0.5 * (forth - back));
            }
        }
        Ok(pose)
    }
}

/// The pose that moves the samples least from `start`, of those that the directions lead to from `at`.
fn nearest(problem: &Problem, at: &Place, directions: &[Six], start: &Rigid) -> Rigid {
    let mut pose = at.pose;
    for _ in 0..STEPS {
        let (mut matrix, mut right) = ([[0.0; 6]; 6], [0.0; 6]);
        for (p, w) in problem.samples.points.iter().zip(&problem.samples.weights) {
            let (here, there) = (pose.point(*p), start.point(*p));
            let away = minus(here, there);
            for axis in 0..3 {
                let normal = std::array::from_fn(|k| f64::from(u8::from(k == axis)));
                let row = slope(here, normal, at.center, at.radius);
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
        pose = small_motion(at.center, at.radius, &step).after(&pose);
    }
    pose
}

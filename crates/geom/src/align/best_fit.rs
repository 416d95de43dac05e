//! The best fit from any pose: start, iteration, and what the result is worth.

use super::alignment::POOR;
use super::alternatives::{better, is_same};
use super::icp::{Ended, MOST, Match, Problem, Room, median_distance};
use super::sample::{Measured, Samples};
use super::start::{Candidate, Search};
use super::system::Spectrum;
use super::work::{BRIEF, PART, Work};
use super::{AlignError, AlignWarning, Alignment, BestFit, Freedom, Start, Target, freedom, near, revolved};
use crate::closest::{BoundaryEdges, check_mesh, check_points};
use crate::num::sum::Sum;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::Aabb;
use crate::stats::SIGMA_OVER_MAD;

/// Samples for the start, for choosing among poses, and above which the iteration first goes over those alone.
const FEW: usize = 400;
const SOME: usize = 5000;
/// Samples from which on the iteration first goes over one of so many, so many times: what it is off then is a few uncertainties.
const LARGE: usize = 100_000;
const SHARE: usize = 8;
const FIRST: usize = 2;
/// Rounds over all samples at most once the iteration has settled on some of them, and where it has not.
const LAST: usize = 30;
const FEW_ROUNDS: usize = 3;
/// Starts whose cost is within this ratio of the best are iterated to the end.
const PROMISING: f64 = 4.0;
/// Worth of a start below which normals are tried the other way round.
const DOUBTFUL: f64 = 0.6;
/// Fewer points than these are found wrongly now and then: of clouds of 20 about one in ten, of 25 none in tries with a bracket.
const SPARSE: usize = 50;
/// Share of the measured that counts below which the start is looked for again, so many times, with other samples and pairs.
const EXPLAINED: f64 = 0.95;
const AGAIN: usize = 2;
/// Share of the measured that does not count from which on that is told.
const MUCH: f64 = 0.1;
/// How often, from where the last round ended, and the share of the spacing that is no other pose.
const ROUNDS: usize = 3;
const SAME: f64 = 0.02;
/// Factors between units that are confused.
const UNITS: [f64; 6] = [25.4, 1.0 / 25.4, 10.0, 0.1, 1000.0, 1e-3];

/// The motion that brings `measured` onto `reference` with the least weighted mean square distance to its surface: of
/// a mesh, weighted by area, or of points; outliers do not count unless `options` say so.
///
/// From any starting pose, of whole and partial scans, with clutter. What cannot be told is named in the warnings: poses
/// that fit as well, motions that the shape leaves free, inverted normals, a wrong unit, a poor fit, too few points.
///
/// Runs on the current rayon pool; the answer does not depend on its size. Cost: about 0.1 s for the start on two cores,
/// then three to five closest-point searches of all points.
///
/// # Errors
/// [`AlignError`]: fewer than three points, all points on one line, coordinates that are no numbers, cancelled.
///
/// ```
/// use trueness_geom::align::{best_fit, BestFit, Measured, Target};
/// use trueness_geom::{closest::Tree, mesh::Mesh, progress::Silent, rigid::Rigid};
/// let reference = Mesh {
///     positions: vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 11.0]],
///     faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
/// };
/// // Points of its surface, turned by 3 radians about x and a little about the others.
/// let turn = Rigid::rotation_about([1.0, 2.0, 3.0], [3.0, 0.4, 0.1]);
/// let mut points = vec![];
/// for face in &reference.faces {
///     let [a, b, c] = face.map(|v| reference.positions[v as usize]);
///     for (i, j) in (0..=12).flat_map(|i| (0..=12 - i).map(move |j| (f64::from(i) / 12.0, f64::from(j) / 12.0))) {
///         points.push(turn.point(std::array::from_fn(|k| a[k] + i * (b[k] - a[k]) + j * (c[k] - a[k]))));
///     }
/// }
/// let tree = Tree::build(&reference)?;
/// let target = Target::new(&reference, &tree);
/// let measured = Measured::Points { points: &points, normals: None };
/// let found = best_fit(&measured, &target, &BestFit::default(), &Silent)?;
/// assert!(found.reference_from_measured.after(&turn).angle() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn best_fit(
    measured: &Measured,
    reference: &Target,
    options: &BestFit,
    progress: &dyn Progress,
) -> Result<Alignment, AlignError> {
    let samples = checked(measured, reference)?;
    let boundary_edges = BoundaryEdges::watched(reference.tree, progress)?;
    let work = Work::new(reference, &boundary_edges, options, &samples);
    let mut start = match options.start {
        Start::Anywhere => work.search(&samples, progress)?,
        Start::Given(pose) => Found { poses: vec![pose], turned: false, scale: None, search: None },
    };
    let turned = |samples: Samples| if start.turned { samples.turned() } else { samples };
    let samples = turned(samples);
    let some = samples.thinned(SOME, options.seed);
    // The pose is that of the surface, its figures are those of the points: errors of a scan are independent there at best.
    let all = work.problem(&samples);
    let surface = match measured {
        Measured::Mesh(_) => Some(turned(Samples::of_surface(measured))),
        Measured::Points { .. } => None,
    };
    let whole = surface.as_ref().unwrap_or(&samples);
    let part = (whole.points.len() > LARGE).then(|| whole.thinned(whole.points.len() / SHARE, options.seed));
    let part = part.as_ref().map(|p| work.problem(p));
    let surface = surface.as_ref().map(|s| work.problem(s));
    let settle = Settle { work: &work, all, surface, part, some: &some };
    let settled = |pose: Rigid, sigma: f64| settle.from(pose, sigma, progress);
    let (pose, sigma) = work.choose(&start.poses, &some, progress)?;
    let mut result = settled(pose, sigma)?;
    let mut unconfirmed = None;
    if let Some(search) = start.search.take() {
        if options.robust && result.share < EXPLAINED {
            let own = result.reference_from_measured;
            let again = work.sought_again(&search, &result, &samples, &some, progress)?;
            start.poses.push(own);
            start.poses.extend(&again);
            let (pose, sigma) = work.choose(&[&[own][..], &again].concat(), &some, progress)?;
            result = settled(pose, sigma)?;
            for _ in 0..ROUNDS {
                let pose = work.around(&search, &result, &some, progress)?;
                if search.apart(&result.reference_from_measured, &pose) <= SAME * search.spacing {
                    break;
                }
                result = settled(pose, sigma)?;
            }
            let found = [own].iter().chain(&again).filter(|pose| is_same(&search, &result, pose)).count();
            unconfirmed = (found < 2).then_some(1 + AGAIN);
        }
        let revolved = work.revolved(&search, &result, &some, progress)?;
        let own = result.reference_from_measured;
        if let Some(near) = revolved.iter().find(|p| search.apart(p, &own) <= search.spacing) {
            let (pose, sigma) = work.choose(&[own, *near], &some, progress)?;
            if search.apart(&own, &pose) > SAME * search.spacing {
                result = settled(pose, sigma)?;
            }
        }
        let poses = (&start.poses[..], &revolved[..]);
        result.alternatives = work.alternatives(&search, poses, &result, &some, progress)?;
        if let Some(pose) = better(&search, &result) {
            result = settled(pose, sigma)?;
            result.alternatives = work.alternatives(&search, poses, &result, &some, progress)?;
        }
        start.search = Some(search);
    }
    result.warnings = work.warnings(&result, &start, measured);
    result.warnings.extend(unconfirmed.map(|searches| AlignWarning::Unconfirmed { searches }));
    Ok(result)
}

/// What the end of an iteration is made with.
struct Settle<'a> {
    work: &'a Work<'a>,
    all: Problem<'a>,
    /// Of a mesh.
    surface: Option<Problem<'a>>,
    /// An eighth of very many.
    part: Option<Problem<'a>>,
    some: &'a Samples,
}

impl Settle<'_> {
    /// Where the iteration over all ends, and what that is worth; `sigma` is the standard deviation of the distances at `pose`.
    fn from(&self, mut pose: Rigid, sigma: f64, progress: &dyn Progress) -> Result<Alignment, AlignError> {
        let Settle { work, all, surface, part, some } = self;
        let reach = work.reach(sigma);
        // What does not settle on some of them does not on all, which would take as many times as long.
        let begun = work.problem(some).run(pose, reach, MOST, progress)?;
        let most = if begun.converged { LAST } else { FEW_ROUNDS };
        pose = begun.pose;
        if let Some(part) = part {
            pose = part.run(pose, reach, FIRST, progress)?.pose;
        }
        let mut room = Room::default();
        let ended = match surface {
            Some(surface) => surface.run(pose, reach, most, progress)?,
            None => all.iterate(pose, reach, most, &mut room, progress)?.0,
        };
        match ended.converged && surface.is_none() {
            true => all.complete(&mut room.matches, &ended.pose, progress)?,
            false => room.matches = all.matches(&ended.pose, f64::INFINITY, progress)?,
        }
        work.worth(all, &ended, room.matches, some, progress)
    }
}

/// The samples of what is measured, once it is known to be fit for use.
fn checked(measured: &Measured, reference: &Target) -> Result<Samples, AlignError> {
    check_points(measured.points())?;
    check_mesh(reference.mesh)?;
    match measured {
        Measured::Mesh(mesh) => check_mesh(mesh)?,
        Measured::Points { points, normals: Some(normals) } if normals.len() != points.len() => {
            let (expected, found) = (points.len(), normals.len());
            return Err(AlignError::Uneven { what: "normals", expected, found });
        }
        Measured::Points { .. } => {}
    }
    let samples = Samples::all(measured);
    if samples.points.len() < 3 {
        return Err(AlignError::TooFewPoints { needed: 3, found: samples.points.len() });
    }
    let moments = samples.moments();
    if moments.variances[1] <= 1e-14 * moments.variances[2] {
        return Err(AlignError::Collinear);
    }
    Ok(samples)
}

/// Where to go on from.
struct Found {
    /// Best first.
    poses: Vec<Rigid>,
    /// Whether the measured normals had to be turned round.
    turned: bool,
    /// The factor by which the measured would fit better.
    scale: Option<f64>,
    search: Option<Search>,
}

impl Work<'_> {
    /// Looks for starts.
    fn search(&self, samples: &Samples, progress: &dyn Progress) -> Result<Found, AlignError> {
        let few = samples.few(FEW, self.options.seed);
        let mut search = Search::new(self.target, few, self.options.seed, progress)?;
        let mut candidates = search.candidates(&[Rigid::IDENTITY], progress)?;
        let best = |c: &[Candidate]| c.first().map_or(0.0, |c| c.worth);
        let as_is = best(&candidates);
        let mut scale = self.scale(&search, as_is, progress)?;
        let mut turned = false;
        if as_is < DOUBTFUL && scale.is_none() && search.samples.oriented {
            search.turn();
            let others = search.candidates(&[Rigid::IDENTITY], progress)?;
            scale = self.scale(&search, best(&others).max(as_is), progress)?;
            turned = scale.is_some() || best(&others) > as_is;
            if turned {
                candidates = others;
            } else {
                search.turn();
            }
        }
        let poses = self.promising(&search, &candidates, progress)?;
        // What has a wrong unit lies nowhere: no use to look on.
        let search = scale.is_none().then_some(search);
        Ok(Found { poses, turned, scale, search })
    }

    /// The best of the candidates, refined on the samples of the search.
    fn promising(
        &self,
        search: &Search,
        candidates: &[Candidate],
        progress: &dyn Progress,
    ) -> Result<Vec<Rigid>, AlignError> {
        let refined = search.refine(candidates, 0.0, &self.problem(&search.samples), progress)?;
        let least = refined.first().map_or(0.0, |r| r.0);
        Ok(refined.iter().filter(|r| r.0 <= PROMISING * least).map(|r| r.1).collect())
    }

    /// The best pose of each further search, with samples and pairs of its own: where much does not lie on the reference, a search
    /// may miss the place. As soon as one ends at that of the result it is enough; else [`AGAIN`] poses, fewer where a search finds nothing.
    fn sought_again(
        &self,
        search: &Search,
        result: &Alignment,
        samples: &Samples,
        some: &Samples,
        progress: &dyn Progress,
    ) -> Result<Vec<Rigid>, AlignError> {
        let mut found = vec![];
        for k in 1..=AGAIN as u64 {
            let seed = self.options.seed.wrapping_add(k);
            let again = search.again(samples.few(FEW, seed), seed);
            let candidates = again.candidates(&[Rigid::IDENTITY], progress)?;
            let mut poses = self.promising(&again, &candidates, progress)?;
            poses.truncate(BRIEF);
            if !poses.is_empty() {
                found.push(self.choose(&poses, some, progress)?.0);
            }
            if found.last().is_some_and(|pose| is_same(search, result, pose)) {
                break;
            }
        }
        Ok(found)
    }

    /// The best pose about that of the result.
    pub(super) fn around(
        &self,
        search: &Search,
        result: &Alignment,
        some: &Samples,
        progress: &dyn Progress,
    ) -> Result<Rigid, AlignError> {
        let pose = result.reference_from_measured;
        let few = self.problem(&search.samples);
        let mut matches = few.matches(&pose, f64::INFINITY, progress)?;
        let sigma = few.deviation(&matches);
        few.weigh(&mut matches, sigma);
        let system = few.system_of_facets(&matches, &pose);
        let tried = near::poses(&system, &result.freedoms, &pose, search.spacing);
        let cap = self.cap(SIGMA_OVER_MAD * result.median);
        let best = search.nearest_of(&tried, &pose, &few, cap, progress)?;
        if best.is_empty() {
            return Ok(pose);
        }
        Ok(self.choose(&[&[pose][..], &best].concat(), some, progress)?.0)
    }

    /// Poses turned about the axis of a reference that is a body of revolution but for a detail; none where the shape leaves a turn free.
    fn revolved(
        &self,
        search: &Search,
        result: &Alignment,
        some: &Samples,
        progress: &dyn Progress,
    ) -> Result<Vec<Rigid>, AlignError> {
        if result.freedoms.iter().any(|f| matches!(f, Freedom::Turns { .. })) {
            return Ok(vec![]);
        }
        let part = some.first(PART);
        let [few, part] = [&search.samples, &part].map(|s| self.problem(s));
        let cap = self.cap(SIGMA_OVER_MAD * result.median);
        revolved::poses(search, &result.reference_from_measured, [&few, &part], cap, progress)
    }

    /// The factor between units by which the measured fits better than as it is.
    fn scale(&self, search: &Search, as_is: f64, progress: &dyn Progress) -> Result<Option<f64>, AlignError> {
        let ratio = search.size_ratio();
        for factor in UNITS {
            if !(0.8..1.25).contains(&(ratio * factor)) {
                continue;
            }
            let scaled = search.scaled(factor);
            let worth = scaled.candidates(&[Rigid::IDENTITY], progress)?.first().map_or(0.0, |c| c.worth);
            // A tiny piece lies well on any flat place: what counts is that all of it fits at full size.
            if worth > DOUBTFUL && (worth > as_is || ratio < 1.0) {
                return Ok(Some(factor));
            }
        }
        Ok(None)
    }

    /// Figures of the result at the pose where it ended, of the matches of all samples there.
    fn worth(
        &self,
        all: &Problem,
        ended: &Ended,
        mut matches: Vec<Match>,
        some: &Samples,
        progress: &dyn Progress,
    ) -> Result<Alignment, AlignError> {
        let pose = &ended.pose;
        let median = median_distance(&matches, &mut vec![]).unwrap_or(0.0);
        let sigma = SIGMA_OVER_MAD * median;
        all.weigh(&mut matches, sigma);
        let system = all.system(&matches, pose);
        if system.weight <= 0.0 {
            return Err(AlignError::NoOverlap);
        }
        let facets = all.system_of_facets(&matches, pose);
        let of_facets = Spectrum::of(&facets);
        let some = self.problem(some);
        let free = freedom::count(&some, &facets, &of_facets, pose, progress)?;
        let barely = freedom::barely_held(&some, &system, (&facets, &of_facets), free, pose, progress)?;
        // What is free is told by the facets; edges of a faceted cylinder would hold it.
        let spectrum = if free > 0 { Spectrum::of(&facets) } else { Spectrum::of(&system) };
        let (share, limit) = (1.0 - system.weight.min(1.0), all.limit(sigma));
        let (mut used, mut farthest, mut sum) = (0, 0.0f64, Sum::default());
        for m in matches.iter().filter(|m| m.distance.is_finite()) {
            used += usize::from(m.equation.weight > 0.0);
            farthest = farthest.max(if m.distance > limit { m.distance } else { 0.0 });
            sum = sum.plus(m.equation.weight * m.distance);
        }
        let left_out = AlignWarning::LeftOut { share, farthest, limit };
        Ok(Alignment {
            reference_from_measured: *pose,
            rms: system.rms(),
            mean_abs: sum.value() / system.weight,
            median,
            iterations: ended.iterations,
            converged: ended.converged,
            used: used as u64,
            left_out: (matches.len() - used) as u64,
            share: system.weight.min(1.0),
            covariance: freedom::covariance(&system, &spectrum, &matches, free, &barely),
            center: system.center,
            condition: (free == 0).then(|| spectrum.values[5] / spectrum.values[0]),
            freedoms: freedom::named(&facets, &of_facets, free),
            alternatives: vec![],
            warnings: if share > MUCH { vec![left_out] } else { vec![] },
        })
    }

    fn warnings(&self, result: &Alignment, start: &Found, measured: &Measured) -> Vec<AlignWarning> {
        let mut warnings = result.warnings.clone();
        let size = self.target.bounds.diagonal().min(Aabb::of(measured.points()).diagonal());
        let share = result.median / size;
        warnings.extend((share > POOR).then_some(AlignWarning::Poor { share }));
        warnings.extend(start.scale.map(|factor| AlignWarning::Scale { factor }));
        warnings.extend(start.turned.then_some(AlignWarning::NormalsTurned));
        let count = result.alternatives.len();
        warnings.extend((count > 0).then_some(AlignWarning::Ambiguous { count }));
        warnings.extend(result.freedoms.iter().map(|&f| AlignWarning::Free(f)));
        let few = match measured {
            Measured::Points { points, .. } => start.search.is_some() && points.len() < SPARSE,
            Measured::Mesh(_) => false,
        };
        warnings.extend(few.then_some(AlignWarning::Few { count: measured.points().len() }));
        warnings.extend((!result.converged).then_some(AlignWarning::NotConverged));
        warnings
    }
}

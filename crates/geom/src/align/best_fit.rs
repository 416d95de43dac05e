//! The best fit from any pose: start, iteration, and what the result is worth.

use super::alignment::{CONFUSED_UNIT_RATIOS, POOR_RESIDUAL_SHARE};
use super::freedom::{FREEDOM_STEP_SHARE, twists};
use super::look::Look;
use super::loose::is_symmetry;
use super::sample::{Measured, Samples, on_surface};
use super::settle::Settle;
use super::start::{Candidate, Search};
use super::work::{RIVAL_SAMPLES, START_SAMPLES, Work};
use super::{AlignError, AlignWarning, Alignment, BestFit, Freedom, Start, Target};
use crate::closest::{BoundaryEdges, check_mesh, check_points};
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::Aabb;

/// Samples for choosing among poses. With more than these the iteration first goes over these alone.
const COMPARING_SAMPLES: usize = 5000;
/// With more samples the iteration first goes over a part of them.
const MAX_SINGLE_STAGE_SAMPLES: usize = 100_000;
/// Samples for each one of that part.
const SAMPLES_PER_FIRST_STAGE: usize = 8;
/// Score of a start below which normals are tried the other way round.
const MIN_CERTAIN_SCORE: f64 = 0.6;
/// A search over fewer points now and then finds a wrong pose. In tries with a bracket it was one cloud of 20 points in ten,
/// and none of 25.
const MIN_CERTAIN_POINTS: usize = 50;

/// The motion that brings `measured` onto `reference` with the least weighted mean square distance to its surface. A mesh is
/// weighted by area, points are not. Outliers do not count unless `options` say so.
///
/// From any starting pose, of whole and partial scans, with clutter. The warnings name whatever cannot be told: poses that fit
/// as well, motions that the shape leaves free, inverted normals. They also name a wrong unit, a poor fit, too few points.
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
///     let [a, b, c] = reference.places(face);
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
    if options.lock.is_some() && options.start == Start::Anywhere {
        return Err(AlignError::LockedSearch);
    }
    let boundary_edges = BoundaryEdges::watched(reference.tree, progress)?;
    let work = Work::new(reference, &boundary_edges, options, &samples);
    let mut start = match options.start {
        Start::Anywhere => work.search(&samples, progress)?,
        Start::From(pose) => Found { poses: vec![pose], turned: false, scale: None, search: None },
    };
    let turned = |samples: Samples| if start.turned { samples.turned() } else { samples };
    let samples = turned(samples);
    let subset = samples.thinned(COMPARING_SAMPLES, options.seed);
    // The pose is that of the surface, its figures are those of the points: errors of a scan are independent there at best.
    let all = work.problem(&samples);
    let surface = match measured {
        Measured::Mesh(_) => Some(turned(Samples::of_surface(measured))),
        Measured::Points { .. } => None,
    };
    let whole = surface.as_ref().unwrap_or(&samples);
    let part = (whole.points.len() > MAX_SINGLE_STAGE_SAMPLES)
        .then(|| whole.thinned(whole.points.len() / SAMPLES_PER_FIRST_STAGE, options.seed));
    let part = part.as_ref().map(|p| work.problem(p));
    let surface = surface.as_ref().map(|s| work.problem(s));
    let settle = Settle { work: &work, all, surface, part, subset: &subset };
    let (pose, sigma) = work.choose(&start.poses, &subset, progress)?;
    let mut result = settle.from(pose, sigma, progress)?;
    if let Some(pose) = work.where_all_count(&result, &subset, progress)? {
        result = settle.from(pose, sigma, progress)?;
    }
    let mut warnings = vec![];
    if let Some(search) = start.search.take() {
        let look = Look { settle: &settle, search: &search, samples: &samples };
        warnings = look.around(&mut start.poses, (&mut result, sigma), progress)?;
        start.search = Some(search);
    }
    result.warnings = work.warnings(&result, &start, measured, progress)?;
    result.warnings.extend(warnings);
    Ok(result)
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
        let start_samples = samples.oriented_subset(START_SAMPLES, self.options.seed);
        let mut search = Search::new(self.target, start_samples, self.options.seed, progress)?;
        let mut candidates = search.candidates(&[Rigid::IDENTITY], progress)?;
        let best = |c: &[Candidate]| c.first().map_or(0.0, |c| c.score);
        let as_is = best(&candidates);
        let mut scale = self.scale(&search, as_is, progress)?;
        let mut turned = false;
        if as_is < MIN_CERTAIN_SCORE && scale.is_none() && search.samples.oriented {
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
        // A measured part with a wrong unit lies nowhere: there is no use in looking on.
        let search = scale.is_none().then_some(search);
        Ok(Found { poses, turned, scale, search })
    }

    /// The factor between units by which the measured fits better than as it is.
    fn scale(&self, search: &Search, as_is: f64, progress: &dyn Progress) -> Result<Option<f64>, AlignError> {
        let ratio = search.size_ratio();
        for factor in CONFUSED_UNIT_RATIOS {
            if !(0.8..1.25).contains(&(ratio * factor)) {
                continue;
            }
            let scaled = search.scaled(factor);
            let score = scaled.candidates(&[Rigid::IDENTITY], progress)?.first().map_or(0.0, |c| c.score);
            // A tiny piece lies well on any flat place: what counts is that all of it fits at full size.
            if score > MIN_CERTAIN_SCORE && (score > as_is || ratio < 1.0) {
                return Ok(Some(factor));
            }
        }
        Ok(None)
    }

    /// Whether the reference is the same along a motion.
    fn is_symmetry(&self, motion: &Freedom, progress: &dyn Progress) -> Result<bool, AlignError> {
        let surface = on_surface(self.target.mesh, RIVAL_SAMPLES, self.options.seed);
        twists(&[*motion]).iter().try_fold(true, |same, twist| {
            Ok(same
                && is_symmetry(&self.problem(&surface), twist, FREEDOM_STEP_SHARE * self.radius, progress)?)
        })
    }

    fn warnings(
        &self,
        result: &Alignment,
        start: &Found,
        measured: &Measured,
        progress: &dyn Progress,
    ) -> Result<Vec<AlignWarning>, AlignError> {
        let mut warnings = result.warnings.clone();
        let size = self.target.bounds.diagonal().min(Aabb::of(measured.points()).diagonal());
        let share = result.median / size;
        warnings.extend((share > POOR_RESIDUAL_SHARE).then_some(AlignWarning::Poor { share }));
        warnings.extend(start.scale.map(|factor| AlignWarning::Scale { factor }));
        warnings.extend(start.turned.then_some(AlignWarning::NormalsTurned));
        let count = result.alternatives.len();
        warnings.extend((count > 0).then_some(AlignWarning::Ambiguous { count }));
        for &motion in &result.freedoms {
            warnings.push(match self.is_symmetry(&motion, progress)? {
                true => AlignWarning::Free(motion),
                false => AlignWarning::Undetermined { motion, width: None },
            });
        }
        let undetermined = |&(motion, width)| AlignWarning::Undetermined { motion, width: Some(width) };
        warnings.extend(result.slack.iter().map(undetermined));
        let is_sparse = match measured {
            Measured::Points { points, .. } => start.search.is_some() && points.len() < MIN_CERTAIN_POINTS,
            Measured::Mesh(_) => false,
        };
        warnings.extend(is_sparse.then_some(AlignWarning::FewPoints { count: measured.points().len() }));
        warnings.extend((!result.converged).then_some(AlignWarning::NotConverged));
        Ok(warnings)
    }
}

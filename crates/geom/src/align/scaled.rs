//! The best fit of a part that may be larger or smaller as a whole. The scale is a seventh unknown, on request alone, as it
//! hides errors of the part.
//!
//! Pose and scale are found in turns. A best fit of the scaled part comes first, then one step of the scale in which the pose
//! gives way. The step takes the Schur complement of the pose in the normal equations of all seven. (Björck, Numerical methods
//! for least squares problems, 1996, 2.2.) The steps are Newton's for both together.

use super::alignment::CONFUSED_UNIT_RATIOS;
use super::covariance::cell_of;
use super::icp::Match;
use super::sample::{Measured, Samples};
use super::system::{Constraint, Six, Spectrum, System, slope};
use super::twist::inner;
use super::work::Work;
use super::{AlignError, AlignWarning, Alignment, BestFit, Start, Target, best_fit};
use crate::closest::BoundaryEdges;
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, dot, minus, times};
use std::collections::BTreeMap;

/// Scales that are tried while none fits, beside that of a wrong unit and that of the sizes. A piece of a part tells nothing by
/// its size.
const TRIED_SCALES: [f64; 6] = [0.9, 1.1, 0.8, 1.25, 0.7, 1.4];
/// Median distance over the size up to which a scale fits.
const MAX_FITTING_MEDIAN: f64 = 2e-3;
/// Most alternations between pose and scale.
const MAX_SCALE_TURNS: usize = 30;
/// Share of its own standard uncertainty below which a step of the scale counts as none.
const SETTLED_SCALE_SHARE: f64 = 1e-2;
/// Mean square displacement along the normals per unit of mean square displacement, from which on the scale is determined. A
/// flat part allows any.
const MIN_SCALE_HOLD: f64 = 1e-4;
/// Share by which a scale may differ from a ratio of units that is named.
const UNIT_RATIO_TOLERANCE: f64 = 0.005;

/// How many times as large the measured has to be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// That factor: measured coordinates times it are those that the motion of the fit acts on.
    pub factor: f64,
    /// Its standard uncertainty, the pose being free.
    pub std_uncertainty: f64,
}

impl Scale {
    /// The ratio of units that it is, nearly.
    pub fn unit(&self) -> Option<f64> {
        CONFUSED_UNIT_RATIOS.into_iter().find(|unit| (self.factor / unit - 1.0).abs() <= UNIT_RATIO_TOLERANCE)
    }
}

/// The best fit with a scale: [`best_fit`] of the measured made [`Scale::factor`] times as large, about the origin of its coordinates.
///
/// Cost: two to ten best fits. A scale between those that are tried first may be missed where a small piece of the part is measured.
///
/// # Errors
/// As [`best_fit`]; [`AlignError::ScaleFree`] where the shape does not tell a scale, as that of a plane.
///
/// ```
/// use trueness_geom::align::{best_fit_scaled, BestFit, Measured, Start, Target};
/// use trueness_geom::{closest::Tree, mesh::Mesh, progress::Silent, rigid::Rigid};
/// let reference = Mesh {
///     positions: vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 11.0]],
///     faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
/// };
/// // The same, shrunk by two percent.
/// let positions = reference.positions.iter().map(|p| p.map(|x| 0.98 * x)).collect();
/// let scan = Mesh { positions, faces: reference.faces.clone() };
/// let tree = Tree::build(&reference)?;
/// // All faces count: three of them lie on theirs, and the fourth would be taken for an outlier.
/// let near = BestFit { start: Start::From(Rigid::IDENTITY), robust: false, ..BestFit::default() };
/// let (_, scale) = best_fit_scaled(&Measured::Mesh(&scan), &Target::new(&reference, &tree), &near, &Silent)?;
/// assert!((0.98 * scale.factor - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn best_fit_scaled(
    measured: &Measured,
    reference: &Target,
    options: &BestFit,
    progress: &dyn Progress,
) -> Result<(Alignment, Scale), AlignError> {
    let as_is = best_fit(measured, reference, options, progress)?;
    let unit = as_is.warnings.iter().find_map(|w| match w {
        AlignWarning::Scale { factor } => Some(*factor),
        _ => None,
    });
    let (mut fit, mut scale) = (as_is, Scale { factor: 1.0, std_uncertainty: 0.0 });
    let radius = |measured: &Measured| Samples::all(measured).moments().radius();
    let size = radius(measured);
    for other in unit.into_iter().chain([radius(&Measured::Mesh(reference.mesh)) / size]).chain(TRIED_SCALES)
    {
        if fit.median / scale.factor <= MAX_FITTING_MEDIAN * size || !other.is_normal() {
            continue;
        }
        let there = of_scaled(measured, other, reference, options, progress)?;
        // A smaller part is nearer to anything.
        if there.median / other < fit.median / scale.factor {
            (fit, scale.factor) = (there, other);
        }
    }
    let mut of_surface = 0.0;
    for _ in 0..MAX_SCALE_TURNS {
        let there = scaled(measured, scale.factor);
        let surface = Samples::of_surface(&there.measured());
        let step = Step::new(surface, reference, options, &fit, progress)?;
        of_surface = step.uncertainty;
        // Never to nothing, and to no other sign.
        let by = 1.0 + step.size.clamp(-0.5, 1.0);
        scale.factor *= by;
        // About the middle of the measured.
        let pose = fit.reference_from_measured;
        let shift = times(by - 1.0, minus(pose.translation(), fit.center));
        let there = Rigid::translation_by(shift).after(&pose);
        let near = BestFit { start: Start::From(there), ..*options };
        fit = of_scaled(measured, scale.factor, reference, &near, progress)?;
        if step.size.abs() <= (SETTLED_SCALE_SHARE * step.uncertainty).max(step.rounding) {
            break;
        }
    }
    if options.start == Start::Anywhere {
        fit = of_scaled(measured, scale.factor, reference, options, progress)?;
    }
    // Errors of a scan are independent at its points at best, and facets share them. Corners alone may tell no scale.
    let points = Samples::all(&scaled(measured, scale.factor).measured());
    let of_points = match Step::new(points, reference, options, &fit, progress) {
        Err(AlignError::ScaleFree) => 0.0,
        step => step?.uncertainty,
    };
    scale.std_uncertainty = scale.factor * of_points.max(of_surface);
    fit.warnings.retain(|w| !matches!(w, AlignWarning::Scale { .. }));
    fit.warnings.extend(scale.unit().map(|factor| AlignWarning::Scale { factor }));
    Ok((fit, scale))
}

/// The measured data that the fit owns.
enum Owned {
    Mesh(Mesh),
    Points(Vec<Point>, Option<Vec<Point>>),
}

impl Owned {
    fn measured(&self) -> Measured<'_> {
        match self {
            Owned::Mesh(mesh) => Measured::Mesh(mesh),
            Owned::Points(points, normals) => Measured::Points { points, normals: normals.as_deref() },
        }
    }
}

fn scaled(measured: &Measured, factor: f64) -> Owned {
    let positions = measured.points().iter().map(|p| times(factor, *p)).collect();
    match measured {
        Measured::Mesh(mesh) => Owned::Mesh(Mesh { positions, faces: mesh.faces.clone() }),
        Measured::Points { normals, .. } => Owned::Points(positions, normals.map(<[Point]>::to_vec)),
    }
}

fn of_scaled(
    measured: &Measured,
    factor: f64,
    reference: &Target,
    options: &BestFit,
    progress: &dyn Progress,
) -> Result<Alignment, AlignError> {
    best_fit(&scaled(measured, factor).measured(), reference, options, progress)
}

/// A step of the scale at a pose, relative, and its standard uncertainty.
struct Step {
    size: f64,
    uncertainty: f64,
    /// A step that arithmetic cannot tell from none.
    rounding: f64,
}

impl Step {
    fn new(
        all: Samples,
        reference: &Target,
        options: &BestFit,
        fit: &Alignment,
        progress: &dyn Progress,
    ) -> Result<Step, AlignError> {
        let turned = fit.warnings.contains(&AlignWarning::NormalsTurned);
        let samples = if turned { all.turned() } else { all };
        let edges = BoundaryEdges::watched(reference.tree, progress)?;
        let work = Work::new(reference, &edges, options, &samples);
        let (problem, pose) = (work.problem(&samples), fit.reference_from_measured);
        let mut matches = problem.matches(&pose, f64::INFINITY, progress)?;
        let sigma = problem.deviation(&matches);
        problem.weigh(&mut matches, sigma);
        let flat = |m: &Match| super::system::Equation { hold: Constraint::Plane(m.facet), ..m.equation };
        let system = System::new(&matches, flat, pose.point(problem.mean), problem.radius);
        if system.weight <= 0.0 {
            return Err(AlignError::NoOverlap);
        }
        let row = |m: &Match| slope(m.equation.point, m.facet, system.center, system.radius);
        let grows = |m: &Match| dot(minus(m.equation.point, system.center), m.facet);
        let counts = || matches.iter().filter(|m| m.equation.weight > 0.0);
        let (mut with, mut own): (Six, f64) = ([0.0; 6], 0.0);
        for m in counts() {
            let (row, grows) = (row(m), grows(m));
            (0..6).for_each(|k| with[k] += m.equation.weight * row[k] * grows);
            own += m.equation.weight * grows * grows;
        }
        let spectrum = Spectrum::of(&system);
        // The pose gives way.
        let gives = spectrum.solve(&with, fit.freedoms.len());
        let hold = own - inner(&with, &gives);
        if hold <= MIN_SCALE_HOLD * system.weight * system.radius * system.radius {
            return Err(AlignError::ScaleFree);
        }
        let mut cells: BTreeMap<[i64; 3], f64> = BTreeMap::new();
        for m in counts() {
            let alone = grows(m) - inner(&row(m), &gives);
            *cells.entry(cell_of(m.equation.point, &system)).or_insert(0.0) +=
                m.equation.weight * alone * dot(m.equation.away, m.facet);
        }
        let sum: f64 = cells.values().sum();
        let squares: f64 = cells.values().map(|x| x * x).sum();
        let count = cells.len() as f64;
        let uncertainty = (squares * count / (count - 7.0).max(1.0)).sqrt() / hold;
        Ok(Step { size: -sum / hold, uncertainty, rounding: problem.rounding / problem.radius })
    }
}

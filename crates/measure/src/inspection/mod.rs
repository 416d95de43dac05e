//! A plan and measured data make verdicts: one pure function.

mod align;
mod by_face;
mod cloud;
mod data;
pub mod decision;
mod denoised;
mod derived;
mod deviation;
mod document;
mod doubts;
mod edge;
mod excluded_points;
mod extract_features;
mod faces_view;
mod features;
mod found;
mod measure;
mod measured;
mod missing_feature_hint;
mod model;
mod noise_field;
mod nominals;
mod own_faces;
mod parted;
mod places;
mod pose_noise;
mod readings;
mod seed;
mod sides;
mod stop;
mod uncertainty;
mod uncounted;
mod wrong_numbers;

#[cfg(test)]
mod test_parts;
#[cfg(test)]
mod tests;

pub use crate::characteristic::{Element, ExcludedPoints, MeasuredFeature, Others};
pub use align::{Alignment, Found};
pub use data::{Data, OwnPoints};
pub use deviation::Deviations;
pub use document::document;
pub use faces_view::DrawnFace;
pub use found::Inspection;
pub use model::on_model;
pub use stop::{NominalFault, NotAligned, NotCompared, Stop};
pub use uncertainty::Uncertainty;

use crate::characteristic::Spec;
use crate::noise::{NoSharedNoise, NoiseOrReason, noise_or_reason};
use crate::plan::Plan;
use features::Features;
use nominals::Nominals;
use trueness_geom::noise::{self, NoNoise};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::scan::Scan;
use uncounted::Uncounted;

/// How many steps an inspection has, each counted as it is done: the alignment, the features, their values, those in other
/// poses, those with doubtful points, the uncertainties, the deviations.
pub const STEPS: u64 = 7;

/// Evaluates the plan. The data are moved by the plan's alignment first; then features are taken, then values.
///
/// # Errors
/// [`Stop`]: a datum system that cannot be, a method that an element does not have, a mesh that cannot be searched.
/// What is not measured is no error: it is told of each value.
///
/// ```
/// use trueness_measure::inspection::{Data, OwnPoints, run};
/// use trueness_measure::plan::Plan;
/// let plan = Plan::parse(r#"
/// schema = "trueness/plan/1"
/// feature = [{ id = "A", shape = "plane", points = "a.xyz" }]
/// characteristic = [{ id = "1", kind = "flatness", feature = "A", tolerance = 0.05 }]
/// "#)?;
/// let points = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [9.0, 9.0, 0.04]];
/// let own = OwnPoints { points, planar: false };
/// let data = Data { points: [(0, own)].into(), ..Data::default() };
/// let found = run(&plan, data, &trueness_geom::progress::Silent)?;
/// let value = found.values[0].as_ref().map_err(Clone::clone)?;
/// assert!((value.value - 0.02).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(plan: &Plan, data: Data, progress: &dyn Progress) -> Result<Inspection, Stop> {
    let (counted, progress) = (progress, &Uncounted(progress) as &dyn Progress);
    let nominals = Nominals::new(plan, &data, progress)?;
    let mut resolved = model::resolved(plan, &nominals, progress)?;
    let located = resolved.plan.clone();
    let plan = &located;
    let (mut data, alignment) = align::aligned(plan, data, &nominals, progress)?;
    counted.advance(1);
    let Features { all: features, is_scan, drawn } = features::extracted(plan, &data, &nominals, progress)?;
    let noise = noise(data.measured.as_ref(), is_scan, data.seed, progress)?;
    sides::checked(plan, &features)?;
    resolved.by_part(&features, progress);
    counted.advance(1);
    let doubts = doubts::doubts(plan, &data, &alignment.motion, &features);
    let measured = |spec: &Spec, features: &[MeasuredFeature]| measure::measured(spec, features, progress);
    let all = |features: &[MeasuredFeature]| {
        plan.specs.par_iter().map(|spec| measured(spec, features)).collect::<Result<Vec<_>, Stop>>()
    };
    let values = all(&features)?;
    counted.advance(1);
    let mut in_other_poses = vec![];
    for motion in align::other_poses(&alignment) {
        // One after the other: each is a copy of all that was measured.
        if let Some(other) = align::in_other_pose(plan, &data, &motion, &nominals, progress)? {
            // A page shows the partition of the pose that was found.
            let other = Data { shown: 0, ..other };
            in_other_poses.push(all(&features::extracted(plan, &other, &nominals, progress)?.all)?);
        }
    }
    counted.advance(1);
    // What the values would be with the points of which it is not certain whose they are.
    let whole = extract_features::with_others(plan, &features, progress)?;
    let concerned =
        |spec: &Spec| spec.numbers(&plan.features).into_iter().any(|n| !features[n].others.points.is_empty());
    let with_others = plan
        .specs
        .par_iter()
        .map(|spec| match &whole {
            Some(whole) if concerned(spec) => measured(spec, whole).map(Some),
            _ => Ok(None),
        })
        .collect::<Result<Vec<_>, Stop>>()?;
    counted.advance(1);
    let uncertainties = uncertainty::found(plan, (&data, &alignment), (&features, &noise), progress)?;
    counted.advance(1);
    if progress.cancelled() {
        return Err(Stop::Cancelled);
    }
    let deviations = match &plan.deviation {
        Some(asked) => Some(deviation::deviations(asked, plan, &nominals, &mut data, progress)?),
        None => None,
    };
    counted.advance(1);
    let measured = data.measured;
    Ok(Inspection {
        drawn,
        faces: nominals.face_records(plan),
        specs: plan.specs.clone(),
        notes: resolved.notes,
        features,
        values,
        with_others,
        in_other_poses,
        noise,
        uncertainties,
        measured,
        alignment,
        doubts,
        deviations,
    })
}

/// The noise of what was measured, and how far neighbors share it; or why none is told.
fn noise(
    measured: Option<&Scan>,
    is_scan: bool,
    seed: u64,
    progress: &dyn Progress,
) -> Result<NoiseOrReason, Stop> {
    let Some(measured) = measured else {
        return Ok(Err(NoSharedNoise::NoSurface));
    };
    let found = if is_scan { noise::scan(measured, seed, progress) } else { Err(NoNoise::Drawn) };
    Ok(noise_or_reason(found)?)
}

//! The plan held against the model: a plan that the model itself is far from keeping says something else than its author meant.
//!
//! The features are taken from their nominals, and each characteristic is measured there as it is on the part. Theoretically exact
//! dimensions that the plan does not give are those found so. Those that it gives are held against them:
//!
//! - what keeps the tolerance on the model is meant as it stands: a drawing's numbers beside those of a model;
//! - numbers that keep it only in another reading (signs, order of axes, the frame of the model) are refused with the right ones;
//! - numbers that no part could keep, as its feature is sought where the model has it (`extract` of the feature), are refused too;
//! - what lies between is told with the value.

use super::data::Data;
use super::derived::derived;
use super::extract_features;
use super::nominals::Nominals;
use super::places::places;
use super::readings::{Compared, OfModel, compared, fits_otherwise};
use super::stop::Stop;
use crate::characteristic::{Characteristic, MeasuredFeature, Missing, NotMeasured, Size, Spec};
use crate::plan::Plan;
use crate::requirement::{Feature, Limits, Source};
use trueness_geom::feature::Nominal;
use trueness_geom::fit::Method;
use trueness_geom::progress::Progress;

/// A plan whose exact dimensions are all known.
pub(super) struct Resolved {
    pub plan: Plan,
    /// What is to be said of each characteristic.
    pub notes: Vec<Vec<String>>,
    /// Whether the model has the features of each.
    pub known: Vec<bool>,
}

impl Resolved {
    /// Tells of exact dimensions without a model that the measured part keeps in another reading only.
    pub fn by_part(&mut self, features: &[MeasuredFeature], progress: &dyn Progress) {
        for (n, spec) in self.plan.specs.iter().enumerate().filter(|(n, _)| !self.known[*n]) {
            let all = |numbers: &[usize]| -> Vec<&MeasuredFeature> {
                numbers.iter().map(|n| &features[*n]).collect()
            };
            let datums = spec.datums.iter().map(|d| all(&d.features)).collect();
            let of = OfModel {
                plan: &self.plan,
                spec,
                features: all(&spec.features),
                datums,
                reach: 0.0,
                progress,
            };
            self.notes[n].extend(fits_otherwise(&of));
        }
    }
}

/// The plan with the exact dimensions that the model gives where it gives none itself.
///
/// # Errors
/// [`Stop::Plan`]: exact dimensions, nominal values or classes that the model contradicts.
pub(super) fn resolved(plan: &Plan, nominals: &Nominals, progress: &dyn Progress) -> Result<Resolved, Stop> {
    let model = Model::new(plan, nominals, progress)?;
    let mut resolved = Resolved {
        plan: plan.clone(),
        notes: vec![vec![]; plan.specs.len()],
        known: vec![false; plan.specs.len()],
    };
    for (n, spec) in plan.specs.iter().enumerate() {
        if progress.cancelled() {
            return Err(Stop::Cancelled);
        }
        let Some(measured) = model.of(spec) else { continue };
        resolved.known[n] = true;
        match compared(&measured)? {
            Compared::Alike => (),
            Compared::Exact(basic) => resolved.plan.specs[n].basic = basic,
            Compared::Differs(note) => resolved.notes[n].push(note),
        }
    }
    Ok(resolved)
}

/// Why the model itself contradicts each characteristic of a plan, or why that could never be measured; `None` where nothing is wrong.
///
/// # Errors
/// [`Stop`]: features that the model does not have.
pub fn on_model(plan: &Plan, data: &Data, progress: &dyn Progress) -> Result<Vec<Option<String>>, Stop> {
    let nominals = Nominals::new(plan, data, progress)?;
    let model = Model::new(plan, &nominals, progress)?;
    let mut all = Vec::with_capacity(plan.specs.len());
    for spec in &plan.specs {
        if progress.cancelled() {
            return Err(Stop::Cancelled);
        }
        all.push(contradiction(&model, spec)?);
    }
    Ok(all)
}

/// Why the model contradicts a characteristic.
fn contradiction(model: &Model, spec: &Spec) -> Result<Option<String>, Stop> {
    let Some(of) = model.of(spec) else {
        return Ok(Some("the model has no element where one of its features should be".into()));
    };
    let basic = match compared(&of) {
        Ok(Compared::Alike) => spec.basic,
        Ok(Compared::Exact(basic)) => basic,
        Ok(Compared::Differs(what)) | Err(Stop::Plan { what, .. }) => return Ok(Some(what)),
        Err(stop) => return Err(stop),
    };
    // A size was compared; its opposite points are those of a part.
    if spec.kind.word() == Size.word() {
        return Ok(None);
    }
    let exact = Spec { basic, ..spec.clone() };
    match (spec.kind.measure(&of.measuring(&exact)), spec.limits) {
        (Err(Missing::Cancelled), _) => Err(Stop::Cancelled),
        (Err(Missing::Impossible(why)), _) => Ok(Some(why.to_string())),
        // That the model has few places tells nothing of a part.
        (Err(Missing::NotMeasured(why)), _) if is_of_datums(&why) => Ok(Some(why.to_string())),
        (Ok(value), Limits::Greatest(most)) if value.value > of.rounded(most) => {
            Ok(Some(format!("the model itself has {:.4} there", value.value)))
        }
        _ => Ok(None),
    }
}

/// Whether the datum system is the reason, as it would be on every part.
fn is_of_datums(why: &NotMeasured) -> bool {
    matches!(
        why,
        NotMeasured::Datum(_)
            | NotMeasured::DatumOrFrame(_)
            | NotMeasured::AlongCoordinate { .. }
            | NotMeasured::NotAlongZ
    )
}

/// The features as the model has them.
struct Model<'a> {
    plan: &'a Plan,
    features: Vec<Option<MeasuredFeature>>,
    /// How far from its nominal each is sought, mm.
    reach: Vec<f64>,
    progress: &'a dyn Progress,
}

impl<'a> Model<'a> {
    fn new(plan: &'a Plan, nominals: &Nominals, progress: &'a dyn Progress) -> Result<Model<'a>, Stop> {
        let mut features: Vec<Option<MeasuredFeature>> = Vec::with_capacity(plan.features.len());
        let mut reach: Vec<f64> = vec![];
        for (number, feature) in plan.features.iter().enumerate() {
            let nominal = nominals.of(number, feature);
            let (taken, near) = match (&feature.source, nominal) {
                (Source::Derived { how, of: [a, b] }, _) => {
                    let two = features[*a].as_ref().zip(features[*b].as_ref());
                    let made = two.map(|(a, b)| derived(extract_features::bare(feature), *how, a, b));
                    (made.filter(|made| made.element.is_ok()), reach[*a].max(reach[*b]))
                }
                (_, Some(nominal)) => {
                    (of_nominal(feature, nominal, progress)?, feature.near(nominal).distance)
                }
                (_, None) => (None, 0.0),
            };
            features.push(taken);
            reach.push(near);
        }
        Ok(Model { plan, features, reach, progress })
    }

    /// A characteristic whose features the model has, all of them.
    fn of(&'a self, spec: &'a Spec) -> Option<OfModel<'a>> {
        let all = |numbers: &[usize]| -> Option<Vec<&MeasuredFeature>> {
            numbers.iter().map(|n| self.features[*n].as_ref()).collect()
        };
        Some(OfModel {
            plan: self.plan,
            spec,
            features: all(&spec.features)?,
            datums: spec.datums.iter().map(|d| all(&d.features)).collect::<Option<_>>()?,
            reach: spec.features.iter().fold(0.0, |most, n| self.reach[*n].max(most)),
            progress: self.progress,
        })
    }
}

/// A feature with points of its nominal; `None` where these make no element.
fn of_nominal(
    feature: &Feature,
    nominal: &Nominal,
    progress: &dyn Progress,
) -> Result<Option<MeasuredFeature>, Stop> {
    let mut taken = extract_features::bare(feature);
    taken.nominal = Some(nominal.clone());
    taken.outward = taken.outward.or(extract_features::normal(nominal));
    taken.points = places(nominal);
    taken.areas = vec![1.0; taken.points.len()];
    let exact = Feature { method: Method::Gaussian, ..feature.clone() };
    let taken = extract_features::associated(taken, &exact, progress)?;
    Ok(Some(taken).filter(|taken| taken.element.is_ok()))
}

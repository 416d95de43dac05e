//! A plan and measured data make verdicts: one pure function.

pub mod decision;
mod take;
mod taken;
mod view;

pub use taken::{Element, Taken};
pub use view::View;

use crate::characteristic::{Measuring, Missing, Value};
use crate::plan::{Align, Plan};
use std::collections::BTreeMap;
use std::ops::Range;
use trueness_geom::align::{AlignError, Alignment, BestFit, Measured, Target, best_fit};
use trueness_geom::closest::Tree;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Point;

/// What was measured, in measured coordinates, millimetres.
#[derive(Clone, Debug, Default)]
pub struct Data {
    /// The measured mesh; a cloud has no facets.
    pub measured: Option<Mesh>,
    /// The nominal mesh, where the plan aligns to it.
    pub reference: Option<Mesh>,
    /// The points of features that have files of their own, by the number of the feature.
    pub points: BTreeMap<usize, OwnPoints>,
    /// Seed of the random choices of the alignment.
    pub seed: u64,
}

/// Points of a feature's own.
#[derive(Clone, Debug, Default)]
pub struct OwnPoints {
    /// The points.
    pub points: Vec<Point>,
    /// Whether they have two coordinates only.
    pub planar: bool,
}

/// Why an inspection stops without an answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Stop {
    /// The plan asks for what cannot be, as the data show.
    #[error("{what}")]
    Plan {
        /// Bytes of the plan's text.
        span: Range<usize>,
        /// What is wrong.
        what: String,
    },
    /// The measured mesh cannot be searched.
    #[error("{0}")]
    Mesh(String),
    /// The measured data could not be aligned.
    #[error("the measured data cannot be aligned to the reference: {0}")]
    Align(String),
    /// The result is no longer wanted.
    #[error("cancelled")]
    Cancelled,
}

impl From<Cancelled> for Stop {
    fn from(_: Cancelled) -> Stop {
        Stop::Cancelled
    }
}

/// All features and values of a plan.
#[derive(Clone, Debug)]
pub struct Inspection {
    /// The features, in the plan's order.
    pub features: Vec<Taken>,
    /// The values of the characteristics, in the plan's order, or why there are none.
    pub values: Vec<Result<Value, String>>,
    /// The measured data where they were evaluated: aligned.
    pub measured: Option<Mesh>,
    /// What took them there: reference from measured.
    pub motion: Rigid,
    /// The best fit, where that was the way.
    pub best_fit: Option<Alignment>,
}

/// Evaluates the plan. The data are moved by the plan's alignment first; then features are taken, then values.
///
/// # Errors
/// [`Stop`]: a datum system that cannot be, a method that an element does not have, a mesh that cannot be searched.
/// What is not measured is no error: it is told of each value.
///
/// ```
/// use trueness_inspect::inspection::{Data, OwnPoints, run};
/// use trueness_inspect::plan::Plan;
/// let plan = Plan::parse(r#"
/// schema = "trueness/plan/1"
/// feature = [{ id = "A", shape = "plane", points = "a.xyz" }]
/// characteristic = [{ id = "1", kind = "flatness", feature = "A", tolerance = 0.05 }]
/// "#)?;
/// let points = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [9.0, 9.0, 0.04]];
/// let own = OwnPoints { points, planar: false };
/// let data = Data { points: [(0, own)].into(), ..Data::default() };
/// let found = run(&plan, data, &trueness_geom::progress::Silent)?;
/// let value = found.values[0].as_ref().map_err(String::as_str)?;
/// assert!((value.value - 0.02).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(plan: &Plan, data: Data, progress: &dyn Progress) -> Result<Inspection, Stop> {
    let (data, motion, best_fit) = aligned(plan, data, progress)?;
    let features = take::features(plan, &data, progress)?;
    let mut values = Vec::with_capacity(plan.specs.len());
    for spec in &plan.specs {
        let of = |numbers: &[usize]| -> Vec<&Taken> { numbers.iter().map(|n| &features[*n]).collect() };
        let (own, datums) = (of(&spec.features), of(&spec.datums));
        let measuring = Measuring { spec, features: &own, datums: &datums, progress };
        values.push(match spec.kind.measure(&measuring) {
            Ok(value) if value.value.is_finite() => Ok(value),
            Ok(_) => Err("the value is not a finite number".into()),
            Err(Missing::NotMeasured(reason)) => Err(reason),
            Err(Missing::Cancelled) => return Err(Stop::Cancelled),
            Err(Missing::Impossible(what)) => {
                let what = format!("characteristic \"{}\": {what}", spec.id);
                return Err(Stop::Plan { span: spec.span.clone(), what });
            }
        });
    }
    if progress.cancelled() {
        return Err(Stop::Cancelled);
    }
    Ok(Inspection { features, values, measured: data.measured, motion, best_fit })
}

/// The data where the plan's alignment takes them, the motion, and the fit that found it.
fn aligned(
    plan: &Plan,
    mut data: Data,
    progress: &dyn Progress,
) -> Result<(Data, Rigid, Option<Alignment>), Stop> {
    let (motion, fit) = match &plan.align {
        Align::None => return Ok((data, Rigid::IDENTITY, None)),
        Align::Given(motion) => (*motion, None),
        Align::BestFit => {
            let fit = best_fitted(&data, progress)?;
            (fit.reference_from_measured, Some(fit))
        }
    };
    let own = data.points.values_mut().flat_map(|own| own.points.iter_mut());
    let mesh = data.measured.iter_mut().flat_map(|mesh| mesh.positions.iter_mut());
    for p in own.chain(mesh) {
        *p = motion.point(*p);
    }
    Ok((data, motion, fit))
}

/// The best fit of the measured data onto the reference.
fn best_fitted(data: &Data, progress: &dyn Progress) -> Result<Alignment, Stop> {
    let (Some(measured), Some(reference)) = (&data.measured, &data.reference) else {
        return Err(Stop::Align("one of them is not there".into()));
    };
    let failed = |e: AlignError| match e {
        AlignError::Cancelled(e) => e.into(),
        e => Stop::Align(e.to_string()),
    };
    let tree = Tree::build_watched(reference, progress).map_err(|e| failed(e.into()))?;
    let points = &measured.positions;
    let measured = match measured.faces.is_empty() {
        true => Measured::Points { points, normals: None },
        false => Measured::Mesh(measured),
    };
    let options = BestFit { seed: data.seed, ..BestFit::default() };
    best_fit(&measured, &Target::new(reference, &tree), &options, progress).map_err(failed)
}

//! The alignment of a plan.

use super::data::Data;
use super::nominals::Nominals;
use super::stop::{NotAligned, Stop};
use super::{MeasuredFeature, deviation, doubts, features};
use crate::characteristic::{Missing, datum_source};
use crate::compare::Regions;
use crate::plan::{Align, Plan};
use std::ops::Range;
use trueness_geom::align::{
    self, AlignError, AlignWarning, BestFit, ExactSurface, InZones, Measured, Minimax, RowFit, Target,
    best_fit, into_zones, minimax,
};
use trueness_geom::closest::Tree;
use trueness_geom::deviation::surface::{ReferenceSurface, SurfaceOptions};
use trueness_geom::feature::Nominal;
use trueness_geom::progress::Progress;
use trueness_geom::rigid::Rigid;
use trueness_geom::scan::Scan;
use trueness_geom::space::{Point, Vector, dot, times};
use trueness_geom::zone::datum::{Datum, DatumError, Rule, System};

/// What brought the measured data where they are evaluated.
#[derive(Clone, Debug)]
pub struct Alignment {
    /// Reference from measured.
    pub motion: Rigid,
    /// What was found on the way.
    pub found: Found,
}

/// What was found on the way of an alignment.
#[derive(Clone, Debug)]
pub enum Found {
    /// Nothing was looked for.
    Nothing,
    /// A best fit, also one that an alignment by datums began with.
    BestFit(Box<align::Alignment>),
    /// The least greatest distance, and the best fit that it began with.
    Chebyshev(Minimax, Box<align::Alignment>),
    /// The least greatest excess over the zones, and the best fit that it began with.
    Zones(InZones, Box<align::Alignment>),
    /// A fit of pairs or reference points, and the corners of the part.
    Rows(RowFit, Vec<Point>),
}

impl Found {
    /// The best fit that was found, or that it began with.
    fn best_fit(&self) -> Option<&align::Alignment> {
        match self {
            Found::BestFit(fit) | Found::Chebyshev(_, fit) | Found::Zones(_, fit) => Some(fit),
            Found::Nothing | Found::Rows(..) => None,
        }
    }
    /// Whether the facets of the measured mesh were found to point inward.
    fn turned(&self) -> bool {
        self.best_fit().is_some_and(|fit| fit.warnings.contains(&AlignWarning::NormalsTurned))
    }
}

/// The data where the plan's alignment takes them, and how.
pub(super) fn aligned(
    plan: &Plan,
    mut data: Data,
    nominals: &Nominals,
    progress: &dyn Progress,
) -> Result<(Data, Alignment), Stop> {
    let rows = |fit: Result<RowFit, AlignError>| {
        // The places stand in the plan.
        let fit = fit.map_err(|e| failed(e).of_every_part())?;
        // What is evaluated lies on the part, also where there is no mesh of it.
        let corners = match (&data.reference, &data.measured) {
            (Some(reference), _) => reference.bounds().corners().to_vec(),
            (None, Some(measured)) => {
                measured.bounds().corners().map(|p| fit.reference_from_measured.point(p)).to_vec()
            }
            (None, None) => vec![],
        };
        let motion = fit.reference_from_measured;
        Ok::<_, Stop>(Alignment { motion, found: Found::Rows(fit, corners) })
    };
    let mut alignment = match &plan.align {
        Align::None => Alignment { motion: Rigid::IDENTITY, found: Found::Nothing },
        Align::Given(motion) | Align::Datum { start: Some(motion), .. } => {
            Alignment { motion: *motion, found: Found::Nothing }
        }
        Align::Datum { start: None, .. } if data.measured.is_none() || data.reference.is_none() => {
            Alignment { motion: Rigid::IDENTITY, found: Found::Nothing }
        }
        Align::BestFit | Align::Chebyshev | Align::Zones | Align::Datum { start: None, .. } => {
            best_fitted(plan, &data, nominals, progress)?
        }
        Align::Pairs { measured, nominal, weights } => rows(align::pairs(measured, nominal, Some(weights)))?,
        Align::Rps { rows: held, start } => rows(align::constrained(held, *start))?,
    };
    if alignment.found.turned()
        && let Some(Scan::Mesh(mesh)) = &mut data.measured
    {
        // The features must find the sides that the alignment has found.
        mesh.faces.iter_mut().for_each(|f| f.swap(1, 2));
    }
    if alignment.motion != Rigid::IDENTITY {
        moved(&mut data, &alignment.motion);
    }
    let onto = onto_datums(plan, &mut data, nominals, progress).map_err(|stop| match stop {
        Stop::Align { reason, of_part } => {
            let hint = doubts::unit(plan, &data, &alignment.motion, alignment.found.best_fit());
            let reason = match hint {
                Some(hint) => NotAligned::InOtherUnit { reason: Box::new(reason), hint },
                None => reason,
            };
            Stop::Align { reason, of_part }
        }
        stop => stop,
    })?;
    if let Some(motion) = onto {
        alignment.motion = motion.after(&alignment.motion);
    }
    Ok((data, alignment))
}

/// Moves data that lie near their place onto the datums of the plan's alignment, where it has such: how.
fn onto_datums(
    plan: &Plan,
    data: &mut Data,
    nominals: &Nominals,
    progress: &dyn Progress,
) -> Result<Option<Rigid>, Stop> {
    let Align::Datum { datums, rule, span, .. } = &plan.align else { return Ok(None) };
    let taken = features::extracted(plan, data, nominals, progress)?.all;
    let motion = by_datums(&taken, datums, *rule, span, progress)?;
    moved(data, &motion);
    Ok(Some(motion))
}

/// Poses that are looked at beside the one taken, at most: a brick looks the same in four.
const OTHER_POSES: usize = 8;

/// The motions that take aligned data to other poses in which they fit about as well, some of them.
pub(super) fn other_poses(alignment: &Alignment) -> Vec<Rigid> {
    let alternatives = alignment.found.best_fit().map_or(&[][..], |fit| &fit.alternatives);
    let back = alignment.motion.inverse();
    let some = alternatives.iter().take(OTHER_POSES);
    some.map(|a| a.reference_from_measured.after(&back)).collect()
}

/// A copy of aligned data in another pose; `None` where the plan's datums cannot be there: it is not the pose.
pub(super) fn in_other_pose(
    plan: &Plan,
    data: &Data,
    motion: &Rigid,
    nominals: &Nominals,
    progress: &dyn Progress,
) -> Result<Option<Data>, Stop> {
    let mut other = data.clone();
    moved(&mut other, motion);
    match onto_datums(plan, &mut other, nominals, progress) {
        Ok(_) => Ok(Some(other)),
        Err(Stop::Plan { .. } | Stop::Align { of_part: true, .. }) => Ok(None),
        Err(stop) => Err(stop),
    }
}

fn moved(data: &mut Data, motion: &Rigid) {
    let own = data.points.values_mut().flat_map(|own| own.points.iter_mut());
    let measured = data.measured.iter_mut().flat_map(Scan::points_mut);
    for p in own.chain(measured) {
        *p = motion.point(*p);
    }
    data.normals.iter_mut().for_each(|n| *n = motion.vector(*n));
}

pub(super) fn failed(e: AlignError) -> Stop {
    match e {
        AlignError::Cancelled(e) => e.into(),
        e => NotAligned::Search(e).into(),
    }
}

/// The best fit of the measured data onto the reference, and from there the least greatest distance or excess, if that is what counts.
fn best_fitted(
    plan: &Plan,
    data: &Data,
    nominals: &Nominals,
    progress: &dyn Progress,
) -> Result<Alignment, Stop> {
    let (Some(measured), Some(reference)) = (&data.measured, &data.reference) else {
        return Err(NotAligned::NotThere.into());
    };
    let tree = Tree::build_watched(reference, progress).map_err(|e| failed(e.into()).of_every_part())?;
    let measured = Measured::from(measured);
    let options = BestFit { seed: data.seed, ..BestFit::default() };
    let exact = data.faces.as_deref().map(|faces| faces as &dyn ExactSurface);
    let target = Target::new(reference, &tree).drawing(exact);
    let fit = best_fit(&measured, &target, &options, progress).map_err(failed)?;
    if let (Align::Zones, Some(asked)) = (&plan.align, &plan.deviation) {
        let surface = ReferenceSurface::new(&tree, reference, &SurfaceOptions::default(), progress)
            .map_err(|e| Stop::from(NotAligned::Reference(e)).of_every_part())?;
        let rules = deviation::regions(asked, plan, nominals, reference)?;
        let regions = Regions::new(&rules, reference, &tree, data.seed, progress)
            .map_err(|e| Stop::from(NotAligned::Region(e)).of_every_part())?;
        let zones = |face, place: &_| regions.allowed(face, place, asked.tolerance);
        let found =
            into_zones(&measured, &target, &surface, &zones, &fit, &options, progress).map_err(failed)?;
        let motion = found.reference_from_measured;
        return Ok(Alignment { motion, found: Found::Zones(found, Box::new(fit)) });
    }
    if plan.align == Align::Chebyshev {
        let found = minimax(&measured, &target, &fit, &options, progress).map_err(failed)?;
        let motion = found.reference_from_measured;
        return Ok(Alignment { motion, found: Found::Chebyshev(found, Box::new(fit)) });
    }
    Ok(Alignment { motion: fit.reference_from_measured, found: Found::BestFit(Box::new(fit)) })
}

/// The motion that lays the frame of the measured datums on that of the nominal ones.
pub(super) fn by_datums(
    taken: &[MeasuredFeature],
    datums: &[usize],
    rule: Rule,
    span: &Range<usize>,
    progress: &dyn Progress,
) -> Result<Rigid, Stop> {
    let wrong = |what: String| Stop::Plan { span: span.clone(), what };
    let impossible = |e: DatumError| match Missing::from(e) {
        Missing::Cancelled => Stop::Cancelled,
        missing => wrong(format!("alignment by datums: {missing}")),
    };
    // How a part was made is no fault of the plan, whose nominals make a system.
    let of_part = |missing: Missing| match missing {
        Missing::Cancelled => Stop::Cancelled,
        Missing::NotMeasured(reason) => NotAligned::Datum(reason).into(),
        Missing::Impossible(reason) => NotAligned::Datums(reason).into(),
    };
    let mut nominals = vec![];
    let mut sources = vec![];
    for &n in datums {
        let of = &taken[n];
        let nominal = of.nominal.as_ref().map(nominal_datum);
        nominals.push(nominal.ok_or_else(|| wrong(format!("feature \"{}\" has no nominal", of.id)))?);
        sources.push(vec![datum_source(of, of).map_err(of_part)?]);
    }
    let nominal = System::of(&nominals).map_err(impossible)?;
    if !nominal.free.is_none() {
        let what = "the datums leave degrees of freedom open; name datums that hold all six";
        return Err(wrong(what.into()));
    }
    let measured = System::associated(&sources, rule, progress).map_err(|e| of_part(e.into()))?;
    // An axis has no sense of its own: it takes that of the model.
    let facing: Vec<Datum> = measured.datums.iter().zip(&nominals).map(|(m, n)| faced(*m, *n)).collect();
    let measured = System::of(&facing).map_err(|e| of_part(e.into()))?;
    Ok(nominal.frame.inverse().after(&measured.frame))
}

/// The datum that a nominal feature is.
fn nominal_datum(nominal: &Nominal) -> Datum {
    match nominal {
        Nominal::Plane { point, normal, .. } => Datum::Plane { point: *point, normal: *normal },
        Nominal::Cylinder { point, direction, .. } | Nominal::Edge { point, direction, .. } => {
            Datum::Axis { point: *point, direction: *direction }
        }
        Nominal::Cone { apex, direction, .. } => Datum::Axis { point: *apex, direction: *direction },
        Nominal::Sphere { center, .. } => Datum::Point(*center),
    }
}

fn faced(measured: Datum, nominal: Datum) -> Datum {
    let like = |d: Vector, n: Vector| if dot(d, n) < 0.0 { times(-1.0, d) } else { d };
    match (measured, nominal) {
        (Datum::Axis { point, direction }, Datum::Axis { direction: n, .. }) => {
            Datum::Axis { point, direction: like(direction, n) }
        }
        (Datum::Plane { point, normal }, Datum::Plane { normal: n, .. }) => {
            Datum::Plane { point, normal: like(normal, n) }
        }
        _ => measured,
    }
}

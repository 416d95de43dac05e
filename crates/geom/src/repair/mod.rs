//! Mending what [`check`] finds, without moving a vertex.
//!
//! [`repair`] goes through the steps of [`STEPS`], one file and one line each, again and again until nothing is left to
//! do. Steps only ever add vertices and let facets name others, so every place that stays keeps its bits. Every change is
//! listed. The result of a step is decided exactly where [`check`] decides exactly.

mod change;
mod degenerate;
mod duplicates;
mod edges;
mod effect;
mod enclosed;
mod error;
mod fins;
mod holes;
mod islands;
mod measure;
mod not_finite;
mod options;
mod orient;
mod outward;
mod pairs;
mod rounds;
mod same;
mod scraps;
mod self_intersections;
mod split;
mod step;
mod stitch;
mod t_junctions;
#[cfg(test)]
mod tests;
mod union;
mod work;

pub use change::Change;
pub use effect::Effect;
pub use enclosed::{Enclosed, NotEnclosed};
pub use error::RepairError;
pub use measure::{Counts, Deviation, DeviationError, Way};
pub use options::{Holes, Options};
pub use step::Step;

use crate::arrange::ArrangeError;
use crate::check::{self, Known, Report};
use crate::closest::sane_vertex;
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::space::Point;
use crate::topology::weld::{WeldError, as_it_is, compact, rejoined};
use measure::way;
use rounds::{Keeper, Kept, Place, go_through};
use same::Same;
use std::sync::Arc;
use work::Work;

/// All steps, in the order in which they are done.
pub const STEPS: [&Step; 15] = [
    &not_finite::STEP,
    &stitch::STEP,
    &degenerate::STEP,
    &union::STEP,
    &duplicates::STEP,
    &t_junctions::STEP,
    &fins::STEP,
    &orient::STEP,
    &split::EDGES,
    &self_intersections::STEP,
    &holes::STEP,
    &scraps::STEP,
    &split::VERTICES,
    &outward::STEP,
    &islands::STEP,
];

impl Default for Options {
    /// All steps; holes up to a quarter of their shell.
    fn default() -> Options {
        Options {
            steps: STEPS.iter().map(|s| s.name).collect(),
            gap: None,
            stitch: None,
            holes: Holes::UpTo(0.25),
            islands: None,
            single: false,
        }
    }
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Repaired {
    /// The mended mesh. Vertices that stayed keep their bits and their order; new ones follow.
    pub mesh: Mesh,
    /// All changes, in the order in which they were made.
    pub changes: Vec<Change>,
    /// How often the steps were gone through.
    pub rounds: usize,
    /// What the check said before.
    pub before: Report,
    /// What it says now.
    pub after: Report,
    /// Vertices and facets that stayed, came and went.
    pub counts: Counts,
    /// What became of the places that the mesh encloses.
    pub effect: Effect,
    /// Steps that were not done, because with them some defect would have become more frequent, or surface would have been removed
    /// and the mesh still not been sound.
    pub taken_back: Vec<&'static str>,
    /// Vertices that were rounded to single precision before anything was decided: on request, or because shells could not be
    /// united otherwise.
    pub rounded: Rounded,
    /// Why closed shells that meet were not united, if they were not.
    pub not_united: Option<ArrangeError>,
}

impl Repaired {
    /// Distances between `before`, the mesh that was repaired, and the result, both ways.
    ///
    /// Each facet is asked about at its corners, the middles of its edges and its middle, exactly to the nearest place of
    /// the other mesh; facets that both have are at distance 0 and not asked about. So the mean is that of the whole
    /// surface, and the maximum falls short by less than a third of the longest edge of a facet that changed. Of a mesh
    /// that encloses places only what bounds them counts as old surface; of facets that met others [`Effect::surface`]
    /// tells the distance.
    ///
    /// # Errors
    /// [`MeshError`](crate::closest::MeshError) where one of them has no facet or a coordinate that is not finite,
    /// [`QueryError`](crate::closest::QueryError) if cancelled.
    pub fn deviation(&self, before: &Mesh, progress: &dyn Progress) -> Result<Deviation, DeviationError> {
        let mut there = way((before, &self.effect.inside), &self.mesh, progress)?;
        there.max = there.max.max(self.effect.surface.unwrap_or(0.0));
        Ok(Deviation { there, back: way((&self.mesh, &Same::default()), before, progress)? })
    }
}

/// What rounding the input has changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rounded {
    /// Vertices.
    pub vertices: u64,
    /// Greatest change of a coordinate, mm.
    pub farthest: f64,
}

/// Torn holes are widened by no more than this share of the whole area, all together.
const WIDEN: f64 = 0.25;

/// Steps that remove surface so that what is left can be closed. Where it is not sound even so, they are not done.
const LOSING: [&str; 2] = [self_intersections::STEP.name, scraps::STEP.name];

/// Mends `mesh`. Vertices at the same place become one first.
///
/// A mesh that is sound comes back as it is. Any mesh will do, however broken, whose finite coordinates are 0 or from 1e-50
/// to 1e45 mm; what cannot be mended stays, and [`Repaired::after`] lists it. No defect that makes a mesh unsound is there
/// more often than before, and what was closed stays closed: where the steps together would end worse, it is done without
/// one of them, without the last of them, or not at all. Crossing facets and loose sheets are removed only where the rest
/// then is sound; facets that are not finite always are, and what is compared is the mesh without them. The result is the
/// same for any number of threads. Shells whose union cannot be written as they are, are united with all vertices rounded to single
/// precision, where the mesh then is sound and no vertex goes farther than a millionth of the diagonal ([`Repaired::rounded`]).
/// Cost: for each step that changes something about as much as a check; filling holes up to
/// the cube of 100 for each ring; what ends worse twice more for each step that changed something, from where it first did;
/// all of it twice where vertices are rounded.
///
/// # Errors
/// [`RepairError`].
pub fn repair(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<Repaired, RepairError> {
    let exact = repaired(mesh, options, progress)?;
    let left_out = exact.taken_back.contains(&union::STEP.name)
        || matches!(exact.not_united, Some(ArrangeError::Unresolved { .. } | ArrangeError::Open { .. }));
    if exact.after.sound || !left_out || options.single || !is_fine_in_single(mesh) {
        return Ok(exact);
    }
    let single = repaired(mesh, &Options { single: true, ..options.clone() }, progress)?;
    Ok(if single.after.sound { single } else { exact })
}

/// Whether single precision takes no vertex farther than a trifle of the size.
fn is_fine_in_single(mesh: &Mesh) -> bool {
    /// Of the diagonal.
    const TRIFLE: f64 = 1e-6;
    let bounds = mesh.finite_bounds();
    let most = bounds.min.iter().chain(&bounds.max).fold(0.0, |most: f64, x| most.max(x.abs()));
    3f64.sqrt() * 0.5 * f64::from(f32::EPSILON) * most <= TRIFLE * bounds.diagonal()
}

/// As [`repair`], in the precision of `options` alone.
fn repaired(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<Repaired, RepairError> {
    let check_options = check::Options { gap: options.gap, ..check::Options::default() };
    in_range(mesh)?;
    let mut base = Work::new(as_it_is(mesh)?, options, progress)?;
    let before = base.report(&check_options)?;
    let (start, mut rounded) = match options.single {
        true => in_single(base.mesh())?,
        false => (None, Rounded::default()),
    };
    let mut start = match start {
        Some(mesh) => Work::new(mesh, options, progress)?,
        None => base.again(options),
    };
    let soup = start.soup()?;
    let attempt = |without: &[&'static str], from: Option<&Kept>| {
        // Bodies that are not united stay whole: what crosses is not torn out in their place.
        let torn = without.contains(&union::STEP.name).then_some(self_intersections::STEP.name);
        let is_wanted = |s: &&str| !without.contains(s) && torn != Some(*s);
        let steps = options.steps.iter().copied().filter(is_wanted).collect();
        attempt((&start, from), &Options { steps, ..options.clone() }, (&before, &check_options))
    };
    // Facets with a coordinate that is not finite are no surface: what the others are without them is what shall not get worse.
    let mut finite = match before.found("not_finite_facets").map_or(0, |found| found.count) {
        0 => None,
        _ => Some(attempt(&names_but(not_finite::STEP.name), None)?),
    };
    let least = finite.as_ref().map_or(&before, |finite| &finite.after).clone();
    let mut done = match (soup, finite.take_if(|_| soup.is_some())) {
        (None, _) => attempt(&[], None)?,
        (Some(_), Some(finite)) => finite,
        (Some(_), None) => Attempt::none(&mut base, &before)?,
    };
    done.not_united = soup.or(done.not_united);
    let mut taken_back = vec![];
    let mut lost = done.did(&LOSING);
    if !done.after.sound && !lost.is_empty() {
        // Surface was removed in vain: it shall stay.
        done = attempt(&lost, None)?;
        taken_back.append(&mut lost);
    }
    if worse(&least, &done.after) {
        (done, taken_back) = match without_some(&attempt, &done, &taken_back, &least)? {
            Some(found) => found,
            None => match finite {
                Some(finite) => (finite, names_but(not_finite::STEP.name)),
                None => {
                    rounded = Rounded::default();
                    (Attempt::none(&mut base, &before)?, names_but(""))
                }
            },
        };
        taken_back.retain(|name| options.steps.contains(name));
    }
    let Attempt { mesh, known, changes, rounds, after, counts, not_united, lost, kept } = done;
    drop(kept);
    let of_start = (rounded.vertices > 0).then_some((&start, rounded.farthest));
    let effect = Effect::of((&base, &before), of_start, (&mesh, &known, &lost), options)?;
    Ok(Repaired { mesh, changes, rounds, before, after, counts, effect, taken_back, rounded, not_united })
}

/// An error where a product of finite coordinates could leave the range of numbers.
fn in_range(mesh: &Mesh) -> Result<(), RepairError> {
    let finite = |p: &Point| sane_vertex(&p.map(|x| if x.is_finite() { x } else { 0.0 }));
    match mesh.positions.par_iter().position_first(|p| !finite(p)) {
        Some(vertex) => Err(RepairError::Range(vertex as u32)),
        None => Ok(()),
    }
}

/// The names of all steps but this one.
fn names_but(name: &str) -> Vec<&'static str> {
    STEPS.iter().map(|s| s.name).filter(|n| *n != name).collect()
}

/// The steps without one of those that changed something in `done`, or without the last ones of these, so that nothing is worse than
/// `least`; and all that were left out, with those left out before.
fn without_some<'a>(
    attempt: &impl Fn(&[&'static str], Option<&Kept>) -> Result<Attempt<'a>, RepairError>,
    done: &Attempt<'a>,
    left_out: &[&'static str],
    least: &Report,
) -> Result<Option<(Attempt<'a>, Vec<&'static str>)>, RepairError> {
    // Tearing opens what is closed: it is the first to be done without.
    let tearing = self_intersections::STEP.name;
    let singly = done.did(&[&[tearing][..], &names_but(tearing)].concat());
    let in_turn = done.did(&names_but(""));
    let last = (2..in_turn.len()).map(|n| in_turn[in_turn.len() - n..].to_vec());
    for tried in singly.into_iter().map(|name| vec![name]).chain(last) {
        let without = [left_out, &tried].concat();
        // The presence of these two changes what other steps do.
        let alone = !tried.iter().any(|name| [union::STEP.name, tearing].contains(name));
        let from = if alone { Kept::before(&done.kept, &tried) } else { None };
        let next = attempt(&without, from)?;
        if !worse(least, &next.after) {
            return Ok(Some((next, without)));
        }
    }
    Ok(None)
}

/// Whether a defect that makes a mesh unsound is there more often, or all surface is gone.
fn worse(before: &Report, after: &Report) -> bool {
    if before.properties.area > 0.0 && after.properties.area == 0.0 {
        return true;
    }
    let count = |report: &Report, name: &str| report.found(name).map_or(0, |found| found.count);
    let errors = check::KINDS.iter().filter(|kind| kind.severity == check::Severity::Error);
    errors.map(|kind| kind.name).any(|name| count(after, name) > count(before, name))
}

/// What some steps came to.
struct Attempt<'a> {
    mesh: Mesh,
    known: Arc<Known>,
    changes: Vec<Change>,
    rounds: usize,
    after: Report,
    counts: Counts,
    not_united: Option<ArrangeError>,
    lost: Vec<[Point; 3]>,
    /// States on the way.
    kept: Vec<Kept<'a>>,
}

impl Attempt<'_> {
    /// Which of these steps changed something, in the order given.
    fn did(&self, steps: &[&'static str]) -> Vec<&'static str> {
        steps.iter().copied().filter(|name| self.changes.iter().any(|c| c.step == *name)).collect()
    }

    /// Nothing done.
    fn none(base: &mut Work, before: &Report) -> Result<Self, RepairError> {
        Ok(Attempt {
            mesh: base.mesh().clone(),
            known: base.known()?,
            changes: vec![],
            rounds: 0,
            after: before.clone(),
            counts: Counts::of(base.mesh(), base.mesh()),
            not_united: None,
            lost: vec![],
            kept: vec![],
        })
    }
}

/// Goes through the steps of `options`, from the start or from a state on the way to which these steps have not differed.
fn attempt<'a>(
    (start, from): (&Work<'a>, Option<&Kept>),
    options: &Options,
    (before, check_options): (&Report, &check::Options),
) -> Result<Attempt<'a>, RepairError> {
    let wanted = |(_, step): &(usize, &'static Step)| options.steps.contains(&step.name);
    let steps: Vec<(usize, &'static Step)> = STEPS.into_iter().enumerate().filter(wanted).collect();
    let mut keeper = Keeper { options: start.options, progress: start.progress, kept: vec![] };
    let (mut work, mut rounds);
    if let Some(from) = from {
        work = from.work.copy(options, start.progress);
        rounds = go_through(&mut work, &steps, from.place(), None)?;
    } else {
        work = start.again(options);
        work.may_widen = WIDEN * before.properties.area;
        rounds = go_through(&mut work, &steps, Place::START, Some(&mut keeper))?;
    }
    if work.widened && work.has_torn_hole()? {
        // All for nothing: what was torn out in vain shall stay.
        work = start.again(options);
        rounds = go_through(&mut work, &steps, Place::START, None)?;
    }
    let mut counts = Counts::of(start.mesh(), work.mesh());
    if !work.changes.is_empty() {
        let joined = rejoined(work.mesh().clone())?;
        let same = joined.faces == work.mesh().faces;
        if !same {
            counts = Counts::of(start.mesh(), &joined);
        }
        work.compacted(compact(joined, 0), same);
    }
    let after = work.report(check_options)?;
    let (known, not_united) = (work.known()?, work.not_united);
    let (changes, lost) = (std::mem::take(&mut work.changes), std::mem::take(&mut work.lost));
    let kept = keeper.kept;
    Ok(Attempt { mesh: work.into_mesh(), known, changes, rounds, after, counts, not_united, lost, kept })
}

/// The mesh in single precision, if that is another; of vertices that fall upon each other facets name the first.
fn in_single(mesh: &Mesh) -> Result<(Option<Mesh>, Rounded), WeldError> {
    let mut single = mesh.clone();
    let mut rounded = Rounded::default();
    for p in single.positions.iter_mut() {
        let near = p.map(|x| f64::from(x as f32));
        // A coordinate beyond the range stays: the format has the last word.
        let change =
            (0..3).filter(|k| near[*k].is_finite()).map(|k| (near[k] - p[k]).abs()).fold(0.0, f64::max);
        if change > 0.0 {
            rounded.vertices += 1;
            rounded.farthest = rounded.farthest.max(change);
            *p = std::array::from_fn(|k| if near[k].is_finite() { near[k] } else { p[k] });
        }
    }
    let single = if rounded.vertices > 0 { Some(rejoined(single)?) } else { None };
    Ok((single, rounded))
}

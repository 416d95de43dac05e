//! Repair of the findings of [`check`], without moving a vertex.
//!
//! [`repair`] goes through the steps of [`STEPS`] (one file and one line each) in rounds, until a round changes
//! nothing. A step makes a new `State` of the one before (`state`): it adds vertices, and removes, adds or renumbers
//! facets, but never writes a coordinate. So every vertex that stays keeps its bits. Every change is listed. A step
//! decides exactly wherever [`check`] does.
//!
//! Where the steps together make the mesh worse, they are gone through again without one of them. That begins at the
//! state before that step first changed something (`rounds`).

mod change;
mod crowded;
mod degenerate;
mod duplicates;
mod edges;
mod effect;
mod enclosed;
mod error;
mod faced;
mod facet_set;
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
mod scraps;
mod self_intersections;
mod split;
mod state;
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
pub use faced::{Faced, faced};
pub use measure::{Counts, Deviation, DeviationError, Way};
pub use options::{Holes, Options};
pub use step::{Removes, Step};

use crate::arrange::ArrangeError;
use facet_set::FacetSet;
use measure::way;
use rounds::{Entry, KeptState, StepPosition, go_through};
use std::sync::Arc;
use trueness_geom::check::{self, Known, Report};
use trueness_geom::closest::sane_vertex;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::space::Point;
use trueness_geom::topology::weld::{WeldError, as_it_is, compact, rejoined};
use work::Work;

/// All steps with their functions, in their order.
const ENTRIES: [Entry; 15] = [
    Entry { step: &not_finite::STEP, run: not_finite::run },
    Entry { step: &stitch::STEP, run: stitch::run },
    Entry { step: &degenerate::STEP, run: degenerate::run },
    Entry { step: &union::STEP, run: union::run },
    Entry { step: &duplicates::STEP, run: duplicates::run },
    Entry { step: &t_junctions::STEP, run: t_junctions::run },
    Entry { step: &fins::STEP, run: fins::run },
    Entry { step: &orient::STEP, run: orient::run },
    Entry { step: &split::EDGES, run: split::edges },
    Entry { step: &self_intersections::STEP, run: self_intersections::run },
    Entry { step: &holes::STEP, run: holes::run },
    Entry { step: &scraps::STEP, run: scraps::run },
    Entry { step: &split::VERTICES, run: split::vertices },
    Entry { step: &outward::STEP, run: outward::run },
    Entry { step: &islands::STEP, run: islands::run },
];

/// All steps, in the order in which they are done.
pub const STEPS: [&Step; ENTRIES.len()] = {
    let mut steps = [ENTRIES[0].step; ENTRIES.len()];
    let mut i = 0;
    while i < steps.len() {
        steps[i] = ENTRIES[i].step;
        i += 1;
    }
    steps
};

/// The step of this name.
pub fn step(name: &str) -> Option<&'static Step> {
    STEPS.into_iter().find(|step| step.name == name)
}

impl Default for Options {
    /// All steps; holes up to a quarter of their shell.
    fn default() -> Options {
        Options {
            steps: STEPS.to_vec(),
            gap: None,
            stitch: None,
            holes: Holes::UpTo(0.25),
            islands: None,
            single: false,
        }
    }
}

/// The result of a repair.
#[derive(Clone, Debug)]
pub struct Repaired {
    /// The mended mesh. Vertices that stayed keep their bits and their order; new ones follow.
    pub mesh: Mesh,
    /// All changes, in the order in which they were made.
    pub changes: Vec<Change>,
    /// How often the steps were gone through.
    pub rounds: usize,
    /// Findings of the check before.
    pub before: Report,
    /// Findings of the check now.
    pub after: Report,
    /// Vertices and facets that stayed, came and went.
    pub counts: Counts,
    /// Effect on the places that the mesh encloses.
    pub effect: Effect,
    /// Steps that were not done. With them some defect would have become more frequent, or surface would have been
    /// removed and the mesh still not been sound.
    pub taken_back: Vec<&'static Step>,
    /// Vertices that were rounded to single precision before anything was decided: on request, or because shells could not be
    /// united otherwise.
    pub rounded: Rounded,
    /// Why closed shells that meet were not united, if they were not.
    pub not_united: Option<ArrangeError>,
}

impl Repaired {
    /// Distances between `before`, the mesh that was repaired, and the result, both ways.
    ///
    /// Each facet is measured at its corners, the middles of its edges and its middle, exactly to the nearest place of
    /// the other mesh. Facets that both have are at distance 0 and not measured. So the mean is that of the whole
    /// surface. The maximum falls short by less than a third of the longest edge of a facet that changed. Only the
    /// surface that bounds enclosed places counts as old, where a mesh encloses any. For facets that met others
    /// [`Effect::surface`] states the distance.
    ///
    /// # Errors
    /// [`MeshError`](trueness_geom::closest::MeshError) where one of them has no facet or a coordinate that is not finite,
    /// [`QueryError`](trueness_geom::closest::QueryError) if cancelled.
    pub fn deviation(&self, before: &Mesh, progress: &dyn Progress) -> Result<Deviation, DeviationError> {
        let mut there = way((before, &self.effect.inside), &self.mesh, progress)?;
        there.max = there.max.max(self.effect.surface.unwrap_or(0.0));
        Ok(Deviation { there, back: way((&self.mesh, &FacetSet::default()), before, progress)? })
    }
}

/// Effect of rounding the input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rounded {
    /// Vertices.
    pub vertices: u64,
    /// Greatest change of a coordinate, mm.
    pub farthest: f64,
}

/// Holes that a step has cut are widened by no more than this share of the whole area, all together.
const MAX_WIDENED_SHARE: f64 = 0.25;

/// Mends `mesh`. Vertices at the same place become one first.
///
/// A mesh that is sound comes back as it is. Any mesh will do, however broken, whose finite coordinates are 0 or from
/// 1e-50 to 1e45 mm. Defects that cannot be mended stay, and
/// [`Repaired::after`] lists them. No defect that makes a mesh unsound is there more often than before, and closed surfaces stay closed. Where the steps together would end worse, the repair is done without one of them, without the last of them, or not at all. Crossing facets and loose sheets are removed only where the rest then is sound. Facets that are not finite always are, and the comparison is with the mesh without them. The result is the same for any number of threads. Some shells have a union that cannot be written as they are. They are united with all vertices rounded to single precision. The mesh then must be sound, and no vertex may go farther than a millionth of the diagonal ([`Repaired::rounded`]).
/// Cost: for each step that changes something about as much as a check. Filling holes takes up to the cube of 100 for
/// each ring. A repair that ends worse is done twice more for each step that changed something, from where it first
/// did. All of it takes twice as long where vertices are rounded.
///
/// # Errors
/// [`RepairError`].
pub fn repair(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<Repaired, RepairError> {
    let exact = repaired(mesh, options, progress)?;
    let left_out = exact.taken_back.contains(&&union::STEP)
        || matches!(exact.not_united, Some(ArrangeError::Unresolved { .. } | ArrangeError::Open { .. }));
    if exact.after.sound || !left_out || options.single || !is_fine_in_single(mesh) {
        return Ok(exact);
    }
    let single = repaired(mesh, &Options { single: true, ..options.clone() }, progress)?;
    Ok(if single.after.sound { single } else { exact })
}

/// Whether single precision takes no vertex farther than a trifle of the size.
fn is_fine_in_single(mesh: &Mesh) -> bool {
    /// Share of the diagonal.
    const NEGLIGIBLE_SHIFT_OF_DIAGONAL: f64 = 1e-6;
    let bounds = mesh.finite_bounds();
    let most = bounds.min.iter().chain(&bounds.max).fold(0.0, |most: f64, x| most.max(x.abs()));
    3f64.sqrt() * 0.5 * f64::from(f32::EPSILON) * most <= NEGLIGIBLE_SHIFT_OF_DIAGONAL * bounds.diagonal()
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
    let attempt = |without: &[&'static Step], from: Option<&KeptState>| {
        // Bodies that are not united stay whole: crossing facets are not cut out in place of uniting them.
        let also = without.contains(&&union::STEP).then_some(&self_intersections::STEP);
        let is_wanted = |s: &&'static Step| !without.contains(s) && also != Some(*s);
        let steps = options.steps.iter().copied().filter(is_wanted).collect();
        attempt((&start, from), &Options { steps, ..options.clone() }, (&before, &check_options))
    };
    // Facets with a coordinate that is not finite are no surface. The findings on the others without them shall not get
    // worse.
    let mut finite = match before.count(check::NOT_FINITE_FACETS) {
        0 => None,
        _ => Some(attempt(&all_but(&not_finite::STEP), None)?),
    };
    let least = finite.as_ref().map_or(&before, |finite| &finite.after).clone();
    let mut done = match (soup, finite.take_if(|_| soup.is_some())) {
        (None, _) => attempt(&[], None)?,
        (Some(_), Some(finite)) => finite,
        (Some(_), None) => Attempt::none(&mut base, &before)?,
    };
    done.not_united = soup.or(done.not_united);
    let mut taken_back = vec![];
    // Steps that remove surface so that the rest can be closed: where it is not sound even so, they are not done.
    let loses = |s: &&'static Step| matches!(s.removes, Removes::Crossings | Removes::Sheets);
    let mut lost = done.did(STEPS.into_iter().filter(loses));
    if !done.after.sound && !lost.is_empty() {
        // Surface was removed, and the rest is not sound all the same: once more without removing any.
        done = attempt(&lost, None)?;
        taken_back.append(&mut lost);
    }
    if worse(&least, &done.after) {
        (done, taken_back) = match without_some(&attempt, &done, &taken_back, &least)? {
            Some(found) => found,
            None => match finite {
                Some(finite) => (finite, all_but(&not_finite::STEP)),
                None => {
                    rounded = Rounded::default();
                    (Attempt::none(&mut base, &before)?, STEPS.to_vec())
                }
            },
        };
        taken_back.retain(|step| options.steps.contains(step));
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

/// All steps but this one.
fn all_but(step: &Step) -> Vec<&'static Step> {
    STEPS.into_iter().filter(|s| *s != step).collect()
}

/// The first attempt after which no defect is more frequent than in
/// `least`, and the steps that it leaves out. First each step that changed something in `done` is left out by itself;
/// then the last two of them, the last three, and so on. Always without `left_out` too.
fn without_some(
    attempt: &impl Fn(&[&'static Step], Option<&KeptState>) -> Result<Attempt, RepairError>,
    done: &Attempt,
    left_out: &[&'static Step],
    least: &Report,
) -> Result<Option<(Attempt, Vec<&'static Step>)>, RepairError> {
    // Cutting out opens closed surfaces: it is the first step to be left out.
    let cutting_out = &self_intersections::STEP;
    let singly = done.did([cutting_out].into_iter().chain(all_but(cutting_out)));
    let in_turn = done.did(STEPS);
    let last = (2..in_turn.len()).map(|n| in_turn[in_turn.len() - n..].to_vec());
    for tried in singly.into_iter().map(|step| vec![step]).chain(last) {
        let without = [left_out, &tried].concat();
        // The presence of these two changes the effect of other steps.
        let alone = !tried.iter().any(|step| [&union::STEP, cutting_out].contains(step));
        let from = if alone { KeptState::before(&done.kept, &tried) } else { None };
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
    let mut errors = check::KINDS.iter().filter(|kind| kind.severity == check::Severity::Error);
    // Too many to count is worse than any number that was counted.
    let count =
        |report: &Report, kind| report.found(kind).map_or((false, 0), |found| (found.at_least, found.count));
    errors.any(|kind| count(after, kind) > count(before, kind))
}

/// Result of one attempt.
struct Attempt {
    mesh: Mesh,
    known: Arc<Known>,
    changes: Vec<Change>,
    rounds: usize,
    after: Report,
    counts: Counts,
    not_united: Option<ArrangeError>,
    lost: Vec<[Point; 3]>,
    /// States on the way.
    kept: Vec<KeptState>,
}

impl Attempt {
    /// Which of these steps changed something, in the order given.
    fn did(&self, steps: impl IntoIterator<Item = &'static Step>) -> Vec<&'static Step> {
        steps.into_iter().filter(|step| self.changes.iter().any(|c| c.step == *step)).collect()
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

/// Goes through the steps of `options`, from the start, or from a state up to which they did the same as in an earlier attempt.
fn attempt(
    (start, from): (&Work, Option<&KeptState>),
    options: &Options,
    (before, check_options): (&Report, &check::Options),
) -> Result<Attempt, RepairError> {
    let wanted = |(_, entry): &(usize, Entry)| options.steps.contains(&entry.step);
    let steps: Vec<(usize, Entry)> = ENTRIES.into_iter().enumerate().filter(wanted).collect();
    let mut kept = vec![];
    let (mut work, mut rounds) = match from {
        Some(from) => go_through(start.resumed(&from.state, options), &steps, from.position, None)?,
        None => {
            let mut work = start.again(options);
            work.state.handover.widening_left = MAX_WIDENED_SHARE * before.properties.area;
            go_through(work, &steps, StepPosition::START, Some(&mut kept))?
        }
    };
    if work.state.handover.has_widened && work.has_open_cut()? {
        // Widened in vain: once more without, so that facets cut out beyond the crossings stay.
        (work, rounds) = go_through(start.again(options), &steps, StepPosition::START, None)?;
    }
    let mut counts = Counts::of(start.mesh(), work.mesh());
    if !work.state.changes.is_empty() {
        let joined = rejoined(work.mesh().clone())?;
        let same = joined.faces == work.mesh().faces;
        if !same {
            counts = Counts::of(start.mesh(), &joined);
        }
        work.compacted(compact(joined, 0), same);
    }
    let after = work.report(check_options)?;
    let (known, not_united) = (work.known()?, work.state.handover.not_united);
    let (changes, lost) =
        (std::mem::take(&mut work.state.changes), std::mem::take(&mut work.state.handover.lost));
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

//! What a repair did to the places that the mesh encloses.

use super::enclosed::{self, Enclosed, NotEnclosed};
use super::measure::places;
use super::same::Same;
use super::work::Work;
use super::{Options, RepairError, islands, orient};
use crate::check::{Known, Report};
use crate::closest::{Query, Tree};
use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::space::Point;
use crate::topology::{Properties, Topology};
use rayon::prelude::*;

/// Bodies, and what they enclose.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// What the mesh enclosed before; if neighbours looked in different directions, after they were turned; without the
    /// shells that are removed on request.
    pub enclosed: Result<Enclosed, NotEnclosed>,
    /// Largest distance, mm, from the surface that bounded it to the new surface. Places asked about: of facets that met
    /// others the middle of each part that bounded it, of others that are gone those of [`Repaired::deviation`](super::Repaired::deviation).
    /// With what rounding the vertices has added at most. `None` where nothing was enclosed or nothing is left.
    pub surface: Option<f64>,
    /// Closed shells that look outwards, before and after.
    pub bodies: [usize; 2],
    /// Facets that did not bound what was enclosed, or in part only.
    pub(super) inside: Same,
}

impl Effect {
    /// From `before`, as its report tells, to `after`. Where vertices of `before` were rounded first, `rounded` is what this made, and
    /// how far they went at most: the surface is compared with that, because gaps thinner than the rounding vanish by it.
    pub(super) fn of(
        (before, report): (&Work, &Report),
        rounded: Option<(&Work, f64)>,
        (after, known_after): (&Mesh, &Known),
        options: &Options,
    ) -> Result<Effect, RepairError> {
        let progress = before.progress;
        let turn = report.soundness.inconsistent_edges > 0;
        let mut base = turned(before, turn, options)?;
        let known = base.known()?;
        let enclosed = match report.sound && base.changes.is_empty() {
            true => Ok(Enclosed::sound(base.mesh(), &known.properties)),
            false => enclosed_by(&mut base)?,
        };
        let surface = match (&enclosed, rounded) {
            (Err(_), _) => None,
            (Ok(enclosed), None) => surface(base.mesh(), enclosed, after, progress)?,
            (Ok(_), Some((mesh, farthest))) => {
                let mut base = turned(mesh, turn, options)?;
                match enclosed_by(&mut base)? {
                    Err(_) => None,
                    Ok(enclosed) => {
                        // Of one coordinate.
                        let off = 3f64.sqrt() * farthest;
                        surface(base.mesh(), &enclosed, after, progress)?.map(|x| x + off)
                    }
                }
            }
        };
        let bodies = [&*known, known_after].map(|known| bodies(&known.topology, &known.properties));
        let inside = enclosed
            .as_ref()
            .map_or(Same::default(), |enclosed| Same::of(base.mesh(), |f| !enclosed.bounds[f]));
        Ok(Effect { enclosed, surface, bodies, inside })
    }
}

/// The mesh without the shells that are removed on request; with `turn`, after neighbours were turned to look the same way.
fn turned<'a>(before: &Work<'a>, turn: bool, options: &'a Options) -> Result<Work<'a>, RepairError> {
    let mut work = before.again(options);
    if turn {
        (orient::STEP.run)(&mut work)?;
    }
    (islands::STEP.run)(&mut work)?;
    Ok(work)
}

/// What the mesh encloses; an error only where the work was stopped.
fn enclosed_by(work: &mut Work) -> Result<Result<Enclosed, NotEnclosed>, RepairError> {
    let known = work.known()?;
    let may_enclose = enclosed::is_closed(&known.topology);
    let pairs = if may_enclose { work.all_crossings()?.map(<[_]>::to_vec) } else { None };
    match enclosed::enclosed(work.mesh(), &known, pairs, work.progress) {
        Err(NotEnclosed::Cancelled(e)) => Err(e.into()),
        result => Ok(result),
    }
}

/// Shells without a boundary edge whose volume is positive.
fn bodies(topology: &Topology, properties: &Properties) -> usize {
    let mut closed = vec![true; topology.shells];
    for e in &topology.boundary_edges {
        closed[topology.shell_of[e.facet as usize] as usize] = false;
    }
    closed.iter().zip(&properties.shell_volumes).filter(|(closed, volume)| **closed && **volume > 0.0).count()
}

/// Largest distance from what bounded the enclosed places to the new surface.
fn surface(
    before: &Mesh,
    enclosed: &Enclosed,
    after: &Mesh,
    progress: &dyn Progress,
) -> Result<Option<f64>, Cancelled> {
    let kept = Same::of(after, |_| true);
    let gone = before
        .faces
        .par_iter()
        .zip(&enclosed.bounds)
        .filter(|(f, bounds)| **bounds && !kept.holds(before, f));
    let mut asked: Vec<Point> =
        gone.flat_map_iter(|(f, _)| places(f.map(|v| before.positions[v as usize]))).collect();
    asked.extend(&enclosed.middles);
    if asked.is_empty() {
        return Ok(Some(0.0));
    }
    let Ok(tree) = Tree::build(after) else { return Ok(None) };
    let distances = tree.distances(&asked, &Query::default(), progress);
    if progress.cancelled() {
        return Err(Cancelled);
    }
    Ok(distances.ok().map(|d| d.into_iter().fold(0.0, f64::max)))
}

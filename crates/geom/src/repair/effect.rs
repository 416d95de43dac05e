//! What a repair did to the places that the mesh encloses.

use super::enclosed::{Enclosed, NotEnclosed, enclosed};
use super::measure::{Key, places, triangle_key};
use super::work::Work;
use super::{Options, RepairError, islands, orient};
use crate::check::Report;
use crate::closest::{Query, Tree};
use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::space::Point;
use crate::topology::{Properties, Topology};

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
    /// Facets that did not bound what was enclosed, or in part only: sorted.
    pub(super) inside: Vec<Key>,
}

impl Effect {
    /// From `before`, welded, to `after`. Where vertices of `before` were rounded first, `rounded` is the mesh that this made, and
    /// how far they went at most: the surface is compared with that, because gaps thinner than the rounding vanish by it.
    pub(super) fn of(
        (before, report): (&Mesh, &Report),
        rounded: Option<(&Mesh, f64)>,
        after: &Mesh,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<Effect, RepairError> {
        let turn = report.soundness.inconsistent_edges > 0;
        let mut base = turned(before, turn, options, progress)?;
        let known = base.known()?;
        let enclosed = match report.sound && base.changes.is_empty() {
            true => Ok(Enclosed::sound(base.mesh(), &known.properties)),
            false => enclosed(base.mesh(), &known.topology, progress),
        };
        if enclosed == Err(NotEnclosed::Cancelled(Cancelled)) {
            return Err(Cancelled.into());
        }
        let surface = match (&enclosed, rounded) {
            (Err(_), _) => None,
            (Ok(enclosed), None) => surface(base.mesh(), enclosed, after, progress)?,
            (Ok(_), Some((mesh, farthest))) => {
                let mut base = turned(mesh, turn, options, progress)?;
                let known = base.known()?;
                match super::enclosed::enclosed(base.mesh(), &known.topology, progress) {
                    Err(NotEnclosed::Cancelled(e)) => return Err(e.into()),
                    Err(_) => None,
                    Ok(enclosed) => {
                        // Of one coordinate.
                        let off = 3f64.sqrt() * farthest;
                        surface(base.mesh(), &enclosed, after, progress)?.map(|x| x + off)
                    }
                }
            }
        };
        let topology = Topology::of(after)?;
        let bodies = [
            bodies(&known.topology, &known.properties),
            bodies(&topology, &Properties::of(after, &topology)),
        ];
        let inside = enclosed.as_ref().map_or(vec![], |enclosed| {
            let all = base.mesh().faces.iter().zip(&enclosed.bounds).filter(|(_, bounds)| !**bounds);
            let mut keys: Vec<Key> = all.map(|(f, _)| triangle_key(base.mesh(), f)).collect();
            keys.sort_unstable();
            keys
        });
        Ok(Effect { enclosed, surface, bodies, inside })
    }
}

/// The mesh without the shells that are removed on request; with `turn`, after neighbours were turned to look the same way.
fn turned<'a>(
    mesh: &Mesh,
    turn: bool,
    options: &'a Options,
    progress: &'a dyn Progress,
) -> Result<Work<'a>, RepairError> {
    let mut work = Work::new(mesh.clone(), options, progress)?;
    if turn {
        (orient::STEP.run)(&mut work)?;
    }
    (islands::STEP.run)(&mut work)?;
    Ok(work)
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
    let mut kept: Vec<_> = after.faces.iter().map(|f| triangle_key(after, f)).collect();
    kept.sort_unstable();
    let gone = before
        .faces
        .iter()
        .zip(&enclosed.bounds)
        .filter(|(f, bounds)| **bounds && kept.binary_search(&triangle_key(before, f)).is_err());
    let mut asked: Vec<Point> =
        gone.flat_map(|(f, _)| places(f.map(|v| before.positions[v as usize]))).collect();
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

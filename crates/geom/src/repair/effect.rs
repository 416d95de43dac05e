//! What a repair did to the places that the mesh encloses.

use super::enclosed::{Enclosed, NotEnclosed, enclosed};
use super::measure::{Key, places, triangle_key};
use super::work::Work;
use super::{Options, RepairError, islands, orient};
use crate::check::Report;
use crate::check::nesting::Container;
use crate::closest::{Query, Tree};
use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, cross, minus, plus, times, unit};
use crate::topology::{Properties, Topology};
use std::sync::OnceLock;

/// Bodies, and what they enclose.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// What the mesh enclosed before; if neighbours looked in different directions, after they were turned; without the
    /// shells that are removed on request.
    pub enclosed: Result<Enclosed, NotEnclosed>,
    /// Largest distance, mm, from the surface that bounded it to the new surface. Places asked about: of facets that met
    /// others the middle of each part that bounded it, of others that are gone those of [`Repaired::deviation`](super::Repaired::deviation);
    /// gaps in the material narrower than 1e-5 of the size do not count.
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
        let gone = match (&enclosed, rounded) {
            (Err(_), _) => Gone::default(),
            (Ok(enclosed), None) => gone(base.mesh(), enclosed, after, progress)?,
            (Ok(_), Some((mesh, farthest))) => {
                let mut base = turned(mesh, turn, options, progress)?;
                let known = base.known()?;
                match super::enclosed::enclosed(base.mesh(), &known.topology, progress) {
                    Err(NotEnclosed::Cancelled(e)) => return Err(e.into()),
                    Err(_) => Gone::default(),
                    Ok(enclosed) => {
                        let gone = gone(base.mesh(), &enclosed, after, progress)?;
                        // Of one coordinate.
                        let off = 3f64.sqrt() * farthest;
                        Gone { farthest: gone.farthest.map(|x| x + off), ..gone }
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
            let all = (0..).zip(&base.mesh().faces).zip(&enclosed.bounds);
            let inner = all.filter(|((f, _), bounds)| !**bounds || gone.gaps.binary_search(f).is_ok());
            let mut keys: Vec<Key> = inner.map(|((_, face), _)| triangle_key(base.mesh(), face)).collect();
            keys.sort_unstable();
            keys
        });
        Ok(Effect { enclosed, surface: gone.farthest, bodies, inside })
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

/// What of the surface that bounded the enclosed places is gone.
#[derive(Default)]
struct Gone {
    /// Largest distance from it to the new surface; see [`Effect::surface`].
    farthest: Option<f64>,
    /// Facets along gaps that are closed now, ascending.
    gaps: Vec<u32>,
}

/// Walls nearer to each other than this share of the diagonal, with material behind both, are no surface that a part shows: gaps that
/// rounding leaves between bodies that touch.
const GAP: f64 = 1e-5;
/// Of that, distances that are not worth asking.
const NOTHING: f64 = 1e-3;

fn gone(
    before: &Mesh,
    enclosed: &Enclosed,
    after: &Mesh,
    progress: &dyn Progress,
) -> Result<Gone, Cancelled> {
    let mut kept: Vec<_> = after.faces.iter().map(|f| triangle_key(after, f)).collect();
    kept.sort_unstable();
    let bounding = (0u32..).zip(&before.faces).zip(&enclosed.bounds).filter(|(_, bounds)| **bounds);
    let is_gone = |f: &[u32; 3]| kept.binary_search(&triangle_key(before, f)).is_err();
    let mut asked: Vec<(u32, Point)> = vec![];
    for ((f, face), _) in bounding.filter(|((_, face), _)| is_gone(face)) {
        asked.extend(places(face.map(|v| before.positions[v as usize])).map(|p| (f, p)));
    }
    let whole = asked.len();
    asked.extend(&enclosed.middles);
    if asked.is_empty() {
        return Ok(Gone { farthest: Some(0.0), gaps: vec![] });
    }
    let Ok(tree) = Tree::build(after) else { return Ok(Gone::default()) };
    let all: Vec<Point> = asked.iter().map(|a| a.1).collect();
    let distances = tree.distances(&all, &Query::default(), progress);
    if progress.cancelled() {
        return Err(Cancelled);
    }
    let Ok(distances) = distances else { return Ok(Gone::default()) };
    let reach = GAP * before.finite_bounds().diagonal();
    let gaps = Gaps::new(before, reach);
    let mut found = Gone { farthest: Some(0.0), gaps: vec![] };
    for (i, ((f, p), distance)) in asked.into_iter().zip(distances).enumerate() {
        // Off the edges of the facet, where a side belongs to a neighbour.
        let inside = || {
            let middle = places(before.faces[f as usize].map(|v| before.positions[v as usize]))[6];
            if i < whole { plus(times(0.999, p), times(0.001, middle)) } else { p }
        };
        if distance > NOTHING * reach && gaps.hold(f, inside()) {
            found.gaps.push(f);
        } else {
            found.farthest = found.farthest.map(|most| most.max(distance));
        }
    }
    found.gaps.sort_unstable();
    found.gaps.dedup();
    Ok(found)
}

/// Gaps of a mesh that are narrower than some reach.
struct Gaps<'a> {
    mesh: &'a Mesh,
    reach: f64,
    /// Made when first needed.
    rays: OnceLock<Container<'a>>,
}

impl Gaps<'_> {
    fn new(mesh: &Mesh, reach: f64) -> Gaps<'_> {
        Gaps { mesh, reach, rays: OnceLock::new() }
    }

    /// Whether there is material on both sides of a facet at a place of it, as near as the reach.
    fn hold(&self, facet: u32, p: Point) -> bool {
        let [a, b, c] = self.mesh.faces[facet as usize].map(|v| self.mesh.positions[v as usize]);
        let Some((normal, _)) = unit(cross(minus(b, a), minus(c, a))) else { return false };
        let all = || (0..self.mesh.faces.len() as u32).collect::<Vec<_>>();
        let rays = self.rays.get_or_init(|| Container::new(self.mesh, &all(), 0));
        let is_inside = |away: f64| rays.beyond(&plus(p, times(away, normal)), |_| true) >= 1;
        is_inside(self.reach) && is_inside(-self.reach)
    }
}

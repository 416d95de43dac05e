//! Effect of a repair on the places that the mesh encloses.

use super::enclosed::{self, Enclosed, NotEnclosed, Piece};
use super::error::RepairError;
use super::facet_set::FacetSet;
use super::measure::{once, places};
use super::options::Options;
use super::work::Work;
use super::{islands, orient};
use std::sync::OnceLock;
use trueness_geom::check::nesting::Container;
use trueness_geom::check::{Known, Report};
use trueness_geom::closest::{Query, Tree};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, cross, minus, norm, plus, times, unit};
use trueness_geom::topology::{Properties, Topology};

/// Bodies, and the volumes that they enclose.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// Volumes that the mesh enclosed before: after turning facets whose neighbors looked in different directions, and
    /// without the shells that are removed on request.
    pub enclosed: Result<Enclosed, NotEnclosed>,
    /// Largest distance, mm, from the surface that bounded it to the new surface. Places asked about are these. A facet
    /// that met others has the middle and the corners of each part that bounded it. A facet that is gone otherwise has
    /// those of
    /// [`Repaired::deviation`](super::Repaired::deviation), and places beside the corners. Gaps in the material narrower than 1e-5 of the size do not count. The error that rounding the vertices has added is included. Loose sheets and crossing facets that were removed so that the rest could be closed count too, where no material is now. `None`
    /// where nothing was enclosed, or nothing is left, and no such facet was removed.
    pub surface: Option<f64>,
    /// Closed shells that look outwards, before and after.
    pub bodies: [usize; 2],
    /// Facets that did not bound an enclosed place, or in part only.
    pub(super) inside: FacetSet,
}

impl Effect {
    /// From `before`, as its report tells, to `after`, for which facets with these corners were removed. Where vertices
    /// of `before` were rounded first, `rounded` is the rounded mesh, and how far they went at most. The surface is
    /// compared with that, because gaps thinner than the rounding vanish by it.
    pub(super) fn of(
        (before, report): (&Work, &Report),
        rounded: Option<(&Work, f64)>,
        (after, known_after, lost): (&Mesh, &Known, &[[Point; 3]]),
        options: &Options,
    ) -> Result<Effect, RepairError> {
        let progress = before.progress;
        let turn = report.soundness.inconsistent_edges > 0;
        let mut base = turned(before, turn, options)?;
        let known = base.known()?;
        let enclosed = match report.sound && base.state.changes.is_empty() {
            true => Ok(Enclosed::sound(base.mesh(), &known.properties)),
            false => enclosed_by(&mut base)?,
        };
        let enclosed_faces = base.mesh().faces.len();
        let lost_surface = match (&enclosed, rounded) {
            (Err(_), _) => LostSurface::default(),
            (Ok(enclosed), None) => lost_surface(base.mesh(), enclosed, after, progress)?,
            (Ok(_), Some((mesh, farthest))) => {
                let mut base = turned(mesh, turn, options)?;
                match enclosed_by(&mut base)? {
                    Err(_) => LostSurface::default(),
                    Ok(enclosed) => {
                        let lost_surface = lost_surface(base.mesh(), &enclosed, after, progress)?;
                        // The distance along one coordinate.
                        let off = 3f64.sqrt() * farthest;
                        // Rounding may join shells, and others are removed on request: then facets have other numbers.
                        let same = base.mesh().faces.len() == enclosed_faces;
                        let gaps = if same { lost_surface.gaps } else { vec![] };
                        LostSurface { farthest: lost_surface.farthest.map(|x| x + off), gaps }
                    }
                }
            }
        };
        let bodies = [&*known, known_after].map(|known| bodies(&known.topology, &known.properties));
        let is_inner = |enclosed: &Enclosed, f: usize| {
            !enclosed.bounds[f] || lost_surface.gaps.binary_search(&(f as u32)).is_ok()
        };
        let inside = enclosed
            .as_ref()
            .map_or(FacetSet::default(), |enclosed| FacetSet::of(base.mesh(), |f| is_inner(enclosed, f)));
        let surface =
            [lost_surface.farthest, beyond(lost, after, progress)?].into_iter().flatten().reduce(f64::max);
        Ok(Effect { enclosed, surface, bodies, inside })
    }
}

/// The mesh without the shells that are removed on request; with `turn`, after neighbors were turned to look the same way.
fn turned<'a>(before: &Work<'a>, turn: bool, options: &'a Options) -> Result<Work<'a>, RepairError> {
    let mut work = before.again(options);
    if turn {
        orient::run(&mut work)?;
    }
    islands::run(&mut work)?;
    Ok(work)
}

/// Volumes that the mesh encloses; an error only where the work was stopped.
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

/// Surface that bounded the enclosed places and is gone.
#[derive(Default)]
struct LostSurface {
    /// Largest distance from it to the new surface; see [`Effect::surface`].
    farthest: Option<f64>,
    /// Facets along gaps that are closed now, ascending.
    gaps: Vec<u32>,
}

/// Walls nearer to each other than this share of the diagonal, with material behind both, are no surface that a part
/// shows. They are gaps that rounding leaves between bodies that touch.
const HIDDEN_GAP_OF_DIAGONAL: f64 = 1e-5;
/// Share of such a gap below which a distance is not worth asking.
const ZERO_DISTANCE_OF_GAP: f64 = 1e-3;

/// Parts of facets that are asked about at a time.
const FACET_PARTS_PER_CHUNK: usize = 1 << 15;

/// A place of the old surface, and a middle of the facet or part that it was taken from.
struct Sample {
    facet: u32,
    place: Point,
    middle: Point,
}

/// Corners, places beside them, and others, the middle last. A corner may lie on another body, and be near the rest of
/// that, where the surface beside it is not.
fn samples_of(facet: u32, corners: &[Point], others: &[Point]) -> Vec<Sample> {
    /// Share of the way to the middle.
    const SHARE_TOWARDS_MIDDLE: f64 = 0.02;
    let middle = others[others.len() - 1];
    let beside = |p: &Point| plus(times(1.0 - SHARE_TOWARDS_MIDDLE, *p), times(SHARE_TOWARDS_MIDDLE, middle));
    let all = corners.iter().copied().chain(corners.iter().map(beside)).chain(others.iter().copied());
    all.map(|place| Sample { facet, place, middle }).collect()
}

fn lost_surface(
    before: &Mesh,
    enclosed: &Enclosed,
    after: &Mesh,
    progress: &dyn Progress,
) -> Result<LostSurface, Cancelled> {
    let kept = FacetSet::of(after, |_| true);
    let bounding = before.faces.par_iter().enumerate().zip(&enclosed.bounds);
    let is_gone = bounding.filter(|((_, face), bounds)| **bounds && !kept.holds(before, face));
    let asked_of = |((f, face), _): ((usize, &[u32; 3]), &bool)| {
        let places = places(before.places(face));
        samples_of(f as u32, &places[..3], &places[3..])
    };
    let of_piece =
        |Piece { facet, middle, corners }: &Piece| samples_of(*facet, corners, std::slice::from_ref(middle));
    let whole: Vec<Sample> = is_gone.flat_map_iter(asked_of).collect();
    let mut found = LostSurface { farthest: Some(0.0), gaps: vec![] };
    if whole.is_empty() && enclosed.pieces.is_empty() {
        return Ok(found);
    }
    let Ok(tree) = Tree::build(after) else { return Ok(LostSurface::default()) };
    let reach = HIDDEN_GAP_OF_DIAGONAL * before.finite_bounds().diagonal();
    let gaps = Gaps::new(before, reach);
    // Some at a time: of bodies that cross very often there are far more pieces than facets.
    let pieces =
        enclosed.pieces.chunks(FACET_PARTS_PER_CHUNK).map(|chunk| chunk.iter().flat_map(of_piece).collect());
    for samples in std::iter::once(whole).chain(pieces) {
        let all: Vec<Point> = samples.iter().map(|a| a.place).collect();
        let distances = once(&all, |places| tree.distances(places, &Query::default(), progress));
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let Ok(distances) = distances else { return Ok(LostSurface::default()) };
        let in_gap = |(Sample { facet, place, middle }, distance): (&Sample, &f64)| {
            // Off the edges, where a side belongs to a neighbor, but not out of the gap: its rim is part of the new surface.
            let inside = || {
                let way = minus(*middle, *place);
                plus(*place, times((0.5 * distance / norm(way)).min(0.001), way))
            };
            *distance > ZERO_DISTANCE_OF_GAP * reach && !progress.cancelled() && gaps.hold(*facet, inside())
        };
        let in_gap: Vec<bool> = samples.par_iter().zip(&distances).map(in_gap).collect();
        if progress.cancelled() {
            return Err(Cancelled);
        }
        for ((Sample { facet, .. }, distance), in_gap) in samples.into_iter().zip(distances).zip(in_gap) {
            if in_gap {
                found.gaps.push(facet);
            } else {
                found.farthest = found.farthest.map(|most| most.max(distance));
            }
        }
    }
    found.gaps.sort_unstable();
    found.gaps.dedup();
    Ok(found)
}

/// Largest distance from facets that were removed to the surface, where they do not lie in the material; `None` if there are none.
fn beyond(lost: &[[Point; 3]], after: &Mesh, progress: &dyn Progress) -> Result<Option<f64>, Cancelled> {
    if lost.is_empty() {
        return Ok(None);
    }
    let Ok(tree) = Tree::build(after) else { return Ok(None) };
    let all: Vec<Point> = lost.iter().flat_map(|corners| places(*corners)).collect();
    let distances = once(&all, |places| tree.distances(places, &Query::default(), progress));
    if progress.cancelled() {
        return Err(Cancelled);
    }
    let Ok(distances) = distances else { return Ok(None) };
    let facets: Vec<u32> = (0..after.faces.len() as u32).collect();
    let rays = Container::new(after, &facets, 0);
    let least = ZERO_DISTANCE_OF_GAP * HIDDEN_GAP_OF_DIAGONAL * after.finite_bounds().diagonal();
    let counts = |p: &Point, distance: f64| distance > least && rays.winding(p).is_some_and(|w| w < 1);
    let farthest = all.par_iter().zip(distances).map(|(p, d)| if counts(p, d) { d } else { 0.0 });
    Ok(Some(farthest.reduce(|| 0.0, f64::max)))
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

    /// Whether there is material on both sides of a facet at a place of it, as near as the reach. Where gaps meet, one side may lie in
    /// the other gap: places beside are asked about too.
    fn hold(&self, facet: u32, p: Point) -> bool {
        let [a, b, c] = self.mesh.corners(facet);
        let (along, across) = (minus(b, a), minus(c, a));
        let Some(((normal, _), (u, _))) = unit(cross(along, across)).zip(unit(along)) else { return false };
        let v = cross(normal, u);
        let all = || (0..self.mesh.faces.len() as u32).collect::<Vec<_>>();
        let rays = self.rays.get_or_init(|| Container::new(self.mesh, &all(), 0));
        let is_inside = |q: &Point, away: f64| {
            rays.winding(&plus(*q, times(away * self.reach, normal))).is_some_and(|w| w >= 1)
        };
        let beside = [[0.0, 0.0], [0.9, 0.4], [-0.4, 0.9], [-0.9, -0.4], [0.4, -0.9]];
        beside.iter().any(|[s, t]| {
            let q = plus(p, times(self.reach, plus(times(*s, u), times(*t, v))));
            is_inside(&q, 1.0) && is_inside(&q, -1.0)
        })
    }
}

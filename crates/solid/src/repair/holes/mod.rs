//! Closed rings of boundary edges get a patch.
//!
//! Patches are proposed in turn until one fits. First comes the triangulation of least area (Barequet and Sharir,
//! Filling gaps in the boundary of a polyhedron, 1995). It is refined and faired where the surroundings are smooth
//! (Liepa, Filling holes in meshes, 2003). Then follow the flat one itself, the one that bends least, and a fan around
//! the middle. A patch fits if it crosses nothing, decided exactly, and makes no edge of three facets. Where none fits,
//! the hole stays open.

mod fair;
mod flat;
mod minimal;
mod patch;
mod refine;
mod ring;
mod site;

use super::error::RepairError;
use super::options::Holes;
use super::step::{Removes, Step};
use super::work::Work;
use crate::neighborhood::Neighborhood;
use minimal::Aim;
use patch::{FIRST_NEW_VERTEX, Patch};
use ring::Ring;
use site::Site;
use std::collections::BTreeSet;
use std::ops::Range;
use trueness_geom::check::Known;
use trueness_geom::check::finding;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{minus, norm, plus, times};
use trueness_geom::topology::Topology;

pub(super) const STEP: Step = Step {
    name: "holes",
    about: "Fills holes: with the triangles of least area, refined and faired to the surroundings where those are smooth. Holes \
            larger than the limit stay open; of a shell that has such a one, all but small holes do.",
    removes: Removes::Nothing,
};

/// The ways to fill a hole, in the order in which they are tried.
const WAYS: [fn(&Site, &Ring) -> Option<Patch>; 4] =
    [refine::patch, |s, r| minimal::patch(s, r, Aim::Area), |s, r| minimal::patch(s, r, Aim::Bend), fan];

/// A hole on trial.
struct Trial {
    ring: Ring,
    /// The next way to try.
    way: usize,
    /// `None` where nothing fits, or where the hole is too large.
    patch: Option<Patch>,
    /// Area, mm², of the largest patch it may get.
    limit: f64,
    /// A step has made it.
    is_own_hole: bool,
    /// Where its facets are while they are in the mesh.
    facets: Range<u32>,
}

impl Trial {
    fn is_too_large(&self, work: &Work) -> bool {
        self.patch.as_ref().is_some_and(|patch| patch.area(work) > self.limit)
    }
}

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    let mut trials = trials(work, &known)?;
    let mut shell_of = known.topology.shell_of.clone();
    let (facets, vertices) = (work.mesh().faces.len() as u32, work.mesh().positions.len());
    while trials.iter().any(|trial| trial.patch.is_some()) {
        shell_of.truncate(facets as usize);
        for trial in &mut trials {
            trial.facets = trial.patch.as_ref().map_or(0..0, |patch| insert(work, patch));
            let shell = if trial.is_own_hole { u32::MAX } else { trial.ring.shell };
            shell_of.extend(trial.facets.clone().map(|_| shell));
        }
        let bad = misfits(work, facets, &shell_of)?;
        let hit = |trial: &Trial| {
            let from = bad.partition_point(|f| *f < trial.facets.start);
            trial.patch.is_some() && bad.get(from).is_some_and(|f| *f < trial.facets.end)
        };
        let again: Vec<usize> = (0..trials.len()).filter(|&i| hit(&trials[i])).collect();
        if again.is_empty() {
            break;
        }
        work.truncate(facets, vertices);
        for i in again {
            work.go_on()?;
            propose(&Site { work, known: &known }, &mut trials[i]);
        }
    }
    for Trial { ring, patch, facets, .. } in &trials {
        if let Some(patch) = patch {
            let area = facets.clone().map(|f| finding::area(work.corners(f))).sum();
            work.log(&STEP, "hole filled", ring.middle(work), patch.facets.len(), area);
        }
    }
    widen(work, &known, trials.iter().filter(|trial| trial.patch.is_none()).map(|trial| &trial.ring));
    Ok(())
}

/// The holes of shells that stay open are filled up to this share of the area of the shell. Gaps of a scan are smaller.
/// Larger ones may have been cut on purpose (a half tunnel of the collected meshes has a round one of 0.65 %).
const MAX_HOLE_OF_SHEET: f64 = 0.005;

/// All holes, with the first patch for each that may be filled.
///
/// A rim beyond the limit is the border of a sheet, which was meant to be open. Others like it, though smaller, may
/// then be borders too, and only a small one is a hole. The border of a flat sheet is none, whatever the limit.
fn trials(work: &Work, known: &Known) -> Result<Vec<Trial>, RepairError> {
    let rings = Ring::all(known);
    let sheets = flat::sheets(work, known, &rings);
    let mut trials = vec![];
    for ring in rings {
        work.go_on()?;
        let is_own_hole = work.is_own_hole(&ring.vertices);
        let limit = if is_own_hole { f64::INFINITY } else { limit(work, &ring) };
        let mut trial = Trial { ring, way: 0, patch: None, limit: f64::INFINITY, is_own_hole, facets: 0..0 };
        propose(&Site { work, known }, &mut trial);
        trial.limit = limit;
        trials.push(trial);
    }
    let open: BTreeSet<u32> =
        trials.iter().filter(|trial| trial.is_too_large(work)).map(|trial| trial.ring.shell).collect();
    for trial in &mut trials {
        if !trial.is_own_hole && open.contains(&trial.ring.shell) {
            trial.limit = trial.limit.min(MAX_HOLE_OF_SHEET * trial.ring.shell_area);
        }
        if trial.is_too_large(work) || flat::is_border(work, &trial.ring, &sheets) {
            trial.patch = None;
        }
    }
    Ok(trials)
}

/// Area, mm², up to which a hole is filled.
fn limit(work: &Work, ring: &Ring) -> f64 {
    match work.options.holes {
        Holes::UpTo(share) => share * ring.shell_area,
        Holes::All => f64::INFINITY,
    }
}

/// The edges, lower vertex first, of rims whose fan is not larger than the limit: they may be filled.
pub(super) fn fillable(work: &Work, known: &Known) -> BTreeSet<[u32; 2]> {
    let sides = |ring: &Ring| -> Vec<[u32; 2]> {
        let n = ring.vertices.len();
        (0..n).map(|i| [ring.vertices[i], ring.vertices[(i + 1) % n]]).collect()
    };
    let fan = |ring: &Ring| -> f64 {
        let middle = ring.middle(work);
        sides(ring).iter().map(|[a, b]| finding::area([work.at(*a), work.at(*b), middle])).sum()
    };
    let small = Ring::all(known).into_iter().filter(|ring| fan(ring) <= limit(work, ring));
    small.flat_map(|ring| sides(&ring)).map(|[a, b]| [a.min(b), a.max(b)]).collect()
}

/// Cuts out the facets around holes that a step has cut and no patch fits, so that the next round may find a patch.
/// Where two bodies cross, the rims that cutting leaves lie so near to each other that patches would cross again.
fn widen<'a>(work: &mut Work, known: &Known, rings: impl Iterator<Item = &'a Ring>) {
    let rings = rings.filter(|ring| work.is_own_hole(&ring.vertices));
    let mut removed: Vec<u32> =
        rings.flat_map(|ring| &ring.vertices).flat_map(|v| known.topology.facets_at_vertex(*v)).collect();
    removed.sort_unstable();
    removed.dedup();
    let area = removed.iter().map(|&f| finding::area(work.corners(f))).sum::<f64>();
    if removed.is_empty() || area > work.state.handover.widening_left {
        work.state.handover.widening_left = 0.0;
        return;
    }
    work.state.handover.widening_left -= area;
    work.state.handover.has_widened = true;
    work.log(&STEP, "holes widened that nothing fits", work.middle(removed[0]), removed.len(), area);
    work.cut_out(&removed);
}

/// Finds the next patch for the hole, if there is one and the hole is not too large.
fn propose(site: &Site, trial: &mut Trial) {
    let work = site.work;
    trial.patch = WAYS[trial.way..].iter().find_map(|way| {
        trial.way += 1;
        way(site, &trial.ring)
    });
    if trial.is_too_large(work) {
        trial.patch = None;
    }
}

/// Puts the patch into the mesh.
fn insert(work: &mut Work, patch: &Patch) -> Range<u32> {
    let first = work.mesh().faces.len() as u32;
    let numbers: Vec<u32> = patch.places.iter().map(|&p| work.add(p)).collect();
    let number = |v: u32| v.checked_sub(FIRST_NEW_VERTEX).map_or(v, |new| numbers[new as usize]);
    let facets: Vec<[u32; 3]> = patch.facets.iter().map(|f| f.map(number)).collect();
    work.replace(&[], &facets);
    first..first + facets.len() as u32
}

/// Facets from
/// `first` on that cross others, lie at an edge of more than two, or have no area; ascending. A patch that crosses facets of another shell fits, if shells will be united. `shell_of`
/// has no shell for patches of holes that a step has cut.
fn misfits(work: &mut Work, first: u32, shell_of: &[u32]) -> Result<Vec<u32>, RepairError> {
    let all = work.mesh().faces.len() as u32;
    let is_chosen: Vec<bool> = (0..all).map(|f| f >= first).collect();
    let (crossings, mut bad) = match Neighborhood::new(work.mesh(), &is_chosen) {
        Some(around) => {
            let topology = Topology::watched(&around.mesh, work.progress)?;
            let crossings = work.crossings_around(&around, &topology)?;
            let bad = unmanifold(&around.mesh, &topology);
            (crossings, bad.into_iter().map(|f| around.numbers[f as usize]).collect())
        }
        None => {
            let known = work.known()?;
            (work.crossings(|f, _| f >= first)?, unmanifold(work.mesh(), &known.topology))
        }
    };
    let Some(crossings) = crossings else { return Ok((first..all).collect()) };
    let unites = work.options.steps.contains(&&super::union::STEP);
    let apart = |pair: &[u32; 2]| {
        let [a, b] = pair.map(|f| shell_of[f as usize]);
        unites && a != u32::MAX && b != u32::MAX && a != b
    };
    bad.extend(crossings.into_iter().filter(|pair| !apart(pair)).flatten());
    bad.retain(|f| *f >= first);
    bad.sort_unstable();
    bad.dedup();
    Ok(bad)
}

/// Facets at edges of more than two, facets that are there twice, and facets without area.
fn unmanifold(mesh: &Mesh, topology: &Topology) -> Vec<u32> {
    let edges = topology.non_manifold_edges.iter();
    let mut bad: Vec<u32> = edges.flat_map(|edge| topology.facets_at_edge(mesh, edge.vertices)).collect();
    bad.extend(topology.duplicate_facets.iter().flatten());
    bad.extend(topology.collinear.iter().chain(&topology.repeated_vertex));
    bad
}

/// Triangles from every edge of the ring to its middle.
fn fan(&Site { work, .. }: &Site, ring: &Ring) -> Option<Patch> {
    let n = ring.vertices.len();
    let side = |i: usize| [ring.vertices[i], ring.vertices[(i + 1) % n]];
    let places = (0..n).map(side).map(|[a, b]| (work.at(a), work.at(b)));
    // Each edge counts by its length, so that the middle does not depend on how finely the ring is divided.
    let (sum, length) = places.fold(([0.0; 3], 0.0), |(sum, length), (a, b)| {
        let l = norm(minus(b, a));
        (plus(sum, times(0.5 * l, plus(a, b))), length + l)
    });
    let middle = times(1.0 / length, sum);
    let facets = (0..n).map(side).map(|[a, b]| [a, b, FIRST_NEW_VERTEX]).collect();
    middle.iter().all(|x| x.is_finite()).then(|| Patch { places: vec![work.rounded(middle)], facets })
}

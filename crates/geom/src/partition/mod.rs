//! Whose point is it: one partition of a scan among faces, those of its nominal or others.
//!
//! Partition is an operation of its own (ISO 17450-1), done once for the whole part, by likelihood, and not anew for each feature:
//!
//! 1. The nominal is cut into [`Faces`]: planes, cylinders, cones, spheres and tori, and what is free between creases.
//! 2. Each face is put where it really is, by the points that are surely its own. They are near it, face as it does, and lie
//!    clear of its border.
//! 3. A point that one face alone can have belongs to it. Near borders each of the faces there is asked where its surface goes
//!    on, by the sure points around. The point belongs to the face with the least distance, as a share of the allowance for
//!    noise and continuation.
//! 4. Points that no face explains are looked at together with their neighbors. Points that hang together with others beyond
//!    the reach of all faces go on into the material ([`Class::Deep`]) or out of it ([`Class::High`]). They are a hole, a bump,
//!    a thing that stands there. If it is closed, and one face alone is around it, it is a [`Class::Dent`]. No more than two
//!    together, clear of borders of a face that was scanned, are outliers ([`Class::Alone`]). Points along a border are
//!    [`Class::Edge`] as far as scans round edges, farther [`Class::Broken`]: a burr, a groove, a chamfer that is not drawn.
//!    The rest is form of the face: a dent.
//!
//! | file | what |
//! |---|---|
//! | `terms` | what is asked and told |
//! | `best` | the face of each point that costs least |
//! | `by_facets` | what the facets of a mesh tell |
//! | `cut` | the nominal cut into faces |
//! | `faces` | a face, and where a point lies on it |
//! | `facing` | how the vertices of a mesh face |
//! | `placed` | where a face really is |
//! | `continuation` | where its surface goes on near a border |
//! | `work` | which faces points may be of, and which explains each best |
//! | `rounding` | how far from its edges a scan is rounded |
//! | `unexplained` | what no face explains |

mod best;
mod by_facets;
mod continuation;
mod cut;
mod faces;
mod facing;
mod placed;
mod rounding;
mod terms;
#[cfg(test)]
mod tests;
mod unexplained;
mod work;

pub use cut::{NO_FACE, element};
pub use faces::{Face, Faces};
pub use placed::Placed;
pub use terms::{Beyond, Class, Options, Partition, PartitionError};

use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::scan::Scan;
use crate::space::{Aabb, Point, single_step};
use crate::spatial::neighbors::PointTree;
use best::Candidate;
use continuation::Sure;
use faces::Seat;
use facing::Facing;
use terms::EXPLAINED_SIGMAS;
use unexplained::{Over, Unexplained};
use work::{ROUNDED_EDGE_SPACINGS, SEARCH_REACHES, SURE_BORDER_SPACINGS, Work};

/// Share of its diagonal that a face reaches where no reach is given.
const DEFAULT_REACH_SHARE: f64 = 0.02;
/// Share of the diagonal of all faces. Up to it, points out of the material and beyond the reach of a face may belong to the
/// face. Into the material nothing else lies.
const OUTWARD_REACH_SHARE: f64 = 0.1;
/// Neighbors whose farthest tells the spacing.
const SPACING_NEIGHBORS: usize = 16;
/// Places where the spacing is looked at.
const SPACING_PLACES: usize = 200;

/// Parts the vertices of a measured mesh, or the points of a cloud, among faces; all in millimeters and in one frame.
///
/// Vertices of a mesh have faces by where they lie and how they face; points of a cloud by where they lie alone. Points within noise of two faces are of
/// one of them. Deterministic for any number of threads. Cost: for each face a pass over the points, and a search for each point within its reach.
/// ```
/// use trueness_geom::partition::{Class, Faces, NO_FACE, Options, partition};
/// use trueness_geom::{mesh::Mesh, progress::Silent, scan::Scan};
/// // The four faces of a tetrahedron, and places of its largest, 0.1 above it; one place is far off.
/// let nominal = Mesh {
///     positions: vec![[0.0, 0.0, 0.0], [30.0, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, -30.0]],
///     faces: vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
/// };
/// let faces = Faces::of(&nominal, &Silent)?;
/// let place = |k: u32| [f64::from(k % 20) + 0.5, f64::from(k / 20) + 0.5, 0.1];
/// let mut positions: Vec<_> = (0..400).map(place).filter(|p| p[0] + p[1] < 29.0).collect();
/// positions.push([5.0, 5.0, 40.0]);
/// let scan = Scan::Cloud(positions);
/// let all: Vec<_> = faces.all.iter().collect();
/// let found = partition(&scan, &all, &Options { distance: Some(1.0), ..Options::default() }, &Silent)?;
/// let top = faces.of_facets[0];
/// assert_eq!((found.owners[0], found.classes[0]), (top, Class::Face));
/// assert!((found.placed[top as usize].offset - 0.1).abs() < 1e-9);
/// assert_eq!(found.owners.last(), Some(&NO_FACE));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`PartitionError`]: a coordinate that is no number, a facet that names no vertex, a reach that is no length, cancelled.
pub fn partition(
    scan: &Scan,
    faces: &[&Face],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Partition, PartitionError> {
    let points = scan.points();
    if let Some(index) = points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        return Err(PartitionError::NotFinite { index });
    }
    if let Some(facet) = scan.facets().iter().position(|f| f.iter().any(|v| *v as usize >= points.len())) {
        return Err(PartitionError::NoSuchVertex { facet });
    }
    let reach = reaches(faces, options)?;
    let mesh = scan.mesh();
    let facing = mesh.map(Facing::new);
    let spacing = spacing(points, options.seed);
    let mut candidates = vec![];
    for (face, reach) in faces.iter().zip(&reach) {
        // Edges are looked for as far as scans round them.
        let reach = f64::max(SEARCH_REACHES * reach, ROUNDED_EDGE_SPACINGS * spacing);
        candidates.push(near(face, points, facing.as_ref(), reach, spacing, progress)?);
    }
    let least = work::least_off(points.len(), &candidates);
    let work = Work { points, faces, reach, candidates, spacing, least };
    let mut sure = work.sure(facing.as_ref());
    if let Some((mesh, facing)) = mesh.zip(facing.as_ref()) {
        by_facets::add(mesh, (&work, facing), &mut sure, progress)?;
    }
    // Half a step is what rounding takes away.
    let floor = 0.5 * single_step(points);
    let sparse = work.sparse(facing.is_none());
    let placed: Vec<Placed> = (faces.par_iter().zip(&sure).zip(&sparse))
        .map(|((face, sure), sparse)| {
            let least = sparse.map_or(floor, |reach| reach / EXPLAINED_SIGMAS);
            Placed::of(face, points, sure, least, options.seed)
        })
        .collect();
    cancelled(progress)?;
    let around: Vec<Sure> = (faces.par_iter().zip(&placed).zip(&sure))
        .map(|((face, placed), sure)| Sure::new(face, placed, points, sure))
        .collect();
    drop(sure);
    cancelled(progress)?;
    let noise = continuation::noise(&around, options.seed).max(floor);
    let mut best = work.by_faces(&placed, noise);
    cancelled(progress)?;
    let (shared, mut between) = work.by_what_is_around(&mut best, &around, noise);
    work.adjacent_face(&mut best, &placed);
    cancelled(progress)?;
    drop((work, around));
    // Computed meshes have sharp edges.
    let straddle = |(mesh, facing)| by_facets::straddle_edges(mesh, &best, &shared, (faces, facing));
    let rounding = rounding::width(points, &best, (faces, &placed), noise, spacing);
    let is_scan = noise > floor || rounding > 0.0 || mesh.zip(facing.as_ref()).is_some_and(straddle);
    let rounded = if is_scan { spacing } else { 0.0 };
    let unexplained =
        Unexplained { scan, faces, placed: &placed, facing: facing.as_ref(), spacing, rounded, rounding };
    let (mut classes, hanging) = unexplained.classes(&mut best);
    between.retain(|b| classes[b.point as usize] == Class::Face);
    for b in &between {
        classes[b.point as usize] = Class::Between;
    }
    let size = faces.iter().fold(Aabb::EMPTY, |b, f| b.union(&f.bounds)).diagonal();
    let far = [size, OUTWARD_REACH_SHARE * size];
    let over = Over { points, faces, owners: &best.owner, facing: facing.as_ref(), spacing, rounded, far };
    let mut beyond = over.faces(&hanging, progress)?;
    let dents = over.dents(&hanging, &beyond, options.seed, progress)?;
    let inside = best.seat.iter().map(|s| s.is_some_and(|s| s.within() >= 0.0)).collect();
    let mut owners = best.owner;
    for (p, face) in dents {
        (owners[p as usize], classes[p as usize]) = (face, Class::Dent);
    }
    beyond.retain(|b| classes[b.point as usize] != Class::Dent);
    let facets = mesh.zip(facing.as_ref()).map_or(vec![], |(mesh, facing)| {
        by_facets::owners(mesh, (&owners, &classes), &shared, (faces, facing))
    });
    Ok(Partition { owners, classes, inside, facets, beyond, between, placed, spacing, noise, is_scan })
}

/// How far each face reaches.
fn reaches(faces: &[&Face], options: &Options) -> Result<Vec<f64>, PartitionError> {
    let of = |(number, face): (usize, &&Face)| {
        let own = options.reaches.get(&(number as u32)).copied().or(options.distance);
        let value = own.unwrap_or(DEFAULT_REACH_SHARE * face.bounds.diagonal());
        let is_length = value > 0.0 && value.is_finite();
        is_length.then_some(value).ok_or(PartitionError::Reach { face: number, value })
    };
    faces.iter().enumerate().map(of).collect()
}

/// The points near a face: within so far of it, and no farther beyond its border.
fn near(
    face: &Face,
    points: &[Point],
    facing: Option<&Facing>,
    reach: f64,
    spacing: f64,
    progress: &dyn Progress,
) -> Result<Vec<Candidate>, Cancelled> {
    let far = reach + SURE_BORDER_SPACINGS[0] * spacing;
    let bounds = face.bounds.widened(reach + spacing);
    let numbers: Vec<u32> =
        (0..points.len() as u32).into_par_iter().filter(|i| bounds.holds(&points[*i as usize])).collect();
    let places: Vec<Point> = numbers.par_iter().map(|i| points[*i as usize]).collect();
    let seats = face.seats(&places, reach, far, progress)?;
    let candidate = |(i, seat): (&u32, Option<Seat>)| {
        let seat = seat.filter(|s| s.within() >= -reach - spacing)?;
        let faces = facing.is_none_or(|f| f.may_be_of(*i, seat.normal()));
        faces.then_some(Candidate { point: *i, seat })
    };
    Ok(numbers.par_iter().zip(seats).filter_map(candidate).collect())
}

/// Distance of neighboring points: the root of the area of one, the median over some places; 1 where there are no neighbors.
///
/// ```
/// let points: Vec<_> = (0..2500).map(|i| [0.5 * f64::from(i % 50), 0.5 * f64::from(i / 50), 0.0]).collect();
/// assert!((trueness_geom::partition::spacing(&points, 0) - 0.5).abs() < 0.1);
/// ```
pub fn spacing(points: &[Point], seed: u64) -> f64 {
    let tree = PointTree::new(points);
    let mut all: Vec<f64> = crate::num::random::Random::new(seed)
        .choose(SPACING_PLACES, points.len())
        .into_iter()
        .filter_map(|i| {
            let near = tree.k_nearest(&points[i], SPACING_NEIGHBORS, None);
            let square = near.last()?.0;
            Some((std::f64::consts::PI * square / near.len() as f64).sqrt())
        })
        .filter(|d| *d > 0.0)
        .collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(1.0)
}

fn cancelled(progress: &dyn Progress) -> Result<(), Cancelled> {
    if progress.cancelled() { Err(Cancelled) } else { Ok(()) }
}

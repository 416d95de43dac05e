//! Whose point is it: one partition of a scan among the faces of its nominal.
//!
//! Partition is an operation of its own (ISO 17450-1), done once for the whole part, by likelihood, and not anew for each feature:
//!
//! 1. The nominal is cut into [`Faces`]: planes, cylinders, cones, spheres and tori, and what is free between creases.
//! 2. Each face is put where it really is, by the points that are surely its own: near it, facing as it does, clear of its border.
//! 3. A point that one face alone can have belongs to it. Near borders each of the faces there is asked where its surface goes on, by
//!    the sure points around; the point belongs to the one that it lies off by the least part of what noise and the going on allow.
//! 4. Points that no face explains are looked at together with their neighbors. What hangs together with points beyond the reach of
//!    all faces goes on into the material ([`Class::Deep`]) or out of it ([`Class::High`]) farther than the reach: a hole, a bump, a thing that
//!    stands there. What lies along a border is [`Class::Edge`] as far as scans round edges, farther [`Class::Broken`]: a burr, a groove, a chamfer
//!    that is not drawn. The rest is form of the face: a dent.
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
//! | `going_on` | where its surface goes on near a border |
//! | `unexplained` | what no face explains |

mod best;
mod by_facets;
mod cut;
mod faces;
mod facing;
mod going_on;
mod placed;
mod terms;
#[cfg(test)]
mod tests;
mod unexplained;

pub use cut::element;
pub use faces::{Face, Faces};
pub use placed::Placed;
pub use terms::{Beyond, Class, NO_FACE, Options, Partition, PartitionError};

use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::{Aabb, Point, dot};
use crate::spatial::neighbors::PointTree;
use best::{Best, Candidate};
use faces::Seat;
use facing::Facing;
use going_on::Sure;
use terms::EXPLAINED;
use unexplained::Over;

/// Share of its diagonal that a face reaches where nothing else is said.
const SHARE: f64 = 0.02;
/// Reaches from the nominal within which a face is looked for: the reach is about where it really is.
const AWAY: f64 = 2.0;
/// Cost of a point beyond a border, for each distance of neighbors: borders move with the faces that make them, and are known no sharper.
const BEYOND: f64 = 2.0;
/// Distances of neighbors beyond a border that cost nothing.
const FREE: f64 = 0.3;
/// A point is asked about again, by what is around, where the second of its faces costs less than this, or the best more than `ASKED`.
const SECOND: f64 = 6.0 * EXPLAINED;
const ASKED: f64 = 0.6 * EXPLAINED;
/// A corner of facets is of each face that costs at most so much more than its best one: at a sharp edge of two.
const SHARED: f64 = 3.0;
/// Cosine of the angle (120°) from which on faces are the two sides of a wall.
const OTHER_SIDE: f64 = -0.5;
/// Cosine of the angle (37°) up to which a sure point faces as its face does.
const FACING: f64 = 0.8;
/// Distances of neighbors from the border at which points are surely of a face: the first of these that leaves enough.
const CLEAR: [f64; 3] = [2.5, 1.5, 0.75];
/// Fewest sure points that are enough.
const FEWEST_SURE: usize = 20;
/// Share of the diagonal of all faces up to which what lies beyond the reach of a face, out of the material, may be of it. Into the material nothing else is.
const ELSEWHERE: f64 = 0.1;
/// Neighbors whose farthest tells the distance of neighbors, and places where that is looked at.
const NEIGHBORS: usize = 16;
const PLACES: usize = 200;

/// Parts the vertices of a measured mesh, or without facets the points of a cloud, among faces; all in millimeters and in one frame.
///
/// Vertices of a mesh have faces by where they lie and how they face; points of a cloud by where they lie alone. Points within noise of two faces are of
/// one of them. Deterministic for any number of threads. Cost: for each face a pass over the points, and a search for each point within its reach.
/// ```
/// use trueness_geom::partition::{Class, Faces, NO_FACE, Options, partition};
/// use trueness_geom::{mesh::Mesh, progress::Silent};
/// // The four faces of a tetrahedron, and places of its largest, 0.1 above it; one place is far off.
/// let nominal = Mesh {
///     positions: vec![[0.0, 0.0, 0.0], [30.0, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, -30.0]],
///     faces: vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
/// };
/// let faces = Faces::of(&nominal, &Silent)?;
/// let place = |k: u32| [f64::from(k % 20) + 0.5, f64::from(k / 20) + 0.5, 0.1];
/// let mut positions: Vec<_> = (0..400).map(place).filter(|p| p[0] + p[1] < 29.0).collect();
/// positions.push([5.0, 5.0, 40.0]);
/// let scan = Mesh { positions, faces: vec![] };
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
    scan: &Mesh,
    faces: &[&Face],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Partition, PartitionError> {
    let points = &scan.positions;
    if let Some(index) = points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        return Err(PartitionError::NotFinite { index });
    }
    if let Some(facet) = scan.faces.iter().position(|f| f.iter().any(|v| *v as usize >= points.len())) {
        return Err(PartitionError::NoSuchVertex { facet });
    }
    let reach = reaches(faces, options)?;
    let facing = (!scan.faces.is_empty()).then(|| Facing::new(scan));
    let spacing = spacing(points, options.seed);
    let mut candidates = vec![];
    for (face, reach) in faces.iter().zip(&reach) {
        candidates.push(near(face, points, facing.as_ref(), AWAY * reach, spacing, progress)?);
    }
    let work = Work { points, faces, reach, candidates, spacing };
    let mut sure = work.sure(facing.as_ref());
    if let Some(facing) = &facing {
        by_facets::add(scan, (&work, facing), &mut sure, progress)?;
    }
    let floor = rounding(points);
    let sparse = work.sparse(facing.is_none());
    let placed: Vec<Placed> = (faces.par_iter().zip(&sure).zip(&sparse))
        .map(|((face, sure), sparse)| {
            Placed::of(face, points, sure, sparse.map_or(floor, |reach| reach / EXPLAINED), options.seed)
        })
        .collect();
    cancelled(progress)?;
    let around: Vec<Sure> = (faces.par_iter().zip(&placed).zip(&sure))
        .map(|((face, placed), sure)| Sure::new(face, placed, points, sure))
        .collect();
    drop(sure);
    cancelled(progress)?;
    let noise = going_on::noise(&around, options.seed).max(floor);
    let mut best = work.by_faces(&placed, noise);
    cancelled(progress)?;
    let (shared, mut between) = work.by_what_is_around(&mut best, &around, noise);
    cancelled(progress)?;
    drop(work);
    let off = |p: u32, face: u32, seat: Seat| placed[face as usize].off(faces[face as usize], points[p as usize], seat);
    // What was computed has sharp edges.
    let rounded = if noise > floor { spacing } else { 0.0 };
    let (mut classes, hanging) = unexplained::classes(scan, &mut best, (spacing, rounded), off);
    between.retain(|b| classes[b.point as usize] == Class::Face);
    for b in &between {
        classes[b.point as usize] = Class::Between;
    }
    let facets = facing.as_ref().map_or(vec![], |facing| {
        by_facets::owners(scan, (&best.owner, &classes), &shared, (faces, facing))
    });
    let size = faces.iter().fold(Aabb::EMPTY, |b, f| b.union(&f.bounds)).diagonal();
    let over = Over { points, faces, around: &around, spacing, far: [size, ELSEWHERE * size] };
    let beyond = over.faces(&hanging, progress)?;
    drop(around);
    let inside = best.seat.iter().map(|s| s.is_some_and(|s| s.within >= 0.0)).collect();
    let owners = best.owner;
    Ok(Partition { owners, classes, inside, facets, beyond, between, placed, spacing, noise, rounding: floor })
}

/// How far each face reaches.
fn reaches(faces: &[&Face], options: &Options) -> Result<Vec<f64>, PartitionError> {
    let of = |(number, face): (usize, &&Face)| {
        let own = options.reaches.get(&(number as u32)).copied().or(options.distance);
        let value = own.unwrap_or(SHARE * face.bounds.diagonal());
        let is_length = value > 0.0 && value.is_finite();
        is_length.then_some(value).ok_or(PartitionError::Reach { face: number, value })
    };
    faces.iter().enumerate().map(of).collect()
}

/// Points and the faces that they may be of.
struct Work<'a> {
    points: &'a [Point],
    faces: &'a [&'a Face],
    /// Of each face.
    reach: Vec<f64>,
    candidates: Vec<Vec<Candidate>>,
    spacing: f64,
}

impl Work<'_> {
    /// The points that are surely of each face: it is the nearest of those over which they lie, they face as it does and lie clear of its border.
    fn sure(&self, facing: Option<&Facing>) -> Vec<Vec<Candidate>> {
        let mut least = vec![f64::INFINITY; self.points.len()];
        for c in self.candidates.iter().flatten().filter(|c| c.seat.within > 0.0) {
            let least = &mut least[c.point as usize];
            *least = least.min(c.seat.off.abs());
        }
        let clear = |near: &[Candidate], reach: f64, times: f64| -> Vec<Candidate> {
            let is_own = |c: &&Candidate| {
                let (p, off) = (c.point as usize, c.seat.off.abs());
                c.seat.within > times * self.spacing
                    && off <= reach.min(least[p])
                    && facing.is_none_or(|f| dot(f.vertices[p], c.seat.normal) > FACING)
            };
            near.iter().filter(is_own).copied().collect()
        };
        let of_face = |(near, reach): (&Vec<Candidate>, &f64)| {
            let mut found = vec![];
            for times in CLEAR {
                found = clear(near, *reach, times);
                if found.len() >= FEWEST_SURE {
                    break;
                }
            }
            found
        };
        self.candidates.par_iter().zip(&self.reach).map(of_face).collect()
    }

    /// Of a cloud with few points over a face, as a probe takes them: what they deviate by is not known, and all within the reach is explained.
    fn sparse(&self, is_cloud: bool) -> Vec<Option<f64>> {
        let few = |(near, reach): (&Vec<Candidate>, &f64)| {
            let is_over = |c: &&Candidate| c.seat.within >= 0.0 && c.seat.off.abs() <= *reach;
            (is_cloud && near.iter().filter(is_over).take(FEWEST_SURE).count() < FEWEST_SURE).then_some(*reach)
        };
        self.candidates.iter().zip(&self.reach).map(few).collect()
    }

    /// The face of each point by the distance from where the faces really are.
    fn by_faces(&self, placed: &[Placed], noise: f64) -> Best {
        let mut best = Best::new(self.points.len());
        for (number, face) in self.faces.iter().enumerate() {
            let scale = placed[number].deviation.max(noise);
            for c in &self.candidates[number] {
                let off = placed[number].off(face, self.points[c.point as usize], c.seat).abs();
                let is_there = c.seat.within > -FREE * self.spacing || off <= EXPLAINED * scale;
                if off <= self.spacing && c.seat.within >= -self.spacing {
                    let near = &mut best.near[c.point as usize];
                    *near = near.saturating_add(1);
                }
                if is_there && off <= self.reach[number] {
                    best.add(c, number as u32, off / scale + self.beyond(c.seat.within));
                }
            }
        }
        best
    }

    /// Those whose face is not certain by that, by what is around them. Tells points, ascending, with all faces that explain them about as
    /// well as the best.
    fn by_what_is_around(
        &self,
        best: &mut Best,
        around: &[Sure],
        noise: f64,
    ) -> (Vec<(u32, u32)>, Vec<Beyond>) {
        let asked: Vec<bool> = (best.cost.iter().zip(&best.second))
            .map(|(cost, second)| cost.is_finite() && (*second < SECOND || *cost > ASKED))
            .collect();
        let again: Vec<Vec<(Candidate, f64)>> = (self.candidates.par_iter().zip(around).zip(&self.reach))
            .map(|((near, around), reach)| {
                let ask = |c: &Candidate| {
                    let z = around.off_over(self.points[c.point as usize], c.seat, *reach, noise)?;
                    Some((*c, z + self.beyond(c.seat.within + FREE * self.spacing)))
                };
                near.par_iter().filter(|c| asked[c.point as usize]).filter_map(ask).collect()
            })
            .collect();
        (0..self.points.len()).filter(|p| asked[*p]).for_each(|p| best.forget(p));
        let (mut shared, mut between) = (vec![], vec![]);
        for (number, near) in (0u32..).zip(&again) {
            near.iter().for_each(|(c, cost)| best.add(c, number, *cost));
        }
        for (number, near) in (0u32..).zip(&again) {
            let is_alike = |n: &&(Candidate, f64)| {
                n.1 <= EXPLAINED.min(best.cost[n.0.point as usize] + SHARED)
            };
            shared.extend(near.iter().filter(is_alike).map(|n| (n.0.point, number)));
            // What no face explains may be of the other side of a wall too.
            let is_other_side = |c: &Candidate| {
                let p = c.point as usize;
                let own = best.seat[p].filter(|_| best.cost[p] > EXPLAINED && best.owner[p] != number);
                c.seat.within > 0.0 && own.is_some_and(|own| dot(own.normal, c.seat.normal) < OTHER_SIDE)
            };
            let other_side = near.iter().map(|n| n.0).filter(is_other_side);
            between.extend(other_side.map(|c| Beyond { point: c.point, face: number, off: c.seat.off }));
        }
        shared.sort_unstable();
        (shared, between)
    }

    fn beyond(&self, within: f64) -> f64 {
        BEYOND * (-within).max(0.0) / self.spacing
    }
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
    let far = reach + CLEAR[0] * spacing;
    let bounds = face.bounds.widened(reach + spacing);
    let numbers: Vec<u32> =
        (0..points.len() as u32).into_par_iter().filter(|i| bounds.holds(&points[*i as usize])).collect();
    let places: Vec<Point> = numbers.par_iter().map(|i| points[*i as usize]).collect();
    let seats = face.seats(&places, reach, far, progress)?;
    let candidate = |(i, seat): (&u32, Option<Seat>)| {
        let seat = seat.filter(|s| s.within >= -reach - spacing)?;
        let faces = facing.is_none_or(|f| f.may_be_of(*i, seat.normal));
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
        .choose(PLACES, points.len())
        .into_iter()
        .filter_map(|i| {
            let near = tree.k_nearest(&points[i], NEIGHBORS, None);
            let square = near.last()?.0;
            Some((std::f64::consts::PI * square / near.len() as f64).sqrt())
        })
        .filter(|d| *d > 0.0)
        .collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(1.0)
}

/// Half a step of single precision of the coordinates.
fn rounding(points: &[Point]) -> f64 {
    let greatest = points.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    0.5 * greatest * f64::from(f32::EPSILON)
}

fn cancelled(progress: &dyn Progress) -> Result<(), Cancelled> {
    if progress.cancelled() { Err(Cancelled) } else { Ok(()) }
}

//! What no face explains.

use super::best::Best;
use super::cut::NO_FACE;
use super::faces::{Face, Seat};
use super::facing::Facing;
use super::terms::{Beyond, Class, EXPLAINED};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, minus, times};
use crate::spatial::neighbors::PointTree;
use std::collections::BTreeMap;

/// Points beyond all reach from which on what hangs together with them is of other things.
const SEVERAL: usize = 3;
/// Distances of neighbors from a border up to which points lie along it.
const ALONG: f64 = 1.0;
/// Nothing was measured at a place if no point is within so many distances of neighbors: by chance, where points lie at random, one time in a million.
const GAP: f64 = 2.1;
/// Distances of neighbors from a border, and off the face, up to which scans round an edge.
const ROUNDED: f64 = 2.0;
/// Neighbors of a point in a cloud, and distances of neighbors within which they hang together.
const NEIGHBORS: usize = 8;
const TOGETHER: f64 = 2.5;

/// The class of each point, and points beyond all reach with the faces that they hang together with. Points that turn out to be of no face lose their owner.
/// `rounded` is the distance of neighbors in a scan, which rounds edges by some of it; 0 where edges are sharp. `off` tells how far a point is off a face where
/// that really is.
pub(super) fn classes(
    scan: &Mesh,
    best: &mut Best,
    (spacing, rounded): (f64, f64),
    off: impl Fn(u32, u32, Seat) -> f64,
) -> (Vec<Class>, Vec<Hanging>) {
    let is_open = |p: usize| best.cost[p].is_nan() || best.cost[p] > EXPLAINED;
    let mut classes: Vec<Class> =
        best.owner.iter().map(|o| if *o == NO_FACE { Class::Beyond } else { Class::Face }).collect();
    let open: Vec<u32> = (0..best.owner.len() as u32).filter(|p| is_open(*p as usize)).collect();
    let mut hanging = vec![];
    for (group, beside) in groups(scan, &open, spacing) {
        let (of_faces, beyond): (Vec<u32>, Vec<u32>) =
            group.into_iter().partition(|p| best.owner[*p as usize] != NO_FACE);
        let seats = || of_faces.iter().filter_map(|p| best.seat[*p as usize]);
        let (total, outside) = (seats().count(), seats().filter(|s| s.off > 0.0).count());
        let is_along = |p: &&u32| {
            let p = **p as usize;
            best.near[p] > 1 || best.seat[p].is_some_and(|s| s.within < ALONG * spacing)
        };
        let along = of_faces.iter().filter(is_along).count();
        if beyond.len() >= SEVERAL && total > 0 {
            let class = if 2 * outside >= total { Class::High } else { Class::Deep };
            let mut faces = vec![];
            for p in of_faces.iter().map(|p| *p as usize) {
                classes[p] = class;
                match best.seat[p] {
                    Some(seat) if seat.within > 0.0 => faces.push(best.owner[p]),
                    _ => best.owner[p] = NO_FACE,
                }
            }
            faces.sort_unstable();
            faces.dedup();
            beyond.iter().for_each(|p| classes[*p as usize] = class);
            hanging.push(Hanging { points: beyond, faces });
        } else if beyond.len() < SEVERAL {
            for p in of_faces.iter().filter(|_| 2 * along > total) {
                let number = *p as usize;
                let is_near = |seat: Seat| {
                    (best.near[number] > 1 || seat.within < ROUNDED * rounded)
                        && off(*p, best.owner[number], seat).abs() < ROUNDED * rounded
                };
                let is_edge = best.seat[number].is_some_and(is_near);
                classes[number] = if is_edge { Class::Edge } else { Class::Broken };
            }
            beyond.iter().for_each(|p| classes[*p as usize] = Class::Alone);
            if !beyond.is_empty() {
                hanging.push(Hanging { points: beyond, faces: vec![] });
            }
        } else {
            // Facets join it to points of faces.
            let mut faces: Vec<u32> = beside.iter().map(|p| best.owner[*p as usize]).collect();
            faces.retain(|face| *face != NO_FACE);
            faces.sort_unstable();
            faces.dedup();
            hanging.push(Hanging { points: beyond, faces });
        }
    }
    (classes, hanging)
}

/// Points beyond the reach of all faces that hang together.
pub(super) struct Hanging {
    pub points: Vec<u32>,
    /// The faces whose points hang together with them; none where they are by themselves.
    pub faces: Vec<u32>,
}

/// Where points beyond the reach of faces may lie over one.
pub(super) struct Over<'a> {
    pub points: &'a [Point],
    pub faces: &'a [&'a Face],
    /// The face of each point.
    pub owners: &'a [u32],
    /// Of a mesh.
    pub facing: Option<&'a Facing>,
    pub spacing: f64,
    /// The same of a scan; 0 where edges are sharp, up to which points lie over a face.
    pub rounded: f64,
    /// How far off a face, into the material and out of it, mm.
    pub far: [f64; 2],
}

impl Over<'_> {
    /// The points that lie over faces: over those that they hang together with; those by themselves over the nearest, where nothing of it was measured
    /// beneath some of them, or where they are alone.
    pub(super) fn faces(
        &self,
        hanging: &[Hanging],
        progress: &dyn Progress,
    ) -> Result<Vec<Beyond>, Cancelled> {
        let mut of_faces: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for hanging in hanging {
            hanging.faces.iter().for_each(|f| of_faces.entry(*f).or_default().extend(&hanging.points));
        }
        let mut found = vec![];
        for (face, numbers) in of_faces {
            found.extend(self.face(face, &numbers, progress)?);
        }
        let themselves: Vec<&Hanging> = hanging.iter().filter(|h| h.faces.is_empty()).collect();
        let mut numbers: Vec<u32> = themselves.iter().flat_map(|h| h.points.iter().copied()).collect();
        numbers.sort_unstable();
        let mut over: Vec<BTreeMap<u32, (Beyond, bool)>> = vec![];
        for face in 0..self.faces.len() as u32 {
            let here = if numbers.is_empty() { vec![] } else { self.face(face, &numbers, progress)? };
            let gaps = self.gaps(face, &here);
            over.push(here.into_iter().zip(gaps).map(|(b, gap)| (b.point, (b, gap))).collect());
        }
        for hanging in themselves {
            let mut nearest: Option<(f64, Vec<Beyond>)> = None;
            for over in &over {
                let own: Vec<(Beyond, bool)> =
                    hanging.points.iter().filter_map(|p| over.get(p)).copied().collect();
                let gaps = own.iter().filter(|over| over.1).count();
                let own: Vec<Beyond> = own.into_iter().map(|over| over.0).collect();
                let off = own.iter().map(|b| b.off.abs()).sum::<f64>() / own.len() as f64;
                let counts = !own.is_empty() && (hanging.points.len() < SEVERAL || gaps >= SEVERAL);
                if counts && nearest.as_ref().is_none_or(|n| off < n.0) {
                    nearest = Some((off, own));
                }
            }
            found.extend(nearest.map_or(vec![], |n| n.1));
        }
        found.sort_unstable_by_key(|b| (b.face, b.point));
        Ok(found)
    }

    /// Those of some points that lie over a face, clear of its border; of a mesh those that face as it does.
    fn face(&self, face: u32, numbers: &[u32], progress: &dyn Progress) -> Result<Vec<Beyond>, Cancelled> {
        let Over { points, faces, rounded, far, .. } = *self;
        let places: Vec<Point> = numbers.iter().map(|p| points[*p as usize]).collect();
        let seats = faces[face as usize].seats(&places, far[0].max(far[1]), rounded, progress)?;
        let over = |(p, seat): (&u32, Option<Seat>)| {
            let seat = seat.filter(|s| s.within >= rounded && -far[0] <= s.off && s.off <= far[1])?;
            let faces = self.facing.is_none_or(|f| f.may_be_of(*p, seat.normal));
            faces.then_some(Beyond { point: *p, face, off: seat.off })
        };
        Ok(numbers.iter().zip(seats).filter_map(over).collect())
    }

    /// Whether nothing of a face was measured beneath each of these points. A computed mesh was not measured.
    fn gaps(&self, face: u32, over: &[Beyond]) -> Vec<bool> {
        if over.is_empty() || self.rounded == 0.0 {
            return vec![true; over.len()];
        }
        let own = (0..self.points.len()).filter(|p| self.owners[*p] == face).map(|p| self.points[p]);
        let tree = PointTree::new(&own.collect::<Vec<Point>>());
        let is_gap = |beyond: &Beyond| {
            let p = self.points[beyond.point as usize];
            let normal = self.faces[face as usize].facing(&p);
            let foot = normal.map_or(p, |n| minus(p, times(beyond.off, n)));
            tree.nearest(&foot).is_none_or(|(square, _)| square.sqrt() > GAP * self.spacing)
        };
        over.iter().map(is_gap).collect()
    }
}

/// Those of some points that hang together, in the order of the first of each; of a mesh with other vertices of their facets.
fn groups(scan: &Mesh, open: &[u32], spacing: f64) -> Vec<(Vec<u32>, Vec<u32>)> {
    let place = |p: u32| open.binary_search(&p).ok().map(|i| i as u32);
    let mut groups = Groups((0..open.len() as u32).collect());
    match scan.faces.is_empty() {
        false => {
            for f in &scan.faces {
                for k in 0..3 {
                    if let (Some(a), Some(b)) = (place(f[k]), place(f[(k + 1) % 3])) {
                        groups.join(a, b);
                    }
                }
            }
        }
        true => {
            let places: Vec<Point> = open.iter().map(|p| scan.positions[*p as usize]).collect();
            let tree = PointTree::new(&places);
            let together = (TOGETHER * spacing).powi(2);
            let near = |i: u32| {
                let near = tree.k_nearest(&places[i as usize], NEIGHBORS, Some(i));
                near.into_iter().filter(|n| n.0 <= together).map(|n| n.1).collect::<Vec<u32>>()
            };
            let all: Vec<Vec<u32>> = (0..open.len() as u32).into_par_iter().map(near).collect();
            for (i, near) in (0u32..).zip(all) {
                near.into_iter().for_each(|j| groups.join(i, j));
            }
        }
    }
    let mut members: Vec<(u32, u32)> = (0u32..).zip(open).map(|(i, p)| (groups.find(i), *p)).collect();
    members.sort_unstable();
    let mut beside: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for f in &scan.faces {
        let Some(inside) = f.iter().find_map(|v| place(*v)) else { continue };
        let others = f.iter().copied().filter(|v| place(*v).is_none());
        beside.entry(groups.find(inside)).or_default().extend(others);
    }
    let group = |g: &[(u32, u32)]| {
        (g.iter().map(|m| m.1).collect(), g.first().and_then(|m| beside.remove(&m.0)).unwrap_or_default())
    };
    members.chunk_by(|a, b| a.0 == b.0).map(group).collect()
}

/// Points that hang together.
struct Groups(Vec<u32>);

impl Groups {
    fn find(&mut self, mut p: u32) -> u32 {
        while self.0[p as usize] != p {
            let above = self.0[self.0[p as usize] as usize];
            self.0[p as usize] = above;
            p = above;
        }
        p
    }
    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

//! Points that no face explains.

use super::best::Best;
use super::cut::NO_FACE;
use super::faces::{Face, Seat};
use super::facing::Facing;
use super::placed::Placed;
use super::rounding::to_edge;
use super::terms::{Beyond, Class, EXPLAINED_SIGMAS};
use super::work::MIN_SCANNED_POINTS;
use crate::num::random::Random;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::scan::Scan;
use crate::space::{Aabb, Point, minus, plus, times};
use crate::spatial::neighbors::PointTree;
use std::collections::BTreeMap;

/// Points beyond all reach from which on the points that hang together with them belong to other things.
const MIN_OTHER_POINTS: usize = 3;
/// Spacings off a face up to which the surface around may lead to a point. Farther off it would be steeper than 45°.
const MAX_STEP_SPACINGS: f64 = 1.0;
/// Distances of neighbors from a border up to which points lie along it.
const ALONG_BORDER_SPACINGS: f64 = 1.0;
/// Spacings without a point within which nothing was measured. Where points lie at random, chance leaves such a gap one time in
/// a million.
const UNMEASURED_SPACINGS: f64 = 2.1;
/// Distances of neighbors from a border, and off the face, up to which scans round an edge.
const ROUNDED_BORDER_RATIO: f64 = 2.0;
/// Distances that differ by less than this share are those of one place.
const SAME_PLACE_SHARE: f64 = 1e-9;
/// Places of a dent where it is looked whether something was measured.
const DENT_PLACES: usize = 100;
/// Neighbors of a point in a cloud that may hang together with it.
const HANGING_NEIGHBORS: usize = 8;
/// Spacings within which they do.
const HANGING_SPACINGS: f64 = 2.5;

/// The evidence about points that no face explains.
pub(super) struct Unexplained<'a> {
    pub scan: &'a Scan,
    pub faces: &'a [&'a Face],
    /// Where these really are.
    pub placed: &'a [Placed],
    /// How the facets of a mesh face.
    pub facing: Option<&'a Facing>,
    pub spacing: f64,
    /// The same of a scan, which rounds edges by some of it; 0 where edges are sharp.
    pub rounded: f64,
    /// How far from edges it does, millimeters.
    pub rounding: f64,
}

impl Unexplained<'_> {
    /// The class of each point, and points beyond all reach with the faces that they hang together with. Points that turn out to be of no face lose their owner.
    pub(super) fn classes(&self, best: &mut Best) -> (Vec<Class>, Vec<Hanging>) {
        let class = |p: u32| match best.owner[p as usize] {
            // Also what edges join together, as all of a part's.
            _ if self.is_rounded(best, p) => Class::Edge,
            NO_FACE => Class::Beyond,
            _ => Class::Face,
        };
        let mut classes: Vec<Class> = (0..best.owner.len() as u32).map(class).collect();
        let is_left = |p: &u32| is_open(best, *p as usize) && classes[*p as usize] != Class::Edge;
        let open: Vec<u32> = (0..best.owner.len() as u32).filter(is_left).collect();
        let mut hanging = vec![];
        for (group, adjacent_points) in groups(self.scan, &open, self.spacing) {
            let (of_faces, beyond): (Vec<u32>, Vec<u32>) =
                group.into_iter().partition(|p| best.owner[*p as usize] != NO_FACE);
            if beyond.len() < MIN_OTHER_POINTS {
                for (p, class) in self.within_reach(best, &of_faces, beyond.len()) {
                    classes[p as usize] = class;
                }
                beyond.iter().for_each(|p| classes[*p as usize] = Class::Alone);
                if !beyond.is_empty() {
                    hanging.push(Hanging { points: beyond, flank: vec![], faces: vec![], around: vec![] });
                }
                continue;
            }
            // Facets join it to points of faces.
            let mut faces = faces_of(&adjacent_points, &best.owner);
            let around = faces_of(&[&adjacent_points[..], &of_faces].concat(), &best.owner);
            let mut flank = of_faces;
            let seats: Vec<Seat> = flank.iter().filter_map(|p| best.seat[*p as usize]).collect();
            if !seats.is_empty() {
                let outside = seats.iter().filter(|s| s.off > 0.0).count();
                let class = if 2 * outside >= seats.len() { Class::High } else { Class::Deep };
                flank.iter().chain(&beyond).for_each(|p| classes[*p as usize] = class);
                flank.retain(|p| {
                    let is_over = best.seat[*p as usize].is_some_and(|seat| seat.within() > 0.0);
                    if !is_over {
                        best.owner[*p as usize] = NO_FACE;
                    }
                    is_over
                });
                faces = faces_of(&flank, &best.owner);
            }
            hanging.push(Hanging { points: beyond, flank, faces, around });
        }
        (classes, hanging)
    }

    /// The classes of points of faces that hang together with no more than some strays.
    fn within_reach(&self, best: &Best, group: &[u32], strays: usize) -> Vec<(u32, Class)> {
        let far = self.rounding + ALONG_BORDER_SPACINGS * self.spacing;
        let along = group.iter().filter(|p| self.is_along(best, **p, far)).count();
        let class = |p: u32| {
            let own = best.owner[p as usize];
            let off = self.off(best, p);
            let is_scanned = self.rounded > 0.0 && self.placed[own as usize].points >= MIN_SCANNED_POINTS;
            let is_edge = || {
                off < ROUNDED_BORDER_RATIO * self.rounded
                    && self.is_along(best, p, ROUNDED_BORDER_RATIO * self.rounded)
            };
            match 2 * along > group.len() {
                true if is_edge() => Class::Edge,
                true => Class::Broken,
                false
                    if group.len() + strays < MIN_OTHER_POINTS
                        && is_scanned
                        && off > MAX_STEP_SPACINGS * self.spacing =>
                {
                    Class::Alone
                }
                false => Class::Face,
            }
        };
        group.iter().map(|p| (*p, class(*p))).collect()
    }

    /// How far a point is off its face where that really is; infinite where it has none.
    fn off(&self, best: &Best, p: u32) -> f64 {
        let (own, seat) = (best.owner[p as usize] as usize, best.seat[p as usize]);
        let place = self.scan.points()[p as usize];
        seat.map_or(f64::INFINITY, |seat| self.placed[own].off(self.faces[own], place, seat).abs())
    }

    /// Whether it lies where the scan rounds edges.
    fn is_rounded(&self, best: &Best, p: u32) -> bool {
        to_edge(best, self.faces, p as usize) < self.rounding
            && (best.owner[p as usize] == NO_FACE || self.off(best, p) < ROUNDED_BORDER_RATIO * self.rounding)
    }

    /// Whether it lies no farther from the border of its face. Where that is not known a face ends where facets lead to another one, or to a wall.
    fn is_along(&self, best: &Best, p: u32, far: f64) -> bool {
        let own = best.owner[p as usize];
        let ends = |seat: Seat| {
            let is_other = |v: &u32| !is_open(best, *v as usize) && best.owner[*v as usize] != own;
            let is_wall = |f: &u32| self.facing.is_some_and(|facing| !facing.is_along(*f, seat.normal()));
            let ends = |f: &u32| is_wall(f) || self.scan.facets()[*f as usize].iter().any(is_other);
            self.facing.is_some_and(|facing| facing.about(p).iter().any(ends))
        };
        let is_along = |s: Seat| s.within() < far || !self.faces[own as usize].is_bounded() && ends(s);
        f64::from(best.adjacent_face[p as usize]) <= self.spacing
            || best.seat[p as usize].is_some_and(is_along)
    }
}

/// Whether no face explains it.
fn is_open(best: &Best, p: usize) -> bool {
    best.cost[p].is_nan() || best.cost[p] > EXPLAINED_SIGMAS
}

/// The faces of some points, ascending.
fn faces_of(points: &[u32], owners: &[u32]) -> Vec<u32> {
    let mut faces: Vec<u32> = points.iter().map(|p| owners[*p as usize]).collect();
    faces.retain(|face| *face != NO_FACE);
    faces.sort_unstable();
    faces.dedup();
    faces
}

/// Points beyond the reach of all faces that hang together.
pub(super) struct Hanging {
    pub points: Vec<u32>,
    /// Points of faces, within their reach, that hang together with them.
    flank: Vec<u32>,
    /// The faces of these, or where there are none, of points that facets join to them; none where they are by themselves.
    faces: Vec<u32>,
    /// All faces at the border of what hangs together, those beyond whose borders it lies too.
    around: Vec<u32>,
}

/// Where points beyond the reach of faces may lie over one.
pub(super) struct Over<'a> {
    pub points: &'a [Point],
    pub faces: &'a [&'a Face],
    /// The face of each point.
    pub owners: &'a [u32],
    /// How the facets of a mesh face.
    pub facing: Option<&'a Facing>,
    pub spacing: f64,
    /// The same of a scan; 0 where edges are sharp, up to which points lie over a face.
    pub rounded: f64,
    /// How far off a face, into the material and out of it, mm.
    pub far: [f64; 2],
}

impl Over<'_> {
    /// The points that lie over faces. They lie over the nearest one where nothing was measured beneath some of them, or where
    /// they are alone. Points that no face explains so lie over those that they hang together with. Points on one side of the
    /// nearest face lie on that side of all.
    pub(super) fn faces(
        &self,
        hanging: &[Hanging],
        progress: &dyn Progress,
    ) -> Result<Vec<Beyond>, Cancelled> {
        let all = self.faces.iter().fold(Aabb::EMPTY, |b, f| b.union(&f.bounds)).widened(self.far[1]);
        let numbers = hanging.iter().flat_map(|h| h.points.iter().copied());
        let mut numbers: Vec<u32> = numbers.filter(|p| all.holds(&self.points[*p as usize])).collect();
        numbers.sort_unstable();
        let outside = self.outside(&numbers, progress)?;
        let sides: Vec<(u32, bool)> = numbers.into_iter().zip(outside).collect();
        let mut over: Vec<BTreeMap<u32, (Beyond, bool)>> = vec![];
        for face in 0..self.faces.len() as u32 {
            let here = self.face(face, &sides, progress)?;
            let gaps = self.gaps(face, &here);
            over.push(here.into_iter().zip(gaps).map(|(b, gap)| (b.point, (b, gap))).collect());
        }
        let mut found = vec![];
        for hanging in hanging {
            found.extend(explained(hanging, &over, self.facing.is_none()));
        }
        found.sort_unstable_by_key(|b| (b.face, b.point));
        Ok(found)
    }

    /// Whether each of some points lies out of the material. It lies on that side of the nearest face; of several about an edge
    /// on that of the face which it is farther across.
    fn outside(&self, numbers: &[u32], progress: &dyn Progress) -> Result<Vec<bool>, Cancelled> {
        let mut nearest: Vec<(f64, f64)> = vec![(f64::INFINITY, 0.0); numbers.len()];
        for face in self.faces {
            let is_near = |i: &usize| {
                let away = face.bounds.distance(&self.points[numbers[*i] as usize]);
                away <= nearest[*i].0 * (1.0 + SAME_PLACE_SHARE)
            };
            let near: Vec<usize> = (0..numbers.len()).into_par_iter().filter(is_near).collect();
            let places: Vec<Point> = near.par_iter().map(|i| self.points[numbers[*i] as usize]).collect();
            let seats = face.seats(&places, f64::INFINITY, f64::INFINITY, progress)?;
            for (i, seat) in near.into_iter().zip(seats) {
                let Some(seat) = seat else { continue };
                let away = libm::hypot(seat.off, seat.within().min(0.0));
                let (least, off) = nearest[i];
                let is_alike = (away - least).abs() <= SAME_PLACE_SHARE * least;
                if (is_alike && seat.off.abs() > off.abs()) || (!is_alike && away < least) {
                    nearest[i] = (away, seat.off);
                }
            }
        }
        Ok(nearest.into_iter().map(|n| n.1 > 0.0).collect())
    }

    /// The points, ascending and with their side, that lie over a face, clear of its border; of a mesh those that face as it
    /// does.
    fn face(
        &self,
        face: u32,
        sides: &[(u32, bool)],
        progress: &dyn Progress,
    ) -> Result<Vec<Beyond>, Cancelled> {
        let Over { points, faces, rounded, far, .. } = *self;
        let bounds = faces[face as usize].bounds.widened(far[1]);
        let may_be = |(p, outside): &&(u32, bool)| !outside || bounds.holds(&points[*p as usize]);
        let sides: Vec<(u32, bool)> = sides.iter().filter(may_be).copied().collect();
        let places: Vec<Point> = sides.iter().map(|(p, _)| points[*p as usize]).collect();
        let seats = faces[face as usize].seats(&places, far[0].max(far[1]), rounded, progress)?;
        let over = |((p, outside), seat): (&(u32, bool), Option<Seat>)| {
            let is_far = |s: &Seat| {
                if *outside { 0.0 < s.off && s.off <= far[1] } else { -far[0] <= s.off && s.off < 0.0 }
            };
            let seat = seat.filter(|s| s.within() >= rounded && is_far(s))?;
            let faces = self.facing.is_none_or(|f| f.may_be_of(*p, seat.normal()));
            faces.then_some(Beyond { point: *p, face, off: seat.off })
        };
        Ok(sides.iter().zip(seats).filter_map(over).collect())
    }

    /// The points of dents among those that go on into the material, with the face that each is in. That face alone is around,
    /// and something was measured at each place over it. A hole is open, or leads to another face.
    pub(super) fn dents(
        &self,
        hanging: &[Hanging],
        beyond: &[Beyond],
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<Vec<(u32, u32)>, Cancelled> {
        let (mut found, mut own) = (vec![], BTreeMap::new());
        for hanging in hanging {
            let [face] = hanging.around[..] else { continue };
            let is_in = |p: &&u32| {
                let at = beyond.binary_search_by_key(&(face, **p), |b| (b.face, b.point));
                at.is_ok_and(|i| beyond[i].off < 0.0)
            };
            let deep = hanging.points.iter().filter(is_in).count();
            let points = [&hanging.points[..], &hanging.flank].concat();
            if deep < MIN_OTHER_POINTS {
                continue;
            }
            let own = own.entry(face).or_insert_with(|| self.points_of_face(face));
            if self.is_closed((face, own), &points, seed, progress)? {
                found.extend(points.into_iter().map(|p| (p, face)));
            }
        }
        Ok(found)
    }

    /// Whether something was measured, at any depth, at each place of a face between some points over it. A computed mesh was not measured.
    fn is_closed(
        &self,
        (face, own): (u32, &PointTree),
        points: &[u32],
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<bool, Cancelled> {
        if self.rounded == 0.0 {
            return Ok(true);
        }
        let feet = |places: &[Point]| -> Result<Vec<Point>, Cancelled> {
            let seats = self.faces[face as usize].seats(places, f64::INFINITY, f64::INFINITY, progress)?;
            let foot = |(p, seat): (&Point, Option<Seat>)| Some(minus(*p, times(seat?.off, seat?.normal())));
            Ok(places.iter().zip(seats).filter_map(foot).collect())
        };
        let places: Vec<Point> = points.iter().map(|p| self.points[*p as usize]).collect();
        let over = feet(&places)?;
        let mut random = Random::new(seed);
        let mut any = || over.get(random.below(over.len().max(1) as u64) as usize).copied();
        let mut middle = || Some(times(0.5, plus(any()?, any()?)));
        let between: Vec<Point> = (0..DENT_PLACES).filter_map(|_| middle()).collect();
        let there = PointTree::new(&over);
        let is_near = |tree: &PointTree, p: &Point| {
            tree.nearest(p).is_some_and(|n| n.0.sqrt() <= UNMEASURED_SPACINGS * self.spacing)
        };
        let is_measured = |p: &Point| is_near(&there, p) || is_near(own, p);
        Ok(feet(&between)?.par_iter().all(is_measured))
    }

    /// The points of a face.
    fn points_of_face(&self, face: u32) -> PointTree {
        let own = (0..self.points.len()).filter(|p| self.owners[*p] == face).map(|p| self.points[p]);
        PointTree::new(&own.collect::<Vec<Point>>())
    }

    /// Whether nothing of a face was measured beneath each of these points. A computed mesh was not measured.
    fn gaps(&self, face: u32, over: &[Beyond]) -> Vec<bool> {
        if over.is_empty() || self.rounded == 0.0 {
            return vec![true; over.len()];
        }
        let tree = self.points_of_face(face);
        let is_gap = |beyond: &Beyond| {
            let p = self.points[beyond.point as usize];
            let normal = self.faces[face as usize].facing(&p);
            let foot = normal.map_or(p, |n| minus(p, times(beyond.off, n)));
            tree.nearest(&foot).is_none_or(|(square, _)| square.sqrt() > UNMEASURED_SPACINGS * self.spacing)
        };
        over.par_iter().map(is_gap).collect()
    }
}

/// The faces over which what hangs together lies, by the points over each face, with whether nothing was measured beneath.
fn explained(hanging: &Hanging, over: &[BTreeMap<u32, (Beyond, bool)>], is_cloud: bool) -> Vec<Beyond> {
    let is_few = hanging.points.len() < MIN_OTHER_POINTS;
    let mut left = hanging.points.clone();
    let mut found = vec![];
    let is_inside = |here: &[(Beyond, bool)]| here.iter().all(|(b, _)| b.off < 0.0);
    // Out of the material a thing may hide some places; into it nothing else lies where the face was not measured.
    take_nearest(&mut left, over, &mut found, |here| {
        let needed = if is_inside(here) { 1 } else { MIN_OTHER_POINTS };
        is_few || here.iter().filter(|(_, gap)| *gap).count() >= needed
    });
    for face in &hanging.faces {
        found.extend(left.iter().filter_map(|p| over[*face as usize].get(p)).map(|(b, _)| *b));
    }
    // Nor does anything that no facets join to other faces.
    if is_cloud && hanging.faces.is_empty() {
        take_nearest(&mut left, over, &mut found, is_inside);
    }
    found
}

/// Takes the points over the nearest face of those over which they count, until they lie over no such one.
fn take_nearest(
    left: &mut Vec<u32>,
    over: &[BTreeMap<u32, (Beyond, bool)>],
    found: &mut Vec<Beyond>,
    counts: impl Fn(&[(Beyond, bool)]) -> bool,
) {
    loop {
        let here = |of: &BTreeMap<u32, (Beyond, bool)>| -> Vec<(Beyond, bool)> {
            left.iter().filter_map(|p| of.get(p)).copied().collect()
        };
        let off =
            |here: &[(Beyond, bool)]| here.iter().map(|(b, _)| b.off.abs()).sum::<f64>() / here.len() as f64;
        let all = over.iter().map(here).filter(|here| !here.is_empty() && counts(here));
        let Some(nearest) = all.min_by(|a, b| off(a).total_cmp(&off(b))) else { break };
        let those: Vec<u32> = nearest.iter().map(|(b, _)| b.point).collect();
        left.retain(|p| those.binary_search(p).is_err());
        found.extend(nearest.into_iter().map(|(b, _)| b));
    }
}

/// The groups of points that hang together, in the order of the first of each; of a mesh with other vertices of their facets.
fn groups(scan: &Scan, open: &[u32], spacing: f64) -> Vec<(Vec<u32>, Vec<u32>)> {
    let place = |p: u32| open.binary_search(&p).ok().map(|i| i as u32);
    let mut groups = Groups((0..open.len() as u32).collect());
    match scan {
        Scan::Mesh(mesh) => {
            for f in &mesh.faces {
                for k in 0..3 {
                    if let (Some(a), Some(b)) = (place(f[k]), place(f[(k + 1) % 3])) {
                        groups.join(a, b);
                    }
                }
            }
        }
        Scan::Cloud(points) => {
            let places: Vec<Point> = open.iter().map(|p| points[*p as usize]).collect();
            let tree = PointTree::new(&places);
            let together = (HANGING_SPACINGS * spacing).powi(2);
            let near = |i: u32| {
                let near = tree.k_nearest(&places[i as usize], HANGING_NEIGHBORS, Some(i));
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
    let mut adjacent_points: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for f in scan.facets() {
        let Some(inside) = f.iter().find_map(|v| place(*v)) else { continue };
        let others = f.iter().copied().filter(|v| place(*v).is_none());
        adjacent_points.entry(groups.find(inside)).or_default().extend(others);
    }
    let group = |g: &[(u32, u32)]| {
        (
            g.iter().map(|m| m.1).collect(),
            g.first().and_then(|m| adjacent_points.remove(&m.0)).unwrap_or_default(),
        )
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

//! Where the measured data lie on the reference, and which points of a cloud belong to what is beside a feature.
//!
//! Nearness to a nominal surface alone does not tell the points of a plane from those at the upper end of a wall beside it, and a
//! cloud has no facets that would tell by their angle. Where the reference is at hand, it does: a point that lies upon one of
//! its facets that runs at an angle to the feature is none of the feature's. Upon: as near as most of the cloud lies to the
//! reference. Of what lies farther off, as a bore larger than its model, the planes of the neighbors of each point tell
//! which way it faces: a piece that faces away from the feature and goes on beyond it is of another surface if the
//! reference has one there that faces as it does. Everything else counts, so that no dent is taken for the wall beside it. Without a
//! reference such pieces are left out too, and nothing that depends on it passes.

use super::data::{Data, Stop};
use super::seed::Seeded;
use crate::plan::Plan;
use std::collections::BTreeMap;
use trueness_geom::closest::{Hit, Query, QueryError, Tree};
use trueness_geom::feature::{FeatureSearch, Nearness, Nominal, NominalSurface, Piece};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::{self, Point, Vector, dot, minus, norm, plus, times};
use trueness_geom::spatial::neighbors::PointTree;

/// Points farther off than this share of the size of the reference are of something else.
pub(super) const ELSEWHERE: f64 = 0.1;
/// So many times the median distance from the reference a point lies upon it: above three standard deviations of noise.
const UPON: f64 = 5.0;
/// But no farther than this share of the distance up to which points are sought.
const FARTHEST: f64 = 0.25;
/// So many times the distance up to which points are sought, or within which they lie upon the reference, a wall may be off its place.
const WALL_REACH: f64 = 3.0;
/// A piece is of the reference if this share of its points is.
const MOST: f64 = 0.75;
/// So many times nearer a face is clearly the nearer one.
const NEARER: f64 = 2.0;
/// Most steps along an edge.
const STEPS: f64 = 1e4;
/// A facet of the reference may be off the surface of the nominal by this share of the distance up to which points are sought.
const ON: f64 = 1e-3;
/// So many times the angle that a feature allows others of the reference may be turned against it that face as it does.
const ALIKE: f64 = 2.0;
/// Distances that differ by less than this share of the size of the reference are the same.
const SAME: f64 = 1e-9;

/// The measured data on the reference.
pub(super) struct Belonging<'a> {
    reference: &'a Mesh,
    measured: &'a [Point],
    /// Of the features that the reference has.
    search: FeatureSearch<'a>,
    size: f64,
    /// Of each measured point the nearest facet and how far off it is, mm; `u32::MAX` for what is elsewhere.
    nearest: Vec<(u32, f64)>,
    /// Median of the distances, mm.
    median: f64,
    /// A step of single precision, which meshes pass through in their files, mm.
    rounding: f64,
}

impl<'a> Belonging<'a> {
    /// Where there is a reference and a feature is sought by a nominal. Cost: a search tree, and a closest place for each measured
    /// point.
    pub fn new(
        plan: &Plan,
        data: &'a Data,
        seeds: &BTreeMap<usize, Seeded>,
        progress: &dyn Progress,
    ) -> Result<Option<Belonging<'a>>, Stop> {
        let sought = !seeds.is_empty() || plan.features.iter().any(|f| f.nominal.is_some());
        let (Some(measured), Some(reference)) = (&data.measured, &data.reference) else { return Ok(None) };
        if !sought || reference.faces.is_empty() {
            return Ok(None);
        }
        let tree = Tree::build_watched(reference, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let bounds = reference.bounds();
        let size = bounds.diagonal();
        let greatest = bounds.min.iter().chain(&bounds.max).fold(0.0, |m: f64, x| m.max(x.abs()));
        let rounding = f64::from(f32::EPSILON) * greatest;
        let nearest = nearest(&tree, &measured.positions, ELSEWHERE * size, progress)?;
        let mut all: Vec<f64> = nearest.iter().filter(|n| n.0 != u32::MAX).map(|n| n.1).collect();
        all.sort_unstable_by(f64::total_cmp);
        let median = all.get(all.len() / 2).copied().unwrap_or(0.0);
        let search = FeatureSearch::new(reference, tree);
        Ok(Some(Belonging {
            reference,
            measured: &measured.positions,
            search,
            size,
            nearest,
            median,
            rounding,
        }))
    }

    /// How far off the measured points are whose nearest facet is one of the nominal's, where that is beyond its distance, mm.
    pub fn beyond(&self, nominal: &Nominal, near: &Nearness, progress: &dyn Progress) -> Vec<f64> {
        let own = self.facets(nominal, near, progress);
        let far = |(face, off): &&(u32, f64)| *off > near.distance && own.binary_search(face).is_ok();
        self.nearest.iter().filter(far).map(|(_, off)| *off).collect()
    }

    /// Those of these measured points that lie upon facets beside the nominal.
    pub fn upon_others(
        &self,
        points: &[u32],
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<u32>, Stop> {
        if matches!(nominal, Nominal::Edge { .. }) {
            return Ok(vec![]);
        }
        // All of the face counts, however its facets lie to its bounds.
        let whole = Nearness { margin: -near.distance, ..*near };
        let own = self.facets(nominal, &whole, progress);
        let upon = (UPON * self.median).min(FARTHEST * near.distance).max(self.rounding);
        let is_upon_other = |p: &u32| {
            let (face, off) = self.nearest[*p as usize];
            face != u32::MAX && off <= upon && own.binary_search(&face).is_err()
        };
        let doubtful: Vec<u32> = points.iter().copied().filter(is_upon_other).collect();
        if own.is_empty() || doubtful.is_empty() {
            return Ok(vec![]);
        }
        let mesh = self.part(own.iter().copied());
        let tree = Tree::build_watched(&mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let asked: Vec<Point> = doubtful.iter().map(|p| self.measured[*p as usize]).collect();
        let on_own = nearest(&tree, &asked, f64::INFINITY, progress)?;
        let is_other = |(p, (own, away)): (&u32, (u32, f64))| {
            let (face, off) = self.nearest[*p as usize];
            let angle = normal(self.reference, face).zip(normal(&mesh, own)).map(|(a, b)| dot(a, b).abs());
            // A wall of a thin part runs along the other one: which of them a point is of is not told by its place.
            let aside = angle.is_some_and(|cosine| cosine < libm::cos(near.angle));
            (aside && off + SAME * self.size < away).then_some(*p)
        };
        Ok(doubtful.iter().zip(on_own).filter_map(is_other).collect())
    }

    /// Whether each of these places, of facets found for a nominal, is of a face of the reference beside it: beyond where its own ends, and
    /// clearly nearer to that face, as on a fillet that leaves it as a tangent.
    pub fn beside(
        &self,
        places: &[Point],
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let (own, Some(surface)) = (self.on_surface(nominal, near, progress), nominal.surface()) else {
            return Ok(vec![false; places.len()]);
        };
        if own.is_empty() {
            return Ok(vec![false; places.len()]);
        }
        // What lies on the surface of the nominal is no other face, however it was cut into facets.
        let is_other = |f: u32| !self.is_on(&surface, f, near);
        let on_all = nearest(self.search.tree(), places, f64::INFINITY, progress)?;
        let asked: Vec<usize> =
            (0..places.len()).filter(|n| on_all[*n].0 != u32::MAX && is_other(on_all[*n].0)).collect();
        let mut beside = vec![false; places.len()];
        if asked.is_empty() {
            return Ok(beside);
        }
        let part = self.part(own.iter().copied());
        let tree = Tree::build_watched(&part, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let of: Vec<Point> = asked.iter().map(|n| places[*n]).collect();
        for (n, (face, away)) in asked.into_iter().zip(nearest(&tree, &of, f64::INFINITY, progress)?) {
            let corner = part.positions[part.faces[face as usize][0] as usize];
            let over = normal(&part, face).map_or(0.0, |way| dot(minus(places[n], corner), way).abs());
            let aside = (away * away - over * over).max(0.0).sqrt();
            // At a sharp edge that is off its place both are as near.
            beside[n] = aside > over && NEARER * on_all[n].1 <= away;
        }
        Ok(beside)
    }

    /// Whether each of these places, of facets that face as the nominal does, is nearer to the facets of the nominal than to others
    /// that face so too, as the ground of a pocket that the reference has.
    pub fn nearer(
        &self,
        places: &[Point],
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let own = self.on_surface(nominal, near, progress);
        let Some(surface) = nominal.surface().filter(|_| !own.is_empty()) else {
            return Ok(vec![true; places.len()]);
        };
        let outward = |f: u32| {
            let corners = self.reference.faces[f as usize].map(|v| self.reference.positions[v as usize]);
            let way = surface.distance(times(1.0 / 3.0, plus(corners[0], plus(corners[1], corners[2]))));
            way.zip(space::normal(corners)).map_or(0.0, |((_, way), facing)| dot(way, facing))
        };
        let side: f64 = own.iter().map(|f| outward(*f).signum()).sum::<f64>().signum();
        let alike = libm::cos(ALIKE * near.angle);
        let others = (0..self.reference.faces.len() as u32)
            .filter(|f| !self.is_on(&surface, *f, near) && side * outward(*f) >= alike);
        let [own, others] = [self.part(own.iter().copied()), self.part(others)];
        if others.faces.is_empty() {
            return Ok(vec![true; places.len()]);
        }
        let away = |mesh: &Mesh| -> Result<Vec<(u32, f64)>, Stop> {
            let tree = Tree::build_watched(mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
            nearest(&tree, places, f64::INFINITY, progress)
        };
        Ok(away(&own)?.into_iter().zip(away(&others)?).map(|(own, other)| own.1 <= other.1).collect())
    }

    /// Keeps those of some pieces beside the nominal that the reference has too: near most of their points it has a surface, not
    /// the nominal's, that faces as the piece does, at least twice as nearly as the nominal's surface.
    pub fn known(
        &self,
        mut pieces: Vec<Piece>,
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<Piece>, Stop> {
        let whole = Nearness { margin: -near.distance, ..*near };
        let (own, Some(surface)) = (self.facets(nominal, &whole, progress), nominal.surface()) else {
            return Ok(vec![]);
        };
        let others =
            self.part((0..self.reference.faces.len() as u32).filter(|f| own.binary_search(f).is_err()));
        if own.is_empty() || others.faces.is_empty() || pieces.is_empty() {
            return Ok(vec![]);
        }
        let tree = Tree::build_watched(&others, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let reach = WALL_REACH * near.distance.max(UPON * self.median);
        let angle = |a: Vector, b: Vector| libm::acos(dot(a, b).abs().min(1.0));
        let mut known = vec![];
        for piece in &pieces {
            let places: Vec<Point> = piece.points.iter().map(|p| self.measured[p.0 as usize]).collect();
            let hits = nearest(&tree, &places, reach, progress)?;
            let is_there = |n: usize| {
                let facing = piece.points[n].1;
                let other = normal(&others, hits[n].0).map(|n| angle(n, facing));
                let nominal = surface.distance(places[n]).map(|(_, way)| angle(way, facing));
                other.zip(nominal).is_some_and(|(other, nominal)| NEARER * other <= nominal)
            };
            let there = (0..places.len()).filter(|n| is_there(*n)).count();
            known.push(there as f64 >= MOST * places.len() as f64);
        }
        let mut known = known.into_iter();
        pieces.retain(|_| known.next().unwrap_or(false));
        Ok(pieces)
    }

    /// Some facets of the reference.
    fn part(&self, facets: impl Iterator<Item = u32>) -> Mesh {
        let faces = facets.map(|f| self.reference.faces[f as usize]).collect();
        Mesh { positions: self.reference.positions.clone(), faces }
    }

    /// Whether each of these places lies over the nominal's facets of the reference, farther inside than its `distance` from where they
    /// end, or outside the material: edges that were broken or rounded are within that distance, and lack material.
    pub fn over(
        &self,
        places: &[Point],
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let own = self.on_surface(nominal, near, progress);
        if own.is_empty() || places.is_empty() {
            return Ok(vec![false; places.len()]);
        }
        let part = self.part(own.iter().copied());
        let border = PointTree::new(&along_border(&part, 0.5 * near.distance));
        let hits = nearest(self.search.tree(), places, ELSEWHERE * self.size, progress)?;
        let inside = |p: &Point| {
            border.nearest(p).is_none_or(|(square, _)| square > 2.0 * near.distance * near.distance)
        };
        let outside = |p: &Point, face: u32| {
            let corner = self.reference.positions[self.reference.faces[face as usize][0] as usize];
            normal(self.reference, face).is_some_and(|out| dot(minus(*p, corner), out) > self.rounding)
        };
        let over = |(p, hit): (&Point, (u32, f64))| {
            own.binary_search(&hit.0).is_ok() && (inside(p) || outside(p, hit.0))
        };
        Ok(places.iter().zip(hits).map(over).collect())
    }

    /// The facets of the reference that lie on the surface of the nominal and within its bounds, ascending. The ground of a shallow pocket
    /// and the begin of a fillet are within its reach, and none of it.
    fn on_surface(&self, nominal: &Nominal, near: &Nearness, progress: &dyn Progress) -> Vec<u32> {
        let Some(surface) = nominal.surface() else { return vec![] };
        let whole = Nearness { margin: -near.distance, ..*near };
        let mut own = self.facets(nominal, &whole, progress);
        own.retain(|f| self.is_on(&surface, *f, near));
        own
    }

    fn is_on(&self, surface: &NominalSurface, facet: u32, near: &Nearness) -> bool {
        let on = (ON * near.distance).max(self.rounding);
        let off = |v: u32| surface.distance(self.reference.positions[v as usize]).map_or(0.0, |d| d.0.abs());
        self.reference.faces[facet as usize].iter().all(|v| off(*v) <= on)
    }

    /// The facets of the reference that the nominal names, ascending: those joined to where it is begun, and those of its surface that
    /// lie apart, beyond a groove or a slot.
    fn facets(&self, nominal: &Nominal, near: &Nearness, progress: &dyn Progress) -> Vec<u32> {
        let Some(surface) = nominal.surface() else { return vec![] };
        let Ok(found) = self.search.find(nominal, near, progress) else { return vec![] };
        let mut all = self.search.apart(&found, nominal, near, progress).unwrap_or_default();
        all.retain(|f| self.is_on(&surface, *f, near));
        all.extend(&found.facets);
        all.sort_unstable();
        all
    }
}

/// Places along the edges of a mesh that one facet alone has, no farther apart than `step`.
fn along_border(mesh: &Mesh, step: f64) -> Vec<Point> {
    let mut places = vec![];
    let positions = &mesh.positions;
    let mut sides: Vec<[u32; 2]> = (mesh.faces.iter())
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [*a.min(b), *a.max(b)])
        .collect();
    sides.sort_unstable();
    for edge in sides.chunk_by(|a, b| a == b).filter(|edge| edge.len() == 1).map(|edge| edge[0]) {
        let [a, b] = edge.map(|v| positions[v as usize]);
        let steps = (norm(minus(b, a)) / step).ceil().clamp(1.0, STEPS);
        places.extend((0..=steps as u32).map(|k| plus(a, times(f64::from(k) / steps, minus(b, a)))));
    }
    places
}

/// The nearest facet to each place and how far off it is; `u32::MAX` beyond `farthest`.
fn nearest(
    tree: &Tree,
    places: &[Point],
    farthest: f64,
    progress: &dyn Progress,
) -> Result<Vec<(u32, f64)>, Stop> {
    let query = Query { max_distance: farthest, ..Query::default() };
    let of = |hit: Option<Hit>| hit.map_or((u32::MAX, 0.0), |h| (h.face, h.distance()));
    tree.map_closest(places, &query, progress, |_, hit| of(hit)).map_err(|e| match e {
        QueryError::Cancelled(_) => Stop::Cancelled,
        e => Stop::Mesh(e.to_string()),
    })
}

fn normal(mesh: &Mesh, face: u32) -> Option<Vector> {
    space::normal(mesh.faces.get(face as usize)?.map(|v| mesh.positions[v as usize]))
}

#[cfg(test)]
mod tests;

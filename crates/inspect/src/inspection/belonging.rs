//! Where the measured data lie on the reference, and which points of a cloud belong to what is beside a feature.
//!
//! Nearness to a nominal surface alone does not tell the points of a plane from those at the upper end of a wall beside it, and a
//! cloud has no facets that would tell by their angle. Where the reference is at hand, it does: a point that lies upon one of
//! its other facets is none of the feature's. Upon: as near as nearly all of the cloud lies to the
//! reference. What is clearly nearer to others and does not lie upon them is not judged either, and leaves the verdict open where it matters. Of what lies farther off, as a bore larger than its model, the planes of the neighbors of each point tell
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
use trueness_geom::space::{self, Point, Vector, dot};

/// Points farther off than this share of the size of the reference are of something else.
pub(super) const ELSEWHERE: f64 = 0.1;
/// So many times the median distance from the reference a point lies upon it: above six standard deviations of noise, for of the points of a wall
/// not one shall remain.
const UPON: f64 = 10.0;
/// But no farther than this share of the distance up to which points are sought.
const FARTHEST: f64 = 0.25;
/// So many times the distance up to which points are sought, or within which they lie upon the reference, a wall may be off its place.
const WALL_REACH: f64 = 3.0;
/// A piece is of the reference if this share of its points is.
const MOST: f64 = 0.75;
/// So many times nearer a face is clearly the nearer one.
pub(super) const NEARER: f64 = 2.0;
/// A point lies upon a round face that the reference has in chords if it is off by so many times their sag.
const SAGS: f64 = 1.5;
/// Angle between facets from which on there is an edge between them, radians.
const CREASE: f64 = 32.0 / 180.0 * std::f64::consts::PI;
/// A point between two faces that run along each other is of one if it is so many times nearer to it.
const WITHIN: f64 = 10.0;
/// A facet of the reference may be off the surface of the nominal by this share of the distance up to which points are sought.
const ON: f64 = 1e-3;
/// So many times the middle one of the distances of its facets from the nominal a facet of the same face may be off.
const LEANS: f64 = 4.0;
/// Distances that differ by less than this share of the size of the reference are the same.
const SAME: f64 = 1e-9;

/// The measured data on the reference.
pub(super) struct Belonging<'a> {
    pub(super) reference: &'a Mesh,
    pub(super) measured: &'a Mesh,
    /// Of the features that the reference has.
    pub(super) search: FeatureSearch<'a>,
    pub(super) size: f64,
    /// Of each measured point the nearest facet and how far off it is, mm; `u32::MAX` for what is elsewhere.
    pub(super) nearest: Vec<(u32, f64)>,
    /// Median of the distances, mm.
    median: f64,
    /// A step of single precision, which meshes pass through in their files, mm.
    pub(super) rounding: f64,
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
        let tree = Tree::build_watched(reference, progress).map_err(|e| Stop::Nominal(e.to_string()))?;
        let bounds = reference.bounds();
        let size = bounds.diagonal();
        let greatest = bounds.min.iter().chain(&bounds.max).fold(0.0, |m: f64, x| m.max(x.abs()));
        let rounding = f64::from(f32::EPSILON) * greatest;
        let nearest = nearest(&tree, &measured.positions, ELSEWHERE * size, progress)?;
        let mut all: Vec<f64> = nearest.iter().filter(|n| n.0 != u32::MAX).map(|n| n.1).collect();
        all.sort_unstable_by(f64::total_cmp);
        let median = all.get(all.len() / 2).copied().unwrap_or(0.0);
        let search = FeatureSearch::new(reference, tree);
        Ok(Some(Belonging { reference, measured, search, size, nearest, median, rounding }))
    }

    /// How far off the measured points are whose nearest facet is one of the nominal's, where that is beyond its distance, mm.
    pub fn beyond(&self, nominal: &Nominal, near: &Nearness, progress: &dyn Progress) -> Vec<f64> {
        let own = self.facets(nominal, near, progress);
        let far = |(face, off): &&(u32, f64)| *off > near.distance && own.binary_search(face).is_ok();
        self.nearest.iter().filter(far).map(|(_, off)| *off).collect()
    }

    /// Those of these measured points that lie upon surfaces of the reference which are not the nominal's, and those that may: they are clearly nearer
    /// to one without lying on it, as the ground of a dent nearly through a sheet is.
    pub fn of_others(
        &self,
        points: &[u32],
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<[Vec<u32>; 2], Stop> {
        let mut others = [vec![], vec![]];
        if matches!(nominal, Nominal::Edge { .. }) {
            return Ok(others);
        }
        // All of the face counts, however its facets lie to its bounds.
        let whole = Nearness { margin: -near.distance, ..*near };
        let own = self.facets(nominal, &whole, progress);
        let is_other = |p: &u32| {
            let (face, _) = self.nearest[*p as usize];
            face != u32::MAX && own.binary_search(&face).is_err()
        };
        let asked: Vec<u32> = points.iter().copied().filter(is_other).collect();
        if own.is_empty() || asked.is_empty() {
            return Ok(others);
        }
        let mesh = self.part(own.iter().copied());
        let own_tree = Tree::build_watched(&mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let places: Vec<Point> = asked.iter().map(|p| self.measured.positions[*p as usize]).collect();
        let upon = self.upon(near);
        for (p, (own, away)) in asked.into_iter().zip(nearest(&own_tree, &places, f64::INFINITY, progress)?) {
            let (face, off) = self.nearest[p as usize];
            let angle = normal(self.reference, face).zip(normal(&mesh, own)).map(|(a, b)| dot(a, b).abs());
            let is_aside = angle.is_some_and(|cosine| cosine < libm::cos(near.angle));
            let upon = upon.max(SAGS * self.search.sag(face, CREASE));
            let is_nearer =
                off + SAME * self.size < away && (is_aside && off <= upon || NEARER * off <= away);
            if is_nearer && off <= upon && (is_aside || WITHIN * off <= away) {
                others[0].push(p);
            } else if is_nearer {
                others[1].push(p);
            }
        }
        Ok(others)
    }

    /// How far off a face of the reference points lie upon it, as most of the measured do.
    pub(super) fn upon(&self, near: &Nearness) -> f64 {
        (UPON * self.median).min(FARTHEST * near.distance).max(self.rounding)
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
            let places: Vec<Point> =
                piece.points.iter().map(|p| self.measured.positions[p.0 as usize]).collect();
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
    pub fn part(&self, facets: impl Iterator<Item = u32>) -> Mesh {
        let faces = facets.map(|f| self.reference.faces[f as usize]).collect();
        Mesh { positions: self.reference.positions.clone(), faces }
    }

    /// Whether a facet of the reference lies on the surface of a nominal. The ground of a shallow pocket and the begin of a fillet are within
    /// its reach, and none of it.
    pub fn is_on(&self, surface: &NominalSurface, facet: u32, near: &Nearness) -> bool {
        self.off(surface, facet) <= self.on(near)
    }

    fn on(&self, near: &Nearness) -> f64 {
        (ON * near.distance).max(self.rounding)
    }

    /// How far the farthest corner of a facet of the reference is off the surface of a nominal.
    fn off(&self, surface: &NominalSurface, facet: u32) -> f64 {
        let of = |v: u32| surface.distance(self.reference.positions[v as usize]).map_or(0.0, |d| d.0.abs());
        self.reference.faces[facet as usize].iter().map(|v| of(*v)).fold(0.0, f64::max)
    }

    /// The facets of the reference that the nominal names, ascending: those joined to where it is begun, and those of its surface that
    /// lie apart, beyond a groove or a slot. A nominal may lean, by the digits it is written with.
    pub fn facets(&self, nominal: &Nominal, near: &Nearness, progress: &dyn Progress) -> Vec<u32> {
        let Some(surface) = nominal.surface() else { return vec![] };
        let Ok(found) = self.search.find(nominal, near, progress) else { return vec![] };
        let mut off: Vec<f64> = found.facets.iter().map(|f| self.off(&surface, *f)).collect();
        off.sort_unstable_by(f64::total_cmp);
        let limit = off.get(off.len() / 2).map_or(0.0, |middle| LEANS * middle).max(self.on(near));
        let mut all = self.search.apart(&found, nominal, near, progress).unwrap_or_default();
        all.extend(&found.facets);
        all.retain(|f| self.off(&surface, *f) <= limit);
        all.sort_unstable();
        all
    }
}

/// The nearest facet to each place and how far off it is; `u32::MAX` beyond `farthest`.
pub(super) fn nearest(
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

/// Height over the plane of a facet, mm, positive outside the material; 0 of one without area.
pub(super) fn height(mesh: &Mesh, face: u32, p: Point) -> f64 {
    let corner = mesh.positions[mesh.faces[face as usize][0] as usize];
    normal(mesh, face).map_or(0.0, |out| dot(space::minus(p, corner), out))
}

pub(super) fn normal(mesh: &Mesh, face: u32) -> Option<Vector> {
    space::normal(mesh.faces.get(face as usize)?.map(|v| mesh.positions[v as usize]))
}

#[cfg(test)]
mod tests;

//! Which points of a cloud near a feature are of other surfaces of the reference.
//!
//! Nearness to a nominal surface alone does not tell the points of a plane from those at the upper end of a wall beside it, and a
//! cloud has no facets that would tell by their angle. Where the reference is at hand, it does. Upon one of its faces lies
//! what is as near to it as nearly all of the cloud is to the reference.
//!
//! - What lies upon another face is of that one, and what is clearly nearer to another beyond where the feature ends. What is clearly nearer to another
//!   over the feature, without lying upon it, is not judged either, and leaves the verdict open where it matters.
//! - Where a feature is off its place, the face beside it ends earlier or goes on, and its points between both places are as near to the feature.
//!   They lie on the plane of that face, and off the feature as its other points around have it. What goes on there out of the material, a burr or
//!   what the part stands on, leaves the verdict open.
//! - Of what lies farther off, as a bore larger than its model, the planes of the neighbors of each point tell which way it faces: a piece
//!   that faces away from the feature and goes on beyond it is of another surface if the reference has one there that faces as it does.
//!
//! Everything else counts, so that no dent is taken for the wall beside it. Without a reference such pieces are left out too, and
//! nothing that depends on it passes.

use super::belonging::{Belonging, UPON};
use super::data::Stop;
use super::own_facets::OwnFacets;
use super::reference::{NEARER, height, nearest, normal, part};
use trueness_geom::closest::Tree;
use trueness_geom::feature::Piece;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Aabb, Point, Vector, dot};
use trueness_geom::spatial::neighbors::PointTree;
use trueness_geom::stats::SIGMA_OVER_MAD;

/// So many times the distance up to which points are sought, or within which they lie upon the reference, a wall may be off its place.
const WALL_REACH: f64 = 3.0;
/// A piece is of the reference if this share of its points is.
const MOST: f64 = 0.75;
/// A point lies upon a round face that the reference has in chords if it is off by so many times their sag.
const SAGS: f64 = 1.5;
/// Angle between facets from which on there is an edge between them, radians.
const CREASE: f64 = 32.0 / 180.0 * std::f64::consts::PI;
/// A point between two faces that run along each other is of one if it is so many times nearer to it.
const WITHIN: f64 = 10.0;
/// Distances that differ by less than this share of the size of the reference are the same.
const SAME: f64 = 1e-9;
/// Points around one at an edge that tell where the feature is there.
const AROUND: usize = 24;
/// Over so many standard deviations a point is off the feature: one in a million of normal noise.
const OFF: f64 = 5.0;

/// The pieces beside a feature, and its points, of a cloud that is told by its reference.
pub(super) struct OfOthers<'a> {
    pub(super) belonging: &'a Belonging<'a>,
    pub(super) own: &'a OwnFacets,
    pub(super) progress: &'a dyn Progress,
}

impl OfOthers<'_> {
    /// Those of these measured points that are of surfaces of the reference which are not the feature's, and those that may be: they are clearly
    /// nearer to one without lying on it, as the ground of a dent nearly through a sheet is.
    pub(super) fn upon(&self, points: &[u32]) -> Result<[Vec<u32>; 2], Stop> {
        let OfOthers { belonging, own, progress } = *self;
        let mut others = [vec![], vec![]];
        let is_other = |p: &u32| {
            let (face, _) = belonging.nearest[*p as usize];
            face != u32::MAX && !own.has(face)
        };
        let asked: Vec<u32> = points.iter().copied().filter(is_other).collect();
        let places = self.places(&asked);
        let hits = nearest(&own.tree, &places, f64::INFINITY, progress)?;
        for ((p, place), (facet, away)) in asked.into_iter().zip(places).zip(hits) {
            let (face, off) = belonging.nearest[p as usize];
            let angle = normal(belonging.reference.mesh, face)
                .zip(normal(&own.mesh, facet))
                .map(|(a, b)| dot(a, b).abs());
            let is_aside = angle.is_some_and(|cosine| cosine < libm::cos(own.near.angle));
            let is_upon = off <= self.upon_facet(face);
            let is_nearer =
                off + SAME * belonging.reference.size < away && (is_aside && is_upon || NEARER * off <= away);
            let is_known = is_upon && (is_aside || WITHIN * off <= away);
            if is_nearer && (is_known || own.ends_before(place, (facet, away), off)) {
                others[0].push(p);
            } else if is_nearer {
                others[1].push(p);
            }
        }
        Ok(others)
    }

    /// Of these measured points, and of those of pieces beside the feature, those that lie on the plane of a face beside it, where that goes on because
    /// the feature is off its place: between the nominal surface and the feature as the points around have it, and off this. And those
    /// that go on beyond both, out of the material: a burr, or what the part stands on.
    pub(super) fn at_edges(&self, points: &[u32], of_pieces: &[u32]) -> Result<[Vec<u32>; 2], Stop> {
        let OfOthers { belonging, own, progress } = *self;
        let mut found = [vec![], vec![]];
        let beside = self.beside()?;
        if beside.is_empty() {
            return Ok(found);
        }
        let mesh = part(belonging.reference.mesh, &beside);
        let tree = Tree::build_watched(&mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let asked = [points, of_pieces].concat();
        let places = self.places(&asked);
        let hits = nearest(&tree, &places, WALL_REACH * own.near.distance, progress)?;
        // Of each point how far it is off the nominal surface, out of the material.
        let (mut on_plane, mut own_places, mut own_off) = (vec![], vec![], vec![]);
        for (n, (place, (facet, away))) in places.iter().zip(hits).enumerate() {
            let Some((off, _)) = own.surface.distance(*place) else { continue };
            let is_on = beside.get(facet as usize).is_some_and(|face| {
                let upon = self.upon_facet(*face);
                height(&mesh, facet, *place).abs() <= upon && (away - off.abs()).abs() <= upon
            });
            if is_on {
                on_plane.push((asked[n], *place, own.side * off));
            } else if n < points.len() {
                own_places.push(*place);
                own_off.push(own.side * off);
            }
        }
        if own_places.len() < AROUND {
            return Ok(found);
        }
        let around = PointTree::new(&own_places);
        for (p, place, off) in on_plane {
            let near = around.k_nearest(&place, AROUND, None);
            let mut offs: Vec<f64> = near.iter().map(|n| own_off[n.1 as usize]).collect();
            let level = middle(&mut offs);
            let mut scatter: Vec<f64> = offs.iter().map(|off| (off - level).abs()).collect();
            let slack = OFF * SIGMA_OVER_MAD * middle(&mut scatter) + belonging.reference.rounding;
            let from_nominal = off * level.signum();
            if from_nominal >= -slack && from_nominal + slack < level.abs() {
                found[0].push(p);
            } else if off > level.max(0.0) + slack {
                found[1].push(p);
            }
        }
        for numbers in &mut found {
            numbers.sort_unstable();
        }
        Ok(found)
    }

    /// The facets of the reference that the feature has an edge with.
    fn beside(&self) -> Result<Vec<u32>, Stop> {
        let OfOthers { belonging, own, progress } = *self;
        let same = SAME * belonging.reference.size;
        let reference = belonging.reference.mesh;
        let bounds = Aabb::of(&own.mesh.positions).widened(same);
        let near: Vec<u32> = belonging.reference.tree().in_box(&bounds);
        let near: Vec<u32> = near.into_iter().filter(|f| !own.has(*f)).collect();
        let mut corners: Vec<u32> = near.iter().flat_map(|f| reference.faces[*f as usize]).collect();
        corners.sort_unstable();
        corners.dedup();
        let places: Vec<Point> = corners.iter().map(|v| reference.positions[*v as usize]).collect();
        let hits = nearest(&own.tree, &places, same, progress)?;
        let cosine = libm::cos(own.near.angle);
        let has_edge = |face: &u32| {
            let Some(facing) = normal(reference, *face) else { return false };
            let facet = |v: &u32| corners.binary_search(v).ok().map(|n| hits[n].0);
            let touched = reference.faces[*face as usize].iter().filter_map(facet);
            let turns = |facet| normal(&own.mesh, facet).is_some_and(|n| dot(n, facing).abs() < cosine);
            touched.filter(|facet| *facet != u32::MAX).any(turns)
        };
        Ok(near.into_iter().filter(has_edge).collect())
    }

    /// Keeps those of some pieces beside the feature that the reference has too: near most of their points it has a surface, not
    /// the feature's, that faces as the piece does, at least twice as nearly as the feature's.
    pub(super) fn known(&self, pieces: Vec<Piece>) -> Result<Vec<Piece>, Stop> {
        let OfOthers { belonging, own, progress } = *self;
        let reach = WALL_REACH * own.near.distance.max(UPON * belonging.median);
        let numbers: Vec<u32> = pieces.iter().flat_map(|piece| piece.points.iter().map(|p| p.0)).collect();
        let places = self.places(&numbers);
        let mut others = belonging.reference.tree().in_box(&Aabb::of(&places).widened(reach));
        others.retain(|f| !own.has(*f));
        if others.is_empty() {
            return Ok(vec![]);
        }
        let others = part(belonging.reference.mesh, &others);
        let tree = Tree::build_watched(&others, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let hits = nearest(&tree, &places, reach, progress)?;
        let angle = |a: Vector, b: Vector| libm::acos(dot(a, b).abs().min(1.0));
        let mut all = places.into_iter().zip(hits);
        let mut is_known = |piece: &Piece| {
            let is_there = |(_, facing): &&(u32, Vector)| {
                let Some((place, (face, _))) = all.next() else { return false };
                let other = normal(&others, face).map(|n| angle(n, *facing));
                let nominal = own.surface.distance(place).map(|(_, way)| angle(way, *facing));
                other.zip(nominal).is_some_and(|(other, nominal)| NEARER * other <= nominal)
            };
            piece.points.iter().filter(is_there).count() as f64 >= MOST * piece.points.len() as f64
        };
        Ok(pieces.into_iter().filter(|piece| is_known(piece)).collect())
    }

    fn upon_facet(&self, face: u32) -> f64 {
        self.belonging.upon(&self.own.near).max(SAGS * self.belonging.reference.search.sag(face, CREASE))
    }

    fn places(&self, points: &[u32]) -> Vec<Point> {
        points.iter().map(|p| self.belonging.measured.positions[*p as usize]).collect()
    }
}

/// The middle one of some numbers, which are sorted.
fn middle(numbers: &mut [f64]) -> f64 {
    numbers.sort_unstable_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests;

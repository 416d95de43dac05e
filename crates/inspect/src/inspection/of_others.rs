//! Which points of a cloud near a feature are of other surfaces of the reference.
//!
//! Nearness to a nominal surface alone does not tell the points of a plane from those at the upper end of a wall beside it, and a
//! cloud has no facets that would tell by their angle. Where the reference is at hand, it does. Upon one of its faces lies
//! what is as near to it as nearly all of the cloud is to the reference.
//!
//! - What lies upon another face is of that one, and what is clearly nearer to another beyond where the feature ends. What is clearly nearer to another
//!   over the feature, without lying upon it, is not judged either, and leaves the verdict open where it matters.
//! - Where a feature or the face beside it is off its place, points of that face are as near to the feature: see [`at_edges`](OfOthers::at_edges).
//! - Of what lies farther off, as a bore larger than its model, the planes of the neighbors of each point tell which way it faces: a piece
//!   that faces away from the feature and goes on beyond it is of another surface if the reference has one there that faces as it does.
//!
//! Everything else counts, so that no dent is taken for the wall beside it. Without a reference such pieces are left out too, and
//! nothing that depends on it passes.

use super::belonging::{Belonging, UPON};
use super::data::Stop;
use super::own_facets::OwnFacets;
use super::reference::{NEARER, WITHIN, nearest, normal, part};
use trueness_geom::closest::Tree;
use trueness_geom::feature::Piece;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Aabb, Point, Vector, dot};

/// So many times the distance up to which points are sought, or within which they lie upon the reference, a wall may be off its place.
pub(super) const WALL_REACH: f64 = 3.0;
/// A piece is of the reference if this share of its points is.
const MOST: f64 = 0.75;
/// A point lies upon a round face that the reference has in chords if it is off by so many times their sag.
const SAGS: f64 = 1.5;
/// Angle between facets from which on there is an edge between them, radians.
const CREASE: f64 = 32.0 / 180.0 * std::f64::consts::PI;
/// Distances that differ by less than this share of the size of the reference are the same.
pub(super) const SAME: f64 = 1e-9;
/// The pieces beside a feature, and its points, of a cloud that is told by its reference.
pub(super) struct OfOthers<'a> {
    pub(super) belonging: &'a Belonging<'a>,
    pub(super) own: &'a OwnFacets,
    /// How far apart points of the cloud lie at most, mm.
    pub(super) spacing: f64,
    pub(super) progress: &'a dyn Progress,
}

impl OfOthers<'_> {
    /// Those of these measured points that are of surfaces of the reference which are not the feature's, and those that may be: they are clearly
    /// nearer to one without lying on it, as the ground of a dent nearly through a sheet is.
    pub(super) fn upon(&self, points: &[u32]) -> Result<[Vec<u32>; 2], Stop> {
        let OfOthers { belonging, own, progress, .. } = *self;
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

    /// Keeps those of some pieces beside the feature that the reference has too: near most of their points it has a surface, not
    /// the feature's, that faces as the piece does, at least twice as nearly as the feature's.
    pub(super) fn known(&self, pieces: Vec<Piece>) -> Result<Vec<Piece>, Stop> {
        let OfOthers { belonging, own, progress, .. } = *self;
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
        self.belonging.upon(&self.own.near).max(self.sag(face))
    }

    /// How far off the chords of a round face of the reference its points lie.
    pub(super) fn sag(&self, face: u32) -> f64 {
        SAGS * self.belonging.reference.search.sag(face, CREASE)
    }

    pub(super) fn places(&self, points: &[u32]) -> Vec<Point> {
        points.iter().map(|p| self.belonging.measured.positions[*p as usize]).collect()
    }
}

#[cfg(test)]
mod tests;

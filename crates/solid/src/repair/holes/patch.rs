//! Patches of holes.

use super::super::work::Work;
use trueness_geom::check::finding;
use trueness_geom::space::Point;

/// Facets that fill a hole. Vertices from [`FIRST_NEW_VERTEX`] on are new.
#[derive(Clone, Debug, Default)]
pub(super) struct Patch {
    /// New places.
    pub places: Vec<Point>,
    /// Numbers below [`FIRST_NEW_VERTEX`] are vertices of the mesh, others are `FIRST_NEW_VERTEX` plus the index of a new place.
    pub facets: Vec<[u32; 3]>,
}

/// Where the numbers of new places start: no mesh has so many vertices.
pub(super) const FIRST_NEW_VERTEX: u32 = 1 << 31;

impl Patch {
    /// Where a vertex is.
    pub(super) fn at(&self, work: &Work, vertex: u32) -> Point {
        match vertex.checked_sub(FIRST_NEW_VERTEX) {
            Some(new) => self.places[new as usize],
            None => work.at(vertex),
        }
    }

    pub(super) fn area(&self, work: &Work) -> f64 {
        self.facets.iter().map(|f| finding::area(f.map(|v| self.at(work, v)))).sum()
    }
}

//! The reference, with what every feature asks of it.

use super::data::Stop;
use trueness_geom::closest::{Hit, Query, QueryError, Tree};
use trueness_geom::feature::FeatureSearch;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::{self, Point, Vector, dot};

/// Points farther off than this share of the size of the reference are of something else.
pub(super) const ELSEWHERE: f64 = 0.1;
/// So many times nearer a face is clearly the nearer one.
pub(super) const NEARER: f64 = 2.0;
/// So many times nearer a face is the one that a place is of, whichever way both face.
pub(super) const WITHIN: f64 = 10.0;

/// A reference with facets.
pub(super) struct Reference<'a> {
    pub mesh: &'a Mesh,
    /// Of the features that it has.
    pub search: FeatureSearch<'a>,
    /// Diagonal of its box, mm.
    pub size: f64,
    /// A step of single precision, which meshes pass through in their files, mm.
    pub rounding: f64,
}

impl<'a> Reference<'a> {
    /// Cost: a search tree.
    pub fn new(mesh: &'a Mesh, progress: &dyn Progress) -> Result<Reference<'a>, Stop> {
        let tree = Tree::build_watched(mesh, progress).map_err(|e| Stop::Nominal(e.to_string()))?;
        let bounds = mesh.bounds();
        let greatest = bounds.min.iter().chain(&bounds.max).fold(0.0, |m: f64, x| m.max(x.abs()));
        let rounding = f64::from(f32::EPSILON) * greatest;
        Ok(Reference { mesh, search: FeatureSearch::new(mesh, tree), size: bounds.diagonal(), rounding })
    }

    pub fn tree(&self) -> &Tree {
        self.search.tree()
    }
}

/// Some facets of a mesh, with the vertices that they have.
pub(super) fn part(mesh: &Mesh, facets: &[u32]) -> Mesh {
    let corners = || facets.iter().flat_map(|f| mesh.faces[*f as usize]);
    let mut used: Vec<u32> = corners().collect();
    used.sort_unstable();
    used.dedup();
    let place = |v: u32| used.partition_point(|u| *u < v) as u32;
    let faces = facets.iter().map(|f| mesh.faces[*f as usize].map(place)).collect();
    Mesh { positions: used.iter().map(|v| mesh.positions[*v as usize]).collect(), faces }
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

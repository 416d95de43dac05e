//! The triangle mesh as data: positions and corners, no adjacency.

use crate::parallel::prelude::*;
use crate::space::{Aabb, Point};

/// Vertices (millimeters) and faces of three vertex numbers each, outward normal by the right hand.
///
/// Nothing is promised beyond that: faces may be degenerate, doubled, or name a vertex that does not exist. Callers that rely
/// on more check it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// `V` places.
    pub positions: Vec<Point>,
    /// `F` triples of indices into `positions`.
    pub faces: Vec<[u32; 3]>,
}

impl Mesh {
    /// Box of all positions, used by a face or not.
    pub fn bounds(&self) -> Aabb {
        Aabb::of(&self.positions)
    }

    /// Where the corners of a face are.
    pub fn corners(&self, face: u32) -> [Point; 3] {
        self.places(&self.faces[face as usize])
    }

    /// Where vertices are.
    #[inline]
    pub fn places<const N: usize>(&self, vertices: &[u32; N]) -> [Point; N] {
        vertices.map(|v| self.positions[v as usize])
    }

    /// Whether single precision holds all coordinates; those that are not finite do not count.
    pub fn is_single(&self) -> bool {
        let holds = |x: &f64| f64::from(*x as f32) == *x || !x.is_finite();
        self.positions.par_iter().all(|p| p.iter().all(holds))
    }

    /// Box of the positions that are finite. Runs on the current rayon pool.
    pub fn finite_bounds(&self) -> Aabb {
        /// Vertices whose box one task finds.
        const VERTICES_PER_BOX: usize = 1 << 14;
        let finite = |p: &&Point| p.iter().all(|x| x.is_finite());
        let of = |part: &[Point]| Aabb::of(part.iter().filter(finite));
        self.positions.par_chunks(VERTICES_PER_BOX).map(of).reduce(|| Aabb::EMPTY, |a, b| a.union(&b))
    }
}

/// The facets about each vertex of a mesh.
///
/// ```
/// use trueness_geom::mesh::{FacetsAround, Mesh};
/// let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let around = FacetsAround::new(&Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3]] });
/// assert_eq!((around.of(0), around.of(3)), (&[0, 1][..], &[1][..]));
/// ```
#[derive(Clone, Debug)]
pub struct FacetsAround {
    first: Vec<usize>,
    facets: Vec<u32>,
}

impl FacetsAround {
    /// The box of a mesh whose facets name its vertices. Cost: two passes over the facets; 12 bytes for each of them and 8 for
    /// each vertex.
    pub fn new(mesh: &Mesh) -> FacetsAround {
        let mut first = vec![0; mesh.positions.len() + 1];
        mesh.faces.iter().flatten().for_each(|v| first[*v as usize + 1] += 1);
        (1..first.len()).for_each(|v| first[v] += first[v - 1]);
        let (mut next, mut facets) = (first.clone(), vec![0; 3 * mesh.faces.len()]);
        for (facet, corners) in (0u32..).zip(&mesh.faces) {
            for v in corners {
                facets[next[*v as usize]] = facet;
                next[*v as usize] += 1;
            }
        }
        FacetsAround { first, facets }
    }

    /// The facets about a vertex, ascending.
    pub fn of(&self, v: u32) -> &[u32] {
        &self.facets[self.first[v as usize]..self.first[v as usize + 1]]
    }
}

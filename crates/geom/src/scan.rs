//! What was measured: a mesh, or a cloud.

use crate::mesh::Mesh;
use crate::space::{Aabb, Point};

/// Measured points, joined by facets or by nothing. Which of the two is decided where they are read, and nowhere else.
///
/// ```
/// use trueness_geom::{mesh::Mesh, scan::Scan};
/// let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let mesh = Scan::from(Mesh { positions: positions.clone(), faces: vec![[0, 1, 2]] });
/// assert!(mesh.mesh().is_some());
/// let cloud = Scan::from(Mesh { positions: positions.clone(), faces: vec![] });
/// assert_eq!(cloud, Scan::Cloud(positions));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Scan {
    /// Vertices and facets.
    Mesh(Mesh),
    /// Points without facets.
    Cloud(Vec<Point>),
}

impl Scan {
    /// The vertices, or the points.
    pub fn points(&self) -> &[Point] {
        match self {
            Scan::Mesh(mesh) => &mesh.positions,
            Scan::Cloud(points) => points,
        }
    }

    /// The same, to be moved.
    pub fn points_mut(&mut self) -> &mut [Point] {
        match self {
            Scan::Mesh(mesh) => &mut mesh.positions,
            Scan::Cloud(points) => points,
        }
    }

    /// The vertices, or the points, by themselves.
    pub fn into_points(self) -> Vec<Point> {
        match self {
            Scan::Mesh(mesh) => mesh.positions,
            Scan::Cloud(points) => points,
        }
    }

    /// The mesh, if it is one.
    pub fn mesh(&self) -> Option<&Mesh> {
        match self {
            Scan::Mesh(mesh) => Some(mesh),
            Scan::Cloud(_) => None,
        }
    }

    /// The facets; a cloud has none.
    pub fn facets(&self) -> &[[u32; 3]] {
        self.mesh().map_or(&[], |mesh| &mesh.faces)
    }

    /// Box of all points, used by a facet or not.
    pub fn bounds(&self) -> Aabb {
        Aabb::of(self.points())
    }
}

/// A mesh without facets is a cloud: nothing joins its points.
impl From<Mesh> for Scan {
    fn from(mesh: Mesh) -> Scan {
        if mesh.faces.is_empty() { Scan::Cloud(mesh.positions) } else { Scan::Mesh(mesh) }
    }
}

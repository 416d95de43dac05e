//! Places of a measured mesh between its vertices: where its facets are large, the vertices alone would leave a map gray.

use super::bisection::{Bisection, PIECE_AREA_RATIO, half_corners};
use super::facet::whole_area;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Point, Vector, normal};

/// Pieces, at most, that the facets are cut into: their edges are a sixtieth of the root of the area, which a map shows well.
const MAX_BETWEEN_PIECES: usize = 20_000;

/// Places in the middle of pieces of large facets. They count in maps alone, no statistic knows them.
#[derive(Clone, Debug, Default)]
pub struct Between {
    /// The places.
    pub points: Vec<Point>,
    /// Unit normal of the facet that each lies on.
    pub normals: Vec<Vector>,
}

impl Between {
    /// Of the facets with an edge longer than the pieces are to be, in their order; the others have their vertices. Facets without area
    /// have none. A mesh of small facets, as scanners make them, has no such places.
    ///
    /// ```
    /// use trueness_geom::mesh::Mesh;
    /// use trueness_measure::compare::Between;
    /// let positions = vec![[0.0; 3], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]];
    /// let between = Between::of(&Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3]] });
    /// assert!(between.points.len() > 5000 && between.points.iter().all(|p| p[2] == 0.0));
    /// assert!(between.normals.iter().all(|n| *n == [0.0, 0.0, 1.0]));
    /// ```
    pub fn of(mesh: &Mesh) -> Between {
        let edge = (whole_area(mesh) / (PIECE_AREA_RATIO * MAX_BETWEEN_PIECES as f64)).sqrt();
        let mut found = Between::default();
        if !(edge > 0.0 && edge.is_finite()) {
            return found;
        }
        let pieces = Bisection::of(mesh, edge, MAX_BETWEEN_PIECES);
        for (face, corners) in (0u32..).zip(&mesh.faces) {
            let corners = corners.map(|v| mesh.positions[v as usize]);
            let Some(normal) = normal(corners).filter(|_| pieces.halves(face).is_some()) else { continue };
            let mut open = vec![(face, corners)];
            while let Some((node, [a, b, c])) = open.pop() {
                match pieces.halves(node) {
                    None => {
                        found.points.push([0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0));
                        found.normals.push(normal);
                    }
                    Some(([first, second], edge)) => {
                        let own = [a, b, c];
                        let (p, q) = (own[edge], own[(edge + 1) % 3]);
                        let middle = [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
                        open.push((second, half_corners(edge, true, own, middle)));
                        open.push((first, half_corners(edge, false, own, middle)));
                    }
                }
            }
        }
        found
    }
}

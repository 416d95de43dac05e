//! Faces that pass through each other, as their facets tell.
//!
//! Facets lie within a known distance of their faces. Two of them cross for certain where each has corners on both sides of the plane of the
//! other, farther from it than both are from their faces.

use super::numbers;
use crate::bounds::bounds;
use trueness_cad::tessellate::Tessellation;
use trueness_cad::trimmed::Trimmed;
use trueness_document::check::Item;
use trueness_geom::plane::Plane;
use trueness_geom::space::{Aabb, Point, dot, normal};

/// Two faces and the facets in which they cross.
pub struct CrossingFaces {
    faces: [u32; 2],
    facets: Vec<u32>,
    /// The box that the two facets that cross deepest have in common.
    common: Aabb,
    depth: f64,
}

/// Pairs of faces of one instance that cross, in the order of their numbers.
pub fn crossing_faces(pairs: &[[u32; 2]], drawn: &Tessellation, shape: &Trimmed) -> Vec<CrossingFaces> {
    let off = |face: u32| drawn.bounds.get(face as usize).and_then(|b| *b).map_or(0.0, |b| b.distance);
    let mut found: Vec<([u32; 2], [u32; 2], f64)> = vec![];
    for pair in pairs {
        let [a, b] = pair.map(|f| drawn.faces[f as usize]);
        let instance = |f: u32| shape.brep.faces.get(f as usize).map(|f| f.instance);
        if a == b || instance(a) != instance(b) {
            continue;
        }
        let depth =
            depth(pair.map(|f| drawn.mesh.faces[f as usize].map(|v| drawn.mesh.positions[v as usize])));
        if depth > off(a) + off(b) {
            found.push(([a.min(b), a.max(b)], *pair, depth));
        }
    }
    found.sort_by(|a, b| a.0.cmp(&b.0).then(b.2.total_cmp(&a.2)));
    let group = |group: &[([u32; 2], [u32; 2], f64)]| {
        let (faces, deepest, depth) = group[0];
        let mut facets: Vec<u32> = group.iter().flat_map(|g| g.1).collect();
        facets.sort_unstable();
        facets.dedup();
        CrossingFaces { faces, facets, common: common(drawn, deepest), depth }
    };
    found.chunk_by(|a, b| a.0 == b.0).map(group).collect()
}

/// How deep each of two facets reaches through the plane of the other: the lesser of both.
fn depth(facets: [[Point; 3]; 2]) -> f64 {
    let through = |own: &[Point; 3], other: &[Point; 3]| {
        let Some(normal) = normal(*other) else { return 0.0 };
        let plane = Plane { normal, offset: dot(normal, other[0]) };
        let heights = own.map(|p| plane.height(&p));
        let [above, below] = [1.0, -1.0].map(|s| heights.iter().map(|h| s * h).fold(0.0, f64::max));
        above.min(below)
    };
    let [a, b] = &facets;
    through(a, b).min(through(b, a))
}

fn common(drawn: &Tessellation, pair: [u32; 2]) -> Aabb {
    let [a, b] =
        pair.map(|f| Aabb::of(&drawn.mesh.faces[f as usize].map(|v| drawn.mesh.positions[v as usize])));
    Aabb {
        min: std::array::from_fn(|k| a.min[k].max(b.min[k])),
        max: std::array::from_fn(|k| a.max[k].min(b.max[k])),
    }
}

impl CrossingFaces {
    /// As documents have it.
    pub fn item(self, shape: &Trimmed) -> Item {
        let CrossingFaces { faces, facets, common, depth } = self;
        Item {
            facets,
            vertices: vec![],
            position: std::array::from_fn(|k| 0.5 * (common.min[k] + common.max[k])),
            bounds: bounds(&common),
            size: depth,
            measures: numbers(shape, &faces, &[]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_are_those_of_corners_on_both_sides() {
        let flat = [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]];
        let upright = |low: f64| [[0.0, -1.0, low], [0.0, 1.0, low], [0.0, 0.0, 3.0]];
        assert!((depth([flat, upright(-0.25)]) - 0.25).abs() < 1e-15);
        assert_eq!(depth([flat, upright(0.1)]), 0.0);
        assert_eq!(depth([flat, flat]), 0.0);
    }
}

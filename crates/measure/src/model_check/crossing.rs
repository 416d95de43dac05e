//! Faces that pass through each other, as their facets tell.
//!
//! Facets lie within a known distance of their faces. Two of them cross for certain where each has corners on both sides of the plane of the
//! other, farther from it than both are from their faces.

use super::entities::numbers;
use crate::bounds::bounds;
use trueness_cad::brep::Brep;
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

/// What faces must not cross of: the solids of an instance together, or a sheet.
#[derive(Clone, Copy, PartialEq)]
enum Body {
    Solids(u32),
    Sheet(u32),
    /// A face of its own.
    Alone(u32),
}

fn bodies(brep: &Brep) -> Vec<Body> {
    let mut all: Vec<Body> = (0..brep.faces.len() as u32).map(Body::Alone).collect();
    let mut solid = vec![false; brep.shells.len()];
    for shell in brep.solids.iter().flat_map(|s| std::iter::once(&s.outer).chain(&s.voids)) {
        solid[*shell as usize] = true;
    }
    for ((number, shell), solid) in (0u32..).zip(&brep.shells).zip(solid) {
        for face in &shell.faces {
            let instance = brep.faces[*face as usize].instance;
            all[*face as usize] = if solid { Body::Solids(instance) } else { Body::Sheet(number) };
        }
    }
    all
}

/// Pairs of faces of one body that cross, in the order of their numbers.
pub fn crossing_faces(pairs: &[[u32; 2]], drawn: &Tessellation, shape: &Trimmed) -> Vec<CrossingFaces> {
    let off = |face: u32| drawn.bounds.get(face as usize).and_then(|b| *b).map_or(0.0, |b| b.distance);
    let bodies = bodies(&shape.brep);
    let mut found: Vec<([u32; 2], [u32; 2], f64)> = vec![];
    for pair in pairs {
        let [a, b] = pair.map(|f| drawn.faces[f as usize]);
        if a == b || bodies[a as usize] != bodies[b as usize] {
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

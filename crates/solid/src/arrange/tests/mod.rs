//! Arrangements and unions against closed forms, brute force in whole numbers, and properties.

mod pieces;
pub(crate) mod touching;
mod twin;
mod unions;

use super::*;
use trueness_geom::check::intersect;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;
use trueness_geom::topology::Properties;

/// Adds a box between two corners, looking outwards.
pub(super) fn add_box(mesh: &mut Mesh, low: Point, high: Point) {
    let first = mesh.positions.len() as u32;
    let corner = |i: usize| std::array::from_fn(|k| if i >> k & 1 == 1 { high[k] } else { low[k] });
    mesh.positions.extend((0..8).map(corner));
    let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    for [a, b, c, d] in squares.map(|s: [u32; 4]| s.map(|v| v + first)) {
        mesh.faces.extend([[a, b, c], [a, c, d]]);
    }
}

/// Adds a tetrahedron, turned to look outwards.
pub(super) fn add_tetrahedron(mesh: &mut Mesh, corners: [Point; 4]) {
    use trueness_geom::num::predicates::side_of_plane;
    let [a, b, c, d] = corners;
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(if side_of_plane(&a, &b, &c, &d) > 0 { [a, c, b, d] } else { [a, b, c, d] });
    // The last corner lies where the first three run clockwise as seen from outside of the others.
    for face in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
        mesh.faces.push(face.map(|v: u32| v + first));
    }
}

pub(super) fn volume(mesh: &Mesh) -> f64 {
    Properties::of(mesh, &Topology::of(mesh).unwrap()).signed_volume
}

/// The union, which must be closed, free of crossings, flat and doubled facets, and made of pieces of facets of the mesh.
pub(super) fn union(mesh: &Mesh, options: &Options) -> Boundary {
    let b = outer_boundary(mesh, options, &Silent).unwrap();
    let t = Topology::of(&b.mesh).unwrap();
    assert!(t.boundary_edges.is_empty() && t.inconsistent_edges.is_empty(), "{t:?}");
    assert!(t.collinear.is_empty() && t.repeated_vertex.is_empty() && t.duplicate_facets.is_empty(), "{t:?}");
    assert_eq!(intersect::self_intersections(&b.mesh, &t, &Silent).unwrap(), Vec::<[u32; 2]>::new());
    let kept = as_it_is(mesh).unwrap().positions;
    assert_eq!(kept[..], b.mesh.positions[..kept.len()], "a vertex moved");
    if options.single {
        assert!(b.mesh.positions.iter().flatten().all(|x| f64::from(*x as f32) == *x));
    }
    b
}

pub(super) fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs().max(1e-300)
}

pub(super) fn turned(mut mesh: Mesh) -> Mesh {
    mesh.faces.iter_mut().for_each(|f| f.swap(1, 2));
    mesh
}

/// A whole number below `bound`.
pub(super) fn whole(random: &mut Random, bound: u64) -> f64 {
    random.below(bound) as f64
}

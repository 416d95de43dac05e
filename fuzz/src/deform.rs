//! Changing meshes: places of vertices, corners of facets, the whole.

use crate::mutate::below;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::space::{Point, minus, plus, times};

/// The most facets of a case.
const FACETS: usize = 400;

/// Coordinates at which arithmetic goes wrong.
const EDGES: [f64; 10] =
    [0.0, -0.0, f64::NAN, f64::INFINITY, f64::MAX, -1e300, 1e150, 1e-300, f64::MIN_POSITIVE, 5e-324];

/// `mesh` with one to sixteen changes; `other` gives pieces.
pub fn deformed(random: &mut Random, mut mesh: Mesh, other: &Mesh) -> Mesh {
    for _ in 0..1 << random.below(5) {
        if mesh.faces.is_empty() || mesh.positions.is_empty() {
            mesh = other.clone();
        } else if random.below(12) == 0 {
            whole(random, &mut mesh, other);
        } else if random.below(2) == 0 {
            vertex(random, &mut mesh);
        } else {
            facet(random, &mut mesh);
        }
        mesh.faces.truncate(FACETS);
    }
    used(mesh)
}

/// A vertex goes to a place that means something to other facets.
fn vertex(random: &mut Random, mesh: &mut Mesh) {
    let v = below(random, mesh.positions.len());
    let place = match random.below(8) {
        0 => mesh.positions[below(random, mesh.positions.len())],
        1..=3 => on_a_facet(random, mesh),
        4 => mesh.positions[v].map(|x| x as f32 as f64),
        5 => mesh.positions[v].map(|x| if random.below(2) == 0 { x.next_up() } else { x }),
        6 => mesh.positions[v].map(f64::round),
        _ => {
            let mut p = mesh.positions[v];
            p[below(random, 3)] = EDGES[below(random, EDGES.len())];
            p
        }
    };
    if random.below(3) == 0 {
        // One facet alone goes there: the surface tears.
        let (f, k) = (below(random, mesh.faces.len()), below(random, 3));
        mesh.faces[f][k] = mesh.positions.len() as u32;
        mesh.positions.push(place);
    } else {
        mesh.positions[v] = place;
    }
}

/// On a facet, on its edge, at its middle, or close by.
fn on_a_facet(random: &mut Random, mesh: &Mesh) -> Point {
    let [a, b, c] = mesh.faces[below(random, mesh.faces.len())].map(|v| mesh.positions[v as usize]);
    let at = |random: &mut Random| random.below(5) as f64 / 4.0;
    let (u, v) = (at(random), at(random));
    let p = plus(a, plus(times(u, minus(b, a)), times((1.0 - u) * v, minus(c, a))));
    match random.below(3) {
        0 => p.map(|x| x + (random.unit() - 0.5) * 1e-6 * x.abs()),
        _ => p,
    }
}

/// A facet comes, goes, or gets another corner.
fn facet(random: &mut Random, mesh: &mut Mesh) {
    let (f, n) = (below(random, mesh.faces.len()), mesh.positions.len());
    let [a, b, c] = mesh.faces[f];
    let any = |random: &mut Random| below(random, n) as u32;
    match random.below(9) {
        0 => drop(mesh.faces.swap_remove(f)),
        1 => mesh.faces.push([a, b, c]),
        2 => mesh.faces[f] = [b, a, c],
        3 => mesh.faces.push([b, a, any(random)]),
        4 => mesh.faces[f][below(random, 3)] = any(random),
        5 => mesh.faces.push(std::array::from_fn(|_| any(random))),
        6 => mesh.faces.push([a, b, a]),
        // A vertex on one side of an edge alone.
        7 => {
            let m = mesh.positions.len() as u32;
            let [p, q] = [a, b].map(|v| mesh.positions[v as usize]);
            mesh.positions.push(times(0.5, plus(p, q)));
            mesh.faces[f] = [a, m, c];
            mesh.faces.push([m, b, c]);
        }
        // All facets at a vertex.
        _ => mesh.faces.retain(|f| !f.contains(&a)),
    }
}

/// All vertices move, or another mesh joins.
fn whole(random: &mut Random, mesh: &mut Mesh, other: &Mesh) {
    let k = below(random, 3);
    match random.below(7) {
        0 => {
            let scale = [1e-300, 1e-160, 1e-20, 1e20, 1e150, 1e300][below(random, 6)];
            mesh.positions.iter_mut().for_each(|p| *p = times(scale, *p));
        }
        1 => mesh.positions.iter_mut().for_each(|p| p[k] = 0.0),
        2 => {
            let shift = [1.0, 1e3, 1e7, 1e12][below(random, 4)];
            mesh.positions.iter_mut().for_each(|p| p[k] += shift);
        }
        // Among few places: much is coplanar, much coincides.
        3 => {
            let size = mesh
                .positions
                .iter()
                .flatten()
                .filter(|x| x.is_finite())
                .fold(0.0, |m: f64, x| m.max(x.abs()));
            let step = size / (1 << random.below(6)) as f64;
            mesh.positions
                .iter_mut()
                .flatten()
                .filter(|x| x.is_finite() && step > 0.0)
                .for_each(|x| *x = (*x / step).round() * step);
        }
        4 => mesh.faces.iter_mut().for_each(|f| f.swap(0, 1)),
        _ => {
            let shift = mesh.positions.len() as u32;
            let offset = on_a_facet(random, mesh);
            let scale = [0.0, 0.001, 0.5, 1.0][below(random, 4)];
            mesh.positions.extend(other.positions.iter().map(|p| plus(*p, times(scale, offset))));
            mesh.faces.extend(other.faces.iter().map(|f| f.map(|v| v + shift)));
        }
    }
}

/// Without vertices that no facet uses, or the mesh would only ever grow.
fn used(mesh: Mesh) -> Mesh {
    let mut number = vec![None; mesh.positions.len()];
    let mut positions = vec![];
    let faces = mesh.faces.iter().map(|f| {
        f.map(|v| {
            *number[v as usize].get_or_insert_with(|| {
                positions.push(mesh.positions[v as usize]);
                positions.len() as u32 - 1
            })
        })
    });
    let faces = faces.collect();
    Mesh { positions, faces }
}

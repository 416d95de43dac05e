//! Simple closed bodies that look outwards.

use crate::mesh::Mesh;
use crate::space::{Point, plus};
use crate::topology::weld;
use std::f64::consts::PI;

/// Runs `job` in a pool of its own.
pub fn on_threads<T: Send>(threads: usize, job: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(job)
}

/// Box from the origin, `n` cells along each side, closed and looking outwards.
pub fn block(n: u32, size: f64) -> Mesh {
    let mut facets = vec![];
    let step = size / f64::from(n);
    for axis in 0..3 {
        for i in 0..n {
            for j in 0..n {
                let at = |di: u32, dj: u32, far: bool| {
                    let mut p = [0.0; 3];
                    p[axis] = if far { size } else { 0.0 };
                    p[(axis + 1) % 3] = f64::from(i + di) * step;
                    p[(axis + 2) % 3] = f64::from(j + dj) * step;
                    p
                };
                for far in [true, false] {
                    let [a, b, c, d] = [at(0, 0, far), at(1, 0, far), at(1, 1, far), at(0, 1, far)];
                    facets.extend(if far { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
                }
            }
        }
    }
    weld::corners(facets.len(), |f, k| facets[f][k]).unwrap()
}

/// A sphere of `n x n` quads, each cut in two.
pub fn sphere(n: usize, r: f64, at: Point) -> Mesh {
    let mut positions = vec![];
    for i in 0..=n {
        for j in 0..n {
            let (a, b) = (PI * i as f64 / n as f64, 2.0 * PI * j as f64 / n as f64);
            let s = if i == 0 || i == n { 0.0 } else { a.sin() };
            positions.push(plus(at, [r * s * b.cos(), r * s * b.sin(), r * a.cos()]));
        }
    }
    let id = |i: usize, j: usize| match i {
        0 => 0,
        _ if i == n => (n * n) as u32,
        _ => (i * n + j % n) as u32,
    };
    let mut faces = vec![];
    for i in 0..n {
        for j in 0..n {
            if i + 1 < n {
                faces.push([id(i, j), id(i + 1, j), id(i + 1, j + 1)]);
            }
            if i > 0 {
                faces.push([id(i, j), id(i + 1, j + 1), id(i, j + 1)]);
            }
        }
    }
    Mesh { positions, faces }
}

/// The cube `[0, size]³`, outward, twelve faces.
pub fn cube(size: f64) -> Mesh {
    let positions = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|b| b as f64 * size)).collect();
    let faces = vec![
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    Mesh { positions, faces }
}

/// Adds the facets of another mesh, moved by `offset`.
pub fn add(mesh: &mut Mesh, other: &Mesh, offset: Point) {
    let shift = mesh.positions.len() as u32;
    mesh.positions.extend(other.positions.iter().map(|p| plus(*p, offset)));
    mesh.faces.extend(other.faces.iter().map(|f| f.map(|v| v + shift)));
}

/// The same with its facets turned over.
pub fn inverted(mut mesh: Mesh) -> Mesh {
    mesh.faces.iter_mut().for_each(|f| f.swap(0, 1));
    mesh
}

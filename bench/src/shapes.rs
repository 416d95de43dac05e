//! Meshes and clouds made on the spot, for the small benchmarks that need no files.

use std::f64::consts::TAU;
use trueness_geom::{
    mesh::Mesh,
    num::random::Random,
    space::{Point, cross, minus, plus, times, unit},
};

/// A closed, wavy torus 500 mm across of `2 n²` triangles, all of about the same size.
pub fn torus(n: u32) -> Mesh {
    let place = |i: u32, j: u32| {
        let (a, b) = (TAU * f64::from(i) / f64::from(n), TAU * f64::from(j) / f64::from(n));
        let tube = 60.0 + 5.0 * (7.0 * a).sin() * (5.0 * b).cos();
        let out = 190.0 + tube * b.cos();
        [out * a.cos(), out * a.sin(), tube * b.sin()]
    };
    let at = |i: u32, j: u32| (i % n) * n + j % n;
    let cells = || (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    Mesh {
        positions: cells().map(|(i, j)| place(i, j)).collect(),
        faces: cells()
            .flat_map(|(i, j)| {
                let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                [[p, q, r], [p, r, s]]
            })
            .collect(),
    }
}

/// Points on the mesh, evenly over its faces, moved along the normal by up to `noise` either way.
pub fn scan(mesh: &Mesh, count: usize, noise: f64) -> Vec<Point> {
    let mut random = Random::new(1);
    let faces = mesh.faces.len() as u64;
    (0..count)
        .map(|_| {
            let [a, b, c] = mesh.faces[random.below(faces) as usize].map(|v| mesh.positions[v as usize]);
            let (u, v) = (random.unit().sqrt(), random.unit());
            let (ab, ac) = (minus(b, a), minus(c, a));
            let on = plus(a, plus(times(u * (1.0 - v), ab), times(u * v, ac)));
            let height = noise * (2.0 * random.unit() - 1.0);
            unit(cross(ab, ac)).map_or(on, |(normal, _)| plus(on, times(height, normal)))
        })
        .collect()
}

//! Parts made for the tests.

use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, unit};

/// A box from `low` to `high`, its sides cut into squares of about `step`, with shared vertices.
pub fn block(low: Point, high: Point, step: f64) -> Mesh {
    let mut soup = vec![];
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let counts = [u, v].map(|k| ((high[k] - low[k]) / step).ceil().max(1.0) as usize);
        let at = |i: usize, j: usize, top: bool| {
            let mut p = low;
            p[axis] = if top { high[axis] } else { low[axis] };
            p[u] = low[u] + (high[u] - low[u]) * i as f64 / counts[0] as f64;
            p[v] = low[v] + (high[v] - low[v]) * j as f64 / counts[1] as f64;
            p
        };
        for (i, j) in (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| (i, j))) {
            for top in [false, true] {
                let [a, b, c, d] =
                    [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| at(i, j, top));
                let quads = [[a, b, c], [a, c, d]];
                soup.extend(quads.map(|[a, b, c]| if top { [a, b, c] } else { [a, c, b] }));
            }
        }
    }
    shared(&soup)
}

/// A body of revolution about z: radii at heights, closed by its ends on the axis.
pub fn turned(profile: &[[f64; 2]], sectors: usize) -> Mesh {
    let at = |[r, z]: [f64; 2], k: usize| {
        let angle = std::f64::consts::TAU * (k % sectors) as f64 / sectors as f64;
        [r * libm::cos(angle), r * libm::sin(angle), z]
    };
    let mut soup = vec![];
    for pair in profile.windows(2) {
        for k in 0..sectors {
            let [a, b, c, d] = [at(pair[0], k), at(pair[0], k + 1), at(pair[1], k + 1), at(pair[1], k)];
            soup.extend(
                [[a, b, c], [a, c, d]].into_iter().filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]),
            );
        }
    }
    shared(&soup)
}

/// Triangles with equal places made one vertex.
pub fn shared(soup: &[[Point; 3]]) -> Mesh {
    let mut known = std::collections::BTreeMap::new();
    let mut mesh = Mesh::default();
    for t in soup {
        let face = t.map(|p| {
            *known.entry(p.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                mesh.positions.push(p);
                mesh.positions.len() as u32 - 1
            })
        });
        mesh.faces.push(face);
    }
    mesh
}

/// Several meshes as one.
pub fn together(meshes: &[Mesh]) -> Mesh {
    let mut all = Mesh::default();
    for m in meshes {
        let first = all.positions.len() as u32;
        all.positions.extend_from_slice(&m.positions);
        all.faces.extend(m.faces.iter().map(|f| f.map(|v| v + first)));
    }
    all
}

/// A plate with three different posts on it: no symmetry, all freedoms held. The bodies overlap a little.
pub fn bracket(step: f64) -> Mesh {
    together(&[
        block([0.0, 0.0, 0.0], [80.0, 50.0, 10.0], step),
        block([8.0, 6.0, 9.0], [20.0, 30.0, 32.0], step),
        block([60.0, 30.0, 9.0], [74.0, 44.0, 20.0], step),
        moved(
            &turned(&[[0.0, 9.0], [9.0, 9.0], [6.0, 26.0], [0.0, 26.0]], 48),
            &Rigid::translation_by([50.0, 14.0, 0.0]),
        ),
    ])
}

/// The mesh after a motion.
pub fn moved(mesh: &Mesh, motion: &Rigid) -> Mesh {
    Mesh { positions: mesh.positions.iter().map(|p| motion.point(*p)).collect(), faces: mesh.faces.clone() }
}

/// A normal deviate (Box and Muller).
pub fn normal(random: &mut Random) -> f64 {
    let (u, v) = (1.0 - random.unit(), random.unit());
    (-2.0 * libm::log(u)).sqrt() * libm::cos(std::f64::consts::TAU * v)
}

/// A rotation, every one equally likely, with a shift of up to `reach` each way.
pub fn random_pose(random: &mut Random, reach: f64) -> Rigid {
    let q = loop {
        let q: [f64; 4] = std::array::from_fn(|_| 2.0 * random.unit() - 1.0);
        let length = q.iter().map(|x| x * x).sum::<f64>();
        if (0.01..1.0).contains(&length) {
            break q.map(|x| x / length.sqrt());
        }
    };
    let angle = 2.0 * libm::acos(q[0].clamp(-1.0, 1.0));
    let axis: Vector = unit([q[1], q[2], q[3]]).map_or([1.0, 0.0, 0.0], |u| u.0);
    let shift = std::array::from_fn(|_| reach * (2.0 * random.unit() - 1.0));
    Rigid::translation_by(shift).after(&Rigid::rotation_about([0.0; 3], axis.map(|x| x * angle)))
}

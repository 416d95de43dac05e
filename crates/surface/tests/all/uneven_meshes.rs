//! Meshes of long facets, and of facets that occur twice: curvatures and signs are those of the surfaces that they
//! stand for.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use trueness_geom::closest::Tree;
use trueness_geom::deviation::surface::{ReferenceSurface, SurfaceOptions};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Point, times, unit};
use trueness_surface::curvature::{self, Options};

/// A sphere of rows of facets, `around` in each, with a fan at each pole.
fn globe(radius: f64, rows: u32, around: u32) -> Mesh {
    let mut positions: Vec<Point> = (0..rows * around)
        .map(|k| {
            let (a, b) = (
                TAU * f64::from(k % around) / f64::from(around),
                PI * f64::from(k / around + 1) / f64::from(rows + 1),
            );
            times(radius, [libm::sin(b) * libm::cos(a), libm::sin(b) * libm::sin(a), libm::cos(b)])
        })
        .collect();
    positions.extend([[0.0, 0.0, radius], [0.0, 0.0, -radius]]);
    let (top, bottom) = (rows * around, rows * around + 1);
    let mut faces = vec![];
    for j in 0..around {
        let next = (j + 1) % around;
        faces.push([top, j, next]);
        for i in 0..rows - 1 {
            let (a, b) = (i * around, (i + 1) * around);
            faces.extend([[a + j, b + j, b + next], [a + j, b + next, a + next]]);
        }
        let last = (rows - 1) * around;
        faces.push([bottom, last + next, last + j]);
    }
    Mesh { positions, faces }
}

/// A tube along z whose facets are as much longer than wide as its rows are apart.
fn tube(radius: f64, rows: u32, around: u32, apart: f64) -> Mesh {
    let place = |k: u32| {
        let a = TAU * f64::from(k % around) / f64::from(around);
        [radius * libm::cos(a), radius * libm::sin(a), apart * f64::from(k / around)]
    };
    let cell = |k: u32| {
        let (a, next) = (k, k / around * around + (k + 1) % around);
        [[a, next, next + around], [a, next + around, a + around]]
    };
    Mesh {
        positions: (0..rows * around).map(place).collect(),
        faces: (0..(rows - 1) * around).flat_map(cell).collect(),
    }
}

#[test]
fn curvatures_of_long_facets_are_those_of_the_shape() {
    let cases = [
        (globe(3.0, 7, 200), -1.0 / 3.0, 0.25),
        (globe(10.0, 15, 240), -0.1, 0.08),
        (globe(5.0, 30, 300), -0.2, 0.03),
        (tube(10.0, 40, 200, 3.0), -0.05, 0.1),
        (tube(10.0, 200, 24, 0.15), -0.05, 0.15),
    ];
    for (n, (mesh, right, within)) in cases.iter().enumerate() {
        let found = curvature::mesh(mesh, &Options::default(), &Silent).unwrap();
        let all: Vec<f64> = found.places.iter().flatten().map(|jet| jet.bend.mean).collect();
        let worst = all.iter().map(|h| (h / right - 1.0).abs()).fold(0.0, f64::max);
        let missing = mesh.positions.len() - all.len();
        eprintln!("{n}: {} places, {missing} without, worst {worst:.4}", all.len());
        assert!(worst < *within, "{n}: {worst}");
    }
}

/// A sphere of 320 facets.
fn round() -> Mesh {
    let t = (1.0 + 5f64.sqrt()) / 2.0;
    let mut positions: Vec<Point> = vec![];
    for (a, b) in [(-1.0, t), (1.0, t), (-1.0, -t), (1.0, -t)] {
        positions.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]]);
    }
    let near = |a: usize, b: usize, p: &[Point]| {
        let d: f64 = (0..3).map(|k| (p[a][k] - p[b][k]).powi(2)).sum();
        d < 4.1
    };
    let mut faces: Vec<[u32; 3]> = vec![];
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b, &positions) && near(b, c, &positions) && near(a, c, &positions) {
                    let [p, q, r] = [a, b, c].map(|k| positions[k]);
                    let det = p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0])
                        + p[2] * (q[0] * r[1] - q[1] * r[0]);
                    faces.push(if det > 0.0 {
                        [a as u32, b as u32, c as u32]
                    } else {
                        [a as u32, c as u32, b as u32]
                    });
                }
            }
        }
    }
    positions.iter_mut().for_each(|p| *p = unit(*p).unwrap().0);
    for _ in 0..2 {
        let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let mut middle = |a: u32, b: u32, positions: &mut Vec<Point>| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                let sum = std::array::from_fn(|k| positions[a as usize][k] + positions[b as usize][k]);
                positions.push(unit(sum).unwrap().0);
                positions.len() as u32 - 1
            })
        };
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [x, y, z] = [[a, b], [b, c], [c, a]].map(|[p, q]| middle(p, q, &mut positions));
                [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
            })
            .collect();
    }
    Mesh { positions, faces }
}

/// Copies of single facets and of whole neighborhoods, turned the other way, change no sign.
#[test]
fn opposite_copies_of_facets_do_not_decide_the_sign() {
    let sound = round();
    let mut wrong = 0;
    for seed in 0..6 {
        let random = &mut Random::stream(seed, 9);
        let mut mesh = sound.clone();
        let turned = |[a, b, c]: [u32; 3]| [a, c, b];
        if seed < 3 {
            let chosen = random.choose(40 << seed, sound.faces.len());
            mesh.faces.extend(chosen.iter().map(|f| turned(sound.faces[*f])));
        } else {
            // All around a few vertices, with a free fin that encloses nothing.
            let chosen = random.choose(12, sound.positions.len());
            let around = |f: &&[u32; 3]| f.iter().any(|v| chosen.contains(&(*v as usize)));
            mesh.faces.extend(sound.faces.iter().filter(around).map(|f| turned(*f)));
            let first = mesh.positions.len() as u32;
            mesh.positions.extend([[2.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, 1.0, 0.0]]);
            mesh.faces.extend([[first, first + 1, first + 2], [first, first + 2, first + 1]]);
        }
        let options = SurfaceOptions::default();
        let tree = Tree::build(&mesh).unwrap();
        let reference = ReferenceSurface::new(&tree, &mesh, &options, &Silent).unwrap();
        let alone = Tree::build(&sound).unwrap();
        let true_signs = ReferenceSurface::new(&alone, &sound, &options, &Silent).unwrap();
        let points: Vec<Point> =
            (0..1200).map(|_| std::array::from_fn(|_| 2.6 * random.unit() - 1.3)).collect();
        let found = reference.deviations(&points, &Silent).unwrap();
        let right = true_signs.deviations(&points, &Silent).unwrap();
        let own = found.iter().zip(&right).filter(|(a, b)| (**a < 0.0) != (**b < 0.0)).count();
        eprintln!("{seed}: {own} signs wrong");
        wrong += own;
    }
    assert_eq!(wrong, 0);
}

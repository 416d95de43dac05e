//! Every mesh that reads: the search equals brute force to the last bit, near and far, on one thread and on two.
//!
//! `TRUENESS_MESHES=FOLDER:FOLDER TRUENESS_POINTS=N` tries other meshes, and more points.

use rayon::prelude::*;
use std::path::{Path, PathBuf};
use trueness_files::{Body, ReadOptions};
use trueness_geom::closest::{Query, Tree, brute};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;

fn folders() -> Vec<PathBuf> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    match std::env::var("TRUENESS_MESHES") {
        Ok(list) => list.split(':').map(PathBuf::from).collect(),
        Err(_) => ["shapes", "broken"].map(|f| corpus.join(f)).to_vec(),
    }
}

/// Half of the points near the surface (on it, or off by a hundredth of the size), half around and far from it.
fn points(mesh: &Mesh, n: usize) -> Vec<Point> {
    let mut random = Random::new(7);
    let bounds = mesh.bounds();
    let size = bounds.diagonal().max(1e-6);
    let mut unit = move || 2.0 * random.unit() - 1.0;
    let center: Point = std::array::from_fn(|k| 0.5 * bounds.min[k] + 0.5 * bounds.max[k]);
    let mut out = vec![];
    for i in 0..n {
        let offset =
            |reach: f64, unit: &mut dyn FnMut() -> f64| -> Point { std::array::from_fn(|_| reach * unit()) };
        let (from, off) = if i % 2 == 0 {
            let face = mesh.faces[i * 7919 % mesh.faces.len()].map(|v| mesh.positions[v as usize]);
            let (s, t) = (unit().abs(), unit().abs());
            let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
            let on = |k: usize| face[0][k] + s * (face[1][k] - face[0][k]) + t * (face[2][k] - face[0][k]);
            (std::array::from_fn(on), offset([0.0, 1e-6, 1e-2][i / 2 % 3] * size, &mut unit))
        } else {
            (center, offset([0.7, 3.0, 100.0][i / 2 % 3] * size, &mut unit))
        };
        out.push(std::array::from_fn(|k| from[k] + off[k]));
    }
    out
}

fn answers(mesh: &Mesh, points: &[Point], threads: usize) -> Vec<(u64, u32)> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let tree = Tree::build(mesh).unwrap();
        let hit =
            |_, h: Option<trueness_geom::closest::Hit>| h.map(|h| (h.distance_squared.to_bits(), h.face));
        let found = tree.map_closest(points, &Query::default(), &Silent, hit).unwrap();
        found.into_iter().map(|h| h.expect("no greatest distance")).collect()
    })
}

#[test]
fn equals_brute_force_on_every_mesh_that_reads() {
    let n = std::env::var("TRUENESS_POINTS").map_or(300, |n| n.parse().unwrap());
    let mut files: Vec<PathBuf> =
        folders().iter().flat_map(|f| std::fs::read_dir(f).unwrap()).map(|e| e.unwrap().path()).collect();
    files.sort();
    let mut meshes = 0;
    for path in files {
        let Ok(input) = trueness_files::open(&path, &ReadOptions::default()) else { continue };
        let Body::Mesh(mesh) = input.body else { continue };
        if Tree::build(&mesh.mesh).is_err() {
            continue;
        }
        meshes += 1;
        let points = points(&mesh.mesh, n);
        let one = answers(&mesh.mesh, &points, 1);
        assert!(one == answers(&mesh.mesh, &points, 2), "{}: threads change the answer", path.display());
        let want: Vec<(u64, u32)> = points
            .par_iter()
            .map(|p| brute::closest(&mesh.mesh, p))
            .map(|(d, face)| (d.to_bits(), face))
            .collect();
        for (i, (got, want)) in one.iter().zip(&want).enumerate() {
            assert_eq!(got, want, "{}: point {i} {:?}", path.display(), points[i]);
        }
    }
    assert!(meshes > 50, "only {meshes} meshes were read");
    if std::env::var_os("TRUENESS_MESHES").is_some() {
        println!("{meshes} meshes, {n} points each: equal in every bit");
    }
}

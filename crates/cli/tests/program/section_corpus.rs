//! Sections of every closed mesh of the corpus: by random planes, and through its vertices, edges and facets.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use trueness_files::{Body, ReadOptions, open};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::exact::Exact;
use trueness_geom::num::random::Random;
use trueness_geom::plane::{Plane, PlaneFrame};
use trueness_geom::progress::Silent;
use trueness_geom::space::{Point, cross, dot, minus};
use trueness_geom::topology::Soundness;
use trueness_section::{area, cut};

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../corpus");
/// Planes of each sort.
const PLANES: usize = 50;

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut all = vec![];
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { all.extend(files(&path)) } else { all.push(path) }
    }
    all.sort();
    all
}

/// The meshes that are closed, with two facets at each edge that agree about the outside.
fn closed_meshes() -> Vec<(PathBuf, Mesh)> {
    let read = |path: PathBuf| match open(&path, &ReadOptions::default()).ok()?.body {
        Body::Mesh(m) => {
            let finite = m.mesh.positions.iter().flatten().all(|x| x.is_finite());
            let sound = Soundness::of(&m.mesh).ok()?;
            (finite && sound.oriented()).then_some((path, m.mesh))
        }
        Body::Points(_) | Body::Splines(_) | Body::Cad(_) | Body::Drawing(_) => None,
    };
    files(Path::new(CORPUS)).into_iter().filter_map(read).collect()
}

/// The plane of this direction through a point.
fn through(normal: [f64; 3], point: Point) -> Plane {
    Plane { normal, offset: dot(normal, point) }
}

/// Random planes, then planes through a vertex, through an edge, and in a facet; offsets are rounded, so that some lie a hair
/// beside what they were meant to pass.
fn planes(mesh: &Mesh, random: &mut Random) -> Vec<Plane> {
    let mut all = vec![];
    let index = |random: &mut Random, n: usize| ((random.unit() * n as f64) as usize).min(n - 1);
    for _ in 0..PLANES {
        let face = mesh.faces[index(random, mesh.faces.len())].map(|v| mesh.positions[v as usize]);
        let other = mesh.faces[index(random, mesh.faces.len())].map(|v| mesh.positions[v as usize]);
        let normal = [0; 3].map(|_| random.unit() - 0.5);
        let t = random.unit();
        all.push(through(normal, [0, 1, 2].map(|k| face[0][k] + t * (other[1][k] - face[0][k]))));
        all.push(through(normal, face[1]));
        all.push(through(cross(minus(face[1], face[0]), normal), face[0]));
        all.push(through(cross(minus(face[1], face[0]), minus(face[2], face[0])), face[0]));
        // Along an axis, through a vertex to the last bit.
        let axis = index(random, 3);
        let mut unit = [0.0; 3];
        unit[axis] = if t < 0.5 { 1.0 } else { -1.0 };
        all.push(Plane { normal: unit, offset: unit[axis] * face[2][axis] });
    }
    all.retain(|p| dot(p.normal, p.normal) > 0.0 && p.frame().is_some());
    all
}

/// The area by the segments of all facets, each by itself (the divergence theorem in the plane), and the sum of the
/// magnitudes of what was added. A vertex in the plane counts as above.
fn brute(mesh: &Mesh, plane: &Plane, frame: &PlaneFrame) -> (f64, f64) {
    let sides: Vec<i32> = mesh
        .positions
        .iter()
        .map(|p| {
            let mut sum = Exact::default();
            (0..3).for_each(|k| sum.add_product(plane.normal[k], p[k], 1.0));
            sum.add(-plane.offset);
            sum.sign()
        })
        .collect();
    let height = |p: &Point| dot(plane.normal, *p) - plane.offset;
    let (mut sum, mut size) = (0.0, 0.0);
    for face in &mesh.faces {
        let (mut from, mut to) = (None, None);
        for k in 0..3 {
            let [a, b] = [face[k], face[(k + 1) % 3]];
            // Always from the same end: the two facets at an edge must agree.
            let ends = [a.min(b), a.max(b)].map(|v| v as usize);
            let [p, q] = ends.map(|v| mesh.positions[v]);
            let (h, l) = (height(&p), height(&q));
            let t = if h == l { 0.5 } else { (h / (h - l)).clamp(0.0, 1.0) };
            let at = match ends.map(|v| sides[v]) {
                [0, _] => p,
                [_, 0] => q,
                _ => [0, 1, 2].map(|k| p[k] + t * (q[k] - p[k])),
            };
            let at = frame.flat(at);
            match (sides[a as usize] >= 0, sides[b as usize] >= 0) {
                (true, false) => from = Some(at),
                (false, true) => to = Some(at),
                _ => {}
            }
        }
        if let (Some(a), Some(b)) = (from, to) {
            sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
            size += (a[0] * b[1]).abs() + (a[1] * b[0]).abs();
        }
    }
    (sum, size)
}

/// Chains of closed meshes close, no point stands twice in succession and no edge twice at all, and the area is that of brute
/// force to 1e-12 of what was added up.
#[test]
fn sections_of_closed_meshes_close_whatever_the_plane_passes() {
    let random = &mut Random::new(15);
    let (mut cuts, mut hit) = (0, 0);
    let meshes = closed_meshes();
    for (path, mesh) in &meshes {
        let planes = planes(mesh, random);
        // Large meshes with fewer planes.
        let stride = (mesh.faces.len() / 20_000).max(1);
        for plane in planes.iter().step_by(stride) {
            let chains = cut(mesh, plane, &Silent).unwrap();
            let shown = format!("{} {plane:?}", path.display());
            let mut edges = HashSet::new();
            for chain in &chains {
                assert!(chain.closed, "{shown}: open");
                let n = chain.points.len();
                assert!(
                    n >= 2 && (0..n).all(|i| chain.points[i] != chain.points[(i + 1) % n]),
                    "{shown}: doubled"
                );
                assert!(chain.edges.iter().all(|e| edges.insert(*e)), "{shown}: an edge twice");
            }
            let frame = plane.frame().unwrap();
            let got = area(&chains, &frame);
            let (want, size) = brute(mesh, plane, &frame);
            assert!(
                (got - want).abs() <= 1e-12 * size.max(f64::MIN_POSITIVE),
                "{shown}: {got} {want} {size}"
            );
            cuts += 1;
            hit += usize::from(!chains.is_empty());
        }
    }
    assert!(meshes.len() >= 20 && cuts >= 3000 && hit * 2 > cuts, "{} meshes, {hit} of {cuts}", meshes.len());
}

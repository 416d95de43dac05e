//! Curvatures against closed forms, properties, and a second way.

use super::*;
use std::f64::consts::TAU;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Vector, cross, dot, minus, norm, plus, times, unit};

mod shared;

/// A place, its outward normal, and there the principal curvatures with the direction of the first.
type KnownPoint = (Point, Vector, [f64; 2], Vector);

/// A body known in closed form, by two parameters.
type TestSurface = fn(f64, f64) -> KnownPoint;

const R: f64 = 10.0;

fn sphere(u: f64, v: f64) -> KnownPoint {
    let n = [v.cos() * u.cos(), v.cos() * u.sin(), v.sin()];
    (times(R, n), n, [-1.0 / R; 2], [-u.sin(), u.cos(), 0.0])
}

fn cylinder(u: f64, v: f64) -> KnownPoint {
    let n = [u.cos(), u.sin(), 0.0];
    ([R * n[0], R * n[1], R * v], n, [0.0, -1.0 / R], [0.0, 0.0, 1.0])
}

/// Radii 10 and 4; `v` is 0 on the outer side.
fn torus(u: f64, v: f64) -> KnownPoint {
    let n = [v.cos() * u.cos(), v.cos() * u.sin(), v.sin()];
    let middle = [R * u.cos(), R * u.sin(), 0.0];
    let around = [-u.sin(), u.cos(), 0.0];
    (plus(middle, times(4.0, n)), n, [-v.cos() / (R + 4.0 * v.cos()), -0.25], around)
}

/// A patch of the surface around `(u, v)`: rings of a grid that is moved by chance, half of it as fine as said.
fn patch(surface: TestSurface, at: [f64; 2], step: f64, random: &mut Random) -> Mesh {
    const N: u32 = 16;
    let place = |k: u32| {
        let mut along = |j: u32, size: f64| {
            let chance = if k == N / 2 * (N + 1) + N / 2 { 0.0 } else { 0.6 * (random.unit() - 0.5) };
            size * (f64::from(j) - 0.5 * f64::from(N) + chance)
        };
        let (du, dv) = (along(k % (N + 1), step), along(k / (N + 1), step));
        surface(at[0] + du, at[1] + dv).0
    };
    let positions = (0..(N + 1) * (N + 1)).map(place).collect();
    Mesh { positions, faces: grid(N, N + 1, false) }
}

/// Facets of `n` by `n` cells of rows of `width` places.
fn grid(n: u32, width: u32, flip: bool) -> Vec<[u32; 3]> {
    let cell = |k: u32| {
        let a = k / n * width + k % n;
        [[a, a + 1, a + width + 1], [a, a + width + 1, a + width]]
    };
    let faces = (0..n * n).flat_map(cell);
    faces.map(|[a, b, c]| if flip { [a, c, b] } else { [a, b, c] }).collect()
}

const MIDDLE: usize = 16 / 2 * 17 + 16 / 2;

/// Greatest error of the principal curvatures in the middle over some patches.
fn error(surface: TestSurface, at: [f64; 2], step: f64, options: &Options, cloud_instead: bool) -> f64 {
    let mut worst = 0.0f64;
    for seed in 0..8 {
        let mesh = patch(surface, at, step, &mut Random::new(seed));
        let found = match cloud_instead {
            true => cloud(&mesh.positions, options, &Silent).unwrap(),
            false => super::mesh(&mesh, options, &Silent).unwrap(),
        };
        let mut jet = found.places[MIDDLE].unwrap();
        let (_, normal, known, _) = surface(at[0], at[1]);
        if cloud_instead && dot(jet.bend.normal, normal) < 0.0 {
            jet = jet.turned();
        }
        assert!(dot(jet.bend.normal, normal) > 0.99);
        for (p, k) in jet.bend.principal.iter().zip(known) {
            worst = worst.max((p.curvature - k).abs());
        }
    }
    worst
}

/// Curvatures come out to the order degree − 1 at least (theorem 3 of the paper), on meshes and in clouds.
#[test]
fn curvatures_converge_as_the_paper_says() {
    let surfaces: [(TestSurface, [f64; 2]); 4] =
        [(sphere, [0.4, 0.3]), (cylinder, [0.4, 0.1]), (torus, [0.4, 0.5]), (torus, [0.4, 2.6])];
    for (n, (surface, at)) in surfaces.into_iter().enumerate() {
        for degree in 2..=5 {
            for instead in [false, true] {
                let options = Options { degree, ..Options::default() };
                let of = |step: f64| error(surface, at, step, &options, instead);
                let (coarse, fine) = (of(0.04), of(0.01));
                let order = (coarse / fine).log2() / 2.0;
                assert!(
                    order > degree as f64 - 1.4 || fine < 1e-10,
                    "surface {n}, degree {degree}: {coarse:e} {fine:e}, order {order}"
                );
                assert!(fine < 2e-3, "surface {n}, degree {degree}: {fine:e}");
            }
        }
    }
}

/// A body with all of its values.
fn whole(surface: TestSurface, n: u32, m: u32, v: impl Fn(u32) -> f64) -> (Mesh, Vec<KnownPoint>) {
    let known: Vec<KnownPoint> =
        (0..n * (m + 1)).map(|k| surface(TAU * f64::from(k % n) / f64::from(n), v(k / n))).collect();
    let faces = (0..n * m).flat_map(|k| {
        let (i, j) = (k % n, k / n);
        let at = |i: u32, j: u32| j * n + i % n;
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    });
    (Mesh { positions: known.iter().map(|k| k.0).collect(), faces: faces.collect() }, known)
}

fn whole_torus() -> (Mesh, Vec<KnownPoint>) {
    let (mut mesh, mut known) = whole(torus, 120, 60, |j| TAU * f64::from(j) / 60.0);
    // The last row is the first one.
    mesh.faces.iter_mut().flatten().for_each(|v| *v %= 7200);
    mesh.positions.truncate(7200);
    known.truncate(7200);
    (mesh, known)
}

#[test]
fn a_whole_torus_has_its_curvatures_normals_and_directions() {
    let (mesh, known) = whole_torus();
    let options = Options { degree: 4, ..Options::default() };
    let of_mesh = super::mesh(&mesh, &options, &Silent).unwrap();
    let of_cloud = cloud(&mesh.positions, &options, &Silent).unwrap();
    assert_eq!((of_mesh.parts, of_cloud.parts), (0, 1));
    for found in [&of_mesh, &of_cloud] {
        for (place, (_, normal, k, direction)) in found.places.iter().zip(&known) {
            let bend = place.unwrap().bend;
            assert!(dot(bend.normal, *normal) > 1.0 - 1e-5);
            // Difference of a polynomial of degree 4 from a circle as wide as the neighborhood. For a parabola, its
            // curvature would be half of this bound.
            let (h, r) = (place.unwrap().reach, 4f64);
            let rest = r - (r * r - h * h).sqrt() - h * h / (2.0 * r) - h.powi(4) / (8.0 * r.powi(3));
            let bound = 4.0 * rest / (h * h);
            let off = |p: usize| (bend.principal[p].curvature - k[p]).abs();
            assert!(off(0).max(off(1)) < bound, "{} {} {bound}", off(0), off(1));
            assert!((bend.mean - 0.5 * (k[0] + k[1])).abs() < bound);
            assert!((bend.gaussian - k[0] * k[1]).abs() < 0.5 * bound);
            assert!(dot(bend.principal[0].direction, *direction).abs() > 0.999);
            assert!(dot(bend.principal[1].direction, *direction).abs() < 0.05);
        }
    }
    // Gauss and Bonnet: the integral over a torus is 0; the area of a vertex is a third of that of its facets.
    let mut area = vec![0.0; mesh.positions.len()];
    for face in &mesh.faces {
        let [a, b, c] = mesh.places(face);
        face.iter().for_each(|v| area[*v as usize] += norm(cross(minus(b, a), minus(c, a))) / 6.0);
    }
    let integral: f64 = of_mesh.places.iter().zip(&area).map(|(p, a)| p.unwrap().bend.gaussian * a).sum();
    // It is 4π on the outer side and as much less on the inner one.
    assert!(integral.abs() < 0.005 * 4.0 * TAU, "{integral}");
}

#[test]
fn polynomials_up_to_the_degree_are_exact() {
    for degree in 2..=6usize {
        let height = |x: f64, y: f64| {
            let all = (2..=degree as i32).map(|d| 0.02 * x.powi(d) - 0.015 * x * y.powi(d - 1));
            0.3 * x * y - 0.1 * y * y + all.sum::<f64>()
        };
        let places = (0..289u32).map(|k| (0.1 * (f64::from(k % 17) - 8.0), 0.1 * (f64::from(k / 17) - 8.0)));
        let mut fitter = Fitter::new(degree, None);
        fitter.take([0.0; 3], places.map(|(x, y)| [x, y, height(x, y)]).filter(|p| *p != [0.0; 3]));
        let jet = fitter.jet([0.0, 0.0, 1.0]).unwrap();
        let (xx, xy, yy) = (0.04, 0.285, -0.2);
        assert!((jet.bend.mean - 0.5 * (xx + yy)).abs() < 1e-12, "{degree}: {}", jet.bend.mean);
        assert!((jet.bend.gaussian - (xx * yy - xy * xy)).abs() < 1e-12);
        assert!(jet.residual < 1e-14 && jet.condition >= unknowns(degree) as f64);
        assert!(jet.neighbors == 288 && norm(minus(jet.bend.normal, [0.0, 0.0, 1.0])) < 1e-15);
    }
}

/// The same by normal equations and elimination, in the frame of the answer.
#[test]
fn another_solver_says_the_same() {
    let mesh = patch(torus, [0.4, 0.5], 0.05, &mut Random::new(3));
    for degree in [2, 3, 4] {
        let options = Options { degree, reach: Reach::Radius(2.5), ..Options::default() };
        let jet = super::mesh(&mesh, &options, &Silent).unwrap().places[MIDDLE].unwrap();
        let p = mesh.positions[MIDDLE];
        let near: Vec<Vector> =
            mesh.positions.iter().map(|q| minus(*q, p)).filter(|q| norm(*q) <= 2.5).collect();
        assert_eq!(jet.neighbors as usize + 1, near.len());
        // The frame at the start, from the facets around.
        let mut up = [0.0; 3];
        for face in mesh.faces.iter().filter(|f| f.contains(&(MIDDLE as u32))) {
            let [a, b, c] = mesh.places(face);
            up = plus(up, cross(minus(b, a), minus(c, a)));
        }
        let up = unit(up).unwrap().0;
        let x = unit(cross(up, [0.3, 0.5, 0.2])).unwrap().0;
        let y = cross(up, x);
        let powers: Vec<(i32, i32)> =
            (0..=degree as i32).flat_map(|d| (0..=d).map(move |k| (d - k, k))).collect();
        let n = powers.len();
        let (mut a, mut b, mut square) = (vec![vec![0.0; n]; n], vec![0.0; n], 0.0);
        for q in &near {
            let (u, v, z) = (dot(*q, x), dot(*q, y), dot(*q, up));
            let row: Vec<f64> = powers.iter().map(|(i, j)| u.powi(*i) * v.powi(*j)).collect();
            for i in 0..n {
                b[i] += row[i] * z;
                (0..n).for_each(|j| a[i][j] += row[i] * row[j]);
            }
            square += z * z;
        }
        let c = trueness_geom::num::dense::solve(a, b.clone()).unwrap();
        let left = square - c.iter().zip(&b).map(|(c, b)| c * b).sum::<f64>();
        let (fx, fy, xx, xy, yy) = (c[1], c[2], 2.0 * c[3], c[4], 2.0 * c[5]);
        let w = (1.0 + fx * fx + fy * fy).sqrt();
        let mean = ((1.0 + fy * fy) * xx - 2.0 * fx * fy * xy + (1.0 + fx * fx) * yy) / (2.0 * w.powi(3));
        let gaussian = (xx * yy - xy * xy) / w.powi(4);
        assert!((jet.bend.mean - mean).abs() < 1e-10, "{degree}: {} {mean}", jet.bend.mean);
        assert!((jet.bend.gaussian - gaussian).abs() < 1e-10);
        let deviation = (left.max(0.0) / (near.len() - n) as f64).sqrt();
        assert!((jet.residual - deviation).abs() < 1e-6 * deviation + 1e-9, "{} {deviation}", jet.residual);
    }
}

/// Normal with standard deviation 1 (Box and Muller).
fn normal(random: &mut Random) -> f64 {
    (-2.0 * (1.0 - random.unit()).ln()).sqrt() * (TAU * random.unit()).cos()
}

/// The uncertainty is the scatter that noise causes, and the residual is the noise.
#[test]
fn noise_scatters_as_the_uncertainty_says() {
    let random = &mut Random::new(11);
    let noise = 0.002;
    let mesh = patch(sphere, [0.4, 0.3], 0.03, &mut Random::new(1));
    let options = Options { degree: 3, reach: Reach::Count(60), ..Options::default() };
    let (mut sum, mut square, mut told, mut residual) = (0.0, 0.0, 0.0, 0.0);
    let runs = 600;
    for _ in 0..runs {
        let mut noisy = mesh.clone();
        for p in &mut noisy.positions {
            *p = times(1.0 + noise * normal(random) / R, *p);
        }
        let jet = super::mesh(&noisy, &options, &Silent).unwrap().places[MIDDLE].unwrap();
        let error = jet.bend.mean + 1.0 / R;
        sum += error;
        square += error * error;
        told += jet.uncertainty * jet.uncertainty;
        residual += jet.residual * jet.residual;
    }
    let n = f64::from(runs);
    let scatter = (square / n - (sum / n).powi(2)).sqrt();
    let [told, residual] = [told, residual].map(|s: f64| (s / n).sqrt());
    // 600 draws know a standard deviation to 3 %.
    assert!((scatter / told - 1.0).abs() < 0.12, "{scatter:e} {told:e}");
    assert!((residual / noise - 1.0).abs() < 0.05, "{residual:e}");
}

#[test]
fn motion_scale_side_and_threads_change_what_they_must() {
    let (mesh, _) = whole_torus();
    let options = Options::default();
    let found = super::mesh(&mesh, &options, &Silent).unwrap().places;
    let (s, c) = (0.6f64, 0.8f64);
    let moved =
        |p: &Point| [2.0 * (c * p[0] - s * p[2]) + 5.0, 2.0 * p[1] - 7.0, 2.0 * (s * p[0] + c * p[2]) + 90.0];
    let other = Mesh {
        positions: mesh.positions.iter().map(moved).collect(),
        faces: mesh.faces.iter().map(|[a, b, c]| [*a, *c, *b]).collect(),
    };
    let turned = super::mesh(&other, &options, &Silent).unwrap().places;
    for (a, b) in found.iter().zip(&turned) {
        let (a, b) = (a.unwrap(), b.unwrap());
        assert!((a.bend.mean + 2.0 * b.bend.mean).abs() < 1e-9);
        assert!((a.bend.gaussian - 4.0 * b.bend.gaussian).abs() < 1e-9);
        assert!((a.bend.principal[0].curvature + 2.0 * b.bend.principal[1].curvature).abs() < 1e-9);
        assert!(
            (2.0 * a.residual - b.residual).abs() < 1e-9 && (a.condition / b.condition - 1.0).abs() < 0.5
        );
    }
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            (
                super::mesh(&mesh, &options, &Silent).unwrap().places,
                cloud(&mesh.positions, &options, &Silent).unwrap().places,
            )
        })
    };
    assert_eq!(of(1), of(3));
}

#[test]
fn a_part_of_a_cloud_looks_outward_or_up() {
    let random = &mut Random::new(2);
    let mut points: Vec<Point> = vec![];
    // Two balls far apart, a wavy sheet seen from above, and a ring, around whose middle there is nothing.
    for center in [[0.0; 3], [100.0, 0.0, 0.0]] {
        for _ in 0..1500 {
            let d: Vector = std::array::from_fn(|_| normal(random));
            points.push(plus(center, times(5.0, unit(d).unwrap().0)));
        }
    }
    for k in 0..900 {
        let (x, y) = (f64::from(k % 30), f64::from(k / 30));
        points.push([x, y + 200.0, (0.3 * x).sin() + 40.0]);
    }
    let (ring, known) = whole_torus();
    points.extend(ring.positions.iter().map(|p| plus(*p, [0.0, -300.0, 0.0])));
    let found = cloud(&points, &Options::default(), &Silent).unwrap();
    assert_eq!(found.parts, 4);
    let mut without = 0;
    for (i, (place, p)) in found.places.iter().zip(&points).enumerate() {
        let Ok(jet) = place else {
            assert_eq!(*place, Err(NoCurvature::Boundary));
            without += 1;
            continue;
        };
        let out = match i {
            0..1500 => *p,
            1500..3000 => minus(*p, [100.0, 0.0, 0.0]),
            3000..3900 => [0.0, 0.0, 1.0],
            _ => known[i - 3900].1,
        };
        assert!(dot(jet.bend.normal, out) > 0.0, "{i}");
        if i < 3000 {
            assert!((jet.bend.mean + 0.2).abs() < 0.05, "{i}: {}", jet.bend.mean);
        }
    }
    // The rim of the sheet.
    assert!((100..=130).contains(&without), "{without}");
}

/// Copies tell nothing more: curvatures and uncertainties are those of each place once.
#[test]
fn copies_of_points_change_nothing() {
    let random = &mut Random::new(9);
    let mesh = patch(torus, [0.3, 0.2], 0.05, random);
    let noisy = |p: &Point| -> Point { std::array::from_fn(|k| p[k] + 0.01 * (random.unit() - 0.5)) };
    let once: Vec<Point> = mesh.positions.iter().map(noisy).collect();
    let often: Vec<Point> = (0..4 * once.len()).map(|i| once[i % once.len()]).collect();
    for reach in [Reach::Count(24), Reach::Radius(2.0)] {
        let options = Options { reach, ..Options::default() };
        let [alone, copied] = [&once, &often].map(|points| cloud(points, &options, &Silent).unwrap());
        assert_eq!(copied.parts, alone.parts);
        assert!(alone.places.iter().flatten().count() > 100);
        for (i, place) in copied.places.iter().enumerate() {
            let told = |place: &Result<Jet, NoCurvature>| {
                place.as_ref().map(|j| (j.bend.mean, j.uncertainty, j.neighbors)).map_err(|e| *e)
            };
            assert_eq!(told(place), told(&alone.places[i % once.len()]), "{i}");
        }
    }
}

#[test]
fn what_has_no_curvature_says_why() {
    let nan = f64::NAN;
    let (mut mesh, _) = whole(cylinder, 40, 12, |j| 0.15 * f64::from(j));
    mesh.positions.extend([[nan, 0.0, 0.0], [50.0, 0.0, 0.0]]);
    // A fin at an edge in the middle.
    let fin = mesh.positions.len() as u32;
    mesh.positions.push([30.0, 0.0, 10.0]);
    mesh.faces.push([6 * 40, 6 * 40 + 1, fin]);
    let found = super::mesh(&mesh, &Options::default(), &Silent).unwrap();
    let reason = |v: usize| found.places[v].err();
    assert_eq!(reason(3), Some(NoCurvature::Boundary));
    assert_eq!(reason(12 * 40 + 3), Some(NoCurvature::Boundary));
    assert_eq!(reason(13 * 40), Some(NoCurvature::NotFinite));
    assert_eq!(reason(13 * 40 + 1), Some(NoCurvature::Unused));
    assert_eq!(reason(6 * 40), Some(NoCurvature::NotASurface));
    assert!(found.places[5 * 40 + 20].is_ok());
    let with = Options { boundary: true, ..Options::default() };
    let all = super::mesh(&mesh, &with, &Silent).unwrap();
    let rim = all.places[20].unwrap().bend;
    assert!((rim.principal[1].curvature + 0.1).abs() < 0.02);
    // Facets that disagree.
    mesh.faces[3].swap(0, 1);
    let found = super::mesh(&mesh, &Options::default(), &Silent).unwrap();
    assert_eq!(found.places[mesh.faces[3][2] as usize], Err(NoCurvature::NotASurface));
    // Too small, and on a line.
    let small = Mesh {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    };
    let few = super::mesh(&small, &Options::default(), &Silent).unwrap();
    assert_eq!(few.places, vec![Err(NoCurvature::FewNeighbors); 4]);
    let line: Vec<Point> = (0..50).map(|k| times(f64::from(k), [1.0, 2.0, 0.5])).collect();
    let equal = vec![[1.0, 2.0, 3.0]; 50];
    // Equal points are one place, which has no neighbor.
    for (points, why) in [(line, NoCurvature::Undetermined), (equal, NoCurvature::FewNeighbors)] {
        let found = cloud(&points, &Options::default(), &Silent).unwrap();
        assert!(found.places.iter().all(|p| *p == Err(why)), "{:?}", found.places[0]);
        assert_eq!(found.parts, 0);
    }
    assert!(cloud(&[], &Options::default(), &Silent).unwrap().places.is_empty());
    let found = cloud(&[[nan; 3], [0.0; 3]], &Options::default(), &Silent).unwrap();
    assert_eq!(found.places, [Err(NoCurvature::NotFinite), Err(NoCurvature::FewNeighbors)]);
}

/// A plate thinner than the neighborhood: the other side is no neighbor on the mesh.
#[test]
fn the_other_side_of_a_thin_wall_is_far_away() {
    let side = |z: f64| (0..289u32).map(move |k| [f64::from(k % 17), f64::from(k / 17), z]);
    let mut faces = grid(16, 17, false);
    faces.extend(grid(16, 17, true).into_iter().map(|f| f.map(|v| v + 289)));
    let mesh = Mesh { positions: side(0.1).chain(side(0.0)).collect(), faces };
    let found =
        super::mesh(&mesh, &Options { reach: Reach::Radius(4.0), ..Options::default() }, &Silent).unwrap();
    let jet = found.places[MIDDLE].unwrap();
    assert!(jet.residual < 1e-12 && jet.bend.mean.abs() < 1e-12 && jet.bend.normal[2] > 0.99);
    assert_eq!(jet.neighbors, 48);
}

/// A disc of many facets around one vertex takes no time that grows with their square.
#[test]
fn a_hub_is_not_gone_through() {
    let n = 20_000u32;
    let rim = |k: u32| TAU * f64::from(k) / f64::from(n);
    let mut positions = vec![[0.0, 0.0, 0.1]];
    positions.extend((0..n).map(|k| [rim(k).cos(), rim(k).sin(), 0.0]));
    positions.extend((0..n).map(|k| [2.0 * rim(k).cos(), 2.0 * rim(k).sin(), -0.5]));
    let mut faces = vec![];
    for k in 0..n {
        let (a, b) = (1 + k, 1 + (k + 1) % n);
        faces.extend([[0, a, b], [a, a + n, b + n], [a, b + n, b]]);
    }
    let start = std::time::Instant::now();
    let found = super::mesh(&Mesh { positions, faces }, &Options::default(), &Silent).unwrap();
    assert!(start.elapsed().as_secs() < 20);
    assert_eq!(found.places[0].map(|j| j.neighbors).unwrap_or(n), n);
}

#[test]
fn wrong_options_and_cancelling() {
    let points = vec![[0.0; 3]; 3];
    let refused = |options: Options| cloud(&points, &options, &Silent).unwrap_err().to_string();
    let options = Options::default();
    assert_eq!(refused(Options { degree: 1, ..options }), "degree 1: it must be from 2 to 6");
    let few = refused(Options { reach: Reach::Count(9), ..options });
    assert_eq!(few, "neighbors 9: a jet of degree 3 needs from 10 to 10000");
    assert_eq!(
        refused(Options { reach: Reach::Radius(0.0), ..options }),
        "radius 0: it must be a length above 0"
    );
    struct Stopped;
    impl Progress for Stopped {
        fn cancelled(&self) -> bool {
            true
        }
    }
    let (mesh, _) = whole_torus();
    assert_eq!(super::mesh(&mesh, &options, &Stopped).unwrap_err(), CurvatureError::Cancelled(Cancelled));
    assert_eq!(cloud(&mesh.positions, &options, &Stopped).unwrap_err(), CurvatureError::Cancelled(Cancelled));
    let lost = Mesh { positions: points, faces: vec![[0, 1, 7]] };
    assert!(matches!(super::mesh(&lost, &options, &Silent), Err(CurvatureError::Mesh(_))));
}

//! Meshes in the plane: no facet turned over, unrollable surfaces are unrolled, and surfaces over them against closed
//! forms.

use super::super::{BaseKind, Layout, Options, SurfaceError, SurfaceFit, fit_mesh};
use super::triangle::Triangle;
use super::*;
use crate::NotADisc;
use std::f64::consts::PI;
use trueness_geom::num::random::Random;
use trueness_geom::progress::{Cancelled, Silent};
use trueness_geom::space::{Point, minus, norm};

/// Facets over a grid of places, without those whose middle is not kept.
fn sheet([m, n]: [u32; 2], place: impl Fn(f64, f64) -> Point, keep: impl Fn(f64, f64) -> bool) -> Mesh {
    let [x, y] = [m, n].map(f64::from);
    let all: Vec<Point> = (0..(m + 1) * (n + 1))
        .map(|k| place(f64::from(k % (m + 1)) / x, f64::from(k / (m + 1)) / y))
        .collect();
    let mut faces = vec![];
    for k in 0..m * n {
        let (i, j) = (k % m, k / m);
        if keep((f64::from(i) + 0.5) / x, (f64::from(j) + 0.5) / y) {
            let a = j * (m + 1) + i;
            // Diagonals by turns.
            let [b, c, d] = [a + 1, a + m + 2, a + m + 1];
            faces.extend(if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    used(all, faces)
}

/// The vertices that facets use.
fn used(all: Vec<Point>, mut faces: Vec<[u32; 3]>) -> Mesh {
    let mut number = vec![u32::MAX; all.len()];
    let mut positions = vec![];
    for v in faces.iter_mut().flatten() {
        if number[*v as usize] == u32::MAX {
            number[*v as usize] = positions.len() as u32;
            positions.push(all[*v as usize]);
        }
        *v = number[*v as usize];
    }
    Mesh { positions, faces }
}

fn pipe(degrees: f64, radius: f64, high: f64) -> impl Fn(f64, f64) -> Point {
    move |x, y| {
        let angle = degrees.to_radians() * x;
        [radius * angle.cos(), radius * angle.sin(), high * y]
    }
}

/// A cone from one ring to another, and its slanting length and angle when unrolled.
fn cone(degrees: f64, half: f64) -> impl Fn(f64, f64) -> Point {
    move |x, y| {
        let (angle, s) = (degrees.to_radians() * x, 20.0 + 30.0 * y);
        [s * half.sin() * angle.cos(), s * half.sin() * angle.sin(), -s * half.cos()]
    }
}

/// A cap of a sphere by equal areas, up to this angle from the pole; every vertex moved by `noise` along its radius.
fn cap(radius: f64, angle: f64, rings: u32, noise: f64, random: &mut Random) -> Mesh {
    let (mut positions, mut faces) = (vec![[0.0, 0.0, radius]], vec![]);
    let first = |ring: u32| if ring == 0 { 0 } else { 1 + 3 * ring * (ring - 1) };
    for ring in 1..=rings {
        let down = angle * f64::from(ring) / f64::from(rings);
        for k in 0..6 * ring {
            let turn = 2.0 * PI * f64::from(k) / f64::from(6 * ring);
            positions
                .push([down.sin() * turn.cos(), down.sin() * turn.sin(), down.cos()].map(|x| radius * x));
        }
        for k in 0..6 * ring {
            let (side, step) = (k / ring, k % ring);
            let inner = |step: u32| {
                if ring == 1 { 0 } else { first(ring - 1) + (side * (ring - 1) + step) % (6 * (ring - 1)) }
            };
            let outer = |k: u32| first(ring) + k % (6 * ring);
            faces.push([inner(step), outer(k), outer(k + 1)]);
            if step + 1 < ring {
                faces.push([inner(step), outer(k + 1), inner(step + 1)]);
            }
        }
    }
    for p in &mut positions {
        let by = 1.0 + noise * gauss(random) / radius;
        *p = p.map(|x| by * x);
    }
    Mesh { positions, faces }
}

fn gauss(random: &mut Random) -> f64 {
    (-2.0 * (1.0 - random.unit()).ln()).sqrt() * (2.0 * PI * random.unit()).cos()
}

/// The farthest that distances in the plane are from those given, of some pairs of vertices.
fn off(flat: &Flat, want: &dyn Fn(usize, usize) -> f64) -> f64 {
    let random = &mut Random::new(11);
    let n = flat.places.len();
    (0..2000).fold(0.0f64, |worst, _| {
        let [i, j] = [0, 1].map(|_| random.below(n as u64) as usize);
        let own = triangle::length([0, 1].map(|k| flat.places[i][k] - flat.places[j][k]));
        worst.max((own - want(i, j)).abs())
    })
}

/// Random meshes with random places: mean values turn no facet over, whatever the places.
#[test]
fn no_facet_turns_over_within_the_circle() {
    let random = &mut Random::new(3);
    for case in 0..300 {
        let [m, n] = [0, 1].map(|_| 2 + random.below(9) as u32);
        let size = [1.0, 0.1, 1e-4, 100.0][case % 4];
        let places: Vec<Point> = (0..(m + 1) * (n + 1))
            .map(|k| [f64::from(k % (m + 1)), f64::from(k / (m + 1)), 0.0])
            .map(|p| p.map(|x| x + size * (random.unit() - 0.5)))
            .collect();
        let at = |x: f64, y: f64| {
            places[((y * f64::from(n)).round() * f64::from(m + 1) + (x * f64::from(m)).round()) as usize]
        };
        // Holes at times.
        let kept: Vec<bool> = (0..m * n).map(|_| case % 3 > 0 || random.unit() > 0.15).collect();
        let keep =
            |x: f64, y: f64| kept[((y * f64::from(n)) as u32 * m + (x * f64::from(m)) as u32) as usize];
        let mesh = sheet([m, n], at, keep);
        let disc = match Disc::of(&mesh, &Silent) {
            Ok(disc) => disc,
            Err(SurfaceError::NotADisc(_)) if case % 3 == 0 => continue,
            Err(e) => panic!("{case}: {e}"),
        };
        let circle = mean_value::within_circle(&mesh.positions, &disc, 1.0, &Silent).unwrap();
        assert_eq!(turned_over(&disc, &circle), 0.0, "{case}");
        let triangle = |f: &[u32; 3]| Triangle::of(mesh.places(f));
        let triangles: Vec<Triangle> = disc.faces.iter().map(triangle).collect();
        let mut relaxed = circle.clone();
        relax::relax(&disc, &triangles, &mut relaxed, &Silent).unwrap();
        assert_eq!(turned_over(&disc, &relaxed), 0.0, "{case}");
        let flat = flatten(&mesh, &Silent).unwrap();
        assert_eq!((flat.folded_share, turned_over(&disc, &flat.places)), (0.0, 0.0), "{case}");
        // The whole has the area of its facets within the rims: none lies on another.
        let area = |line: &[u32]| {
            let around = line.iter().zip(line.iter().cycle().skip(1));
            0.5 * around
                .map(|(a, b)| triangle::cross(flat.places[*a as usize], flat.places[*b as usize]))
                .sum::<f64>()
        };
        let facets: f64 = disc.faces.iter().map(|f| area(f)).sum();
        let rims: f64 = disc.rims.iter().map(|r| area(r)).sum();
        assert!((facets - rims).abs() < 1e-9 * rims && facets > 0.0, "{case}: {facets} {rims}");
        assert!(!super::super::crossing::cross(&disc.rims, &flat.places), "{case}");
    }
}

/// Pipes, cones and sheets with any outline and holes are unrolled as they were rolled.
#[test]
fn what_was_rolled_is_unrolled() {
    let (radius, high) = (20.0, 50.0);
    let ell = |x: f64, y: f64| x < 0.4 || y < 0.3;
    let holed = |x: f64, y: f64| (x - 0.5).hypot(y - 0.5) > 0.2;
    let all = |_: f64, _: f64| true;
    let outlines: [&dyn Fn(f64, f64) -> bool; 3] = [&all, &ell, &holed];
    for (degrees, keep) in [120.0, 200.0, 300.0].iter().flat_map(|d| outlines.iter().map(move |k| (*d, k))) {
        let mesh = sheet([60, 30], pipe(degrees, radius, high), keep);
        let flat = flatten(&mesh, &Silent).unwrap();
        // Chords stand in for arcs.
        let chord = 2.0 * radius * (degrees.to_radians() / 120.0).sin() * 60.0;
        let own = |i: usize| {
            let p = mesh.positions[i];
            let angle = p[1].atan2(p[0]).rem_euclid(2.0 * PI) / degrees.to_radians();
            [chord * if angle > 1.1 { 0.0 } else { angle }, p[2]]
        };
        let off = off(&flat, &|i, j| triangle::length([0, 1].map(|k| own(i)[k] - own(j)[k])));

        assert!(off < 1e-3 * chord, "{degrees}: {off}");
        assert!(flat.stretch.iter().all(|s| (s - 1.0).abs() < 1e-3) && !flat.round, "{:?}", flat.stretch);
    }
    let half = 0.5f64;
    let mesh = sheet([90, 30], cone(300.0, half), all);
    let flat = flatten(&mesh, &Silent).unwrap();
    let own = |i: usize| {
        let p = mesh.positions[i];
        let s = norm(p);
        let turn = p[1].atan2(p[0]).rem_euclid(2.0 * PI);
        let angle = half.sin() * if turn > 5.3 { 0.0 } else { turn };
        [s * angle.cos(), s * angle.sin()]
    };
    let off = off(&flat, &|i, j| triangle::length([0, 1].map(|k| own(i)[k] - own(j)[k])));
    assert!(off < 0.05, "{off}");
}

fn over_mesh(mesh: &Mesh, spans: [usize; 2]) -> SurfaceFit {
    let options = Options { base: BaseKind::Mesh, layout: Layout::Spans(spans), ..Options::default() };
    fit_mesh(mesh, &options, &Silent).unwrap()
}

/// Pipes beyond half a turn, cones, and caps beyond a half sphere. The residuals are the noise, and distances from the
/// true surface are less than it.
#[test]
fn surfaces_over_meshes_keep_to_the_noise() {
    let random = &mut Random::new(21);
    let noise = 0.01;
    let mut noisy = |mesh: Mesh| {
        let positions = mesh.positions.iter().map(|p| p.map(|x| x + noise * gauss(random))).collect();
        Mesh { positions, faces: mesh.faces }
    };
    let all = |_: f64, _: f64| true;
    let from_axis = |p: Point| p[0].hypot(p[1]) - 20.0;
    let half = 0.5f64;
    let from_cone = |p: Point| p[0].hypot(p[1]) * half.cos() + p[2] * half.sin();
    let from_center = |p: Point| norm(p) - 20.0;
    type Case<'a> = (&'a str, Mesh, [usize; 2], &'a dyn Fn(Point) -> f64);
    let cases: [Case; 4] = [
        ("pipe", noisy(sheet([120, 50], pipe(300.0, 20.0, 50.0), all)), [16, 4], &from_axis),
        ("cone", noisy(sheet([150, 40], cone(300.0, half), all)), [14, 10], &from_cone),
        ("half sphere", noisy(cap(20.0, 0.5 * PI, 45, 0.0, &mut Random::new(1))), [10, 10], &from_center),
        ("more than half", noisy(cap(20.0, 0.7 * PI, 45, 0.0, &mut Random::new(1))), [14, 14], &from_center),
    ];
    for (name, mesh, spans, off) in cases {
        let found = over_mesh(&mesh, spans);
        let count = mesh.positions.len() as f64;
        let free = count - found.degrees_of_freedom.unwrap();
        let rms = (found.deviations.iter().map(|d| d * d).sum::<f64>() / free).sqrt();
        assert!(rms < 1.05 * noise, "{name}: {rms}");
        let true_off = found.feet.iter().map(|[u, v]| off(found.surface.at(*u, *v)).powi(2)).sum::<f64>();
        assert!((true_off / count).sqrt() < 0.6 * noise, "{name}: {}", (true_off / count).sqrt());
        assert_eq!((found.base.folded_share, found.base.round), (0.0, false), "{name}");
        // The normal looks as that of the facets.
        let [a, b, c] = mesh.faces[mesh.faces.len() / 2].map(|v| v as usize);
        let facet = trueness_geom::space::cross(
            minus(mesh.positions[b], mesh.positions[a]),
            minus(mesh.positions[c], mesh.positions[a]),
        );
        let own = found.surface.bend(found.feet[a][0], found.feet[a][1]).unwrap().normal;
        assert!(trueness_geom::space::dot(facet, own) > 0.9 * norm(facet), "{name}");
    }
}

/// A wide band that winds around an axis a little more than once has no place in the plane: it stays within the circle.
#[test]
fn what_would_lie_on_itself_stays_within_the_circle() {
    let band = |turns: f64| {
        move |x: f64, y: f64| {
            let angle = 2.0 * PI * turns * x;
            [(2.0 + 8.0 * y) * angle.cos(), (2.0 + 8.0 * y) * angle.sin(), 0.3 * angle]
        }
    };
    let flat = |turns: f64| flatten(&sheet([200, 20], band(turns), |_, _| true), &Silent).unwrap();
    let (less, more) = (flat(0.9), flat(1.2));
    assert!(!less.round && less.stretch[0] > 0.99 && less.stretch[1] < 1.01, "{:?}", less.stretch);
    assert!(more.round && more.folded_share == 0.0);
    assert!(more.stretch[0] < 0.5 && more.stretch[1] > 1.5, "{:?}", more.stretch);
}

#[test]
fn what_is_no_disc_is_refused() {
    let all = |_: f64, _: f64| true;
    let refused = |mesh: &Mesh| match flatten(mesh, &Silent) {
        Err(SurfaceError::NotADisc(why)) => why,
        other => panic!("{:?}", other.map(|_| ())),
    };
    let flat = sheet([4, 4], |x, y| [x, y, 0.0], all);
    assert_eq!(refused(&Mesh::default()), NotADisc::Empty);
    // Two parts, one of them moved.
    let mut two = flat.clone();
    two.positions.extend(flat.positions.iter().map(|p| [p[0] + 5.0, p[1], p[2]]));
    two.faces.extend(flat.faces.iter().map(|f| f.map(|v| v + 25)));
    assert_eq!(refused(&two), NotADisc::Parts { parts: 2 });
    let mut turned = flat.clone();
    turned.faces[0].swap(0, 1);
    assert!(matches!(refused(&turned), NotADisc::Turned { edges: 2.. }));
    let mut fin = flat.clone();
    fin.positions.push([0.3, 0.3, 1.0]);
    fin.faces.push([6, 7, 25]);
    assert!(matches!(refused(&fin), NotADisc::NotManifold { .. }));
    let mut loose = flat.clone();
    loose.positions.push([9.0, 9.0, 9.0]);
    assert_eq!(refused(&loose), NotADisc::Unused { count: 1, first: 25 });
    let closed = trueness_geom::samples::block(2, 1.0);
    assert_eq!(refused(&closed), NotADisc::Closed);
    // A ring bent into itself, and cut open at one cell: a torus with a hole.
    let (m, n) = (24, 12);
    let torus = |k: u32| {
        let (u, v) = (2.0 * PI * f64::from(k % m) / f64::from(m), 2.0 * PI * f64::from(k / m) / f64::from(n));
        [(10.0 + 3.0 * v.cos()) * u.cos(), (10.0 + 3.0 * v.cos()) * u.sin(), 3.0 * v.sin()]
    };
    let at = |i: u32, j: u32| (j % n) * m + i % m;
    let cells = (1..m * n).map(|k| (k % m, k / m));
    let faces = cells
        .flat_map(|(i, j)| {
            [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
        })
        .collect();
    assert_eq!(
        refused(&Mesh { positions: (0..m * n).map(torus).collect(), faces }),
        NotADisc::Handles { handles: 1 }
    );
    struct Stopped;
    impl Progress for Stopped {
        fn cancelled(&self) -> bool {
            true
        }
    }
    let cancelled = flatten(&flat, &Stopped);
    assert!(matches!(cancelled, Err(SurfaceError::Cancelled(Cancelled))));
}

/// Facets without an area, of a sheet whose rows were pushed onto each other, and vertices at one place.
#[test]
fn degenerate_facets_are_laid_flat_too() {
    let pushed = |x: f64, y: f64| [10.0 * x, 10.0 * if y > 0.3 && y < 0.7 { 0.5 } else { y }, 0.0];
    let flat = flatten(&sheet([12, 12], pushed, |_, _| true), &Silent).unwrap();
    assert!(flat.places.iter().flatten().all(|x| x.is_finite()) && flat.folded_share == 0.0);
    let heap = flatten(&sheet([5, 5], |_, _| [1.0; 3], |_, _| true), &Silent).unwrap();
    assert!(heap.places.iter().flatten().all(|x| x.is_finite()));
}

#[test]
fn triangles_are_laid_with_their_sides() {
    let random = &mut Random::new(2);
    for _ in 0..1000 {
        let corners: [Point; 3] = std::array::from_fn(|_| std::array::from_fn(|_| random.unit()));
        let flat = Triangle::of(corners);
        for k in 0..3 {
            let want = norm(minus(corners[k], corners[(k + 1) % 3]));
            assert!((triangle::length(flat.edge(k, (k + 1) % 3)) - want).abs() < 1e-2 * want);
        }
        assert!(flat.doubled_area() > 0.0);
        let onto = std::array::from_fn(|_| [random.unit(), random.unit()]);
        if flat.doubled_area() < 0.1 {
            continue;
        }
        let [least, most] = flat.stretch(onto);
        // Product and greatest image of a unit vector.
        let area = Triangle(onto).doubled_area() / flat.doubled_area();
        assert!((least * most - area).abs() < 1e-9 * (1.0 + most * most), "{least} {most} {area}");
        let (a, b) = (flat.edge(0, 1), flat.edge(0, 2));
        let (c, d) = (Triangle(onto).edge(0, 1), Triangle(onto).edge(0, 2));
        let grown = (0..1000).map(|k| (f64::from(k) * PI / 1000.0).sin_cos()).map(|(s, t)| {
            let x: [f64; 2] = [0, 1].map(|k| s * a[k] + t * b[k]);
            let y: [f64; 2] = [0, 1].map(|k| s * c[k] + t * d[k]);
            triangle::length(y) / triangle::length(x)
        });
        let greatest = grown.fold(0.0, f64::max);
        assert!(greatest <= most * (1.0 + 1e-9) && greatest > 0.9 * most, "{greatest} {most}");
    }
}

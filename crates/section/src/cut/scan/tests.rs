use super::*;
use crate::{Contour, Geometry, Options, SegmentKind, chain_contour, cut};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::plane::Plane;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Point, norm};

/// A band of so many columns and rows of vertices, jittered, with diagonals, closed around where it is asked for.
/// `place` tells where a column and row lie.
fn band(
    columns: usize,
    rows: usize,
    closed: bool,
    jitter: f64,
    random: &mut Random,
    place: impl Fn(f64, f64) -> Point,
) -> Mesh {
    let mut mesh = Mesh::default();
    for j in 0..rows {
        for i in 0..columns {
            let mut off = || jitter * (random.unit() - 0.5);
            let (a, b) = (i as f64 + 0.5 * (j % 2) as f64 + off(), j as f64 + off());
            mesh.positions.push(place(a, b));
        }
    }
    let at = |i: usize, j: usize| (j * columns + i % columns) as u32;
    for j in 0..rows - 1 {
        for i in 0..columns - usize::from(!closed) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
            match j % 2 {
                0 => mesh.faces.extend([[a, b, c], [b, d, c]]),
                _ => mesh.faces.extend([[a, b, d], [a, d, c]]),
            }
        }
    }
    mesh
}

/// The mesh with independent noise of its vertices along these directions, averaged over as many rings; of this deviation in the end.
fn noisy(
    mesh: &Mesh,
    rings: usize,
    sigma: f64,
    random: &mut Random,
    along: impl Fn(&Point) -> Point,
) -> Mesh {
    let plain = CutMesh::new(mesh, None);
    let mut off: Vec<f64> =
        mesh.positions.iter().map(|_| (0..12).map(|_| random.unit()).sum::<f64>() - 6.0).collect();
    for _ in 0..rings {
        off = (0..off.len() as u32)
            .map(|v| {
                let all = plain.neighbors_of(v).iter().chain([&v]);
                let (sum, n) = all.fold((0.0, 0.0), |(sum, n), w| (sum + off[*w as usize], n + 1.0));
                sum / n
            })
            .collect();
    }
    let rms = (off.iter().map(|x| x * x).sum::<f64>() / off.len() as f64).sqrt();
    let moved = |(p, x): (&Point, &f64)| {
        let n = along(p);
        [0, 1, 2].map(|k| p[k] + sigma * x / rms * n[k])
    };
    Mesh { positions: mesh.positions.iter().zip(&off).map(moved).collect(), faces: mesh.faces.clone() }
}

fn level(height: f64) -> (Plane, PlaneFrame) {
    let plane = Plane { normal: [0.0, 0.0, 1.0], offset: height };
    (plane, plane.frame().unwrap())
}

/// Crossings of surfaces whose sections are known lie on these, next to all of the way from the chords.
#[test]
fn crossings_lie_on_the_surface() {
    let random = &mut Random::new(5);
    let around = |a: f64, n: f64| libm::sincos(std::f64::consts::TAU * a / n);
    // Upright cylinder, sphere cut off its middle, cone, and a slanted cylinder: a place by column and height, and how far off a place is.
    type Body<'a> = (&'a str, Box<dyn Fn(f64, f64) -> Point>, Box<dyn Fn([f64; 2]) -> f64>);
    let r = 9.0;
    let of_circle = |radius: f64| move |p: [f64; 2]| libm::hypot(p[0], p[1]) - radius;
    // Its wall ends at a face that goes on outwards or inwards, a facet or some above the plane.
    let wall = |top: f64, sense: f64| -> Box<dyn Fn(f64, f64) -> Point> {
        Box::new(move |a, z| {
            let ((s, c), beyond) = (around(a, 56.0), (z - 5.0 - top).max(0.0));
            let r = r + sense * beyond;
            [r * c, r * s, (z - 5.0).min(top)]
        })
    };
    let bodies: Vec<Body> = vec![
        (
            "cylinder",
            Box::new(move |a, z| {
                let (s, c) = around(a, 56.0);
                [r * c, r * s, z - 5.0]
            }),
            Box::new(of_circle(r)),
        ),
        (
            "sphere",
            Box::new(move |a, z| {
                let ((s, c), (up, out)) = (around(a, 56.0), libm::sincos((z - 2.0) / r));
                [r * out * c, r * out * s, r * up]
            }),
            Box::new(of_circle((r * r - 0.01_f64).sqrt())),
        ),
        (
            "slanted cylinder",
            Box::new(move |a, z| {
                let (s, c) = around(a, 56.0);
                let z = z - 5.0;
                [r * c + 0.4 * z, r * s, z]
            }),
            Box::new(move |p| libm::hypot(p[0] - 0.04, p[1]) - r),
        ),
        ("bore 1.6 beneath a face", wall(1.7, 1.0), Box::new(of_circle(r))),
        ("bore 2.2 beneath a face", wall(2.3, 1.0), Box::new(of_circle(r))),
        ("bore 2.8 beneath a face", wall(2.9, 1.0), Box::new(of_circle(r))),
        ("shaft 1.6 beneath a face", wall(1.7, -1.0), Box::new(of_circle(r))),
        ("shaft 2.2 beneath a face", wall(2.3, -1.0), Box::new(of_circle(r))),
    ];
    for (name, place, off) in bodies {
        let mesh = band(56, 12, true, 0.5, random, place);
        let (plane, frame) = level(0.1);
        let chain = &cut(&mesh, &plane, &Silent).unwrap()[0];
        let row = ScanRow::of(&CutMesh::new(&mesh, None), chain, &frame, true);
        assert_eq!(row.kept.len(), chain.points.len(), "{name}");
        let far = |all: &mut dyn Iterator<Item = [f64; 2]>| all.map(|p| off(p).abs()).fold(0.0, f64::max);
        let before = far(&mut chain.points.iter().map(|p| frame.flat(*p)));
        let after = far(&mut row.points.iter().copied());
        println!("{name}: {before} {after}");
        assert!(before > 5e-3 && after < 0.08 * before, "{name}: {before} {after}");
    }
}

/// The weights of crossings say how far their mean is uncertain: of independent noise, and of noise that neighbors share.
#[test]
fn weights_tell_how_uncertain_the_mean_is() {
    let random = &mut Random::new(8);
    let flat = band(200, 40, false, 0.5, random, |a, z| [a, 0.0, z - 20.0]);
    let (plane, frame) = level(0.1);
    for rings in [0, 1, 2] {
        let (mut squares, mut stated, count) = (0.0, 0.0, 300);
        let first = noisy(&flat, rings, 0.01, random, |_| [0.0, 1.0, 0.0]);
        let noise = trueness_geom::noise::mesh(&first, 0, &Silent).unwrap();
        for _ in 0..count {
            let mesh = noisy(&flat, rings, 0.01, random, |_| [0.0, 1.0, 0.0]);
            let chain = &cut(&mesh, &plane, &Silent).unwrap()[0];
            let row = ScanRow::of(&CutMesh::new(&mesh, Some(noise)), chain, &frame, false);
            let whole: f64 = row.weights.iter().sum();
            let mean = row.points.iter().zip(&row.weights).map(|(p, w)| w * p[1]).sum::<f64>() / whole;
            squares += mean * mean / f64::from(count);
            stated += row.noise.unwrap().deviation.powi(2) / whole / f64::from(count);
        }
        let ratio = (squares / stated).sqrt();
        println!("{rings} rings: {ratio}");
        assert!((0.85..1.2).contains(&ratio), "{rings} rings: {ratio}");
    }
}

/// Flat places without noise tell that a mesh has none, whatever its patches tell; noise of ten roundings leaves none of them.
#[test]
fn flats_tell_that_there_is_no_noise() {
    let random = &mut Random::new(12);
    // A sheet of waves half, and flat half.
    let wave = |a: f64| if a < 100.0 { 3.0 * libm::sin(a / 2.0) } else { 0.0 };
    let sheet = band(200, 40, false, 0.5, random, |a, z| [a, wave(a), z - 20.0]);
    let noise_and_form = |mesh: &Mesh| {
        let noise = trueness_geom::noise::mesh(mesh, 0, &Silent).ok();
        let cut = CutMesh::new(mesh, noise);
        (cut.scatters, cut.free_form)
    };
    assert_eq!(noise_and_form(&sheet), (false, None));
    let rounding = CutMesh::new(&sheet, None).rounding();
    let (scatters, _) = noise_and_form(&noisy(&sheet, 0, 10.0 * rounding, random, |_| [0.0, 1.0, 0.0]));
    assert!(scatters);
    // Waves of some facets each, all over, are a free form.
    let body = band(200, 40, false, 0.5, random, |a, z| {
        let swell = (0.1 + libm::sin(a / 50.0).powi(2)) * (0.1 + libm::sin(z / 15.0).powi(2));
        [a, 2.0 * swell * libm::sin(a / 2.0 + 0.3 * z) * libm::sin(z / 2.0), z - 20.0]
    });
    println!("{:?}", trueness_geom::noise::mesh(&body, 0, &Silent));
    let (_, form) = noise_and_form(&body);
    assert!(form.is_some_and(|form| form > 0.1), "{form:?}");
}

fn radius_of(mesh: &Mesh, plane: &Plane) -> (f64, f64, Contour) {
    let noise = trueness_geom::noise::mesh(mesh, 0, &Silent).ok();
    let chain = &cut(mesh, plane, &Silent).unwrap()[0];
    let options = Options::default();
    let found =
        chain_contour(chain, &plane.frame().unwrap(), &CutMesh::new(mesh, noise), &options, &Silent).unwrap();
    let [segment] = &found.segments[..] else { panic!("{:?}", found.segments) };
    let Geometry::Arc { radius, .. } = segment.geometry else { panic!("{:?}", segment) };
    let Some(crate::Uncertainty::Arc { radius: stated, .. }) = segment.uncertainty else {
        panic!("{segment:?}")
    };
    (radius, stated, found)
}

/// A bore whose noise neighbors share is one circle, with its radius within the stated uncertainty. It is the same from
/// the other side and for facets in any order.
#[test]
fn bores_of_scans_are_circles_from_either_side() {
    let random = &mut Random::new(2);
    let (mut inside, count) = (0, 40);
    for k in 0..count {
        let (r, rings) = (6.0 + 10.0 * random.unit(), k % 4);
        let columns = (std::f64::consts::TAU * r / 0.5) as usize;
        let even = band(columns, 24, true, 0.5, random, |a, z| {
            let (s, c) = libm::sincos(std::f64::consts::TAU * a / columns as f64);
            [r * c, r * s, 0.45 * (z - 12.0)]
        });
        let out = |p: &Point| {
            let length = norm([p[0], p[1], 0.0]);
            [p[0] / length, p[1] / length, 0.0]
        };
        let mesh = noisy(&even, rings, 0.008, random, out);
        let plane = Plane { normal: [0.0, 0.0, 1.0], offset: 0.13 };
        let (radius, stated, found) = radius_of(&mesh, &plane);
        assert!(found.unreliable.is_empty() && found.closed, "{k}");
        inside += usize::from((radius - r).abs() <= 1.96 * stated);
        let back = Plane { normal: [0.0, 0.0, -1.0], offset: -0.13 };
        let mut shuffled = mesh.clone();
        let order = random.choose(mesh.faces.len(), mesh.faces.len());
        shuffled.faces = order.into_iter().map(|i| mesh.faces[i]).collect();
        for other in [radius_of(&mesh, &back).0, radius_of(&shuffled, &plane).0] {
            assert!((other - radius).abs() < 1e-3 * stated, "{k}: {other} {radius} ± {stated}");
        }
    }
    println!("{inside} of {count} within 1.96 standard uncertainties");
    assert!(inside >= 34, "{inside}");
}

/// The contour of a noisy part is the same from either side of the plane, and for facets in any order: kinds, joins, places.
#[test]
fn contours_are_the_same_from_either_side_and_in_any_order() {
    let random = &mut Random::new(14);
    // A rounded triangle: three lines, three arcs.
    let (columns, r) = (240, 6.0);
    let corners = [[0.0, 0.0], [34.0, 3.0], [11.0, 29.0]];
    let side = |k: usize| {
        let (a, b): ([f64; 2], [f64; 2]) = (corners[k % 3], corners[(k + 1) % 3]);
        let long = libm::hypot(b[0] - a[0], b[1] - a[1]);
        (a, [(b[0] - a[0]) / long, (b[1] - a[1]) / long], long)
    };
    let turn = |k: usize| {
        let (u, v) = (side(k).1, side(k + 1).1);
        libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
    };
    let whole: f64 = (0..3).map(|k| side(k).2 + r * turn(k)).sum();
    let way = |s: f64| {
        let mut left = s.rem_euclid(whole);
        for k in 0..3 {
            let (a, u, long) = side(k);
            let out = [u[1], -u[0]];
            if left <= long {
                return ([0, 1].map(|i| a[i] + left * u[i] + r * out[i]), out);
            }
            left -= long;
            if left <= r * turn(k) {
                let (sin, cos) = libm::sincos(left / r);
                let out = [out[0] * cos - out[1] * sin, out[0] * sin + out[1] * cos];
                return ([0, 1].map(|i| corners[(k + 1) % 3][i] + r * out[i]), out);
            }
            left -= r * turn(k);
        }
        (corners[0], [0.0, -1.0])
    };
    for rings in 0..4 {
        let at = |a: f64| way(a * whole / columns as f64);
        let even = band(columns, 20, true, 0.5, random, |a, z| {
            let ([x, y], _) = at(a);
            [x, y, 0.5 * (z - 10.0)]
        });
        // The part holds the places no farther than the radius from the triangle.
        let out = |p: &Point| {
            let from = |k: usize| {
                let (a, u, long) = side(k);
                let s = ((p[0] - a[0]) * u[0] + (p[1] - a[1]) * u[1]).clamp(0.0, long);
                [p[0] - a[0] - s * u[0], p[1] - a[1] - s * u[1], 0.0]
            };
            let way = (0..3).map(from).min_by(|a, b| norm(*a).total_cmp(&norm(*b))).unwrap_or_default();
            way.map(|x| x / r)
        };
        let mesh = noisy(&even, rings, 0.006, random, out);
        assert_eq!(same_from_everywhere(&mesh, random), 6, "{rings}");
    }
    // A free form, whose curve has its knots where the row begins.
    let body = band(columns, 40, true, 0.5, random, |a, z| {
        let t = std::f64::consts::TAU * a / columns as f64;
        let swell = (0.1 + libm::sin(2.0 * t).powi(2)) * (0.1 + libm::sin(z / 15.0).powi(2));
        let (s, c) = libm::sincos(t);
        let r = 38.0 + 2.0 * swell * libm::sin(40.0 * t + 0.3 * z) * libm::sin(z / 2.0);
        [r * c, r * s, z - 20.0]
    });
    assert_eq!(same_from_everywhere(&body, random), 1);
}

/// The number of segments of a contour, which is the same from either side of the plane and for facets in any order.
fn same_from_everywhere(mesh: &Mesh, random: &mut Random) -> usize {
    let noise = trueness_geom::noise::mesh(mesh, 0, &Silent).ok();
    let of = |mesh: &Mesh, normal: f64| {
        let plane = Plane { normal: [0.0, 0.0, normal], offset: 0.13 * normal };
        let chain = &cut(mesh, &plane, &Silent).unwrap()[0];
        let frame = plane.frame().unwrap();
        let found =
            chain_contour(chain, &frame, &CutMesh::new(mesh, noise), &Options::default(), &Silent).unwrap();
        holds_the_numbers(&found, chain.points.len());
        let mut joins: Vec<Point> = found.joins.iter().map(|j| frame.place(j.point)).collect();
        joins.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut kinds: Vec<_> = found.segments.iter().map(|s| s.geometry.kind()).collect();
        kinds.sort();
        (kinds, joins, found.length(), found.rms())
    };
    let own = of(mesh, 1.0);
    let mut shuffled = mesh.clone();
    let order = random.choose(mesh.faces.len(), mesh.faces.len());
    shuffled.faces = order.into_iter().map(|i| mesh.faces[i]).collect();
    for other in [of(mesh, -1.0), of(&shuffled, 1.0), of(&shuffled, -1.0)] {
        assert_eq!(other.0, own.0);
        assert!((other.2 - own.2).abs() < 1e-8, "{} {}", other.2, own.2);
        assert!((other.3 - own.3).abs() < 1e-9, "{} {}", other.3, own.3);
        for (a, b) in own.1.iter().zip(&other.1) {
            assert!(norm([0, 1, 2].map(|k| a[k] - b[k])) < 1e-6, "{a:?} {b:?}");
        }
    }
    own.0.len()
}

/// Lists of points have as many entries, name points that there are, and go along the contour.
fn holds_the_numbers(found: &Contour, count: usize) {
    assert!(found.labels.len() == count && found.residuals.len() == count && found.stations.len() == count);
    for list in [&found.outliers, &found.bevels, &found.repeated, &found.gaps] {
        assert!(list.iter().all(|i| *i < count) && list.is_sorted());
    }
    // Stations rise around the contour but for one step back over its start.
    let back = found.stations.windows(2).filter(|w| w[1] < w[0] - 0.5 * found.spacing).count();
    assert!(back <= 1, "{back}");
    // The places lie as far off the segments they belong to as they are told to.
    let n = count;
    for (i, p) in found.moved.iter().enumerate().filter(|(i, _)| found.bevels.binary_search(i).is_err()) {
        // The order of the row stands: a place behind the point before has its foot beside that.
        if [(i + n - 1) % n, (i + 1) % n].iter().any(|j| found.stations[*j] == found.stations[i]) {
            continue;
        }
        let off = found.segments[found.labels[i] as usize].foot(*p).1;
        assert!((off.abs() - found.residuals[i].abs()).abs() < 1e-6, "{i}: {off} {}", found.residuals[i]);
    }
}

/// Corners that no edge of the mesh runs along are corners, with no segment for the facets that pass them by.
#[test]
fn bevels_of_the_mesh_are_no_segments() {
    let random = &mut Random::new(4);
    let corners = [[0.0, 0.0], [31.3, 0.0], [31.3, 19.7], [0.0, 19.7]];
    let way = |s: f64| {
        let mut left = s;
        for k in 0..4 {
            let (a, b): ([f64; 2], [f64; 2]) = (corners[k], corners[(k + 1) % 4]);
            let long = libm::hypot(b[0] - a[0], b[1] - a[1]);
            if left <= long {
                return [0, 1].map(|i| a[i] + left / long * (b[i] - a[i]));
            }
            left -= long;
        }
        corners[0]
    };
    for sigma in [0.0, 0.004] {
        for rings in 0..3 {
            let columns = 163;
            let even = band(columns, 20, true, 0.5, random, |a, z| {
                let [x, y] = way((a * 102.0 / columns as f64).rem_euclid(102.0));
                [x, y, 0.6 * (z - 10.0)]
            });
            let out = |p: &Point| match (p[0], p[1]) {
                (0.0, _) => [-1.0, 0.0, 0.0],
                (31.3, _) => [1.0, 0.0, 0.0],
                (_, 0.0) => [0.0, -1.0, 0.0],
                _ => [0.0, 1.0, 0.0],
            };
            let mesh = noisy(&even, rings, sigma, random, out);
            let (plane, frame) = level(0.1);
            let noise = trueness_geom::noise::mesh(&mesh, 0, &Silent).ok();
            let chain = &cut(&mesh, &plane, &Silent).unwrap()[0];
            let found =
                chain_contour(chain, &frame, &CutMesh::new(&mesh, noise), &Options::default(), &Silent)
                    .unwrap();
            assert!(found.segments.iter().all(|s| s.geometry.kind() == SegmentKind::Line), "{sigma} {rings}");
            let lengths: Vec<f64> = found.segments.iter().map(|s| s.length).collect();
            assert_eq!((found.segments.len(), found.unreliable.len()), (4, 0), "{sigma} {rings} {lengths:?}");
            for join in &found.joins {
                let off = |c: &[f64; 2]| libm::hypot(c[0] - join.point[0], c[1] - join.point[1]);
                let nearest = corners.iter().map(off).fold(f64::INFINITY, f64::min);
                assert!(nearest <= 4.0 * join.uncertainty + 1e-6, "{nearest} {}", join.uncertainty);
            }
        }
    }
}

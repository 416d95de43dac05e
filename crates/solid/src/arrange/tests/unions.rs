//! Unions whose volume is known, and the bodies that they leave alone.

use super::*;
use std::f64::consts::PI;
use trueness_geom::rigid::Rigid;
use trueness_geom::samples::block;

/// Boxes at whole numbers, outwards or inwards: places are counted cube by cube. Faces, edges and corners fall upon each other.
#[test]
fn heaps_of_boxes_are_counted_cube_by_cube() {
    let random = &mut Random::new(3);
    for round in 0..150 {
        let mut mesh = Mesh::default();
        let size = 4 + round % 4;
        let mut winding = vec![0; (size * size * size) as usize];
        for _ in 0..2 + random.below(8) {
            let low = [(); 3].map(|()| random.below(size));
            let high = low.map(|x| x + 1 + random.below(size - x));
            let mut one = Mesh::default();
            add_box(&mut one, low.map(|x| x as f64), high.map(|x| x as f64));
            let inverted = random.below(3) == 0;
            let first = mesh.positions.len() as u32;
            let one = if inverted { turned(one) } else { one };
            mesh.positions.extend(one.positions);
            mesh.faces.extend(one.faces.iter().map(|f| f.map(|v| v + first)));
            for (i, w) in winding.iter_mut().enumerate() {
                let i = i as u64;
                let cube = [i % size, i / size % size, i / size / size];
                if (0..3).all(|k| low[k] <= cube[k] && cube[k] < high[k]) {
                    *w += if inverted { -1 } else { 1 };
                }
            }
        }
        let expected = winding.iter().filter(|w| **w > 0).count() as f64;
        let b = union(&mesh, &Options { turn: false, ..Options::default() });
        assert!((volume(&b.mesh) - expected).abs() < 1e-9, "{round}: {} {expected}", volume(&b.mesh));
        // Turned over, it is the same for who trusts the larger part only where all is negative.
        if winding.iter().all(|w| *w <= 0) {
            let b = union(&mesh, &Options::default());
            let expected = winding.iter().filter(|w| **w < 0).count() as f64;
            assert!((volume(&b.mesh) - expected).abs() < 1e-9, "{round}");
        }
    }
}

/// A star prism of `n` corners, each joined with the `k`-th next: one shell that crosses itself, and winds around its middle
/// `k` times.
fn star(n: u32, k: u32) -> Mesh {
    let mut mesh = Mesh { positions: vec![[0.0; 3], [0.0, 0.0, 1.0]], faces: vec![] };
    for i in 0..n {
        let (s, c) = (
            libm::sin(2.0 * PI * f64::from(i) / f64::from(n)),
            libm::cos(2.0 * PI * f64::from(i) / f64::from(n)),
        );
        mesh.positions.extend([[c, s, 0.0], [c, s, 1.0]]);
    }
    for i in 0..n {
        let (a, b) = (2 + 2 * i, 2 + 2 * ((i + k) % n));
        mesh.faces.extend([[0, b, a], [1, a + 1, b + 1], [a, b, b + 1], [a, b + 1, a + 1]]);
    }
    mesh
}

#[test]
fn a_shell_that_crosses_itself_keeps_its_outline() {
    for (n, k) in [(5, 2), (7, 3), (11, 3), (13, 6), (20, 7)] {
        let (angle, steps) = (PI / f64::from(n), f64::from(k));
        let inner = libm::cos(steps * angle) / libm::cos((steps - 1.0) * angle);
        let expected = f64::from(n) * inner * libm::sin(angle);
        let found = volume(&union(&star(n, k), &Options::default()).mesh);
        assert!((found - expected).abs() < 1e-12, "{n} {k}: {found} {expected}");
        let single = Mesh {
            positions: star(n, k).positions.iter().map(|p| p.map(|x| f64::from(x as f32))).collect(),
            ..star(n, k)
        };
        let found = volume(&union(&single, &Options { single: true, ..Options::default() }).mesh);
        assert!((found - expected).abs() < 1e-6, "{n} {k}: {found} {expected}");
    }
}

/// Twenty square rings, each hooked into the next so deep that they cross.
#[test]
fn a_chain_of_twenty_rings() {
    let mut mesh = Mesh::default();
    let mut filled = std::collections::BTreeSet::new();
    for i in 0..20i32 {
        // A frame of 6 by 4, one thick, flat or upright, as four bars that overlap at the corners.
        let (x, flat) = (4 * i, i % 2 == 0);
        for [a, b] in [[[0, 0], [6, 1]], [[0, 3], [6, 4]], [[0, 0], [1, 4]], [[5, 0], [6, 4]]] {
            let place = |[u, v]: [i32; 2], w: i32| if flat { [x + u, v, w + 1] } else { [x + u, w + 1, v] };
            let (low, high) = (place(a, 0), place(b, 1));
            add_box(&mut mesh, low.map(f64::from), high.map(f64::from));
            for x in low[0]..high[0] {
                for y in low[1]..high[1] {
                    filled.extend((low[2]..high[2]).map(|z| [x, y, z]));
                }
            }
        }
    }
    let b = union(&mesh, &Options::default());
    assert_eq!(volume(&b.mesh), filled.len() as f64);
}

/// A flat ribbon, one wide and one thick, along a path on a grid. It crosses itself, runs upon itself for some squares,
/// and beside itself for others. One closed shell, all of whose overlaps are coplanar.
#[test]
fn a_ribbon_that_overlaps_itself() {
    let path: [[i32; 2]; 10] =
        [[0, 0], [9, 0], [9, 6], [3, 6], [3, -4], [6, -4], [6, 3], [1, 3], [1, 0], [7, 0]];
    let mut mesh = Mesh::default();
    let way = |i: usize| -> [i32; 2] { std::array::from_fn(|k| (path[i + 1][k] - path[i][k]).signum()) };
    for (i, p) in path.iter().enumerate() {
        let last = path.len() - 1;
        let (before, after) = (way(i.saturating_sub(1)), way(i.min(last - 1)));
        // Left of the way, mitred; half a square beyond both ends.
        let left = |d: [i32; 2]| [-d[1], d[0]];
        let (a, b) = (left(before), left(after));
        let aside: [f64; 2] = std::array::from_fn(|k| match before == after {
            true => 0.5 * f64::from(a[k]),
            false => 0.5 * f64::from(a[k] + b[k]),
        });
        let beyond = if i == 0 {
            -0.5
        } else if i == last {
            0.5
        } else {
            0.0
        };
        for side in [1.0, -1.0] {
            let at = |k: usize| f64::from(p[k]) + side * aside[k] + beyond * f64::from(after[k]);
            mesh.positions.extend([[at(0), at(1), 0.0], [at(0), at(1), 1.0]]);
        }
    }
    let mut quad = |a: u32, b: u32, c: u32, d: u32| mesh.faces.extend([[a, b, c], [a, c, d]]);
    let count = path.len() as u32;
    // Node i has 4 i left below, + 1 left above, + 2 right below, + 3 right above.
    for i in 0..count - 1 {
        let (n, m) = (4 * i, 4 * (i + 1));
        quad(n + 1, n + 3, m + 3, m + 1);
        quad(n, m, m + 2, n + 2);
        quad(n, n + 1, m + 1, m);
        quad(n + 2, m + 2, m + 3, n + 3);
    }
    let end = 4 * (count - 1);
    quad(0, 2, 3, 1);
    quad(end, end + 1, end + 3, end + 2);
    let mut squares = std::collections::BTreeSet::new();
    for (i, p) in path.iter().enumerate().take(path.len() - 1) {
        let steps = (path[i + 1][0] - p[0]).abs() + (path[i + 1][1] - p[1]).abs();
        squares.extend((0..=steps).map(|t| [p[0] + t * way(i)[0], p[1] + t * way(i)[1]]));
    }
    let b = union(&mesh, &Options::default());
    assert_eq!(volume(&b.mesh), squares.len() as f64);
}

#[test]
fn three_planes_through_one_point() {
    let mut mesh = Mesh::default();
    for k in 0..3 {
        let (mut low, mut high) = ([-1.0; 3], [2.0; 3]);
        (low[k], high[k]) = (0.0, 1.0);
        add_box(&mut mesh, low, high);
    }
    assert_eq!(volume(&union(&mesh, &Options::default()).mesh), 27.0 - 9.0 + 1.0);
    // Turned about an axis that is none of the coordinate axes, nothing has a finite binary fraction.
    let (s, c) = (libm::sin(0.3), libm::cos(0.3));
    mesh.positions.iter_mut().for_each(|p| {
        *p = [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]];
        *p = [p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]];
    });
    assert!(near(volume(&union(&mesh, &Options::default()).mesh), 19.0));
}

/// Faces one step of the numbers apart: before, behind, and tilted by it.
#[test]
fn faces_one_step_apart() {
    let next = 1.0f64.next_up();
    for (low, volume_of_both, shells) in [(1.0f64.next_down(), 2.0, 1), (1.0, 2.0, 1), (next, 2.0, 2)] {
        let mut mesh = Mesh::default();
        add_box(&mut mesh, [0.0; 3], [1.0; 3]);
        add_box(&mut mesh, [low, 0.0, 0.0], [2.0, 1.0, 1.0]);
        let b = union(&mesh, &Options::default());
        assert!(near(volume(&b.mesh), volume_of_both), "{low}");
        assert_eq!(Topology::of(&b.mesh).unwrap().shells, shells, "{low}");
    }
    for single in [false, true] {
        let step = if single { f64::from(f32::EPSILON) } else { f64::EPSILON };
        for corner in 0..8 {
            let mut mesh = Mesh::default();
            add_box(&mut mesh, [0.0; 3], [1.0; 3]);
            add_box(&mut mesh, [0.0; 3], [1.0; 3]);
            // One corner of the second box is off by one step in one coordinate.
            mesh.positions[8 + corner][corner % 3] += step;
            let b = union(&mesh, &Options { single, ..Options::default() });
            assert!((volume(&b.mesh) - 1.0).abs() < 2.0 * step, "{corner}");
        }
    }
}

#[test]
fn what_nothing_touches_stays_as_it_is() {
    let mut mesh = block(6, 2.0);
    let far = mesh.positions.iter().map(|p| p.map(|x| x + 1.5)).collect::<Vec<_>>();
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(far);
    let again: Vec<[u32; 3]> = mesh.faces.iter().map(|f| f.map(|v| v + first)).collect();
    mesh.faces.extend(again);
    let b = union(&mesh, &Options::default());
    assert!(near(volume(&b.mesh), 16.0 - 0.125));
    let topology = Topology::of(&mesh).unwrap();
    let pairs = intersect::self_intersections(&mesh, &topology, &Silent).unwrap();
    let inside = |f: &u32| {
        let m: Point = std::array::from_fn(|k| {
            mesh.faces[*f as usize].iter().map(|v| mesh.positions[*v as usize][k]).sum::<f64>() / 3.0
        });
        let within = |low: f64| m.iter().all(|x| low < *x && *x < low + 2.0);
        if *f < mesh.faces.len() as u32 / 2 { within(1.5) } else { within(0.0) }
    };
    let touched: std::collections::BTreeSet<u32> = pairs.iter().flatten().copied().collect();
    let free: Vec<u32> =
        (0..mesh.faces.len() as u32).filter(|f| !touched.contains(f) && !inside(f)).collect();
    assert_eq!(b.source[..free.len()], free[..]);
    for (f, face) in free.iter().zip(&b.mesh.faces) {
        assert_eq!(mesh.faces[*f as usize], *face);
    }
}

/// Material in material vanishes, a cavity stays, and a body that is inside out as a whole is turned.
#[test]
fn nested_shells() {
    let nested = |outer: bool, inner: bool| {
        let mut mesh = Mesh::default();
        add_box(&mut mesh, [0.0; 3], [4.0; 3]);
        let mut small = Mesh::default();
        add_box(&mut small, [1.0; 3], [2.0; 3]);
        let (mesh, small) =
            (if outer { turned(mesh) } else { mesh }, if inner { turned(small) } else { small });
        let positions = [mesh.positions, small.positions].concat();
        let faces = mesh.faces.into_iter().chain(small.faces.iter().map(|f| f.map(|v| v + 8))).collect();
        Mesh { positions, faces }
    };
    for (outer, inner, expected) in
        [(false, false, 64.0), (false, true, 63.0), (true, true, 64.0), (true, false, 63.0)]
    {
        let b = union(&nested(outer, inner), &Options::default());
        assert_eq!(volume(&b.mesh), expected, "{outer} {inner}");
    }
    // Not turned, nothing of it is material, but where a shell winds around in the positive sense.
    let empty =
        outer_boundary(&nested(true, true), &Options { turn: false, single: false }, &Silent).unwrap();
    assert_eq!(empty.mesh.faces.len(), 0);
}

/// Figure-eight immersion of the Klein bottle: no side is the outer one.
#[test]
fn a_surface_with_one_side_has_no_outside() {
    let (n, m) = (24u32, 12u32);
    let mut mesh = Mesh::default();
    for i in 0..n {
        for j in 0..m {
            let (u, v) = (2.0 * PI * f64::from(i) / f64::from(n), 2.0 * PI * f64::from(j) / f64::from(m));
            let w = 2.0 + libm::cos(u / 2.0) * libm::sin(v) - libm::sin(u / 2.0) * libm::sin(2.0 * v);
            let z = libm::sin(u / 2.0) * libm::sin(v) + libm::cos(u / 2.0) * libm::sin(2.0 * v);
            mesh.positions.push([w * libm::cos(u), w * libm::sin(u), z]);
        }
    }
    for i in 0..n {
        for j in 0..m {
            // The last ring is joined with the first, the other way round.
            let at = |i: u32, j: u32| if i < n { i * m + j % m } else { (m - j % m) % m };
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            mesh.faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    let refused = outer_boundary(&mesh, &Options::default(), &Silent);
    assert!(matches!(refused, Err(ArrangeError::Open { .. })), "{refused:?}");
    assert!(arrange(&mesh, &Silent).unwrap().mesh.faces.len() > mesh.faces.len());
    let open = Mesh { faces: vec![[0, 1, 2]], positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] };
    assert!(matches!(outer_boundary(&open, &Options::default(), &Silent), Err(ArrangeError::Open { .. })));
}

/// Long triangles in all directions: more pairs than would ever be wanted.
#[test]
fn a_tangle_is_given_up() {
    let random = &mut Random::new(9);
    let mut mesh = Mesh::default();
    for i in 0..4000 {
        mesh.positions.extend([(); 3].map(|()| [(); 3].map(|()| random.unit())));
        mesh.faces.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    assert!(matches!(arrange(&mesh, &Silent), Err(ArrangeError::Tangle { .. })));
    let empty = Mesh::default();
    assert_eq!(outer_boundary(&empty, &Options::default(), &Silent).unwrap().mesh, empty);
}

/// Decisions and results do not depend on the scale, to the ends of the range.
#[test]
fn unions_at_the_ends_of_the_range_are_the_same_and_beyond_are_refused() {
    let random = &mut Random::new(5);
    let mut mesh = Mesh::default();
    for _ in 0..6 {
        let low: Point = std::array::from_fn(|_| 2.0 * random.unit());
        add_box(&mut mesh, low, low.map(|x| x + 1.0 + random.unit()));
    }
    let turn = Rigid::rotation_about([0.0; 3], [0.3, 0.5, 0.7]);
    mesh.positions.iter_mut().for_each(|p| *p = turn.point(*p));
    let plain = union(&mesh, &Options::default());
    for (power, fits) in [(147, true), (150, false), (-160, true), (-171, false), (500, false)] {
        let scale = 2f64.powi(power);
        let scaled = |mesh: &Mesh| {
            let positions = mesh.positions.iter().map(|p| p.map(|x| x * scale)).collect();
            Mesh { positions, faces: mesh.faces.clone() }
        };
        match outer_boundary(&scaled(&mesh), &Options::default(), &Silent) {
            Ok(b) => assert!(fits && b.mesh == scaled(&plain.mesh), "2^{power}"),
            Err(e) => assert!(!fits && matches!(e, ArrangeError::Range { .. }), "2^{power}: {e}"),
        }
        assert_eq!(arrange(&scaled(&mesh), &Silent).is_ok(), fits, "2^{power}");
    }
}

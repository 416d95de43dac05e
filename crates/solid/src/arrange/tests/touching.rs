//! Bodies that touch in faces, edges and vertices, turned at random: their corners are rounded, so nothing lies in one plane.

use super::*;
use std::f64::consts::TAU;
use trueness_geom::rigid::Rigid;

/// A polygon that runs counter-clockwise, as a prism from one height to another.
fn prism(mesh: &mut Mesh, polygon: &[[f64; 2]], low: f64, high: f64) {
    let (first, n) = (mesh.positions.len() as u32, polygon.len() as u32);
    for z in [low, high] {
        mesh.positions.extend(polygon.iter().map(|[x, y]| [*x, *y, z]));
    }
    let mut add = |face: [u32; 3]| mesh.faces.push(face.map(|v| v + first));
    for i in 0..n {
        let j = (i + 1) % n;
        add([i, j, n + j]);
        add([i, n + j, n + i]);
    }
    for i in 1..n - 1 {
        add([0, i + 1, i]);
        add([n, n + i, n + i + 1]);
    }
}

fn rectangle([x, y]: [f64; 2], [u, v]: [f64; 2]) -> [[f64; 2]; 4] {
    [[x, y], [u, y], [u, v], [x, v]]
}

/// A regular polygon, and its area.
fn regular(n: u32, radius: f64, [x, y]: [f64; 2]) -> (Vec<[f64; 2]>, f64) {
    let corner = |i: u32| {
        let turn = TAU * f64::from(i) / f64::from(n);
        [x + radius * libm::cos(turn), y + radius * libm::sin(turn)]
    };
    let area = 0.5 * f64::from(n) * radius * radius * libm::sin(TAU / f64::from(n));
    ((0..n).map(corner).collect(), area)
}

/// A plate between two such polygons, with a hole.
fn ring(mesh: &mut Mesh, inner: &[[f64; 2]], outer: &[[f64; 2]], low: f64, high: f64) {
    let (first, n) = (mesh.positions.len() as u32, inner.len() as u32);
    for (polygon, z) in [(inner, low), (outer, low), (inner, high), (outer, high)] {
        mesh.positions.extend(polygon.iter().map(|[x, y]| [*x, *y, z]));
    }
    let mut add = |corners: [u32; 4]| {
        let [a, b, c, d] = corners.map(|v| v + first);
        mesh.faces.extend([[a, b, c], [a, c, d]]);
    };
    for i in 0..n {
        let j = (i + 1) % n;
        add([n + i, i, j, n + j]);
        add([2 * n + i, 3 * n + i, 3 * n + j, 2 * n + j]);
        add([n + i, n + j, 3 * n + j, 3 * n + i]);
        add([i, 2 * n + i, 2 * n + j, j]);
    }
}

/// Bodies that touch without having any material in common, or that have faces in common, and the volume of their union.
pub(crate) fn touching(random: &mut Random) -> Vec<(&'static str, Mesh, f64)> {
    let mut all = vec![];
    let mut add = |name, volume: f64, build: &dyn Fn(&mut Mesh)| {
        let mut mesh = Mesh { positions: vec![], faces: vec![] };
        build(&mut mesh);
        all.push((name, mesh, volume));
    };
    let (n, r) = (5 + random.below(40) as u32, 2.0 + random.unit());
    let (round, area) = regular(n, r, [random.unit(), random.unit()]);
    let block = rectangle([-9.0, -8.0], [10.0, 11.0]);
    add("a cylinder on a block", 361.0 * 3.0 + 4.0 * area, &|m| {
        prism(m, &block, 0.0, 3.0);
        prism(m, &round, 3.0, 7.0);
    });
    let (wide, wide_area) = regular(3 + random.below(30) as u32, 6.0, [0.0; 2]);
    add("a cylinder on another", wide_area + 2.0 * area, &|m| {
        prism(m, &wide, 0.0, 1.0);
        prism(m, &round, 1.0, 3.0);
    });
    let (outer, outer_area) = regular(n, 8.0, [0.0; 2]);
    let long = if random.unit() < 0.5 { 0.0 } else { 2.0 };
    add("a pin in a hole", 3.0 * outer_area + long * area, &|m| {
        ring(m, &round, &outer, 0.0, 3.0);
        prism(m, &round, -long, 3.0);
    });
    add("bricks", 27.0, &|m| {
        for i in 0..27 {
            let [x, y, z] = [i % 3, i / 3 % 3, i / 9].map(f64::from);
            let (x, y) = (x + 0.3 * z, y + 0.2 * z);
            prism(m, &rectangle([x, y], [x + 1.0, y + 1.0]), z, z + 1.0);
        }
    });
    add("a flush cross", 36.0, &|m| {
        prism(m, &rectangle([0.0, 0.0], [10.0, 2.0]), 0.0, 1.0);
        prism(m, &rectangle([4.0, -4.0], [6.0, 6.0]), 0.0, 1.0);
    });
    add("a block in the face of another", 500.0, &|m| {
        prism(m, &rectangle([0.0, 0.0], [10.0, 10.0]), 0.0, 5.0);
        prism(m, &rectangle([2.0, 3.0], [7.0, 6.0]), 2.0, 5.0);
    });
    add("cubes that touch in edges", 4.0, &|m| {
        for ([x, y], z) in [([0.0, 0.0], 0.0), ([1.0, 1.0], 0.0), ([1.0, 0.0], 1.0), ([2.0, 2.0], 1.0)] {
            prism(m, &rectangle([x, y], [x + 1.0, y + 1.0]), z, z + 1.0);
        }
    });
    // They have corners in common, and nothing crosses but for rounding.
    add("a slab of four cubes", 4.0, &|m| {
        for (x, z) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            // The diagonals of faces that touch run across each other.
            let mut square = rectangle([x, 0.0], [x + 1.0, 1.0]);
            square.rotate_left(z as usize);
            prism(m, &square, z, z + 1.0);
        }
    });
    add("two boxes upon a cube", 2.0, &|m| {
        prism(m, &rectangle([0.0, 0.0], [1.0, 1.0]), 0.0, 1.0);
        prism(m, &rectangle([0.0, 0.0], [0.5, 1.0]), 1.0, 2.0);
        prism(m, &rectangle([0.5, 0.0], [1.0, 1.0]), 1.0, 2.0);
    });
    add("a pyramid on its tip", 361.0 + area, &|m| {
        prism(m, &block, 0.0, 1.0);
        let first = m.positions.len() as u32;
        m.positions.push([round[0][0], round[0][1], 1.0]);
        m.positions.extend(round.iter().map(|[x, y]| [*x, *y, 4.0]));
        m.faces.extend((0..n).map(|i| [0, 1 + (i + 1) % n, 1 + i].map(|v| v + first)));
        m.faces.extend((1..n - 1).map(|i| [1, 1 + i, 2 + i].map(|v| v + first)));
    });
    all
}

/// A cone over or under a fan around the origin, which has `n` facets.
fn cone(mesh: &mut Mesh, n: u32, (radius, turn): (f64, f64), tip: f64) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([[0.0, 0.0, tip], [0.0; 3]]);
    for i in 0..n {
        let angle = TAU * (f64::from(i) + turn) / f64::from(n);
        mesh.positions.push([radius * libm::cos(angle), radius * libm::sin(angle), 0.0]);
    }
    for (i, j) in (0..n).map(|i| (2 + i, 2 + (i + 1) % n)) {
        for [a, b, c] in [[0, i, j], [1, j, i]] {
            mesh.faces.push(if tip > 0.0 { [a, b, c] } else { [a, c, b] }.map(|v| v + first));
        }
    }
}

/// A rotation about any place.
pub(crate) fn rotation(random: &mut Random) -> Rigid {
    let mut any = || 6.0 * random.unit() - 3.0;
    Rigid::rotation_about([any(), any(), any()], [any(), any(), any()])
}

/// Bodies that touch become one or stay in touch, wherever they are turned to: in double and in single precision.
#[test]
fn bodies_that_touch_become_their_union_however_they_are_turned() {
    let random = &mut Random::new(41);
    for _ in 0..6 {
        let turn = rotation(random);
        for (name, mut mesh, volume_of_all) in touching(random) {
            mesh.positions.iter_mut().for_each(|p| *p = turn.point(*p));
            let got = volume(&union(&mesh, &Options::default()).mesh);
            assert!(
                (got - volume_of_all).abs() < 1e-12 * volume_of_all,
                "{name}: {got}, not {volume_of_all}"
            );
            mesh.positions.iter_mut().flatten().for_each(|x| *x = f64::from(*x as f32));
            let got = volume(&union(&mesh, &Options { single: true, ..Options::default() }).mesh);
            assert!((got - volume_of_all).abs() < 1e-5 * volume_of_all, "{name}: {got}, not {volume_of_all}");
        }
    }
}

/// A copy that lies a step of the numbers beside the original is the same body.
#[test]
fn a_copy_a_step_away_vanishes() {
    let random = &mut Random::new(5);
    let (round, area) = regular(24, 5.0, [0.1, 0.2]);
    let mut mesh = Mesh { positions: vec![], faces: vec![] };
    prism(&mut mesh, &round, 0.3, 4.3);
    let mut copy = mesh.clone();
    for x in copy.positions.iter_mut().flatten() {
        *x = [x.next_down(), *x, x.next_up()][random.below(3) as usize];
    }
    let first = mesh.positions.len() as u32;
    mesh.positions.append(&mut copy.positions);
    mesh.faces.extend(copy.faces.iter().map(|f| f.map(|v| v + first)));
    let union = union(&mesh, &Options::default());
    assert!(near(volume(&union.mesh), 4.0 * area));
    assert_eq!(union.mesh.faces.len(), copy.faces.len());
}

/// Cones base to base, turned and rounded: two fans of thousands of facets upon each other. The pairs of facets whose boxes meet are many
/// times as many as are found at once.
#[test]
fn fans_of_thousands_of_facets_that_touch_are_united() {
    let turn = rotation(&mut Random::new(6));
    for n in [60, 2500] {
        let mut mesh = Mesh { positions: vec![], faces: vec![] };
        cone(&mut mesh, n, (10.0, 0.0), 10.0);
        cone(&mut mesh, n, (8.0, 0.35), -10.0);
        mesh.positions.iter_mut().for_each(|p| *p = turn.point(*p).map(|x| f64::from(x as f32)));
        let got = volume(&union(&mesh, &Options { single: true, ..Options::default() }).mesh);
        let base = 0.5 * f64::from(n) * libm::sin(TAU / f64::from(n));
        let want = base * (100.0 + 64.0) * 10.0 / 3.0;
        assert!((got - want).abs() < 1e-5 * want, "{n}: {got}, not {want}");
    }
}

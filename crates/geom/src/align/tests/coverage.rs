//! How often the stated uncertainty holds the true pose.

use super::parts::{block, bracket, normal};
use crate::align::{Alignment, BestFit, Measured, Start, Target, best_fit};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, cross, dot, minus, plus, times, unit};

/// Views of each part, and scans from each.
const VIEWS: usize = 40;
const TRIALS: usize = 4;

/// Places on the facets that look along `view`, every so many of area, with white noise in all directions or waves.
fn view(mesh: &Mesh, view: Vector, count: usize, noise: f64, wave: f64, random: &mut Random) -> Vec<Point> {
    let corner = |f: &[u32; 3]| mesh.places(f);
    let double = |f: &[u32; 3]| {
        let [a, b, c] = corner(f);
        cross(minus(b, a), minus(c, a))
    };
    let seen: Vec<&[u32; 3]> =
        mesh.faces.iter().filter(|f| unit(double(f)).is_some_and(|n| dot(n.0, view) > 0.1)).collect();
    let area = |f: &&&[u32; 3]| dot(double(f), view);
    let total: f64 = seen.iter().map(|f| area(&f)).sum();
    let phase: f64 = 6.0 * random.unit();
    let mut points = vec![];
    let mut left = 0.0;
    for f in &seen {
        left += count as f64 * area(&f) / total;
        let [a, b, c] = corner(f);
        let n = unit(double(f)).map_or([0.0; 3], |n| n.0);
        while left >= 1.0 {
            left -= 1.0;
            let (root, t) = (random.unit().sqrt(), random.unit());
            let p = plus(plus(times(1.0 - root, a), times(root * (1.0 - t), b)), times(root * t, c));
            let form = wave * libm::sin(phase + 0.9 * p[0] + 0.7 * p[1] + 0.8 * p[2]);
            let off: Vector = std::array::from_fn(|k| noise * normal(random) + form * n[k]);
            points.push(plus(p, off));
        }
    }
    points
}

fn errors(found: &Alignment) -> [f64; 6] {
    let pose = found.reference_from_measured;
    let r = pose.rotation();
    let turn = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]].map(|x| 0.5 * x);
    let shift = minus(pose.point(found.center), found.center);
    std::array::from_fn(|k| {
        let e = if k < 3 { turn[k] } else { shift[k - 3] };
        e / found.covariance[k][k].sqrt()
    })
}

/// Share of errors within 1.96 standard uncertainties, and the mean of their squares.
fn held(
    part: &Mesh,
    looks: Vector,
    [count, trials]: [usize; 2],
    noise: f64,
    wave: f64,
    random: &mut Random,
) -> [f64; 2] {
    let tree = Tree::build(part).unwrap();
    let target = Target::new(part, &tree);
    let (mut within, mut squares) = (0, 0.0);
    for _ in 0..trials {
        let points = view(part, looks, count, noise, wave, random);
        let options = BestFit { start: Start::From(Rigid::IDENTITY), ..BestFit::default() };
        let found =
            best_fit(&Measured::Points { points: &points, normals: None }, &target, &options, &Silent)
                .unwrap();
        for e in errors(&found) {
            within += usize::from(e.abs() <= 1.96);
            squares += e * e;
        }
    }
    [within as f64, squares].map(|x| x / (6 * trials) as f64)
}

/// Views from any side, of noise and of waves of form: the block is held at its rims by few points in some of them.
#[test]
fn views_of_one_side_hold_what_they_say() {
    let random = &mut Random::new(8);
    let block = block([0.0; 3], [60.0, 40.0, 15.0], 60.0);
    let mut shares = vec![];
    for (name, part, wave) in
        [("block", &block, 0.0), ("bracket", &bracket(200.0), 0.0), ("block", &block, 0.01)]
    {
        let (mut all, mut squares) = (0.0, 0.0);
        for _ in 0..VIEWS {
            let looks = std::array::from_fn(|_| normal(random));
            let share = held(part, unit(looks).unwrap().0, [1000, TRIALS], 0.01, wave, random);
            all += share[0] / VIEWS as f64;
            squares += share[1] / VIEWS as f64;
        }
        shares.push((name, wave, all, squares));
    }
    assert!(shares.iter().all(|share| share.2 > 0.93), "{shares:?}");
    // The views that hold least: three faces, one of them seen flat.
    let share = held(&block, unit([0.6, 0.5, 0.6]).unwrap().0, [2000, 40], 0.01, 0.0, random);
    assert!(share[0] > 0.92, "{share:?}");
}

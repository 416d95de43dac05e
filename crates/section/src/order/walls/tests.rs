//! Rates over random thin walls and single contours: parted in two right faces, told, or wrong without a word.

use super::super::ways::order;
use crate::model::flat::distance;
use std::f64::consts::TAU;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.unit()
}

fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// Corners of an outline at the offset `d` outward of a closed polygon, or to the left of an open one.
fn offset(corners: &[[f64; 2]], closed: bool, d: f64) -> Vec<[f64; 2]> {
    let n = corners.len();
    let normal = |i: usize, j: usize| {
        let (a, b) = (corners[i], corners[j]);
        let l = distance(a, b);
        [(b[1] - a[1]) / l, (a[0] - b[0]) / l]
    };
    (0..n)
        .map(|k| {
            let before = if k > 0 { Some(normal(k - 1, k)) } else { closed.then(|| normal(n - 1, 0)) };
            let after = if k + 1 < n { Some(normal(k, k + 1)) } else { closed.then(|| normal(n - 1, 0)) };
            let (u, v) = (before.or(after).unwrap_or([0.0; 2]), after.or(before).unwrap_or([0.0; 2]));
            let s = d / (1.0 + u[0] * v[0] + u[1] * v[1]);
            [corners[k][0] + s * (u[0] + v[0]), corners[k][1] + s * (u[1] + v[1])]
        })
        .collect()
}

/// Points along a polygon, `step` apart in the mean, at random.
fn along(corners: &[[f64; 2]], closed: bool, step: f64, random: &mut Random) -> Vec<[f64; 2]> {
    let n = corners.len();
    let sides = if closed { n } else { n - 1 };
    let mut all = vec![];
    for k in 0..sides {
        let (a, b) = (corners[k], corners[(k + 1) % n]);
        let count = (distance(a, b) / step).round().max(2.0) as usize;
        for i in 0..count {
            let s = (i as f64 + random.unit()) / count as f64;
            all.push([a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])]);
        }
    }
    all
}

/// Points with their face (0 or 1), the wall's thickness at its thinnest and thickest, the noise, and whether faces are closed.
pub(super) struct Made {
    pub points: Vec<([f64; 2], usize)>,
    pub walls: [f64; 2],
    pub noise: f64,
    pub spacing: f64,
    pub closed: bool,
    pub kind: usize,
}

/// A wall between 0.3 and 5 spacings thick, or one up to 30 that scatters across many points of its faces.
pub(super) fn wall(seed: u64, dense: bool) -> Made {
    let random = &mut Random::stream(31, seed);
    let spacing = 0.1;
    let [low, high] = if dense { [0.7, 1.5] } else { [-0.52, 0.7] };
    let wall = spacing * libm::pow(10.0, between(random, low, high));
    let noise = wall * between(random, 0.01, 0.12);
    let noise = if dense { noise } else { noise.min(0.3 * spacing) };
    let kind = random.below(5) as usize;
    let (w, h) = (between(random, 8.0, 25.0), between(random, 8.0, 25.0));
    let (mid, closed): (Vec<[f64; 2]>, bool) = match kind {
        0 => (
            (0..240)
                .map(|i| libm::sincos(TAU * f64::from(i) / 240.0))
                .map(|(s, c)| [0.4 * w * c, 0.4 * w * s])
                .collect(),
            true,
        ),
        1 | 4 => (vec![[-w, 0.0], [w, 0.0]], false),
        2 => (vec![[0.0, h], [0.0, 0.0], [w, 0.0]], false),
        _ => (vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]], true),
    };
    let density = [1.0, between(random, 1.0, 3.0)];
    let mut points = vec![];
    for face in 0..2 {
        let d = wall * (face as f64 - 0.5);
        let corners = offset(&mid, closed, d);
        let corners = if kind == 4 { vec![[-w, 0.15 * d], [w, d]] } else { corners };
        for p in along(&corners, closed, spacing * density[face], random) {
            points.push(([p[0] + noise * normal(random), p[1] + noise * normal(random)], face));
        }
    }
    let turn = libm::sincos(TAU * random.unit());
    for (p, _) in &mut points {
        *p = [p[0] * turn.1 - p[1] * turn.0, p[0] * turn.0 + p[1] * turn.1];
    }
    (1..points.len()).rev().for_each(|i| points.swap(i, random.below(i as u64 + 1) as usize));
    let walls = if kind == 4 { [0.15 * wall, wall] } else { [wall; 2] };
    Made { points, walls, noise, spacing, closed, kind }
}

/// How the rows of a wall are. Right are two rows, each of one face but for points that noise hides. Else they are reported, or each of one face but in pieces, or none of these.
pub(super) fn judged(made: &Made) -> (usize, String) {
    let flat: Vec<[f64; 2]> = made.points.iter().map(|p| p.0).collect();
    let found = order(&flat, None, &Silent).unwrap();
    let reported = found.rows.iter().any(|r| r.layered.is_some());
    let pure = |r: &super::super::ways::Ordered| {
        let of = r.numbers.iter().filter(|i| made.points[**i].1 == 1).count();
        of.min(r.numbers.len() - of) as f64 / r.numbers.len() as f64
    };
    let all = |face: usize| made.points.iter().filter(|p| p.1 == face).count() as f64;
    let most = |r: &super::super::ways::Ordered| {
        r.numbers.len() as f64
            > 0.85
                * all(usize::from(
                    2 * r.numbers.iter().filter(|i| made.points[**i].1 == 1).count() > r.numbers.len(),
                ))
    };
    let (faces, rest) = found.rows.split_at(found.rows.len().min(2));
    let right = faces.len() == 2
        && faces.iter().all(|r| pure(r) < 0.03 && r.closed == made.closed && most(r))
        && rest.iter().map(|r| r.numbers.len()).sum::<usize>() * 20 < flat.len();
    let show: Vec<String> = found
        .rows
        .iter()
        .map(|r| format!("{}{} {:.2}", r.numbers.len(), if r.closed { "c" } else { "o" }, pure(r)))
        .collect();
    let pieces = found.rows.iter().all(|r| pure(r) < 0.06);
    (
        if right {
            0
        } else if reported {
            1
        } else if pieces {
            2
        } else {
            3
        },
        format!(
            "kind {} wall {:.3} noise {:.4} {}: {}",
            made.kind,
            made.walls[1] / made.spacing,
            made.noise / made.walls[1],
            reported,
            show.join(", ")
        ),
    )
}

#[test]
fn faces_of_thin_walls_are_parted_or_told() {
    let [right, reported, pieces, wrong] = rates(40, false);
    assert!(wrong == 0 && right > 32, "{right} {reported} {pieces} {wrong}");
}

/// Windows of walls that are thick for how near points lie grow with the scatter of the faces.
#[test]
fn faces_of_dense_walls_are_parted_or_told() {
    let [right, reported, pieces, wrong] = rates(40, true);
    assert!(wrong == 0 && right > 32, "{right} {reported} {pieces} {wrong}");
}

fn rates(walls: u64, dense: bool) -> [usize; 4] {
    let mut counts = [0; 4];
    for seed in 0..walls {
        let made = wall(seed, dense);
        let (k, text) = judged(&made);
        counts[k] += 1;
        if k > 0 {
            println!("{seed} {k} {text}");
        }
    }
    counts
}

/// One face, whatever its scatter, and teeth and waves are no wall.
#[test]
fn one_face_is_no_wall() {
    let mut doubted = 0;
    for seed in 0..40 {
        let random = &mut Random::stream(32, seed);
        let (n, kind, step) = (300 + random.below(900) as usize, random.below(4), 0.1);
        let noise = step * between(random, 0.01, 3.0);
        let even = random.below(2) == 0;
        let mut points: Vec<[f64; 2]> = (0..n)
            .map(|i| {
                let s = (i as f64 + random.unit()) * step;
                let off = noise * if even { 3.4 * (random.unit() - 0.5) } else { normal(random) };
                let radius = n as f64 * step / TAU;
                let (sin, cos) = libm::sincos(s / radius);
                match kind {
                    0 => [(radius + off) * cos, (radius + off) * sin],
                    1 => [s, off],
                    2 => [s, 3.0 * libm::sin(0.4 * s) + 0.3 * off],
                    _ => [s, if (s / 2.0).fract() < 0.5 { 0.0 } else { 0.6 } + 0.02 * off],
                }
            })
            .collect();
        (1..points.len()).rev().for_each(|i| points.swap(i, random.below(i as u64 + 1) as usize));
        let found = order(&points, None, &Silent).unwrap();
        let bad = found.rows.iter().any(|r| r.layered.is_some()) || kind < 2 && found.rows.len() > 1;
        if bad {
            let show: Vec<usize> = found.rows.iter().map(|r| r.numbers.len()).collect();
            println!(
                "{seed} kind {kind} noise {:.2} even {even} n {n}: {show:?} {:?}",
                noise / step,
                found.rows[0].layered
            );
        }
        doubted += usize::from(bad);
    }
    assert_eq!(doubted, 0);
}

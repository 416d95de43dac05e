//! Rates over random profiles: their trailing edge and their chord.

use super::tail;
use crate::model::flat::distance;
use std::f64::consts::{PI, TAU};
use trueness_geom::num::random::Random;

/// A profile with the right answers for it.
pub(crate) struct Made {
    pub points: Vec<[f64; 2]>,
    pub chord: f64,
    /// Thickness of the edge; 0 of a sharp one.
    pub edge: f64,
    pub kind: &'static str,
    pub noise: f64,
}

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.unit()
}

fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// Height and slope of the camber line: of four digits, or of five with their first 2.
fn camber(x: f64, m: f64, p: f64, five: bool) -> [f64; 2] {
    if five {
        let (k, m) = (15.957 * m / 0.02, 0.2025);
        return match x < m {
            true => [
                k / 6.0 * (x * x * (x - 3.0 * m) + m * m * (3.0 - m) * x),
                k / 6.0 * (3.0 * x * x - 6.0 * m * x + m * m * (3.0 - m)),
            ],
            false => [k / 6.0 * m * m * m * (1.0 - x), -k / 6.0 * m * m * m],
        };
    }
    match x < p {
        true => [m / (p * p) * x * (2.0 * p - x), 2.0 * m / (p * p) * (p - x)],
        false => [
            m / (1.0 - p).powi(2) * (1.0 - 2.0 * p + x * (2.0 * p - x)),
            2.0 * m / (1.0 - p).powi(2) * (p - x),
        ],
    }
}

/// A profile of random thickness, camber, edge, size, place, direction and first point.
pub(crate) fn made(seed: u64) -> Made {
    let random = &mut Random::stream(21, seed);
    let (t, m, p, five) = (
        between(random, 0.06, 0.24),
        between(random, 0.0, 0.12),
        between(random, 0.3, 0.6),
        random.below(3) == 0,
    );
    let m = if random.below(3) == 0 {
        0.0
    } else if five {
        0.5 * m
    } else {
        m
    };
    let each = (15.0 * libm::pow(200.0 / 15.0, random.unit())) as usize;
    let cosine = random.below(2) == 0;
    let kind = ["sharp", "blunt", "open", "round"][random.below(4) as usize];
    let edge = if kind == "sharp" { 0.0 } else { between(random, 0.005, (0.5 * t).min(0.06)) };
    let half = |x: f64| {
        5.0 * t * (0.2969 * x.sqrt() + x * (-0.126 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))))
            + 0.5 * edge * x
    };
    let last = if kind == "round" { 1.0 - 0.5 * edge } else { 1.0 };
    let side = |k: usize, sign: f64| {
        let u = k as f64 / each as f64;
        let x = last * if cosine { 0.5 * (1.0 - libm::cos(PI * u)) } else { u };
        let [y, slope] = camber(x, m, p, five);
        let (s, c) = libm::sincos(libm::atan(slope));
        [x - sign * half(x) * s, y + sign * half(x) * c]
    };
    let mut all: Vec<[f64; 2]> =
        (0..=each).rev().map(|k| side(k, 1.0)).chain((1..=each).map(|k| side(k, -1.0))).collect();
    let (upper, lower) = (all[0], all[all.len() - 1]);
    let middle = [0.5 * (upper[0] + lower[0]), 0.5 * (upper[1] + lower[1])];
    let on_edge = 2 + random.below(8) as usize;
    match kind {
        "sharp" => drop(all.pop()),
        "blunt" => all.extend(
            (1..on_edge)
                .map(|i| i as f64 / on_edge as f64)
                .map(|s| [0, 1].map(|k| lower[k] + s * (upper[k] - lower[k]))),
        ),
        "round" => {
            let r = [lower[0] - middle[0], lower[1] - middle[1]];
            let arc = |i: usize| libm::sincos(PI * i as f64 / (on_edge + 2) as f64);
            all.extend(
                (1..on_edge + 2)
                    .map(arc)
                    .map(|(s, c)| [middle[0] + c * r[0] - s * r[1], middle[1] + c * r[1] + s * r[0]]),
            );
        }
        _ => {}
    }
    let tip = if kind == "round" {
        let out = [0.5 * (upper[1] - lower[1]), 0.5 * (lower[0] - upper[0])];
        [middle[0] + out[0], middle[1] + out[1]]
    } else {
        middle
    };
    let far = (0..20_000).map(|i| {
        let (x, sign) = (f64::from(i % 10_000) * 1e-5, if i < 10_000 { 1.0 } else { -1.0 });
        let [y, slope] = camber(x, m, p, five);
        let (s, c) = libm::sincos(libm::atan(slope));
        distance([x - sign * half(x) * s, y + sign * half(x) * c], tip)
    });
    let chord = far.fold(0.0, f64::max);
    let (points, size, noise) = placed(all, random);
    Made { points, chord: size * chord, edge: size * edge, kind, noise: size * noise }
}

/// The points of a random size, place, direction and first point, perhaps with noise; that size, and the noise as a share of it.
fn placed(all: Vec<[f64; 2]>, random: &mut Random) -> (Vec<[f64; 2]>, f64, f64) {
    let size = libm::pow(10.0, between(random, 0.0, 3.0));
    let noise = if random.below(2) == 0 { 0.0 } else { 1e-4 };
    let (s, c) = libm::sincos(if random.below(2) == 0 { 0.0 } else { TAU * random.unit() });
    let shift = [0, 1].map(|_| between(random, -1.0, 1.0) * size);
    let place = |[x, y]: [f64; 2], random: &mut Random| {
        let (x, y) = (x + noise * normal(random), y + noise * normal(random));
        [shift[0] + size * (c * x - s * y), shift[1] + size * (s * x + c * y)]
    };
    let mut points: Vec<[f64; 2]> = all.into_iter().map(|p| place(p, random)).collect();
    if random.below(2) == 0 {
        let start = random.below(points.len() as u64) as usize;
        points.rotate_left(start);
    }
    if random.below(2) == 0 {
        points.reverse();
    }
    (points, size, noise)
}

/// How many of so many profiles have a chord that is off by more than a share. Then how many have such an edge, and an
/// edge of another kind.
fn wrong(profiles: u64) -> [usize; 3] {
    let mut counts = [0; 3];
    for seed in 0..profiles {
        let made = made(seed);
        let row = &made.points;
        let found = tail(row, made.noise);
        let [a, b] = found.ends.map(|i| row[i]);
        let end = if found.round { row[found.tip] } else { [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])] };
        let chord = row.iter().map(|p| distance(*p, end)).fold(0.0, f64::max);
        let name = if found.round {
            "round"
        } else if distance(a, b) == 0.0 {
            "sharp"
        } else {
            "blunt"
        };
        let want = if made.kind == "open" { "blunt" } else { made.kind };
        // The point farthest from the leading edge is, of a cambered profile, beside the middle of a round edge.
        let allowance = if made.kind == "round" { 0.5 * made.edge / made.chord } else { 0.0 };
        let off = (chord / made.chord - 1.0).abs() > 0.005 + allowance;
        let thick = name == "blunt"
            && want == "blunt"
            && (distance(a, b) - made.edge).abs() > 0.2 * made.edge + 5.0 * made.noise;
        counts[0] += usize::from(off);
        counts[1] += usize::from(thick);
        counts[2] += usize::from(name != want);
        if off || thick || name != want {
            println!(
                "{seed} {} of {}: {name} {:.4} of {:.4}, chord {:.5} of 1",
                made.kind,
                row.len(),
                distance(a, b) / made.chord,
                made.edge / made.chord,
                chord / made.chord
            );
        }
    }
    counts
}

#[test]
fn trailing_edges_are_found() {
    let [chords, edges, kinds] = wrong(200);
    assert!(chords == 0 && edges == 0 && kinds <= 2, "{chords} {edges} {kinds}");
}

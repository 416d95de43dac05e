//! Rates over random rows: strays left out or told, and no point of a row without a stray doubted.

use super::Strays;
use std::f64::consts::{PI, TAU};
use trueness_geom::num::random::Random;

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.unit()
}

fn count(random: &mut Random, low: u64, high: u64) -> usize {
    (low + random.below(high - low + 1)) as usize
}

fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// Points on both sides of a profile of four digits, from its trailing edge around; or its upper side alone, from the leading edge.
fn airfoil(random: &mut Random) -> Vec<[f64; 2]> {
    let (each, chord) = (count(random, 15, 120), libm::pow(10.0, between(random, 0.0, 3.0)));
    let (t, m, p) = (between(random, 0.06, 0.24), between(random, 0.0, 0.06), between(random, 0.3, 0.5));
    let cosine = random.below(2) == 0;
    let place = |k: usize, side: f64| {
        let u = k as f64 / each as f64;
        let x = if cosine { 0.5 * (1.0 - libm::cos(PI * u)) } else { u };
        let half = 5.0 * t * (0.2969 * x.sqrt() + x * (-0.126 + x * (-0.3516 + x * (0.2843 - 0.1015 * x))));
        let camber = if x < p {
            m / (p * p) * x * (2.0 * p - x)
        } else {
            m / (1.0 - p).powi(2) * (1.0 - 2.0 * p + x * (2.0 * p - x))
        };
        [chord * x, chord * (camber + side * half)]
    };
    if random.below(2) == 0 {
        return (0..=each).map(|k| place(k, 1.0)).collect();
    }
    (0..=each).rev().map(|k| place(k, 1.0)).chain((1..=each).map(|k| place(k, -1.0))).collect()
}

/// An arc or a whole circle, with even or random steps and noise.
fn arc(random: &mut Random) -> Vec<[f64; 2]> {
    let (n, r) = (count(random, 12, 300), libm::pow(10.0, between(random, -1.0, 3.0)));
    let sweep = if random.below(3) == 0 { TAU * (1.0 - 1.0 / n as f64) } else { between(random, 0.5, 6.0) };
    let (center, start) = ([0, 1].map(|_| between(random, -3.0, 3.0) * r), between(random, 0.0, TAU));
    let mut shares: Vec<f64> = (0..n).map(|k| k as f64 / (n - 1) as f64).collect();
    if random.below(2) == 0 {
        shares = (0..n).map(|_| random.unit()).collect();
        shares.sort_by(f64::total_cmp);
    }
    let noise = r * [0.0, 1e-4, 1e-3][random.below(3) as usize];
    let at = |s: f64, random: &mut Random| {
        let (sin, cos) = libm::sincos(start + s * sweep);
        let r = r + noise * normal(random);
        [center[0] + r * cos, center[1] + r * sin]
    };
    shares.into_iter().map(|s| at(s, random)).collect()
}

/// A polygon by its corners, or by points along its sides.
fn polygon(random: &mut Random) -> Vec<[f64; 2]> {
    let n = count(random, 8, 14);
    let mut angles: Vec<f64> = (0..n).map(|k| TAU * (k as f64 + 0.7 * random.unit()) / n as f64).collect();
    angles.sort_by(f64::total_cmp);
    let corners: Vec<[f64; 2]> = angles
        .iter()
        .map(|a| (libm::sincos(*a), between(random, 5.0, 10.0)))
        .map(|((s, c), r)| [r * c, r * s])
        .collect();
    let along = count(random, 1, 20);
    let side = |k: usize| {
        let (a, b) = (corners[k], corners[(k + 1) % n]);
        (0..along)
            .map(move |i| i as f64 / along as f64)
            .map(move |s| [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])])
    };
    let mut all: Vec<[f64; 2]> = (0..n).flat_map(side).collect();
    let start = random.below(all.len() as u64) as usize;
    all.rotate_left(start);
    all
}

/// A free curve, open or closed.
fn free(random: &mut Random) -> Vec<[f64; 2]> {
    let n = count(random, 20, 300);
    let terms: Vec<[f64; 3]> =
        (2..6).map(|k| [f64::from(k), 2.0 * random.unit() / f64::from(k), TAU * random.unit()]).collect();
    let open = random.below(2) == 0;
    (0..n)
        .map(|i| i as f64 / n as f64)
        .map(|s| {
            let sum: f64 = terms.iter().map(|[k, size, phase]| size * libm::sin(k * TAU * s + phase)).sum();
            let (sin, cos) = libm::sincos(TAU * s);
            if open { [30.0 * s, sum] } else { [(10.0 + sum) * cos, (10.0 + sum) * sin] }
        })
        .collect()
}

/// A rectangle with rounded corners by the ends of its lines and the vertices of its arcs, from any point, closed or
/// open. Without height it is an obround.
fn ends_of_lines(random: &mut Random) -> Vec<[f64; 2]> {
    let (r, each) = (between(random, 1.0, 5.0), count(random, 6, 30));
    let [w, h] =
        [0, 1].map(|k| if k == 1 && random.below(3) == 0 { 0.0 } else { r * between(random, 0.3, 15.0) });
    let mut all = vec![];
    for (k, [x, y]) in [[w, h], [-w, h], [-w, -h], [w, -h]].into_iter().enumerate() {
        for i in 0..=each {
            let (sin, cos) = libm::sincos(0.5 * PI * (k as f64 + i as f64 / each as f64));
            all.push([x + r * cos, y + r * sin]);
        }
    }
    all.dedup();
    let start = random.below(all.len() as u64) as usize;
    all.rotate_left(start);
    if random.below(3) == 0 {
        // A hook: one arc with the lines beside it.
        all = (0..=each)
            .map(|i| libm::sincos(2.5 * i as f64 / each as f64))
            .map(|(s, c)| [r * c, r * s])
            .collect();
        let (s, c) = libm::sincos(2.5);
        let long = r * between(random, 0.5, 20.0);
        all.push([r * c - long * s, r * s + long * c]);
        if random.below(2) == 0 {
            all.insert(0, [r, -r * between(random, 0.5, 20.0)]);
        }
    }
    all
}

/// A row of any kind without a stray, some with a gap.
fn row(random: &mut Random) -> Vec<[f64; 2]> {
    let kinds = [airfoil, arc, polygon, free, ends_of_lines];
    let mut all = kinds[random.below(5) as usize](random);
    let n = all.len();
    if random.below(5) == 0 && n > 40 {
        let from = n / 4 + random.below(n as u64 / 4) as usize;
        all.drain(from..from + n / 8);
    }
    if random.below(2) == 0 {
        all.reverse();
    }
    all
}

/// A row with strays, and their numbers.
fn with_strays(random: &mut Random) -> (Vec<[f64; 2]>, Vec<usize>) {
    let mut all = row(random);
    let n = all.len();
    let size = super::super::clean::size(&all);
    let middle = [0, 1].map(|k| all.iter().map(|p| p[k]).sum::<f64>() / n as f64);
    let far = |random: &mut Random| {
        let ((sin, cos), off) =
            (libm::sincos(TAU * random.unit()), size * libm::pow(10.0, between(random, 0.3, 6.0)));
        [middle[0] + off * cos, middle[1] + off * sin]
    };
    let mut one = far(random);
    let number = (n / 2) as f64;
    if random.below(5) == 0 && (number - middle[0]).hypot(number - middle[1]) > 2.0 * size {
        one = [number; 2];
    }
    let mut numbers = vec![];
    match random.below(6) {
        0 | 1 => {
            all.insert(0, one);
            numbers.push(0);
        }
        2 | 3 => {
            all.push(one);
            numbers.push(n);
        }
        4 => {
            let at = 2 + random.below(n as u64 - 4) as usize;
            all.insert(at, one);
            numbers.push(at);
        }
        _ => {
            let other = if random.below(2) == 0 { one } else { far(random) };
            all.insert(0, one);
            all.push(other);
            numbers.extend([0, n + 1]);
            if random.below(2) == 0 {
                all.push(other);
                numbers.push(n + 2);
            }
        }
    }
    (all, numbers)
}

/// How many rows with strays have them left out, doubted, and neither; how many rows without lose or doubt a point.
fn rates(rows: u64) -> [usize; 4] {
    let mut counts = [0; 4];
    for seed in 0..rows {
        let (points, wanted) = with_strays(&mut Random::stream(11, seed));
        let found = Strays::of(&points);
        let known = |list: &[usize]| wanted.iter().all(|i| list.contains(i));
        let all = [&found.out[..], &found.doubtful, &found.straight_on].concat();
        let k = if found.out == wanted { 0 } else { 2 - usize::from(known(&all)) };
        counts[k] += 1;
        if k == 2 && rows > 100 {
            println!("missed {seed}: {wanted:?} of {}: {found:?}", points.len());
        }
        let points = row(&mut Random::stream(12, seed));
        let found = Strays::of(&points);
        counts[3] += usize::from(found.out.len() + found.doubtful.len() > 0);
        if found.out.len() + found.doubtful.len() > 0 && rows > 100 {
            println!(
                "false {seed}: {found:?} of {} {:?} {:?} … {:?}",
                points.len(),
                points[0],
                points[1],
                points[points.len() - 1]
            );
        }
    }
    counts
}

#[test]
fn strays_are_left_out_or_told_and_no_other_point_is() {
    let [left_out, doubted, missed, false_doubt] = rates(100);
    assert!(missed == 0 && false_doubt == 0, "{left_out} {doubted} {missed} {false_doubt}");
    assert!(left_out > 90, "{left_out} {doubted}");
}

#[test]
#[ignore = "prints what goes wrong in many rows: run with --ignored"]
fn more_strays_are_left_out_or_told() {
    println!("{:?}", rates(3000));
}

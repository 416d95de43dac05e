//! Planted noise against what is found.

use super::*;
use crate::progress::Silent;
use crate::space::{Vector, plus, times};
use crate::spatial::lists::lists;

/// Standard deviation of what is planted, millimeters.
const PLANTED: f64 = 0.01;

/// A surface of its parameters, with its normal.
#[derive(Clone, Copy, Debug)]
enum Form {
    Plane,
    /// Radius in spacings.
    Cylinder(f64),
    /// Radius of the middle circle and of the tube, in spacings.
    Torus(f64, f64),
    /// Four planes that meet in right-angled edges: so many spacings wide each.
    Folded(f64),
}

impl Form {
    fn place(self, [u, v]: [f64; 2]) -> (Point, Vector) {
        match self {
            Form::Plane => ([u, v, 0.0], [0.0, 0.0, 1.0]),
            Form::Cylinder(r) => {
                let (sin, cos) = (u / r).sin_cos();
                ([r * sin, v, r * cos], [sin, 0.0, cos])
            }
            Form::Torus(big, small) => {
                let ((su, cu), (sv, cv)) = ((u / big).sin_cos(), (v / small).sin_cos());
                let from_axis = big + small * sv;
                ([from_axis * su, from_axis * cu, small * cv], [sv * su, sv * cu, cv])
            }
            Form::Folded(width) => {
                let (fold, along) = ((u / width).floor(), u.rem_euclid(width));
                // Steps up and on, one after the other.
                if fold.rem_euclid(2.0) == 0.0 {
                    let [x, z] = [along + width * (fold / 2.0), width * (fold / 2.0)];
                    ([x, v, z], [0.0, 0.0, 1.0])
                } else {
                    let half = (fold - 1.0) / 2.0;
                    ([width * (half + 1.0), v, width * half + along], [-1.0, 0.0, 0.0])
                }
            }
        }
    }
}

/// A mesh of about equal facets whose vertices have noise that is averaged over the neighbors so many times; and how many points of it tell
/// as much as an independent one.
fn scan(form: Form, rounds: usize, side: u32, seed: u64) -> (Mesh, f64) {
    let mut random = Random::new(seed);
    let mut jitter = || 0.3 * (random.unit() - 0.5);
    let at = |i: u32| (i % side, i / side);
    let parameters = (0..side * side).map(|i| {
        let (x, y) = at(i);
        let odd = 0.5 * f64::from(y % 2);
        [f64::from(x) + odd + jitter() - 0.5 * f64::from(side), 0.866 * f64::from(y) + jitter()]
    });
    let parameters: Vec<[f64; 2]> = parameters.collect();
    let faces: Vec<[u32; 3]> = (0..(side - 1) * (side - 1))
        .flat_map(|k| {
            let a = k / (side - 1) * side + k % (side - 1);
            let (right, up, both) = (a + 1, a + side, a + side + 1);
            if (a / side) % 2 == 0 { [[a, right, up], [right, both, up]] } else { [[a, right, both], [a, both, up]] }
        })
        .collect();
    let sides = faces.iter().flat_map(|f| [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]].map(|e| e.map(|k: usize| f[k])));
    let (first, others) = lists(parameters.len(), sides.collect());
    let around = |i: usize| &others[first[i] as usize..first[i + 1] as usize];
    let average = |values: &[f64]| -> Vec<f64> {
        let mean = |i: usize| {
            let beside = around(i);
            (values[i] + beside.iter().map(|j| values[*j as usize]).sum::<f64>()) / (1 + beside.len()) as f64
        };
        (0..values.len()).map(mean).collect()
    };
    let averaged = |values: Vec<f64>| (0..rounds).fold(values, |values, _| average(&values));
    // What one point of independent noise becomes: the average is symmetric inside.
    let mut one = vec![0.0; parameters.len()];
    one[(side * side / 2 + side / 2) as usize] = 1.0;
    let one = averaged(one);
    let squares: f64 = one.iter().map(|w| w * w).sum();
    let noise = averaged((0..parameters.len()).map(|_| normal(&mut random)).collect());
    let places = parameters.iter().zip(noise).map(|(p, e)| {
        let (place, out) = form.place(*p);
        plus(place, times(PLANTED * e / squares.sqrt(), out))
    });
    (Mesh { positions: places.collect(), faces }, one.iter().sum::<f64>().powi(2) / squares)
}

/// A normal number: the sum of twelve even ones is near enough.
fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// Deviation found over planted, and the root of the points that count as one over the true one.
fn ratios(form: Form, rounds: usize, side: u32, seed: u64) -> [f64; 2] {
    let (scanned, true_points) = scan(form, rounds, side, seed);
    let found = mesh(&scanned, seed, &Silent).unwrap();
    [found.deviation / PLANTED, (found.points_per_independent / true_points).sqrt()]
}

/// The middle and the extremes of both ratios over some seeds.
fn over_seeds(form: Form, rounds: usize, seeds: std::ops::Range<u64>) -> [[f64; 3]; 2] {
    let all: Vec<[f64; 2]> = seeds.map(|seed| ratios(form, rounds, 71, seed)).collect();
    [0, 1].map(|k| {
        let mut sorted: Vec<f64> = all.iter().map(|r| r[k]).collect();
        sorted.sort_by(f64::total_cmp);
        [sorted[0], sorted[sorted.len() / 2], sorted[sorted.len() - 1]]
    })
}

#[test]
fn planted_noise_is_found_with_what_neighbors_share() {
    for form in [Form::Plane, Form::Cylinder(20.0), Form::Cylinder(10.0), Form::Torus(40.0, 20.0), Form::Folded(35.0), Form::Folded(18.0)] {
        for rounds in 0..4 {
            let [deviation, shared] = over_seeds(form, rounds, 0..5);
            eprintln!("{form:?} {rounds}: {deviation:.3?} {shared:.3?}");
        }
    }
    panic!();
}

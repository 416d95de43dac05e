//! Planted noise against what is found.

use super::*;
use crate::fit::{Options, fit};
use crate::progress::Silent;
use crate::shape::{Kind, Parameter, Shape};
use crate::space::{Vector, minus, norm, plus, times};
use crate::spatial::lists::lists;
use std::collections::BTreeMap;

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

/// Facets, and the vertices beside each vertex.
struct Net {
    faces: Vec<[u32; 3]>,
    first: Vec<u32>,
    others: Vec<u32>,
}

impl Net {
    fn new(vertices: usize, faces: Vec<[u32; 3]>) -> Net {
        let sides = |f: &[u32; 3]| [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]].map(|e| e.map(|k| f[k]));
        let (first, others) = lists(vertices, faces.iter().flat_map(sides).collect());
        Net { faces, first, others }
    }
    fn beside(&self, i: usize) -> &[u32] {
        &self.others[self.first[i] as usize..self.first[i + 1] as usize]
    }
    /// Each value becomes the mean of itself and those beside, so many times.
    fn averaged(&self, mut values: Vec<f64>, rounds: usize) -> Vec<f64> {
        for _ in 0..rounds {
            let mean = |i: usize| {
                let beside = self.beside(i);
                let sum: f64 = beside.iter().map(|j| values[*j as usize]).sum();
                (values[i] + sum) / (1 + beside.len()) as f64
            };
            values = (0..values.len()).map(mean).collect();
        }
        values
    }
    /// Noise that is averaged so many times, of deviation [`PLANTED`]. Also how many points of it tell as much as an
    /// independent one, both as they are at a vertex inside.
    fn noise(&self, rounds: usize, inside: usize, random: &mut Random) -> (Vec<f64>, f64) {
        let count = self.first.len() - 1;
        let mut one = vec![0.0; count];
        one[inside] = 1.0;
        let one = self.averaged(one, rounds);
        let squares: f64 = one.iter().map(|w| w * w).sum();
        let raw = (0..count).map(|_| PLANTED / squares.sqrt() * normal(random)).collect();
        (self.averaged(raw, rounds), one.iter().sum::<f64>().powi(2) / squares)
    }
}

/// A mesh of about equal facets whose vertices have noise; and how many points of it tell as much as an independent one.
fn scan(form: Form, rounds: usize, side: u32, seed: u64) -> (Mesh, f64) {
    let mut random = Random::new(seed);
    let mut jitter = || 0.3 * (random.unit() - 0.5);
    let parameters: Vec<[f64; 2]> = (0..side * side)
        .map(|i| {
            let (x, y) = (f64::from(i % side), f64::from(i / side));
            let odd = 0.5 * (y % 2.0);
            [x + odd + jitter() - 0.5 * f64::from(side), 0.866 * y + jitter()]
        })
        .collect();
    let two = |k: u32| {
        let a = k / (side - 1) * side + k % (side - 1);
        let (right, up, both) = (a + 1, a + side, a + side + 1);
        match (a / side) % 2 {
            0 => [[a, right, up], [right, both, up]],
            _ => [[a, right, both], [a, both, up]],
        }
    };
    let net = Net::new(parameters.len(), (0..(side - 1) * (side - 1)).flat_map(two).collect());
    let (noise, shared) = net.noise(rounds, (side / 2 * side + side / 2) as usize, &mut random);
    let places = parameters.iter().zip(noise).map(|(p, e)| {
        let (place, out) = form.place(*p);
        plus(place, times(e, out))
    });
    (Mesh { positions: places.collect(), faces: net.faces }, shared)
}

/// A ball of radius 10 with 2,562 vertices, an icosahedron parted four times, with noise. Also how many points of it tell as
/// much as one.
fn ball(rounds: usize, random: &mut Random) -> (Mesh, f64) {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut places: Vec<Point> = (0..3)
        .flat_map(|axis| {
            [[1.0, golden], [-1.0, golden], [1.0, -golden], [-1.0, -golden]].map(|[a, b]| {
                let mut p = [0.0; 3];
                (p[axis], p[(axis + 1) % 3]) = (a, b);
                p
            })
        })
        .collect();
    let apart = |places: &[Point], i: usize, j: usize| norm(minus(places[i], places[j]));
    let mut faces: Vec<[u32; 3]> = vec![];
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if [[i, j], [j, k], [k, i]].iter().all(|[a, b]| apart(&places, *a, *b) < 2.1) {
                    faces.push([i, j, k].map(|v| v as u32));
                }
            }
        }
    }
    for _ in 0..4 {
        let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let mut parted = vec![];
        for f in &faces {
            let m = [0, 1, 2].map(|k| {
                let (a, b) = (f[k], f[(k + 1) % 3]);
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    places.push(plus(places[a as usize], places[b as usize]));
                    places.len() as u32 - 1
                })
            });
            parted.extend([[f[0], m[0], m[2]], [m[0], f[1], m[1]], [m[2], m[1], f[2]], m]);
        }
        places.iter_mut().for_each(|p| *p = times(1.0 / norm(*p), *p));
        faces = parted;
    }
    let net = Net::new(places.len(), faces);
    let (noise, shared) = net.noise(rounds, 2000, random);
    let positions = places.iter().zip(noise).map(|(p, e)| times((10.0 + e) / norm(*p), *p)).collect();
    (Mesh { positions, faces: net.faces }, shared)
}

/// A normal number: the sum of twelve even ones is near enough.
fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// Deviation found over planted, and the root of the points that count as one over the true one.
fn ratios(found: &Noise, true_points: f64) -> [f64; 2] {
    [found.deviation / PLANTED, (found.points_per_independent / true_points).sqrt()]
}

/// The least, the middle and the greatest.
fn spread(mut all: Vec<f64>) -> [f64; 3] {
    all.sort_by(f64::total_cmp);
    [all[0], all[all.len() / 2], all[all.len() - 1]]
}

const FORMS: [Form; 5] =
    [Form::Plane, Form::Cylinder(20.0), Form::Torus(40.0, 20.0), Form::Folded(35.0), Form::Folded(18.0)];

fn rates(copies: u64) {
    for form in FORMS {
        for rounds in 0..4 {
            let of_mesh = |seed: u64| {
                let (scan, shared) = scan(form, rounds, 71, seed);
                let found = [mesh(&scan, seed, &Silent), cloud(&scan.positions, seed, &Silent)];
                found.map(|found| ratios(&found.unwrap(), shared))
            };
            let all: Vec<_> = (0..copies).map(of_mesh).collect();
            for (k, what) in ["mesh", "cloud"].into_iter().enumerate() {
                let [deviation, shared] = [0, 1].map(|r| spread(all.iter().map(|a| a[k][r]).collect()));
                println!("{form:?} {rounds} {what}: deviation {deviation:.3?}, shared {shared:.3?}");
                assert!((deviation[1] - 1.0).abs() < 0.15, "{form:?} {rounds} {what}: {deviation:?}");
                assert!((shared[1] - 1.0).abs() < 0.15, "{form:?} {rounds} {what}: {shared:?}");
            }
        }
    }
}

#[test]
fn planted_noise_is_found_with_what_neighbors_share() {
    rates(3);
}

/// On faces of thirteen spacings' width all large patches reach over edges, and what they tell is form: small ones tell the noise.
#[test]
fn narrow_faces_have_their_noise_from_small_patches() {
    for rounds in 0..2 {
        for seed in 0..4 {
            let (scan, shared) = scan(Form::Folded(13.0), rounds, 71, seed);
            let found = mesh(&scan, seed, &Silent).unwrap();
            let [deviation, shared] = ratios(&found, shared);
            println!("{rounds} rounds: {deviation:.2} {shared:.2} {found:?}");
            assert!((deviation - 1.0).abs() < 0.25 && (shared - 1.0).abs() < 0.35, "{deviation} {shared}");
        }
    }
}

/// The deviation of a plane without noise is 0, a number.
#[test]
fn what_has_no_noise_has_the_deviation_0() {
    let positions: Vec<Point> = (0..1600).map(|i| [f64::from(i % 40), f64::from(i / 40), 0.0]).collect();
    let found = cloud(&positions, 0, &Silent).unwrap();
    assert_eq!((found.deviation, found.white, found.points_per_independent), (0.0, 1.0, 1.0), "{found:?}");
}

/// Radii of noisy balls scatter by the stated uncertainty times the root of the points that count as one.
#[test]
fn radii_of_balls_scatter_as_stated() {
    let copies: u64 = std::env::var("COPIES").map_or(40, |x| x.parse().unwrap());
    for rounds in 0..4 {
        let (mut squares, mut stated, mut independent, mut all) = (0.0, 0.0, 0.0, vec![]);
        for seed in 0..copies {
            let (scan, shared) = ball(rounds, &mut Random::stream(seed, rounds as u64));
            let fit = fit(&scan.positions, Kind::Sphere, &Options::default(), &Silent).unwrap();
            let distances: Vec<f64> = scan.positions.iter().map(|p| fit.shape.distance(*p)).collect();
            let found = about(&scan.clone().into(), &distances, seed, &Silent).unwrap();
            let uncertainties = fit.covariance.as_ref().unwrap().uncertainties(&fit.shape);
            let [_, (_, Parameter::Number(u))] = uncertainties[..] else { panic!("{uncertainties:?}") };
            let Shape::Sphere { radius, .. } = fit.shape else { panic!() };
            squares += (radius - 10.0).powi(2) / copies as f64;
            stated += u * u * found.points_per_independent / copies as f64;
            independent += u * u / copies as f64;
            all.push(ratios(&found, shared));
        }
        let [deviation, shared] = [0, 1].map(|r| spread(all.iter().map(|a| a[r]).collect()));
        let [ratio, alone] = [stated, independent].map(|s| (squares / s).sqrt());
        // A scatter of 40 copies is known to a ninth.
        assert!((0.75..1.3).contains(&ratio), "{rounds}: {ratio}");
        println!(
            "{rounds}: scatter over stated {ratio:.3}, of independent points {alone:.3}, deviation {deviation:.3?}, shared {shared:.3?}"
        );
    }
}

//! Walls, bores and dents in closed form.

use super::*;
use crate::feature::in_cloud;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::rigid::Rigid;
use crate::space::norm;

/// Normal numbers, roughly: the sum of twelve.
fn noise(random: &mut Random, sigma: f64) -> f64 {
    sigma * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0)
}

/// A floor from −10 to 10 with a bore of radius 4 down to −5 and walls along its sides, measured with some noise across the surfaces:
/// the points, and which of them are of the floor.
fn plate(sigma: f64) -> (Vec<Point>, Vec<bool>) {
    let mut random = Random::new(7);
    let mut points = vec![];
    let mut floor = vec![];
    let mut add = |p: Point, is_floor: bool| {
        points.push(p);
        floor.push(is_floor);
    };
    for _ in 0..6000 {
        let [x, y] = [0, 1].map(|_| 20.0 * random.unit() - 10.0);
        if libm::hypot(x, y) > 4.0 {
            add([x, y, noise(&mut random, sigma)], true);
        }
    }
    for _ in 0..2000 {
        let (turn, radius) = (std::f64::consts::TAU * random.unit(), 4.0 + noise(&mut random, sigma));
        add([radius * libm::cos(turn), radius * libm::sin(turn), -5.0 * random.unit()], false);
    }
    for _ in 0..2000 {
        let (along, deep) = (20.0 * random.unit() - 10.0, -5.0 * random.unit());
        for side in [-10.0, 10.0] {
            add([side + noise(&mut random, sigma), along, deep], false);
            add([along, side + noise(&mut random, sigma), deep], false);
        }
    }
    (points, floor)
}

/// Distance from the nearest wall, all of which are upright.
fn from_walls(p: Point) -> f64 {
    let bore = (libm::hypot(p[0], p[1]) - 4.0).abs();
    bore.min(10.0 - p[0].abs()).min(10.0 - p[1].abs()).max(0.0)
}

fn top() -> Nominal {
    let corner = |x: f64, y: f64| [10.0 * x, 10.0 * y, 0.0];
    let boundary = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary }
}

const NEAR: Nearness = Nearness { distance: 1.0, angle: 0.26, margin: -1.0, rim: true, inward: None };

fn beside(points: &[Point], nominal: &Nominal, near: &Nearness) -> (Vec<u32>, Vec<Piece>) {
    let own = in_cloud(points, nominal, near).unwrap().points;
    let found = pieces_beside(points, &PointTree::new(points), &own, nominal, near, &Silent).unwrap();
    (own, found)
}

fn numbers(pieces: &[Piece]) -> Vec<u32> {
    let mut all: Vec<u32> = pieces.iter().flat_map(|p| p.points.iter().map(|q| q.0)).collect();
    all.sort_unstable();
    all
}

/// Of a plate, the walls of its bore and sides are told from its top, and nothing of the top is.
#[test]
fn walls_are_told_from_a_plane() {
    for sigma in [0.0, 0.003, 0.01] {
        let (points, floor) = plate(sigma);
        let (own, pieces) = beside(&points, &top(), &NEAR);
        let out = numbers(&pieces);
        // What lies on a wall too, as far as noise tells, may be of either.
        let inside = |p: &&u32| floor[**p as usize] && from_walls(points[**p as usize]) > 0.01 + 4.0 * sigma;
        let lost = out.iter().filter(inside).count();
        let kept: Vec<f64> = own
            .iter()
            .filter(|p| !floor[**p as usize] && out.binary_search(p).is_err())
            .map(|p| points[*p as usize][2].abs())
            .collect();
        // What is kept of the walls lies on the top too, but for what is hardly below it.
        let deep = kept.iter().fold(0.0, |m: f64, d| m.max(*d));
        assert!(own.len() > 5000 + 1500 && out.len() > 1500, "{sigma}: {} {}", own.len(), out.len());
        assert_eq!(lost, 0, "{sigma}");
        assert!(deep <= 6.0 * sigma + 0.005, "{sigma}: {} kept, to {deep}", kept.len());
        // The normals are those of the walls.
        for (p, n) in pieces.iter().flat_map(|p| &p.points) {
            assert!(n[2].abs() < 0.2 && (norm(*n) - 1.0).abs() < 1e-12, "{sigma} {p} {n:?}");
        }
    }
}

/// The slope of a dent, of a scratch, of a bump is no wall, however steep, as long as it ends within reach.
#[test]
fn what_ends_within_reach_is_of_the_feature() {
    for (deep, steep) in [(0.9, 1.0), (0.9, 3.0), (-0.9, 2.0), (0.5, 9.0)] {
        let (mut points, floor) = plate(0.002);
        for (p, _) in points.iter_mut().zip(&floor).filter(|(_, is_floor)| **is_floor) {
            // A dent at (7, 7) and a scratch across the whole top at x = −7.
            let off = libm::hypot(p[0] - 7.0, p[1] - 7.0).min((p[0] + 7.0).abs());
            p[2] -= (steep * (1.5 - off)).clamp(0.0, f64::abs(deep)).copysign(deep);
        }
        let (_, pieces) = beside(&points, &top(), &NEAR);
        // The scratch ends on two walls: what lies on them may be theirs.
        let inside = |p: &&u32| floor[**p as usize] && from_walls(points[**p as usize]) > 0.5;
        assert_eq!(numbers(&pieces).iter().filter(inside).count(), 0, "{deep} {steep}");
    }
}

/// A dent deeper than the reach of the feature: its slopes go on and are told, its rim stays.
#[test]
fn what_goes_on_beyond_reach_is_told() {
    let (mut points, floor) = plate(0.002);
    for p in points.iter_mut().zip(&floor).filter(|(_, f)| **f).map(|(p, _)| p) {
        p[2] -= (3.0 - libm::hypot(p[0] - 6.0, p[1] - 6.0)).max(0.0) * 1.5;
    }
    let (_, pieces) = beside(&points, &top(), &NEAR);
    let dent = |p: &u32| floor[*p as usize] && from_walls(points[*p as usize]) > 0.5;
    assert!(numbers(&pieces).iter().filter(|p| dent(p)).count() > 30);
    // In pieces of their own: not one with a wall.
    for piece in &pieces {
        let of = piece.points.iter().filter(|(p, _)| dent(p)).count();
        assert!(of == 0 || of == piece.points.len(), "{of} of {}", piece.points.len());
    }
}

/// Around a bore it is the top that is beside; and what is found moves with the points.
#[test]
fn planes_are_told_from_a_bore_wherever_it_is() {
    let (points, floor) = plate(0.004);
    let near = Nearness { distance: 0.8, ..NEAR };
    let mut last: Option<Vec<u32>> = None;
    let motions = [Rigid::IDENTITY, Rigid::rotation_about([30.0, -4.0, 11.0], [0.5, 1.0, -0.3])];
    for motion in motions {
        let moved: Vec<Point> = points.iter().map(|p| motion.point(*p)).collect();
        let nominal = Nominal::Cylinder {
            point: motion.point([0.0, 0.0, -5.0]),
            direction: motion.vector([0.0, 0.0, 1.0]),
            radius: 4.0,
            length: 5.0,
        };
        let (own, pieces) = beside(&moved, &nominal, &near);
        let out = numbers(&pieces);
        assert!(out.iter().all(|p| floor[*p as usize]) && out.len() > 200, "{}", out.len());
        let kept = own.iter().filter(|p| out.binary_search(p).is_err() && floor[**p as usize]);
        let off = kept.map(|p| libm::hypot(points[*p as usize][0], points[*p as usize][1]) - 4.0);
        let off = off.fold(0.0, |m: f64, d| m.max(d.abs()));
        assert!(off < 0.05, "{off}");
        assert!(last.is_none_or(|l| l == out));
        last = Some(out);
    }
}

/// Too few points tell nothing, an edge has nothing beside it, and a nominal without sense is refused.
#[test]
fn what_tells_nothing() {
    let few: Vec<Point> = (0..8).map(|i| [f64::from(i), f64::from(i * i % 5), 0.0]).collect();
    assert!(beside(&few, &top(), &NEAR).1.is_empty());
    let (points, _) = plate(0.0);
    let edge = Nominal::Edge {
        point: [-10.0, 10.0, 0.0],
        direction: [1.0, 0.0, 0.0],
        length: 20.0,
        normals: [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    };
    assert!(beside(&points, &edge, &NEAR).1.is_empty());
    let none = Nominal::Plane { point: [0.0; 3], normal: [0.0; 3], boundary: vec![] };
    assert!(pieces_beside(&points, &PointTree::new(&points), &[0], &none, &NEAR, &Silent).is_err());
}

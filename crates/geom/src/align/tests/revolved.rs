//! A shaft with a key: a body of revolution but for a few points, and the same when its ends are interchanged.

use super::parts::{normal, random_pose};
use crate::align::sample::on_surface;
use crate::align::{AlignWarning, BestFit, Measured, Target, best_fit};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::Point;
use std::f64::consts::TAU;

const SIDES: u32 = 128;

/// A prism of radius 10 and height 30, along its whole length a key 2 wide and `high` above it.
fn shaft(high: f64) -> Mesh {
    let mut positions: Vec<Point> = vec![[0.0; 3], [0.0, 0.0, 30.0]];
    for k in 0..SIDES {
        let angle = TAU * f64::from(k) / f64::from(SIDES);
        let radius = if k <= 2 || k >= SIDES - 2 { 10.0 + high } else { 10.0 };
        let (sin, cos) = angle.sin_cos();
        positions.extend([0.0, 30.0].map(|z| [radius * cos, radius * sin, z]));
    }
    let mut faces = vec![];
    for k in 0..SIDES {
        let [a, b] = [k, (k + 1) % SIDES].map(|k| 2 + 2 * k);
        faces.extend([[0, b, a], [1, a + 1, b + 1], [a, b, b + 1], [a, b + 1, a + 1]]);
    }
    Mesh { positions, faces }
}

#[test]
fn a_shaft_with_a_key_is_told_to_look_the_same_from_either_end() {
    for (seed, high) in [(0, 1.0), (1, 1.0), (2, 0.3), (3, 0.3), (4, 0.3), (5, 0.3)] {
        let reference = shaft(high);
        let tree = Tree::build(&reference).unwrap();
        let random = &mut Random::new(seed);
        let pose = random_pose(random, 100.0);
        let places = on_surface(&reference, 6000, seed).points;
        let points: Vec<Point> =
            places.iter().map(|p| pose.point(p.map(|x| x + 0.005 * normal(random)))).collect();
        let measured = Measured::Points { points: &points, normals: None };
        let found =
            best_fit(&measured, &Target::new(&reference, &tree), &BestFit::default(), &Silent).unwrap();
        assert!(
            found.warnings.contains(&AlignWarning::Ambiguous { count: 1 }),
            "{seed}: {:?}",
            found.warnings
        );
        // One of the two poses is the true one, and the other has its ends interchanged.
        let poses = [found.reference_from_measured, found.alternatives[0].reference_from_measured];
        let turns = poses.map(|p| p.after(&pose).angle().to_degrees());
        assert!(turns.iter().any(|t| *t < 0.05) && turns.iter().any(|t| *t > 179.9), "{seed}: {turns:?}");
    }
}

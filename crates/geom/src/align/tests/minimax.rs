//! The least greatest distance: closed forms, no better pose nearby, one answer from several starts.

use super::parts::block;
use crate::align::{AlignError, Alignment, BestFit, Measured, Start, Target, best_fit, minimax};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::rigid::Rigid;
use crate::space::Point;

fn fitted(
    points: &[Point],
    mesh: &Mesh,
    start: Rigid,
) -> (Alignment, Result<crate::align::Minimax, AlignError>) {
    let tree = Tree::build(mesh).unwrap();
    let target = Target::new(mesh, &tree);
    let measured = Measured::Points { points, normals: None };
    let options = BestFit { start: Start::From(start), robust: false, ..BestFit::default() };
    let fit = best_fit(&measured, &target, &options, &Silent).unwrap();
    let found = minimax(&measured, &target, &fit, &options, &Silent);
    (fit, found)
}

fn greatest(points: &[Point], mesh: &Mesh, motion: &Rigid) -> f64 {
    let tree = Tree::build(mesh).unwrap();
    let far = |p: &Point| tree.closest(&motion.point(*p), f64::INFINITY).unwrap().unwrap().distance;
    points.iter().map(far).fold(0.0, f64::max)
}

/// Places within the sides of a block, one a square of `step`.
fn places(low: Point, high: Point, step: f64) -> Vec<Point> {
    let mesh = block(low, high, step);
    let middle = |f: &[u32; 3]| {
        let [a, b, c] = mesh.places(f);
        std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0)
    };
    mesh.faces.iter().map(middle).collect()
}

#[test]
fn half_of_a_single_bump_in_closed_form() {
    // One side has a bump of 0.3 at its middle. The block moves half of it back, and then its far side sticks out as much.
    let (low, high) = ([-10.0, -6.0, -4.0], [10.0, 6.0, 4.0]);
    let mesh = block(low, high, 40.0);
    let mut points = places(low, high, 1.0);
    points.push([10.3, 0.0, 0.0]);
    for start in [Rigid::IDENTITY, Rigid::rotation_about([1.0, 2.0, 3.0], [0.002, -0.001, 0.003])] {
        let (fit, found) = fitted(&points, &mesh, start);
        let found = found.unwrap();
        assert!((found.greatest - 0.15).abs() < 1e-9, "{}", found.greatest);
        assert!((greatest(&points, &mesh, &found.reference_from_measured) - found.greatest).abs() < 1e-12);
        // The greatest distance of the least-squares pose is nearly all of the bump.
        assert!(greatest(&points, &mesh, &fit.reference_from_measured) > 0.29);
        assert!(found.rms > fit.rms && found.used == points.len() as u64 && found.not_counted.count == 0);
    }
}

#[test]
fn no_pose_nearby_is_better() {
    let random = &mut Random::new(8);
    let mut uneven = |size: f64| -> Point { std::array::from_fn(|_| size * (2.0 * random.unit() - 1.0)) };
    let (low, high) = ([0.0; 3], [30.0, 20.0, 9.0]);
    let mesh = block(low, high, 60.0);
    for _ in 0..3 {
        let mut points = places(low, high, 1.5);
        for p in &mut points {
            let off = uneven(0.05);
            *p = std::array::from_fn(|k| p[k] + off[k]);
        }
        let (fit, found) = fitted(&points, &mesh, Rigid::IDENTITY);
        let found = found.unwrap();
        let best = found.reference_from_measured;
        assert!(found.greatest < greatest(&points, &mesh, &fit.reference_from_measured));
        let there = greatest(&points, &mesh, &best);
        assert!((there - found.greatest).abs() < 1e-12, "{there} {}", found.greatest);
        for k in 0..200 {
            let size = [1e-2, 1e-3, 1e-4][k % 3];
            let turn = Rigid::rotation_about([15.0, 10.0, 4.5], uneven(size / 15.0));
            let other = Rigid::translation_by(uneven(size)).after(&turn).after(&best);
            let there = greatest(&points, &mesh, &other);
            assert!(there >= found.greatest - 1e-9, "{there} {} by {size}", found.greatest);
        }
        // From elsewhere it ends at the same greatest distance.
        let away = Rigid::rotation_about([3.0, 2.0, 1.0], [0.01, 0.02, -0.01]);
        let again = fitted(&points, &mesh, away).1.unwrap();
        assert!((again.greatest - found.greatest).abs() < 1e-7, "{} {}", again.greatest, found.greatest);
    }
}

#[test]
fn what_is_free_has_no_such_pose() {
    let sheet = Mesh {
        positions: vec![[0.0; 3], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]],
        faces: vec![[0, 1, 2], [0, 2, 3]],
    };
    let points: Vec<Point> =
        (0..400).map(|k| [2.0 + 0.25 * f64::from(k % 20), 2.0 + 0.25 * f64::from(k / 20), 0.01]).collect();
    let (_, found) = fitted(&points, &sheet, Rigid::IDENTITY);
    assert!(matches!(found, Err(AlignError::Free { free: 3 })), "{found:?}");
}

/// Every vertex of a mesh of large facets counts: the distance told is the greatest of all.
#[test]
fn a_vertex_between_large_facets_counts() {
    let mesh = block([0.0; 3], [60.0, 40.0, 20.0], 80.0);
    let mut measured = block([0.0; 3], [60.0, 40.0, 20.0], 8.0);
    let on_top = |p: &Point| p[2] > 19.9 && (p[0] - 30.0).abs() < 5.0 && (p[1] - 20.0).abs() < 5.0;
    let deep = measured.positions.iter().position(on_top).unwrap();
    measured.positions[deep][2] -= 0.08;
    let tree = Tree::build(&mesh).unwrap();
    let target = Target::new(&mesh, &tree);
    let options = BestFit { start: Start::From(Rigid::IDENTITY), robust: false, ..BestFit::default() };
    let fit = best_fit(&Measured::Mesh(&measured), &target, &options, &Silent).unwrap();
    let found = minimax(&Measured::Mesh(&measured), &target, &fit, &options, &Silent).unwrap();
    let worst = greatest(&measured.positions, &mesh, &found.reference_from_measured);
    assert!((found.greatest - worst).abs() < 1e-12, "{} {worst}", found.greatest);
    assert_eq!((found.used, found.not_counted.count), (measured.positions.len() as u64, 0));
    // Half of the dent is shared out at best.
    assert!(worst > 0.039 && worst < 0.0801, "{worst}");
}

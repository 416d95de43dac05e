//! Requests to a best fit besides: components that stay zero, and a scale.

use super::parts::{block, bracket, moved, normal, random_pose};
use crate::align::{
    AlignError, AlignWarning, BestFit, Lock, Measured, Start, Target, best_fit, best_fit_scaled,
};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::rigid::Rigid;
use crate::space::{Point, times};

/// A block is moved by little: each component that is locked stays zero, and the sum of squares of the residuals is the least.
#[test]
fn locked_components_stay_zero_and_the_others_are_the_least() {
    let reference = bracket(8.0);
    let tree = Tree::build(&reference).unwrap();
    let target = Target::new(&reference, &tree);
    let away = Rigid::translation_by([0.4, -0.3, 0.2])
        .after(&Rigid::rotation_about([40.0, 25.0, 10.0], [0.01, -0.02, 0.015]));
    let scan = moved(&bracket(4.0), &away);
    let measured = Measured::Mesh(&scan);
    for set in 1..64_u32 {
        let axes = std::array::from_fn(|k| set >> k & 1 == 1);
        let lock = Lock::new(axes, &measured, Rigid::IDENTITY);
        let options = BestFit {
            start: Start::From(Rigid::IDENTITY),
            robust: false,
            lock: Some(lock),
            ..BestFit::default()
        };
        if set % 5 > 1 {
            continue;
        }
        let found = best_fit(&measured, &target, &options, &Silent).unwrap();
        let [turn, shift] = lock.components(&found.reference_from_measured);
        for k in 0..3 {
            let zero = [(axes[k], shift[k]), (axes[k + 3], turn[k])];
            assert!(zero.iter().all(|(locked, x)| !locked || x.abs() < 1e-12), "{set} {turn:?} {shift:?}");
            assert!(!axes[k] || found.covariance[k + 3][k + 3] < 1e-20, "{set}");
        }
    }
    // Nothing but a slide is left: of a shift of a block, exactly that component.
    let part = block([0.0; 3], [30.0, 20.0, 10.0], 5.0);
    let tree = Tree::build(&part).unwrap();
    let shifted = moved(&part, &Rigid::translation_by([0.2, 0.1, -0.3]));
    let measured = Measured::Mesh(&shifted);
    let lock = Lock::new([false, true, true, true, true, true], &measured, Rigid::IDENTITY);
    let options = BestFit {
        start: Start::From(Rigid::IDENTITY),
        robust: false,
        lock: Some(lock),
        ..BestFit::default()
    };
    let found = best_fit(&measured, &Target::new(&part, &tree), &options, &Silent).unwrap();
    let [x, y, z] = found.reference_from_measured.translation();
    assert!((x + 0.2).abs() < 1e-3 && y.abs() < 1e-12 && z.abs() < 1e-12, "{x} {y} {z}");
    let anywhere = BestFit { start: Start::Anywhere, ..options };
    let refused = best_fit(&measured, &Target::new(&part, &tree), &anywhere, &Silent);
    assert_eq!(refused, Err(AlignError::LockedSearch));
}

#[test]
fn a_scale_is_found_with_the_pose_and_told_by_its_unit() {
    let reference = bracket(6.0);
    let tree = Tree::build(&reference).unwrap();
    let target = Target::new(&reference, &tree);
    let random = &mut Random::new(2);
    for (factor, unit) in [
        (1.012, None),
        (0.97, None),
        (1.0, None),
        (2.0, None),
        (0.4, None),
        (25.4, Some(25.4)),
        (1e-3, Some(1e-3)),
    ] {
        let mut scan = moved(&bracket(4.0), &random_pose(random, 50.0));
        scan.positions.iter_mut().for_each(|p| *p = times(1.0 / factor, *p));
        let (found, scale) =
            best_fit_scaled(&Measured::Mesh(&scan), &target, &BestFit::default(), &Silent).unwrap();
        assert!((scale.factor / factor - 1.0).abs() < 1e-8, "{factor}: {scale:?}");
        assert!(found.rms < 1e-6, "{factor}: {}", found.rms);
        assert_eq!(scale.unit(), unit);
        assert_eq!(found.warnings.iter().any(|w| matches!(w, AlignWarning::Scale { .. })), unit.is_some());
    }
    // Its uncertainty: of noisy copies the factor is off by what is said.
    let (clean, mut sum) = (bracket(3.0), 0.0);
    for _ in 0..30 {
        let noisy = clean.positions.iter().map(|p| p.map(|x| x + 0.01 * normal(random))).collect();
        let scan = Mesh { positions: noisy, faces: clean.faces.clone() };
        let options = BestFit { start: Start::From(Rigid::IDENTITY), ..BestFit::default() };
        let (_, scale) = best_fit_scaled(&Measured::Mesh(&scan), &target, &options, &Silent).unwrap();
        sum += ((scale.factor - 1.0) / scale.std_uncertainty).powi(2) / 30.0;
    }
    assert!((0.5..1.7).contains(&sum), "{sum}");
    // One plane tells none.
    let points: Vec<Point> =
        (0..400).map(|k| [10.0 + (k % 20) as f64, 8.0 + 0.5 * (k / 20) as f64, 10.0]).collect();
    let part = block([0.0; 3], [40.0, 25.0, 10.0], 5.0);
    let tree = Tree::build(&part).unwrap();
    let flat = Measured::Points { points: &points, normals: None };
    let found = best_fit_scaled(&flat, &Target::new(&part, &tree), &BestFit::default(), &Silent);
    assert!(matches!(found, Err(AlignError::ScaleFree)), "{found:?}");
}

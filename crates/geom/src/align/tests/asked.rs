//! What is asked of a best fit besides: components that stay zero.

use super::parts::{block, bracket, moved};
use crate::align::{AlignError, BestFit, Lock, Measured, Start, Target, best_fit};
use crate::closest::Tree;
use crate::progress::Silent;
use crate::rigid::Rigid;

/// Of a block moved by little, each component that is locked stays zero, and the sum of squares is the least of what is left.
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
            start: Start::Given(Rigid::IDENTITY),
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
        start: Start::Given(Rigid::IDENTITY),
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

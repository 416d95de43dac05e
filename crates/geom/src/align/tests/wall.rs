//! Points without normals of one face of a plate: either side will do, and the rim of the face alone holds them along it.

use super::parts::{block, normal, random_pose};
use crate::align::{AlignWarning, Alignment, BestFit, Measured, Start, Target, best_fit};
use crate::closest::Tree;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::rigid::Rigid;
use crate::space::Point;

const SIZE: [f64; 3] = [60.0, 40.0, 8.0];

/// Points of the top of the plate, with noise.
fn top(random: &mut Random, count: usize) -> Vec<Point> {
    let one = |_| {
        let at = [SIZE[0] * random.unit(), SIZE[1] * random.unit(), SIZE[2]];
        at.map(|x| x + 0.01 * normal(random))
    };
    (0..count).map(one).collect()
}

fn fit(points: &[Point], start: Start) -> Alignment {
    let reference = block([0.0; 3], SIZE, 4.0);
    let tree = Tree::build(&reference).unwrap();
    let options = BestFit { start, ..BestFit::default() };
    best_fit(&Measured::Points { points, normals: None }, &Target::new(&reference, &tree), &options, &Silent)
        .unwrap()
}

#[test]
fn the_other_side_of_a_plate_is_told() {
    for seed in 0..6 {
        let random = &mut Random::new(seed);
        let pose = random_pose(random, 100.0);
        let points: Vec<Point> = top(random, 2000).iter().map(|p| pose.point(*p)).collect();
        let found = fit(&points, Start::Anywhere);
        assert!(
            found.warnings.iter().any(|w| matches!(w, AlignWarning::Ambiguous { .. })),
            "{seed}: {:?}",
            found.warnings
        );
        let height = |pose: &Rigid| points.iter().map(|p| pose.point(*p)[2]).sum::<f64>() / 2000.0;
        let here = height(&found.reference_from_measured);
        let other = |a: &crate::align::Alternative| {
            ((height(&a.reference_from_measured) - here).abs() - SIZE[2]).abs() < 0.1
        };
        assert!(found.alternatives.iter().any(other), "{seed}: {here} {:?}", found.alternatives);
    }
}

/// Along the face the pose is as uncertain as it says. The few points beyond the rim hold it, and no equation tells how far it
/// may go until they do.
#[test]
fn a_face_is_held_by_its_rim_no_better_than_is_said() {
    let (mut far, mut most) = (0, 0.0_f64);
    for seed in 0..12 {
        let points = top(&mut Random::new(100 + seed), 2000);
        let found = fit(&points, Start::From(Rigid::IDENTITY));
        let moved = found.reference_from_measured.point(found.center);
        for k in 0..2 {
            let (off, sigma) = ((moved[k] - found.center[k]).abs(), found.covariance[k + 3][k + 3].sqrt());
            far += usize::from(off > 3.0 * sigma);
            most = most.max(sigma);
        }
    }
    assert_eq!(far, 0);
    assert!(most < 0.5, "{most}");
}

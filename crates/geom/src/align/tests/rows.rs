//! Pairs and rows, against motions that are known.

use super::parts::random_pose;
use crate::align::{AlignError, AlignWarning, Row, constrained, pairs};
use crate::num::random::Random;
use crate::space::{Point, minus, norm, plus, times};

fn places(random: &mut Random, count: usize) -> Vec<Point> {
    (0..count).map(|_| std::array::from_fn(|_| 100.0 * random.unit() - 50.0)).collect()
}

#[test]
fn pairs_give_back_the_motion() {
    let random = &mut Random::new(9);
    for _ in 0..100 {
        let pose = random_pose(random, 100.0);
        let points = places(random, 5);
        let moved: Vec<Point> = points.iter().map(|p| pose.point(*p)).collect();
        let found = pairs(&points, &moved, None).unwrap();
        assert!(found.rms < 1e-12);
        assert!(found.reference_from_measured.after(&pose.inverse()).angle() < 1e-13);
    }
}

#[test]
fn no_other_motion_has_less_and_weights_count() {
    let random = &mut Random::new(10);
    let (from, to) = (places(random, 6), places(random, 6));
    let weights: Vec<f64> = (0..6).map(|_| random.unit()).collect();
    let found = pairs(&from, &to, Some(&weights)).unwrap().reference_from_measured;
    let squares = |m: &crate::rigid::Rigid| -> f64 {
        (0..6).map(|i| weights[i] * norm(minus(m.point(from[i]), to[i])).powi(2)).sum()
    };
    let least = squares(&found);
    for _ in 0..200 {
        let other = random_pose(random, 50.0);
        assert!(squares(&other) > least);
        let near = crate::rigid::Rigid::rotation_about(to[0], times(1e-4, minus(to[1], to[2])));
        assert!(squares(&near.after(&found)) > least);
    }
    // A weight of two is the pair twice.
    let twice: Vec<Point> = from.iter().chain(&from[..1]).copied().collect();
    let there: Vec<Point> = to.iter().chain(&to[..1]).copied().collect();
    let by_weight = pairs(&from, &to, Some(&[2.0, 1.0, 1.0, 1.0, 1.0, 1.0])).unwrap();
    let by_count = pairs(&twice, &there, None).unwrap();
    assert!(
        by_weight.reference_from_measured.after(&by_count.reference_from_measured.inverse()).angle() < 1e-13
    );
}

#[test]
fn a_mirror_image_is_no_rotation() {
    let random = &mut Random::new(11);
    let from = places(random, 8);
    let to: Vec<Point> = from.iter().map(|p| [-p[0], p[1], p[2]]).collect();
    let found = pairs(&from, &to, None).unwrap();
    let r = found.reference_from_measured.rotation();
    assert!(crate::space::dot(r[0], crate::space::cross(r[1], r[2])) > 0.0 && found.rms > 1.0);
}

/// Places that belong together but for one, those of a mirror image, and those that are only noisy.
#[test]
fn pairs_that_do_not_belong_together_are_told() {
    let random = &mut Random::new(12);
    let pose = random_pose(random, 50.0);
    let from = places(random, 6);
    let to: Vec<Point> = from.iter().map(|p| plus(pose.point(*p), [0.1 * random.unit(); 3])).collect();
    assert_eq!(pairs(&from, &to, None).unwrap().warnings, []);
    let mut wrong = to.clone();
    wrong[3] = plus(wrong[3], [0.0, 30.0, 0.0]);
    let told = |to: &[Point], weights: Option<&[f64]>| pairs(&from, to, weights).unwrap().warnings;
    let all = told(&wrong, None);
    let [AlignWarning::PoorRows { row: 3, residual, mirrored: false, .. }] = all[..] else {
        panic!("{all:?}")
    };
    assert!(residual > 5.0 && residual < 30.0, "{residual}");
    assert_eq!(told(&wrong, Some(&[1.0, 1.0, 1.0, 0.0, 1.0, 1.0])), []);
    let image: Vec<Point> = to.iter().map(|p| [p[0], p[1], -p[2]]).collect();
    let all = told(&image, None);
    assert!(matches!(all[..], [AlignWarning::PoorRows { mirrored: true, .. }]), "{all:?}");
}

#[test]
fn what_determines_no_pose_is_refused() {
    let line: Vec<Point> = (0..5).map(|k| times(f64::from(k), [1.0, 2.0, 3.0])).collect();
    assert_eq!(pairs(&line, &line, None), Err(AlignError::Collinear));
    assert!(matches!(pairs(&line, &line[..4], None), Err(AlignError::Uneven { .. })));
    assert!(matches!(pairs(&line[..2], &line[..2], None), Err(AlignError::TooFewPoints { .. })));
    let weights = [1.0, f64::NAN, 1.0, 1.0, 1.0];
    assert_eq!(pairs(&line, &line, Some(&weights)), Err(AlignError::BadWeight { row: 1 }));
    let row = |p: Point, direction: Point| Row { measured: p, nominal: p, direction, weight: 1.0 };
    let corners: [Point; 4] = [[0.0; 3], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [9.0, 9.0, 4.0]];
    let up: Vec<Row> = (0..8).map(|k| row(corners[k % 4], [0.0, 0.0, 1.0])).collect();
    assert_eq!(constrained(&up, None), Err(AlignError::Underdetermined { free: 3 }));
    let none: Vec<Row> = (0..8).map(|k| row(corners[k % 4], [0.0; 3])).collect();
    assert_eq!(constrained(&none, None), Err(AlignError::NoDirection { row: 0 }));
}

#[test]
fn rows_hold_along_their_directions_only() {
    // Points moved across their directions change nothing.
    let held: [(Point, usize); 6] = [
        ([0.0, 0.0, 0.0], 2),
        ([80.0, 0.0, 0.0], 2),
        ([0.0, 50.0, 0.0], 2),
        ([10.0, 0.0, 8.0], 1),
        ([70.0, 0.0, 8.0], 1),
        ([0.0, 25.0, 8.0], 0),
    ];
    let random = &mut Random::new(13);
    let pose = random_pose(random, 60.0);
    let rows = held.map(|(nominal, axis)| {
        let mut direction = [0.0; 3];
        direction[axis] = 2.0;
        let mut across: Point = std::array::from_fn(|_| random.unit() - 0.5);
        across[axis] = 0.0;
        Row { measured: pose.point(plus(nominal, across)), nominal, direction, weight: 1.0 }
    });
    let found = constrained(&rows, None).unwrap();
    assert!(found.converged && found.residuals.iter().all(|r| r.abs() < 1e-12), "{found:?}");
    let off = found.reference_from_measured.after(&pose);
    assert!(off.angle() < 1e-13 && off.displacement([40.0, 25.0, 0.0]) < 1e-11);
    // With a seventh row that disagrees, the weighted residuals balance and the heavier is held better.
    let mut more = rows.to_vec();
    more.push(Row {
        measured: pose.point([0.0, 25.0, 8.3]),
        nominal: [0.5, 25.0, 8.0],
        direction: [1.0, 0.0, 0.0],
        weight: 9.0,
    });
    let found = constrained(&more, None).unwrap();
    assert!(found.residuals[6].abs() < found.residuals[5].abs() && found.residuals[5].abs() < 0.5);
}

/// Three places are held along z almost on a line. The plane through them tilts about the line of the first two, which lies 0.4
/// from the third. The gains of any rows, against the same alignment done again with one of them off.
#[test]
fn errors_of_a_row_are_amplified_as_is_told() {
    let row = |nominal: Point, axis: usize| Row {
        measured: nominal,
        nominal,
        direction: std::array::from_fn(|k| f64::from(u8::from(k == axis))),
        weight: 1.0,
    };
    let rows = [
        row([5.0, 5.0, 0.0], 2),
        row([75.0, 5.0, 0.0], 2),
        row([40.0, 5.4, 0.0], 2),
        row([5.0, 0.0, 0.0], 1),
        row([75.0, 0.0, 0.0], 1),
        row([0.0, 25.0, 0.0], 0),
    ];
    let corners: Vec<Point> =
        (0..4).map(|k| [80.0 * f64::from(k % 2), 50.0 * f64::from(k / 2), 0.0]).collect();
    let told = constrained(&rows, None).unwrap().amplifications(&corners);
    assert!((told[2] - 45.0 / 0.4).abs() < 1e-9, "{told:?}");
    assert!(told[5] > 0.9 && told[5] < 2.0, "{told:?}");
    let random = &mut Random::new(12);
    for trial in 0..20 {
        let nominal = places(random, 9);
        let pose = random_pose(random, 50.0).inverse();
        let rows: Vec<Row> = (0..[6, 9][trial % 2])
            .map(|i| Row {
                measured: pose.point(nominal[i]),
                nominal: nominal[i],
                direction: std::array::from_fn(|_| random.unit() - 0.5),
                weight: 0.5 + random.unit(),
            })
            .collect();
        let Ok(rest) = constrained(&rows, Some(pose.inverse())) else { continue };
        for (i, told) in rest.amplifications(&corners).into_iter().enumerate() {
            let size = 1e-7 / told;
            let mut off = rows.clone();
            let d = off[i].direction;
            off[i].nominal = minus(off[i].nominal, times(size / norm(d), d));
            let again = constrained(&off, Some(rest.reference_from_measured)).unwrap();
            let between = again.reference_from_measured.after(&rest.reference_from_measured.inverse());
            let moved = corners.iter().map(|p| between.displacement(*p)).fold(0.0, f64::max);
            assert!((moved / (told * size) - 1.0).abs() < 1e-3, "{trial} {i}: {moved} {told}");
        }
    }
}

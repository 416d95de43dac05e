//! Sparse rows without noise: rounded rectangles of a few points to a corner.

use super::*;

/// `count` points at even lengths around a rectangle with rounded corners, turned and moved, rounded to so many decimals.
pub(super) fn rounded_rectangle(
    count: usize,
    shift: f64,
    [w, h, r]: [f64; 3],
    turn: f64,
    decimals: i32,
) -> Vec<[f64; 2]> {
    let quarter = 0.5 * std::f64::consts::PI * r;
    let length = 2.0 * (w + h - 4.0 * r) + 4.0 * quarter;
    let sides = [w - 2.0 * r, h - 2.0 * r];
    let (sin, cos) = libm::sincos(turn);
    let unit = 10.0_f64.powi(decimals);
    let place = |i: usize| {
        let mut s = length * (i as f64 + shift) / count as f64;
        let (mut at, mut heading, mut k) = ([r - 0.5 * w, -0.5 * h], 0.0, 0);
        loop {
            let (sh, ch) = libm::sincos(heading);
            if s <= sides[k % 2] {
                return [at[0] + s * ch, at[1] + s * sh];
            }
            s -= sides[k % 2];
            at = [at[0] + sides[k % 2] * ch, at[1] + sides[k % 2] * sh];
            let center = [at[0] - r * sh, at[1] + r * ch];
            let angle = heading - 0.5 * std::f64::consts::PI + s.min(quarter) / r;
            let (sa, ca) = libm::sincos(angle);
            at = [center[0] + r * ca, center[1] + r * sa];
            if s <= quarter {
                return at;
            }
            (s, heading, k) = (s - quarter, heading + 0.5 * std::f64::consts::PI, k + 1);
        }
    };
    (0..count)
        .map(place)
        .map(|[x, y]| [7.0 + cos * x - sin * y, sin * x + cos * y - 3.0])
        .map(|p| p.map(|x| (x * unit).round() / unit))
        .collect()
}

pub(super) fn is_right(contour: &Contour, [w, h, r]: [f64; 3], off: f64) -> bool {
    let length = 2.0 * (w + h - 4.0 * r) + 2.0 * std::f64::consts::PI * r;
    let radii = contour.segments.iter().filter_map(|s| match s.geometry {
        Geometry::Arc { radius, .. } => Some(radius),
        _ => None,
    });
    let radii: Vec<f64> = radii.collect();
    contour.segments.len() == 8
        && radii.len() == 4
        && radii.iter().all(|x| (x - r).abs() < off)
        && (contour.length() - length).abs() < off
}

/// Rounded rectangles of 16 to 60 exact points are right, or named unreliable: never tilted lines without a word.
#[test]
fn sparse_rounded_rectangles_are_right_or_astray() {
    let (mut right, mut all, mut silent) = (0, 0, vec![]);
    for sizes in [[40.0, 24.0, 6.0], [30.0, 20.0, 3.0], [50.0, 50.0, 10.0], [60.0, 20.0, 5.0]] {
        for count in (16..=60).step_by(2) {
            for (shift, turn, decimals) in
                [(0.3, 0.0, 15), (0.0, 0.4, 15), (0.7, 0.4, 6), (0.15, 1.1, 4), (0.5, 0.0, 3)]
            {
                // A corner without a point of its own is a corner.
                let [w, h, r] = sizes;
                let quarter = 0.5 * std::f64::consts::PI * r;
                if 2.0 * (w + h - 4.0 * r) + 4.0 * quarter > quarter * count as f64 {
                    continue;
                }
                let points = rounded_rectangle(count, shift, sizes, turn, decimals);
                let contour = found(&points);
                let good = is_right(&contour, sizes, 1e-7_f64.max(200.0 * 10.0_f64.powi(-decimals)));
                silent.extend(
                    (!good && contour.unreliable.is_empty()).then_some((sizes, count, shift, decimals)),
                );
                all += 1;
                right += usize::from(good && contour.unreliable.is_empty());
            }
        }
    }
    assert!(4 * right > 3 * all, "{right} of {all}");
    // Four points to a side of which two are on it look like a square of noisy points.
    assert!(50 * silent.len() <= all, "{} of {all}: {silent:?}", silent.len());
}

/// A slot of few points, a bracket with a corner and a fillet, open: right too.
#[test]
fn sparse_slots_and_brackets_are_right() {
    let arc = |center: [f64; 2], r: f64, degrees: &[f64]| -> Vec<[f64; 2]> {
        let at = degrees.iter().map(|a| libm::sincos(a.to_radians()));
        at.map(|(s, c)| [center[0] + r * c, center[1] + r * s]).collect()
    };
    let slot = [
        vec![[-8.0, -5.0], [-1.0, -5.0], [7.0, -5.0]],
        arc([10.0, 0.0], 5.0, &[-70.0, -20.0, 30.0, 75.0]),
        vec![[8.0, 5.0], [0.0, 5.0], [-7.0, 5.0]],
        arc([-10.0, 0.0], 5.0, &[110.0, 160.0, 200.0, 255.0]),
    ]
    .concat();
    let contour = contour(&slot, &Options { closed: Some(true), ..Options::default() }, &Silent).unwrap();
    assert!(contour.unreliable.is_empty() && contour.closed, "{:?} {}", kinds(&contour), contour.noise);
    assert_eq!(kinds(&contour), [SegmentKind::Line, SegmentKind::Arc, SegmentKind::Line, SegmentKind::Arc]);
    assert!((contour.length() - 40.0 - 10.0 * std::f64::consts::PI).abs() < 1e-7, "{}", contour.length());
    let bracket = [
        vec![[0.0, 0.0], [5.0, 0.0], [10.0, 0.0], [16.0, 0.0]],
        arc([17.0, 3.0], 3.0, &[-60.0, -25.0]),
        vec![[20.0, 4.0], [20.0, 9.0], [20.0, 14.0], [18.0, 15.0], [12.0, 15.0], [5.0, 15.0]],
    ]
    .concat();
    let contour = found(&bracket);
    assert!(contour.unreliable.is_empty() && !contour.closed);
    assert_eq!(kinds(&contour), [SegmentKind::Line, SegmentKind::Arc, SegmentKind::Line, SegmentKind::Line]);
    let truth =
        [([17.0, 0.0], Continuity::G1), ([20.0, 3.0], Continuity::G1), ([20.0, 15.0], Continuity::G0)];
    for (join, (at, continuity)) in contour.joins.iter().zip(truth) {
        assert!(far(join.point, at) < 1e-6 && join.continuity == continuity, "{join:?}");
    }
}

/// Outlines of pixels lie on lines exactly where they run along the grid, and scatter by a pixel elsewhere: they are not unreliable.
#[test]
fn outlines_of_pixels_are_not_astray() {
    let mut points: Vec<[f64; 2]> = vec![];
    for i in 0..300 {
        let (s, c) = libm::sincos(f64::from(i) * std::f64::consts::TAU / 300.0);
        let p = [(60.0 * c).round(), (60.0 * s).round()];
        if points.last() != Some(&p) && points.first() != Some(&p) {
            points.push(p);
        }
    }
    assert!(found(&points).unreliable.is_empty());
}

/// Two sides that end close to each other do not meet far beyond: points as close as theirs would lie there.
#[test]
fn no_corner_lies_beyond_a_blunt_tip() {
    for (seed, flat) in [0.3, 0.2, 0.4].into_iter().enumerate() {
        let random = &mut Random::new(seed as u64);
        let (sin, cos) = libm::sincos(4.0_f64.to_radians());
        let side = |sign: f64| {
            (0..80)
                .map(move |i| 0.5 * f64::from(i) + 0.05)
                .map(move |s| [-s * cos, sign * (0.5 * flat + s * sin)])
        };
        let below: Vec<[f64; 2]> = side(-1.0).collect();
        let points: Vec<[f64; 2]> = below.into_iter().rev().chain(side(1.0)).collect();
        let noisy: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| x + 0.003 * normal(random))).collect();
        let found = found(&noisy);
        assert_eq!(kinds(&found), [SegmentKind::Line; 2], "{flat}");
        let join = &found.joins[0];
        assert!(join.point[0] < 0.1 && join.open == [true; 2], "{flat}: {join:?}");
    }
}

/// Points of the one side that end at the corner tell it, where those of the other begin only after a wide gap. Where
/// both end before it, the gap is the uncertainty.
#[test]
fn a_corner_beside_a_gap_is_told_by_the_side_that_reaches_it() {
    for seed in 0..6 {
        for (end, warned) in [(0, true), (6, false)] {
            let random = &mut Random::new(seed);
            let down = (end..40).rev().map(|i| [0.0, f64::from(i)]);
            let along = (15..60).map(|i| [f64::from(i), 0.0]);
            let noisy: Vec<[f64; 2]> =
                down.chain(along).map(|p| p.map(|x| x + 0.005 * normal(random))).collect();
            let found = found(&noisy);
            assert_eq!(found.segments.len(), 2, "{end} {seed}");
            let join = &found.joins[0];
            let off = libm::hypot(join.point[0], join.point[1]);
            match warned {
                true => assert!(off < 5.0 * join.uncertainty && join.uncertainty < 0.01, "{seed}: {join:?}"),
                false => assert!(join.uncertainty > 1.0 && join.open == [true; 2], "{seed}: {join:?}"),
            }
        }
    }
}

//! Sections with known joins: closed forms, exact data, rigid motions, coverage over fresh noise, wrong and ugly rows.

mod clothoids;
mod corners;
mod direction;
mod gentle;
mod long;
mod noise_levels;
mod outlines;
mod resolved;
mod rounded;
mod scattered;
mod smooth;
mod sparse;
mod stray_ends;
mod unreliable;
mod vertices;

use super::*;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;

/// Normal by the sum of twelve uniform numbers.
fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// A line of length 8, a quarter of a circle of radius 5, a line of length 6.
fn bend(s: f64) -> [f64; 2] {
    let quarter = 2.5 * std::f64::consts::PI;
    if s < 8.0 {
        [s, 0.0]
    } else if s < 8.0 + quarter {
        let (sin, cos) = libm::sincos((s - 8.0) / 5.0);
        [8.0 + 5.0 * sin, 5.0 - 5.0 * cos]
    } else {
        [13.0, 5.0 + s - 8.0 - quarter]
    }
}

fn bends(count: usize, noise: f64, seed: u64) -> Vec<[f64; 2]> {
    let random = &mut Random::new(seed);
    let length = 14.0 + 2.5 * std::f64::consts::PI;
    (0..count)
        .map(|i| bend(length * i as f64 / (count - 1) as f64))
        .map(|p| [p[0] + noise * normal(random), p[1] + noise * normal(random)])
        .collect()
}

fn kinds(contour: &Contour) -> Vec<SegmentKind> {
    contour.segments.iter().map(|s| s.geometry.kind()).collect()
}

fn found(points: &[[f64; 2]]) -> Contour {
    contour(points, &Options::default(), &Silent).unwrap()
}

fn far(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

#[test]
fn exact_points_give_the_exact_joins() {
    let contour = found(&bends(150, 0.0, 0));
    assert_eq!(kinds(&contour), [SegmentKind::Line, SegmentKind::Arc, SegmentKind::Line]);
    for (join, truth) in contour.joins.iter().zip([[8.0, 0.0], [13.0, 5.0]]) {
        assert!(far(join.point, truth) < 1e-6, "{join:?}");
        assert_eq!(join.continuity, Continuity::G1);
    }
    let Geometry::Arc { center, radius, sweep, .. } = contour.segments[1].geometry else { panic!() };
    assert!(far(center, [8.0, 5.0]) < 1e-6 && (radius - 5.0).abs() < 1e-6);
    assert!((sweep - 0.5 * std::f64::consts::PI).abs() < 1e-6);
    assert_eq!(contour.labels.iter().filter(|l| **l == 1).count(), contour.segments[1].count);
}

/// The stated intervals hold the true joins as often as they say, over fresh noise.
#[test]
fn intervals_cover_over_fresh_noise() {
    let (mut inside, mut all, mut z, mut other) = (0, 0, 0.0, 0);
    for seed in 0..150 {
        let contour = found(&bends(120, 0.01, 1000 + seed));
        if kinds(&contour) != [SegmentKind::Line, SegmentKind::Arc, SegmentKind::Line] {
            other += 1;
            continue;
        }
        for (join, truth) in contour.joins.iter().zip([[8.0, 0.0], [13.0, 5.0]]) {
            let [a, b] = join.interval;
            let d = [b[0] - a[0], b[1] - a[1]];
            let t = ((truth[0] - a[0]) * d[0] + (truth[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
            inside += i32::from((0.0..=1.0).contains(&t));
            all += 1;
            let along = (join.point[0] - truth[0]) * d[0] + (join.point[1] - truth[1]) * d[1];
            z += (along / libm::hypot(d[0], d[1]) / join.uncertainty).powi(2);
        }
    }
    // Noise that looks like another kind: at most 3 in 100.
    assert!(other <= 4, "{other}");
    let share = f64::from(inside) / f64::from(all);
    // 300 trials at 95 %: four standard deviations are 5 %.
    assert!((0.90..=0.99).contains(&share), "{share}");
    assert!((z / f64::from(all) - 1.0).abs() < 0.35, "{}", z / f64::from(all));
}

/// Errors of directions, radii and centers over fresh noise are as large as stated: each over its uncertainty has the
/// mean square 1. With 240 draws that is uncertain by 0.09; three times that is allowed.
#[test]
fn uncertainties_of_segments_are_those_of_fresh_noise() {
    let mut sums = [0.0; 5];
    let mut count = 0.0;
    for seed in 0..240 {
        let contour = found(&bends(120, 0.01, 1000 + seed));
        if kinds(&contour) != [SegmentKind::Line, SegmentKind::Arc, SegmentKind::Line] {
            continue;
        }
        count += 1.0;
        let [first, arc, last] = [0, 1, 2].map(|k| &contour.segments[k]);
        let Geometry::Arc { center, radius, .. } = arc.geometry else { panic!() };
        let Some(Uncertainty::Arc { center: of_center, radius: of_radius }) = arc.uncertainty else {
            panic!()
        };
        let angle = |s: &Segment| match s.uncertainty {
            Some(Uncertainty::Line { angle }) => angle,
            _ => panic!(),
        };
        let off = [
            first.angle() / angle(first),
            (last.angle() - 0.5 * std::f64::consts::PI) / angle(last),
            (radius - 5.0) / of_radius,
            (center[0] - 8.0) / of_center[0],
            (center[1] - 5.0) / of_center[1],
        ];
        (0..5).for_each(|k| sums[k] += off[k] * off[k]);
    }
    assert!(count > 230.0, "{count}");
    for mean in sums.map(|s| s / count) {
        assert!((mean - 1.0).abs() < 0.27, "{:?}", sums.map(|s| s / count));
    }
}

#[test]
fn a_rigid_motion_moves_the_answer_and_reversing_turns_it_round() {
    let points = bends(120, 0.005, 3);
    let before = found(&points);
    let (sin, cos) = libm::sincos(2.1);
    let moved = |p: [f64; 2]| [1e3 + cos * p[0] - sin * p[1], -500.0 + sin * p[0] + cos * p[1]];
    let after = found(&points.iter().map(|p| moved(*p)).collect::<Vec<_>>());
    let reversed = found(&points.iter().rev().copied().collect::<Vec<_>>());
    assert_eq!((kinds(&before), kinds(&before)), (kinds(&after), kinds(&reversed)));
    for (i, join) in before.joins.iter().enumerate() {
        assert!(far(moved(join.point), after.joins[i].point) < 1e-6);
        assert!((join.uncertainty - after.joins[i].uncertainty).abs() < 0.02 * join.uncertainty);
        assert!(far(join.point, reversed.joins[1 - i].point) < 0.1 * join.uncertainty);
    }
}

/// A square with rounded corners, one of them sharp: closed, with a corner.
#[test]
fn corners_are_told_from_tangent_joins() {
    let random = &mut Random::new(5);
    let mut points = vec![];
    let mut push = |p: [f64; 2]| points.push([p[0] + 0.002 * normal(random), p[1] + 0.002 * normal(random)]);
    (0..80).for_each(|i| push([0.1 * f64::from(i) + 0.05, 0.0]));
    for i in 0..31 {
        let (sin, cos) = libm::sincos(f64::from(i) * 0.05 + 0.02);
        push([8.0 + 2.0 * sin, 2.0 - 2.0 * cos]);
    }
    (0..80).for_each(|i| push([10.0, 2.0 + 0.1 * f64::from(i) + 0.05]));
    (0..100).for_each(|i| push([9.95 - 0.1 * f64::from(i), 10.0]));
    (0..100).for_each(|i| push([0.0, 9.95 - 0.1 * f64::from(i)]));
    let contour = found(&points);
    assert!(contour.closed);
    let mut sorted: Vec<(Continuity, [f64; 2])> =
        contour.joins.iter().map(|j| (j.continuity, j.point)).collect();
    sorted.sort_by_key(|a| a.0);
    assert_eq!(contour.segments.len(), 5, "{:?}", kinds(&contour));
    for corner in [[10.0, 10.0], [0.0, 10.0], [0.0, 0.0]] {
        let join = contour.joins.iter().find(|j| far(j.point, corner) < 0.01).unwrap();
        assert_eq!(join.continuity, Continuity::G0);
        assert!((join.turn - 0.5 * std::f64::consts::PI).abs() < 0.01);
        assert!(far(join.point, corner) < 5.0 * join.uncertainty && join.uncertainty < 0.002);
    }
    for tangent in [[8.0, 0.0], [10.0, 2.0]] {
        let join = contour.joins.iter().find(|j| far(j.point, tangent) < 0.1).unwrap();
        assert_eq!(join.continuity, Continuity::G1);
    }
}

#[test]
fn wrong_rows_are_refused_and_odd_ones_answered() {
    let options = Options::default();
    let refused = |points: &[[f64; 2]]| contour(points, &options, &Silent).unwrap_err();
    assert_eq!(refused(&[[0.0, 0.0], [1.0, 0.0], [2.0, 1.0]]), SectionError::TooFewPoints { found: 3 });
    assert_eq!(refused(&[[0.0, 0.0]; 9]), SectionError::TooFewPoints { found: 1 });
    let mut points = bends(90, 0.01, 1);
    points[7][1] = f64::NAN;
    assert_eq!(refused(&points), SectionError::NotFinite { index: 7 });
    let mut points = bends(150, 0.001, 1);
    let mut random = Random::new(2);
    (0..150).rev().for_each(|i| points.swap(i, random.below(i as u64 + 1) as usize));
    assert!(matches!(refused(&points), SectionError::Unordered { .. }));
    // Run through twice.
    assert_eq!(refused(&[bends(90, 0.01, 1), bends(90, 0.01, 1)].concat()), SectionError::PlacesAgain);
    let noise = Options { noise: Some(-1.0), ..options };
    assert!(matches!(contour(&bends(90, 0.01, 1), &noise, &Silent), Err(SectionError::WrongOption { .. })));
    // Points doubled, one far off: left out, listed, and the joins stay where they are.
    let plain = found(&bends(120, 0.005, 9));
    let mut points = bends(120, 0.005, 9);
    points[30][1] += 1.0;
    points.insert(60, points[59]);
    let odd = found(&points);
    assert_eq!((&odd.repeated[..], &odd.outliers[..]), (&[60][..], &[30][..]));
    assert_eq!(kinds(&plain), kinds(&odd));
    for (a, b) in plain.joins.iter().zip(&odd.joins) {
        assert!(far(a.point, b.point) < a.uncertainty);
    }
    // Noise of ten spacings: a line still, or at least nothing sharper than the data allow.
    let random = &mut Random::new(4);
    let wild: Vec<[f64; 2]> = (0..2000).map(|i| [f64::from(i) * 0.01, 0.1 * normal(random)]).collect();
    let line = found(&wild);
    assert_eq!(kinds(&line), [SegmentKind::Line]);
    assert!((line.noise - 0.1).abs() < 0.01);
}

#[test]
fn a_circle_has_no_join_and_a_slot_has_four() {
    let random = &mut Random::new(6);
    let circle: Vec<[f64; 2]> = (0..200)
        .map(|i| libm::sincos(f64::from(i) * std::f64::consts::TAU / 200.0))
        .map(|(s, c)| [3.0 + 7.0 * c + 0.001 * normal(random), 7.0 * s + 0.001 * normal(random)])
        .collect();
    let contour = found(&circle);
    assert!(contour.closed && contour.joins.is_empty(), "{:?}", kinds(&contour));
    let Geometry::Arc { center, radius, sweep, .. } = contour.segments[0].geometry else { panic!() };
    assert!(far(center, [3.0, 0.0]) < 1e-3 && (radius - 7.0).abs() < 1e-3);
    assert!((sweep - std::f64::consts::TAU).abs() < 1e-6, "{sweep}");
    let mut slot = vec![];
    (0..100).for_each(|i| slot.push([0.2 * f64::from(i) - 10.0, -4.0]));
    (0..63)
        .map(|i| libm::sincos(0.05 * f64::from(i)))
        .for_each(|(s, c)| slot.push([10.0 + 4.0 * s, -4.0 * c]));
    (0..100).for_each(|i| slot.push([9.97 - 0.2 * f64::from(i), 4.0]));
    (0..63)
        .map(|i| libm::sincos(0.05 * f64::from(i)))
        .for_each(|(s, c)| slot.push([-10.0 - 4.0 * s, 4.0 * c]));
    let slot: Vec<[f64; 2]> =
        slot.iter().map(|p| [p[0] + 0.002 * normal(random), p[1] + 0.002 * normal(random)]).collect();
    let contour = found(&slot);
    assert_eq!(contour.joins.len(), 4);
    // The contour closes: each segment starts where the one before ends.
    for (i, segment) in contour.segments.iter().enumerate() {
        let next = &contour.segments[(i + 1) % 4];
        assert!(far(segment.end, next.start) < 1e-9, "{i}");
        assert!(far(segment.end, contour.joins[i].point) < 1e-9, "{i}");
    }
    for truth in [[-10.0, -4.0], [10.0, -4.0], [10.0, 4.0], [-10.0, 4.0]] {
        assert!(contour.joins.iter().any(|j| far(j.point, truth) < 0.05));
    }
}

/// Length of a stadium of two lines of 50 and two half circles of radius 10.
const STADIUM: f64 = 100.0 + 20.0 * std::f64::consts::PI;

/// Its place at a length from where its first line starts.
fn on_stadium(s: f64) -> [f64; 2] {
    let half = 10.0 * std::f64::consts::PI;
    let around = |x: f64, a: f64| {
        let (sin, cos) = libm::sincos(a);
        [x + 10.0 * sin, 10.0 - 10.0 * cos]
    };
    match s {
        s if s < 50.0 => [s, 0.0],
        s if s < 50.0 + half => around(50.0, (s - 50.0) / 10.0),
        s if s < 100.0 + half => [100.0 + half - s, 20.0],
        s => around(0.0, std::f64::consts::PI + (s - 100.0 - half) / 10.0),
    }
}

/// A stadium of `count` points, closed.
fn stadium(count: usize, noise: f64, seed: u64) -> Vec<[f64; 2]> {
    let random = &mut Random::new(seed);
    (0..count)
        .map(|i| on_stadium(STADIUM * i as f64 / count as f64))
        .map(|p| [p[0] + noise * normal(random), p[1] + noise * normal(random)])
        .collect()
}

fn has_the_joins_of_the_stadium(contour: &Contour) {
    assert_eq!(contour.segments.len(), 4, "{:?}", kinds(contour));
    for truth in [[0.0, 0.0], [50.0, 0.0], [50.0, 20.0], [0.0, 20.0]] {
        let join = contour.joins.iter().find(|j| far(j.point, truth) < 0.1);
        assert!(
            join.is_some_and(|j| far(j.point, truth) < 5.0 * j.uncertainty),
            "{truth:?} {:?}",
            contour.joins
        );
    }
}

/// Sums over 100,000 points leave no digits for a part of a hundred, unless the rounding loss is kept.
#[test]
fn a_long_row_has_no_more_segments_than_a_short_one() {
    has_the_joins_of_the_stadium(&found(&stadium(100_000, 0.005, 5)));
}

/// One point in fifty is up to 3 mm off, some of them next to each other: all are left out.
#[test]
fn many_outliers_are_left_out() {
    let mut points = stadium(3000, 0.005, 6);
    let random = &mut Random::new(12);
    let mut wrong: Vec<usize> = (0..60).map(|_| random.below(3000) as usize).collect();
    wrong.sort_unstable();
    wrong.dedup();
    let exact = stadium(3000, 0.0, 0);
    for i in &wrong {
        let (a, b) = (exact[(i + 2999) % 3000], exact[(i + 1) % 3000]);
        let off = (0.5 + 2.5 * random.unit()) * if random.unit() < 0.5 { -1.0 } else { 1.0 } / far(a, b);
        points[*i] = [points[*i][0] + off * (b[1] - a[1]), points[*i][1] - off * (b[0] - a[0])];
    }
    let contour = found(&points);
    has_the_joins_of_the_stadium(&contour);
    assert!(wrong.iter().all(|i| contour.outliers.contains(i)), "{wrong:?} {:?}", contour.outliers);
    let more: Vec<&usize> = contour.outliers.iter().filter(|i| !wrong.contains(i)).collect();
    assert!(more.len() <= 3 && (contour.noise - 0.005).abs() < 0.0005, "{more:?} {}", contour.noise);
}

/// Segments begin and end where their joins are, corners too: a spline with its control points, an arc with its angles.
#[test]
fn segments_end_at_their_joins() {
    for seed in 0..10 {
        let random = &mut Random::new(40 + seed);
        let line = (0..60).map(|i| [f64::from(i) * 0.3 - 18.0, 0.0]);
        let free = (0..80).map(|i| 0.3 * f64::from(i)).map(|s| [0.3 * s + libm::sin(0.4 * s), s]);
        let points: Vec<[f64; 2]> = line
            .chain(free)
            .map(|p| [p[0] + 0.004 * normal(random), p[1] + 0.004 * normal(random)])
            .collect();
        let contour = found(&points);
        assert_eq!(kinds(&contour)[..2], [SegmentKind::Line, SegmentKind::Spline], "{seed}");
        assert_eq!(contour.joins[0].continuity, Continuity::G0);
        let Geometry::Spline { curve, .. } = &contour.segments[1].geometry else { panic!() };
        let ends = [curve.points()[0], curve.points()[curve.points().len() - 1]];
        assert_eq!(ends, [contour.joins[0].point, contour.segments[1].end]);
        let bow =
            (0..40).map(|i| libm::sincos(0.04 * f64::from(i) + 0.01)).map(|(s, c)| [8.0 - 8.0 * c, 8.0 * s]);
        let noisy = |p: [f64; 2], random: &mut Random| p.map(|x| x + 0.004 * normal(random));
        let line = (0..60).map(|i| [f64::from(i) * 0.3 - 17.9, 0.0]);
        let points: Vec<[f64; 2]> = line.chain(bow).map(|p| noisy(p, random)).collect();
        let contour = found(&points);
        assert_eq!(kinds(&contour), [SegmentKind::Line, SegmentKind::Arc], "{seed}");
        let Geometry::Arc { center, radius, start, .. } = contour.segments[1].geometry else { panic!() };
        let (sin, cos) = libm::sincos(start);
        let own = [center[0] + radius * cos, center[1] + radius * sin];
        assert!(far(own, contour.joins[0].point) < 1e-9, "{seed}: {own:?} {:?}", contour.joins[0]);
    }
}

/// A corner is no outlier, however sharp and however coarse the row; one point off on a side is.
#[test]
fn points_at_corners_are_no_outliers() {
    for degrees in [30.0, 60.0, 90.0, 120.0, 150.0_f64] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        for seed in 0..20 {
            let random = &mut Random::new(100 + seed);
            let ratio = 5.0 + 100.0 * random.unit();
            let noise = 0.3 / ratio;
            let shift = 0.3 * random.unit();
            let at = |s: f64| if s < 0.0 { [s, 0.0] } else { [s * cos, s * sin] };
            let mut points: Vec<[f64; 2]> = (-40..40).map(|i| at(0.3 * f64::from(i) + shift)).collect();
            points
                .iter_mut()
                .for_each(|p| *p = [p[0] + noise * normal(random), p[1] + noise * normal(random)]);
            assert_eq!(found(&points).outliers, [0_usize; 0], "{degrees} {seed} {ratio}");
            points[20][1] += 14.0 * noise;
            assert_eq!(found(&points).outliers, [20], "{degrees} {seed} {ratio}");
        }
    }
}

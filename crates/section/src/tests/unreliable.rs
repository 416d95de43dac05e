//! Rows whose chain is easily unreliable: wild, wavy and short ones, and polygons of few points.

use super::*;
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::Curve;

/// Every segment begins where the one before ends, whatever the row: no crossing is sought far from where the points end.
#[test]
fn segments_of_wild_rows_follow_each_other() {
    for seed in 0..8 {
        let random = &mut Random::new(700 + seed);
        // A closed outline of bumps and dents of many sizes.
        let terms: Vec<[f64; 3]> = (2..14)
            .map(|k| [f64::from(k), 6.0 * random.unit() / f64::from(k), 6.3 * random.unit()])
            .collect();
        let count = 150;
        let at = |i: usize| {
            let a = std::f64::consts::TAU * i as f64 / count as f64;
            let r = 12.0 + terms.iter().map(|[k, size, phase]| size * libm::sin(k * a + phase)).sum::<f64>();
            [r * libm::cos(a), r * libm::sin(a)]
        };
        let points: Vec<[f64; 2]> = (0..count)
            .map(at)
            .map(|p| [p[0] + 0.02 * normal(random), p[1] + 0.02 * normal(random)])
            .collect();
        let contour = found(&points);
        let n = contour.segments.len();
        contour.segments.iter().for_each(drawn_as_told);
        for (k, join) in contour.joins.iter().enumerate() {
            let (before, after) = (&contour.segments[k], &contour.segments[(k + 1) % n]);
            assert!(far(before.end, join.point) < 1e-9 && far(after.start, join.point) < 1e-9, "{seed} {k}");
            let nearest = points.iter().map(|p| far(*p, join.point)).fold(f64::INFINITY, f64::min);
            assert!(
                nearest < 6.0 * contour.spacing,
                "{seed}: join {k} is {nearest} off, {}",
                contour.spacing
            );
        }
    }
}

/// The drawing of a free curve is as long as stated, also between the places that it was made from. Its ends may lead
/// to corners that lie beside its chain.
fn drawn_as_told(segment: &Segment) {
    let Geometry::Spline { curve, .. } = &segment.geometry else { return };
    let places: Vec<[f64; 2]> = (0..=20_000).map(|i| curve.at(f64::from(i) / 20_000.0)).collect();
    let drawn: f64 = places.windows(2).map(|w| far(w[0], w[1])).sum();
    assert!((drawn / segment.length - 1.0).abs() < 0.2, "{drawn} drawn, {} told", segment.length);
}

/// A curve is unreliable that is drawn much longer than it is.
#[test]
fn a_curve_that_swings_goes_astray() {
    let knots = Knots::clamped(3, 0.0, &[], 1.0).unwrap();
    let of = |height: f64| {
        let curve =
            Curve::new(knots.clone(), vec![[0.0, 0.0], [1.0, height], [2.0, -height], [3.0, 0.0]]).unwrap();
        Segment::bare(Geometry::Spline { curve, deviation: 0.0 }, [[0.0; 2], [3.0, 0.0]], 3.0, [0.0; 2])
    };
    assert!(!of(0.5).is_overlong() && of(20.0).is_overlong());
}

/// Along every segment the drawn curve is about as long as the way from point to point.
fn runs_along_its_points(points: &[[f64; 2]], contour: &Contour) {
    let n = contour.segments.len();
    for (k, segment) in contour.segments.iter().enumerate() {
        let own: Vec<[f64; 2]> =
            (0..points.len()).filter(|i| contour.labels[*i] == k as u32).map(|i| points[i]).collect();
        let way = own.windows(2).map(|w| far(w[0], w[1])).sum::<f64>();
        let ends = far(segment.start, own[0]) + far(segment.end, own[own.len() - 1]);
        assert!(segment.length <= 1.5 * (way + ends), "{k} of {n}: {} along {way} + {ends}", segment.length);
        drawn_as_told(segment);
    }
}

/// The corners of an exact polygon with few points on each edge are where its edges meet.
#[test]
fn short_exact_triangles_have_their_corners() {
    // With one short edge, then any.
    let mut all = vec![[[5.37356, 5.686722], [5.100787, 6.409844], [-7.549447, -6.118488]]];
    for seed in 0..20 {
        let random = &mut Random::new(300 + seed);
        let turn = 6.3 * random.unit();
        all.push(std::array::from_fn(|k| {
            let (a, r) = (turn + 2.1 * k as f64 + 0.4 * random.unit(), 6.0 + 3.0 * random.unit());
            [r * libm::cos(a), r * libm::sin(a)]
        }));
    }
    for (n, corners) in all.iter().enumerate() {
        let edge = |k: usize| {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            (0..6).map(move |i| f64::from(i) / 6.0).map(move |t| [0, 1].map(|d| a[d] + t * (b[d] - a[d])))
        };
        let points: Vec<[f64; 2]> = (0..3).flat_map(edge).collect();
        let options = Options { closed: Some(true), ..Options::default() };
        let contour = contour(&points, &options, &Silent).unwrap();
        let around: f64 = (0..3).map(|k| far(corners[k], corners[(k + 1) % 3])).sum();
        assert!((contour.length() / around - 1.0).abs() < 1e-3, "{n}: {} of {around}", contour.length());
        assert!(contour.segments.iter().all(|s| s.geometry.kind() == SegmentKind::Line), "{n}");
    }
}

/// The same of polygons of three to seven corners with three to eight points an edge, open and closed, any first.
#[test]
fn exact_polygons_have_their_corners() {
    for seed in 0..120 {
        let random = &mut Random::new(700 + seed);
        let (sides, each) = (3 + random.below(5) as usize, 3 + random.below(6) as usize);
        let corners: Vec<[f64; 2]> = (0..sides)
            .map(|k| {
                let a = (k as f64 + 0.5 * random.unit()) * std::f64::consts::TAU / sides as f64;
                let r = 6.0 + 6.0 * random.unit();
                [50.0 + r * libm::cos(a), r * libm::sin(a) - 7.0]
            })
            .collect();
        let turn = |k: usize| {
            let [a, b, c] = [k, k + 1, k + 2].map(|k| corners[k % sides]);
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
            libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]).abs()
        };
        if (0..sides).any(|k| turn(k) < 0.15) {
            continue;
        }
        let place = |i: usize| {
            let (k, t) = (i / each % sides, (i % each) as f64 / each as f64);
            [0, 1].map(|d| corners[k][d] + t * (corners[(k + 1) % sides][d] - corners[k][d]))
        };
        let (closed, first) = (seed % 2 == 0, random.below(each as u64) as usize);
        let first = if closed { first } else { 0 };
        let count = sides * each;
        let points: Vec<[f64; 2]> = (first..first + count).map(place).collect();
        let options = Options { closed: Some(closed), ..Options::default() };
        let contour = contour(&points, &options, &Silent).unwrap();
        let around = match closed {
            true => (0..sides).map(|k| far(corners[k], corners[(k + 1) % sides])).sum(),
            false => points.windows(2).map(|w| far(w[0], w[1])).sum::<f64>(),
        };
        assert_eq!(kinds(&contour), vec![SegmentKind::Line; sides], "{seed}");
        assert!((contour.length() / around - 1.0).abs() < 1e-5, "{seed}: {} of {around}", contour.length());
        assert!(contour.unreliable.is_empty(), "{seed}");
    }
}

#[test]
fn wavy_closed_rows_are_followed() {
    // Few points a wave and much noise. A loop between two points costs a sum of squares nothing. A chain that was laid
    // out wrong may shrink to nothing where it is closed by force.
    for (count, noise) in [(110, 0.25), (60, 0.3), (40, 0.3)] {
        for seed in 0..8 {
            let mut random = Random::new(900 + seed);
            let waves: Vec<[f64; 3]> =
                (2..9).map(|k| [f64::from(k), 4.0 * random.unit(), 6.3 * random.unit()]).collect();
            let points: Vec<[f64; 2]> = (0..count)
                .map(|i| {
                    let a = f64::from(i) * std::f64::consts::TAU / f64::from(count);
                    let wave = |[k, size, phase]: &[f64; 3]| size / k * libm::sin(k * a + phase);
                    let r = 45.0 + waves.iter().map(wave).sum::<f64>() + noise * normal(&mut random);
                    [r * libm::cos(a), r * libm::sin(a)]
                })
                .collect();
            let found = found(&points);
            runs_along_its_points(&points, &found);
            assert!(found.noise < 4.0, "{count} {seed}: {}", found.noise);
            assert!((240.0..340.0).contains(&found.length()), "{count} {seed}: {}", found.length());
        }
    }
}

/// Corners of a closed polygon on an ellipse, as a plane cuts them out of a cylinder with flat sides.
fn ellipse(count: usize, flat: f64, noise: f64, seed: u64) -> Vec<[f64; 2]> {
    let mut random = Random::new(seed);
    let turn = random.unit();
    let at = |i: usize| (i as f64 + turn) * std::f64::consts::TAU / count as f64;
    (0..count)
        .map(|i| [10.0 * libm::cos(at(i)), 10.0 * flat * libm::sin(at(i))])
        .map(|p| [p[0] + noise * normal(&mut random), p[1] + noise * normal(&mut random)])
        .collect()
}

#[test]
fn short_closed_rows_are_followed() {
    for count in [8, 10, 12, 16, 20, 24, 32, 48, 59, 90] {
        for (k, flat) in [0.35, 0.6, 0.8, 0.97].into_iter().enumerate() {
            for noise in [0.0, 1e-3, 0.02] {
                let points = ellipse(count, flat, noise, 40 + k as u64);
                let options = Options { closed: Some(true), ..Options::default() };
                let found = contour(&points, &options, &Silent).unwrap();
                let way: f64 = (0..count).map(|i| far(points[i], points[(i + 1) % count])).sum();
                let name = format!("{count} {flat} {noise}: {} along {way}", found.length());
                // So few points that curves run through each hold little else.
                let longest = if count < 10 { 1.25 } else { 1.15 };
                assert!((0.97..longest).contains(&(found.length() / way)), "{name}");
                let worst = found.residuals.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
                assert!(worst < 0.3 * way / count as f64, "{name}, {worst} off");
            }
        }
    }
}

#[test]
fn a_square_has_no_tangent_joins() {
    let mut random = Random::new(77);
    let side = |k: usize, t: f64| [[t, 0.0], [10.0, t], [10.0 - t, 10.0], [0.0, 10.0 - t]][k];
    let points: Vec<[f64; 2]> = (0..160)
        .map(|i| side(i / 40, (i % 40) as f64 * 0.25))
        .map(|p| [p[0] + 0.01 * normal(&mut random), p[1] + 0.01 * normal(&mut random)])
        .collect();
    let free = found(&points);
    assert_eq!((kinds(&free), free.joins.len()), (vec![SegmentKind::Line; 4], 4));
    for continuity in [Continuity::G1, Continuity::G2] {
        let forced =
            contour(&points, &Options { continuity: Some(continuity), ..Options::default() }, &Silent);
        match forced {
            Err(SectionError::Unreliable) => {}
            Err(e) => panic!("{e}"),
            Ok(c) => runs_along_its_points(&points, &c),
        }
    }
}

/// Points to and fro between two lines give lines that head exactly the same way. These do not tell where they cross, so that the join has
/// an interval, and an uncertainty above 0.
#[test]
fn joins_of_lines_that_head_the_same_way_have_an_interval() {
    for count in [80, 120, 150] {
        let points: Vec<[f64; 2]> =
            (0..count).map(|k| [29.5 - 0.5 * f64::from(k / 2), 0.5 * f64::from(k % 2)]).collect();
        let joins = found(&points).joins;
        assert!(!joins.is_empty(), "{count}");
        for join in joins {
            let ends = join.interval.iter().flatten();
            assert!(ends.copied().all(f64::is_finite) && join.uncertainty > 0.0, "{count}: {join:?}");
        }
    }
}

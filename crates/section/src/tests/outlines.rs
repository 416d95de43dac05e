//! Outlines of many lines and arcs, with points that scatter as far as they are apart.

use super::*;

/// Points on a polygon with rounded corners, closed, with noise across; and the number of lines and arcs that it is made of. Radii of 0 leave
/// corners. `places` are ascending, as shares of the length.
fn outline(
    corners: &[[f64; 2]],
    radii: &[f64],
    places: &[f64],
    noise: f64,
    random: &mut Random,
) -> (Vec<[f64; 2]>, usize) {
    let n = corners.len();
    let unit = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| (b[k] - a[k]) / far(a, b));
    // Start, direction, length and curvature of each line and arc.
    let mut pieces: Vec<([f64; 2], [f64; 2], f64, f64)> = vec![];
    let reach = |i: usize| {
        let (u, v) = (unit(corners[(i + n - 1) % n], corners[i]), unit(corners[i], corners[(i + 1) % n]));
        let turn = libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
        (turn, radii[i] * libm::tan(0.5 * turn.abs()))
    };
    for i in 0..n {
        let next = (i + 1) % n;
        let along = unit(corners[i], corners[next]);
        let (from, (turn, to)) = (reach(i).1, reach(next));
        let at = |s: f64| [0, 1].map(|k| corners[i][k] + s * along[k]);
        let length = far(corners[i], corners[next]);
        pieces.push((at(from), along, length - from - to, 0.0));
        if radii[next] > 0.0 {
            let arc = (at(length - to), along, radii[next] * turn.abs(), turn.signum() / radii[next]);
            pieces.push(arc);
        }
    }
    let whole: f64 = pieces.iter().map(|p| p.2).sum();
    let point = |place: &f64| {
        let mut s = whole * place;
        let of = pieces.iter().find(|p| {
            let inside = s < p.2;
            s -= if inside { 0.0 } else { p.2 };
            inside
        });
        let (at, [x, y], _, bend) = of.unwrap();
        let (sin, cos) = libm::sincos(bend * s);
        let (ahead, aside) = if *bend == 0.0 { (s, 0.0) } else { (sin / bend, (1.0 - cos) / bend) };
        let off = noise * normal(random);
        let (ahead, aside) = (ahead - off * sin, aside + off * cos);
        [at[0] + ahead * x - aside * y, at[1] + ahead * y + aside * x]
    };
    (places.iter().map(point).collect(), pieces.len())
}

/// Each at a random place of its share.
fn even(count: usize, random: &mut Random) -> Vec<f64> {
    (0..count).map(|i| (i as f64 + 0.2 + 0.6 * random.unit()) / count as f64).collect()
}

/// Teeth whose sides are some ten distances of points whose scatter is as large as these. Local fits of points farther
/// apart hold a corner each, and are none of noise.
#[test]
fn teeth_are_no_noise() {
    let mut corners = vec![];
    for i in 0..24u32 {
        let radius = |out: bool| if out { 18.0 } else { 15.0 };
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / 24.0);
        for out in [i % 2 == 1, i.is_multiple_of(2)] {
            corners.push([radius(out) * cos, radius(out) * sin]);
        }
    }
    for (count, seed) in [(800, 1), (1500, 2), (3000, 3), (5000, 4)] {
        let random = &mut Random::new(seed);
        let (points, pieces) = outline(&corners, &[0.0; 48], &even(count, random), 0.05, random);
        let contour = found(&points);
        assert_eq!(contour.segments.len(), pieces, "{count}: noise {}", contour.noise);
        assert!((contour.noise / 0.05 - 1.0).abs() < 0.1, "{count}: {}", contour.noise);
    }
}

/// Eight teeth with rounded corners, of some six points to a line or arc. They are their lines and arcs, and the noise
/// is that of the points. Where the headings of so many add up to one far off, the search ends elsewhere. Curves of two
/// coefficients follow so few points as well as arcs, but for the penalty. One row of the four may fail.
#[test]
fn a_gear_of_few_points_is_lines_and_arcs() {
    let corners: Vec<[f64; 2]> = (0..32)
        .map(|i| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i / 2) / 16.0);
            let radius = if (i + 1) / 2 % 2 == 0 { 13.0 } else { 18.0 };
            [radius * cos, radius * sin]
        })
        .collect();
    let mut wrong = vec![];
    for seed in 0..4 {
        let random = &mut Random::new(9000 + seed);
        let (points, pieces) = outline(&corners, &[1.2; 32], &even(400, random), 0.001, random);
        let contour = found(&points);
        let is_free = contour.segments.iter().any(|s| s.geometry.kind() == SegmentKind::Spline);
        if is_free || contour.segments.len() != pieces || (contour.noise / 0.001 - 1.0).abs() > 0.2 {
            wrong.push((seed, contour.segments.len(), contour.noise));
        }
    }
    assert!(wrong.len() <= 1, "{wrong:?}");
}

/// The outline of a bracket is its lines and arcs, but for a line of few points that noise may hide. The search begins
/// near them, however the headings of many add up. One row of the 24 may fail.
#[test]
fn a_bracket_is_lines_and_arcs() {
    let corners = [[0.0, 0.0], [60.0, 0.0], [60.0, 10.0], [12.0, 10.0], [12.0, 45.0], [0.0, 45.0]];
    let mut wrong = vec![];
    for (count, noise) in [(1000, 0.05), (2000, 0.02), (3000, 0.05), (3000, 0.02)] {
        for seed in 0..6 {
            let random = &mut Random::new(90 + seed);
            let radii = [4.0, 0.0, 5.0, 8.0, 3.0, 6.0];
            let (mut points, pieces) = outline(&corners, &radii, &even(count, random), noise, random);
            points.rotate_left(seed as usize * count / 7);
            let contour = found(&points);
            let is_free = contour.segments.iter().any(|s| s.geometry.kind() == SegmentKind::Spline);
            if is_free || contour.segments.len() + 1 < pieces || (contour.noise / noise - 1.0).abs() > 0.1 {
                wrong.push((count, noise, seed, contour.segments.len(), contour.noise));
            }
        }
    }
    assert!(wrong.len() <= 1, "{wrong:?}");
}

/// Points at random places of a rounded rectangle, some of them beside gaps in a bend, are no outliers. Nine rows of ten are its lines and
/// arcs.
#[test]
fn points_beside_gaps_in_a_bend_are_no_outliers() {
    let corners = [[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [0.0, 20.0]];
    let random = &mut Random::new(6);
    let mut right = 0;
    for row in 0..40 {
        let mut places: Vec<f64> = (0..400).map(|_| random.unit()).collect();
        places.sort_by(f64::total_cmp);
        let (points, pieces) = outline(&corners, &[5.0, 2.0, 3.0, 4.0], &places, 0.004, random);
        let contour = found(&points);
        assert_eq!(contour.outliers, [0; 0], "{row}");
        right += usize::from(contour.segments.len() == pieces);
    }
    assert!(right >= 36, "{right}");
}

/// Where two curves of a spiral join hardly anything tells: the interval is about the join all the same.
#[test]
fn intervals_are_about_their_joins() {
    let random = &mut Random::new(11);
    for (count, noise) in [(1000, 0.01), (1000, 0.03), (2000, 0.01)] {
        let points: Vec<[f64; 2]> = (0..count)
            .map(|i| f64::from(i) / f64::from(count - 1))
            .map(|t| {
                let (sin, cos) = libm::sincos(60.0 * t);
                [
                    (1.0 + 50.0 * t) * cos + noise * normal(random),
                    (1.0 + 50.0 * t) * sin + noise * normal(random),
                ]
            })
            .collect();
        let contour = found(&points);
        for join in &contour.joins {
            let [a, b] = join.interval;
            let middle = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
            assert!(far(middle, join.point) <= far(a, b), "{count}: {join:?}");
        }
    }
}

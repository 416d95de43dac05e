//! Outlines of many lines and arcs, with points that scatter as far as they are apart.

use super::*;

/// Points on a polygon with rounded corners, closed, each at a random place of its share of the length, with noise across; and the
/// number of lines and arcs that it is made of. Radii of 0 leave corners.
fn outline(
    corners: &[[f64; 2]],
    radii: &[f64],
    count: usize,
    noise: f64,
    seed: u64,
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
    let random = &mut Random::new(seed);
    let point = |i: usize| {
        let mut s = whole * (i as f64 + 0.6 * (random.unit() - 0.5) + 0.5) / count as f64;
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
    ((0..count).map(point).collect(), pieces.len())
}

/// Teeth whose sides are some ten distances of points whose scatter is as large as these: local fits of points farther apart hold a
/// corner each, and are none of noise.
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
        let (points, pieces) = outline(&corners, &[0.0; 48], count, 0.05, seed);
        let contour = found(&points);
        assert_eq!(contour.segments.len(), pieces, "{count}: noise {}", contour.noise);
        assert!((contour.noise / 0.05 - 1.0).abs() < 0.1, "{count}: {}", contour.noise);
    }
}

/// The outline of a bracket is its lines and arcs: the search begins near them, however the headings of many add up.
#[test]
fn a_bracket_is_lines_and_arcs() {
    let corners = [[0.0, 0.0], [60.0, 0.0], [60.0, 10.0], [12.0, 10.0], [12.0, 45.0], [0.0, 45.0]];
    let mut wrong = vec![];
    for (count, noise) in [(1000, 0.05), (2000, 0.02), (3000, 0.05), (3000, 0.02)] {
        for seed in 0..6 {
            let (mut points, pieces) =
                outline(&corners, &[4.0, 0.0, 5.0, 8.0, 3.0, 6.0], count, noise, 90 + seed);
            points.rotate_left(seed as usize * count / 7);
            let contour = found(&points);
            let is_free = contour.segments.iter().any(|s| s.geometry.kind() == SegmentKind::Spline);
            if is_free || contour.segments.len() != pieces || (contour.noise / noise - 1.0).abs() > 0.1 {
                wrong.push((count, noise, seed, contour.segments.len(), contour.noise));
            }
        }
    }
    assert!(wrong.len() <= 1, "{wrong:?}");
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

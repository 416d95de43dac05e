//! Polygons of all shapes are cut into triangles that make them up.

use super::*;

/// Every triangle must point where the polygon does, and their areas must add up to its own.
fn check(outline: &[[f64; 2]], expected: f64) {
    // Lifted into a slanted plane far from the origin.
    let lift = |p: &[f64; 2]| [p[0] + 1e4, p[1] - 1e4, 0.5 * p[0] - 0.25 * p[1]];
    let positions: Vec<Point> = outline.iter().map(lift).collect();
    let corners: Vec<u32> = (0..outline.len() as u32).collect();
    let mut triangles = vec![];
    triangulate(&positions, &corners, |t| triangles.push(t));
    assert_eq!(triangles.len(), outline.len() - 2);
    let z: Vec<f64> = triangles.iter().map(|t| area(&positions, *t)[2]).collect();
    assert!(z.iter().all(|a| *a >= -1e-12), "{z:?}");
    let sum: f64 = z.iter().sum();
    assert!((sum - expected).abs() < 1e-9, "{sum} {expected}");
}

#[test]
fn concave_outlines() {
    check(&[[0., 0.], [4., 0.], [4., 4.], [0., 4.]], 16.0);
    check(&[[0., 0.], [4., 0.], [4., 4.], [2., 1.], [0., 4.]], 10.0);
    // A comb: reflex corners, corners in line.
    check(
        &[[0., 0.], [6., 0.], [6., 5.], [5., 5.], [5., 1.], [4., 1.], [4., 5.], [3., 5.], [3., 1.], [0., 1.]],
        14.0,
    );
    // A star of ten corners, radii 1 and 3.
    let star: Vec<[f64; 2]> = (0..10)
        .map(|i| {
            let (r, a) = (if i % 2 == 0 { 3.0 } else { 1.0 }, f64::from(i) * std::f64::consts::PI / 5.0);
            [r * a.cos(), r * a.sin()]
        })
        .collect();
    check(&star, 15.0 * (std::f64::consts::PI / 5.0).sin());
}

/// The triangles of [`Ears::cut`], found with nothing remembered.
fn plain(places: &[Point2]) -> Vec<[u32; 3]> {
    let (mut left, mut all, mut i) = ((0..places.len()).collect::<Vec<_>>(), vec![], 0);
    while left.len() > 3 {
        let n = left.len();
        let triangle = |k: usize| [left[(k + n - 1) % n], left[k], left[(k + 1) % n]];
        let turns = |k: usize| turn(triangle(k).map(|i| places[i]));
        let ear = |k: usize| {
            let [a, b, c] = triangle(k).map(|i| places[i]);
            let inside = |p: Point2| {
                ![a, b, c].contains(&p) && [[a, b, p], [b, c, p], [c, a, p]].iter().all(|t| turn(*t) >= 0.0)
            };
            turns(k) > 0.0 && !left.iter().any(|i| inside(places[*i]))
        };
        let next = (i..i + n).map(|k| k % n).find(|k| ear(*k));
        i = next.or_else(|| (0..n).find(|k| turns(*k) == 0.0)).unwrap_or(0);
        all.push(triangle(i).map(|i| i as u32));
        left.remove(i);
    }
    all.push([0, 1, 2].map(|k| left[k] as u32));
    all
}

#[test]
fn what_is_remembered_changes_nothing() {
    let random = &mut trueness_geom::num::random::Random::new(5);
    for case in 0..300 {
        let n = 4 + random.below(60) as usize;
        let place = |k: usize| {
            let (r, angle) = (1.0 + random.unit(), k as f64 * std::f64::consts::TAU / n as f64);
            match case % 3 {
                0 => [r * libm::cos(angle), r * libm::sin(angle)],
                1 => [random.unit(), random.unit()],
                _ => [random.below(5) as f64, random.below(5) as f64],
            }
        };
        let places: Vec<Point2> = (0..n).map(place).collect();
        let mut got = vec![];
        let how = Ears::new(places.clone()).cut(MAX_NODE_VISITS, |t| got.push(t));
        assert_eq!(got, plain(&places), "{case}");
        assert!(how == Cut::Whole || case % 3 > 0, "{case}");
    }
}

/// Long outlines are cut as exactly as short ones: combs, slit rings, stars and spirals of many corners.
#[test]
fn long_outlines_are_cut_inside() {
    const N: usize = 20_000;
    let around = |i: usize, turns: f64, r: f64| {
        let angle = turns * std::f64::consts::TAU * i as f64 / N as f64;
        [r * libm::cos(angle), r * libm::sin(angle)]
    };
    let comb = (0..N).map(|i| [i as f64, if i % 2 == 0 { 0.0 } else { 1e4 }]);
    let comb = comb.rev().chain([[0.0, -1.0], [N as f64, -1.0]]).collect::<Vec<_>>();
    let ring = (0..=N).map(|i| around(i, 0.999, 50.0)).chain((0..=N).rev().map(|i| around(i, 0.999, 40.0)));
    let gear = (0..N).map(|i| around(i, 1.0, if i / 2 % 2 == 0 { 50.0 } else { 45.0 }));
    let spiral = (0..=N).map(|i| around(i, 30.0, 10.0 + 90.0 * i as f64 / N as f64));
    let spiral = spiral.chain((0..=N).rev().map(|i| around(i, 30.0, 9.0 + 90.0 * i as f64 / N as f64)));
    for (name, outline) in
        [("comb", comb), ("ring", ring.collect()), ("gear", gear.collect()), ("spiral", spiral.collect())]
    {
        let n = outline.len();
        let positions: Vec<Point> = outline.iter().map(|p| [p[0], p[1], 0.0]).collect();
        let corners: Vec<u32> = (0..n as u32).collect();
        let mut triangles = vec![];
        assert_eq!(triangulate(&positions, &corners, |t| triangles.push(t)), Cut::Whole, "{name}");
        let shoelace: f64 = (0..n).map(|i| turn([[0.0; 2], outline[i], outline[(i + 1) % n]])).sum();
        let areas = triangles.iter().map(|t| 2.0 * area(&positions, *t)[2]);
        assert!(areas.clone().all(|a| a >= 0.0), "{name}");
        assert!((areas.sum::<f64>() / shoelace - 1.0).abs() < 1e-9, "{name}");
    }
}

/// Outlines that cross themselves everywhere take no longer than the bound, and are named.
#[test]
fn crossing_outlines_are_cut_somehow() {
    let star = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) * 10_000.0 / 20_001.0;
        [libm::cos(angle), libm::sin(angle), 0.0]
    };
    let random = &mut trueness_geom::num::random::Random::new(5);
    let stars: Vec<Point> = (0..20_001).map(star).collect();
    let soup: Vec<Point> = (0..20_000).map(|_| [random.unit(), random.unit(), 0.0]).collect();
    let flower: Vec<Point> = (0..20_000).map(|i| if i % 2 == 0 { [0.0; 3] } else { star(i) }).collect();
    for positions in [stars, soup, flower] {
        let corners: Vec<u32> = (0..positions.len() as u32).collect();
        let mut n = 0;
        assert_eq!(triangulate(&positions, &corners, |_| n += 1), Cut::Somehow);
        assert_eq!(n, positions.len() - 2);
    }
}

#[test]
fn degenerate_outlines_still_give_all_triangles() {
    let positions = vec![[0.0; 3]; 5];
    let mut n = 0;
    triangulate(&positions, &[0, 1, 2, 3, 4], |_| n += 1);
    assert_eq!(n, 3);
    triangulate(&positions, &[0, 1], |_| n += 1);
    assert_eq!(n, 3);
    // A bow tie has as much area one way as the other: none to look along.
    let tie = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    triangulate(&tie, &[0, 1, 2, 3], |_| n += 1);
    assert_eq!(n, 5);
}

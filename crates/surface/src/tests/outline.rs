//! Outlines and facets within them, against the points, known areas, and the rules of a closed line of facets.

use super::super::{Outline, trimmed};
use std::collections::HashMap;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::surface::Surface;

const DOMAIN: [(f64, f64); 2] = [(0.0, 100.0), (0.0, 60.0)];

/// So many places of 100 × 60, none within the disks; in rows every `row` mm where that is not 0.
fn places(random: &mut Random, count: usize, disks: &[[f64; 3]], row: f64) -> Vec<[f64; 2]> {
    let mut all = vec![];
    for _ in 0..100 * count {
        let mut p = [100.0 * random.unit(), 60.0 * random.unit()];
        if row > 0.0 {
            p[0] = (p[0] / row).round() * row;
        }
        let within = |d: &[f64; 3]| (p[0] - d[0]).hypot(p[1] - d[1]) < d[2];
        if !disks.iter().any(within) && all.len() < count {
            all.push(p);
        }
    }
    all
}

fn disks(random: &mut Random, count: usize) -> Vec<[f64; 3]> {
    (0..count).map(|_| [100.0 * random.unit(), 60.0 * random.unit(), 3.0 + 20.0 * random.unit()]).collect()
}

fn domain(points: &[[f64; 2]]) -> [(f64, f64); 2] {
    let range = |k: usize| {
        let all = points.iter().map(|p| p[k]);
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    [range(0), range(1)]
}

/// All points that are not left out are within, or on the rim of the domain.
#[test]
fn outlines_hold_their_points() {
    let random = &mut Random::new(1);
    for case in 0..300 {
        let holes = disks(random, case % 9);
        let row = if case % 3 == 0 { 5.0 } else { 0.0 };
        let points = places(random, [20, 100, 500, 3000][case % 4], &holes, row);
        if points.len() < 4 {
            continue;
        }
        let domain = domain(&points);
        let outline = Outline::new(&points, domain, None, &Silent).unwrap();
        let inner = |p: &&[f64; 2]| (0..2).all(|k| domain[k].0 < p[k] && p[k] < domain[k].1);
        let out = points.iter().filter(inner).filter(|p| !outline.holds(**p)).count();
        assert!(out <= outline.left_out, "{case}: {out} of {}, {} left out", points.len(), outline.left_out);
    }
}

/// An L with a hole has its area, within the width by which the outline is set off, and one hole. Only a reach of more
/// than half its width bridges a gap.
#[test]
fn outlines_go_into_corners_holes_and_gaps() {
    let random = &mut Random::new(7);
    let hole = [[30.0, 20.0, 8.0]];
    let in_l = |p: &[f64; 2]| p[0] < 50.0 || p[1] < 30.0;
    let points: Vec<[f64; 2]> = places(random, 60_000, &hole, 0.0).into_iter().filter(in_l).collect();
    let outline = Outline::new(&points, DOMAIN, None, &Silent).unwrap();
    let [region] = &outline.regions[..] else { panic!("{} regions", outline.regions.len()) };
    let (want, cell) = (4500.0 - 64.0 * std::f64::consts::PI, outline.reach / 6.0);
    // 80 mm of rim inside of the rectangle, and that of the hole.
    let set_off = 4.5 * cell * (80.0 + 16.0 * std::f64::consts::PI);
    assert_eq!(region.holes.len(), 1);
    assert!(outline.area() > want && outline.area() < want + set_off, "{} {want} {set_off}", outline.area());
    assert!(!outline.holds([30.0, 20.0]) && !outline.holds([75.0, 45.0]) && outline.holds([75.0, 20.0]));
    let gap = |p: &[f64; 2]| (p[0] - 60.0).abs() > 2.0;
    let parted: Vec<[f64; 2]> = places(random, 60_000, &[], 0.0).into_iter().filter(gap).collect();
    let regions = |reach: f64| Outline::new(&parted, DOMAIN, Some(reach), &Silent).unwrap().regions.len();
    assert_eq!([1.0, 1.7, 2.4, 5.0].map(regions), [2, 2, 1, 1]);
    // A few points far off make no part of their own.
    let mut crumb: Vec<[f64; 2]> = parted.iter().filter(|p| p[0] < 60.0).copied().collect();
    crumb.extend([[90.0, 30.0], [90.1, 30.1]]);
    let outline = Outline::new(&crumb, DOMAIN, None, &Silent).unwrap();
    assert_eq!((outline.regions.len(), outline.left_out), (1, 2));
}

/// Lines of a scanner are one part, however near points lie along them. Places that are there several times are no
/// neighbors, and none of many parts alike is left out.
#[test]
fn outlines_of_lines_copies_and_islands_leave_nothing_out() {
    let random = &mut Random::new(4);
    let lines: Vec<[f64; 2]> = (0..40_000).map(|k| [2.5 * f64::from(k % 41), 60.0 * random.unit()]).collect();
    let grid = |copies: u32| -> Vec<[f64; 2]> {
        (0..41 * 31 * copies).map(|k| [f64::from(k % 41) * 2.5, f64::from(k / 41 % 31) * 2.0]).collect()
    };
    for (name, points) in [("lines", lines), ("once", grid(1)), ("copies", grid(20))] {
        let outline = Outline::new(&points, DOMAIN, None, &Silent).unwrap();
        assert_eq!((outline.regions.len(), outline.left_out), (1, 0), "{name}: {}", outline.reach);
        assert!(outline.area() > 0.95 * 6000.0, "{name}");
        // The rim of the domain is within on all four sides.
        assert!(
            [[0.0, 30.0], [100.0, 30.0], [50.0, 0.0], [50.0, 60.0]].iter().all(|p| outline.holds(*p)),
            "{name}"
        );
    }
    let islands: Vec<[f64; 2]> = (0..28_800)
        .map(|k| [0, 1].map(|j| [f64::from(k % 12), f64::from(k / 12 % 12)][j] * 50.0 + 5.0 * random.unit()))
        .collect();
    let outline = Outline::new(&islands, domain(&islands), Some(1.0), &Silent).unwrap();
    assert_eq!((outline.regions.len(), outline.left_out), (144, 0));
    assert!(outline.reach > outline.wanted);
}

/// Islands that lie nearer together than lines of a scanner may, many and few, with lines or dust beside: they are never joined.
#[test]
fn outlines_keep_islands_apart() {
    let random = &mut Random::new(8);
    for (rows, each, gap) in [(12, 200, 7.0), (12, 16, 7.0), (3, 400, 4.0), (2, 3000, 4.0), (6, 2000, 1.0)] {
        let mut points = vec![];
        for island in 0..rows * rows {
            let corner = [island % rows, island / rows].map(|k| f64::from(k) * (3.0 + gap));
            points.extend((0..each).map(|_| corner.map(|x| x + 3.0 * random.unit())));
        }
        let outline = Outline::new(&points, domain(&points), None, &Silent).unwrap();
        assert_eq!(
            (outline.regions.len(), outline.left_out),
            ((rows * rows) as usize, 0),
            "{rows} {each} {gap}"
        );
        // The gap between them is outside.
        let between = 3.0 + 0.5 * gap;
        assert!(!outline.holds([between, 1.5]) && !outline.holds([between; 2]) && outline.holds([1.5; 2]));
    }
}

/// Nothing to cut along, and rectangles without an inside.
#[test]
fn outlines_of_nothing_are_empty() {
    let none = |points: &[[f64; 2]], domain| Outline::new(points, domain, None, &Silent).unwrap();
    assert_eq!(none(&[], DOMAIN).regions, []);
    assert_eq!(none(&[[1.0, 1.0]; 9], [(1.0, 1.0); 2]).regions, []);
    let line: Vec<[f64; 2]> = (0..50).map(|k| [f64::from(k), 3.0]).collect();
    assert_eq!(none(&line, [(0.0, 49.0), (3.0, 3.0)]).regions, []);
    // Many copies of few places, which no square parts.
    let copies: Vec<[f64; 2]> =
        (0..20_000).map(|k| [100.0 * f64::from(k % 2), 60.0 * f64::from(k % 2)]).collect();
    let outline = none(&copies, DOMAIN);
    assert!(
        copies.iter().all(|p| outline.holds([p[0].clamp(1e-6, 100.0 - 1e-6), p[1].clamp(1e-6, 60.0 - 1e-6)]))
    );
}

/// Facets fill the outline once: every edge inside has two, in opposite directions, and their area is that of the outline. Their boundary
/// is a closed line for each of the outline's, none of which touches another. They keep within the tolerance.
#[test]
fn facets_fill_the_outline_within_the_tolerance() {
    let random = &mut Random::new(3);
    let knots = [Knots::uniform(3, 12, 0.0, 100.0), Knots::uniform(3, 7, 0.0, 60.0)];
    let [us, vs] = [knots[0].greville(), knots[1].greville()];
    let height = |u: f64, v: f64| 6.0 * libm::sin(u / 15.0) * libm::cos(v / 11.0);
    // A graph over its parameters: u and v are x and y.
    let points: Vec<Point> = us.iter().flat_map(|u| vs.iter().map(|v| [*u, *v, height(*u, *v)])).collect();
    let surface = Surface::new(knots, points).unwrap();
    for case in 0..24 {
        let holes = disks(random, case % 6);
        let mut points = places(random, [300, 3000, 9000][case % 3], &holes, 0.0);
        // With long sides across the rows and columns.
        points.retain(|p| case % 2 == 0 || (0.6 * p[0] + 0.8 * p[1] - 54.0).abs() < 22.0);
        let outline = Outline::new(&points, DOMAIN, None, &Silent).unwrap();
        let mesh = trimmed(&surface, &outline, 0.05, 1_000_000, &Silent).unwrap().unwrap();
        let (mut edges, mut area) = (HashMap::new(), 0.0);
        for face in &mesh.faces {
            let [a, b, c] = mesh.places(face);
            area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
            (0..3).for_each(|k| *edges.entry([face[k], face[(k + 1) % 3]]).or_insert(0) += 1);
            for w in [[1.0 / 3.0; 3], [0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]] {
                let p: Point = std::array::from_fn(|k| w[0] * a[k] + w[1] * b[k] + w[2] * c[k]);
                assert!((surface.at(p[0], p[1])[2] - p[2]).abs() <= 0.05, "{case} {p:?}");
            }
        }
        assert!(edges.values().all(|n| *n == 1), "{case}");
        let rim = edges.keys().filter(|[a, b]| !edges.contains_key(&[*b, *a]));
        let mut next: HashMap<u32, u32> = HashMap::new();
        rim.for_each(|[a, b]| assert_eq!(next.insert(*a, *b), None, "{case}"));
        let lines: Vec<&[[f64; 2]]> = outline.regions.iter().flat_map(|r| r.loops()).collect();
        assert!(next.len() >= lines.iter().map(|line| line.len()).sum::<usize>(), "{case}");
        let mut count = 0;
        while let Some(mut at) = next.keys().min().copied() {
            while let Some(further) = next.remove(&at) {
                at = further;
            }
            count += 1;
        }
        assert_eq!(count, lines.len(), "{case}");
        assert!((area - outline.area()).abs() < 1e-8, "{case}: {area} {}", outline.area());
    }
    let all = Outline::new(&places(random, 3000, &[], 0.0), DOMAIN, None, &Silent).unwrap();
    assert!(trimmed(&surface, &all, 1e-4, 1000, &Silent).unwrap().is_none());
}

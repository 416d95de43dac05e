//! Surfaces that have no area, or places without a normal: nearest places as brute force has them, at a bounded cost.

use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Point, minus, norm};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::surface::{Degenerate, Direction, FootSearch, Nurbs};

/// Control points along a direction.
const N: usize = 6;

/// The faults of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Family {
    Sound,
    AllEqual,
    AllEqualAtOrigin,
    AlmostEqual,
    AllEqualButOne,
    CollapsedEdge,
    CollapsedEdges,
    CollapsedRows,
    Collinear,
    Folded,
    Mirrored,
    ClosedInBoth,
    Creased,
    Weights,
    WeightedPole,
    FarPoint,
}

use Family::*;

const FAMILIES: [Family; 16] = [
    Sound,
    AllEqual,
    AllEqualAtOrigin,
    AlmostEqual,
    AllEqualButOne,
    CollapsedEdge,
    CollapsedEdges,
    CollapsedRows,
    Collinear,
    Folded,
    Mirrored,
    ClosedInBoth,
    Creased,
    Weights,
    WeightedPole,
    FarPoint,
];

fn made(family: Family, seed: u64) -> Nurbs {
    let mut random = Random::stream(seed, 11);
    let clamped = |inner: &[f64]| Knots::clamped(3, 0.0, inner, 1.0).unwrap();
    let knots = match family {
        Creased => [clamped(&[0.5, 0.5]), clamped(&[0.3, 0.3])],
        _ => [clamped(&[0.4, 0.6]), clamped(&[0.3, 0.7])],
    };
    let mut points: Vec<(Point, f64)> = (0..N * N)
        .map(|k| ([20.0 * (k / N) as f64, 10.0 * (k % N) as f64, 10.0 * random.unit()], 1.0))
        .collect();
    let at = |i: usize, j: usize| i * N + j;
    match family {
        Sound | Creased => {}
        AllEqual => points.iter_mut().for_each(|p| p.0 = [1.0, 2.0, 3.0]),
        AllEqualAtOrigin => points.iter_mut().for_each(|p| p.0 = [0.0; 3]),
        AlmostEqual => {
            points.iter_mut().for_each(|p| p.0 = [1.0, 2.0, 3.0].map(|x| x + 1e-12 * random.unit()))
        }
        AllEqualButOne => {
            points.iter_mut().for_each(|p| p.0 = [1.0, 2.0, 3.0]);
            points[at(2, 3)].0 = [40.0, 20.0, 10.0];
        }
        CollapsedEdge | WeightedPole => (0..N).for_each(|j| points[at(0, j)].0 = [-10.0, 25.0, 5.0]),
        CollapsedEdges => (0..N).for_each(|j| {
            points[at(0, j)].0 = [-10.0, 25.0, 5.0];
            points[at(N - 1, j)].0 = [110.0, 25.0, 5.0];
        }),
        CollapsedRows => (0..N * N).for_each(|k| points[k].0 = points[at(k / N, 0)].0),
        Collinear => points.iter_mut().for_each(|p| p.0 = [100.0 * random.unit(), 0.0, 3.0]),
        Folded => points.iter_mut().for_each(|p| p.0 = [100.0 * random.unit(), 50.0 * random.unit(), 0.0]),
        Mirrored => (0..N * N).for_each(|k| points[k].0 = points[at((k / N).min(N - 1 - k / N), k % N)].0),
        ClosedInBoth => (0..N).for_each(|j| {
            points[at(N - 1, j)].0 = points[at(0, j)].0;
            points[at(j, N - 1)].0 = points[at(j, 0)].0;
        }),
        Weights => points.iter_mut().for_each(|p| p.1 = libm::pow(10.0, 4.0 * random.unit())),
        FarPoint => points[at(2, 2)].0[2] = 1e7,
    }
    if family == WeightedPole {
        points.iter_mut().for_each(|p| p.1 = 1.0 + random.unit());
    }
    Nurbs::weighted(knots, &points).unwrap()
}

fn asked(seed: u64, count: usize) -> Vec<Point> {
    let mut random = Random::stream(seed, 12);
    let place = |_| [140.0 * random.unit() - 20.0, 90.0 * random.unit() - 20.0, 60.0 * random.unit() - 30.0];
    (0..count).map(place).collect()
}

/// Distances are those of brute force, and what they cost is bounded for every kind.
#[test]
fn nearest_places_are_those_of_brute_force_at_a_bounded_cost() {
    const M: usize = 120;
    let mut sound = 0.0;
    for family in FAMILIES {
        let (mut time, mut cuts, mut most, mut worst, mut uncertain) = (0.0, 0, 0, 0.0f64, 0);
        for seed in 0..5 {
            let (surface, points) = (made(family, seed), asked(seed, 20));
            let at = |k: usize| k as f64 / M as f64;
            let sample: Vec<Point> = (0..(M + 1) * (M + 1))
                .map(|k| surface.at(at(k / (M + 1)), at(k % (M + 1))).unwrap())
                .collect();
            let search = FootSearch::new(std::slice::from_ref(&surface), &Silent).unwrap();
            let start = std::time::Instant::now();
            let found: Vec<_> = points.iter().map(|p| search.nearest(p)).collect();
            time += start.elapsed().as_secs_f64();
            for (p, f) in points.iter().zip(found) {
                let brute = sample.iter().map(|s| norm(minus(*s, *p))).fold(f64::INFINITY, f64::min);
                worst = worst.max(f.foot.distance - brute);
                let [u, v] = f.foot.parameters;
                assert!(norm(minus(surface.at(u, v).unwrap(), f.foot.place)) < 1e-6, "{family:?}");
                uncertain += usize::from(!f.certain);
                cuts += f.cuts;
                most = most.max(f.cuts);
            }
        }
        if family == Sound {
            sound = time;
        }
        eprintln!(
            "{family:?}: {:.1} µs a point ({:.1} times a sound one), {} cuts, at most {most}, {worst:.2e} beyond brute force, {uncertain} uncertain",
            time * 1e4,
            time / sound,
            cuts / 100
        );
        assert!(worst < 1e-8, "{family:?}: {worst}");
        assert!(cuts / 100 <= MEAN_CUTS, "{family:?}: {}", cuts / 100);
    }
}

/// Cuts a point in the mean: each takes about a microsecond.
const MEAN_CUTS: usize = 200;

#[test]
fn what_is_degenerate_is_told() {
    use Direction::{U, V};
    let all = |family| (0..5).map(move |seed| made(family, seed).degenerate());
    for family in FAMILIES {
        let right = match family {
            AllEqual | AllEqualAtOrigin | AlmostEqual => vec![Degenerate::Place],
            Collinear | AllEqualButOne => vec![Degenerate::Line],
            CollapsedRows => vec![Degenerate::Curve(V)],
            CollapsedEdge | WeightedPole => vec![Degenerate::Edge(U, false)],
            CollapsedEdges => vec![Degenerate::Edge(U, false), Degenerate::Edge(U, true)],
            _ => vec![],
        };
        assert!(all(family).all(|found| found == right), "{family:?}");
    }
}

#[test]
fn a_control_point_out_of_all_scale_is_refused() {
    let mut points: Vec<(Point, f64)> = made(Sound, 1).control_points();
    points[14].0[2] = 8.7e15;
    let surface = Nurbs::weighted(made(Sound, 1).knots().clone(), &points).unwrap();
    let found = FootSearch::new(&[surface], &Silent).err().map(|e| e.to_string());
    assert!(found.as_ref().is_some_and(|e| e.contains("control point 14 of surface 0")), "{found:?}");
}

//! The linear programs of the zones against the crate `microlp`, and zones that no linear program can narrow.

use super::{Kind, Made, Method, fitted};
use crate::fit::linear::{Function, lowest};
use crate::num::random::Random;
use crate::shape::Shape;
use microlp::{ComparisonOp, OptimizationDirection, Problem, SolveOutcome, Variable};

/// The least of the greatest function within |x| ≤ reach, by another solver.
fn theirs<const P: usize>(functions: &[Function<P>], reach: f64) -> f64 {
    let mut problem = Problem::new(OptimizationDirection::Minimize);
    let t = problem.add_var(1.0, (f64::NEG_INFINITY, f64::INFINITY));
    let x: [Variable; P] = std::array::from_fn(|_| problem.add_var(0.0, (-reach, reach)));
    for f in functions {
        let terms: Vec<(Variable, f64)> = x.iter().copied().zip(f.slope).chain([(t, -1.0)]).collect();
        problem.add_constraint(&terms[..], ComparisonOp::Le, -f.level);
    }
    let SolveOutcome::Solution(solution) = problem.solve().unwrap() else { panic!() };
    solution.objective()
}

fn random_functions<const P: usize>(random: &mut Random, count: usize) -> Vec<Function<P>> {
    let mut next = || random.unit() - 0.5;
    (0..count).map(|_| Function { level: next(), slope: std::array::from_fn(|_| next()) }).collect()
}

#[test]
fn the_lowest_point_is_that_of_another_solver() {
    fn one<const P: usize>(random: &mut Random) {
        for count in [1, P, P + 1, 5 * P, 60] {
            for reach in [0.01, 0.3, 10.0] {
                let functions = random_functions::<P>(random, count);
                let (ours, theirs) = (lowest(&functions, reach).unwrap().value, theirs(&functions, reach));
                assert!((ours - theirs).abs() < 1e-9, "{P} {count} {reach}: {ours} {theirs}");
            }
        }
    }
    let mut random = Random::new(21);
    for _ in 0..4 {
        one::<2>(&mut random);
        one::<3>(&mut random);
        one::<4>(&mut random);
        one::<5>(&mut random);
        one::<7>(&mut random);
    }
}

/// Numbers of a shape that may be changed one by one, and the shape with some added to them.
fn changed(shape: &Shape, by: &[f64]) -> Shape {
    let unit = |v: [f64; 3]| crate::space::unit(v).unwrap().0;
    let plus = |p: [f64; 3], at: usize| std::array::from_fn(|k| p[k] + by[at + k]);
    match *shape {
        Shape::Plane { point, normal } => {
            Shape::Plane { point: plus(point, 0), normal: unit(plus(normal, 3)) }
        }
        Shape::Sphere { center, radius } => Shape::Sphere { center: plus(center, 0), radius: radius + by[3] },
        Shape::Cylinder { point, direction, radius } => Shape::Cylinder {
            point: plus(point, 0),
            direction: unit(plus(direction, 3)),
            radius: radius + by[6],
        },
        Shape::Circle2 { center, radius } => {
            Shape::Circle2 { center: [center[0] + by[0], center[1] + by[1], 0.0], radius: radius + by[2] }
        }
        _ => panic!("{shape:?}"),
    }
}

/// Half the width of the narrowest zone that small changes reach, by another solver over all points, with slopes by differences.
fn narrowest<const P: usize>(points: &[[f64; 3]], shape: &Shape, length: f64) -> f64 {
    const STEP: f64 = 1e-6;
    // Directions are changed at the lever of the part, so that all unknowns move points alike.
    let lever = |k: usize| if k >= 3 && P > 4 && k < 6 { 1.0 / length } else { 1.0 };
    let at = |k: usize, h: f64| {
        let mut by = [0.0; P];
        by[k] = h * lever(k);
        changed(shape, &by)
    };
    let functions: Vec<Function<P>> = points
        .iter()
        .flat_map(|&p| {
            let level = shape.distance(p);
            let slope: [f64; P] =
                std::array::from_fn(|k| (at(k, STEP).distance(p) - at(k, -STEP).distance(p)) / (2.0 * STEP));
            [Function { level, slope }, Function { level: -level, slope: slope.map(|x| -x) }]
        })
        .collect();
    theirs(&functions, 1e-3)
}

/// At a minimum zone the linear program over all points brings nothing; beside it, it does.
#[test]
fn no_linear_program_narrows_a_minimum_zone() {
    for (kind, seeds) in
        [(Kind::Plane, 0..4), (Kind::Circle2, 0..4), (Kind::Sphere, 0..4), (Kind::Cylinder, 0..4)]
    {
        for seed in seeds {
            let points = Made { kind, count: 120, share: 0.7, noise: 0.05, seed }.points();
            let of = |shape: &Shape| match kind {
                Kind::Plane => narrowest::<6>(&points, shape, 20.0),
                Kind::Circle2 => narrowest::<3>(&points, shape, 20.0),
                Kind::Sphere => narrowest::<4>(&points, shape, 20.0),
                _ => narrowest::<7>(&points, shape, 20.0),
            };
            let zone = fitted(&points, kind, Method::MinimumZone).unwrap();
            let half = 0.5 * zone.residuals.form_error;
            let lower = of(&zone.shape);
            assert!((half - lower).abs() < 1e-6 * half, "{kind:?} {seed}: {half}, a program reaches {lower}");
            let squares = fitted(&points, kind, Method::Gaussian).unwrap();
            let half = squares.residuals.max.0.max(-squares.residuals.min.0);
            assert!(of(&squares.shape) < 0.999 * half, "{kind:?} {seed}: least squares is no zone");
        }
    }
}

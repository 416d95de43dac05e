//! Distances told against those of brute force.

use super::references::points;
use super::*;
use trueness_geom::space::minus;
use trueness_geom::spline::surface::Patches;

/// Steps of the dense sample in both directions.
const STEPS: usize = 200;

/// Least distances of a dense sample, improved by descents from the nearest places of it.
fn brute(surface: &Surface<Point>, points: &[Point]) -> Vec<f64> {
    let patches = Patches::new(surface);
    let domain = surface.domain();
    let at = |k: usize, i: usize| domain[k].0 + (domain[k].1 - domain[k].0) * i as f64 / STEPS as f64;
    let sample: Vec<([f64; 2], Point)> = (0..(STEPS + 1) * (STEPS + 1))
        .map(|n| [at(0, n / (STEPS + 1)), at(1, n % (STEPS + 1))])
        .map(|p| (p, patches.at(p[0], p[1])))
        .collect();
    let least = |p: &Point| {
        let mut all: Vec<(f64, [f64; 2])> = sample.iter().map(|(at, q)| (norm(minus(*q, *p)), *at)).collect();
        all.select_nth_unstable_by(30, |a, b| a.0.total_cmp(&b.0));
        let descent = |(d, at): &(f64, [f64; 2])| patches.foot_from(*p, *at).distance.min(*d);
        all[..30].iter().map(descent).fold(f64::INFINITY, f64::min)
    };
    points.iter().map(least).collect()
}

/// The greatest difference of the answers from brute force.
fn difference(points: &[Point], options: &Options) -> f64 {
    let found = fit(points, options, &Silent).unwrap();
    let patches = Patches::new(&found.surface);
    let least = brute(&found.surface, points);
    let mut most = 0.0f64;
    for (k, p) in points.iter().enumerate() {
        let (told, foot) = (found.deviations[k].abs(), found.feet[k]);
        let own = norm(minus(patches.at(foot[0], foot[1]), *p));
        assert!((own - told).abs() < 1e-12, "{own} {told}");
        most = most.max((told - least[k]).abs());
    }
    most
}

/// One unit long, one unit high: walls on all sides.
fn steep() -> Vec<Point> {
    points("franke_400.txt")
}

#[test]
fn distances_told_are_those_of_the_nearest_places() {
    // Its parameters, seen on a slanting plane, lead to the wrong side of a wall.
    let slanting = difference(&steep(), &Options::default());
    assert!(slanting < 1e-9, "{slanting}");
    for layout in [Layout::Spans([4, 4]), Layout::Tolerance(0.02)] {
        let told = difference(&steep(), &Options { layout, base: BaseKind::Xy, ..Options::default() });
        assert!(told < 1e-9, "{told}");
    }
    // Dimensions of a part, with noise.
    let told = difference(&scan(300, 0.3, 5), &Options::default());
    assert!(told < 1e-9, "{told}");
}

#[test]
fn both_sides_of_a_tear_are_searched() {
    let inner = [0.3, 0.5, 0.5, 0.5, 0.5, 0.8];
    let knots = [Knots::clamped(3, 0.0, &inner, 1.0).unwrap(), Knots::uniform(2, 6, 0.0, 1.0)];
    let layout = Layout::Knots(knots);
    let found =
        fit(&steep(), &Options { layout, base: BaseKind::Xy, ..Options::default() }, &Silent).unwrap();
    // The places of the tear itself are seen from one side alone by brute force.
    let least = brute(&found.surface, &steep());
    assert!(found.deviations.iter().zip(&least).all(|(told, least)| told.abs() < least + 1e-9));
    let same = found.deviations.iter().zip(&least).filter(|(told, least)| (told.abs() - *least).abs() < 1e-9);
    assert!(same.count() > 350);
}

#[test]
fn a_tolerance_is_judged_by_the_nearest_places() {
    let most = |d: &[f64]| d.iter().fold(0.0f64, |m, d| m.max(d.abs()));
    let mut judged = 0;
    for seed in 0..12 {
        let points: Vec<Point> =
            scan(250, 0.0, seed).iter().map(|p| [0.01 * p[0], 0.01 * p[1], 0.1 * p[2]]).collect();
        let options = Options { corrections: 2, ..Options::default() };
        // The first surface on the way to any tolerance.
        let (base, parameters) = base::parameters(&points, options.base, &Silent).unwrap();
        let domain = base::ranges(parameters.iter().copied());
        let spans = refine::first_spans(domain);
        let knots = [0, 1].map(|k| Knots::uniform(3, spans[k], domain[k].0, domain[k].1));
        let local = pass::corrected(&points, parameters.clone(), base, knots, &options, &Silent).unwrap();
        let local = border::reaching_over(&points, local);
        let (far, true_far) = (most(&local.deviations), most(&brute(&local.surface, &points)));
        if far > true_far + 1e-3 {
            judged += 1;
            let tolerance = 0.5 * (far + true_far);
            let task = refine::Task { points: &points, tolerance, options: &options, progress: &Silent };
            let mut rounds = refine::Rounds::new(task, refine::Halved::Longer, base, parameters);
            let refine::Round::Over(found) = rounds.next().unwrap() else { panic!("{seed}") };
            assert_eq!((found.reached, found.surface), (Some(Reached::Tolerance), local.surface), "{seed}");
        }
    }
    assert!(judged > 0);
}

//! Common datums against closed forms, against the fit of all points, and against elements near them.

use std::f64::consts::TAU;
use trueness_geom::fit::{Method, Options, fit};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::rigid::Rigid;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};
use trueness_geom::zone::datum::{Datum, DatumError, Rule, Source, System};
use trueness_geom::zone::parallel_planes;

const RULES: [Rule; 2] = [Rule::Gaussian, Rule::MinimumZone];

/// Circles about (x, y) at these heights.
fn round(at: [f64; 2], radius: f64, levels: &[f64], around: usize) -> Vec<Point> {
    let point = |k: usize, z: f64| {
        let angle = TAU * k as f64 / around as f64;
        [at[0] + radius * angle.cos(), at[1] + radius * angle.sin(), z]
    };
    levels.iter().flat_map(|z| (0..around).map(move |k| point(k, *z))).collect()
}

fn cylinder(points: &[Point]) -> Source<'_> {
    Source { points, kind: Kind::Cylinder, outward: [0.0; 3] }
}

fn plane(points: &[Point], outward: Vector) -> Source<'_> {
    Source { points, kind: Kind::Plane, outward }
}

fn grid(mut f: impl FnMut(f64, f64) -> Point) -> Vec<Point> {
    (0..25).map(|k| f(f64::from(k % 5) * 10.0 - 20.0, f64::from(k / 5) * 10.0 - 20.0)).collect()
}

fn axis(sources: &[Vec<Source>], rule: Rule) -> (Point, Vector) {
    let system = System::associated(sources, rule, &Silent).unwrap();
    match system.datums.last() {
        Some(Datum::Axis { point, direction }) => (*point, *direction),
        other => panic!("{other:?}"),
    }
}

fn median(sources: &[Vec<Source>], rule: Rule) -> (Point, Vector) {
    let system = System::associated(sources, rule, &Silent).unwrap();
    match system.datums.last() {
        Some(Datum::Plane { point, normal }) => (*point, *normal),
        other => panic!("{other:?}"),
    }
}

const OFF: f64 = 1e-3;

/// Two bearings of one shaft, one off by `OFF`, the other by `-OFF`; radii differ.
fn bearings() -> [Vec<Point>; 2] {
    [round([0.0, OFF], 20.0, &[0.0, 10.0], 12), round([0.0, -OFF], 15.0, &[90.0, 100.0], 12)]
}

/// By least squares the slope is that of the regression through the four centers, 180 / 8200 of the offset. By minimum zone it
/// is that of the line nearest to all four, 1 / 45 of it.
#[test]
fn the_axis_of_two_bearings_is_that_of_their_centers() {
    let [a, b] = bearings();
    for (rule, slope) in [(Rule::Gaussian, -180.0 / 8200.0), (Rule::MinimumZone, -1.0 / 45.0)] {
        for sources in [vec![cylinder(&a), cylinder(&b)], vec![cylinder(&b), cylinder(&a)]] {
            let (point, direction) = axis(&[sources], rule);
            let found = direction[1] / direction[2];
            assert!((found - slope * OFF).abs() < 1e-9, "{rule:?}: {found} instead of {}", slope * OFF);
            let middle = point[1] + (50.0 - point[2]) * found;
            // The touching points lie along y: they tell x to the square root of rounding.
            assert!(middle.abs() < 1e-8 && point[0].abs() < 1e-7, "{rule:?}: {point:?}");
        }
    }
}

#[test]
fn common_datums_move_with_the_part() {
    let far = Rigid::rotation_about([1.0, 2.0, 3.0], [0.7, -1.9, 0.4]);
    let far = Rigid::translation_by([120.0, -340.0, 56.0]).after(&far);
    let moved = |points: &[Point]| -> Vec<Point> { points.iter().map(|p| far.point(*p)).collect() };
    let mut random = Random::new(3);
    let mut rough = |points: Vec<Point>| -> Vec<Point> {
        points.into_iter().map(|p| p.map(|x| x + 0.02 * (random.unit() - 0.5))).collect()
    };
    let [a, b] = bearings().map(&mut rough);
    let (c, d) = (rough(grid(|x, z| [x, 0.0, z])), rough(grid(|x, z| [x, 12.0, z])));
    for rule in RULES {
        let (point, direction) = axis(&[vec![cylinder(&a), cylinder(&b)]], rule);
        let (e, f) = (moved(&a), moved(&b));
        let (there, way) = axis(&[vec![cylinder(&e), cylinder(&f)]], rule);
        // An axis has no sense of its own.
        assert!(norm(cross(way, far.vector(direction))) < 1e-9, "{rule:?}");
        let back = minus(far.inverse().point(there), point);
        assert!(norm(cross(back, direction)) < 1e-9, "{rule:?}");

        let (down, up) = ([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]);
        let (point, normal) = median(&[vec![plane(&c, down), plane(&d, up)]], rule);
        let (e, f) = (moved(&c), moved(&d));
        let sources = vec![plane(&e, far.vector(down)), plane(&f, far.vector(up))];
        let (there, way) = median(&[sources], rule);
        assert!(norm(minus(way, far.vector(normal))) < 1e-9, "{rule:?}");
        assert!(dot(minus(far.inverse().point(there), point), normal).abs() < 1e-9, "{rule:?}");
    }
}

/// No axis near the one found has a smaller sum of squares, or a narrower zone, with the best radius of each bearing.
#[test]
fn no_axis_near_it_is_better() {
    for seed in 0..6 {
        let mut random = Random::new(seed);
        let mut rough = |points: Vec<Point>| -> Vec<Point> {
            points.into_iter().map(|p| p.map(|x| x + 0.05 * (random.unit() - 0.5))).collect()
        };
        // A short seat, a long one, and a partial one of other radii.
        let parts = [
            rough(round([0.0; 2], 20.0, &[0.0, 2.0], 30)),
            rough(round([0.0; 2], 15.0, &[60.0, 75.0, 90.0], 40)),
            rough(round([0.0; 2], 8.0, &[95.0, 120.0], 50).into_iter().filter(|p| p[0] > -2.0).collect()),
        ];
        let sources: Vec<Source> = parts.iter().map(|p| cylinder(p)).collect();
        for rule in RULES {
            let (point, direction) = axis(std::slice::from_ref(&sources), rule);
            let cost = |point: Point, way: Vector| -> f64 {
                let mut total = 0.0f64;
                for part in &parts {
                    let r: Vec<f64> = part.iter().map(|p| norm(cross(minus(*p, point), way))).collect();
                    let mean = r.iter().sum::<f64>() / r.len() as f64;
                    let (low, high) =
                        r.iter().fold((f64::INFINITY, 0.0f64), |m, x| (m.0.min(*x), m.1.max(*x)));
                    match rule {
                        Rule::Gaussian => total += r.iter().map(|x| (x - mean).powi(2)).sum::<f64>(),
                        Rule::MinimumZone => total = total.max(high - low),
                    }
                }
                total
            };
            let best = cost(point, direction);
            for size in [1e-2, 1e-4, 1e-6] {
                for _ in 0..200 {
                    let mut step = || [0; 3].map(|_| size * (random.unit() - 0.5));
                    let (shift, tilt) = (step(), times(0.01, step()));
                    let other = cost(plus(point, shift), unit(plus(direction, tilt)).unwrap().0);
                    assert!(other >= best - 1e-11, "{seed} {rule:?} {size}: {other} < {best}");
                }
            }
        }
    }
}

#[test]
fn coplanar_planes_are_one_plane() {
    let mut random = Random::new(8);
    let mut pad = |x0: f64| grid(|x, y| [0.2 * x + x0, y, 0.01 * random.unit()]);
    let pads = [pad(0.0), pad(60.0), pad(120.0)];
    let up = [0.0, 0.0, 1.0];
    let whole: Vec<Point> = pads.iter().flatten().copied().collect();
    for rule in RULES {
        let sources = pads.iter().map(|p| plane(p, up)).collect();
        let found = System::associated(&[sources], rule, &Silent).unwrap();
        let one = System::associated(&[vec![plane(&whole, up)]], rule, &Silent).unwrap();
        assert_eq!(found, one);
    }
}

/// Opposite planes of a block: one flat, one at a slope. By least squares the normal is that of the parallel planes; by
/// minimum zone the slope is shared. Both median planes go through the middle.
#[test]
fn opposite_planes_give_their_median_plane() {
    let slope = 2e-4;
    let (low, high) = (grid(|x, z| [x, 0.0, z]), grid(|x, z| [x, 10.0 + slope * x, z]));
    let (down, up) = ([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]);
    for rule in RULES {
        let (point, normal) = median(&[vec![plane(&low, down), plane(&high, up)]], rule);
        // Both have the same points: half the slope is the best by either rule.
        assert!((normal[0] / normal[1] + 0.5 * slope).abs() < 1e-9, "{rule:?} {normal:?}");
        assert!(normal[1] < 0.0, "{rule:?}: the normal is that of the first plane");
        assert!((dot(point, normal) + 5.0 * normal[1].abs()).abs() < 1e-6, "{rule:?} {point:?}");
    }
    let (pair, _) = parallel_planes(&low, &high).unwrap();
    let (_, normal) = median(&[vec![plane(&low, down), plane(&high, up)]], Rule::Gaussian);
    assert!(norm(cross(pair, normal)) < 1e-12);
    // A bump of 0.02 on one side moves the touching plane there, and so the median plane by half of it.
    let mut bumped = high.clone();
    bumped.iter_mut().for_each(|p| p[1] = 10.0);
    bumped[12][1] = 10.02;
    let (point, normal) = median(&[vec![plane(&low, down), plane(&bumped, up)]], Rule::MinimumZone);
    assert!((normal[1] + 1.0).abs() < 1e-12 && (point[1] - 5.01).abs() < 1e-9, "{normal:?} {point:?}");
}

/// As second datums they keep the attitude of the first.
#[test]
fn common_datums_keep_the_attitude_of_those_before() {
    let floor = grid(|x, y| [x, y, 0.0]);
    let lean = |points: Vec<Point>| -> Vec<Point> {
        points.into_iter().map(|[x, y, z]| [x + 1e-3 * z, y, z]).collect()
    };
    let (a, b) =
        (lean(round([0.0; 2], 5.0, &[0.0, 10.0], 12)), lean(round([0.0; 2], 7.0, &[20.0, 30.0], 12)));
    for rule in RULES {
        let first = vec![plane(&floor, [0.0, 0.0, -1.0])];
        let (point, direction) = axis(&[first.clone(), vec![cylinder(&a), cylinder(&b)]], rule);
        assert!(norm(cross(direction, [0.0, 0.0, 1.0])) < 1e-12);
        // Seen along the normal the centers lie at 0, 0.01, 0.02, 0.03.
        assert!((point[0] - 0.015).abs() < 1e-8, "{rule:?} {point:?}");
        // The zone is held by points along x: its radii take up what a place along y changes.
        let told = if rule == Rule::Gaussian { 1e-9 } else { 0.01 };
        assert!(point[1].abs() < told, "{rule:?} {point:?}");

        // A slot whose sides lean over the floor and turn about its normal.
        let side = |x0: f64| grid(|y, z| [x0 + 1e-3 * z + 2e-3 * y, y, z + 20.0]);
        let (left, right) = (side(-3.0), side(3.0));
        let slot = vec![plane(&left, [1.0, 0.0, 0.0]), plane(&right, [-1.0, 0.0, 0.0])];
        let (_, normal) = median(&[first, slot], rule);
        assert!(normal[2].abs() < 1e-14, "{normal:?}");
        // The lean adds to the scatter across the sides: a millionth of the slope.
        assert!((normal[1] / normal[0] + 2e-3).abs() < 1e-8, "{rule:?} {normal:?}");
    }
}

#[test]
fn features_that_make_no_common_datum_are_refused() {
    let up = [0.0, 0.0, 1.0];
    let (a, beside) = (round([0.0; 2], 5.0, &[0.0, 10.0], 12), round([40.0, 0.0], 5.0, &[0.0, 10.0], 12));
    let (low, high) = (grid(|x, y| [x, y, 0.0]), grid(|x, y| [x, y, 7.0]));
    let slope = grid(|x, y| [x, y, x]);
    let refused = |sources: Vec<Source>| System::associated(&[sources], Rule::Gaussian, &Silent).unwrap_err();
    let says = |e: DatumError, what: &str| assert!(e.to_string().contains(what), "{e}");
    says(
        refused(vec![cylinder(&a), cylinder(&beside)]),
        "common datum 1: its features do not lie about one axis",
    );
    says(refused(vec![plane(&low, up), plane(&high, up)]), "face one way at different heights");
    says(refused(vec![plane(&low, up), cylinder(&a)]), "of nothing else");
    says(refused(vec![plane(&low, up), plane(&slope, up)]), "datum 1 stands at 45.000°");
    says(refused(vec![]), "two or three features");
    let two = [[0.0; 3], [1.0, 0.0, 0.0]];
    let few = refused(vec![plane(&low, up), plane(&two, up)]);
    assert!(matches!(few, DatumError::Fit { datum: 0, .. }), "{few}");
}

/// A cylinder with itself, in two halves, is the cylinder.
#[test]
fn two_halves_are_the_whole() {
    let mut random = Random::new(11);
    let whole: Vec<Point> = round([3.0, 4.0], 12.0, &[0.0, 10.0, 20.0, 30.0], 24)
        .into_iter()
        .map(|p| p.map(|x| x + 0.01 * (random.unit() - 0.5)))
        .collect();
    let (low, high) = whole.split_at(48);
    let (point, direction) = axis(&[vec![cylinder(low), cylinder(high)]], Rule::Gaussian);
    let options = Options { method: Method::Gaussian, ..Options::default() };
    let Shape::Cylinder { point: there, direction: way, .. } =
        fit(&whole, Kind::Cylinder, &options, &Silent).unwrap().shape
    else {
        unreachable!()
    };
    // Each half has a radius of its own: not the same problem, but the same axis within the noise.
    assert!(norm(cross(way, direction)) < 1e-4);
    assert!(norm(cross(minus(there, point), direction)) < 2e-3);
}

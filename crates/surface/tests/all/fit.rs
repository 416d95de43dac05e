//! Surfaces through points: points beyond their border, and where a sphere's poles come to lie.

use std::f64::consts::{FRAC_PI_2, PI};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};
use trueness_geom::spline::surface::{FootSearch, Nurbs, Patches};
use trueness_surface::{BaseKind, Layout, Options, SurfaceFit, fit};

fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

fn turned(random: &mut Random) -> impl Fn(Point) -> Point + use<> {
    let mut vector = || std::array::from_fn(|_| normal(random));
    let z = unit(vector()).unwrap().0;
    let x = unit(cross(vector(), z)).unwrap().0;
    let y = cross(z, x);
    move |p| plus(times(p[0], x), plus(times(p[1], y), times(p[2], z)))
}

/// A patch with noise along its normal, its base, and how much noise.
fn patch(kind: usize, random: &mut Random) -> (Vec<Point>, BaseKind, f64) {
    let noise = 0.005 * (1.0 + 3.0 * random.unit());
    let turn = turned(random);
    let count = 4000;
    let place = |random: &mut Random| {
        let [u, v] = [random.unit(), random.unit()];
        match kind % 7 {
            0 => ([40.0 * u, 25.0 * v, 0.0], [0.0, 0.0, 1.0]),
            1 | 5 => {
                let (n, z) = ([libm::cos(3.0 * u), libm::sin(3.0 * u), 0.0], 60.0 * v);
                ([15.0 * n[0], 15.0 * n[1], z], n)
            }
            2 | 6 => {
                let (a, b) = (1.6 * u, 1.2 * v - 0.4);
                let n = [libm::cos(a) * libm::cos(b), libm::sin(a) * libm::cos(b), libm::sin(b)];
                (times(30.0, n), n)
            }
            3 => {
                let (x, y) = (30.0 * u - 15.0, 20.0 * v - 10.0);
                ([x, y, x * y / 25.0], unit([-y / 25.0, -x / 25.0, 1.0]).unwrap().0)
            }
            _ => {
                let (x, y) = (40.0 * u, 30.0 * v);
                let slopes = [0.4 * libm::cos(0.2 * x), -0.45 * libm::sin(0.15 * y)];
                let z = 2.0 * libm::sin(0.2 * x) + 3.0 * libm::cos(0.15 * y);
                ([x, y, z], unit([-slopes[0], -slopes[1], 1.0]).unwrap().0)
            }
        }
    };
    let base = [
        BaseKind::Plane,
        BaseKind::Cylinder,
        BaseKind::Sphere,
        BaseKind::Plane,
        BaseKind::Xy,
        BaseKind::Plane,
        BaseKind::Plane,
    ][kind % 7];
    let points = (0..count)
        .map(|_| {
            let (p, n) = place(random);
            let off = noise * normal(random);
            let p = plus(p, times(off, n));
            if base == BaseKind::Xy { p } else { turn(p) }
        })
        .collect();
    (points, base, noise)
}

/// Deviations are the distances from the surface as a search on its own has them, none of them along it. Hardly a point
/// is excluded.
#[test]
fn deviations_hold_nothing_along_the_surface() {
    let (mut beyond, mut all, mut along) = (0, 0, 0);
    for seed in 0..14 {
        let random = &mut Random::stream(seed, 3);
        let (points, base, noise) = patch(seed as usize, random);
        let layout = if seed < 7 { Layout::Spans([8, 6]) } else { Layout::Tolerance(8.0 * noise) };
        let reached = matches!(layout, Layout::Tolerance(_));
        let found = fit(&points, &Options { base, layout, ..Options::default() }, &Silent).unwrap();
        let search = FootSearch::new(&[Nurbs::from(found.surface.clone())], &Silent).unwrap();
        for i in found.counted() {
            let own = search.nearest(&points[i]);
            let off = (own.foot.distance - found.deviations[i].abs()).abs();
            assert!(off < 1e-9, "{seed} {base:?} {i}: {} {}", own.foot.distance, found.deviations[i]);
            let across = own.foot.normal.map_or(0.0, |n| dot(n, minus(points[i], own.foot.place)).abs());
            along += usize::from(own.foot.distance - across > 1e-9);
        }
        let worst = found.counted().map(|i| found.deviations[i].abs()).fold(0.0, f64::max);
        eprintln!(
            "{seed} {base:?} noise {noise:.4}: worst {worst:.4}, {} beyond, {:?}",
            found.beyond_border.len(),
            found.reached
        );
        if reached {
            assert_eq!(found.reached.map(|r| r.name()), Some("tolerance"), "{seed}");
        }
        beyond += found.beyond_border.len();
        all += points.len();
    }
    assert_eq!(along, 0);
    assert!(beyond * 2000 < all, "{beyond} of {all}");
}

/// The farthest that two opposite poles can lie from all points, by trial: directions all over, the best of them improved.
fn farthest_poles(directions: &[Vector]) -> f64 {
    let width = |z: Vector| directions.iter().map(|d| dot(*d, z).abs()).fold(0.0, f64::max);
    let golden = PI * (3.0 - 5f64.sqrt());
    let mut best: Vec<(f64, Vector)> = (0..4000)
        .map(|k| {
            let z = (k as f64 + 0.5) / 4000.0;
            let (r, a) = ((1.0 - z * z).sqrt(), golden * k as f64);
            [r * libm::cos(a), r * libm::sin(a), z]
        })
        .map(|z| (width(z), z))
        .collect();
    best.sort_by(|a, b| a.0.total_cmp(&b.0));
    let improved = best.iter().copied().take(6).map(|(mut least, mut z)| {
        let mut step = 0.03;
        while step > 1e-5 {
            let x = unit(cross(z, [0.31, 0.77, 0.55])).unwrap().0;
            let y = cross(z, x);
            let next = (0..12)
                .map(|k| f64::from(k) * PI / 6.0)
                .map(|a| {
                    unit(plus(z, times(step, plus(times(libm::cos(a), x), times(libm::sin(a), y)))))
                        .unwrap()
                        .0
                })
                .map(|z| (width(z), z))
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .unwrap();
            if next.0 < least { (least, z) = next } else { step *= 0.5 }
        }
        least
    });
    libm::acos(improved.fold(1.0, f64::min))
}

/// Points of a sphere of radius 20 that are within a part of it.
fn part(random: &mut Random, count: usize, holds: impl Fn(Vector) -> bool) -> Vec<Point> {
    let turn = turned(random);
    let mut out = vec![];
    while out.len() < count {
        let d = unit(std::array::from_fn(|_| normal(random))).unwrap().0;
        if holds(d) {
            out.push(turn(times(20.0, d)));
        }
    }
    out
}

fn mean_curvatures(found: &SurfaceFit) -> Vec<f64> {
    let patches = Patches::new(&found.surface);
    let mut all: Vec<f64> = found
        .counted()
        .filter_map(|i| patches.bend(found.feet[i][0], found.feet[i][1]))
        .map(|b| b.mean)
        .collect();
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn poles_of_a_sphere_lie_as_far_from_the_points_as_can_be() {
    type Part = (&'static str, fn(Vector) -> bool);
    let parts: [Part; 7] = [
        ("band", |d| d[2].abs() < 0.25),
        ("wide band", |d| d[2].abs() < 0.7),
        ("cap", |d| d[2] > 0.8),
        ("slanted band", |d| d[2] > 0.1 && d[2] < 0.4),
        ("octant", |d| d.iter().all(|x| *x > 0.0)),
        ("strip", |d| d[2].abs() < 0.2 && d[0] > 0.0),
        ("most of a half", |d| d[2] > 0.35),
    ];
    for (name, holds) in parts {
        for seed in 0..2 {
            let random = &mut Random::stream(seed, 5);
            let points = part(random, 1500, holds);
            let options = Options { base: BaseKind::Sphere, layout: Layout::Auto, ..Options::default() };
            let found = fit(&points, &options, &Silent).unwrap();
            let (center, z) = (found.base.origin, found.base.axes[2]);
            let directions: Vec<Vector> = points.iter().map(|p| unit(minus(*p, center)).unwrap().0).collect();
            let own = libm::acos(directions.iter().map(|d| dot(*d, z).abs()).fold(0.0, f64::max));
            let best = farthest_poles(&directions);
            let all = mean_curvatures(&found);
            let [low, high] = [all.len() / 40, all.len() - 1 - all.len() / 40].map(|k| all[k]);
            eprintln!(
                "{name}: poles {:.3}° of {:.3}°, H {low:.5} to {high:.5} (95 %), {:.5} to {:.5}",
                own.to_degrees(),
                best.to_degrees(),
                all[0],
                all[all.len() - 1]
            );
            assert!(own > best - 1e-4, "{name}: {} of {}", own.to_degrees(), best.to_degrees());
            assert_eq!(found.base.pole, own < 10f64.to_radians() - 1e-4, "{name}");
            if own > FRAC_PI_2 / 3.0 {
                assert!([low, high].iter().all(|h| (h.abs() - 0.05).abs() < 0.005), "{name}: {low} {high}");
            }
        }
    }
}

#[test]
fn a_whole_sphere_has_a_pole_among_its_points() {
    let points = part(&mut Random::stream(1, 6), 2000, |_| true);
    let found = fit(&points, &Options { base: BaseKind::Sphere, ..Options::default() }, &Silent).unwrap();
    assert!(found.base.pole);
    assert!(norm(found.base.axes[2]) > 0.999_999);
}

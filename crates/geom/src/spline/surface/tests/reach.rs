//! Bounds of the reach against closed forms and the exact search.

use super::super::{FootSearch, Patches, Surface};
use crate::num::random::Random;
use crate::progress::Silent;
use crate::space::{Point, norm, plus, times};
use crate::spline::basis::Knots;

/// Hills of this height over ten by ten units.
fn hills(height: f64, degree: usize) -> Surface<Point> {
    let knots = Knots::uniform(degree, 6, 0.0, 10.0);
    let (places, n) = (knots.greville(), knots.count());
    let mut random = Random::stream(3, degree as u64);
    let point = |k: usize| [places[k / n], places[k % n], height * random.unit()];
    Surface::new([knots.clone(), knots.clone()], (0..n * n).map(point).collect()).unwrap()
}

#[test]
fn points_within_have_the_foot_they_stand_over() {
    let mut random = Random::stream(8, 1);
    let (mut before, mut within) = (f64::INFINITY, 0);
    for height in [0.1, 0.5, 1.0, 2.0] {
        for degree in [2, 3, 5] {
            let surface = hills(height, degree);
            let patches = Patches::new(&surface);
            let search = FootSearch::new(&[surface.clone().into()], &Silent).unwrap();
            let reach = patches.reach();
            assert!(reach > 0.0 && reach.is_finite(), "{height} {degree}");
            for _ in 0..400 {
                let at = [10.0 * random.unit(), 10.0 * random.unit()];
                let bend = surface.bend(at[0], at[1]).unwrap();
                // Nowhere is it more than a radius of curvature.
                assert!(bend.principal.iter().all(|p| reach * p.curvature.abs() < 1.0));
                let away = 2.0 * (random.unit() - 0.5) * reach;
                let p = plus(surface.at(at[0], at[1]), times(away, bend.normal));
                let found = search.nearest(&p).foot.distance;
                assert!((found - away.abs()).abs() < 1e-12, "{height} {degree}: {found} {away}");
                within += 1;
            }
            if degree == 3 {
                assert!(reach < before, "{reach} {before}");
                before = reach;
            }
        }
    }
    assert_eq!(within, 4800);
}

#[test]
fn a_small_bowl_has_about_half_its_radius() {
    // z = x² + y², with a radius of 0.5 at the bottom.
    let knots = || Knots::uniform(2, 1, -0.01, 0.01);
    let at = [-0.01, 0.0, 0.01];
    let square = |k: usize| if k == 1 { -1e-4 } else { 1e-4 };
    let points = (0..9).map(|k| [at[k / 3], at[k % 3], square(k / 3) + square(k % 3)]).collect();
    let reach = Patches::new(&Surface::new([knots(), knots()], points).unwrap()).reach();
    assert!(reach < 0.25 && reach > 0.2, "{reach}");
}

#[test]
fn heights_over_a_slanting_plane_keep_their_reach() {
    let reach = |slope: f64| {
        let surface = hills(3.0, 3);
        let points = surface.points().iter().map(|p| [p[0], p[1], p[2] + slope * p[0]]).collect();
        Patches::new(&Surface::new(surface.knots().clone(), points).unwrap()).reach()
    };
    // Steeper walls take some of it, not all.
    assert!(reach(2.0) > 0.2 * reach(0.0) && reach(0.0) > 0.0, "{} {}", reach(2.0), reach(0.0));
}

#[test]
fn flat_creased_and_turning_surfaces() {
    let flat = |x: f64| vec![[0.0; 3], [0.0, 3.0, 0.0], [x, 0.0, 1.0], [x, 3.0, 1.0]];
    let line = || Knots::uniform(1, 1, 0.0, 1.0);
    let patches = |knots, points| Patches::new(&Surface::new(knots, points).unwrap());
    assert_eq!(patches([line(), line()], flat(2.0)).reach(), f64::INFINITY);
    // A crease, however shallow.
    let roof =
        vec![[0.0; 3], [0.0, 3.0, 0.0], [1.0, 0.0, 0.1], [1.0, 3.0, 0.1], [2.0, 0.0, 0.0], [2.0, 3.0, 0.0]];
    assert_eq!(patches([Knots::uniform(1, 2, 0.0, 1.0), line()], roof).reach(), 0.0);
    // A sheet rolled up, and a single place.
    let roll = (0..8).flat_map(|k| {
        let (s, c) = (0.9 * f64::from(k)).sin_cos();
        [0.0, 3.0].map(|z| [c, s, z])
    });
    let rolled = patches([Knots::uniform(3, 5, 0.0, 1.0), line()], roll.collect());
    assert_eq!(rolled.reach(), 0.0);
    assert_eq!(patches([line(), line()], vec![[1.0; 3]; 4]).reach(), 0.0);
    assert!(norm(rolled.at(0.5, 0.5)) > 0.0);
}

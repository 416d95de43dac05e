//! Profiles with measures in closed form: envelopes of circles, NACA's four digits, ellipses.

use super::*;
use crate::model::flat::distance;
use crate::{Options, contour};
use std::f64::consts::{PI, TAU};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;

/// The parts of a contour that the measures need.
fn found(points: &[[f64; 2]], closed: bool) -> Contour {
    let length: f64 = points.windows(2).map(|w| distance(w[0], w[1])).sum();
    Contour { closed, spacing: length / points.len() as f64, ..Contour::default() }
}

fn measured(points: &[[f64; 2]]) -> Airfoil {
    airfoil(points, &found(points, true), &Silent).unwrap()
}

/// The envelope of circles with centers on an arc of radius 60 that turns by 0.8, counter-clockwise from the trailing
/// edge. Their radius goes from 1.2 to 0.5 with 2.4 more in the middle.
fn blade(count: usize) -> Vec<[f64; 2]> {
    envelope(count, [1.2, -0.7, 9.6])
}

/// The same of circles of the radius a + b u + c u (1 − u) at the share u of the arc.
fn envelope(count: usize, [a, b, c]: [f64; 3]) -> Vec<[f64; 2]> {
    const BEND: f64 = 60.0;
    const TURN: f64 = 0.8;
    let length = BEND * TURN;
    let center = |s: f64| {
        let (sin, cos) = libm::sincos(s / BEND - 0.5 * TURN);
        ([BEND * sin, BEND * cos], [cos, -sin])
    };
    let radius = |s: f64| a + b * s / length + c * s * (length - s) / (length * length);
    let slope = |s: f64| b / length + c * (length - 2.0 * s) / (length * length);
    // Where the circle at s touches the envelope on either side.
    let touch = |s: f64, side: f64| {
        let (c, t) = center(s);
        let n = [-t[1], t[0]];
        let (r, d) = (radius(s), slope(s));
        let across = side * (1.0 - d * d).sqrt();
        [0, 1].map(|k| c[k] + r * (across * n[k] - d * t[k]))
    };
    let cap = |s: f64, from: [f64; 2], to: [f64; 2], share: f64| {
        let (c, _) = center(s);
        let angle = |p: [f64; 2]| libm::atan2(p[1] - c[1], p[0] - c[0]);
        let sweep = (angle(to) - angle(from)).rem_euclid(TAU);
        let (sin, cos) = libm::sincos(angle(from) + share * sweep);
        [c[0] + radius(s) * cos, c[1] + radius(s) * sin]
    };
    let side = |n: usize| (0..n).map(move |k| k as f64 / n as f64);
    let (flat, round) = (count / 2 - count / 16, count / 16);
    let mut all: Vec<[f64; 2]> = side(flat).map(|t| touch(length * (1.0 - t), 1.0)).collect();
    all.extend(side(round).map(|t| cap(0.0, touch(0.0, 1.0), touch(0.0, -1.0), t)));
    all.extend(side(flat).map(|t| touch(length * t, -1.0)));
    all.extend(side(round).map(|t| cap(length, touch(length, -1.0), touch(length, 1.0), t)));
    all
}

/// Half the thickness of NACA's four digits; with `last` 0.1036 the trailing edge is closed.
fn half(t: f64, x: f64, last: f64) -> f64 {
    5.0 * t * (0.2969 * x.sqrt() - x * (0.1260 + x * (0.3516 - x * (0.2843 - last * x))))
}

/// A profile of four digits: camber `m` at `p`, thickness `t`, from the trailing edge over the upper side.
fn naca(m: f64, p: f64, t: f64, last: f64, count: usize) -> Vec<[f64; 2]> {
    let place = |k: usize| {
        let angle = PI * k as f64 / count as f64;
        let x = 0.5 * (1.0 + libm::cos(angle));
        let (camber, slope) = match () {
            () if m == 0.0 => (0.0, 0.0),
            () if x < p => (m / (p * p) * (2.0 * p - x) * x, 2.0 * m / (p * p) * (p - x)),
            () => {
                let q = (1.0 - p) * (1.0 - p);
                (m / q * (1.0 - 2.0 * p + (2.0 * p - x) * x), 2.0 * m / q * (p - x))
            }
        };
        let y = half(t, x, last) * if k <= count { 1.0 } else { -1.0 };
        let size = libm::hypot(1.0, slope);
        [x - y * slope / size, camber + y / size]
    };
    (0..=2 * count).map(place).collect()
}

#[test]
fn circles_along_an_arc_are_found_again() {
    let points = blade(800);
    let found = measured(&points);
    let (sin, cos) = libm::sincos(0.4);
    // The chord lies on the line through the centers of both ends.
    assert!((found.chord - (120.0 * sin + 1.7)).abs() < 2e-4, "{}", found.chord);
    assert!((found.camber.abs() - 60.0 * (1.0 - cos)).abs() < 1e-3, "{}", found.camber);
    // Radius 1.2 − 0.7 u + 9.6 u (1 − u): greatest at u = 8.9 / 19.2.
    let u = 8.9 / 19.2;
    let most = 1.2 - 0.7 * u + 9.6 * u * (1.0 - u);
    assert!((found.thickness - 2.0 * most).abs() < 1e-4, "{}", found.thickness);
    // Its center is on the arc, seen from both ends of the chord.
    let at = (1.2 + 60.0 * (sin - libm::sin(0.4 - 0.8 * u))) / found.chord;
    assert!((found.thickness_at - at).abs() < 1e-3, "{} {at}", found.thickness_at);
    assert_eq!(found.trailing_edge, TrailingEdge::Round);
    let (lead, trail) = (found.leading_radius.unwrap(), found.trailing_radius.unwrap());
    assert!((lead.radius - 1.2).abs() < 0.01, "{lead:?}");
    assert!((trail.radius - 0.5).abs() < 0.01, "{trail:?}");
    // Every center of the camber line is on the arc.
    assert!(found.camber_line.iter().all(|(c, _)| (libm::hypot(c[0], c[1]) - 60.0).abs() < 2e-3));
    assert!(distance(found.camber_line[0].0, found.leading) < 2.0);
}

#[test]
fn four_digits_are_found_again() {
    for (m, p) in [(0.0, 0.4), (0.02, 0.4), (0.04, 0.4)] {
        for t in [0.06, 0.12, 0.18] {
            let found = measured(&naca(m, p, t, 0.1036, 150));
            let brief = Airfoil { camber_line: vec![], ..found.clone() };
            let name = format!("{m} {p} {t}: {brief:?}");
            // The thickness is greatest where its slope is 0; there the circle touches at right angles to the camber line.
            let x = (280..320)
                .map(|k| f64::from(k) * 1e-3)
                .max_by(|a, b| half(t, *a, 0.1036).total_cmp(&half(t, *b, 0.1036)));
            let most = 2.0 * half(t, x.unwrap(), 0.1036);
            assert!((found.thickness - most).abs() < 1e-5, "{most} {name}");
            assert!((found.thickness_at - 0.3).abs() < 5e-3, "{name}");
            // The leading edge is the place farthest from the trailing one: by brute force, of camber a little above 0.
            let lead = naca(m, p, t, 0.1036, 20_000);
            let lead =
                lead.iter().max_by(|a, b| distance(**a, [1.0, 0.0]).total_cmp(&distance(**b, [1.0, 0.0])));
            let lead = *lead.unwrap();
            let chord = distance(lead, [1.0, 0.0]);
            assert!((found.chord - chord).abs() < 1e-5, "{chord} {name}");
            assert!(distance(found.leading, lead) < 3e-4, "{lead:?} {name}");
            // Heights of the parabolas' camber above that chord; centers of circles leave it by the square of the slopes.
            let above = |k: u32| {
                let x = f64::from(k) * 1e-3;
                let y = if x < p {
                    m / (p * p) * (2.0 * p - x) * x
                } else {
                    m / ((1.0 - p) * (1.0 - p)) * (1.0 - 2.0 * p + (2.0 * p - x) * x)
                };
                ((1.0 - lead[0]) * (y - lead[1]) + lead[1] * (x - lead[0])) / chord
            };
            let most = (0..1000).map(above).fold(0.0, f64::max);
            // Points at the nose are 0.0018 apart and more: an arc of radius 0.004 bulges 1e-4 between them.
            assert!((found.camber - most).abs() < 1e-4 + 0.005 * m, "{most} {name}");
            // The radius at the very front; the local curve spreads over a bend that opens on both sides.
            let lead = found.leading_radius.unwrap().radius;
            assert!((lead / (1.1019 * t * t) - 1.0).abs() < 0.1, "{lead} {name}");
        }
    }
}

#[test]
fn trailing_edges_are_told_apart() {
    let sharp = measured(&naca(0.02, 0.4, 0.12, 0.1036, 80));
    assert_eq!(sharp.trailing_edge, TrailingEdge::Sharp);
    assert_eq!(sharp.trailing_radius, Err(AirfoilError::Cornered("sharp")));
    // Cut off: the last coefficient leaves 0.0126 times the thickness on each side.
    let cut = measured(&naca(0.0, 0.4, 0.12, 0.1015, 80));
    let TrailingEdge::Blunt(gap) = cut.trailing_edge else { panic!("{:?}", cut.trailing_edge) };
    assert!((gap - 2.0 * half(0.12, 1.0, 0.1015)).abs() < 1e-9);
    assert!((cut.chord - 1.0).abs() < 1e-4);
    let points = naca(0.0, 0.4, 0.12, 0.1015, 80);
    let open = airfoil(&points, &found(&points, false), &Silent).unwrap();
    assert!(matches!(open.trailing_edge, TrailingEdge::Open(_)), "{:?}", open.trailing_edge);
    assert!((open.thickness - cut.thickness).abs() < 1e-6);
    // Few points of seven decimals, as catalogs have them: both corners are one of the contour, between the ends.
    for count in [30, 34, 50] {
        let points = naca(0.0, 0.4, 0.12, 0.1015, count);
        let rounded: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| (x * 1e7).round() / 1e7)).collect();
        let cut = measured(&rounded);
        let TrailingEdge::Blunt(gap) = cut.trailing_edge else { panic!("{count}: {:?}", cut.trailing_edge) };
        assert!((gap - 2.0 * half(0.12, 1.0, 0.1015)).abs() < 2e-7, "{count}: {gap}");
    }
}

#[test]
fn where_a_row_begins_and_how_it_lies_does_not_matter() {
    let points = blade(400);
    let first = measured(&points);
    let (sin, cos) = libm::sincos(2.3);
    for by in [50, 130, 333] {
        let mut moved: Vec<[f64; 2]> = points.clone();
        moved.rotate_left(by);
        let mut other: Vec<[f64; 2]> =
            moved.iter().map(|p| [cos * p[0] - sin * p[1] + 7.0, sin * p[0] + cos * p[1] - 4.0]).collect();
        let turned = measured(&other);
        other.reverse();
        let reversed = measured(&other);
        for found in [turned, reversed] {
            // Points of the trailing edge are 0.06 apart: an arc of radius 0.5 bulges 9e-4 between them.
            assert!((found.chord - first.chord).abs() < 9e-4, "{} {}", found.chord, first.chord);
            assert!((found.thickness - first.thickness).abs() < 1e-4);
            // A place z across the chord on the leading edge (radius 1.2) is nearer by z²/2.4: by as much as the bulge
            // at z = 0.047. The distance from the chord in the middle may differ by half of that.
            assert!((found.camber - first.camber).abs() < 0.023, "{} {}", found.camber, first.camber);
            let (a, b) = (found.leading_radius.unwrap(), first.leading_radius.unwrap());
            assert!((a.radius - b.radius).abs() < 0.01);
        }
    }
}

#[test]
fn noise_changes_measures_by_what_is_stated() {
    let exact = blade(600);
    let random = &mut Random::new(3);
    let noise = 0.01;
    let (mut thick, mut lead, mut runs) = (0.0, 0.0, 0.0);
    let u = 8.9 / 19.2;
    let most = 2.0 * (1.2 - 0.7 * u + 9.6 * u * (1.0 - u));
    for _ in 0..40 {
        let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
        let points: Vec<[f64; 2]> =
            exact.iter().map(|p| [p[0] + noise * normal(), p[1] + noise * normal()]).collect();
        let found = measured(&points);
        assert_eq!(found.trailing_edge, TrailingEdge::Round);
        thick += ((found.thickness - most) / found.thickness_uncertainty).powi(2);
        let edge = found.leading_radius.unwrap();
        lead += ((edge.radius - 1.2) / edge.uncertainty).powi(2);
        runs += 1.0;
    }
    // Standardized squares: 1 on average, with a standard deviation of √(2 / 40).
    let [thick, lead] = [thick / runs, lead / runs];
    assert!((0.3..2.0).contains(&thick) && (0.3..2.0).contains(&lead), "{thick} {lead}");
}

/// Over fresh noise the measures lie within twice their uncertainties as often as they should. So do those of edges of
/// fifty times the scatter, and of a blade of one thickness. The greatest circle of such a blade is the one that
/// scatter makes greatest.
#[test]
fn uncertainties_hold_over_fresh_noise() {
    let u = 8.9 / 19.2;
    let most = 2.0 * (1.2 - 0.7 * u + 9.6 * u * (1.0 - u));
    for (form, thick, radii, count, noise) in
        [([1.2, -0.7, 9.6], most, [1.2, 0.5], 160, 0.01), ([1.2, 0.0, 0.0], 2.4, [1.2, 1.2], 160, 0.02)]
    {
        let (exact, random) = (envelope(count, form), &mut Random::new(count as u64));
        let (mut off, mut within, mut all) = (0.0, [0, 0], [0, 0]);
        for _ in 0..16 {
            let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
            let points: Vec<[f64; 2]> =
                exact.iter().map(|p| [p[0] + noise * normal(), p[1] + noise * normal()]).collect();
            let row = contour(&points, &Options::default(), &Silent).unwrap();
            let found = airfoil(&points, &row, &Silent).unwrap();
            off += ((found.thickness - thick) / found.thickness_uncertainty).powi(2) / 16.0;
            for (k, edge) in [found.leading_radius, found.trailing_radius].into_iter().enumerate() {
                if let Ok(edge) = edge {
                    // Both ends of a blade of one thickness are alike.
                    within[k] += i32::from((edge.radius - radii[k]).abs() < 2.0 * edge.uncertainty);
                    all[k] += 1;
                }
            }
        }
        let name = format!("{form:?} {noise}: {off} {within:?} of {all:?}");
        // The mean of 16 standardized squares is uncertain by 0.35: three of that.
        assert!(off < 2.05, "{name}");
        // 95 of 100 are to be within; of 16 two fewer than that by chance in one case of 50.
        assert!((0..2).all(|k| all[k] >= 8 && within[k] * 100 >= 81 * all[k]), "{name}");
    }
}

/// A figure of eight has no inside, and is no profile; scatter about a sharp edge is no crossing.
#[test]
fn profiles_that_cross_themselves_are_refused() {
    for noise in [0.0, 0.02] {
        let random = &mut Random::new(2);
        let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
        let mut noisy = |p: [f64; 2]| p.map(|x| x + noise * normal());
        for lobe in [0.3, 1.0] {
            // The one lobe is smaller.
            let eight: Vec<[f64; 2]> = (0..200)
                .map(|i| libm::sincos((f64::from(i) + 0.3) * TAU / 200.0))
                .map(|(s, c)| if s < 0.0 { (s * lobe, c * lobe) } else { (s, c) })
                .map(|(s, c)| noisy([40.0 * s, 10.0 * s * c]))
                .collect();
            let row = contour(&eight, &Options::default(), &Silent).unwrap();
            let refused = airfoil(&eight, &row, &Silent);
            assert!(matches!(refused, Err(AirfoilError::Crosses { .. })), "{noise} {lobe} {refused:?}");
        }
        let sharp = naca(0.02, 0.4, 0.12, 0.1036, 60);
        let sharp: Vec<[f64; 2]> = sharp.iter().map(|p| noisy([40.0 * p[0], 40.0 * p[1]])).collect();
        let row = contour(&sharp, &Options::default(), &Silent).unwrap();
        let outcome = airfoil(&sharp, &row, &Silent);
        assert!(outcome.is_ok(), "{noise} {outcome:?}");
    }
}

#[test]
fn what_is_no_profile_is_refused() {
    let line: Vec<[f64; 2]> = (0..40).map(|i| [f64::from(i), 0.0]).collect();
    let refused = |points: &[[f64; 2]]| airfoil(points, &found(points, false), &Silent).unwrap_err();
    assert!(matches!(refused(&line), AirfoilError::Open { .. }));
    assert!(matches!(refused(&line[..6]), AirfoilError::TooFewPoints { found: 6 }));
}

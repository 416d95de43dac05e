//! Planted motions come back within their uncertainties, held motions stay, and free ones are named.

use super::*;
use crate::Segment;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;

fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// A plate of 60 by 30 with a corner of radius 8: lines and an arc.
fn plate() -> Outline {
    let segments = vec![
        Segment::straight([0.0, 0.0], [60.0, 0.0]),
        Segment::straight([60.0, 0.0], [60.0, 22.0]),
        Segment::arc([52.0, 22.0], 8.0, 0.0, FRAC_PI_2),
        Segment::straight([52.0, 30.0], [0.0, 30.0]),
        Segment::straight([0.0, 30.0], [0.0, 0.0]),
    ];
    Outline { segments, closed: true }
}

/// An ellipse of 20 by 12 in chords.
fn ellipse(count: usize) -> Outline {
    let at = |i: usize| {
        let (sin, cos) = libm::sincos(TAU * i as f64 / count as f64);
        [20.0 * cos, 12.0 * sin]
    };
    Outline::polyline(&(0..count).map(at).collect::<Vec<_>>(), true)
}

/// Points at random places of an outline, in its order, that scatter across by `noise`.
fn measured(outline: &Outline, count: usize, noise: f64, random: &mut Random) -> Vec<[f64; 2]> {
    let total = outline.length();
    let mut at: Vec<f64> = (0..count).map(|_| total * random.unit()).collect();
    at.sort_by(f64::total_cmp);
    let place = |along: f64| {
        let mut rest = along;
        let s = outline.segments.iter().find(|s| {
            rest -= s.length;
            rest < 0.0
        });
        let s = s.unwrap_or(&outline.segments[0]);
        s.place((rest + s.length) / s.length)
    };
    at.into_iter().map(place).map(|p| p.map(|x| x + noise * normal(random))).collect()
}

fn onto(points: &[[f64; 2]], outline: &Outline, freedom: Freedom) -> Result<OntoNominal, OntoNominalError> {
    onto_nominal(&[points], std::slice::from_ref(outline), freedom, f64::INFINITY, &Silent)
}

/// At least 93 % of the 720 errors of 240 draws with a motion planted are within two standard uncertainties, and not
/// all.
#[test]
fn planted_motions_come_back_within_their_uncertainties() {
    let random = &mut Random::new(11);
    for (outline, count) in [(plate(), 150), (ellipse(240), 200)] {
        let (mut held, mut draws, mut ratios) = (0, 0, vec![]);
        for _ in 0..120 {
            let points = measured(&outline, count, 0.01, random);
            let planted = PlaneMotion {
                center: [0.0; 2],
                turn: 0.1 * (random.unit() - 0.5),
                shift: [random.unit() - 0.5, random.unit() - 0.5],
            };
            let moved: Vec<[f64; 2]> = points.iter().map(|p| planted.apply(*p)).collect();
            let found = onto(&moved, &outline, Freedom::FREE).unwrap();
            assert!(found.converged && found.used == count, "{found:?}");
            // Where the center goes, it came from.
            let back = planted.inverse().apply(found.motion.center);
            let there = found.motion.apply(found.motion.center);
            let errors = [
                (there[0] - back[0], found.shift_uncertainty[0]),
                (there[1] - back[1], found.shift_uncertainty[1]),
                (found.motion.turn + planted.turn, found.turn_uncertainty),
            ];
            for (error, u) in errors {
                held += usize::from(error.abs() <= 2.0 * u);
                draws += 1;
                ratios.push((error / u).powi(2));
            }
        }
        let share = f64::from(held as u32) / f64::from(draws as u32);
        let square = ratios.iter().sum::<f64>() / ratios.len() as f64;
        assert!((0.93..0.995).contains(&share), "{share} {square}");
        assert!((0.7..1.25).contains(&square), "{square}");
    }
}

/// A motion that is not free stays as it is, to the last digit.
#[test]
fn what_is_held_stays() {
    let random = &mut Random::new(2);
    let points = measured(&plate(), 200, 0.005, random);
    let by = |x: f64, y: f64| points.iter().map(|p| [p[0] + x, p[1] + y]).collect::<Vec<_>>();
    let x = onto(&by(0.3, -0.2), &plate(), Freedom::X).unwrap();
    assert!((x.motion.shift[0] + 0.3).abs() < 4.0 * x.shift_uncertainty[0] + 0.05, "{x:?}");
    assert_eq!((x.motion.shift[1], x.motion.turn), (0.0, 0.0));
    assert_eq!((x.shift_uncertainty[1], x.turn_uncertainty), (0.0, 0.0));
    let y = onto(&by(0.0, 0.25), &plate(), Freedom::Y).unwrap();
    assert_eq!((y.motion.shift[0], y.motion.turn), (0.0, 0.0));
    assert!((y.motion.shift[1] + 0.25).abs() < 4.0 * y.shift_uncertainty[1], "{y:?}");
    let both = onto(&by(0.3, -0.2), &plate(), Freedom::SHIFT).unwrap();
    assert!((both.motion.shift[1] - 0.2).abs() < 4.0 * both.shift_uncertainty[1] && both.motion.turn == 0.0);
    // A turn alone is about the origin.
    let turned = PlaneMotion { center: [0.0; 2], turn: 0.02, shift: [0.0; 2] };
    let there: Vec<[f64; 2]> = points.iter().map(|p| turned.apply(*p)).collect();
    let turn = onto(&there, &plate(), Freedom::TURN).unwrap();
    assert_eq!((turn.motion.shift, turn.motion.center), ([0.0; 2], [0.0; 2]));
    assert!((turn.motion.turn + 0.02).abs() < 4.0 * turn.turn_uncertainty, "{turn:?}");
}

/// A motion that the outline does not hold is named; a polygon that follows a circle turns as that does.
#[test]
fn what_is_free_is_named() {
    let random = &mut Random::new(3);
    let line = Outline::polyline(&[[0.0, 0.0], [50.0, 0.0]], false);
    let circle = Outline { segments: vec![Segment::arc([5.0, 2.0], 10.0, 0.0, TAU)], closed: true };
    let polygon = |n: usize| {
        let at = |i: usize| libm::sincos(TAU * i as f64 / n as f64);
        let points: Vec<[f64; 2]> = (0..n).map(at).map(|(s, c)| [5.0 + 10.0 * c, 2.0 + 10.0 * s]).collect();
        Outline::polyline(&points, true)
    };
    let half = Outline { segments: vec![Segment::arc([5.0, 2.0], 10.0, 0.0, PI)], closed: false };
    for outline in [&circle, &polygon(30), &polygon(200), &half] {
        let points = measured(outline, 150, 0.001, random);
        let Err(OntoNominalError::Undetermined { free: Free::Turns { center }, remedy }) =
            onto(&points, outline, Freedom::FREE)
        else {
            panic!("{outline:?}")
        };
        assert!((center[0] - 5.0).abs() < 0.3 && (center[1] - 2.0).abs() < 0.3, "{center:?}");
        assert_eq!(remedy, "ask for --fit xy");
        assert!(onto(&points, outline, Freedom::SHIFT).is_ok());
    }
    let points: Vec<[f64; 2]> = (1..50).map(|i| [f64::from(i), 0.01 * normal(random)]).collect();
    for freedom in [Freedom::FREE, Freedom::SHIFT, Freedom::X] {
        let found = onto(&points, &line, freedom);
        let Err(OntoNominalError::Undetermined { free: Free::Slides { direction }, .. }) = found else {
            panic!("{freedom:?} {found:?}")
        };
        assert!((direction[0] - 1.0).abs() < 1e-6, "{direction:?}");
    }
    assert!(onto(&points, &line, Freedom::Y).is_ok());
    // An octagon does not turn.
    let points = measured(&polygon(8), 200, 0.001, random);
    assert!(onto(&points, &polygon(8), Freedom::FREE).is_ok());
}

/// Points without a counterpart do not lead the fit where it is said how far others may be.
#[test]
fn points_without_a_counterpart_are_left_out() {
    let random = &mut Random::new(4);
    let mut points = measured(&plate(), 300, 0.005, random);
    let planted = PlaneMotion { center: [30.0, 15.0], turn: 0.01, shift: [0.2, -0.1] };
    points.iter_mut().for_each(|p| *p = planted.apply(*p));
    let sound = onto(&points, &plate(), Freedom::FREE).unwrap();
    points.extend((0..60).map(|i| [20.0 + 0.1 * f64::from(i), 36.0 + 0.01 * f64::from(i)]));
    let all = onto(&points, &plate(), Freedom::FREE).unwrap();
    let found = onto_nominal(&[&points], &[plate()], Freedom::FREE, 1.0, &Silent).unwrap();
    assert_eq!((found.used, found.left_out), (300, 60));
    let off = |f: &OntoNominal| (f.motion.turn - sound.motion.turn).abs() / sound.turn_uncertainty;
    assert!(off(&found) < 1e-3 && off(&all) > 5.0, "{} {}", off(&found), off(&all));
    // Before and after, of the points that count.
    assert!(found.rms < 0.006 && found.rms_before > 0.1, "{found:?}");
}

/// Deviations that go together along the row tell less than as many that do not.
#[test]
fn correlated_deviations_are_less_certain() {
    let random = &mut Random::new(5);
    let plain = onto(&measured(&ellipse(240), 400, 0.01, random), &ellipse(240), Freedom::FREE).unwrap();
    let waves: Vec<[f64; 2]> = (0..400)
        .map(|i| {
            let (sin, cos) = libm::sincos(TAU * f64::from(i) / 400.0);
            let (r, _) = libm::sincos(7.0 * TAU * f64::from(i) / 400.0);
            [(20.0 + 0.014 * r) * cos, (12.0 + 0.014 * r) * sin]
        })
        .collect();
    let waves = onto(&waves, &ellipse(240), Freedom::FREE).unwrap();
    assert!(plain.correlated < 1.8 && waves.correlated > 8.0, "{} {}", plain.correlated, waves.correlated);
    assert!(waves.turn_uncertainty > 2.0 * plain.turn_uncertainty);
}

/// Errors that name their place and remedy.
#[test]
fn too_few_points_and_no_outline() {
    let none = onto_nominal(&[&[[0.0; 2]; 9]], &[], Freedom::FREE, 1.0, &Silent).unwrap_err();
    assert_eq!(none, OntoNominalError::NoOutline);
    let points = [[1.0, 0.1], [30.0, 0.1], [60.0, 10.0]];
    let error = onto(&points, &plate(), Freedom::FREE).unwrap_err();
    assert_eq!(error, OntoNominalError::TooFewPoints { found: 3, unknowns: 3 });
    let far: Vec<[f64; 2]> = (0..20).map(|i| [f64::from(i), -9.0]).collect();
    let found = onto_nominal(&[&far], &[plate()], Freedom::X, 1.0, &Silent);
    assert!(found.is_err(), "{found:?}");
}

/// A segment moved is the same one elsewhere: distances of moved points stay.
#[test]
fn outlines_move_rigidly() {
    let motion = PlaneMotion { center: [3.0, -2.0], turn: 0.7, shift: [5.0, 1.0] };
    let random = &mut Random::new(6);
    let points: Vec<[f64; 2]> =
        (0..50).map(|_| [80.0 * random.unit() - 10.0, 50.0 * random.unit() - 10.0]).collect();
    let moved: Vec<[f64; 2]> = points.iter().map(|p| motion.apply(*p)).collect();
    let before = off_nominal(&points, &[plate()], &Silent).unwrap();
    let after = off_nominal(&moved, &[plate().moved(&motion)], &Silent).unwrap();
    for ((a, b), p) in before.iter().zip(&after).zip(&points) {
        assert!((a.unwrap().deviation - b.unwrap().deviation).abs() < 1e-12);
        let [[a, b, x], [c, d, y]] = motion.rows();
        let there = motion.apply(*p);
        assert!((a * p[0] + b * p[1] + x - there[0]).abs() < 1e-12);
        assert!((c * p[0] + d * p[1] + y - there[1]).abs() < 1e-12);
        let back = motion.inverse().apply(there);
        assert!(libm::hypot(back[0] - p[0], back[1] - p[1]) < 1e-12);
    }
}

/// A plate that is evenly larger than its nominal, with or without a bore, drawn by few points or many. The fit comes
/// to rest, no farther than where it began, and finds the motion by which the plate was moved.
#[test]
fn even_growth_comes_to_rest() {
    let random = &mut Random::new(21);
    let rectangle = |grown: f64, between: usize| -> Vec<[f64; 2]> {
        let corners = [[-20.0, -15.0], [20.0, -15.0], [20.0, 15.0], [-20.0, 15.0]];
        let grown: Vec<[f64; 2]> = corners.iter().map(|c| c.map(|x: f64| x + grown * x.signum())).collect();
        let side = |i: usize| {
            let (a, b) = (grown[i], grown[(i + 1) % 4]);
            (0..between).map(move |k| [0, 1].map(|j| a[j] + (b[j] - a[j]) * k as f64 / between as f64))
        };
        (0..4).flat_map(side).collect()
    };
    let bore = |radius: f64, count: usize| -> Vec<[f64; 2]> {
        let at = |i: usize| libm::sincos(-TAU * (i as f64 + 0.3) / count as f64);
        (0..count).map(at).map(|(s, c)| [6.0 + radius * c, 3.0 + radius * s]).collect()
    };
    for round in 0..300 {
        let (grown, between) = (0.1 * random.unit() - 0.02, [1, 2, 3, 20][random.below(4) as usize]);
        let planted = PlaneMotion {
            center: [0.0; 2],
            turn: 0.8 * random.unit() - 0.4,
            shift: [0, 1].map(|_| 4.0 * random.unit() - 2.0),
        };
        let mut rows = vec![rectangle(grown, between)];
        let mut outlines = vec![Outline::polyline(&rectangle(0.0, 1), true)];
        if round % 2 == 0 {
            rows.push(bore(5.0 - grown, 40));
            outlines.push(Outline::polyline(&bore(5.0, 24), true));
        }
        rows.iter_mut().flatten().for_each(|p| *p = planted.apply(*p));
        let rows: Vec<&[[f64; 2]]> = rows.iter().map(|r| &r[..]).collect();
        let found = onto_nominal(&rows, &outlines, Freedom::FREE, f64::INFINITY, &Silent);
        let found = found.unwrap_or_else(|e| panic!("round {round}: {e}"));
        assert!(found.converged && found.rms <= found.rms_before, "round {round}: {found:?}");
        // Few points within a plate come nearer to it by a turn. Chords of the bore lie off its circle by more than the
        // plate has grown.
        if grown < 0.0 {
            continue;
        }
        let off = found.motion.apply(planted.apply([0.0; 2]));
        let within = |off: f64, by: f64| off.abs() <= 4.0 * by + 1e-6;
        let [x, y] = [0, 1].map(|k| within(off[k], found.shift_uncertainty[k]));
        let turn = within(found.motion.turn + planted.turn, found.turn_uncertainty);
        assert!(x && y && turn, "round {round}, {between}, {grown}: {off:?} {found:?}");
    }
}

/// Numbers whose squares are none end the fit, with an answer that says it did not come to rest or with an error.
#[test]
fn overflow_ends_the_fit() {
    let random = &mut Random::new(22);
    let points = measured(&plate(), 60, 0.01, random);
    for scale in [1e-200, 1e-100, 1e100, 1e150, 1e160, 1e200, 1e300] {
        let scaled: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| x * scale)).collect();
        let corners =
            [[0.0, 0.0], [60.0, 0.0], [60.0, 30.0], [0.0, 30.0]].map(|p: [f64; 2]| p.map(|x| x * scale));
        let found = onto(&scaled, &Outline::polyline(&corners, true), Freedom::FREE);
        let is_number =
            |f: &OntoNominal| f.motion.shift.iter().chain([&f.motion.turn]).all(|x| x.is_finite());
        assert!(found.as_ref().map_or(true, |f| is_number(f) || !f.converged), "{scale}: {found:?}");
    }
}

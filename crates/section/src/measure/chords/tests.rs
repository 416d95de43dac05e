//! Chords in closed form.

use super::*;
use crate::{Options, PlaneMotion, airfoil, contour};
use std::f64::consts::{PI, TAU};
use trueness_geom::progress::Silent;

fn measured(points: &[[f64; 2]]) -> (Contour, Airfoil, Chords) {
    let options = Options { closed: Some(true), ..Options::default() };
    let found = contour(points, &options, &Silent).unwrap();
    let blade = airfoil(points, &found, &Silent).unwrap();
    let all = chords(points, &found, &blade).unwrap();
    (found, blade, all)
}

/// An ellipse of 40 by 6: all chords are its long axis, and no line touches it twice.
#[test]
fn an_ellipse_has_one_chord() {
    let points: Vec<[f64; 2]> = (0..600)
        .map(|i| libm::sincos(TAU * f64::from(i) / 600.0))
        .map(|(s, c)| [20.0 * c, 3.0 * s])
        .collect();
    let (_, _, all) = measured(&points);
    for chord in [all.farthest, all.camber_ends] {
        assert!((chord.length() - 40.0).abs() < 2e-3, "{chord:?}");
        let angle = libm::sin(chord.angle()).abs();
        assert!(angle < 5e-5, "{angle}");
    }
    assert_eq!(all.bitangent, Err(AirfoilError::NotHollow));
    assert!((all.area - PI * 60.0).abs() < 1e-3 && all.centroid.iter().all(|x| x.abs() < 1e-4), "{all:?}");
}

/// A bow of constant width: the band between circles of radius 50 ± 2 over a turn of 0.8, with round ends of radius 2.
fn bow(count: usize) -> Vec<[f64; 2]> {
    let at = |r: f64, a: f64| {
        let (s, c) = libm::sincos(a);
        [r * s, r * c - 50.0]
    };
    let half = 0.4;
    let n = count / 2;
    let cap = count / 16;
    let round = |a: f64, sense: f64| {
        let center = at(50.0, a);
        (1..cap).map(move |i| {
            // From the outer side around the end to the inner one, or back.
            let turn = PI * f64::from(i as u32) / cap as f64;
            let (s, c) = libm::sincos(a + sense * turn);
            [center[0] + 2.0 * s, center[1] + 2.0 * c]
        })
    };
    let mut all: Vec<[f64; 2]> =
        (0..=n).map(|i| at(52.0, -half + 2.0 * half * i as f64 / n as f64)).collect();
    all.extend(round(half, 1.0));
    all.extend((0..=n).map(|i| at(48.0, half - 2.0 * half * i as f64 / n as f64)));
    let back: Vec<[f64; 2]> = round(-half, -1.0).collect();
    all.extend(back.into_iter().rev());
    all
}

/// Closed forms of the bow. Ends of the middle arc are led on by 2 along it, and the flat tangent touches both round
/// ends below. The farthest places lie on the line through the centers of the ends.
#[test]
fn a_bow_has_three_chords() {
    let (_, _, all) = measured(&bow(800));
    let (sin, cos) = libm::sincos(0.4);
    let span = 2.0 * 50.0 * sin;
    assert!((all.farthest.length() - (span + 4.0)).abs() < 2e-3, "{:?}", all.farthest);
    let flat = all.bitangent.unwrap();
    assert!((flat.length() - (span + 4.0)).abs() < 2e-3, "{flat:?}");
    let height = 50.0 * cos - 50.0 - 2.0;
    assert!((flat.leading[1] - height).abs() < 2e-3 && (flat.trailing[1] - height).abs() < 2e-3, "{flat:?}");
    let ends = span + 2.0 * 2.0 * cos;
    assert!((all.camber_ends.length() - ends).abs() < 0.05, "{:?} {ends}", all.camber_ends);
    // The band's centroid: of its middle arc, led on by the round ends.
    assert!(all.centroid[0].abs() < 1e-3, "{:?}", all.centroid);
}

/// Chords turn and move with the profile.
#[test]
fn chords_turn_with_the_profile() {
    let motion = PlaneMotion { center: [7.0, 1.0], turn: 0.11, shift: [3.0, -4.0] };
    let points = bow(800);
    let moved: Vec<[f64; 2]> = points.iter().map(|p| motion.apply(*p)).collect();
    let ((_, a, before), (_, b, after)) = (measured(&points), measured(&moved));
    // Which end leads is open for a bow of one width.
    let same = distance(motion.apply(a.leading), b.leading) < 1.0;
    let by = |a: &Chord, b: &Chord| {
        let turn = b.angle() - a.angle() - if same { 0.0 } else { PI };
        turn - TAU * (turn / TAU).round()
    };
    assert!((by(&before.farthest, &after.farthest) - 0.11).abs() < 2e-4);
    assert!((by(&before.bitangent.unwrap(), &after.bitangent.unwrap()) - 0.11).abs() < 2e-4);
    assert!((by(&before.camber_ends, &after.camber_ends) - 0.11).abs() < 2e-3);
    assert!(distance(motion.apply(before.centroid), after.centroid) < 1e-3);
}

/// A row of an outline: chords by their ends, few lines and curves by even places.
#[test]
fn rows_of_outlines() {
    let points = bow(200);
    assert_eq!(
        outline_row(&Outline::polyline(&points, true)).len(),
        Outline::polyline(&points, true).segments.len()
    );
    let square = Outline::polyline(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], true);
    assert_eq!(outline_row(&square).len(), 1200);
}

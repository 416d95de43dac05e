//! Drawn relations are offered, others seldom are, and the covariance is that of fresh noise.

use super::offer::{MAX_CHANCE, MIN_PROBABILITY, Value};
use super::spread::Shape;
use super::*;
use crate::{Options, contour};
use crate::{Outline, Segment};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;

fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// Points at even steps along an outline, with noise.
fn measured(outline: &Outline, step: f64, noise: f64, random: &mut Random) -> Vec<[f64; 2]> {
    let mut all = vec![];
    for s in &outline.segments {
        let parts = (s.length / step).ceil() as usize;
        all.extend((0..parts).map(|i| s.place((i as f64 + 0.5) / parts as f64)));
    }
    all.into_iter().map(|p: [f64; 2]| p.map(|x| x + noise * normal(random))).collect()
}

fn found(outline: &Outline, noise: f64, random: &mut Random) -> (Vec<[f64; 2]>, Contour) {
    let points = measured(outline, 0.25, noise, random);
    let options = Options { closed: Some(outline.closed), noise: Some(noise), ..Options::default() };
    let contour = contour(&points, &options, &Silent).unwrap();
    (points, contour)
}

/// A rectangle of `a` by `b` whose corners have these radii, the lower left one sharp, turned by `turn`.
fn rounded(a: f64, b: f64, [p, q, r]: [f64; 3], turn: f64) -> Outline {
    let segments = vec![
        Segment::straight([0.0, 0.0], [a - p, 0.0]),
        Segment::arc([a - p, p], p, -FRAC_PI_2, FRAC_PI_2),
        Segment::straight([a, p], [a, b - q]),
        Segment::arc([a - q, b - q], q, 0.0, FRAC_PI_2),
        Segment::straight([a - q, b], [r, b]),
        Segment::arc([r, b - r], r, FRAC_PI_2, FRAC_PI_2),
        Segment::straight([0.0, b - r], [0.0, 0.0]),
    ];
    let motion = crate::PlaneMotion { center: [0.0; 2], turn, shift: [0.0; 2] };
    Outline { segments, closed: true }.moved(&motion)
}

fn kinds(offers: &[Offer], kind: OfferKind) -> Vec<&Offer> {
    offers.iter().filter(|o| o.kind == kind).collect()
}

/// A drawn plate: 40 × 25, radii 5, 5 and 3, along the axes. Each relation that was drawn is offered in nine of ten of
/// 40 draws at least.
#[test]
fn what_was_drawn_is_offered() {
    let random = &mut Random::new(7);
    let outline = rounded(40.0, 25.0, [5.0, 5.0, 3.0], 0.0);
    let mut counts = std::collections::BTreeMap::<&str, usize>::new();
    let draws = 40;
    for _ in 0..draws {
        let (points, contour) = found(&outline, 0.004, random);
        if contour.segments.len() != 7 {
            continue;
        }
        *counts.entry("found").or_default() += 1;
        let (offers, why) = tidy(std::slice::from_ref(&contour), &[&points]);
        assert_eq!(why, [None]);
        let mut is = |name: &'static str, holds: bool| *counts.entry(name).or_default() += usize::from(holds);
        is("horizontal", kinds(&offers, OfferKind::Horizontal).len() == 2);
        is("vertical", kinds(&offers, OfferKind::Vertical).len() == 2);
        is("parallel", kinds(&offers, OfferKind::Parallel).len() == 2);
        is("right", kinds(&offers, OfferKind::RightAngle).len() == 4);
        let whole = |kind, value: f64| kinds(&offers, kind).iter().any(|o| (o.offered - value).abs() < 1e-9);
        is("radius 5", whole(OfferKind::Radius, 5.0));
        is("radius 3", whole(OfferKind::Radius, 3.0));
        is("equal radii", kinds(&offers, OfferKind::EqualRadii).iter().any(|o| o.of.len() == 2));
        is("40", whole(OfferKind::Distance, 40.0));
        is("25", whole(OfferKind::Distance, 25.0));
        is("centers", whole(OfferKind::Centers, 15.0));
        for o in &offers {
            assert!(o.p >= MIN_PROBABILITY && o.chance <= MAX_CHANCE && o.uncertainty > 0.0, "{o:?}");
            assert!((o.z - (o.found - o.offered) / o.uncertainty).abs() < 1e-9, "{o:?}");
        }
    }
    assert!(counts["found"] >= 36, "{counts:?}");
    // Two of two lines within 95 % each are 90 %, four right angles that go together about 85 %.
    for (name, least) in [
        ("horizontal", 0.8),
        ("vertical", 0.8),
        ("parallel", 0.8),
        ("right", 0.75),
        ("radius 5", 0.9),
        ("radius 3", 0.85),
        ("equal radii", 0.85),
        ("40", 0.85),
        ("25", 0.85),
        ("centers", 0.85),
    ] {
        let share = counts[name] as f64 / counts["found"] as f64;
        assert!(share >= least, "{name} {share} {counts:?}");
    }
}

/// Few relations of a plate whose numbers are random are offered: no more than chance makes of all that were looked at.
#[test]
fn what_was_not_drawn_is_seldom_offered() {
    let random = &mut Random::new(8);
    let (mut false_ones, mut plates) = (0, 0);
    for _ in 0..40 {
        let mut any = |a: f64, b: f64| a + (b - a) * random.unit();
        let (a, b) = (any(35.0, 45.0), any(22.0, 28.0));
        let (radii, turn) = ([any(3.0, 6.0), any(3.0, 6.0), any(3.0, 6.0)], any(0.1, 0.7));
        let (points, contour) = found(&rounded(a, b, radii, turn), 0.004, random);
        if contour.segments.len() != 7 {
            continue;
        }
        plates += 1;
        let (offers, _) = tidy(std::slice::from_ref(&contour), &[&points]);
        // Parallel and at right angles it is.
        let drawn = |o: &&Offer| !matches!(o.kind, OfferKind::Parallel | OfferKind::RightAngle);
        false_ones += offers.iter().filter(drawn).count();
        assert!(
            kinds(&offers, OfferKind::Horizontal).is_empty()
                && kinds(&offers, OfferKind::Vertical).is_empty()
        );
        assert_eq!(kinds(&offers, OfferKind::Tangent).len(), 0);
    }
    // Three radii, lengths, two distances, three of centers, three pairs of radii.
    let each = f64::from(false_ones as u32) / f64::from(plates as u32);
    assert!(plates >= 34 && each < 0.8, "{each} of {plates}");
}

/// The covariance of lines and arcs with tangents is that of draws. Errors of values of two segments over their
/// uncertainties have the mean square 1.
#[test]
fn uncertainties_are_those_of_fresh_noise() {
    let random = &mut Random::new(9);
    let outline = rounded(40.0, 25.0, [5.0, 5.0, 3.0], 0.3);
    let (mut sums, mut count) = ([0.0; 4], 0.0);
    let mut sweep = vec![];
    for _ in 0..80 {
        let (points, contour) = found(&outline, 0.004, random);
        if contour.segments.len() != 7 {
            continue;
        }
        let spreads = [Spread::new(&contour, &points)];
        let members = relation::members(&spreads);
        // The point at the corner may belong to the line before.
        let length = |k: &usize| contour.segments[*k].length;
        let first = (0..7).max_by(|a, b| length(a).total_cmp(&length(b))).unwrap();
        let member = |k: usize| members.iter().find(|m| m.of[1] == k).copied();
        let Some(all) = (0..7).map(|i| member((first + i) % 7)).collect::<Option<Vec<_>>>() else {
            continue;
        };
        let angle = |s: Shape| if let Shape::Line { angle, .. } = s { angle } else { 0.0 };
        let radius = |s: Shape| if let Shape::Arc { radius, .. } = s { radius } else { 0.0 };
        let center = |s: Shape| if let Shape::Arc { center, .. } = s { center } else { [0.0; 2] };
        let apart = |[s, t]: [Shape; 2]| {
            let (c, d) = (center(s), center(t));
            libm::hypot(d[0] - c[0], d[1] - c[1])
        };
        let values = [
            (all[0].with(&all[2], &|[s, t]| angle(t) - angle(s)), FRAC_PI_2),
            (all[1].with(&all[3], &|[s, t]| radius(t) - radius(s)), 0.0),
            (all[1].with(&all[3], &apart), 15.0),
            (
                all[0].with(&all[4], &|s| {
                    relation::across(
                        s,
                        relation::between_them(std::slice::from_ref(&contour), &all[0], &all[4]),
                    )
                }),
                25.0,
            ),
        ];
        count += 1.0;
        for (sum, (value, truth)) in sums.iter_mut().zip(values) {
            let value = value.unwrap();
            *sum += ((value.found - truth) / value.uncertainty).powi(2);
        }
        let Some(u) = contour.segments[(first + 1) % 7].uncertainty else { continue };
        let own = all[1].value(&radius).unwrap().uncertainty;
        if let crate::Uncertainty::Arc { radius, center: stated } = u {
            assert!((own - radius).abs() < 1e-3 * radius);
            let x = all[1].value(&|s| center(s)[0]).unwrap().uncertainty;
            sweep.push(x / stated[0]);
        }
    }
    assert!(count >= 70.0, "{count}");
    let squares = sums.map(|s| s / count);
    assert!(squares.iter().all(|s| (0.6..1.5).contains(s)), "{squares:?}");
    // Coordinates of the center, scaled with the radius, are those told.
    assert!(sweep.iter().all(|s| (0.8..1.25).contains(s)), "{sweep:?}");
}

/// Two holes around one center and two apart by a whole number.
#[test]
fn holes_have_diameters_centers_and_distances() {
    let random = &mut Random::new(10);
    let hole = |c: [f64; 2], r: f64| Outline { segments: vec![Segment::arc(c, r, 0.3, TAU)], closed: true };
    let drawn = [hole([0.0, 0.0], 4.0), hole([0.0, 0.0], 6.5), hole([18.0, 7.5], 4.0)];
    let mut right = 0;
    for _ in 0..20 {
        let (points, contours): (Vec<_>, Vec<_>) = drawn.iter().map(|o| found(o, 0.004, random)).unzip();
        let rows: Vec<&[[f64; 2]]> = points.iter().map(|p| &p[..]).collect();
        let (offers, _) = tidy(&contours, &rows);
        let of = |kind| kinds(&offers, kind).iter().map(|o| (o.of.clone(), o.offered)).collect::<Vec<_>>();
        let (d, c) = (of(OfferKind::Diameter), of(OfferKind::Centers));
        right += usize::from(
            d.iter().map(|d| d.1).collect::<Vec<_>>() == [8.0, 13.0, 8.0]
                && of(OfferKind::Concentric) == [(vec![[0, 0], [1, 0]], 0.0)]
                && of(OfferKind::EqualRadii) == [(vec![[0, 0], [2, 0]], 0.0)]
                && c.len() == 2
                && c.iter().all(|c| (c.1 - 19.5).abs() < 1e-9),
        );
    }
    // Eight values at 95 %, of which some go together.
    assert!(right >= 11, "{right}");
}

/// Nothing is offered of values without uncertainty.
#[test]
fn exact_and_free_contours_have_no_offers() {
    let exact = Contour { row_kind: crate::RowKind::Facets, ..Contour::default() };
    assert_eq!(
        tidy(&[exact, Contour::default()], &[&[], &[]]),
        (vec![], vec![Some(Untidied::Exact), Some(Untidied::Unknown)])
    );
}

/// The coarsest step that fits, and none that fits anyway.
#[test]
fn steps_go_from_coarse_to_fine() {
    let whole = |found: f64, uncertainty: f64| {
        let value = Value { found, uncertainty, degrees: 1e9 };
        value.whole_of(OfferKind::Radius).map(|o| (o.offered, o.step.unwrap_or(0.0)))
    };
    assert_eq!(whole(12.0005, 0.0005), Some((12.0, 1.0)));
    assert_eq!(whole(12.4995, 0.0005), Some((12.5, 0.5)));
    assert_eq!(whole(12.3005, 0.0005), Some((12.3, 0.1)));
    assert_eq!(whole(12.3495, 0.0005), Some((12.35, 0.05)));
    assert_eq!(whole(12.3412, 0.0005), None);
    assert_eq!(whole(12.3005, 0.005), None);
    assert_eq!([whole(f64::NAN, 0.1), whole(1.0, f64::NAN), whole(0.0001, 0.001)], [None; 3]);
}

/// A line that meets an arc at a corner of a hair may be tangent; at one of a degree it is not.
#[test]
fn corners_of_a_hair_may_be_tangents() {
    let random = &mut Random::new(12);
    let open = |tilt: f64| Outline {
        segments: vec![
            Segment::straight([-20.0 * libm::cos(tilt), 20.0 * libm::sin(tilt)], [0.0, 0.0]),
            Segment::arc([0.0, 8.0], 8.0, -FRAC_PI_2, 0.5 * PI),
        ],
        closed: false,
    };
    let mut counts = [0; 2];
    for _ in 0..20 {
        for (count, tilt) in counts.iter_mut().zip([0.0, 0.1]) {
            let points = measured(&open(tilt), 0.25, 0.004, random);
            let options = Options {
                closed: Some(false),
                noise: Some(0.004),
                continuity: Some(crate::Continuity::G0),
                ..Options::default()
            };
            let contour = contour(&points, &options, &Silent).unwrap();
            let (offers, _) = tidy(std::slice::from_ref(&contour), &[&points]);
            *count += usize::from(!kinds(&offers, OfferKind::Tangent).is_empty());
        }
    }
    assert!(counts[0] >= 15 && counts[1] == 0, "{counts:?}");
}

/// Circles touch from within where they turn alike, from outside where they do not; a line touches at the radius.
#[test]
fn tangents_in_closed_form() {
    let arc = |x: f64, radius: f64| Shape::Arc { center: [x, 1.0], radius };
    let line = Shape::Line { place: [40.0, 4.0], angle: PI };
    assert_eq!(spread::off_tangent([arc(0.0, 5.0), arc(3.0, 2.0)], true), 0.0);
    assert_eq!(spread::off_tangent([arc(0.0, 5.0), arc(7.0, 2.0)], false), 0.0);
    assert!((spread::off_tangent([line, arc(-2.0, 3.0)], false)).abs() < 1e-12);
    assert!((spread::off_tangent([arc(-2.0, 2.0), line], true) - 1.0).abs() < 1e-12);
}

/// Segments joined by a tangent are tangent in the covariance: that value has no uncertainty, though either side has.
#[test]
fn tangent_joins_hold_in_the_covariance() {
    let random = &mut Random::new(13);
    let (points, contour) = found(&rounded(40.0, 25.0, [5.0, 5.0, 3.0], 0.3), 0.004, random);
    let spreads = [Spread::new(&contour, &points)];
    let all = relation::members(&spreads);
    let mut joined = 0;
    for (k, join) in contour.joins.iter().enumerate() {
        let next = (k + 1) % contour.segments.len();
        let pair = [k, next].map(|k| all.iter().find(|m| m.of[1] == k));
        let ([Some(a), Some(b)], false) = (pair, join.continuity == crate::Continuity::G0) else {
            continue;
        };
        let u = a.with(b, &|s| spread::off_tangent(s, false)).unwrap().uncertainty;
        // Scaled to the uncertainties told, which differ from these by less than a thousandth.
        assert!(u.is_nan() || u < 2e-5, "{k}: {u}");
        joined += 1;
    }
    assert!(joined >= 4, "{joined}");
}

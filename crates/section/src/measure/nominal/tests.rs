//! Deviations in closed form, and by brute force.

use super::*;
use crate::{Options, SegmentKind, contour};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;

fn deviations(points: &[[f64; 2]], outlines: &[Outline]) -> Vec<Option<f64>> {
    off_nominal(points, outlines, &Silent).unwrap().into_iter().map(|o| o.map(|o| o.deviation)).collect()
}

/// A star of sharp spikes and notches: distances to all sides by hand, the sign by whether the point is inside.
#[test]
fn deviations_are_those_of_brute_force() {
    let random = &mut Random::new(11);
    for round in 0..20 {
        let corner = |i: u32, random: &mut Random| {
            let (s, c) = libm::sincos(0.45 * f64::from(i));
            let r = if i.is_multiple_of(2) { 10.0 } else { 1.0 + 6.0 * random.unit() };
            [r * c, r * s]
        };
        let star: Vec<[f64; 2]> = (0..13).map(|i| corner(i, random)).collect();
        let hole: Vec<[f64; 2]> =
            [[0.3, 0.0], [0.0, 0.3], [-0.3, 0.0], [0.0, -0.3]].map(|p: [f64; 2]| p).to_vec();
        let mut outlines = vec![Outline::polyline(&star, true), Outline::polyline(&hole, true)];
        if round % 2 == 1 {
            outlines = outlines.into_iter().map(Outline::reversed).collect();
        }
        let outlines = with_material_inside(outlines);
        let points: Vec<[f64; 2]> =
            (0..300).map(|_| [24.0 * random.unit() - 12.0, 24.0 * random.unit() - 12.0]).collect();
        for (p, found) in points.iter().zip(deviations(&points, &outlines)) {
            let sides = |all: &[[f64; 2]]| -> f64 {
                let n = all.len();
                let each = |i: usize| {
                    let (a, b) = (all[i], all[(i + 1) % n]);
                    let d = [b[0] - a[0], b[1] - a[1]];
                    let t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
                    let t = t.clamp(0.0, 1.0);
                    libm::hypot(p[0] - a[0] - t * d[0], p[1] - a[1] - t * d[1])
                };
                (0..n).map(each).fold(f64::INFINITY, f64::min)
            };
            let distance = sides(&star).min(sides(&hole));
            let material = inside(&star, *p) != inside(&hole, *p);
            let truth = if material { -distance } else { distance };
            assert!((found.unwrap() - truth).abs() < 1e-12, "{p:?} {found:?} {truth}");
        }
    }
}

/// A round of lines and arcs found from points: deviations are those of the exact shape, outside positive, whichever way the
/// points run.
#[test]
fn a_contour_found_is_a_nominal() {
    let slot = |i: u32| {
        let s = 0.125 * f64::from(i);
        let half = 4.0 * std::f64::consts::PI;
        match s {
            s if s < 20.0 => [s, -4.0],
            s if s < 20.0 + half => {
                let (sin, cos) = libm::sincos((s - 20.0) / 4.0);
                [20.0 + 4.0 * sin, -4.0 * cos]
            }
            s if s < 40.0 + half => [40.0 + half - s, 4.0],
            s => {
                let (sin, cos) = libm::sincos((s - 40.0 - half) / 4.0);
                [-4.0 * sin, 4.0 * cos]
            }
        }
    };
    let mut points: Vec<[f64; 2]> = (0..521).map(slot).collect();
    for _ in 0..2 {
        let options = Options { closed: Some(true), ..Options::default() };
        let found = contour(&points, &options, &Silent).unwrap();
        assert!(found.segments.iter().all(|s| s.geometry.kind() != SegmentKind::Spline));
        let nominal = with_material_inside(vec![Outline::of(&found)]);
        let found = deviations(&[[10.0, 4.5], [26.0, 0.0], [-3.0, 0.0], [10.0, 1.0]], &nominal);
        for (found, truth) in found.iter().zip([0.5, 2.0, -1.0, -3.0]) {
            assert!((found.unwrap() - truth).abs() < 1e-5, "{found:?} {truth}");
        }
        points.reverse();
    }
}

#[test]
fn points_beyond_a_free_end_have_no_deviation() {
    let open = [Outline::polyline(&[[0.0, 0.0], [4.0, 0.0], [4.0, 0.0], [4.0, 3.0]], false)];
    let points = [[2.0, 1.0], [2.0, -1.0], [-0.1, 1.0], [0.0, 2.0], [4.5, 3.1], [5.0, -1.0], [f64::NAN, 0.0]];
    let found = deviations(&points, &open);
    // To the left is positive; at right angles to the end is not beyond it.
    let corner = -(2.0_f64.sqrt());
    assert_eq!(found, [Some(1.0), Some(-1.0), None, Some(2.0), None, Some(corner), None]);
    assert_eq!(deviations(&points[..1], &[]), [None]);
    struct Stopped;
    impl Progress for Stopped {
        fn cancelled(&self) -> bool {
            true
        }
    }
    assert_eq!(off_nominal(&points, &open, &Stopped), Err(Cancelled));
}

/// A plate with a hole in it. The hole keeps its side when the plate is open by a hair, and by a wide gap no more.
#[test]
fn holes_stay_holes_within_what_is_nearly_closed() {
    let plate =
        |gap: f64| Outline::polyline(&[[0.0, gap], [0.0, 9.0], [9.0, 9.0], [9.0, 0.0], [0.0; 2]], false);
    let hole = Outline::polyline(&[[3.0, 3.0], [5.0, 3.0], [5.0, 5.0], [3.0, 5.0]], true);
    for (gap, nearly) in [(0.001, true), (0.3, true), (0.5, false), (9.0, false)] {
        let open = plate(gap);
        assert_eq!(open.nearly_closed().is_some(), nearly, "{gap}");
        assert!(open.nearly_closed().is_none_or(|found| (found - gap).abs() < 1e-12));
        let outlines = with_material_inside(vec![open.clone(), hole.clone()]);
        // The open one stays as it is drawn, whose left is inside or outside as chance has it.
        assert_eq!(outlines[0], open);
        let side = if nearly { 1.0 } else { -1.0 };
        assert_eq!(deviations(&[[4.0, 3.25], [4.0, 2.5]], &outlines), [Some(0.25 * side), Some(-0.5 * side)]);
    }
    assert_eq!(hole.nearly_closed(), None);
    assert_eq!(Outline::default().nearly_closed(), None);
}

/// Parts of a way of a line, an arc and a curve: their places are those of the whole, their lengths those asked for.
#[test]
fn a_part_lies_on_the_whole() {
    use trueness_geom::spline::{basis::Knots, curve::Curve};
    let line = Segment::line([0.0, 0.0], [20.0, 0.0]);
    let arc = Segment::arc([20.0, 8.0], 8.0, -std::f64::consts::FRAC_PI_2, std::f64::consts::PI);
    let control = vec![[20.0, 16.0], [15.0, 16.0], [10.0, 20.0], [5.0, 12.0], [0.0, 16.0], [-3.0, 10.0]];
    let curve = Curve::new(Knots::uniform(3, 3, 0.0, 2.0), control).unwrap();
    let whole = Outline { segments: vec![line, arc, Segment::of_curve(curve, 0.0)], closed: false };
    let random = &mut Random::new(4);
    let length = whole.length();
    for round in 0..200 {
        let [a, b] = [random.unit(), random.unit()].map(|x| length * x);
        let (mut from, mut to) = (a.min(b), a.max(b));
        if round % 10 == 0 {
            (from, to) = (0.0, length);
        }
        let part = &whole.parts(&[[from, to]])[0];
        assert!((part.length() - (to - from)).abs() < 1e-9, "{from} {to} {}", part.length());
        for w in part.segments.windows(2) {
            assert!(libm::hypot(w[0].end[0] - w[1].start[0], w[0].end[1] - w[1].start[1]) < 1e-9);
        }
        for s in &part.segments {
            for share in [0.0, 0.1, 0.5, 0.7, 1.0] {
                let off = off_nominal(&[s.place(share)], std::slice::from_ref(&whole), &Silent).unwrap()[0];
                let off = off.unwrap();
                assert!(off.deviation.abs() < 1e-9, "{off:?}");
                assert!(off.along > from - 1e-6 && off.along < to + 1e-6, "{off:?} {from} {to}");
            }
        }
    }
    assert!(whole.parts(&[[3.0, 3.0], [length, length + 1.0]]).is_empty());
    assert_eq!(
        whole.parts(&[[1.0, 2.0], [5.0, 25.0]]),
        [whole.parts(&[[1.0, 2.0]]), whole.parts(&[[5.0, 25.0]])].concat()
    );
}

//! The best fit into zones: closed forms, no better pose nearby, invariance, zones that depend on the place.

use super::parts::block;
use crate::align::{
    AlignError, BestFit, InZones, Measured, Start, Target, ZoneAt, best_fit, into_zones, minimax,
};
use crate::closest::Tree;
use crate::deviation::surface::{ReferenceSurface, SurfaceOptions};
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::rigid::Rigid;
use crate::space::Point;
use std::cmp::Ordering;

const LOW: Point = [-10.0, -6.0, -4.0];
const HIGH: Point = [10.0, 6.0, 4.0];

fn fitted(points: &[Point], mesh: &Mesh, start: Rigid, zones: &ZoneAt) -> Result<InZones, AlignError> {
    let tree = Tree::build(mesh).unwrap();
    let target = Target::new(mesh, &tree);
    let surface = ReferenceSurface::new(&tree, mesh, &SurfaceOptions::default(), &Silent).unwrap();
    let measured = Measured::Points { points, normals: None };
    let options = BestFit { start: Start::From(start), robust: false, ..BestFit::default() };
    let fit = best_fit(&measured, &target, &options, &Silent).unwrap();
    into_zones(&measured, &target, &surface, zones, &fit, &options, &Silent)
}

/// The greatest excess at a pose, with signs by which side of the block's faces a point is on.
fn excess(points: &[Point], mesh: &Mesh, motion: &Rigid, zones: &ZoneAt) -> f64 {
    let tree = Tree::build(mesh).unwrap();
    let of = |p: &Point| {
        let p = motion.point(*p);
        let place = tree.closest(&p, f64::INFINITY).unwrap().unwrap();
        let inside = (0..3).all(|k| LOW[k] <= p[k] && p[k] <= HIGH[k]);
        let deviation = if inside { -place.distance } else { place.distance };
        let zone = zones(place.face, &place.point);
        zone.map_or(f64::NEG_INFINITY, |[lower, upper]| (deviation - upper).max(lower - deviation))
    };
    points.iter().map(of).fold(f64::NEG_INFINITY, f64::max)
}

fn places(step: f64) -> Vec<Point> {
    let mesh = block(LOW, HIGH, step);
    let middle = |f: &[u32; 3]| {
        let [a, b, c] = mesh.places(f);
        std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0)
    };
    mesh.faces.iter().map(middle).collect()
}

/// The top may be 0 to 0.4 too high, all else 0.1 either way. A perfect block rises by 0.05 and has 0.05 left on both sides.
#[test]
fn room_is_shared_out_in_closed_form() {
    let mesh = block(LOW, HIGH, 40.0);
    let zones = |_: u32, p: &Point| Some(if p[2] > 3.99 { [0.0, 0.4] } else { [-0.1, 0.1] });
    for start in [Rigid::IDENTITY, Rigid::rotation_about([1.0, 2.0, 3.0], [0.002, -0.001, 0.003])] {
        let points = places(1.0);
        let found = fitted(&points, &mesh, start, &zones).unwrap();
        assert!((found.excess + 0.05).abs() < 1e-9, "{}", found.excess);
        let up = found.reference_from_measured.point([0.0; 3])[2];
        assert!((up - 0.05).abs() < 1e-6 && found.used == points.len() as u64, "{up}");
        assert!(
            (excess(&points, &mesh, &found.reference_from_measured, &zones) - found.excess).abs() < 1e-12
        );
        // Where nothing is asked of the bottom it may rise until the top has more left than the sides.
        let open = |face: u32, p: &Point| if p[2] < -3.99 { None } else { zones(face, p) };
        let found = fitted(&points, &mesh, start, &open).unwrap();
        assert!((found.excess + 0.1).abs() < 1e-9 && found.without_zone > 100, "{}", found.excess);
    }
}

#[test]
fn equal_zones_are_the_least_greatest_distance() {
    let mesh = block(LOW, HIGH, 40.0);
    let mut points = places(1.0);
    points.push([10.3, 0.0, 0.0]);
    let found = fitted(&points, &mesh, Rigid::IDENTITY, &|_, _| Some([-0.02, 0.02])).unwrap();
    assert!((found.excess - 0.13).abs() < 1e-9, "{}", found.excess);
    let tree = Tree::build(&mesh).unwrap();
    let (target, measured) = (Target::new(&mesh, &tree), Measured::Points { points: &points, normals: None });
    let options = BestFit { start: Start::From(Rigid::IDENTITY), robust: false, ..BestFit::default() };
    let fit = best_fit(&measured, &target, &options, &Silent).unwrap();
    let least = minimax(&measured, &target, &fit, &options, &Silent).unwrap();
    assert!((least.greatest - 0.02 - found.excess).abs() < 1e-9);
    assert_eq!((found.zone, found.deviation > 0.0), ([-0.02, 0.02], true));
}

#[test]
fn no_pose_nearby_is_better_and_moving_the_scan_changes_nothing() {
    let random = &mut Random::new(11);
    let mut uneven = |size: f64| -> Point { std::array::from_fn(|_| size * (2.0 * random.unit() - 1.0)) };
    let mesh = block(LOW, HIGH, 40.0);
    // Uneven zones whose borders run across the faces.
    let zones = |_: u32, p: &Point| match p[0] {
        x if x < -3.0 => Some([-0.01, 0.06]),
        x if x < 4.0 => Some([-0.05, 0.06]),
        _ => None,
    };
    for _ in 0..3 {
        let mut points = places(1.3);
        for p in &mut points {
            let off = uneven(0.05);
            *p = std::array::from_fn(|k| p[k] + off[k]);
        }
        let found = fitted(&points, &mesh, Rigid::IDENTITY, &zones).unwrap();
        let best = found.reference_from_measured;
        assert!((excess(&points, &mesh, &best, &zones) - found.excess).abs() < 1e-12);
        for k in 0..300 {
            let size = [1e-2, 1e-3, 1e-4][k % 3];
            let turn = Rigid::rotation_about([0.0; 3], uneven(size / 10.0));
            let other = Rigid::translation_by(uneven(size)).after(&turn).after(&best);
            let there = excess(&points, &mesh, &other, &zones);
            assert!(there >= found.excess - 1e-9, "{there} {} by {size}", found.excess);
        }
        let away = Rigid::rotation_about([3.0, 2.0, 1.0], [0.4, -0.9, 0.7])
            .after(&Rigid::translation_by([50.0, -7.0, 3.0]));
        let moved: Vec<Point> = points.iter().map(|p| away.point(*p)).collect();
        let again = fitted(&moved, &mesh, away.inverse(), &zones).unwrap();
        assert!((again.excess - found.excess).abs() < 1e-8, "{} {}", again.excess, found.excess);
    }
}

/// A part without noise has a bump of 0.2 and a dent of 0.24, which the best fit leaves out as outliers. Here they are shared
/// out, and judged.
#[test]
fn a_bump_and_a_dent_count_however_little_the_rest_scatters() {
    let mesh = block(LOW, HIGH, 40.0);
    let mut points = places(1.0);
    points.extend([[10.2, 0.0, 0.0], [9.76, 3.0, 2.0]]);
    let tree = Tree::build(&mesh).unwrap();
    let target = Target::new(&mesh, &tree);
    let surface = ReferenceSurface::new(&tree, &mesh, &SurfaceOptions::default(), &Silent).unwrap();
    let measured = Measured::Points { points: &points, normals: None };
    let options = BestFit { start: Start::From(Rigid::IDENTITY), ..BestFit::default() };
    let fit = best_fit(&measured, &target, &options, &Silent).unwrap();
    assert_eq!(fit.excluded_points, 2);
    let into = |zone: [f64; 2]| {
        into_zones(&measured, &target, &surface, &|_, _| Some(zone), &fit, &options, &Silent).unwrap()
    };
    let (tight, wide) = (into([-0.1, 0.1]), into([-0.22, 0.22]));
    for (found, zone) in [(&tight, 0.1), (&wide, 0.22)] {
        let motion = found.reference_from_measured;
        let judged = excess(&points, &mesh, &motion, &|_, _| Some([-zone, zone]));
        assert!((judged - found.excess).abs() < 1e-12, "{judged} {}", found.excess);
        assert_eq!((found.used, found.not_counted.count), (points.len() as u64, 0));
        assert!((found.least - found.excess).abs() < 1e-12);
        // As it stands the dent decides; a shift and a turn leave less of it.
        assert!(found.excess + zone < 0.2401 && found.excess + zone > 0.1, "{}", found.excess);
    }
    assert!(tight.beyond >= 2 && wide.beyond == 0, "{} {}", tight.beyond, wide.beyond);
    assert!(wide.excess <= 0.0, "{}", wide.excess);
    let least = minimax(&measured, &target, &fit, &options, &Silent).unwrap();
    assert!((least.greatest - 0.1 - tight.excess).abs() < 1e-6 && least.not_counted.count == 0, "{least:?}");
}

/// Points that lie far off do not decide the pose, but they are judged: no point counts as within that is not.
#[test]
fn clutter_does_not_count_in_the_search_and_is_judged() {
    let mesh = block(LOW, HIGH, 40.0);
    let mut points = places(1.0);
    points.extend([[13.0, 0.0, 0.0], [0.0, 0.0, 7.0]]);
    let tree = Tree::build(&mesh).unwrap();
    let target = Target::new(&mesh, &tree);
    let surface = ReferenceSurface::new(&tree, &mesh, &SurfaceOptions::default(), &Silent).unwrap();
    let measured = Measured::Points { points: &points, normals: None };
    for robust in [true, false] {
        let options = BestFit { start: Start::From(Rigid::IDENTITY), robust, ..BestFit::default() };
        let fit = best_fit(&measured, &target, &options, &Silent).unwrap();
        let zones = |_: u32, p: &Point| (p[2] < 3.99).then_some([-0.1, 0.1]);
        let found = into_zones(&measured, &target, &surface, &zones, &fit, &options, &Silent).unwrap();
        let judged = excess(&points, &mesh, &found.reference_from_measured, &zones);
        assert!((judged - found.excess).abs() < 1e-12, "{judged} {}", found.excess);
        assert!(found.beyond > 0 && found.used + found.without_zone == points.len() as u64);
        let least = minimax(&measured, &target, &fit, &options, &Silent).unwrap();
        if robust {
            assert!((found.least + 0.1).abs() < 1e-9 && (found.excess - 2.9).abs() < 1e-6, "{found:?}");
            assert_eq!((found.not_counted.count, found.beyond, least.not_counted.count), (2, 1, 2));
            assert!((least.not_counted.farthest - 3.0).abs() < 1e-9 && least.greatest < 1e-9, "{least:?}");
        } else {
            assert_eq!((found.not_counted.count, least.not_counted.count), (0, 0));
            assert!(found.least == found.excess && found.excess < 2.0, "{}", found.excess);
        }
    }
}

/// Vertices of edges lie nearly as near to two faces. A linear program from the best fit alone ends at 0.00174, in front of such a kink. The pose to compare
/// with is of another program (scipy's linear programs from five starts, with distances in closed form).
#[test]
fn kinks_beside_edges_do_not_end_the_search() {
    let high = [30.0, 20.0, 10.0];
    let mesh = block(high.map(|x| -x), high, 80.0);
    let bent = |p: &Point| {
        let [x, y, z] = [p[0] + 30.0, p[1] + 20.0, p[2] + 10.0];
        let up = 0.03 * libm::sin(1.1 * x / 15.0) * z / 20.0 + 0.02 * (y / 40.0) * (y / 40.0);
        let off = [0.002 * z * libm::sin(1.1 * y / 9.0), 0.02 * libm::cos(1.1 * x / 8.0), up];
        [p[0] + off[0], p[1] + off[1], p[2] + off[2]]
    };
    let mut flat = block(high.map(|x| -x), high, 2.0).positions;
    // In another order the search happens to begin beyond the kink.
    flat.sort_by(|a, b| a.iter().zip(b).fold(Ordering::Equal, |o, (x, y)| o.then(x.total_cmp(y))));
    let points: Vec<Point> = flat.iter().map(bent).collect();
    let [lower, upper] = [-0.0274, 0.0574];
    let turn = Rigid::rotation_about(
        [0.0; 3],
        [5.2536086020575974e-8, -0.00016837492916551864, -0.00062403688925009],
    );
    let shift = [-0.002266120511503938, -0.008418247145145096, -0.005693052349803367];
    let known = Rigid::translation_by(shift).after(&turn);
    let deviation = |p: &Point| {
        let beyond: [f64; 3] = std::array::from_fn(|k| p[k].abs() - high[k]);
        let out = beyond.map(|x| x.max(0.0));
        let most = beyond.into_iter().fold(f64::NEG_INFINITY, f64::max);
        if most > 0.0 { (out[0] * out[0] + out[1] * out[1] + out[2] * out[2]).sqrt() } else { most }
    };
    let excess = |motion: &Rigid| {
        let of = |p: &Point| deviation(&motion.point(*p));
        points.iter().map(of).map(|d| (d - upper).max(lower - d)).fold(f64::NEG_INFINITY, f64::max)
    };
    let there = excess(&known);
    assert!((there - 0.0009071790860383).abs() < 1e-12, "{there}");
    let found = fitted(&points, &mesh, Rigid::IDENTITY, &|_, _| Some([lower, upper])).unwrap();
    let here = excess(&found.reference_from_measured);
    assert!((here - found.excess).abs() < 1e-12 && here < there + 1e-9, "{here} {} {there}", found.excess);
    // No worse than a given start, wherever the best fit leads.
    let zone = there - 1e-4;
    let found = fitted(&points, &mesh, known, &|_, _| Some([lower - zone, upper + zone])).unwrap();
    assert!(found.excess < 1e-4 + 1e-9 && found.beyond > 0, "{}", found.excess);
}

#[test]
fn without_any_zone_there_is_no_answer() {
    let mesh = block(LOW, HIGH, 40.0);
    let found = fitted(&places(2.0), &mesh, Rigid::IDENTITY, &|_, _| None);
    assert_eq!(found, Err(AlignError::NoZone));
}

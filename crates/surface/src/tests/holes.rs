//! Real scans with holes and ragged outlines: no control point leaves the part, and the noise is all that is left.

use super::*;
use std::path::PathBuf;
use trueness_geom::space::{dot, minus};

/// The points of one of the bunny's range scans that lie within `radius` of its point number `middle`.
fn patch(scan: u8, middle: usize, radius: f64) -> Vec<Point> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../corpus/bunny/scans.ply");
    let bytes = std::fs::read(path).unwrap();
    let start = bytes.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    let number = |b: &[u8]| f64::from(f32::from_le_bytes(b.try_into().unwrap()));
    let own: Vec<Point> = bytes[start..]
        .chunks_exact(13)
        .filter(|row| row[12] == scan)
        .map(|row| [number(&row[..4]), number(&row[4..8]), number(&row[8..12])])
        .collect();
    let center = own[middle];
    own.into_iter().filter(|p| norm(minus(*p, center)) < radius).collect()
}

/// Patches of several scans; all have holes or ragged outlines, and some walls as high as they are wide.
fn patches() -> Vec<Vec<Point>> {
    [
        (0, 17_000, 20.0),
        (1, 27_000, 20.0),
        (2, 9_000, 16.0),
        (3, 36_000, 22.0),
        (5, 11_000, 18.0),
        (6, 21_000, 20.0),
        (8, 5_000, 18.0),
        (9, 30_000, 20.0),
    ]
    .map(|(scan, middle, radius)| patch(scan, middle, radius))
    .to_vec()
}

/// Control points farther from the middle of the points' box than the corners of twice that box.
fn far(found: &SurfaceFit, points: &[Point]) -> usize {
    let hull = trueness_geom::space::Aabb::of(points);
    let middle: Point = std::array::from_fn(|k| 0.5 * (hull.min[k] + hull.max[k]));
    found.surface.points().iter().filter(|p| norm(minus(**p, middle)) > hull.diagonal()).count()
}

#[test]
fn scans_with_holes_keep_all_control_points_near() {
    for (n, points) in patches().into_iter().enumerate() {
        for layout in [Layout::Tolerance(0.5), Layout::Spans([8, 8]), Layout::Spans([16, 16])] {
            let found =
                fit(&points, &Options { layout: layout.clone(), ..Options::default() }, &Silent).unwrap();
            assert_eq!(far(&found, &points), 0, "{n} {layout:?}");
            assert_eq!(found.far_control_points, 0, "{n} {layout:?}");
            if let Layout::Tolerance(_) = layout {
                assert_eq!(found.reached, Some(Reached::Tolerance));
            }
            // Control points that no point holds are counted: the corners of round patches at least.
            if layout == Layout::Spans([16, 16]) {
                let share = found.support.unsupported as f64 / found.support.control_points as f64;
                assert!(share > 0.05 && share < 0.4, "{n} {share}");
            }
        }
    }
}

/// Standard deviation of the points from quadrics through the twelve nearest of each, which know nothing of splines.
fn noise(points: &[Point]) -> f64 {
    let mut sum = 0.0;
    let asked: Vec<&Point> = points.iter().step_by(5).collect();
    for p in &asked {
        let mut near: Vec<&Point> = points.iter().collect();
        near.select_nth_unstable_by(12, |a, b| norm(minus(**a, **p)).total_cmp(&norm(minus(**b, **p))));
        let near: Vec<Point> = near[..12].iter().map(|q| **q).collect();
        let plane =
            trueness_geom::fit::fit(&near, trueness_geom::shape::Kind::Plane, &Default::default(), &Silent)
                .unwrap();
        let trueness_geom::shape::Shape::Plane { point, normal } = plane.shape else { panic!() };
        let x = trueness_geom::space::unit(minus(near[0], near[11])).unwrap().0;
        let x = minus(x, trueness_geom::space::times(dot(x, normal), normal));
        let y = trueness_geom::space::cross(normal, x);
        // Least squares of the heights by 1, x, y, x², x y, y².
        let rows: Vec<([f64; 6], f64)> = near
            .iter()
            .map(|q| minus(*q, point))
            .map(|d| (dot(d, x), dot(d, y), dot(d, normal)))
            .map(|(x, y, z)| ([1.0, x, y, x * x, x * y, y * y], z))
            .collect();
        let mut square = vec![0.0; 36];
        let mut right = vec![0.0; 6];
        for (row, z) in &rows {
            for a in 0..6 {
                right[a] += row[a] * z;
                (0..6).for_each(|b| square[6 * a + b] += row[a] * row[b]);
            }
        }
        let factor = trueness_geom::num::cholesky::Cholesky::new(square, 6).unwrap();
        factor.solve(&mut right);
        let left = |(row, z): &([f64; 6], f64)| z - (0..6).map(|k| row[k] * right[k]).sum::<f64>();
        sum += rows.iter().map(left).map(|r| r * r).sum::<f64>() / 6.0;
    }
    (sum / asked.len() as f64).sqrt()
}

#[test]
fn the_noise_of_a_scan_is_what_is_left() {
    let points = patch(6, 21_000, 20.0);
    let layout = Layout::Tolerance(0.05);
    let found = fit(&points, &Options { layout, ..Options::default() }, &Silent).unwrap();
    let free = points.len() as f64 - found.degrees_of_freedom.unwrap();
    let sigma = pass::rms(&found.deviations) * (points.len() as f64 / free).sqrt();
    let floor = noise(&points);
    assert!((sigma / floor - 1.0).abs() < 0.1, "{sigma} {floor}");
    assert_eq!(far(&found, &points), 0);
}

/// A hole and an empty corner of a part that bends: the surface goes on as the part does, not as its base.
#[test]
fn a_hole_in_a_pipe_is_bridged_as_the_pipe_is() {
    let random = &mut Random::new(8);
    let round = |a: f64, z: f64| [15.0 * a.cos(), 15.0 * a.sin(), z];
    let points: Vec<Point> = (0..8000)
        .map(|_| (3.0 * random.unit(), 50.0 * random.unit()))
        .filter(|(a, z)| (15.0 * (a - 1.5)).hypot(z - 25.0) > 6.0 && !(*a > 2.3 && *z < 10.0))
        .map(|(a, z)| round(a, z))
        .collect();
    let options = Options { base: BaseKind::Cylinder, layout: Layout::Spans([24, 24]), ..Options::default() };
    let found = fit(&points, &options, &Silent).unwrap();
    let off = |p: &Point| (p[0].hypot(p[1]) - 15.0).abs();
    let worst = found.surface.points().iter().map(off).fold(0.0, f64::max);
    assert!(worst < 0.5, "{worst}");
    assert!(found.support.unsupported > 20);
}

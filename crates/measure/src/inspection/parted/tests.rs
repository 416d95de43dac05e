//! Walls, fillets and noise beside a plane of known form.

use crate::inspection::data::Data;
use crate::inspection::test_parts::plane_plan;
use crate::inspection::{Inspection, run};
use crate::plan::Plan;
use std::collections::HashMap;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Point, plus};

/// A bar along y: its top at z = 0 from x = −10 to 10, then a quarter of a circle of radius 2 in steps of 10°, or a wall.
fn bar(fillet: bool) -> Mesh {
    let mut profile = vec![[-10.0, -8.0], [-10.0, 0.0], [10.0, 0.0]];
    if fillet {
        let turn = |i: i32| f64::from(10 * i).to_radians();
        profile.extend((1..=9).map(|i| [10.0 + 2.0 * libm::sin(turn(i)), 2.0 * libm::cos(turn(i)) - 2.0]));
    }
    let last = profile[profile.len() - 1][0];
    profile.push([last, -8.0]);
    // From fifty to a hundred points along each side, so that every place of the surface is near one.
    let mut mesh = Mesh::default();
    let n = 50u32;
    for side in profile.windows(2) {
        let first = mesh.positions.len() as u32;
        for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
            let [s, t] = [i, j].map(|k| f64::from(k) / f64::from(n));
            let [x, z] = [0, 1].map(|k| side[0][k] + s * (side[1][k] - side[0][k]));
            mesh.positions.push([x, 20.0 * t, z]);
            if i < n && j < n {
                let a = first + i * (n + 1) + j;
                mesh.faces.extend([[a, a + n + 1, a + 1], [a + 1, a + n + 1, a + n + 2]]);
            }
        }
    }
    mesh
}

/// Flatness of the plane z = 0 over a rectangle in x and y from the points of a cloud, and how many they are.
fn flatness(cloud: &Mesh, reference: Option<&Mesh>, bounds: [[f64; 2]; 2], extract: &str) -> (f64, usize) {
    let cloud = Mesh { positions: cloud.positions.clone(), faces: vec![] };
    // Nobody writes a nominal to the last digit.
    of_plane(cloud, reference, bounds, (1e-4, extract))
}

/// The same of a mesh or a cloud, for a nominal that leans.
fn of_plane(
    measured: Mesh,
    reference: Option<&Mesh>,
    bounds: [[f64; 2]; 2],
    with: (f64, &str),
) -> (f64, usize) {
    let found = found(measured, reference, bounds, with);
    (found.values[0].as_ref().unwrap().value, found.features[0].points.len())
}

fn found(
    measured: Mesh,
    reference: Option<&Mesh>,
    bounds: [[f64; 2]; 2],
    (leaning, extract): (f64, &str),
) -> Inspection {
    let plan = plane_plan(bounds, (leaning, 0.1), extract, "");
    let data = Data { measured: Some(measured.into()), reference: reference.cloned(), ..Data::default() };
    run(&plan, data, &Silent).unwrap()
}

/// The flatness that decides: with the points of which it is not certain whose they are.
fn greatest(cloud: &Mesh, reference: &Mesh, bounds: [[f64; 2]; 2], extract: &str) -> f64 {
    let cloud = Mesh { positions: cloud.positions.clone(), faces: vec![] };
    let found = found(cloud, Some(reference), bounds, (1e-4, extract));
    let with_others = found.with_others[0].as_ref().map_or(0.0, |v| v.as_ref().unwrap().value);
    found.values[0].as_ref().unwrap().value.max(with_others)
}

const TOP: [[f64; 2]; 2] = [[-10.0, 10.0], [0.0, 20.0]];

/// Facets of a fillet face nearly as the plane that it leaves, and are none of it; nothing over the plane itself is lost with them.
#[test]
fn facets_of_a_fillet_are_no_part_of_the_plane() {
    // One surface: without it facets of the fillet are beside those of the plane and joined to none of them.
    let model = {
        let bar = bar(true);
        let key = |p: &Point| p.map(|x| (x * 1e9).round() as i64);
        let mut at = HashMap::new();
        let places: Vec<u32> =
            bar.positions.iter().zip(0..).map(|(p, i)| *at.entry(key(p)).or_insert(i)).collect();
        let faces = bar.faces.iter().map(|f| f.map(|v| places[v as usize])).collect();
        Mesh { positions: bar.positions, faces }
    };
    let of = |measured, reference| of_plane(measured, reference, TOP, (0.0, "distance = 0.5")).0;
    assert!(of(model.clone(), None) < 1e-9 && of(model.clone(), Some(&model)) < 1e-9);
    // Dents of the plane, and the same part somewhat off its place, across and along.
    for height in [0.04, -0.04] {
        let mut dented = model.clone();
        let near = |p: &&mut Point| p[2] == 0.0 && (p[0] - 8.0).abs() < 0.01 && (p[1] - 10.0).abs() < 0.01;
        let moved = dented.positions.iter_mut().filter(near).map(|p| p[2] += height).count();
        assert_eq!(moved, 1);
        let found = found(dented, Some(&model), TOP, (0.0, "distance = 0.5"));
        let others = found.with_others[0].as_ref().map_or(0.0, |v| v.as_ref().unwrap().value);
        let value = found.values[0].as_ref().unwrap().value.max(others);
        assert!((value - 0.04).abs() < 1e-6, "{height} {value}");
    }
    for shift in [[0.1, 0.0, 0.02], [-0.1, 0.0, -0.02]] {
        let mut off = model.clone();
        off.positions.iter_mut().for_each(|p| *p = plus(*p, shift));
        let value = of(off, Some(&model));
        assert!(value < 0.02, "{shift:?} {value}");
    }
}

/// Facets of the planes that leave a fillet as tangents face nearly as it does, and are none of it.
#[test]
fn facets_of_tangent_planes_are_no_part_of_a_fillet() {
    let plan = Plan::parse(
        r#"
        schema = "trueness/plan/1"
        measured = "part.stl"
        [[feature]]
        id = "R"
        shape = "cylinder"
        extract = { distance = 0.5, coverage = 0.1 }
        nominal = { point = [10, 0, -2], direction = [0, 1, 0], radius = 2, length = 20 }
        [[characteristic]]
        id = "1"
        kind = "cylindricity"
        feature = "R"
        tolerance = 0.1
        "#,
    )
    .unwrap();
    let chord = |k: i32| {
        let (sin, cos) = f64::from(10 * k).to_radians().sin_cos();
        [10.0 + 2.0 * sin, 2.0 * cos - 2.0]
    };
    let mut lines = vec![[[-10.0, 0.0], chord(0)], [chord(9), [12.0, -8.0]]];
    lines.extend((0..9).map(|k| [chord(k), chord(k + 1)]));
    let data = Data { measured: Some(bar(true).into()), reference: Some(strips(&lines)), ..Data::default() };
    let found = run(&plan, data, &Silent).unwrap();
    // Nine chords of 51 × 51 points; their inner ones lie within the arrow over a chord of 10 degrees.
    let value = found.values[0].as_ref().unwrap().value;
    let arrow = 2.0 * (1.0 - libm::cos(5f64.to_radians()));
    assert!((value - arrow).abs() < 1e-3, "{value} {arrow}");
    // The lines that it shares with the planes are of either.
    assert!((9 * 51 * 51 - 2 * 51..=9 * 51 * 51).contains(&found.features[0].points.len()));
}

/// Neither the upper ends of the walls nor the fillet, but for what faces as it does, are part of the plane between them.
#[test]
fn what_is_beside_a_plane_is_no_part_of_it() {
    let wall = bar(false);
    for extract in ["distance = 0.5", "distance = 0.5, margin = 0"] {
        let (value, points) = flatness(&wall, Some(&wall), TOP, extract);
        assert!(value < 1e-9 && points >= 49 * 49, "{extract}: {value} {points}");
    }
    // The way it goes tells the wall without a reference too, but for its rim, which lies on both.
    let (value, points) = flatness(&wall, None, TOP, "distance = 0.5");
    assert!(value < 1e-9 && points >= 49 * 51, "{value} {points}");
    let fillet = bar(true);
    let wide = "distance = 0.5, margin = -2";
    // All of it that is within reach would make 0.5.
    assert!(flatness(&fillet, None, TOP, wide).0 < 0.25);
    let (value, points) = flatness(&fillet, Some(&fillet), TOP, wide);
    // Its second facet of 10 degrees lies at 15.
    assert!(value < 2.0 * (1.0 - libm::cos(20f64.to_radians())) + 1e-3, "{value}");
    assert!(points >= 51 * 51, "{points}");
}

/// Sparse points with noise, whose tail lies farther off the wall than most of the cloud, on a wall beside a top that is too high:
/// near the edge all planes of neighbors mix both.
#[test]
fn what_noise_carries_off_a_wall_is_no_part_of_the_plane_beside_it() {
    let (reference, sigma) = (bar(false), 0.003);
    for high in [0.0, 0.05, 0.1] {
        let random = &mut Random::new(7);
        let mut normal = || sigma * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
        let noise: Vec<f64> = (0..3000).map(|_| normal()).collect();
        let mut place = |low: f64, top: f64| low + (top - low) * random.unit();
        let of_top = noise[..1500].iter().map(|n| [place(-10.0, 10.0), place(0.0, 20.0), high + n]);
        let of_top: Vec<Point> = of_top.collect();
        let of_wall = noise[1500..].iter().map(|n| [10.0 + n, place(0.0, 20.0), place(-8.0, high)]);
        let positions = [of_top, of_wall.collect()].concat();
        let cloud = Mesh { positions, faces: vec![] };
        let (value, points) = flatness(&cloud, Some(&reference), TOP, "distance = 0.5");
        let range = noise[..1500].iter().fold([0.0f64; 2], |[a, b], n| [a.min(*n), b.max(*n)]);
        assert!(value < 1.5 * (range[1] - range[0]), "{high}: {value} {range:?}");
        assert!((1450..1550).contains(&points), "{high}: {points}");
    }
}

/// Points with these deviations from the plane z = 0.
fn lowered(mesh: &Mesh, by: impl Fn(f64, f64) -> f64) -> Mesh {
    let mut mesh = mesh.clone();
    mesh.positions.iter_mut().filter(|p| p[2] == 0.0).for_each(|p| p[2] -= by(p[0], p[1]));
    mesh
}

/// Whatever lies beside or below it, no defect is taken for something else: it counts, or leaves the verdict open.
#[test]
fn defects_of_a_plane_stay_with_it() {
    // A sheet of thickness 1 with a dent deeper than half of it.
    let mut sheet = bar(false);
    let below: Vec<Point> = sheet.positions.iter().map(|p| [p[0], p[1], -1.0]).collect();
    let first = sheet.positions.len() as u32;
    sheet.faces.extend(sheet.faces.clone().iter().map(|[a, b, c]| [a + first, c + first, b + first]));
    sheet.positions.extend(below);
    let dented = lowered(&sheet, |x, y| if libm::hypot(x, y - 10.0) < 3.0 { 0.7 } else { 0.0 });
    let value = greatest(&dented, &sheet, TOP, "distance = 0.8");
    assert!(value > 0.65, "{value}");
    // A bar, narrow or wide, worn down towards one end, deeper than half its width; and a dent beside its rim.
    for width in [0.2, 1.0] {
        let mut rib = bar(false);
        rib.positions.iter_mut().for_each(|p| p[0] *= 0.1 * width);
        let worn = lowered(&rib, |_, y| 0.05 * (y - 10.0).max(0.0));
        let across = [TOP[0].map(|x| 0.1 * width * x), TOP[1]];
        let value = greatest(&worn, &rib, across, "distance = 0.6");
        // Half of its slope lies flat, half falls by 0.5: a quarter is left between two planes; what may be of the walls makes more.
        assert!(value > 0.22, "{width}: {value}");
    }
    let wall = bar(false);
    let nick = |x: f64, y: f64| if x > 9.0 && (y - 10.0).abs() < 3.0 { 0.3 } else { 0.0 };
    let value = greatest(&lowered(&wall, nick), &wall, TOP, "distance = 0.5, margin = 0.3");
    assert!(value > 0.25, "{value}");
}

/// A mesh of these strips, each from one line along y to the next, 20 long.
fn strips(lines: &[[[f64; 2]; 2]]) -> Mesh {
    let mut mesh = Mesh::default();
    for strip in lines {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(strip.iter().flat_map(|[x, z]| [[*x, 0.0, *z], [*x, 20.0, *z]]));
        mesh.faces.extend([[0, 2, 1], [1, 2, 3]].map(|f| f.map(|v| v + first)));
    }
    mesh
}

/// Points strewn over those strips, `dense` to the square millimeter, with noise across them.
fn strewn(lines: &[[[f64; 2]; 2]], dense: f64, sigma: f64) -> Mesh {
    let random = &mut Random::new(11);
    let mut positions = vec![];
    for [[a, c], [b, d]] in lines {
        let long = libm::hypot(b - a, d - c);
        for _ in 0..(20.0 * long * dense) as usize {
            let off = sigma * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
            let t = random.unit();
            let place = [a + t * (b - a) - off * (d - c) / long, c + t * (d - c) + off * (b - a) / long];
            positions.push([place[0], 20.0 * random.unit(), place[1]]);
        }
    }
    Mesh { positions, faces: vec![] }
}

/// The other side of a sheet, a lower step, a chamfer: what lies upon them is not of the plane, of noise not even one point.
#[test]
fn what_lies_upon_other_faces_of_the_reference_is_no_part_of_a_plane() {
    const SIGMA: f64 = 0.003;
    let top = [[-10.0, 0.0], [10.0, 0.0]];
    let sides = [
        ("sheet", vec![[[10.0, -0.4], [-10.0, -0.4]]]),
        ("thick sheet", vec![[[10.0, -1.5], [-10.0, -1.5]]]),
        ("step", vec![[[10.0, 0.0], [10.0, -0.1]], [[10.0, -0.1], [30.0, -0.1]]]),
        ("chamfer", vec![[[10.0, 0.0], [12.0, -2.0]], [[12.0, -2.0], [12.0, -8.0]]]),
    ];
    for (name, others) in sides {
        let lines = [&[top][..], &others].concat();
        let cloud = strewn(&lines, 30.0, SIGMA);
        let (value, points) = flatness(&cloud, Some(&strips(&lines)), TOP, "distance = 2");
        // Of twelve thousand points with noise none is farther off than six standard deviations.
        assert!(value < 12.0 * SIGMA, "{name}: {value}");
        // The wall of the step is lower than a distance of points: some beside it may be left out as on its edge.
        assert!((11_700..12_100).contains(&points), "{name}: {points}");
    }
}

/// Where a top is off its place the wall beside it goes on to it, or ends before.
#[test]
fn a_wall_that_goes_on_to_a_displaced_plane_is_no_part_of_it() {
    const SIGMA: f64 = 0.003;
    let of = |high: f64, wall: f64| {
        vec![[[-10.0, high], [10.0, high]], [[10.0, wall], [10.0, -8.0]], [[-10.0, -8.0], [-10.0, wall]]]
    };
    let reference = strips(&of(0.0, 0.0));
    for dense in [3.0, 30.0] {
        for high in [0.4, 0.15, 0.05, -0.05, -0.4] {
            let cloud = strewn(&of(high, high), dense, SIGMA);
            let (value, points) = flatness(&cloud, Some(&reference), TOP, "distance = 0.5");
            let all = 400.0 * dense;
            // Up to five deviations, as sixteen points around tell them, the plane explains points of the wall.
            assert!(value < 13.0 * SIGMA, "{dense} {high}: {value}");
            assert!((0.97 * all..1.01 * all).contains(&(points as f64)), "{dense} {high}: {points}");
        }
    }
}

/// Where a wall is off its place the top beside it, which is in its own, ends earlier: the upper end of the wall is no part of it.
#[test]
fn a_wall_off_its_place_is_no_part_of_the_plane_beside_it() {
    const SIGMA: f64 = 0.003;
    let of = |[top, below]: [f64; 2]| {
        let (right, left) = ([[top, 0.0], [below, -8.0]], [[-below, -8.0], [-top, 0.0]]);
        vec![[[-top, 0.0], [top, 0.0]], right, left]
    };
    let reference = strips(&of([10.0, 10.0]));
    for dense in [1.0, 3.0, 30.0] {
        for wall in [[9.95, 9.95], [9.7, 9.7], [9.7, 10.0], [9.9, 9.5], [10.3, 10.3]] {
            let cloud = strewn(&of(wall), dense, SIGMA);
            let (value, points) = flatness(&cloud, Some(&reference), TOP, "distance = 0.5");
            let all = 40.0 * wall[0] * dense;
            assert!(value < 12.0 * SIGMA, "{dense} {wall:?}: {value}");
            assert!((0.97 * all..1.01 * all).contains(&(points as f64)), "{dense} {wall:?}: {points}");
        }
        if dense < 3.0 {
            continue;
        }
        // A chamfer wider than a scan rounds edges lies on neither, and counts.
        let wide = 4.5 / f64::sqrt(dense);
        let (end, low) = (10.0 - wide, -wide);
        let broken = [[[-9.0, 0.0], [end, 0.0]], [[end, 0.0], [10.0, low]], [[10.0, low], [10.0, -8.0]]];
        let value = greatest(&strewn(&broken, dense, SIGMA), &reference, TOP, "distance = 0.5");
        assert!(value > 0.05, "{dense}: {value}");
    }
}

/// A slot that is off its place: the points of each wall lie as far off it as those of the other wall, and no verdict rests on which is which.
#[test]
fn points_between_two_faces_leave_the_verdict_open() {
    let lines = [[[-10.0, 0.0], [10.0, 0.0]], [[10.0, -1.2], [-10.0, -1.2]]];
    let reference = strips(&lines);
    let mut cloud = strewn(&lines, 30.0, 0.003);
    cloud.positions.iter_mut().for_each(|p| p[2] += 0.3);
    let (value, points) = flatness(&cloud, Some(&reference), TOP, "distance = 2");
    assert!(value < 0.04 && points >= 11_800, "{value} {points}");
}

/// A dent or a slot deeper than the distance and deeper than half the wall is told of its own face alone, of meshes and of clouds without points on
/// its walls.
#[test]
fn what_lies_nearer_to_the_other_side_of_a_wall_is_told() {
    const DEEP: f64 = 3.2;
    let (top, below) = ([[-10.0, 0.0], [10.0, 0.0]], [[10.0, -4.0], [-10.0, -4.0]]);
    let reference = strips(&[top, below]);
    let slot = [[-2.0, -DEEP], [2.0, -DEEP]];
    let milled = [[[-10.0, 0.0], [-2.0, 0.0]], slot, [[2.0, 0.0], [10.0, 0.0]], below];
    let left_out = |measured: Mesh, reference: &Mesh| {
        let found = found(measured, Some(reference), TOP, (0.0, "distance = 0.5"));
        let value = found.values[0].as_ref().unwrap().value;
        (value, found.features[0].left_out.map(|l| (l.points, (10.0 * l.farthest).round())))
    };
    // As cloud, and as mesh of lines along the slot.
    for dense in [30.0, 5.0] {
        let cloud = strewn(&milled, dense, 0.003);
        let count = cloud.positions.iter().filter(|p| p[0].abs() < 2.0 && p[2] > -3.5).count() as u64;
        let (value, told) = left_out(cloud, &reference);
        assert!(
            value < 0.04 && told.is_some_and(|t| t.0 > count / 2 && t.0 <= count && t.1 == 32.0),
            "{value} {told:?} {count}"
        );
    }
    assert_eq!(left_out(strips(&milled), &reference), (0.0, Some((4, 32.0))));
    // In the other face, and nearer to that one.
    let below = [[[10.0, -4.0], [2.0, -4.0]], [[2.0, -2.4], [-2.0, -2.4]], [[-2.0, -4.0], [-10.0, -4.0]]];
    let other = [&[top][..], &below].concat();
    for dense in [30.0, 1.0] {
        let (value, told) = left_out(strewn(&other, dense, 0.003), &reference);
        assert!(value < 0.04 && told.is_none(), "{value} {told:?}");
    }
    assert_eq!(left_out(strips(&other), &reference), (0.0, None));
}

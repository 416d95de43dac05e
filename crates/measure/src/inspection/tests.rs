//! Points of a cloud that were left out of a feature as of other surfaces: counted, told, and never a false pass. What a document says
//! of what was not measured.

use super::test_parts::plane_plan;
use super::{Data, run};
use crate::plan::Plan;
use trueness_document::Verdict;
use trueness_document::inspect::{CharacteristicRecord, InspectDocument, PlanRecord};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Silent;
use trueness_geom::scan::Scan;
use trueness_geom::space::Point;

/// Sides of the round walls.
const TURNS: u32 = 120;

/// A plate, 40 by 40 and 6 thick, its top at z = 0, with a bore in its middle: as squares about `step` long, the bore with so
/// many sides. `raise` is added to the heights of the top.
fn plate(radius: f64, turns: u32, step: f64, raise: impl Fn(f64, f64) -> f64) -> Mesh {
    let mut mesh = Mesh::default();
    let mut sheet = |rows: u32, columns: u32, at: &dyn Fn(f64, f64) -> Point| {
        let first = mesh.positions.len() as u32;
        for (i, j) in (0..=rows).flat_map(|i| (0..=columns).map(move |j| (i, j))) {
            mesh.positions.push(at(f64::from(i) / f64::from(rows), f64::from(j) / f64::from(columns)));
            if i < rows && j < columns {
                let a = first + i * (columns + 1) + j;
                mesh.faces.extend([[a, a + columns + 1, a + 1], [a + 1, a + columns + 1, a + columns + 2]]);
            }
        }
    };
    // From the bore outwards to the square, then down both walls.
    let round = |t: f64, r: f64| {
        let phi = std::f64::consts::TAU * t;
        [r * libm::cos(phi), r * libm::sin(phi)]
    };
    let square = |t: f64| {
        let [x, y] = round(t, 1.0);
        let longest = x.abs().max(y.abs());
        [20.0 * x / longest, 20.0 * y / longest]
    };
    let (out, down) = ((16.0 / step) as u32, (6.0 / step) as u32);
    sheet(out, turns, &|s, t| {
        let ([a, b], [c, d]) = (round(t, radius), square(t));
        let (x, y) = (a + s * (c - a), b + s * (d - b));
        [x, y, raise(x, y)]
    });
    sheet(down, turns, &|s, t| {
        let [x, y] = round(t, radius);
        [x, y, -6.0 * s]
    });
    sheet(down, turns, &|s, t| {
        let [x, y] = square(t);
        [x, y, -6.0 * s]
    });
    mesh
}

/// What is told of measured data by a plan.
fn document(plan: &Plan, data: Data) -> InspectDocument {
    let found = run(plan, data, &Silent).unwrap();
    crate::inspection::document(plan, PlanRecord { path: String::new(), sha256: None }, &found, vec![])
}

/// Flatness of the top, from a cloud.
fn flatness(cloud: Mesh, reference: Option<&Mesh>, extract: &str) -> (CharacteristicRecord, u64) {
    let plan = plane_plan([[-20.0, 20.0], [-20.0, 20.0]], (0.0, 0.05), extract, "");
    let measured = Some(Scan::Cloud(cloud.positions));
    let data = Data { measured, reference: reference.cloned(), ..Data::default() };
    let mut document = document(&plan, data);
    let left_out = document.features[0].left_out.as_ref().map_or(0, |l| l.others + l.beyond);
    (document.characteristics.remove(0), left_out)
}

/// Waves of 0.01 either way.
fn waves(x: f64, y: f64) -> f64 {
    0.01 * libm::sin(x) * libm::cos(y)
}

/// The walls of a bore that is larger than its model, and of one whose model has sixteen sides, are no part of the top.
#[test]
fn a_bore_off_its_model_is_no_part_of_the_top() {
    let fine = plate(4.0, TURNS, 0.25, |_, _| 0.0);
    let coarse = plate(4.0, 16, 0.25, |_, _| 0.0);
    for (radius, reference) in [(4.0, &fine), (4.2, &fine), (3.8, &fine), (4.0, &coarse), (4.2, &coarse)] {
        let (c, _) = flatness(plate(radius, TURNS, 0.25, waves), Some(reference), "distance = 1");
        let value = c.value.unwrap();
        assert!((0.018..0.0201).contains(&value), "{radius} {}: {value}", reference.faces.len());
        assert_eq!(c.verdict, Verdict::Pass, "{radius} {}: {:?}", reference.faces.len(), c.notes);
    }
}

/// Without a reference what else was measured tells the walls.
#[test]
fn without_a_reference_walls_are_told_by_what_was_measured() {
    let (c, _) = flatness(plate(4.0, TURNS, 0.25, waves), None, "distance = 1");
    assert!(c.value.unwrap() < 0.0201 && c.verdict == Verdict::Pass, "{:?} {:?}", c.value, c.notes);
}

/// No dent, groove, nick or bump passes: of any depth and steepness, in the middle and at the rims, with a reference and without.
#[test]
fn no_defect_is_dropped() {
    let model = plate(4.0, TURNS, 0.25, |_, _| 0.0);
    for deep in [0.1, 0.9, 1.3, 2.5, -0.4_f64] {
        for steep in [0.5, 30.0] {
            for at in [[12.0, 0.0], [19.5, 3.0], [5.0, 0.0], [0.0, 30.0]] {
                // A round dent; the last is a groove across the plate.
                let shape = |x: f64, y: f64| {
                    let off = if at[1] > 20.0 { y - 10.0 } else { libm::hypot(x - at[0], y - at[1]) };
                    (steep * (1.5 - off.abs())).clamp(0.0, deep.abs()).copysign(deep)
                };
                let spoiled = || plate(4.0, TURNS, 0.25, |x, y| waves(x, y) - shape(x, y));
                for reference in [None, Some(&model)] {
                    let (c, _) = flatness(spoiled(), reference, "distance = 1");
                    let told =
                        format!("{deep} {steep} {at:?} {}: {:?} {:?}", reference.is_some(), c.value, c.notes);
                    // Without a reference a pocket with a face of its own may have been drawn: it is told.
                    let is_told = reference.is_none() && c.notes.iter().any(|n| n.contains("lie over it"));
                    assert!(c.verdict != Verdict::Pass || is_told, "{told}");
                    // What is within reach is judged, not only told; along an edge it may be a burr, a groove, a chamfer.
                    let inside = at != [19.5, 3.0] && at != [5.0, 0.0];
                    if deep.abs() < 1.0 && reference.is_some() && inside {
                        assert_eq!(c.verdict, Verdict::Fail, "{told}");
                    }
                }
            }
        }
    }
}

/// The sign ∅ is the drawing's: it does not go with the value.
#[test]
fn the_zone_of_what_was_not_measured_is_that_of_the_plan() {
    let plan = Plan::parse(
        r#"
        schema = "trueness/plan/1"
        measured = "part.xyz"
        [[feature]]
        id = "A"
        shape = "plane"
        nominal = { point = [0, 0, 0], normal = [0, 0, 1], boundary = [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]] }
        [[feature]]
        id = "B"
        shape = "cylinder"
        nominal = { point = [0, 0, -5], direction = [0, 0, 1], radius = 2, length = 5 }
        [[characteristic]]
        id = "1"
        kind = "perpendicularity"
        feature = "B"
        datums = ["A"]
        tolerance = 0.1
        [[characteristic]]
        id = "2"
        kind = "perpendicularity"
        feature = "B"
        datums = ["A"]
        tolerance = 0.1
        diametral = true
        [[characteristic]]
        id = "3"
        kind = "parallelism"
        feature = "A"
        datums = ["B"]
        tolerance = 0.1
        [[characteristic]]
        id = "4"
        kind = "straightness"
        feature = "B"
        tolerance = 0.1
        [[characteristic]]
        id = "5"
        kind = "position"
        feature = "B"
        datums = ["A"]
        basic = { x = 1, y = 2 }
        tolerance = 0.1
        [[characteristic]]
        id = "6"
        kind = "flatness"
        feature = "A"
        tolerance = 0.1
        "#,
    )
    .unwrap();
    let measured = Some(Scan::Cloud(vec![[500.0, 0.0, 0.0]; 4]));
    let document = document(&plan, Data { measured, ..Data::default() });
    let all = &document.characteristics;
    assert!(all.iter().all(|c| c.verdict == Verdict::NotMeasured));
    let zones: Vec<bool> = all.iter().map(CharacteristicRecord::diametral).collect();
    assert_eq!(zones, [true, true, false, true, true, false]);
}

/// A floor of squares of 1, from 0 to 20, with a square from 3 to 5 raised between upright walls: as eight facets, or as two. No place where
/// features are begun lies on it.
fn padded(height: f64, fine: bool) -> Mesh {
    let mut mesh = Mesh::default();
    let mut quad = |corners: [Point; 4]| {
        let first = corners.map(|p| {
            mesh.positions.iter().position(|q| *q == p).unwrap_or_else(|| {
                mesh.positions.push(p);
                mesh.positions.len() - 1
            }) as u32
        });
        mesh.faces.extend([[first[0], first[1], first[2]], [first[0], first[2], first[3]]]);
    };
    let mut level = |x: f64, y: f64, size: f64, z: f64| {
        quad([[x, y, z], [x + size, y, z], [x + size, y + size, z], [x, y + size, z]]);
    };
    for (x, y) in (0..20).flat_map(|x| (0..20).map(move |y| (f64::from(x), f64::from(y)))) {
        let raised = (3.0..5.0).contains(&x) && (3.0..5.0).contains(&y);
        if !raised {
            level(x, y, 1.0, 0.0);
        } else if fine {
            level(x, y, 1.0, height);
        }
    }
    if !fine {
        level(3.0, 3.0, 2.0, height);
    }
    let corners = [[3.0, 3.0], [5.0, 3.0], [5.0, 5.0], [3.0, 5.0]];
    for k in 0..4 {
        let [[a, b], [c, d]] = [corners[k], corners[(k + 1) % 4]];
        quad([[a, b, 0.0], [c, d, 0.0], [c, d, height], [a, b, height]]);
    }
    mesh
}

/// Document of the flatness of the floor from a mesh.
fn floor(measured: Mesh, reference: Option<Mesh>, rim: bool) -> InspectDocument {
    let plan = Plan::parse(&format!(
        r#"
        schema = "trueness/plan/1"
        measured = "part.stl"
        [[feature]]
        id = "A"
        shape = "plane"
        extract = {{ distance = 1, rim = {rim} }}
        [feature.nominal]
        point = [0, 0, 0]
        normal = [0, 0, 1]
        boundary = [[0, 0, 0], [20, 0, 0], [20, 20, 0], [0, 20, 0]]
        [[characteristic]]
        id = "1"
        kind = "flatness"
        feature = "A"
        tolerance = 0.1
        "#
    ))
    .unwrap();
    let data = Data { measured: Some(measured.into()), reference, ..Data::default() };
    document(&plan, data)
}

/// Pockets, pads and loose pieces between upright walls are joined to their feature by no facet of it, and are of it all the same, unless the
/// reference has them. Without a reference they count too, where they have vertices that no wall has.
#[test]
fn what_lies_apart_within_reach_is_judged() {
    let flat = || padded(0.0, true);
    for (height, fine, rim) in
        [(-0.3, true, true), (0.3, true, false), (0.3, false, true), (-0.3, false, false)]
    {
        let of = |reference| floor(padded(height, fine), reference, rim).characteristics.remove(0);
        let told = format!("{height} {fine} {rim}");
        let c = of(Some(flat()));
        assert!(
            (c.value.unwrap() - 0.3).abs() < 1e-9 && c.verdict == Verdict::Fail,
            "{told} {:?} {:?}",
            c.value,
            c.notes
        );
        let c = of(Some(padded(height, fine)));
        assert!(c.value.unwrap().abs() < 1e-9 && c.verdict == Verdict::Pass, "{told} {:?}", c.value);
        let c = of(None);
        assert!(c.verdict != Verdict::Pass || !rim || !fine, "{told} {:?} {:?}", c.value, c.notes);
    }
    // A piece that touches nothing.
    let mut loose = flat();
    let first = loose.positions.len() as u32;
    loose.positions.extend([[3.2, 3.2, 0.5], [4.8, 3.2, 0.5], [4.8, 4.8, 0.5]]);
    loose.faces.push([first, first + 1, first + 2]);
    let c = floor(loose, Some(flat()), true).characteristics.remove(0);
    assert!((c.value.unwrap() - 0.5).abs() < 1e-9 && c.verdict == Verdict::Fail, "{:?}", c.value);
}

/// Points in a corner of a feature are not the feature, in clouds as in meshes; all of it without its rim is.
#[test]
fn a_corner_of_a_cloud_is_not_its_feature() {
    let part = |share: f64| {
        let mut cloud = plate(4.0, TURNS, 0.25, waves);
        cloud.positions.retain(|p| p[2].abs() < 0.02 && p[0] < -20.0 + 40.0 * share);
        flatness(cloud, None, "distance = 1").0
    };
    let c = part(0.1);
    assert_eq!((c.verdict, c.value), (Verdict::NotMeasured, None));
    let reason = c.reason.unwrap();
    assert!(reason.contains("of its nominal area was measured, less than 25.0 %"), "{reason}");
    assert_eq!(part(0.5).verdict, Verdict::Pass);
    assert_eq!(part(1.0).verdict, Verdict::Pass);
}

/// Copies of points change nothing.
#[test]
fn points_that_come_several_times_count_once() {
    let cloud = plate(4.1, TURNS, 0.25, waves);
    let model = plate(4.0, TURNS, 0.25, |_, _| 0.0);
    let copies = Mesh { positions: cloud.positions.repeat(20), faces: vec![] };
    let (once, often) =
        (flatness(cloud, Some(&model), "distance = 1"), flatness(copies, Some(&model), "distance = 1"));
    assert_eq!((once.0.value, once.1), (often.0.value, often.1));
}

/// A box from 0 to `size` of squares of 2, and what is added to the height of its top.
fn brick(size: [f64; 3], raise: impl Fn(f64, f64) -> f64) -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        for end in [0.0, size[axis]] {
            let first = mesh.positions.len() as u32;
            let [rows, columns] = [u, v].map(|k| (size[k] / 2.0) as u32);
            for (i, j) in (0..=rows).flat_map(|i| (0..=columns).map(move |j| (i, j))) {
                let mut p = [0.0; 3];
                (p[axis], p[u], p[v]) = (end, 2.0 * f64::from(i), 2.0 * f64::from(j));
                if axis == 2 && end > 0.0 {
                    p[2] += raise(p[0], p[1]);
                }
                mesh.positions.push(p);
                if i < rows && j < columns {
                    let a = first + i * (columns + 1) + j;
                    let [b, c, d] = [a + columns + 1, a + columns + 2, a + 1];
                    let out = end > 0.0;
                    mesh.faces.extend(if out { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
                }
            }
        }
    }
    mesh
}

/// Of a brick nobody knows which face is the top: one that is not flat fails in one pose and passes in another, whichever was taken.
#[test]
fn a_part_that_looks_the_same_in_several_ways_is_judged_in_all() {
    let plan = Plan::parse(
        r#"
        schema = "trueness/plan/1"
        measured = "part.stl"
        reference = "brick.stl"
        align = { method = "best-fit" }
        [[feature]]
        id = "top"
        shape = "plane"
        seed = [14, 10, 8]
        [[feature]]
        id = "side"
        shape = "plane"
        seed = [0, 10, 4]
        [[characteristic]]
        id = "1"
        kind = "flatness"
        feature = "top"
        tolerance = 0.02
        [[characteristic]]
        id = "2"
        kind = "flatness"
        feature = "side"
        tolerance = 0.02
        "#,
    )
    .unwrap();
    let size = [28.0, 20.0, 8.0];
    let bumpy =
        brick(size, |x, y| 0.04 * f64::from(u8::from((8.0..20.0).contains(&x) && (6.0..14.0).contains(&y))));
    let mut turned = bumpy.clone();
    turned.positions.iter_mut().for_each(|p| *p = [p[0], size[1] - p[1], size[2] - p[2]]);
    for measured in [bumpy, turned] {
        let reference = Some(brick(size, |_, _| 0.0));
        let data = Data { measured: Some(measured.into()), reference, ..Data::default() };
        let document = document(&plan, data);
        let verdicts: Vec<Verdict> = document.characteristics.iter().map(|c| c.verdict).collect();
        assert_eq!(verdicts, [Verdict::Undecided, Verdict::Pass], "{:?}", document.alignment.warnings);
        let notes = &document.characteristics[0].notes;
        assert!(notes.iter().any(|n| n.contains("in another pose that fits as well")), "{notes:?}");
        assert_eq!(document.verdict, Verdict::Undecided);
    }
}

/// An axis goes as far as its feature does, with its rim, whether that counts for the element or not.
#[test]
fn axes_go_to_the_rim_that_does_not_count() {
    // A shaft along z from 0 to 6 that leans by 0.01, in rings of 1 with both ends closed, over a square.
    let (turns, slope) = (48u32, 0.01);
    let mut mesh = Mesh::default();
    for z in (0..7).map(f64::from) {
        for k in 0..turns {
            let phi = std::f64::consts::TAU * f64::from(k) / f64::from(turns);
            mesh.positions.push([4.0 * libm::cos(phi) + slope * z, 4.0 * libm::sin(phi), z]);
        }
    }
    let at = |row: u32, k: u32| row * turns + k % turns;
    for (row, k) in (0..6).flat_map(|row| (0..turns).map(move |k| (row, k))) {
        let [a, b, c, d] = [at(row, k), at(row, k + 1), at(row + 1, k + 1), at(row + 1, k)];
        mesh.faces.extend([[a, b, c], [a, c, d]]);
    }
    for (row, z) in [(0, 0.0), (6, 6.0)] {
        let center = mesh.positions.len() as u32;
        mesh.positions.push([slope * z, 0.0, z]);
        let fan =
            |k| if row == 0 { [center, at(0, k + 1), at(0, k)] } else { [center, at(6, k), at(6, k + 1)] };
        mesh.faces.extend((0..turns).map(fan));
    }
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([[-9.0, -9.0, -5.0], [9.0, -9.0, -5.0], [9.0, 9.0, -5.0], [-9.0, 9.0, -5.0]]);
    mesh.faces.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    for rim in [true, false] {
        let plan = Plan::parse(&format!(
            r#"
            schema = "trueness/plan/1"
            measured = "part.stl"
            [[feature]]
            id = "A"
            shape = "plane"
            nominal = {{ point = [0, 0, -5], normal = [0, 0, 1], boundary = [[-9, -9, -5], [9, -9, -5], [9, 9, -5], [-9, 9, -5]] }}
            [[feature]]
            id = "B"
            shape = "cylinder"
            nominal = {{ point = [0, 0, 0], direction = [0, 0, 1], radius = 4, length = 6 }}
            extract = {{ rim = {rim} }}
            [[characteristic]]
            id = "1"
            kind = "perpendicularity"
            feature = "B"
            datums = ["A"]
            tolerance = 0.1
            "#
        ))
        .unwrap();
        let data = Data { measured: Some(mesh.clone().into()), ..Data::default() };
        let found = run(&plan, data, &Silent).unwrap();
        let rings = if rim { 7 } else { 5 };
        assert_eq!(
            found.features[1].points.len(),
            rings * turns as usize,
            "{rim} {:?}",
            found.features[1].others
        );
        let value = found.values[0].as_ref().unwrap().value;
        // Its ends are where its points are, whose circles lie across z.
        assert!((value - (6.0 + 8.0 * slope) * slope).abs() < 1e-5, "{rim}: {value}");
    }
}

/// A ramp that was not drawn, up to the border of its feature, or a broken edge: told, and never passed, where nothing was scanned that rounds edges.
#[test]
fn steep_slopes_over_a_feature_are_no_pass() {
    let plate = |ramp: f64, slope: f64| {
        // Rows of 0.5 along x; from `ramp` on they slope beyond the angle of the feature.
        let mut mesh = Mesh::default();
        for (i, j) in (0..=40u32).flat_map(|i| (0..=10u32).map(move |j| (i, j))) {
            let x = 0.5 * f64::from(i);
            mesh.positions.push([x, 2.0 * f64::from(j), slope * (x - ramp).max(0.0)]);
            if i < 40 && j < 10 {
                let a = i * 11 + j;
                mesh.faces.extend([[a, a + 11, a + 12], [a, a + 12, a + 1]]);
            }
        }
        mesh
    };
    let of = |ramp, slope| floor(plate(ramp, slope), Some(plate(99.0, 0.0)), true).characteristics.remove(0);
    for (ramp, slope) in [(18.0, 0.4), (18.0, -0.4), (19.5, 0.4), (19.5, -0.4)] {
        let c = of(ramp, slope);
        assert_eq!((c.value, c.verdict), (Some(0.0), Verdict::Undecided), "{ramp} {slope} {:?}", c.notes);
        assert!(
            c.value_with_others.unwrap() > 0.1 && c.notes[0].contains("along its edges"),
            "{:?}",
            c.notes
        );
    }
}

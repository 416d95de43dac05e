//! Points of a cloud that were left out of a feature as of other surfaces: counted, told, and never a false pass. What a document says
//! of what was not measured.

use super::{Data, run};
use crate::plan::Plan;
use crate::results::Verdict;
use crate::results::inspect::{CharacteristicRecord, InspectDocument, PlanRecord};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Silent;
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

/// Flatness of the top, from a cloud.
fn flatness(cloud: Mesh, reference: Option<&Mesh>, extract: &str) -> (CharacteristicRecord, u64) {
    let plan = Plan::parse(&format!(
        r#"
        schema = "trueness/plan/1"
        measured = "part.xyz"
        [[feature]]
        id = "A"
        shape = "plane"
        extract = {{ {extract} }}
        [feature.nominal]
        point = [0, 0, 0]
        normal = [0, 0, 1]
        boundary = [[-20, -20, 0], [20, -20, 0], [20, 20, 0], [-20, 20, 0]]
        [[characteristic]]
        id = "1"
        kind = "flatness"
        feature = "A"
        tolerance = 0.05
        "#
    ))
    .unwrap();
    let measured = Some(Mesh { faces: vec![], ..cloud });
    let data = Data { measured, reference: reference.cloned(), ..Data::default() };
    let found = run(&plan, data, &Silent).unwrap();
    let record = PlanRecord { path: String::new(), sha256: None };
    let mut document = InspectDocument::new(&plan, record, &found, vec![]);
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
        let (c, left_out) = flatness(plate(radius, TURNS, 0.25, waves), Some(reference), "distance = 1");
        let value = c.value.unwrap();
        assert!((0.018..0.0201).contains(&value), "{radius} {}: {value}", reference.faces.len());
        assert_eq!(c.verdict, Verdict::Pass);
        // Both walls, four rows each, are told, and what they would make of it.
        assert!(left_out >= 2 * 4 * u64::from(TURNS), "{left_out}");
        assert!(c.value_with_others.unwrap() > 0.9, "{:?}", c.value_with_others);
        assert!(c.notes[0].contains("other surfaces of the reference"), "{:?}", c.notes);
        assert!(c.notes[1].ends_with(": fail"), "{:?}", c.notes);
    }
}

/// Without a reference the walls are left out too, but nothing is proven; a margin, where there is no bore within it, decides.
#[test]
fn without_a_reference_walls_are_told_and_nothing_passes() {
    // The outer walls have rows much farther apart than their points, and tell nothing: left out here, they would count.
    let cloud = || {
        let mut cloud = plate(4.0, TURNS, 0.25, waves);
        cloud.positions.retain(|p| p[2].abs() < 0.02 || libm::hypot(p[0], p[1]) < 4.01);
        cloud
    };
    let (c, left_out) = flatness(cloud(), None, "distance = 1");
    assert!(c.value.unwrap() < 0.0201 && c.verdict == Verdict::Undecided, "{:?}", c.value);
    assert!(left_out >= 4 * u64::from(TURNS), "{left_out}");
    assert!(c.notes[1].contains("a reference, or a margin"), "{:?}", c.notes);
    // Without the bore's wall and with a margin there is nothing that could be of something else.
    let mut bare = cloud();
    bare.positions.retain(|p| libm::hypot(p[0], p[1]) > 4.01);
    let (c, left_out) = flatness(bare, None, "distance = 1, margin = 0.5");
    assert_eq!((c.verdict, left_out, c.value_with_others), (Verdict::Pass, 0, None), "{:?}", c.notes);
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
                    let told = format!("{deep} {steep} {at:?} {}: {:?}", reference.is_some(), c.value);
                    assert_ne!(c.verdict, Verdict::Pass, "{told}");
                    // What is within reach is judged, not only told.
                    if deep.abs() < 1.0 && reference.is_some() {
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
    let measured = Some(Mesh { positions: vec![[500.0, 0.0, 0.0]; 4], faces: vec![] });
    let found = run(&plan, Data { measured, ..Data::default() }, &Silent).unwrap();
    let record = PlanRecord { path: String::new(), sha256: None };
    let document = InspectDocument::new(&plan, record, &found, vec![]);
    let all = &document.characteristics;
    assert!(all.iter().all(|c| c.verdict == Verdict::NotMeasured));
    let zones: Vec<bool> = all.iter().map(CharacteristicRecord::diametral).collect();
    assert_eq!(zones, [true, true, false, true, true, false]);
}

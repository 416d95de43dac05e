//! Exact places of plans in datum systems of all kinds: written rightly they are taken, written in another frame, with other signs or along
//! other axes they are refused with what to write.

use crate::common;

use common::round;
use std::collections::BTreeMap;
use trueness_document::inspect::{CharacteristicRecord, PlanRecord};
use trueness_document::plan::PlanError;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Point, Vector, cross, dot, minus, plus, times};
use trueness_measure::inspection::{self, Data, OwnPoints, Stop, run};
use trueness_measure::plan::Plan;

/// A block from the origin to `size` with a bore, and three of its faces as datums.
struct Block {
    size: Point,
    /// Outward normals of the datum faces: each of them along another axis of the model.
    faces: [Vector; 3],
    /// Middle of the bore, whose axis goes along the first normal.
    bore: Point,
    /// By how much it is off there in the part.
    off: Vector,
}

fn axis(k: usize, sign: f64) -> Vector {
    std::array::from_fn(|i| if i == k { sign } else { 0.0 })
}

impl Block {
    fn new(random: &mut Random) -> Block {
        let mut any = |from: f64, to: f64| from + (to - from) * random.unit();
        let size = [any(60.0, 120.0), any(60.0, 120.0), any(20.0, 40.0)];
        let first = any(0.0, 3.0) as usize;
        let second = (first + 1 + any(0.0, 2.0) as usize) % 3;
        let orders = [first, second, 3 - first - second];
        let faces = orders.map(|k| axis(k, if any(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 }));
        // Whole tenths, as on drawings, away from the rim.
        let bore = size.map(|s| (any(0.2 * s, 0.8 * s) * 10.0).round() / 10.0);
        let off: Point = std::array::from_fn(|k| if k == orders[0] { 0.0 } else { any(-0.02, 0.02) });
        Block { size, faces, bore, off }
    }

    /// A corner of the face with this normal.
    fn corner(&self, normal: Vector) -> Point {
        std::array::from_fn(|k| if normal[k] > 0.0 { self.size[k] } else { 0.0 })
    }

    /// Coordinates of a place in the datum system: z, x and y = z × x, into the material.
    fn in_datums(&self, p: Point) -> Point {
        let [a, b, c] = self.faces;
        let (z, x) = (times(-1.0, a), times(-1.0, b));
        let y = cross(z, x);
        let from = |face: Vector, way: Vector| dot(minus(p, self.corner(face)), way);
        [from(b, x), from(c, y), from(a, z)]
    }

    /// Points of the face with this normal, and its nominal.
    fn face(&self, normal: Vector) -> (Vec<Point>, String) {
        let k = (0..3).find(|k| normal[*k] != 0.0).unwrap();
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let at = |s: f64, t: f64| {
            let mut p = self.corner(normal);
            (p[i], p[j]) = (s * self.size[i], t * self.size[j]);
            p
        };
        let points = (0..16).map(|n| at(f64::from(n % 4) / 3.0, f64::from(n / 4) / 3.0)).collect();
        let corners = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
        let nominal = format!("point = {:?}, normal = {normal:?}, boundary = {corners:?}", corners[0]);
        (points, nominal)
    }

    /// Points of the bore, and its nominal.
    fn hole(&self) -> (Vec<Point>, String) {
        let way = self.faces[0].map(f64::abs);
        let k = (0..3).find(|k| way[*k] != 0.0).unwrap();
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let length = self.size[k];
        let middle = plus(self.bore, self.off);
        let points =
            round([0.0; 2], &[0.0, 0.5 * length, length], 12, |_| 5.0).into_iter().map(|[a, b, c]| {
                let mut p = middle;
                (p[i], p[j], p[k]) = (p[i] + a, p[j] + b, c);
                p
            });
        let mut start = self.bore;
        start[k] = 0.0;
        let nominal = format!("point = {start:?}, direction = {way:?}, radius = 5.0, length = {length}");
        (points.collect(), nominal)
    }

    fn inspected(&self, basic: &str) -> Result<CharacteristicRecord, String> {
        let mut text = String::from("schema = \"trueness/plan/1\"\n");
        let mut points = BTreeMap::new();
        let faces = self.faces.map(|normal| self.face(normal));
        for (n, (own, nominal)) in faces.into_iter().chain([self.hole()]).enumerate() {
            let shape = if n < 3 { "plane" } else { "cylinder" };
            let id = ["A", "B", "C", "H"][n];
            text += &format!(
                "[[feature]]\nid = \"{id}\"\nshape = \"{shape}\"\npoints = \"p\"\nnominal = {{ {nominal} }}\n"
            );
            points.insert(n, OwnPoints { points: own, planar: false });
        }
        text += &format!(
            "[[characteristic]]\nid = \"1\"\nkind = \"position\"\nfeature = \"H\"\ndatums = [\"A\", \"B\", \"C\"]\n\
             tolerance = 0.1\n{basic}\n"
        );
        let plan = Plan::parse(&text).map_err(|e| e.to_string())?;
        let found = run(&plan, Data { points, ..Data::default() }, &Silent).map_err(|stop| match stop {
            Stop::Plan { span, what } => PlanError::at(&text, &span, what).to_string(),
            stop => panic!("{stop}"),
        })?;
        let record = PlanRecord { path: "plan".into(), sha256: None };
        Ok(inspection::document(&plan, record, &found, vec![]).characteristics.remove(0))
    }
}

fn basic(x: f64, y: f64) -> String {
    format!("basic = {{ x = {x}, y = {y} }}")
}

/// What a number of a plan may be off by its rounding, mm: the plans of these tests are written with six decimals.
const WRITTEN: f64 = 0.5e-6;
/// By how much a value may then differ: twice the distance of the written place, rounded in both coordinates, from the true one.
const OF_WRITTEN: f64 = 2.0 * std::f64::consts::SQRT_2 * WRITTEN;
/// What the computation itself may add.
const COMPUTED: f64 = 1e-8;

/// What 250 plans of each kind come to.
#[derive(Debug, Default, PartialEq)]
struct Rates {
    right: u32,
    refused: u32,
    without_a_word: u32,
    alike: u32,
}

#[test]
fn places_in_another_frame_or_order_are_refused_and_right_ones_taken() {
    let mut random = Random::new(20_261_128);
    let mut rates = Rates::default();
    for n in 0..250 {
        let block = Block::new(&mut random);
        let [x, y, _] = block.in_datums(block.bore);
        let (x, y) = ((x * 1e6).round() / 1e6, (y * 1e6).round() / 1e6);
        let value = 2.0 * dot(block.off, block.off).sqrt();
        // As the drawing has it, without (the model's, of which no digit is lost), and a hundredth beside it.
        let beside = 2.0 * 0.01 + OF_WRITTEN;
        for (written, rounded) in
            [(basic(x, y), OF_WRITTEN), (String::new(), 0.0), (basic(x + 0.01, y), beside)]
        {
            let within = rounded + COMPUTED;
            let found = block.inspected(&written).unwrap_or_else(|e| panic!("{n}: {written}: {e}"));
            let there = found.value.unwrap_or_else(|| panic!("{n}: {:?}", found.reason));
            assert!((there - value).abs() <= within, "{n}: {written}: {there} for {value}");
            assert_eq!(found.notes, Vec::<String>::new());
            let place = found.place.unwrap();
            let off = place.deviation.into_iter().flatten().fold(0.0, f64::hypot);
            assert!((2.0 * off - there).abs() < 1e-6, "{n}: {place:?}");
            rates.right += 1;
        }
        // The model's own coordinates, other signs, the other order.
        let [i, j] = match block.faces[0].map(f64::abs) {
            [1.0, ..] => [1, 2],
            [_, 1.0, _] => [0, 2],
            _ => [0, 1],
        };
        let model = format!(
            "basic = {{ {} = {}, {} = {} }}",
            ["x", "y", "z"][i],
            block.bore[i],
            ["x", "y", "z"][j],
            block.bore[j]
        );
        let is_alike = |a: f64, b: f64| (a - x).hypot(b - y) < 0.05;
        let of_model = if [i, j] == [0, 1] { is_alike(block.bore[0], block.bore[1]) } else { false };
        let wrong = [
            (model, of_model),
            (basic(-x, y), is_alike(-x, y)),
            (basic(x, -y), is_alike(x, -y)),
            (basic(-x, -y), is_alike(-x, -y)),
            (basic(y, x), is_alike(y, x)),
            (basic(-y, x), is_alike(-y, x)),
            // Off by a digit: no other reading fits.
            (basic(x + 10.0, y), false),
        ];
        for (written, alike) in wrong {
            match block.inspected(&written) {
                Err(said) => {
                    let at = said
                        .split_once("write basic = { x = ")
                        .map(|(_, rest)| rest.split_once(" }").unwrap().0);
                    let at = at.unwrap_or_else(|| panic!("{n}: {written}: {said}"));
                    let (a, b) = at.split_once(", y = ").unwrap();
                    let (a, b): (f64, f64) = (a.parse().unwrap(), b.parse().unwrap());
                    assert!((a - x).hypot(b - y) < 1e-3, "{n}: {x} {y}: {said}");
                    assert!(said.starts_with("line "), "{said}");
                    rates.refused += 1;
                }
                Ok(_) if alike => rates.alike += 1,
                Ok(found) if found.notes.is_empty() => {
                    println!("{n}: {written} for {x}, {y}: {:?}", found.value);
                    rates.without_a_word += 1;
                }
                Ok(_) => rates.refused += 1,
            }
        }
    }
    assert_eq!((rates.right, rates.without_a_word), (750, 0), "{rates:?}");
    assert_eq!(rates.refused + rates.alike, 1750, "{rates:?}");
}

/// Between the tolerance and the distance within which the feature is sought nobody can tell what is meant: it is told.
#[test]
fn a_place_a_little_off_is_told() {
    let block = Block {
        size: [120.0, 80.0, 20.0],
        faces: [axis(2, -1.0), axis(1, -1.0), axis(0, -1.0)],
        bore: [67.0, 42.0, 10.0],
        off: [0.01, 0.0, 0.0],
    };
    let found = block.inspected("basic = { x = 42.2, y = -67 }").unwrap();
    assert!(found.notes[0].contains("0.2 mm off the model's feature \"H\""), "{:?}", found.notes);
    let said = block.inspected("basic = { x = 67, y = 42 }").unwrap_err();
    for part in [
        "line 28, column 9: \"1\": x = 67, y = 42 in the datum system A | B | C",
        "the model has it at x = 67, y = 42, z = 10, ",
        "which is x = 42, y = -67 in the datum system A | B | C",
        "the plan's numbers are coordinates of the model",
        "write basic = { x = 42, y = -67 }, or leave it out",
    ] {
        assert!(said.contains(part), "{part}\n{said}");
    }
}

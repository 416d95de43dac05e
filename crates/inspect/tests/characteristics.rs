//! Every characteristic of the list: a case in closed form, moved rigidly, with too few points, and the zone against least
//! squares.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Point;
use trueness_inspect::characteristic::ALL;
use trueness_inspect::inspection::{Data, Inspection, OwnPoints, Stop, run};
use trueness_inspect::plan::Plan;

/// Features by name and shape, with their points; further lines of the characteristic; the value.
struct Case {
    kind: &'static str,
    features: Vec<(&'static str, &'static str, Vec<Point>)>,
    more: String,
    value: f64,
}

const H: f64 = 0.01;

fn grid(f: impl Fn(f64, f64) -> Point) -> Vec<Point> {
    (0..25).map(|k| f(f64::from(k % 5) * 10.0, f64::from(k / 5) * 10.0)).collect()
}

fn floor() -> Vec<Point> {
    grid(|x, y| [x, y, 0.0])
}

/// A cylinder or circles about an axis along z, its radius as a function of the number of the point around.
fn round(center: [f64; 2], levels: &[f64], around: usize, radius: impl Fn(usize) -> f64) -> Vec<Point> {
    let at = |k: usize, z: f64| {
        let angle = TAU * k as f64 / around as f64;
        [center[0] + radius(k) * angle.cos(), center[1] + radius(k) * angle.sin(), z]
    };
    levels.iter().flat_map(|z| (0..around).map(move |k| at(k, *z))).collect()
}

const LEVELS: [f64; 4] = [0.0, 5.0, 10.0, 20.0];

fn lobes(k: usize) -> f64 {
    if k.is_multiple_of(2) { 8.0 + H } else { 8.0 - H }
}

fn case(
    kind: &'static str,
    features: &[(&'static str, &'static str, Vec<Point>)],
    more: &str,
    value: f64,
) -> Case {
    Case { kind, features: features.to_vec(), more: more.into(), value }
}

fn forms() -> Vec<Case> {
    // Up at two opposite corners, down at the others: no tilt helps.
    let twist: Vec<Point> = vec![[-9.0, -9.0, H], [9.0, 9.0, H], [-9.0, 9.0, -H], [9.0, -9.0, -H], [0.0; 3]];
    let nominal = "nominal = { point = [0, 0, 0], normal = [0, 0, 1], boundary = [[-9, -9, 0], [9, -9, 0], [9, 9, 0]] }";
    vec![
        case("straightness", &[("F", "line", round([0.0; 2], &LEVELS, 3, |_| H))], "", 2.0 * H),
        case("flatness", &[("F", "plane", twist.clone())], "", 2.0 * H),
        case("roundness", &[("F", "circle", round([0.0; 2], &[3.0], 8, lobes))], "", 2.0 * H),
        case("cylindricity", &[("F", "cylinder", round([0.0; 2], &LEVELS, 8, lobes))], "", 2.0 * H),
        Case {
            kind: "surface-profile",
            features: vec![("F", "plane", twist)],
            more: format!("#feature {nominal}"),
            value: 2.0 * H,
        },
    ]
}

fn oriented() -> Vec<Case> {
    let datum = ("A", "plane", floor());
    let tilted = grid(|x, y| [x, y, 5.0 + 1e-3 * x]);
    let leaning = grid(|y, z| [2e-3 * z, y, z]);
    // A slope at 30° and a little more: the turn about the datum cannot mend its angle.
    let (angle, more) = (PI / 6.0, 1e-3f64);
    let slope = grid(|x, y| [x * (angle + more).cos(), y, x * (angle + more).sin()]);
    let pin = round([3.0, 4.0], &LEVELS, 8, |_| 5.0);
    let leaning_pin: Vec<Point> = pin.iter().map(|p| [p[0] + 1e-3 * p[2], p[1], p[2]]).collect();
    let one = "datums = [\"A\"]";
    vec![
        case("parallelism", &[("F", "plane", tilted), datum.clone()], one, 0.04),
        case("perpendicularity", &[("F", "plane", leaning), datum.clone()], one, 0.08),
        case(
            "angularity",
            &[("F", "plane", slope), datum.clone()],
            "basic = { angle = 30 }\ndatums = [\"A\"]",
            40.0 * more.sin(),
        ),
        case(
            "perpendicularity",
            &[("F", "line", vec![[1.0, 1.0, 0.0], [1.03, 1.04, 9.0]]), datum.clone()],
            one,
            0.05,
        ),
        // The sections of the sheared cylinder stay circles: its axis leans by 1e-3 of its length.
        case(
            "coaxiality",
            &[("F", "cylinder", pin.clone()), ("A", "cylinder", round([3.0, 4.02], &LEVELS, 8, |_| 9.0))],
            one,
            0.04,
        ),
        case("angle", &[("F", "plane", grid(|x, y| [x, y, x])), datum], "datums = [\"A\"]", 45.0),
        case(
            "parallelism",
            &[
                ("F", "line", leaning_pin[..1].iter().chain(&leaning_pin[24..25]).copied().collect()),
                ("A", "cylinder", pin),
            ],
            one,
            0.02,
        ),
    ]
}

fn located() -> Vec<Case> {
    let floor = ("A", "plane", floor());
    let wall = ("B", "plane", grid(|y, z| [0.0, y, z]));
    let front = ("C", "plane", grid(|x, z| [x, 0.0, z]));
    let pin = ("F", "cylinder", round([20.03, 20.04], &[1.0, 9.0], 8, |_| 5.0));
    let place = "basic = { x = 20, y = 20 }\ndatums = [\"A\", \"B\", \"C\"]";
    let ring = ("F", "circle", round([0.03, 0.0], &[5.0], 8, |_| 4.0));
    let shaft = ("A", "cylinder", round([0.0; 2], &LEVELS, 8, |_| 9.0));
    let disc = ("F", "plane", grid(|x, y| [x, y, 30.0 + 1e-3 * x]));
    let drum = ("F", "cylinder", round([0.03, 0.0], &LEVELS, 8, |_| 4.0));
    let sides = [
        ("L", "plane", grid(|y, z| [10.01, y, z])),
        ("M", "plane", grid(|y, z| [30.03, y, z])),
        ("O", "plane", grid(|y, z| [0.0, y, z])),
        ("P", "plane", grid(|y, z| [40.0, y, z])),
    ];
    let roof = ("F", "plane", grid(|x, y| [x, y, 7.0]));
    let checkered =
        grid(|x, y| [x, y, if (x as u32 / 10 + y as u32 / 10).is_multiple_of(2) { H } else { -H }]);
    let checkered: Vec<Point> = checkered.into_iter().filter(|p| p[0] < 40.0 && p[1] < 40.0).collect();
    let two = "datums = [\"A\", \"B\"]\nbasic = { x = 20 }";
    vec![
        case("position", &[pin.clone(), floor.clone(), wall.clone(), front], place, 0.1),
        // Free along the edge of A and B: the place along it does not count, and x alone holds it.
        case("position", &[pin, floor.clone(), wall], two, 0.06),
        case("symmetry", &sides, "#median", 0.04),
        case("circular-runout", &[ring.clone(), shaft.clone()], "datums = [\"A\"]", 0.06),
        case("total-runout", &[drum.clone(), shaft.clone()], "datums = [\"A\"]", 0.06),
        case("total-runout", &[disc, shaft], "datums = [\"A\"]", 0.04),
        case("size", std::slice::from_ref(&drum), "size = \"GG\"", 8.0),
        case("size", std::slice::from_ref(&drum), "size = \"GN\"", 8.0),
        case("size", std::slice::from_ref(&drum), "size = \"GX\"", 8.0),
        case("size", &[drum], "size = \"GC\"", 8.0),
        case("size", &[roof.clone(), floor.clone()], "#both\nsize = \"GG\"", 7.0),
        case("distance", &[roof, floor], "datums = [\"A\"]", 7.0),
        case("texture", &[("F", "plane", checkered)], "parameter = \"Sa\"", H),
    ]
}

impl Case {
    fn plan(&self, more: &str) -> Plan {
        let mut text = String::from("schema = \"trueness/plan/1\"\n");
        for (id, shape, _) in &self.features {
            text += &format!("[[feature]]\nid = \"{id}\"\nshape = \"{shape}\"\npoints = \"{id}\"\n");
            if let (Some(nominal), "F") = (self.more.strip_prefix("#feature "), *id) {
                text += &format!("{nominal}\n");
            }
        }
        let (mut feature, mut lines) = ("\"F\"".to_string(), self.more.clone());
        if self.more == "#median" {
            for (id, of) in [("MID", "[\"L\", \"M\"]"), ("DATUM", "[\"O\", \"P\"]")] {
                text += &format!("[[feature]]\nid = \"{id}\"\nderived = \"median-plane\"\nof = {of}\n");
            }
            (feature, lines) = ("\"MID\"".into(), "datums = [\"DATUM\"]".into());
        } else if self.more.starts_with("#both") {
            feature = "[\"F\", \"A\"]".into();
        }
        lines = lines.lines().filter(|l| !l.starts_with('#')).collect::<Vec<_>>().join("\n");
        let limits = match self.kind {
            "size" | "distance" | "angle" => "nominal = 1\nupper = 1\nlower = -1",
            _ => "tolerance = 1",
        };
        text += &format!(
            "[[characteristic]]\nid = \"1\"\nkind = \"{}\"\nfeature = {feature}\n{limits}\n{lines}\n{more}\n",
            self.kind
        );
        Plan::parse(&text).unwrap_or_else(|e| panic!("{}: {e}\n{text}", self.kind))
    }

    fn run(&self, more: &str, change: impl Fn(&[Point]) -> Vec<Point>) -> Result<Inspection, Stop> {
        let own = |points: &[Point]| OwnPoints { points: change(points), planar: false };
        let points: BTreeMap<usize, OwnPoints> =
            self.features.iter().enumerate().map(|(n, f)| (n, own(&f.2))).collect();
        run(&self.plan(more), Data { points, ..Data::default() }, &Silent)
    }

    fn value(&self, more: &str, change: impl Fn(&[Point]) -> Vec<Point>) -> f64 {
        let found = self.run(more, change).unwrap_or_else(|e| panic!("{}: {e}", self.kind));
        found.values[0].as_ref().unwrap_or_else(|e| panic!("{}: {e}", self.kind)).value
    }
}

fn cases() -> Vec<Case> {
    forms().into_iter().chain(oriented()).chain(located()).collect()
}

#[test]
fn every_kind_has_its_closed_form() {
    let cases = cases();
    for kind in ALL {
        assert!(cases.iter().any(|c| c.kind == kind.word()), "{} has no case", kind.word());
        assert!(!kind.standard().is_empty());
    }
    for c in &cases {
        let value = c.value("", <[Point]>::to_vec);
        assert!((value - c.value).abs() < 1e-9, "{} {}: {value} instead of {}", c.kind, c.more, c.value);
    }
}

#[test]
fn values_do_not_depend_on_the_frame() {
    let far = Rigid::rotation_about([1.0, 2.0, 3.0], [0.7, -1.9, 0.4]);
    let far = Rigid::translation_by([120.0, -340.0, 56.0]).after(&far);
    // A nominal surface does not move with the data: it is found again after a small motion.
    let small = Rigid::rotation_about([1.0, 2.0, 3.0], [1e-3, 2e-3, -1e-3]);
    for c in cases() {
        let motion = if c.kind == "surface-profile" { small } else { far };
        let value = c.value("", |points| points.iter().map(|p| motion.point(*p)).collect());
        assert!((value - c.value).abs() < 1e-8, "{} {}: {value} instead of {}", c.kind, c.more, c.value);
    }
}

#[test]
fn too_few_points_are_not_measured() {
    for c in cases() {
        let found = c.run("", |points| points[..1].to_vec());
        match found {
            Ok(found) => {
                let reason = found.values[0].as_ref().unwrap_err();
                assert!(reason.contains("points"), "{}: {reason}", c.kind);
            }
            Err(e) => panic!("{}: {e}", c.kind),
        }
        // The toleranced feature alone: its datums are there.
        let mut short = Case { features: c.features.clone(), more: c.more.clone(), ..c };
        short.features[0].2.truncate(1);
        let found = short.run("", <[Point]>::to_vec).unwrap();
        assert!(found.values[0].is_err(), "{}: {:?}", c.kind, found.values[0]);
        let none = c.run("", |_| vec![]).unwrap();
        assert!(none.values[0].is_err(), "{}", c.kind);
    }
}

#[test]
fn no_zone_is_wider_than_that_of_least_squares() {
    for c in forms().iter().filter(|c| c.kind != "surface-profile") {
        for seed in 0..10 {
            let noise = |points: &[Point]| -> Vec<Point> {
                let mut random = Random::new(seed);
                let many = (0..6).flat_map(|_| points.iter().copied());
                many.map(|p| p.map(|x| x + 0.02 * (random.unit() - 0.5))).collect()
            };
            let (zone, squares) =
                (c.value("method = \"minimum-zone\"", noise), c.value("method = \"gaussian\"", noise));
            assert!(zone <= squares * (1.0 + 1e-12), "{} {seed}: {zone} > {squares}", c.kind);
            assert!(zone > 0.0);
        }
    }
}

//! Every characteristic of the list: a case in closed form, moved rigidly, with too few points, and the zone against least
//! squares.

use crate::common;

use common::{far, grid, round};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Point;
use trueness_measure::characteristic::ALL;
use trueness_measure::inspection::{Data, Inspection, OwnPoints, Stop, run};
use trueness_measure::plan::Plan;

/// Features by name and shape, with their points; further lines of the characteristic; the value.
struct Case {
    kind: &'static str,
    features: Vec<(&'static str, &'static str, Vec<Point>)>,
    more: String,
    value: f64,
}

const H: f64 = 0.01;

fn floor() -> Vec<Point> {
    grid(|x, y| [x, y, 0.0])
}

const LEVELS: [f64; 4] = [0.0, 5.0, 10.0, 20.0];

fn lobes(k: usize) -> f64 {
    if k.is_multiple_of(2) { 8.0 + H } else { 8.0 - H }
}

/// A pin whose axis is off by `H` halfway: the thinnest cylinder around its three centers has that diameter.
fn bent() -> Vec<Point> {
    let ring = |x: f64, z: f64| round([x, 0.0], &[z], 8, |_| 5.0);
    [ring(0.0, 0.0), ring(H, 10.0), ring(0.0, 20.0)].concat()
}

/// Rows of points up and down in turn, each with a height and a slope of its own: each lies in a zone of its own.
fn rows() -> Vec<Point> {
    let row = |k: usize| {
        let way = Rigid::rotation_about([0.0; 3], [0.0, 1e-3 * k as f64, 0.0]);
        let zigzag = move |i: usize| [i as f64, 0.0, if i.is_multiple_of(2) { H } else { -H }];
        (0..7)
            .map(move |i| way.point(zigzag(i)))
            .map(move |[x, y, z]| [x, y + 6.0 * k as f64, z + 0.02 * k as f64])
    };
    (0..4).flat_map(row).collect()
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
        case("straightness", &[("F", "cylinder", bent())], "", H),
        case("flatness", &[("F", "plane", twist.clone())], "", 2.0 * H),
        case("roundness", &[("F", "circle", round([0.0; 2], &[3.0], 8, lobes))], "", 2.0 * H),
        case("cylindricity", &[("F", "cylinder", round([0.0; 2], &LEVELS, 8, lobes))], "", 2.0 * H),
        case("surface-profile", &[("F", "plane", twist)], &format!("#feature {nominal}"), 2.0 * H),
        case(
            "line-profile",
            &[("F", "plane", rows())],
            &format!("#feature {nominal}\nintersection = [0, 1, 0]"),
            2.0 * H,
        ),
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

/// Zones that a second datum locks further, and common datums.
fn systems() -> Vec<Case> {
    let floor = ("A", "plane", floor());
    let wall = ("B", "plane", grid(|y, z| [0.0, y, z]));
    let two = "datums = [\"A\", \"B\"]";
    // Upright, but turned about the normal of the floor: with the floor alone its value is 0.
    let turned = ("F", "plane", grid(|y, z| [30.0 + 1e-3 * y, y, z]));
    // A slope of 30° that dips towards the wall, turned about the vertical by a small angle.
    let (angle, off) = (PI / 6.0, 1e-3f64);
    let slope = |azimuth: f64| -> Vec<Point> {
        grid(|s, t| {
            let (x, y, z) = (s * angle.cos(), t - 20.0, s * angle.sin());
            [x * azimuth.cos() - y * azimuth.sin(), x * azimuth.sin() + y * azimuth.cos(), z]
        })
    };
    // The normal of the slope and that of the zone are `off` apart about the vertical: seen along the zone's normal the
    // corners of the slope spread by their places across and along the slope.
    let spread = |off: f64| {
        let height = |s: f64, t: f64| {
            let x = s * angle.cos() * off.cos() - (t - 20.0) * off.sin();
            x * -angle.sin() + s * angle.sin() * angle.cos()
        };
        let corners = [height(0.0, 0.0), height(40.0, 0.0), height(0.0, 40.0), height(40.0, 40.0)];
        let most = corners.iter().fold(f64::NEG_INFINITY, |m, x| m.max(*x));
        most - corners.iter().fold(f64::INFINITY, |m, x| m.min(*x))
    };
    let level = vec![[0.0, 20.0, 5.0], [40.0, 20.03, 5.04]];
    // Two seats of a shaft, off to either side: their common axis goes through the middle between them.
    let e = 2e-3;
    let (seat, other) =
        (round([e, 0.0], &[0.0, 10.0], 8, |_| 9.0), round([-e, 0.0], &[90.0, 100.0], 8, |_| 7.0));
    let (seat, other) = (("A", "cylinder", seat), ("B", "cylinder", other));
    let ring = ("F", "circle", round([0.0, 0.03], &[50.0], 8, |_| 12.0));
    let pads = [
        ("F", "plane", grid(|x, y| [x + 50.0, y, 9.0 + 1e-3 * x])),
        ("A", "plane", grid(|x, y| [x, y, 0.0])),
        ("B", "plane", grid(|x, y| [x + 200.0, y, 0.0])),
    ];
    let slot = [
        ("F", "plane", grid(|y, z| [10.02, y, z])),
        ("A", "plane", grid(|y, z| [0.0, y, z])),
        ("B", "plane", grid(|y, z| [20.0, y, z])),
    ];
    vec![
        case("perpendicularity", &[turned, floor.clone(), wall.clone()], two, 0.04),
        case(
            "angularity",
            &[("F", "plane", slope(off)), floor.clone(), wall.clone()],
            "basic = { angle = 30 }\ndatums = [\"A\", \"B\"]",
            spread(off),
        ),
        case(
            "angularity",
            &[("F", "plane", slope(PI / 4.0 + off)), floor.clone(), wall.clone()],
            "basic = { angle = 30, turn = 45 }\ndatums = [\"A\", \"B\"]",
            spread(off),
        ),
        case(
            "parallelism",
            &[("F", "line", level), floor, wall],
            "diametral = true\ndatums = [\"A\", \"B\"]",
            0.05,
        ),
        case("coaxiality", &[ring, seat, other], "datums = [\"A-B\"]", 0.06),
        case("parallelism", &pads, "datums = [\"A-B\"]", 0.04),
        case("symmetry", &slot, "datums = [\"A-B\"]", 0.04),
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
    let two = "datums = [\"A\", \"B\"]\nbasic = { x = 20 }\ndiametral = false";
    let above = checkered.iter().map(|[x, y, z]| [*x, *y, z + 7.0]).collect();
    let rough = [("F", "plane", above), ("A", "plane", checkered.clone())];
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
        case("size", std::slice::from_ref(&drum), "size = \"GC\"", 8.0),
        case("size", &[drum], "size = \"LP\"", 8.0),
        case("size", &[roof.clone(), floor.clone()], "#both\nsize = \"GG\"", 7.0),
        case("size", &[roof.clone(), floor.clone()], "#both\nsize = \"LP\"", 7.0),
        // Both faces up and down by the same: the pair around them, the pair between them, the pair in the middle.
        case("size", &rough, "#both\nsize = \"GN\"", 7.0 + 2.0 * H),
        case("size", &rough, "#both\nsize = \"GX\"", 7.0 - 2.0 * H),
        case("size", &rough, "#both\nsize = \"GC\"", 7.0),
        case("distance", &[roof, floor], "datums = [\"A\"]", 7.0),
        case("texture", &[("F", "plane", checkered)], "parameter = \"Sa\"", H),
    ]
}

impl Case {
    fn plan(&self, more: &str) -> Plan {
        let mut text = String::from("schema = \"trueness/plan/1\"\n");
        for (id, shape, _) in &self.features {
            text += &format!("[[feature]]\nid = \"{id}\"\nshape = \"{shape}\"\npoints = \"{id}\"\n");
            if let (Some(line), "F") = (self.more.lines().next(), *id) {
                text += &format!("{}\n", line.strip_prefix("#feature ").unwrap_or_default());
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
    forms().into_iter().chain(oriented()).chain(systems()).chain(located()).collect()
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
    let far = far();
    // A nominal surface does not move with the data: it is found again after a small motion.
    let small = Rigid::rotation_about([1.0, 2.0, 3.0], [1e-3, 2e-3, -1e-3]);
    // Neither do intersection planes: a line is found again after a motion within its own.
    let within = Rigid::rotation_about([1.0, 2.0, 3.0], [0.0, 2e-3, 0.0]);
    for c in cases() {
        let motion = match c.kind {
            "surface-profile" => small,
            "line-profile" => within,
            _ => far,
        };
        let value = c.value("", |points| points.iter().map(|p| motion.point(*p)).collect());
        assert!((value - c.value).abs() < 1e-8, "{} {}: {value} instead of {}", c.kind, c.more, c.value);
    }
}

/// What a second datum locks is free without it: the value can only fall.
#[test]
fn a_second_datum_locks_the_zone_further() {
    let values = [("perpendicularity", 0.0), ("angularity", 0.0), ("parallelism", 0.04)];
    for (kind, value) in values {
        let mut c = systems().into_iter().find(|c| c.kind == kind).unwrap();
        let both = c.value("", <[Point]>::to_vec);
        c.more = c.more.replace(", \"B\"", "");
        let alone = c.value("", <[Point]>::to_vec);
        assert!((alone - value).abs() < 1e-9 && alone < both, "{kind}: {alone} {both}");
    }
    // The second datum lies across the first one's axis: it locks no turn, and that is said.
    let shaft = ("A", "cylinder", round([0.0; 2], &LEVELS, 8, |_| 9.0));
    let end = ("B", "plane", grid(|x, y| [x, y, 20.0]));
    let side = ("F", "plane", grid(|y, z| [9.0 + 1e-3 * z, y, z]));
    let c = case("parallelism", &[side, shaft, end], "datums = [\"A\", \"B\"]", 0.04);
    let found = c.run("", <[Point]>::to_vec).unwrap();
    let value = found.values[0].as_ref().unwrap();
    assert!((value.value - 0.04).abs() < 1e-9, "{}", value.value);
    assert!(value.notes[0].contains("lock the zone no further"), "{:?}", value.notes);
    // A wall at 20° to the second datum is neither along nor across it.
    let askew = grid(|y, z| [y * 20f64.to_radians().sin(), y * 20f64.to_radians().cos(), z]);
    let two = "datums = [\"A\", \"B\"]";
    let datums = [("A", "plane", floor()), ("B", "plane", grid(|y, z| [0.0, y, z]))];
    let features = [("F", "plane", askew), datums[0].clone(), datums[1].clone()];
    match case("perpendicularity", &features, two, 0.0).run("", <[Point]>::to_vec) {
        Err(Stop::Plan { what, .. }) => assert!(what.contains("not as drawn"), "{what}"),
        other => panic!("{:?}", other.map(|f| f.values)),
    }
}

#[test]
fn too_few_points_are_not_measured() {
    for c in cases() {
        let found = c.run("", |points| points[..1].to_vec());
        match found {
            Ok(found) => {
                let reason = found.values[0].as_ref().unwrap_err();
                assert!(reason.to_string().contains("points"), "{}: {reason}", c.kind);
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
    for c in forms().iter().filter(|c| !c.kind.ends_with("profile")) {
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

//! Material requirements: closed forms of perfect cylinders, gauges by brute force, datums that shift.

use crate::common;

use common::{far, grid, round};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_6, TAU};
use trueness_document::Verdict;
use trueness_document::inspect::{CharacteristicRecord, PlanRecord};
use trueness_document::plan::MaterialWord;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Point;
use trueness_measure::inspection::{self, Data, Inspection, OwnPoints, run};
use trueness_measure::plan::Plan;

/// A floor A, and a cylinder F of 10 ± 0.1, bore or shaft, with further features.
struct Case {
    internal: bool,
    feature: Vec<Point>,
    more: Vec<(&'static str, String, Vec<Point>)>,
    lines: String,
}

impl Case {
    fn new(internal: bool, feature: Vec<Point>, lines: &str) -> Case {
        Case { internal, feature, more: vec![], lines: lines.into() }
    }

    /// With a shaft B of 8 ± `limit`.
    fn with_shaft(mut self, points: Vec<Point>, limit: f64) -> Case {
        let size = format!(
            "internal = false\n[[characteristic]]\nid = \"size B\"\nkind = \"size\"\nfeature = \"B\"\nsize = \"GN\"\n\
             nominal = 8\nupper = {limit}\nlower = -{limit}\n"
        );
        self.more.push(("B", size, points));
        self
    }

    fn inspected(&self, motion: &Rigid) -> (Inspection, CharacteristicRecord) {
        let mut text = String::from("schema = \"trueness/plan/1\"\n");
        let mut add = |id: &str, shape: &str, lines: &str| {
            let (own, rest) =
                lines.split_once("[[").map_or((lines, String::new()), |(a, b)| (a, format!("[[{b}")));
            text += &format!("[[feature]]\nid = \"{id}\"\nshape = \"{shape}\"\npoints = \"{id}\"\n{own}\n");
            rest
        };
        add("A", "plane", "");
        add("F", "cylinder", &format!("internal = {}", self.internal));
        let rest: String = self.more.iter().map(|(id, lines, _)| add(id, "cylinder", lines)).collect();
        text += &rest;
        text += "[[characteristic]]\nid = \"size\"\nkind = \"size\"\nfeature = \"F\"\nsize = \"GX\"\nnominal = 10\n";
        text += "upper = 0.1\nlower = -0.1\n";
        text +=
            &format!("[[characteristic]]\nid = \"1\"\nfeature = \"F\"\ntolerance = 0.2\n{}\n", self.lines);
        let plan = Plan::parse(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let own = |points: &[Point]| OwnPoints {
            points: points.iter().map(|p| motion.point(*p)).collect(),
            planar: false,
        };
        let mut points = BTreeMap::from([(0, own(&grid(|x, y| [x, y, 0.0]))), (1, own(&self.feature))]);
        points.extend(self.more.iter().enumerate().map(|(n, (_, _, p))| (n + 2, own(p))));
        let found = run(&plan, Data { points, ..Data::default() }, &Silent).unwrap();
        let record = PlanRecord { path: "plan".into(), sha256: None };
        let mut document = inspection::document(&plan, record, &found, vec![]);
        (found, document.characteristics.pop().unwrap())
    }

    /// Value and greatest allowed value, the same wherever the part lies.
    fn values(&self, within: f64) -> (f64, f64) {
        let (_, here) = self.inspected(&Rigid::IDENTITY);
        let (_, there) = self.inspected(&far());
        let value = here.value.unwrap_or_else(|| panic!("{:?}", here.reason));
        assert!((value - there.value.unwrap()).abs() < within, "{value} {:?}", there.value);
        assert!((here.upper - there.upper).abs() < within);
        (value, here.upper)
    }
}

fn near(found: (f64, f64), wanted: (f64, f64), within: f64) {
    let close = (found.0 - wanted.0).abs() < within && (found.1 - wanted.1).abs() < within;
    assert!(close, "{found:?} instead of {wanted:?}");
}

const LEVELS: [f64; 3] = [1.0, 5.0, 11.0];

/// So many points around that a gauge gains nothing by lying between two of them.
fn pin(x: f64, diameter: f64) -> Vec<Point> {
    round([x, 0.0], &LEVELS, 360, |_| 0.5 * diameter)
}

const PLACE: &str = "kind = \"position\"\nbasic = { x = 0, y = 0 }\n";
/// The frame of the measured part itself.
const HERE: &str = "frame = { origin = [0, 0, 0], x = [1, 0, 0], z = [0, 0, 1] }\n";

/// A perfect cylinder, off by 0.15: the value is twice that, the bonus what its size leaves of the limit.
#[test]
fn perfect_cylinders_have_the_bonus_of_their_size() {
    // (bore, requirement, diameter, bonus)
    for (internal, letter, diameter, bonus) in [
        (true, "M", 10.04, 0.14),
        (false, "M", 9.97, 0.13),
        (true, "L", 10.04, 0.06),
        (false, "L", 9.97, 0.07),
        // Beyond the limit the bonus is below 0.
        (true, "M", 9.85, -0.05),
        (false, "L", 9.8, -0.1),
    ] {
        let lines = format!("{PLACE}{HERE}material = \"{letter}\"");
        let (_, c) = Case::new(internal, pin(0.15, diameter), &lines).inspected(&Rigid::IDENTITY);
        near((c.value.unwrap(), c.upper), (0.3, 0.2 + bonus), 1e-9);
        assert_eq!(c.tolerance, Some(0.2));
        assert_eq!(c.verdict == Verdict::Pass, 0.3 <= 0.2 + bonus, "{internal} {letter} {diameter}");
        let part = |name: &str| c.parts[name];
        assert!((part("mating_size") - diameter).abs() < 1e-9 && (part("bonus") - bonus).abs() < 1e-9);
        // The verdict is that of the virtual condition.
        let around = internal == (letter == "L");
        let kept = match around {
            true => part("related_size") <= part("virtual_size"),
            false => part("related_size") >= part("virtual_size"),
        };
        assert_eq!(kept, c.verdict == Verdict::Pass);
        assert_eq!(
            c.requirement(),
            Some((0.2, if letter == "M" { MaterialWord::M } else { MaterialWord::L })),
            "{:?}",
            c.modifiers
        );
        // Without the requirement the same part has the same value and no bonus.
        let (_, c) =
            Case::new(internal, pin(0.15, diameter), &format!("{PLACE}{HERE}")).inspected(&Rigid::IDENTITY);
        near((c.value.unwrap(), c.upper), (0.3, 0.2), 1e-9);
    }
}

/// A perfect cylinder of length 10 leans by an angle: the upright pin that fits is thinner by the offset of its ends and by
/// what the leaning circles lose.
#[test]
fn a_leaning_bore_takes_a_thinner_gauge() {
    let angle = 2e-3f64;
    let lean = Rigid::rotation_about([0.0, 0.0, 6.0], [0.0, angle, 0.0]);
    let points: Vec<Point> = pin(0.0, 10.06).iter().map(|p| lean.point(*p)).collect();
    let lost = 10.0 * angle.sin() + 10.06 * (1.0 - angle.cos());
    let case =
        Case::new(true, points.clone(), "kind = \"perpendicularity\"\ndatums = [\"A\"]\nmaterial = \"M\"");
    near(case.values(1e-6), (lost, 0.2 + 0.16), 1e-6);
    // At 90° less the lean about a datum plane it stands exact: angularity finds the turn.
    let degrees = angle.to_degrees();
    let lines = format!(
        "kind = \"angularity\"\nbasic = {{ angle = {} }}\ndiametral = true\ndatums = [\"A\"]\nmaterial = \"M\"",
        90.0 - degrees
    );
    near(Case::new(true, points, &lines).values(1e-6), (0.0, 0.36), 1e-6);
}

/// Diameter of the smallest circle around points, or of the largest free of them near their middle: of all circles through
/// three, and on two as a diameter.
fn gauge(points: &[Point], around: bool) -> f64 {
    let mut best = if around { f64::INFINITY } else { 0.0f64 };
    let mut take = |x: f64, y: f64, r: f64| {
        let near = (x - 0.4).hypot(y + 0.3) < 0.5;
        let all = points.iter().all(|p| {
            let d = (p[0] - x).hypot(p[1] - y);
            if around { d <= r + 1e-12 } else { d >= r - 1e-12 }
        });
        if near && all {
            best = if around { best.min(2.0 * r) } else { best.max(2.0 * r) };
        }
    };
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().skip(i + 1) {
            take(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[0] - b[0]).hypot(a[1] - b[1]));
            for c in &points[j + 1..] {
                let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
                let twice = 2.0 * (u[0] * v[1] - u[1] * v[0]);
                let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
                let (x, y) = ((v[1] * uu - u[1] * vv) / twice, (u[0] * vv - v[0] * uu) / twice);
                take(a[0] + x, a[1] + y, x.hypot(y));
            }
        }
    }
    best
}

/// The largest pin in a rough bore, and the smallest ring around it, by brute force.
#[test]
fn gauges_are_those_of_brute_force() {
    for seed in 0..4 {
        let mut random = Random::new(seed);
        let mut rough = || 5.0 + 0.03 * (random.unit() - 0.5);
        let radii: Vec<f64> = (0..60).map(|_| rough()).collect();
        let points = round([0.4, -0.3], &LEVELS, 60, |k| radii[k]);
        for (internal, letter) in [(true, "M"), (false, "M"), (true, "L"), (false, "L")] {
            let around = internal == (letter == "L");
            let lines = format!("kind = \"perpendicularity\"\ndatums = [\"A\"]\nmaterial = \"{letter}\"");
            let (_, c) = Case::new(internal, points.clone(), &lines).inspected(&Rigid::IDENTITY);
            let related = gauge(&points[..60], around);
            let found = c.parts["related_size"];
            assert!((found - related).abs() < 1e-9, "{internal} {letter}: {found} {related}");
            assert!(c.value.unwrap() >= 0.0);
        }
    }
}

/// A shaft with play in its gauge lets the part shift by half the play towards the bore's place.
#[test]
fn a_datum_shifts_by_its_play() {
    // The bore stands 20.15 from the shaft in place of 20; the shaft of 8.00 has 0.1 less than its maximum material.
    let bore = pin(20.15, 10.04);
    let shaft = pin(0.0, 8.0);
    let place = "kind = \"position\"\nbasic = { x = 20, y = 0 }\n";
    let value = |datum: &str, material: &str| {
        let lines = format!("{place}datums = [\"A\", \"{datum}\"]\n{material}");
        Case::new(true, bore.clone(), &lines).with_shaft(shaft.clone(), 0.1).values(1e-6)
    };
    near(value("B", ""), (0.3, 0.2), 1e-6);
    near(value("B", "material = \"M\""), (0.3, 0.34), 1e-6);
    near(value("B(M)", ""), (0.2, 0.2), 1e-6);
    near(value("B(M)", "material = \"M\""), (0.2, 0.34), 1e-6);
    // By least material the shaft of 8.00 has as much play in what must be left of it.
    near(value("B(L)", ""), (0.2, 0.2), 1e-6);
    // A tolerance of attitude with the same requirement widens the datum's virtual condition by its own.
    let attitude = "[[characteristic]]\nid = \"2\"\nkind = \"perpendicularity\"\nfeature = \"B\"\ntolerance = 0.06\n\
                    datums = [\"A\"]\nmaterial = \"M\"\n";
    let mut case = Case::new(true, bore.clone(), &format!("{place}datums = [\"A\", \"B(M)\"]"));
    case = case.with_shaft(shaft.clone(), 0.1);
    case.more[0].1 += attitude;
    near(case.values(1e-6), (0.14, 0.2), 1e-6);
    // A shaft at its limit has none; one beyond it fits no gauge.
    let case = |diameter: f64| {
        let lines = format!("{place}datums = [\"A\", \"B(M)\"]");
        Case::new(true, bore.clone(), &lines).with_shaft(pin(0.0, diameter), 0.1)
    };
    near(case(8.1).values(1e-6), (0.3, 0.2), 1e-6);
    let (_, c) = case(8.13).inspected(&Rigid::IDENTITY);
    assert_eq!(c.verdict, Verdict::NotMeasured);
    assert!(
        c.reason.as_ref().unwrap().contains("0.030000 mm beyond its virtual condition"),
        "{:?}",
        c.reason
    );
}

/// Alone, the datum may lean too: in a gauge of length 10 with a play of 0.01 the axis 10 to 20 above its end moves by as
/// much as 0.005 and twice the slope 0.001.
#[test]
fn a_single_datum_leans_within_its_play() {
    let shaft = round([0.0; 2], &[0.0, 5.0, 10.0], 16, |_| 4.0);
    let bore = round([0.04, 0.0], &[20.0, 30.0], 16, |_| 5.0);
    let value = |datum: &str| {
        let lines = format!("{PLACE}datums = [\"{datum}\"]");
        Case::new(true, bore.clone(), &lines).with_shaft(shaft.clone(), 0.01).values(1e-6).0
    };
    assert!((value("B") - 0.08).abs() < 1e-7, "{}", value("B"));
    // At the ends of the shaft +0.005 and −0.005: at 20 it is −0.015, at 30 −0.025.
    assert!((value("B(M)") - 0.05).abs() < 2e-5, "{}", value("B(M)"));
}

#[test]
fn too_few_points_have_no_gauge() {
    let lines = format!("{PLACE}datums = [\"B(M)\"]\nmaterial = \"M\"");
    for (own, other) in [(2, 48), (48, 2), (0, 48)] {
        let (mut bore, mut shaft) = (pin(0.0, 10.0), pin(0.0, 8.0));
        bore.truncate(own);
        shaft.truncate(other);
        let (_, c) = Case::new(true, bore, &lines).with_shaft(shaft, 0.1).inspected(&Rigid::IDENTITY);
        assert_eq!(c.verdict, Verdict::NotMeasured);
        assert!(c.reason.unwrap().contains("points"));
    }
}

/// A shaft of perfect sections that is bent by `h` has a mating size of its diameter and `h`: what lies between value and limit is
/// what lies between that and the virtual condition.
#[test]
fn a_bent_shaft_keeps_its_virtual_condition_or_not() {
    for (diameter, h) in [(10.0, 0.05), (10.08, 0.2), (10.08, 0.23), (9.9, 0.35), (9.9, 0.42)] {
        let ring = |x: f64, z: f64| round([x, 0.0], &[z], 360, |_| 0.5 * diameter);
        let points = [ring(0.0, 0.0), ring(h, 20.0), ring(0.0, 40.0)].concat();
        let case = Case::new(false, points.clone(), "kind = \"straightness\"\nmaterial = \"M\"");
        let (value, upper) = case.values(1e-6);
        assert!((value - upper - (diameter + h - 10.3)).abs() < 1e-6, "{diameter} {h}: {value} {upper}");
        // The sections are shifted, not tilted: the least-squares size is a little above theirs.
        assert!(
            (value - h).abs() < h * h && (upper - (0.2 + 10.1 - diameter)).abs() < h * h,
            "{value} {upper}"
        );
        let (_, c) = case.inspected(&Rigid::IDENTITY);
        assert_eq!(c.verdict == Verdict::Pass, diameter + h <= 10.3, "{diameter} {h}");
        // Without the requirement: the zone of its median line, no bonus.
        let (_, c) = Case::new(false, points, "kind = \"straightness\"").inspected(&Rigid::IDENTITY);
        near((c.value.unwrap(), c.upper), (h, 0.2), 1e-9);
        assert_eq!(c.parts["sections"], 3.0);
    }
}

/// Beside a bore there is room for any cylinder: a bore off its place has none there, whatever the datums leave free.
#[test]
fn a_bore_off_its_place_keeps_no_boundary_beside_it() {
    // A shaft B at the origin; the bore stands 22 from it and any way about it, 20 is asked.
    let shaft = pin(0.0, 8.0);
    // A gauge that lies between two of the points gains what their chord sags, and there may be two such places.
    let sag = 2.0 * 10.0 * (1.0 - libm::cos(0.5 * TAU / 360.0));
    for step in 0..12 {
        let place =
            Rigid::rotation_about([0.0; 3], [0.0, 0.0, f64::from(step) * FRAC_PI_6]).point([20.0, 0.0, 0.0]);
        let basic = format!("kind = \"position\"\nbasic = {{ x = {}, y = {} }}\n", place[0], place[1]);
        for (internal, letter) in [(true, "M"), (false, "L"), (true, "L"), (false, "M")] {
            let lines = format!("{basic}datums = [\"A\", \"B\"]\nmaterial = \"{letter}\"");
            let case = Case::new(internal, pin(22.0, 10.0), &lines).with_shaft(shaft.clone(), 0.1);
            near(case.values(sag), (4.0, 0.3), sag);
        }
        // The shaft has a play of 0.1, which moves the part by half of it.
        let lines = format!("{basic}datums = [\"A\", \"B(M)\"]\nmaterial = \"M\"");
        let case = Case::new(true, pin(22.0, 10.0), &lines).with_shaft(shaft.clone(), 0.1);
        near(case.values(sag), (3.9, 0.3), sag);
        // A place outside the bore has no cylinder within it: twice its distance from the axis is still the value.
        let lines = format!("{basic}datums = [\"A\", \"B\"]\nmaterial = \"M\"");
        let case = Case::new(true, pin(27.0, 10.0), &lines).with_shaft(shaft.clone(), 0.1);
        near(case.values(sag), (14.0, 0.3), sag);
    }
}

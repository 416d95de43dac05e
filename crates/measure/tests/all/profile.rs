//! Profiles of lines and surfaces: zones beside the exact geometry, sections held and free, what a plan must say.

use crate::common;

use common::round;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use trueness_document::inspect::{CharacteristicRecord, PlanRecord};
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;
use trueness_measure::inspection::{self, Data, OwnPoints, run};
use trueness_measure::plan::Plan;

/// The frame of the measured part itself.
const HERE: &str = "frame = { origin = [0, 0, 0], x = [1, 0, 0], z = [0, 0, 1] }\n";
const BORE: &str =
    "shape = \"cylinder\"\nnominal = { point = [0, 0, 0], direction = [0, 0, 1], radius = 5, length = 20 }\n";
const FLOOR: &str = "shape = \"plane\"\nnominal = { point = [0, 0, 0], normal = [0, 0, 1], boundary = [[0, 0, 0], [40, 0, 0], [40, 40, 0]] }\n";

fn text(feature: &str, lines: &str) -> String {
    format!(
        "schema = \"trueness/plan/1\"\n[[feature]]\nid = \"F\"\npoints = \"F\"\n{feature}[[characteristic]]\nid = \"1\"\n\
         feature = \"F\"\ntolerance = 0.1\n{lines}"
    )
}

fn measured(feature: &str, lines: &str, points: Vec<Point>) -> CharacteristicRecord {
    let text = text(feature, lines);
    let plan = Plan::parse(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let points = BTreeMap::from([(0, OwnPoints { points, planar: false })]);
    let found = run(&plan, Data { points, ..Data::default() }, &Silent).unwrap();
    let record = PlanRecord { path: "plan".into(), sha256: None };
    inspection::document(&plan, record, &found, vec![]).characteristics.remove(0)
}

fn value(feature: &str, lines: &str, points: Vec<Point>) -> f64 {
    let found = measured(feature, lines, points);
    found.value.unwrap_or_else(|| panic!("{:?}", found.reason))
}

fn close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
}

const LEVELS: [f64; 3] = [2.0, 10.0, 18.0];

/// Radii of 5.02 and 5.06 around an axis: zones evenly about 5, about 5 ± an offset, and where they are narrowest.
#[test]
fn zones_lie_about_their_offset() {
    let points = || round([0.0; 2], &LEVELS, 12, |k| if k.is_multiple_of(2) { 5.02 } else { 5.06 });
    for (kind, more) in [("surface-profile", ""), ("line-profile", "intersection = [0, 0, 2]\n")] {
        let lines = |offset: &str| format!("kind = \"{kind}\"\n{more}{HERE}{offset}");
        let (bore, shaft) = (format!("{BORE}internal = true\n"), format!("{BORE}internal = false\n"));
        close(value(BORE, &lines(""), points()), 0.12);
        // Out of the material of a shaft is away from its axis, of a bore towards it.
        close(value(&shaft, &lines("offset = 0.05"), points()), 0.06);
        close(value(&bore, &lines("offset = -0.05"), points()), 0.06);
        close(value(&bore, &lines("offset = 0.05"), points()), 0.22);
        close(value(BORE, &lines("offset = \"free\""), points()), 0.04);
        assert!(measured(BORE, &lines("offset = \"free\""), points()).modifiers.contains(&"OZ".to_string()));
        let uz = measured(&bore, &lines("offset = -0.05"), points()).modifiers;
        assert!(uz.contains(&"UZ -0.05".to_string()), "{uz:?}");
    }
}

/// Rows on a floor at heights of their own: held they have a common zone, with a free middle each has its own; a free line also
/// turns. Distances are within the plane of the row: across a slope of the intersection planes they are longer.
#[test]
fn sections_are_held_or_free() {
    let row = |y: f64, z: f64| (0..9).map(move |i| [f64::from(i), y, z + 1e-3 * f64::from(i % 2)]);
    let points = || row(0.0, 0.01).chain(row(10.0, 0.03)).chain(row(20.0, -0.02)).collect::<Vec<Point>>();
    let lines = |more: &str| format!("kind = \"line-profile\"\nintersection = [0, 1, 0]\n{more}");
    close(value(FLOOR, &lines(HERE), points()), 0.062);
    close(value(FLOOR, &lines(&format!("{HERE}offset = \"free\"")), points()), 1e-3);
    close(value(FLOOR, &lines(""), points()), 1e-3);
    // Planes at 60° to the floor meet it in the same rows; what is 0.031 above is 0.031 / sin 60° from the line within them.
    let slanted = format!(
        "kind = \"line-profile\"\nintersection = [0, {}, {}]\n{HERE}",
        (PI / 3.0).sin(),
        (PI / 3.0).cos()
    );
    close(value(FLOOR, &slanted, points()), 0.062 / (PI / 3.0).sin());
    let found = measured(FLOOR, &lines(""), points());
    assert_eq!((found.parts["sections"], found.symbol.as_str()), (3.0, "⌒"));
    assert!(found.modifiers.contains(&"planes across (0, 1, 0)".to_string()), "{:?}", found.modifiers);
    // Too few points of any section.
    let few = measured(FLOOR, &lines(""), row(0.0, 0.0).take(3).collect());
    assert!(few.value.is_none() && few.reason.unwrap().contains("points"));
}

#[test]
fn what_a_profile_needs_is_asked_for() {
    let fault = |feature: &str, lines: &str, told: &str| {
        let e = Plan::parse(&text(feature, lines)).unwrap_err().to_string();
        assert!(e.contains(told), "{e}");
    };
    fault(FLOOR, "kind = \"line-profile\"\n", "line 11, column 8: line-profile: it needs `intersection`");
    fault(
        FLOOR,
        "kind = \"line-profile\"\nintersection = [0, 0, 1]\n",
        "line 12, column 16: line-profile: the intersection planes lie along",
    );
    fault(
        FLOOR,
        "kind = \"line-profile\"\nintersection = [0, 0, 0]\n",
        "line 12, column 16: the normal of the intersection planes",
    );
    fault(
        BORE,
        "kind = \"surface-profile\"\noffset = 0.05\n",
        "an offset is counted out of the material; give its feature `internal",
    );
    fault(FLOOR, "kind = \"surface-profile\"\noffset = \"fre\"\n", "line 12, column 10");
    fault(FLOOR, "kind = \"surface-profile\"\noffset = nan\n", "line 12, column 10: the offset is NaN");
    fault(FLOOR, "kind = \"flatness\"\noffset = 0.1\n", "line 12, column 10: flatness takes no `offset`");
    fault("shape = \"cylinder\"\n", "kind = \"surface-profile\"\n", "needs `nominal`");
}

//! What the author of a plan meets: each fault with its place, its remedy and its exit status.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, status, stderr, stdout, trueness};

/// A floor, a wall and a pin, exact but for one point of the floor.
fn parts(folder: &Folder) {
    let grid = |f: &dyn Fn(f64, f64) -> [f64; 3]| -> String {
        let all = (0..25).map(|k| f(f64::from(k % 5) * 10.0, f64::from(k / 5) * 10.0));
        all.map(|[x, y, z]| format!("{x} {y} {z}\n")).collect()
    };
    let bump = |x: f64, y: f64| if (x, y) == (20.0, 20.0) { 0.05 } else { 0.0 };
    folder.write("floor.xyz", grid(&|x, y| [x, y, bump(x, y)]));
    folder.write("roof.xyz", grid(&|x, y| [x, y, 12.0]));
    folder.write("wall.xyz", grid(&|x, y| [0.0, x, y]));
    let pin = (0..40).map(|k| {
        let (angle, z) = (f64::from(k % 8) * 0.785, f64::from(k / 8) * 3.0);
        format!("{} {} {z}\n", 20.0 + 4.0 * angle.cos(), 20.0 + 4.0 * angle.sin())
    });
    folder.write("pin.xyz", pin.collect::<String>());
    folder.write("two.xyz", "0 0 0\n1 2 3\n");
    folder.write("words.xyz", "these are words\nand no numbers\n");
}

const PLAN: &str = r#"schema = "trueness/plan/1"
units = "mm"

[[feature]]
id = "A"
shape = "plane"
points = "floor.xyz"

[[feature]]
id = "B"
shape = "plane"
points = "wall.xyz"

[[feature]]
id = "R"
shape = "plane"
points = "roof.xyz"

[[feature]]
id = "pin"
shape = "cylinder"
points = "pin.xyz"

[[characteristic]]
id = "1"
kind = "flatness"
feature = "A"
tolerance = 0.1

[[characteristic]]
id = "2"
kind = "perpendicularity"
feature = "pin"
datums = ["A"]
tolerance = 0.1

[decision]
rule = "simple"
"#;

/// A change of the plan, and what is said to it.
struct Fault {
    from: &'static str,
    to: &'static str,
    says: &'static str,
}

const fn fault(from: &'static str, to: &'static str, says: &'static str) -> Fault {
    Fault { from, to, says }
}

const POSITION: &str = "kind = \"position\"\nbasic = { x = 20, y = 20 }";

/// A word of the plan, what stands in its place, and what is said of that.
const FAULTS: &[Fault] = &[
    fault(
        "schema = \"trueness/plan/1\"",
        "schema = \"trueness/plan/2\"",
        "line 1, column 10: the schema is \"trueness/plan/2\", but this program reads \"trueness/plan/1\"",
    ),
    fault(
        "schema = \"trueness/plan/1\"\n",
        "",
        "`schema` is missing; add it, as in schema = \"trueness/plan/1\"",
    ),
    fault("id = \"A\"", "id = \"A", "line 5, column"),
    fault(
        "units = \"mm\"",
        "units = \"furlong\"",
        "line 2, column 9: there is no value \"furlong\" (known: mm, cm, m, in, um)",
    ),
    fault("units = \"mm\"", "unit = \"mm\"", "there is no field \"unit\"; did you mean \"units\"?"),
    fault(
        "tolerance = 0.1",
        "tolerence = 0.1",
        "there is no field \"tolerence\"; did you mean \"tolerance\"?",
    ),
    fault(
        "tolerance = 0.1",
        "tolerance = \"0.1\"",
        "line 28, column 13: `tolerance` is \"0.1\", not one number, the width or diameter of the zone; write 0.1 without quotes",
    ),
    fault(
        "tolerance = 0.1",
        "tolerance = -0.1",
        "line 28, column 13: the tolerance is -0.1; it cannot be below 0",
    ),
    fault(
        "tolerance = 0.1",
        "tolerance = nan",
        "line 28, column 13: the tolerance is NaN; give a finite number",
    ),
    fault("feature = \"A\"\ntolerance = 0.1", "feature = \"A\"", "flatness needs `tolerance`"),
    fault(
        "kind = \"flatness\"",
        "kind = \"flatnes\"",
        "line 26, column 8: there is no kind \"flatnes\"; did you mean \"flatness\"?",
    ),
    fault(
        "kind = \"flatness\"",
        "kind = \"line-profile\"",
        "line 27, column 11: line-profile: its feature needs `nominal`, the theoretically exact surface",
    ),
    fault(
        "shape = \"cylinder\"",
        "shape = \"cilinder\"",
        "line 21, column 9: there is no value \"cilinder\"; did you mean \"cylinder\"?",
    ),
    fault(
        "feature = \"A\"",
        "feature = \"AA\"",
        "line 27, column 11: there is no feature \"AA\"; did you mean \"A\"? (known: A, B, R, pin)",
    ),
    fault(
        "feature = \"A\"",
        "feature = \"pin\"",
        "line 27, column 11: flatness: feature \"pin\" is a cylinder; it is defined for: plane",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"E\"]",
        "line 34, column 11: there is no feature \"E\"; did you mean \"A\"?",
    ),
    fault("datums = [\"A\"]\n", "", "perpendicularity: it needs a datum: give `datums`"),
    fault("datums = [\"A\"]", "datums = [\"A\", \"A\"]", "datum \"A\" is named twice"),
    fault(
        "datums = [\"A\"]",
        "datums = [\"pin\"]",
        "\"pin\" is the toleranced feature; it cannot be its own datum",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1",
        "kind = \"distance\"\nfeature = [\"A\", \"A\"]\nnominal = 8\nupper = 0.1\nlower = -0.1",
        "line 33, column 11: \"A\" is named twice; a feature is no distance from itself",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]",
        "kind = \"coaxiality\"\nfeature = \"pin\"\ndatums = [\"A\", \"B\"]",
        "line 34, column 10: coaxiality: it is evaluated for a single datum only",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"A-C\"]",
        "line 34, column 11: there is no feature \"C\"; did you mean \"A\"?",
    ),
    fault(
        "kind = \"flatness\"",
        "kind = \"flatness\"\nsize = \"GG\"",
        "line 27, column 8: flatness takes no `size`",
    ),
    fault("id = \"2\"", "id = \"1\"", "line 31, column 6: there are two characteristics \"1\""),
    fault("id = \"B\"", "id = \"A\"", "line 10, column 6: there are two features \"A\""),
    fault(
        "points = \"floor.xyz\"\n",
        "",
        "feature \"A\" has no points: give `points`, `nominal`, `seed` or `face`",
    ),
    fault(
        "shape = \"plane\"\npoints = \"floor.xyz\"",
        "points = \"floor.xyz\"",
        "feature \"A\" needs `shape`, or `derived` with `of`",
    ),
    fault(
        "kind = \"perpendicularity\"",
        "kind = \"angularity\"",
        "angularity: it needs the theoretically exact angle: basic = { angle = 60 }",
    ),
    fault(
        "kind = \"perpendicularity\"",
        "kind = \"angularity\"\nbasic = { angle = 130 }",
        "the angle is 130; give degrees from 0 to 90",
    ),
    fault(
        "kind = \"perpendicularity\"",
        "kind = \"coaxiality\"",
        "line 34, column 10: coaxiality: the datum is a plane; it must be one of: line, cylinder, cone",
    ),
    fault(
        "kind = \"perpendicularity\"",
        "kind = \"position\"",
        "position: it needs the theoretically exact place: basic = { x = 10, y = 20 }",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1",
        "kind = \"size\"\nfeature = \"pin\"\nsize = \"GG\"",
        "size needs `nominal`, `upper` and `lower`",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1",
        "kind = \"size\"\nfeature = \"pin\"\nsize = \"GG\"\nnominal = 8\nupper = -0.1\nlower = 0.1",
        "the lower limit deviation 0.1 is above the upper one -0.1",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1",
        "kind = \"size\"\nfeature = \"pin\"\nsize = \"XX\"\nnominal = 8\nupper = 0.1\nlower = -0.1",
        "line 34, column 8: there is no value \"XX\"",
    ),
    fault("rule = \"simple\"", "rule = \"iso14253-1\"", "rule \"iso14253-1\" needs the expanded uncertainty"),
    fault("rule = \"simple\"", "rule = \"iso\"", "there is no value \"iso\""),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1\n\n[decision]\nrule = \"simple\"",
        "kind = \"angle\"\nfeature = \"pin\"\ndatums = [\"A\"]\nnominal = 90\nupper = 1\nlower = -1\n\n[decision]\nrule = \"iso14253-1\"\nuncertainty = 0.002",
        "that of [decision] is one of lengths",
    ),
    fault("[decision]", "[align]\nmethod = \"rps\"\n[decision]", "method \"rps\" needs `points`, a list of"),
    fault("[decision]", "[align]\nmethod = \"datum\"\n[decision]", "method \"datum\" needs `datums`"),
    fault(
        "[decision]",
        "[align]\nmethod = \"datum\"\ndatums = [\"X\", \"A\"]\n[decision]",
        "line 39, column 11: there is no feature \"X\"",
    ),
    fault(
        "[decision]",
        "[align]\nmethod = \"datum\"\ndatums = [\"A\"]\n[decision]",
        "feature \"A\" has no `nominal`: where it should lie is not known",
    ),
    fault(
        "[decision]",
        "[align]\nmethod = \"none\"\ndatums = [\"A\"]\n[decision]",
        "`datums` goes with method \"datum\"",
    ),
    fault(
        "[decision]",
        "[align]\nmethod = \"pairs\"\npoints = [{ measured = [0, 0, 0], nominal = [0, 0, 0] }]\n[decision]",
        "method \"pairs\" needs at least 3 points, there are 1",
    ),
    fault(
        "[decision]",
        "[align]\nmethod = \"best-fit\"\n[decision]",
        "a best fit needs `measured` and `reference`",
    ),
    fault(
        "[decision]",
        "[align]\nmethod = \"given\"\ntransform = [[1, 0], [0, 1]]\n[decision]",
        "a transform has four rows of four numbers",
    ),
    fault(
        "[decision]",
        "[deviation]\ntolerance = [-0.1, 0.1]\n[decision]",
        "line 37, column 1: [deviation] needs `measured` and `reference`",
    ),
    fault(
        "[decision]",
        "[align]\nmethod = \"given\"\ntransform = [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]\n[decision]",
        "the transform: it scales lengths by 2",
    ),
    fault("[decision]", "[decision]\nnoise = -1", "the noise is -1; it cannot be below 0"),
    fault("[decision]", "[decision]\ndraws = 100", "line 38, column 9: this belongs to `noise`"),
    fault("[decision]", "[decision]\ncorrelation = 1", "line 38, column 15: this belongs to `noise`"),
    fault("[decision]", "[decision]\nnoise = 0.01\ndraws = 3", "draws is 3; it is from 10 to 100000"),
];

#[test]
fn faults_of_plans_are_told_with_their_places() {
    let folder = Folder::new();
    parts(&folder);
    for fault in FAULTS {
        assert!(PLAN.contains(fault.from), "{}", fault.from);
        let plan = folder.write("plan.toml", PLAN.replacen(fault.from, fault.to, 1));
        let o = trueness(["inspect", plan.to_str().unwrap()]);
        let text = stderr(&o);
        assert!(text.contains(fault.says), "{}\nshould say {}\nsays {text}", fault.to, fault.says);
        assert!(text.contains("plan.toml: line "), "{text}");
        assert_eq!((status(&o), stdout(&o).as_str()), (3, ""), "{text}");
    }
}

/// What only the measured data show: impossible datum systems, files that are missing or hold no points.
#[test]
fn faults_that_data_show_are_told_too() {
    let folder = Folder::new();
    parts(&folder);
    let system = |datums: &str| {
        PLAN.replacen("kind = \"perpendicularity\"", POSITION, 1).replacen("datums = [\"A\"]", datums, 1)
    };
    let cases = [
        (
            system("datums = [\"A\", \"R\"]"),
            "line 31, column 6: characteristic \"2\": datum 2 holds nothing that the datums before it leave free",
        ),
        (PLAN.replacen("floor.xyz", "flor.xyz", 1), "line 7, column 10: the points of feature \"A\""),
        (PLAN.replacen("floor.xyz", "words.xyz", 1), "words.xyz"),
        (
            PLAN.replacen(
                "points = \"floor.xyz\"",
                "method = \"maximum-inscribed\"\npoints = \"floor.xyz\"",
                1,
            ),
            "line 5, column 6: feature \"A\": maximum-inscribed is not defined for a plane",
        ),
    ];
    let of_plane = |feature: &str, basic: &str| {
        let to = format!("kind = \"position\"\nbasic = {{ {basic} }}\nfeature = \"{feature}\"");
        PLAN.replacen("kind = \"perpendicularity\"\nfeature = \"pin\"", &to, 1)
    };
    let planes = [
        (
            of_plane("R", "x = 3"),
            "its plane lies across z in the datum system, not across x: basic = { z = … }",
        ),
        (of_plane("B", "z = 3"), "in the datum system, not across z"),
        (of_plane("B", "x = 3"), "its datums leave shifts along x free"),
    ];
    for (plan, says) in cases.into_iter().chain(planes) {
        let plan = folder.write("plan.toml", plan);
        let o = trueness(["inspect", plan.to_str().unwrap()]);
        let text = stderr(&o);
        assert!(text.contains(says), "should say {says}\nsays {text}");
        assert_eq!((status(&o), stdout(&o).as_str()), (3, ""), "{text}");
    }
    let o = trueness(["inspect", folder.file("none.toml").to_str().unwrap()]);
    assert_eq!(status(&o), 3);
    assert!(stderr(&o).contains("none.toml: the plan cannot be read"), "{}", stderr(&o));
    let plan = folder.write("plan.toml", b"schema = \"\xff\"");
    let o = trueness(["inspect", plan.to_str().unwrap()]);
    assert!(stderr(&o).contains("line 1, column 11: the text is not UTF-8"), "{}", stderr(&o));
    // Words of the command line that do not fit the plan are wrong usage.
    let plan = folder.write("plan.toml", PLAN);
    let floor = folder.file("floor.xyz");
    let o = trueness(["inspect", plan.to_str().unwrap(), "--measured", floor.to_str().unwrap()]);
    assert_eq!(status(&o), 2, "{}", stderr(&o));
    assert!(stderr(&o).contains("the plan names none"), "{}", stderr(&o));
    let over = trueness(["inspect", plan.to_str().unwrap(), "--csv", floor.to_str().unwrap()]);
    assert_eq!(status(&over), 2, "{}", stderr(&over));
    assert!(stderr(&over).contains("would overwrite the input"), "{}", stderr(&over));
}

/// A seat may be part of the common datum that it is toleranced to, never be its own.
#[test]
fn a_seat_is_toleranced_to_the_common_datum_it_is_part_of() {
    let folder = Folder::new();
    parts(&folder);
    let pin = "[[feature]]\nid = \"P2\"\nshape = \"cylinder\"\npoints = \"pin2.xyz\"\n\n[[characteristic]]\nid = \"1\"";
    let turn = |k: u32| {
        let (angle, z) = (f64::from(k % 8) * 0.785, 40.0 + f64::from(k / 8) * 3.0);
        format!("{} {} {z}\n", 20.02 + 4.0 * angle.cos(), 20.0 + 4.0 * angle.sin())
    };
    folder.write("pin2.xyz", (0..40).map(turn).collect::<String>());
    let run = |datums: &str| {
        let text = PLAN.replacen("[[characteristic]]\nid = \"1\"", pin, 1).replacen(
            "perpendicularity",
            "coaxiality",
            1,
        );
        let plan = folder.write("plan.toml", text.replacen("datums = [\"A\"]", datums, 1));
        trueness(["inspect", plan.to_str().unwrap()])
    };
    let o = run("datums = [\"pin-P2\"]");
    // Five circles each at x = 20 and 20.02: the least-squares line leans by 0.2 / 418 and is 0.0033 off at the inner end.
    assert!(stdout(&o).contains("0.0066") && status(&o) == 0, "{} {}", stdout(&o), stderr(&o));
    let o = run("datums = [\"pin\"]");
    assert!(stderr(&o).contains("cannot be its own datum") && status(&o) == 3, "{}", stderr(&o));
}

/// Pass, fail, undecided and not measured, each with its exit status and in every output.
#[test]
fn verdicts_stand_in_every_output() {
    let folder = Folder::new();
    parts(&folder);
    let run = |plan: String| {
        let plan = folder.write("plan.toml", plan);
        let (json, csv, junit) = (folder.file("r.json"), folder.file("r.csv"), folder.file("r.xml"));
        let paths = [&plan, &json, &csv, &junit].map(|p| p.to_str().unwrap().to_string());
        let [plan, json, csv, junit] = paths.each_ref().map(String::as_str);
        let o = trueness(["inspect", plan, "--json", json, "--csv", csv, "--junit", junit]);
        let read = |p: &str| std::fs::read_to_string(p).unwrap_or_default();
        let answer: serde_json::Value = serde_json::from_str(&read(json)).unwrap();
        (status(&o), stdout(&o), answer, read(csv), read(junit))
    };
    let (code, table, answer, csv, junit) = run(PLAN.into());
    assert_eq!((code, answer["verdict"].as_str()), (0, Some("pass")), "{table}");
    assert!(table.contains("pass: 2 pass, 0 fail, 0 undecided, 0 not measured"), "{table}");
    assert!(csv.lines().nth(1).unwrap().contains(",1,flatness,A,,,,0.1,") && csv.contains(",pass,"), "{csv}");
    assert!(junit.contains("<testsuites tests=\"2\" failures=\"0\" errors=\"0\">"), "{junit}");

    let (code, table, answer, _, junit) = run(PLAN.replacen("tolerance = 0.1", "tolerance = 0.02", 1));
    assert_eq!((code, answer["verdict"].as_str()), (1, Some("fail")), "{table}");
    assert_eq!(answer["characteristics"][0]["utilisation"].as_f64().map(|u| (u * 1e6).round()), Some(2.5e6));
    assert!(junit.contains("<failure message=\"fail: 0.0"), "{junit}");

    let iso = PLAN.replacen("rule = \"simple\"", "rule = \"iso14253-1\"\nuncertainty = 0.06", 1);
    let (code, table, answer, _, junit) = run(iso);
    assert_eq!((code, answer["verdict"].as_str()), (1, Some("undecided")), "{table}");
    assert!(junit.contains("errors=\"1\"") && junit.contains("<error message=\"undecided"), "{junit}");

    let (code, table, answer, _, junit) = run(PLAN.replacen("floor.xyz", "two.xyz", 1));
    assert_eq!((code, answer["verdict"].as_str()), (1, Some("not_measured")), "{table}");
    let reason = answer["characteristics"][0]["reason"].as_str().unwrap();
    assert_eq!(reason, "feature \"A\": a plane needs at least 3 points, there are 2");
    assert!(answer["characteristics"][0]["value"].is_null());
    assert!(table.contains(reason) && junit.contains("not measured"), "{table}{junit}");
}

/// Lengths of a plan in inch are those of the same plan in mm.
#[test]
fn the_unit_of_a_plan_is_that_of_all_its_lengths() {
    let folder = Folder::new();
    parts(&folder);
    let inch = PLAN.replace("\"mm\"", "\"in\"").replace("tolerance = 0.1", "tolerance = 0.051");
    let plan = folder.write("inch.toml", inch);
    let answer = crate::common::document(["inspect", plan.to_str().unwrap()]);
    let first = &answer["characteristics"][0];
    assert!((first["value"].as_f64().unwrap() - 0.05 * 25.4).abs() < 1e-9, "{first}");
    assert!((first["tolerance"].as_f64().unwrap() - 0.051 * 25.4).abs() < 1e-12);
    assert_eq!(answer["inputs"][0]["unit_assumed"], "in");
}

/// A file that says its unit is not read in that of the plan.
#[test]
fn the_unit_of_a_file_goes_before_the_plans() {
    let folder = Folder::new();
    let point = |k: u32| format!("{},{},{}\n", k % 5, k / 5, if k == 7 { 0.001 } else { 0.0 });
    let rows: String = (0..25).map(point).collect();
    let plan = "schema = \"trueness/plan/1\"\nunits = \"mm\"\n\n[[feature]]\nid = \"A\"\nshape = \"plane\"\npoints = \"a.csv\"\n\n\
                [[characteristic]]\nid = \"1\"\nkind = \"flatness\"\nfeature = \"A\"\ntolerance = 0.01\n";
    let plan = folder.write("plan.toml", plan);
    let flatness = |header: &str| {
        folder.write("a.csv", format!("{header}\n{rows}"));
        let o = trueness(["inspect", plan.to_str().unwrap(), "--json", "-"]);
        let d: serde_json::Value = serde_json::from_slice(&o.stdout).unwrap();
        (status(&o), d["characteristics"][0]["value"].as_f64().unwrap())
    };
    let ((passed, mm), (failed, inch)) = (flatness("x,y,z"), flatness("x (in),y (in),z (in)"));
    assert_eq!((passed, failed), (0, 1));
    assert!((inch / mm - 25.4).abs() < 1e-9, "{mm} {inch}");
}

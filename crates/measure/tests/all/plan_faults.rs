//! Faults of plans in datum systems, material requirements and tolerance classes: each with its place and its remedy.

use trueness_measure::plan::Plan;

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

const FAULTS: &[Fault] = &[
    // Wrong types and slips of TOML, in words of plans.
    fault(
        "tolerance = 0.1",
        "tolerance = \"0,1\"",
        "line 28, column 13: `tolerance` is \"0,1\", not one number, the width or diameter of the zone; write 0.1 without quotes",
    ),
    fault(
        "tolerance = 0.1",
        "tolerance = [-0.1, 0.1]",
        "line 28, column 13: `tolerance` is [-0.1, 0.1], not one number, the width or diameter",
    ),
    fault("tolerance = 0.1", "", "line 24, column 1: flatness needs `tolerance`"),
    fault(
        "tolerance = 0.1",
        "tolerance = 0,1",
        "line 28, column 14: a decimal comma; numbers have a point, as in 0.05",
    ),
    fault("tolerance = 0.1", "tolerance = .1", "line 28, column 13: a number begins with a digit; write 0.1"),
    fault("tolerance = 0.1", "tolerance = 0.1mm", "line 28, column 16: a number has no unit: \"mm\" must go"),
    fault("tolerance = 0.1", "tolerance =", "line 28, column 12: there is no value behind `=`"),
    fault(
        "tolerance = 0.1",
        "tolerance = 0.1\ntolerance = 0.2",
        "line 29, column 1: `tolerance` is there twice; leave one out",
    ),
    fault(
        "tolerance = 0.1",
        "tolerence = 0.1",
        "line 28, column 1: there is no field \"tolerence\"; did you mean \"tolerance\"?",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = \"A\"",
        "line 34, column 10: `datums` is \"A\", not a list, as in [\"A\", \"B\"]",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"A\"]\nbasic = { x = \"3\" }",
        "line 35, column 15: `x` is \"3\", not a number; write 3 without quotes",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"A\"]\noffset = true",
        "line 35, column 10: `offset` is a length, or \"free\"",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"A\"]\nmethod = 3",
        "line 35, column 10: `method` is 3, not a word in quotes",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"A\"]\ndiametral = \"yes\"",
        "line 35, column 13: `diametral` is \"yes\", not true or false",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"A\"]\nintersection = [1, 2]",
        "`intersection` is a list of 2, not three numbers, as in [0, 0, 1]",
    ),
    fault("id = \"1\"", "id = 1", "line 25, column 6: `id` is 1, not text in quotes; write \"1\""),
    fault("id = \"1\"", "id = x", "line 25, column 6: text stands in quotes; write \"x\""),
    fault("id = \"1\"", "id = \"1", "line 25, column 8: the text has no closing quote; end it with \""),
    fault(
        "schema = \"trueness/plan/1\"",
        "{\"schema\": 1}",
        "line 1, column 1: this is no plan; give a TOML file",
    ),
    fault("kind = \"flatness\"\n", "", "`kind` is missing; add it, as in kind = \"flatness\""),
    fault(
        "feature = \"A\"",
        "feature = 3",
        "line 27, column 11: `feature` is the id of a feature, or two of a size",
    ),
    fault(
        "[[characteristic]]\nid = \"1\"",
        "[characteristic]\nid = \"1\"",
        "[characteristic] is one table; write [[characteristic]]",
    ),
    fault(
        "tolerance = 0.1",
        "class = \"K\"",
        "line 28, column 9: class \"K\" goes by a nominal length; give `length`",
    ),
    fault(
        "tolerance = 0.1",
        "class = \"m\"\nlength = 80",
        "class \"m\" is not in the tables of this program; write the limits (known: H, K, L of ISO 2768-2)",
    ),
    fault(
        "tolerance = 0.1",
        "tolerance = 0.1\nlength = 80",
        "line 29, column 10: `length` goes with `class`",
    ),
    fault(
        "tolerance = 0.1",
        "tolerance = 0.1\nclass = \"K\"",
        "line 28, column 13: give `class` or `tolerance`, not both",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1",
        "kind = \"size\"\nfeature = \"pin\"\nsize = \"GG\"\nnominal = 8\nclass = \"c11\"",
        "line 36, column 9: class \"c11\" is not in the tables of this program; write the limits",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1",
        "kind = \"size\"\nfeature = \"pin\"\nsize = \"GG\"\nnominal = 8\nclass = \"H7\"\nupper = 0.1",
        "line 37, column 9: give `class` or `upper`, not both",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1",
        "kind = \"size\"\nfeature = \"pin\"\nsize = \"GG\"\nnominal = 8\nclass = \"H7\"\nlength = 10",
        "line 37, column 10: size takes no `length`",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"A\"]\nmaterial = \"M\"",
        "line 35, column 12: of feature \"pin\" it is not said on which side its material is; give it `internal = true`",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"A\"]\nmaterial = \"R\"",
        "line 35, column 12: there is no value \"R\"",
    ),
    fault(
        "tolerance = 0.1",
        "tolerance = 0.1\nmaterial = \"M\"",
        "line 29, column 12: flatness takes no `material`",
    ),
    // No name is that of all faces without one.
    fault(
        "units = \"mm\"\n\n[[feature]]\nid = \"A\"\nshape = \"plane\"\npoints = \"floor.xyz\"",
        "reference = \"m.stp\"\nmeasured = \"s.xyz\"\n[[feature]]\nid = \"A\"\nshape = \"plane\"\nname = \" \"",
        "line 7, column 8: the name is empty; give the one that the file has for the faces, or their numbers by `face`",
    ),
    fault(
        "points = \"floor.xyz\"",
        "points = \"floor.xyz\"\ninternal = true",
        "line 8, column 12: `internal` is for cylinders, cones and spheres: bores and shafts",
    ),
    fault(
        "points = \"pin.xyz\"\n",
        "points = \"pin.xyz\"\ninternal = false\n[[characteristic]]\nid = \"3\"\nkind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1\nmaterial = \"M\"\n",
        "line 30, column 12: it goes by the limits of size of feature \"pin\"; add a characteristic of kind \"size\"",
    ),
    fault(
        "kind = \"perpendicularity\"",
        "kind = \"position\"\nbasic = { x = 1 }\nmaterial = \"M\"",
        "a material requirement is evaluated for an axis along z, placed by x and y",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]",
        "kind = \"position\"\nbasic = { x = 1, y = 2 }\nfeature = \"pin\"\ndatums = [\"A(M)\", \"B\"]",
        "a material requirement is evaluated on the only datum, or on the second and last one after a plane",
    ),
    // The place is that of the nominals.
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]",
        "kind = \"position\"\nfeature = \"h1\"\ndatums = [\"f\", \"h2\", \"h3(M)\"]\ntolerance = 0.1\n\
         [[feature]]\nid = \"f\"\nshape = \"plane\"\nnominal = { point = [0,0,0], normal = [0,0,1], boundary = [[0,0,0],[9,0,0],[9,9,0]] }\npoints = \"floor.xyz\"\n\
         [[feature]]\nid = \"h1\"\nshape = \"cylinder\"\nnominal = { point = [5,0,0], direction = [0,0,1], radius = 2, length = 9 }\npoints = \"pin.xyz\"\ninternal = true\n\
         [[feature]]\nid = \"h2\"\nshape = \"cylinder\"\nnominal = { point = [20,0,0], direction = [0,0,1], radius = 2, length = 9 }\npoints = \"pin.xyz\"\ninternal = true\n\
         [[feature]]\nid = \"h3\"\nshape = \"cylinder\"\nnominal = { point = [40,0,0], direction = [0,0,1], radius = 2, length = 9 }\npoints = \"pin.xyz\"\ninternal = true\n\
         [[characteristic]]\nid = \"9\"\nkind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]",
        "a material requirement is evaluated on the only datum, or on the second and last one after a plane",
    ),
    fault(
        "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]",
        "kind = \"position\"\nbasic = { x = 1, y = 2 }\nfeature = \"pin\"\ndatums = [\"A(M)\"]",
        "line 35, column 11: feature \"A\" is a plane; a material requirement is for cylinders here",
    ),
    fault("datums = [\"A\"]", "datums = [\"A-A\"]", "line 34, column 11: datum \"A\" is named twice"),
    fault("datums = [\"A\"]", "datums = [\"A-B-R-A\"]", "a common datum has up to three features"),
    fault("datums = [\"A\"]", "datums = [\"A\", \"B-A\"]", "line 34, column 16: datum \"A\" is named twice"),
    fault(
        "kind = \"flatness\"\nfeature = \"A\"",
        "kind = \"parallelism\"\nfeature = \"A\"\ndatums = [\"R-pin\"]",
        "line 28, column 11: a common datum is made of planes, or of cylinders and lines",
    ),
    fault(
        "datums = [\"A\"]",
        "datums = [\"A(M)\"]",
        "line 34, column 11: perpendicularity takes no material requirement on a datum",
    ),
    fault(
        "kind = \"perpendicularity\"",
        "kind = \"angularity\"\nbasic = { angle = 60, turn = 45 }",
        "angularity: a turn is counted from the direction of a second datum; name one",
    ),
    fault(
        "kind = \"perpendicularity\"",
        "kind = \"angularity\"\nbasic = { angle = 60, turn = 145 }",
        "the turn is 145; give degrees from 0 to 90",
    ),
    // Words of other standards and programs.
    fault(
        "kind = \"flatness\"",
        "kind = \"concentricity\"",
        "line 26, column 8: there is no kind \"concentricity\"; did you mean \"coaxiality\"?",
    ),
    fault(
        "kind = \"flatness\"",
        "kind = \"diameter\"",
        "there is no kind \"diameter\"; did you mean \"size\"?",
    ),
    fault(
        "kind = \"flatness\"",
        "kind = \"runout\"",
        "did you mean \"circular-runout\" or \"total-runout\"?",
    ),
    fault(
        "kind = \"flatness\"",
        "kind = \"run_out\"",
        "did you mean \"circular-runout\" or \"total-runout\"?",
    ),
    fault(
        "kind = \"flatness\"",
        "kind = \"profile\"",
        "did you mean \"line-profile\" or \"surface-profile\"?",
    ),
    fault("kind = \"flatness\"", "kind = \"True Position\"", "did you mean \"position\"?"),
    fault("kind = \"flatness\"", "kind = \"circularity\"", "did you mean \"roundness\"?"),
    fault("kind = \"flatness\"", "kind = \"cilindricity\"", "did you mean \"cylindricity\"?"),
    fault("kind = \"flatness\"", "kind = \"squareness\"", "did you mean \"perpendicularity\"?"),
    fault("kind = \"flatness\"", "kind = \"parallel\"", "did you mean \"parallelism\"?"),
    fault("kind = \"flatness\"", "kind = \"planarity\"", "did you mean \"flatness\"?"),
    fault("kind = \"flatness\"", "kind = \"Flatness\"", "did you mean \"flatness\"?"),
    fault("shape = \"cylinder\"", "shape = \"hole\"", "did you mean \"cylinder\"?"),
    // Paths of Windows in double quotes.
    fault(
        "points = \"floor.xyz\"",
        "points = \"C:\\scans\\floor.xyz\"",
        "in double quotes \\ begins an escape; write 'C:\\scans\\floor.xyz' in single quotes, or \"C:/scans/floor.xyz\"",
    ),
    fault(
        "points = \"floor.xyz\"",
        "points = \"C:\\users\\x\\floor.xyz\"",
        "write 'C:\\users\\x\\floor.xyz' in single quotes",
    ),
    fault("points = \"floor.xyz\"", "points = \"C:\\data\\\"", "in double quotes \\ begins an escape"),
    fault(
        "points = \"floor.xyz\"",
        "points = \"C:\\new\\table.xyz\"",
        "line 7, column 10: in double quotes \\ begins an escape; write 'C:\\new\\table.xyz' in single quotes",
    ),
    // Limits that no part keeps, or that say another thing.
    fault(
        "tolerance = 0.1",
        "tolerance = 0",
        "line 28, column 13: the tolerance is 0, which no part keeps; give the width or diameter of the zone, above 0",
    ),
    fault(
        SIZE,
        "kind = \"size\"\nsize = \"GG\"\nfeature = \"pin\"\nnominal = 10\nupper = 10.05\nlower = 9.95",
        "19.95 to 20.05 would be allowed; write upper = 0.05, lower = -0.05",
    ),
    fault(
        SIZE,
        "kind = \"size\"\nsize = \"GG\"\nfeature = \"pin\"\nnominal = 10\nupper = 10.05\nlower = -0.05",
        "line 36, column 9: upper and lower are deviations",
    ),
    fault(
        SIZE,
        "kind = \"size\"\nsize = \"GG\"\nfeature = \"pin\"\nnominal = 10\nupper = 0.05\nlower = 9.95",
        "line 37, column 9: upper and lower are deviations",
    ),
    fault(
        SIZE,
        "kind = \"size\"\nsize = \"GG\"\nfeature = \"pin\"\nnominal = 10\nupper = 0.05\nlower = 0.05",
        "both limit deviations are 0.05, which no part keeps; write upper = 0.05, lower = -0.05",
    ),
    fault(
        SIZE,
        "kind = \"size\"\nsize = \"GG\"\nfeature = \"pin\"\nnominal = 10\nupper = 0\nlower = 0",
        "both limit deviations are 0, which no part keeps",
    ),
    fault(
        SIZE,
        "kind = \"size\"\nsize = \"GG\"\nfeature = \"pin\"\nnominal = 10\ntolerance = 0.1",
        "size takes no `tolerance`; give `upper` and `lower`",
    ),
    fault(
        SIZE,
        "kind = \"angle\"\ndatums = [\"A\"]\nfeature = \"pin\"\nnominal = 90\nupper = 90.5\nlower = 89.5",
        "write upper = 0.5, lower = -0.5",
    ),
    fault(
        SIZE,
        "kind = \"angle\"\ndatums = [\"A\"]\nfeature = \"pin\"\nnominal = 150\nupper = 0.5\nlower = -0.5",
        "the nominal angle is 150; angles are from 0 to 90 degrees, and this one is 30 there",
    ),
    // Classes of the other side, and places of one coordinate.
    fault(
        "points = \"pin.xyz\"\n",
        "points = \"pin.xyz\"\ninternal = true\n[[characteristic]]\nid = \"3\"\nkind = \"size\"\nsize = \"GG\"\nfeature = \"pin\"\nnominal = 8\nclass = \"h7\"\n",
        "line 30, column 9: \"h7\" is a class of shafts and thicknesses (small letters), and feature \"pin\" is a hole or a slot; write \"H7\"",
    ),
    fault(
        "points = \"pin.xyz\"\n",
        "points = \"pin.xyz\"\ninternal = false\n[[characteristic]]\nid = \"3\"\nkind = \"size\"\nsize = \"GG\"\nfeature = \"pin\"\nnominal = 8\nclass = \"G6\"\n",
        "is a shaft or a thickness; write \"g6\"",
    ),
    fault(
        "kind = \"perpendicularity\"",
        "kind = \"position\"\nbasic = { x = 42 }",
        "line 33, column 9: position: `basic` gives x alone, and an axis is placed by the two coordinates across it: add y",
    ),
    fault(
        "feature = \"A\"",
        "feature = \"pin\"",
        "flatness: feature \"pin\" is a cylinder; it is defined for: plane; of a cylinder there is cylindricity",
    ),
];

const SIZE: &str = "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1";

/// What is rightly written in an unusual way stays as it is.
#[test]
fn unusual_plans_are_taken() {
    let size = |more: &str| format!("kind = \"size\"\nsize = \"GG\"\nfeature = \"pin\"\n{more}");
    for to in [
        size("nominal = 0.1\nupper = 0.1\nlower = 0"),
        size("nominal = 0.1\nupper = 0.1\nlower = -0.1"),
        size("nominal = 10\nupper = 0.05\nlower = 0.01"),
        size("nominal = 10\nupper = -0.01\nlower = -0.05"),
        size("nominal = 8\nclass = \"js7\""),
        size("nominal = 8\nclass = \"m\""),
        "kind = \"distance\"\nfeature = \"R\"\ndatums = [\"A\"]\nnominal = 0\nupper = 0.1\nlower = -0.1".into(),
        "kind = \"angle\"\nfeature = \"R\"\ndatums = [\"A\"]\nnominal = 0\nupper = 0.1\nlower = 0".into(),
        "kind = \"texture\"\nfeature = \"R\"\nparameter = \"Ssk\"\ntolerance = 0".into(),
        "kind = \"position\"\nfeature = \"pin\"\ndatums = [\"A\"]\nbasic = { x = 3 }\ndiametral = false\ntolerance = 1".into(),
    ] {
        Plan::parse(&PLAN.replacen(SIZE, &to, 1)).unwrap_or_else(|e| panic!("{to}: {e}"));
    }
}

#[test]
fn faults_are_told_with_their_places() {
    Plan::parse(PLAN).unwrap();
    for fault in FAULTS {
        assert!(PLAN.contains(fault.from), "{}", fault.from);
        match Plan::parse(&PLAN.replacen(fault.from, fault.to, 1)) {
            Err(e) => {
                let text = e.to_string();
                assert!(text.contains(fault.says), "{}\nshould say {}\nsays {text}", fault.to, fault.says);
            }
            Ok(_) => panic!("{} is taken", fault.to),
        }
    }
}

/// Names of features may have dashes: a datum is then read the only way that there is.
#[test]
fn common_datums_are_read_by_the_names_of_features() {
    let datums = |plan: &str, written: &str| {
        let plan = plan.replace("datums = [\"A\"]", &format!("datums = [{written}]"));
        Plan::parse(&plan).map(|p| {
            let names = p.specs[1].datums.iter().map(|d| d.name(&p.features));
            (
                p.specs[1].datums.iter().map(|d| d.features.clone()).collect::<Vec<_>>(),
                names.collect::<Vec<_>>(),
            )
        })
    };
    let found = datums(PLAN, "\"A-R\", \"B\"").unwrap();
    assert_eq!(found, (vec![vec![0, 2], vec![1]], vec!["A-R".to_string(), "B".into()]));
    let dashed = PLAN.replace("id = \"R\"", "id = \"A-B\"");
    assert_eq!(datums(&dashed, "\"A-B-B\"").unwrap().0, [[2, 1]]);
    // Where it could be either, nothing is guessed.
    assert_eq!(
        datums(&dashed, "\"A-B\"").unwrap_err().what,
        "\"A-B\" can be read as common datums of different features; rename one"
    );
}

/// Limits by letters are those of the tables, in the unit of the plan.
#[test]
fn classes_give_their_limits() {
    let limits = |units: &str, from: &str, to: &str| {
        let plan = PLAN.replace("units = \"mm\"", &format!("units = \"{units}\"")).replacen(from, to, 1);
        let plan = Plan::parse(&plan).unwrap_or_else(|e| panic!("{to}: {e}"));
        plan.specs.iter().map(|s| s.limits.range()).collect::<Vec<_>>()
    };
    let own = "kind = \"perpendicularity\"\nfeature = \"pin\"\ndatums = [\"A\"]\ntolerance = 0.1";
    let size = |nominal: &str, class: &str| {
        format!("kind = \"size\"\nfeature = \"pin\"\nsize = \"GX\"\nnominal = {nominal}\nclass = \"{class}\"")
    };
    assert_eq!(limits("mm", own, &size("8", "H7"))[1], (Some(8.0), 8.015));
    assert_eq!(limits("cm", own, &size("0.8", "g6"))[1], (Some(8.0 - 0.014), 8.0 - 0.005));
    assert_eq!(limits("mm", own, &size("8", "m"))[1], (Some(7.8), 8.2));
    let flat = "tolerance = 0.1";
    assert_eq!(limits("mm", flat, "class = \"mK\"\nlength = 80")[0], (None, 0.2));
    assert_eq!(limits("cm", flat, "class = \"K\"\nlength = 8")[0], (None, 0.2));
    let upright = "datums = [\"A\"]\ntolerance = 0.1";
    assert_eq!(limits("mm", upright, "datums = [\"A\"]\nclass = \"L\"\nlength = 250")[1], (None, 1.0));
    let angle =
        "kind = \"angle\"\nfeature = \"pin\"\ndatums = [\"A\"]\nnominal = 90\nclass = \"c\"\nlength = 20";
    assert_eq!(limits("mm", own, angle)[1], (Some(89.0), 91.0));
}

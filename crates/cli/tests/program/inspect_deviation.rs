//! Deviations from the reference in a plan: the numbers, the rules and the words of `compare`.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, status, stderr, stdout, trueness};

/// Deviations that a plan asks for are those of `compare`, and their verdict counts.
#[test]
fn deviations_of_a_plan_are_those_of_a_comparison() {
    let folder = Folder::new();
    // A square of 10 mm and points above it, a fifth of them 0.3 mm away, one far off.
    folder.write("nominal.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3\nf 1 3 4\n");
    let points = (0..100).map(|k| {
        let z = if k == 50 {
            7.0
        } else if k % 5 == 0 {
            0.3
        } else {
            0.05
        };
        format!("{} {} {z}\n", 0.5 + f64::from(k % 10), 0.5 + f64::from(k / 10))
    });
    folder.write("scan.xyz", points.collect::<String>());
    let plan = |deviation: &str| {
        let head = "schema = \"trueness/plan/1\"\nmeasured = \"scan.xyz\"\nreference = \"nominal.obj\"\n";
        let plan = folder.write("plan.toml", format!("{head}[deviation]\n{deviation}"));
        let paths =
            ["r.json", "r.csv", "r.xml", "r.html"].map(|n| folder.file(n).to_str().unwrap().to_string());
        let [json, csv, junit, html] = paths.each_ref().map(String::as_str);
        let arguments = ["--json", json, "--csv", csv, "--junit", junit, "--html", html];
        let o = trueness([&["inspect", plan.to_str().unwrap()], &arguments[..]].concat());
        let read = |p: &str| std::fs::read_to_string(p).unwrap_or_default();
        let answer = serde_json::from_str(&read(json)).unwrap_or(serde_json::Value::Null);
        (status(&o), stdout(&o) + &stderr(&o), answer, read(csv), read(junit))
    };
    let (code, table, answer, csv, junit) = plan("tolerance = [-0.1, 0.1]\nmax_distance = 5\n");
    assert_eq!((code, answer["verdict"].as_str()), (1, Some("fail")), "{table}");
    let found = &answer["deviation"];
    assert_eq!(found["excluded"]["max_distance"], 1);
    // Of 99 points 19 are beyond the tolerance.
    assert_eq!(found["tolerance"]["inside"].as_f64(), Some(80.0 / 99.0));
    let compared = folder.file("c.json");
    let [scan, nominal] = ["scan.xyz", "nominal.obj"].map(|n| folder.file(n).to_str().unwrap().to_string());
    let by_compare = ["compare", &scan, &nominal, "--tolerance", "0.1", "--max-distance", "5", "--json"];
    let o = trueness([&by_compare[..], &[compared.to_str().unwrap()]].concat());
    assert_eq!(status(&o), 1);
    let compared: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(&compared).unwrap()).unwrap();
    for key in ["deviation", "tolerance", "worst", "histogram", "excluded", "verdict"] {
        assert_eq!(found[key], compared["comparisons"][0][key], "{key}");
    }
    assert!(table.contains("80.808 % within ±0.1: fail"), "{table}");
    assert!(csv.contains(",deviation,deviation,,,,100,100,80.8"), "{csv}");
    assert!(
        junit.contains("tests=\"1\" failures=\"1\"") && junit.contains("% of the points within -0.1"),
        "{junit}"
    );

    let (code, table, answer, ..) = plan("tolerance = [-0.1, 0.1]\nmax_distance = 5\ninside = 80\n");
    assert_eq!((code, answer["verdict"].as_str()), (0, Some("pass")), "{table}");
    for (text, says) in [
        ("", "nothing in the plan can be judged"),
        ("tolerance = [0.1, -0.1]", "line 5, column 13: the tolerance is [least, greatest]"),
        ("tolerance = -0.1", "line 5, column 13: the tolerance is [least, greatest]"),
        ("tolerance = \"0.1\"", "line 5, column 13: the tolerance is [least, greatest]"),
        (
            "tolerance = [-1, 1]\ninside = 101",
            "line 6, column 10: inside is 101; a share is from 0 to 100 percent",
        ),
        ("inside = 50", "line 5, column 10: `inside` says how many points must keep a `tolerance`"),
        ("tolerance = [-1, 1]\nmax_distance = -2", "max_distance is -2; it cannot be below 0"),
        (
            "tolerance = [-1, 1]\nfacing = 0",
            "line 6, column 10: facing is 0; an angle between normals is above 0",
        ),
        ("tolerance = [-1, 1]\noutliers = \"iqr:2\"", "line 6, column 12: ‘iqr:2’ is no rule for outliers"),
        ("tolerance = [-1, 1]\ncoverage = \"all\"", "line 6, column 12: coverage is \"auto\" or a length"),
        ("tolerance = [-1, 1]\ncoverage = 0", "line 6, column 12: coverage is \"auto\" or a length"),
        (
            "tolerance = [-1, 1]\nfacing = 60",
            "`facing` of [deviation] needs the normals of the points: columns nx, ny, nz",
        ),
    ] {
        let (code, said, ..) = plan(text);
        assert!(code == 3 && said.contains(says), "should say {says}\nsays {said}");
    }
}

/// What a comparison leaves out by a rule, a plan leaves out, too: the same numbers, turned and moved by the alignment or not.
#[test]
fn rules_of_a_plan_are_those_of_a_comparison() {
    let folder = Folder::new();
    folder.write("nominal.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3\nf 1 3 4\n");
    // Over half of the square; ten points look down, one is far off.
    let scan = |z: f64, turn: f64| {
        let point = |k: i32| {
            let away = z + if k == 25 { 3.0 } else { 0.01 * f64::from(k % 7) };
            let up = if k % 5 == 0 { -turn } else { turn };
            format!("{},{},{},0,0,{up}\n", 0.5 + f64::from(k % 10), 0.5 + f64::from(k / 10), turn * away)
        };
        "x,y,z,nx,ny,nz\n".to_string() + &(0..50).map(point).collect::<String>()
    };
    let head = "schema = \"trueness/plan/1\"\nmeasured = \"scan.csv\"\nreference = \"nominal.obj\"\n";
    // Some 45 % of the square is covered.
    let asked = "[deviation]\ntolerance = [-0.1, 0.1]\nfacing = 60\noutliers = \"mad:5\"\ncoverage = 0.8\n\
                 min_coverage = 30\n";
    let plan = |align: &str| {
        let plan = folder.write("plan.toml", format!("{head}{align}{asked}"));
        let json = folder.file("r.json");
        let o = trueness(["inspect", plan.to_str().unwrap(), "--json", json.to_str().unwrap()]);
        let answer: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(&json).unwrap_or_default()).unwrap_or_default();
        (stdout(&o) + &stderr(&o), answer["deviation"].clone())
    };
    folder.write("scan.csv", scan(0.0, 1.0));
    let (table, found) = plan("");
    let compared = folder.file("c.json");
    let [measured, nominal] =
        ["scan.csv", "nominal.obj"].map(|n| folder.file(n).to_str().unwrap().to_string());
    let rules = ["--facing", "60", "--outliers", "mad:5", "--coverage", "0.8", "--tolerance", "0.1"];
    let more = ["--min-coverage", "30", "--json", compared.to_str().unwrap()];
    let o = trueness([&["compare", &measured, &nominal], &rules[..], &more].concat());
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let compared: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(&compared).unwrap()).unwrap();
    for key in ["deviation", "tolerance", "worst", "excluded", "outliers", "coverage", "verdict"] {
        assert!(!found[key].is_null() && found[key] == compared["comparisons"][0][key], "{key} {found}");
    }
    // The tenth point that looks down is the one far off.
    assert_eq!((&found["excluded"]["facing"], found["excluded"]["outlier"].as_u64()), (&10.into(), Some(0)));
    assert!(table.contains("10 points left out (10 facing)"), "{table}");
    assert!(table.contains("outliers by mad:5: 0 points") && table.contains("not covered: "), "{table}");
    // Turned over and moved, the normals turn with the points.
    folder.write("scan.csv", scan(4.0, -1.0));
    let motion = "[align]\nmethod = \"given\"\ntransform = [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]\n";
    let (_, moved) = plan(motion);
    assert_eq!(moved["excluded"]["facing"], 40);
    let turn = "[align]\nmethod = \"given\"\ntransform = [[1,0,0,0],[0,-1,0,10],[0,0,-1,-4],[0,0,0,1]]\n";
    let (_, turned) = plan(turn);
    assert_eq!(turned["excluded"]["facing"], 10);
}

/// The least greatest distance as the alignment of a plan: less than that of the best fit, and the greatest deviation is it.
#[test]
fn a_plan_aligns_by_the_least_greatest_distance() {
    let folder = Folder::new();
    // A wedge of three rectangles and two triangles, cut askew, so that one pose fits it.
    let corners = [[0.0, 0.0, 0.0], [60.0, 0.0, 0.0], [0.0, 35.0, 0.0], [60.0, 25.0, 0.0]];
    let top = [[0.0, 0.0, 12.0], [52.0, 0.0, 20.0], [0.0, 35.0, 12.0], [60.0, 25.0, 15.0]];
    let all: Vec<[f64; 3]> = corners.into_iter().chain(top).collect();
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let lines = all.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let facets = faces.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    folder.write("nominal.obj", lines.chain(facets).collect::<String>());
    // Places of all facets, off by up to 0.03 in a pattern, some of them by 0.08.
    let mut points = String::new();
    for (n, face) in faces.iter().enumerate() {
        let [a, b, c] = face.map(|v| all[v]);
        for (i, j) in (1..9).flat_map(|i| (1..9 - i).map(move |j| (f64::from(i) / 9.0, f64::from(j) / 9.0))) {
            let off =
                0.03 * (7.0 * i + 11.0 * j + n as f64).sin() + if n == 2 && i > 0.5 { 0.08 } else { 0.0 };
            let p: [f64; 3] = std::array::from_fn(|k| a[k] + i * (b[k] - a[k]) + j * (c[k] - a[k]));
            points += &format!("{} {} {}\n", p[0] + 0.2 * off, p[1] - 0.3 * off, p[2] + off);
        }
    }
    folder.write("scan.xyz", points);
    let head = "schema = \"trueness/plan/1\"\nmeasured = \"scan.xyz\"\nreference = \"nominal.obj\"\n";
    let greatest = |method: &str| {
        let text = format!("{head}[align]\nmethod = \"{method}\"\n[deviation]\ntolerance = [-1, 1]\n");
        let (plan, json) = (folder.write("plan.toml", text), folder.file("r.json"));
        let o = trueness(["inspect", plan.to_str().unwrap(), "--json", json.to_str().unwrap()]);
        let answer: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(&json).unwrap()).unwrap();
        let all = &answer["deviation"]["deviation"]["all"];
        let far = all["max"].as_f64().unwrap().max(-all["min"].as_f64().unwrap());
        (far, answer["alignment"]["greatest"].as_f64().or(answer["alignment"]["excess"].as_f64()), stdout(&o))
    };
    // All tolerances ±1: the greatest excess is the greatest distance less 1.
    let (into_zones, excess, table) = greatest("zones");
    assert!((into_zones - 1.0 - excess.unwrap()).abs() < 1e-9, "{into_zones} {excess:?}");
    assert!(table.contains("aligned by zones") && table.contains("greatest excess"), "{table}");
    let (by_squares, none, _) = greatest("best-fit");
    let (least, told, table) = greatest("chebyshev");
    assert_eq!(none, None);
    assert!(least < 0.95 * by_squares, "{least} {by_squares}");
    assert!((least - told.unwrap()).abs() < 1e-9, "{least} {told:?}");
    assert!((least - into_zones).abs() < 1e-6, "{least} {into_zones}");
    assert!(table.contains("aligned by chebyshev") && table.contains("greatest distance"), "{table}");
    let form = "[[feature]]\nid = \"A\"\nshape = \"plane\"\npoints = \"scan.xyz\"\n\
                [[characteristic]]\nid = \"1\"\nkind = \"flatness\"\nfeature = \"A\"\ntolerance = 99\n";
    let text = format!("{head}[align]\nmethod = \"zones\"\n[deviation]\n{form}");
    let o = trueness(["inspect", folder.write("none.toml", text).to_str().unwrap()]);
    assert!(status(&o) == 3 && stderr(&o).contains("fits into the tolerances"), "{}", stderr(&o));
    let bare = "schema = \"trueness/plan/1\"\n[align]\nmethod = \"chebyshev\"\n";
    let plan = folder.write("bare.toml", bare);
    let o = trueness(["inspect", plan.to_str().unwrap()]);
    assert!(status(&o) == 3, "{}", stderr(&o));
}

/// Of a plain block four poses fit as well. Each characteristic may take the one that suits it; the deviations are those of one pose and prove
/// nothing. Table, document and page tell the reason.
#[test]
fn poses_that_fit_as_well_leave_deviations_undecided() {
    let folder = Folder::new();
    let mut points = String::new();
    for k in 0..2400_u32 {
        let (i, j, side) = (k % 20, k / 20 % 20, k / 400);
        let (u, v) = ((f64::from(i) + 0.5) / 20.0, (f64::from(j) + 0.5) / 20.0);
        let [x, y, z] = match side {
            0 => [30.0 * u, 20.0 * v, 0.0],
            1 => [30.0 * u, 20.0 * v, 12.0],
            2 => [30.0 * u, 0.0, 12.0 * v],
            3 => [30.0 * u, 20.0, 12.0 * v],
            4 => [0.0, 20.0 * u, 12.0 * v],
            _ => [30.0, 20.0 * u, 12.0 * v],
        };
        points += &format!("{x} {y} {z}\n");
    }
    folder.write("scan.xyz", points);
    let corners = (0..8).map(|k| format!("v {} {} {}\n", 30 * (k & 1), 20 * (k >> 1 & 1), 12 * (k >> 2)));
    let faces = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
    let faces = faces.map(|f| format!("f {} {} {} {}\n", f[0], f[1], f[2], f[3]));
    folder.write("nominal.obj", corners.chain(faces).collect::<String>());
    let head = "schema = \"trueness/plan/1\"\nmeasured = \"scan.xyz\"\nreference = \"nominal.obj\"\n";
    let plan = folder
        .write("plan.toml", format!("{head}[align]\nmethod = \"best-fit\"\n[deviation]\ntolerance = 0.1\n"));
    let [json, html] = ["r.json", "r.html"].map(|n| folder.file(n).to_str().unwrap().to_string());
    let o = trueness(["inspect", plan.to_str().unwrap(), "--json", &json, "--html", &html]);
    let answer: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&json).unwrap()).unwrap();
    let reason = "the alignment cannot be relied on (ambiguous)";
    assert_eq!((status(&o), answer["verdict"].as_str()), (1, Some("undecided")), "{}", stdout(&o));
    assert_eq!(answer["verdict_reasons"][0]["text"].as_str(), Some(reason));
    assert!(stdout(&o).contains(reason), "{}", stdout(&o));
    assert!(std::fs::read_to_string(&html).unwrap().contains(reason));
}

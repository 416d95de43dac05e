//! Tolerances of regions, in `trueness compare --regions` and in plans.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, corpus, document, status, stderr, stdout, trueness};
use serde_json::Value;
use std::path::Path;

fn word(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A square of 20 mm in the plane z = 0, looking up.
const SQUARE: &str = "v 0 0 0\nv 20 0 0\nv 20 20 0\nv 0 20 0\nf 1 2 3\nf 1 3 4\n";

/// 400 points over it, one a square millimeter, from the upper end down: 0.05 high over x < 10 (every tenth of them 0.3), 0.15 over the rest.
fn points() -> String {
    let point = |k: usize| {
        let (x, y) = (0.5 + (k % 20) as f64, 19.5 - (k / 20) as f64);
        let z = if x > 10.0 {
            0.15
        } else if k % 20 == 3 {
            0.3
        } else {
            0.05
        };
        format!("{x} {y} {z}\n")
    };
    (0..400).map(point).collect()
}

/// The left half but for its upper end, the whole upper end, and what is far from all points.
const REGIONS: &str = "[[region]]\nid = \"left\"\nbetween = [[10, 15, 1], [0, 0, -1]]\ntolerance = 0.1\ninside = 90\n\
[[region]]\nid = \"upper\"\nbetween = [[0, 10, -1], [20, 20, 1]]\ntolerance = [0, 0.2]\n";

fn share(region: &Value) -> (u64, f64, &str) {
    let of = (&region["deviation"]["count"], &region["tolerance"]["inside"], &region["verdict"]);
    (of.0.as_u64().unwrap(), of.1.as_f64().unwrap(), of.2.as_str().unwrap())
}

#[test]
fn every_region_is_judged_by_its_own_tolerance() {
    let folder = Folder::new();
    let (square, scan) = (folder.write("square.obj", SQUARE), folder.write("scan.xyz", points()));
    let regions = folder.write("regions.toml", REGIONS);
    let [json, html] = ["r.json", "r.html"].map(|n| folder.file(n));
    let run = |regions: &Path, more: &[&str]| {
        let words =
            ["compare", word(&scan), word(&square), "--regions", word(regions), "--json", word(&json)];
        let o = trueness(words.iter().chain(more));
        let text = std::fs::read_to_string(&json).unwrap_or_default();
        (status(&o), stdout(&o), serde_json::from_str::<Value>(&text).unwrap_or_default())
    };
    let (code, table, found) = run(&regions, &["--tolerance", "-0.2,+0.2", "--html", word(&html)]);
    let c = &found["comparisons"][0];
    // 150 places left of 10 and below 15, one column of ten too high: 0.9 are within. The first that has a place counts: the
    // upper end has 50 of the left half's and 100 others; the five of the column that are 0.3 high fail. 100 others are left.
    assert_eq!(share(&c["regions"][0]), (150, 0.9, "pass"));
    assert_eq!(share(&c["regions"][1]), (150, 145.0 / 150.0, "fail"));
    assert_eq!(c["tolerance"]["inside"], 1.0);
    assert_eq!((code, c["verdict"].as_str(), found["verdict"].as_str()), (1, Some("fail"), Some("fail")));
    assert_eq!(c["deviation"]["all"]["count"], 400);
    let lower = |n: usize| c["regions"][n]["tolerance"]["lower"].as_f64();
    assert_eq!((lower(0), lower(1)), (Some(-0.1), Some(0.0)));
    // The worst place is 0.2 beyond the tolerance of the left half, although the upper end has the same deviations, and has them first.
    assert_eq!((&c["worst"][0]["region"], c["worst"][0]["deviation"].as_f64()), (&"left".into(), Some(0.3)));
    for part in ["left", "90.000", "upper", "96.667", "(others)", "together: FAIL"] {
        assert!(table.contains(part), "{part}\n{table}");
    }
    // All points that no region judges have a verdict of their own.
    assert!(table.lines().any(|l| l.starts_with("(others)") && l.ends_with("pass")), "{table}");
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(page.contains("Tolerances of regions") && page.contains("all other points"));
    // No color of a map can stand for three tolerances.
    assert!(found["scale"]["tolerance"].is_null(), "{}", found["scale"]);

    // Without a tolerance for all, the others are not judged; wide enough, all pass.
    let wide = folder.write("wide.toml", REGIONS.replace("[0, 0.2]", "[0, 0.3]"));
    let (code, _, found) = run(&wide, &[]);
    assert_eq!((code, found["verdict"].as_str()), (0, Some("pass")));
    assert!(found["comparisons"][0].get("tolerance").is_none());
    // A region that no point reaches has not been measured, and nothing passes for it.
    let empty = folder
        .write("empty.toml", REGIONS.replace("[[0, 10, -1], [20, 20, 1]]", "[[0, 10, 5], [20, 20, 6]]"));
    let (code, _, found) = run(&empty, &[]);
    assert_eq!((code, found["verdict"].as_str()), (1, Some("undecided")));
    for (bad, says) in [
        ("", "there is no [[region]]"),
        (&REGIONS.replace("upper", "left"), "line 7, column 6: there are two regions \"left\""),
        (&REGIONS.replace("[0, 0.2]", "[0.2, 0]"), "line 9, column 13: the tolerance is [least, greatest]"),
        (
            &REGIONS.replace("between = [[0, 10, -1], [20, 20, 1]]\n", ""),
            "a region has one of `seed`, `between`",
        ),
        (&REGIONS.replace("inside = 90", "inside = 190"), "inside is 190"),
    ] {
        let bad = folder.write("bad.toml", bad);
        let o = trueness(["compare", word(&scan), word(&square), "--regions", word(&bad)]);
        assert!(status(&o) == 3 && stderr(&o).contains(says), "{says}: {} {}", status(&o), stderr(&o));
    }
}

#[test]
fn a_seed_is_the_plane_or_cylinder_around_it() {
    let folder = Folder::new();
    let plate = corpus("examples/plate/nominal.stl");
    let out = folder.file("d.csv");
    let regions = "[[region]]\nid = \"top\"\nseed = [5, 5, 17]\ntolerance = [-0.1, 0.1]\n\
        [[region]]\nid = \"bore\"\nseed = [9.1, 16.5, 8]\ntolerance = [-0.1, 0.1]\n";
    let file = folder.write("regions.toml", regions);
    let words = [
        "compare",
        word(&plate),
        word(&plate),
        "--sample",
        "20000",
        "--regions",
        word(&file),
        "--out",
        word(&out),
    ];
    let found = document(words);
    let text = std::fs::read_to_string(&out).unwrap();
    let places: Vec<Vec<f64>> =
        text.lines().skip(1).map(|l| l.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    let top = places.iter().filter(|p| (p[2] - 17.0).abs() < 1e-6).count() as u64;
    // On the bore of radius 7.5 about (16.6, 16.5), to the sag of its facets.
    let round = |p: &&Vec<f64>| {
        ((p[0] - 16.6).hypot(p[1] - 16.5) - 7.5).abs() < 0.05 && p[2] > 1e-6 && p[2] < 17.0 - 1e-6
    };
    let bore = places.iter().filter(round).count() as u64;
    let counts = |k: usize| found["comparisons"][0]["regions"][k]["deviation"]["count"].as_u64().unwrap();
    assert!(top > 2000 && bore > 500, "{top} {bore}");
    // Samples on the rim that two facets share may go to either.
    assert!(
        counts(0).abs_diff(top) <= 5 && counts(1).abs_diff(bore) <= 25,
        "{} {top}, {} {bore}",
        counts(0),
        counts(1)
    );
    let nowhere = folder.write("nowhere.toml", regions.replace("[5, 5, 17]", "[nan, 5, 17]"));
    let o = trueness(["compare", word(&plate), word(&plate), "--regions", word(&nowhere)]);
    assert!(status(&o) == 3 && stderr(&o).contains("three finite numbers"), "{}", stderr(&o));
}

#[test]
fn regions_of_a_plan_are_those_of_a_comparison() {
    let folder = Folder::new();
    let (square, scan) = (folder.write("square.obj", SQUARE), folder.write("scan.xyz", points()));
    let regions = folder.write("regions.toml", REGIONS);
    let head = "schema = \"trueness/plan/1\"\nmeasured = \"scan.xyz\"\nreference = \"square.obj\"\n";
    let feature = "[[feature]]\nid = \"A\"\nshape = \"plane\"\nnominal = { point = [0, 0, 0], normal = [0, 0, 1], \
        boundary = [[0, 0, 0], [20, 0, 0], [20, 20, 0], [0, 20, 0]] }\nextract = { distance = 1 }\n";
    let paths = ["r.json", "r.csv", "r.xml", "r.html", "r.qif"].map(|n| folder.file(n));
    let [json, csv, junit, html, qif] = paths.each_ref().map(|p| word(p));
    let run = |deviation: &str| {
        let plan = folder.write("plan.toml", format!("{head}{feature}{deviation}"));
        let words = [
            "inspect",
            word(&plan),
            "--json",
            json,
            "--csv",
            csv,
            "--junit",
            junit,
            "--html",
            html,
            "--qif",
            qif,
        ];
        let o = trueness(words);
        let text = std::fs::read_to_string(json).unwrap_or_default();
        (status(&o), stdout(&o) + &stderr(&o), serde_json::from_str::<Value>(&text).unwrap_or_default())
    };
    let asked = format!(
        "[deviation]\ntolerance = [-0.2, 0.2]\n{}",
        REGIONS.replace("[[region]]", "[[deviation.region]]")
    );
    let (code, table, found) = run(&asked);
    let words =
        ["compare", word(&scan), word(&square), "--tolerance", "-0.2,+0.2", "--regions", word(&regions)];
    let compared = &document(words)["comparisons"][0];
    for key in ["deviation", "regions", "tolerance", "worst", "verdict"] {
        assert!(!compared[key].is_null() && found["deviation"][key] == compared[key], "{key}");
    }
    assert_eq!((code, found["verdict"].as_str()), (1, Some("fail")), "{table}");
    let read = |path: &str| std::fs::read_to_string(path).unwrap();
    assert!(table.contains("together: FAIL") && table.contains("upper"), "{table}");
    assert!(read(csv).contains(",deviation upper,deviation,") && read(csv).contains(",deviation,deviation,"));
    assert!(read(junit).contains("tests=\"3\" failures=\"1\"") && read(junit).contains("deviation left"));
    assert_eq!(read(qif).matches("UserDefinedAttributeCharacteristicMeasurement id").count(), 3);
    assert!(read(html).contains("Tolerances of regions"));
    // The facets of a feature: here all of them.
    let by_feature = "[deviation]\n[[deviation.region]]\nid = \"A\"\nfeature = \"A\"\ntolerance = [0, 0.3]\n";
    let (code, said, found) = run(by_feature);
    assert_eq!((code, share(&found["deviation"]["regions"][0])), (0, (400, 1.0, "pass")), "{said}");
    for (bad, says) in [
        (by_feature.replace("feature = \"A\"", "feature = \"B\""), "there is no feature \"B\""),
        (by_feature.replace("feature = \"A\"\n", ""), "a region has one of"),
        (by_feature.replace("[0, 0.3]", "[0, nan]"), "the tolerance is [least, greatest]"),
    ] {
        let (code, said, _) = run(&bad);
        assert!(code == 3 && said.contains(says) && said.contains("line 1"), "{says}: {said}");
    }
}

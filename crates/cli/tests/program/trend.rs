//! `trueness trend`: results of one plan over many parts.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, status, stderr, stdout, trueness};
use serde_json::Value;

/// A plan of a floor and of a roof at this height over it, `tolerance` for the distance.
fn plan(part: usize, tolerance: f64) -> String {
    format!(
        "schema = \"trueness/plan/1\"\ntitle = \"Block\"\n\
         [[feature]]\nid = \"A\"\nshape = \"plane\"\npoints = \"floor.xyz\"\n\
         [[feature]]\nid = \"R\"\nshape = \"plane\"\npoints = \"roof-{part}.xyz\"\n\
         [[characteristic]]\nid = \"h\"\nkind = \"distance\"\nfeature = \"R\"\ndatums = [\"A\"]\n\
         nominal = 10\nupper = {tolerance}\nlower = -{tolerance}\n\
         [[characteristic]]\nid = \"f\"\nkind = \"flatness\"\nfeature = \"R\"\ntolerance = 0.5\n"
    )
}

fn square(z: f64, bump: f64) -> String {
    format!("0 0 {z}\n10 0 {z}\n0 10 {z}\n10 10 {z}\n5 5 {}\n", z + bump)
}

/// Results of parts of these heights.
fn results(folder: &Folder, heights: &[f64]) -> Vec<String> {
    folder.write("floor.xyz", square(0.0, 0.0));
    let one = |(n, z): (usize, &f64)| {
        folder.write(&format!("roof-{n}.xyz"), square(*z, 0.01));
        let plan = folder.write(&format!("plan-{n}.toml"), plan(n, 0.5));
        let json = folder.file(&format!("result-{n}.json")).to_str().unwrap().to_string();
        let o = trueness(["inspect", plan.to_str().unwrap(), "--json", &json]);
        assert!(status(&o) <= 1, "{}", stderr(&o));
        json
    };
    heights.iter().enumerate().map(one).collect()
}

fn trend(folder: &Folder, results: &[String]) -> (i32, String, Value, String) {
    let (json, csv) = (folder.file("trend.json"), folder.file("trend.csv"));
    let [json, csv] = [json, csv].map(|p| p.to_str().unwrap().to_string());
    let mut words = vec!["trend", "--json", &json, "--csv", &csv];
    words.extend(results.iter().map(String::as_str));
    let o = trueness(words);
    let read = |p: &str| std::fs::read_to_string(p).unwrap_or_default();
    let document = serde_json::from_str(&read(&json)).unwrap_or(Value::Null);
    (status(&o), stdout(&o) + &stderr(&o), document, read(&csv))
}

/// Mean, spreads, limits and indices of six parts against their formulas.
#[test]
fn a_course_is_told() {
    let folder = Folder::new();
    // The bump moves the mean of each roof by 0.002.
    let heights = [10.0, 10.1, 9.9, 10.05, 9.95, 10.0];
    let (code, table, d, csv) = trend(&folder, &results(&folder, &heights));
    assert_eq!((code, d["schema"].as_str()), (0, Some("trueness/trend/1")), "{table}");
    let c = &d["characteristics"][0];
    let near = |key: &str, wanted: f64| {
        let found = key.split('.').fold(c, |v, k| &v[k]).as_f64().unwrap_or(f64::NAN);
        assert!((found - wanted).abs() < 1e-9, "{key}: {found} instead of {wanted}");
    };
    let mean = 10.002;
    let s = (heights.iter().map(|z| (z + 0.002 - mean).powi(2)).sum::<f64>() / 5.0).sqrt();
    let moving = (0.1 + 0.2 + 0.15 + 0.1 + 0.05) / 5.0;
    let within = moving * std::f64::consts::PI.sqrt() / 2.0;
    near("mean", mean);
    near("std_dev", s);
    near("std_dev_within", within);
    near("min", 9.902);
    near("max", 10.102);
    near("control.upper", mean + 3.0 * within);
    near("control.moving_range", moving);
    near("pp.value", 1.0 / (6.0 * s));
    near("ppk.value", (10.5 - mean) / (3.0 * s));
    near("cp.value", 1.0 / (6.0 * within));
    near("cpk.value", (10.5 - mean) / (3.0 * within));
    assert!(c["ppk"]["low"].as_f64() < c["ppk"]["value"].as_f64());
    assert_eq!(c["counts"]["pass"], 6);
    // A tolerance of form has one limit: no Pp.
    let f = &d["characteristics"][1];
    assert!(f["pp"].is_null() && f["lower"].is_null(), "{f}");
    assert_eq!((d["in_control"].as_bool(), d["verdict"].as_str()), (Some(true), Some("pass")));
    assert!(d["warnings"][0].as_str().unwrap().contains("not the same text"), "{d}");
    assert_eq!(csv.lines().count(), 3);
    assert!(csv.lines().nth(1).unwrap().starts_with("h,distance,R,A,mm,9.5,10.5,6,6,10.00"), "{csv}");
    assert!(table.contains("pass: 6 parts, 6 of them pass; in control"), "{table}");
}

/// Whatever names are long, heads stand above their numbers and no line of the tables runs over.
#[test]
fn the_table_fits_a_terminal() {
    let folder = Folder::new();
    let long = "top of the rear mounting flange, upper left";
    folder.write("floor.xyz", square(0.0, 0.0));
    let files = [9.9, 10.0, 10.1].map(|z| {
        folder.write("roof-0.xyz", square(z, 0.01));
        let text = plan(0, 0.5)
            .replace("\"R\"", &format!("\"{long}\""))
            .replace("\"h\"", "\"height of the flange\"");
        let plan = folder.write("plan.toml", text);
        let json = folder.file(&format!("result-{z}.json")).to_str().unwrap().to_string();
        let o = trueness(["inspect", plan.to_str().unwrap(), "--json", &json]);
        assert!(status(&o) <= 1, "{}", stderr(&o));
        json
    });
    let (_, table, d, _) = trend(&folder, &files);
    assert!(table.lines().all(|l| l.chars().count() <= 100), "{table}");
    let ends = |word: &str| {
        let (line, at) = table.lines().find_map(|l| Some((l, l.find(word)?))).unwrap();
        line[..at + word.len()].chars().count()
    };
    let max = format!("{:.4}", d["characteristics"][0]["max"].as_f64().unwrap());
    assert_eq!(ends("max"), ends(&max), "{table}");
    assert!(table.contains(&format!("  {long}\n")), "{table}");
    assert!(
        table.contains("height of the flange  1.") || table.contains("height of the flange  2."),
        "{table}"
    );
}

/// The page holds the same document, and its charts without any script.
#[test]
fn a_report_is_written() {
    let folder = Folder::new();
    let files = results(&folder, &[10.0, 10.1, 9.9, 11.0]);
    let [html, json] = ["trend.html", "trend.json"].map(|n| folder.file(n).to_str().unwrap().to_string());
    let mut words = vec!["trend", "--html", &html, "--json", &json, "--lang", "de"];
    words.extend(files.iter().map(String::as_str));
    let o = trueness(words);
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    let page = std::fs::read_to_string(&html).unwrap();
    let manifest = page.split_once("id=\"manifest\">").unwrap().1.split_once("</script>").unwrap().0;
    let manifest: Value = serde_json::from_str(manifest).unwrap();
    let document: Value = serde_json::from_str(&std::fs::read_to_string(&json).unwrap()).unwrap();
    assert_eq!(manifest["result"], document);
    assert_eq!(document["characteristics"][0]["verdicts"][3], "fail");
    assert_eq!(page.matches("<figure class=\"chart\"").count(), 2);
    assert!(page.contains("Eingriff") && page.contains("Nicht in Ordnung"));
    // A result is never written over.
    let over = trueness(["trend", &files[0], &files[1], "--html", &files[1]]);
    assert_eq!(status(&over), 2, "{}", stderr(&over));
}

#[test]
fn parts_out_of_control_are_named() {
    let folder = Folder::new();
    let mut heights: Vec<f64> = (0..14).map(|k| 10.0 + 0.001 * f64::from(k % 2)).collect();
    heights[9] = 10.2;
    let (code, table, d, csv) = trend(&folder, &results(&folder, &heights));
    assert_eq!(
        (code, d["verdict"].as_str(), d["in_control"].as_bool()),
        (1, Some("pass"), Some(false)),
        "{table}"
    );
    let out = d["characteristics"][0]["out_of_control"].as_array().unwrap();
    assert!(out.iter().any(|o| o["part"] == 9 && o["rule"] == "beyond"), "{out:?}");
    assert!(table.contains("! h: part 10 (") && table.contains("is beyond a control limit"), "{table}");
    assert!(csv.lines().nth(1).unwrap().ends_with(",9 10 11"), "{csv}");
    // A part that fails makes the trend fail.
    let mut heights = vec![10.0; 3];
    heights[1] = 11.0;
    let (code, table, d, _) = trend(&folder, &results(&folder, &heights));
    assert_eq!((code, d["verdict"].as_str()), (1, Some("fail")), "{table}");
}

/// A part that was not measured has no value and leaves the others in their order.
#[test]
fn parts_without_a_value_are_counted() {
    let folder = Folder::new();
    let files = results(&folder, &[10.0, 10.1, 10.0]);
    folder.write("roof-1.xyz", "0 0 0\n");
    let plan = folder.file("plan-1.toml");
    let o = trueness(["inspect", plan.to_str().unwrap(), "--json", &files[1]]);
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    let (code, table, d, _) = trend(&folder, &files);
    let c = &d["characteristics"][0];
    assert_eq!(
        (code, c["measured"].as_u64(), c["counts"]["not_measured"].as_u64()),
        (1, Some(2), Some(1)),
        "{table}"
    );
    assert!(c["values"][1].is_null() && c["values"][2].is_number());
    // The two that are left are alike.
    assert!(c["cpk"].is_null());
    assert_eq!(c["capability_reason"].as_str(), Some("the values do not vary"));
    let (_, _, d, _) = trend(&folder, &files[..1]);
    let reason = d["characteristics"][0]["course_reason"].as_str().unwrap();
    assert_eq!(reason, "it needs at least two values, there are 1");
}

#[test]
fn what_makes_no_trend_is_told() {
    let folder = Folder::new();
    let files = results(&folder, &[10.0, 10.1]);
    let refused = |second: &str, says: &str| {
        let o = trueness(["trend", &files[0], second]);
        assert_eq!((status(&o), stdout(&o).as_str()), (3, ""), "{}", stderr(&o));
        assert!(stderr(&o).contains(says) && stderr(&o).contains(second), "{}", stderr(&o));
    };
    let changed = |from: &str, to: &str| {
        let text = std::fs::read_to_string(&files[1]).unwrap();
        assert!(text.contains(from));
        folder.write("changed.json", text.replacen(from, to, 1)).to_str().unwrap().to_string()
    };
    let tolerance = changed("\"tolerance\": 0.5", "\"tolerance\": 0.4");
    refused(&tolerance, "characteristic \"f\": its tolerance is 0.4, in the first result 0.5");
    refused(
        &changed("\"id\": \"f\"", "\"id\": \"g\""),
        "characteristic \"f\" of the first result is missing",
    );
    refused(
        &changed("\"kind\": \"distance\"", "\"kind\": \"size\""),
        "its kind is size, in the first result distance",
    );
    refused(&changed("\"units\": \"mm\"", "\"units\": \"in\""), "its units are \"in\", not \"mm\"");
    let second: Value = serde_json::from_str(&std::fs::read_to_string(&files[1]).unwrap()).unwrap();
    let passed =
        second["characteristics"].as_array().unwrap().iter().find(|c| c["verdict"] == "pass").unwrap();
    let edited = |to: Value| {
        let mut all = second.clone();
        let id = passed["id"].as_str().unwrap();
        let of = all["characteristics"].as_array_mut().unwrap().iter_mut().find(|c| c["id"] == id).unwrap();
        of["value"] = to;
        folder.write("edited.json", all.to_string()).to_str().unwrap().to_string()
    };
    refused(&edited(Value::Null), "has the verdict \"pass\" without a value");
    refused(&edited(1e3.into()), "has the verdict \"pass\" with a value beyond its limits");
    refused(&changed("trueness/inspect/1", "trueness/fit/1"), "its schema is \"trueness/fit/1\"");
    refused(&changed("\"verdict\": \"pass\"", "\"verdict\": \"good\""), "it is no whole result");
    let text = folder.write("words.json", "these are words").to_str().unwrap().to_string();
    refused(&text, "it is no JSON");
    refused(&files[0], "it is the same as result 1, to the last byte; give each part once");
    let none = folder.file("none.json").to_str().unwrap().to_string();
    refused(&none, "the result cannot be read");
    assert_eq!(status(&trueness(["trend"])), 2);
    let over = trueness(["trend", &files[0], &files[1], "--csv", &files[1]]);
    assert_eq!(status(&over), 2, "{}", stderr(&over));
}

/// What no inspection writes is refused with the file and the place, one edit at a time.
#[test]
fn results_that_contradict_themselves_are_refused() {
    let folder = Folder::new();
    let files = results(&folder, &[10.0, 10.1]);
    let sound: Value = serde_json::from_str(&std::fs::read_to_string(&files[1]).unwrap()).unwrap();
    assert_eq!(sound["verdict"], "pass");
    type Edit = fn(&mut Value);
    let cases: [(Edit, &str); 14] = [
        (|d| d["verdict"] = "fail".into(), "its verdict is \"fail\", but the worst in it is \"pass\""),
        (
            |d| {
                d["characteristics"][0]["verdict"] = "fail".into();
                d["characteristics"][0]["value"] = 11.into();
                d["counts"]["pass"] = 1.into();
                d["counts"]["fail"] = 1.into();
            },
            "its verdict is \"pass\", but the worst in it is \"fail\"",
        ),
        (
            |d| {
                d["characteristics"][1]["verdict"] = "not_measured".into();
                d["characteristics"][1]["value"] = Value::Null;
                d["counts"]["pass"] = 1.into();
                d["counts"]["not_measured"] = 1.into();
            },
            "its verdict is \"pass\", but the worst in it is \"not measured\"",
        ),
        (
            |d| d["alignment"]["warnings"] = serde_json::json!([{ "kind": "poor", "text": "it is far off" }]),
            "its verdict is \"pass\", but the worst in it is \"undecided\"",
        ),
        (|d| d["counts"]["pass"] = 1.into(), "its counts are not those of its characteristics"),
        (|d| d["characteristics"][1]["id"] = "h".into(), "it has two characteristics \"h\""),
        (|d| d["characteristics"][1]["unit"] = "in".into(), "\"f\" has the unit \"in\", not mm, deg, 1"),
        (
            |d| d["characteristics"][1]["value"] = (-1).into(),
            "\"f\" has the value -1, but no zone is narrower",
        ),
        (
            |d| d["characteristics"][0]["lower"] = 12.into(),
            "\"h\" has the lower limit 12 above the upper one 10.5",
        ),
        (
            |d| d["characteristics"][0]["uncertainty"] = (-0.5).into(),
            "\"h\" has the negative uncertainty -0.5",
        ),
        (
            |d| d["characteristics"][0]["interval"] = serde_json::json!([11, 10]),
            "\"h\" has an interval from 11 to 10",
        ),
        (
            |d| d["characteristics"][0]["verdict"] = "fail".into(),
            "\"h\" has the verdict \"fail\" with a value within its limits",
        ),
        (
            |d| d["characteristics"][0]["verdict"] = "not_measured".into(),
            "\"h\" has the verdict \"not measured\" with a value",
        ),
        (
            |d| {
                d["characteristics"][0]["verdict"] = "undecided".into();
                d["characteristics"][0]["value"] = Value::Null;
            },
            "\"h\" has the verdict \"undecided\" without a value",
        ),
    ];
    for (edit, says) in cases {
        let mut document = sound.clone();
        edit(&mut document);
        let edited = folder.write("edited.json", document.to_string());
        let edited = edited.to_str().unwrap();
        // As the only result, and as the second one.
        for words in [vec!["trend", edited], vec!["trend", &files[0], edited]] {
            let o = trueness(words);
            assert_eq!((status(&o), stdout(&o).as_str()), (3, ""), "{says}: {}", stderr(&o));
            assert!(stderr(&o).contains(says) && stderr(&o).contains(edited), "{says}: {}", stderr(&o));
        }
    }
    let unchanged = folder.write("edited.json", sound.to_string());
    assert_eq!(status(&trueness(["trend", unchanged.to_str().unwrap()])), 0);
}

/// Bars reach over the interval of a result; of a result without one, as far as its uncertainty.
#[test]
fn bars_show_where_the_true_value_lies() {
    let folder = Folder::new();
    let files = results(&folder, &[10.0, 10.1]);
    let edit = |file: &str, change: &dyn Fn(&mut Value)| {
        let mut document: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
        change(&mut document["characteristics"]);
        std::fs::write(file, document.to_string()).unwrap();
    };
    edit(&files[0], &|all| {
        all[0]["uncertainty"] = 0.25.into();
        all[1]["uncertainty"] = 0.02.into();
        all[1]["interval"] = serde_json::json!([-0.5, 0.125]);
    });
    let (_, _, document, _) = trend(&folder, &files);
    let of = |n: usize| document["characteristics"][n]["intervals"].clone();
    let value = document["characteristics"][0]["values"][0].as_f64().unwrap();
    assert_eq!(of(0), serde_json::json!([[value - 0.25, value + 0.25], null]));
    assert_eq!(of(1), serde_json::json!([[-0.5, 0.125], null]));
}

/// A measured block of 10 mm in 600 facets whose top rises by `rise` towards x = 10; with a `hole` nothing of its top is there for y > 5.
fn block(rise: f64, hole: bool) -> String {
    let mut text = String::from("solid block\n");
    let mut facet = |p: [[f64; 3]; 3]| {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        p.iter().for_each(|[x, y, z]| text.push_str(&format!("vertex {x:?} {y:?} {z:?}\n")));
        text.push_str("endloop\nendfacet\n");
    };
    for (axis, side) in [(0, 0.0), (0, 10.0), (1, 0.0), (1, 10.0), (2, 0.0), (2, 10.0)] {
        for (i, j) in (0..10).flat_map(|i| (0..10).map(move |j| (f64::from(i), f64::from(j)))) {
            let at = |u: f64, v: f64| {
                let mut p = [0.0; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, u, v);
                if axis == 2 && side > 0.0 {
                    p[2] += rise * p[0] / 10.0;
                }
                p
            };
            let mut quad = [at(i, j), at(i + 1.0, j), at(i + 1.0, j + 1.0), at(i, j + 1.0)];
            if side == 0.0 {
                quad.reverse();
            }
            if hole && axis == 2 && side > 0.0 && quad.iter().any(|p| p[1] > 5.0) {
                continue;
            }
            facet([quad[0], quad[1], quad[2]]);
            facet([quad[0], quad[2], quad[3]]);
        }
    }
    text + "endsolid block\n"
}

/// The deviations are all that the plan judges: their course has a chart, with the share that is allowed.
fn the_course_of_deviations_is_told(folder: &Folder, parts: &[String], [json, page]: [&str; 2]) {
    let mut second: Value = serde_json::from_str(&std::fs::read_to_string(&parts[1]).unwrap()).unwrap();
    second["deviation"]["tolerance"]["inside"] = 0.925.into();
    second["deviation"]["verdict"] = "fail".into();
    second["verdict"] = "fail".into();
    let second = folder.write("second.json", second.to_string()).to_str().unwrap().to_string();
    let o = trueness(["trend", &parts[0], &second, &parts[2], "--json", json, "--html", page]);
    assert!(status(&o) == 1 && stdout(&o).contains("deviation"), "{}{}", stdout(&o), stderr(&o));
    let document: Value = serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
    let [c] = &document["characteristics"].as_array().unwrap()[..] else { panic!("{document}") };
    assert_eq!((c["id"].as_str(), c["unit"].as_str()), (Some("deviation"), Some("%")));
    assert_eq!(c["values"], serde_json::json!([100.0, 92.5, 100.0]));
    assert_eq!(c["verdicts"], serde_json::json!(["pass", "fail", "pass"]));
    assert_eq!((c["lower"].as_f64(), c["mean"].as_f64()), (Some(100.0), Some(97.5)));
    assert!(c["control"].is_null() && c["ppk"].is_null(), "{c}");
    let charts = std::fs::read_to_string(page).unwrap();
    assert_eq!(charts.matches("<figure class=\"chart\"").count(), 1);
}

/// Mean and spread over the part against the closed form: the top of three parts rises by 0, 0.3 and 0.6 mm along x.
#[test]
fn mean_and_spread_are_told_over_the_part() {
    let folder = Folder::new();
    folder.write("nominal.stl", block(0.0, false));
    let plan = "schema = \"trueness/plan/1\"\nmeasured = \"nominal.stl\"\nreference = \"nominal.stl\"\n\
                [deviation]\ntolerance = [-1, 1]\n";
    let plan = folder.write("plan.toml", plan);
    let name = |n: &str| folder.file(n).to_str().unwrap().to_string();
    let inspect = |n: usize, scan: String, places: bool| {
        let (scan, json) = (folder.write(&format!("part-{n}.stl"), scan), name(&format!("part-{n}.json")));
        let mut words =
            vec!["inspect", plan.to_str().unwrap(), "--json", &json, "--measured", scan.to_str().unwrap()];
        words.extend(places.then_some("--places"));
        let o = trueness(words);
        assert_eq!(status(&o), 0, "{}", stderr(&o));
        json
    };
    let parts: Vec<String> =
        [0.0, 0.3, 0.6].iter().enumerate().map(|(n, r)| inspect(n, block(*r, n == 2), true)).collect();
    let (json, page) = (name("trend.json"), name("map.html"));
    let mut words = vec!["trend", "--json", &json, "--map", &page];
    words.extend(parts.iter().map(String::as_str));
    let o = trueness(words);
    assert_eq!(status(&o), 0, "{}{}", stdout(&o), stderr(&o));
    assert!(stdout(&o).contains("sigma: greatest 0.29"), "{}", stdout(&o));
    let document: Value = serde_json::from_str(&std::fs::read_to_string(&json).unwrap()).unwrap();
    let map = &document["map"];
    let (mut top, mut lacking) = (0, 0);
    for (n, place) in map["places"].as_array().unwrap().iter().enumerate() {
        let [x, y, z] = [0, 1, 2].map(|k| place[k].as_f64().unwrap());
        // Well within the top: at its rim, vertices of the sides count too where the reference has them nearest.
        if z < 10.0 || !(1.0..9.0).contains(&x) || !(1.0..9.0).contains(&y) {
            continue;
        }
        top += 1;
        // Each place has the value of the place of the scan nearest to it, half a facet away at most: a vertex, or one between vertices, which
        // are not the same in every part.
        let (mean, sigma) = (map["mean"][n].as_f64().unwrap(), map["std_dev"][n].as_f64().unwrap());
        match map["parts"][n].as_u64().unwrap() {
            3 => {
                assert!((mean - 0.03 * x).abs() < 0.03, "{mean} at {x}");
                assert!((sigma - mean).abs() < 0.01, "the spread of 0, r, 2 r is r: {sigma}, {mean}");
            }
            2 => {
                lacking += 1;
                assert!(y > 5.0 && (mean - 0.015 * x).abs() < 0.015, "{mean} at {x}, {y}");
                assert!((sigma - mean * 2.0f64.sqrt()).abs() < 0.01, "{sigma}, {mean}");
            }
            other => panic!("{other} parts at {x}, {y}"),
        }
    }
    assert!(top > 500 && lacking > 100, "{top}, {lacking}");
    assert_eq!(
        map["partial"].as_u64().unwrap(),
        map["parts"].as_array().unwrap().iter().filter(|p| **p == 2).count() as u64
    );
    let manifest = std::fs::read_to_string(&page).unwrap();
    let manifest = manifest.split_once("id=\"manifest\">").unwrap().1.split_once("</script>").unwrap().0;
    let manifest: Value = serde_json::from_str(manifest).unwrap();
    assert_eq!(manifest["maps"].as_array().unwrap().len(), 2);
    assert_eq!(manifest["maps"][1]["scale"]["lower"], 0.0);
    the_course_of_deviations_is_told(&folder, &parts, [&json, &page]);
    // A result without places: why there is no map.
    let bare = inspect(7, block(0.1, false), false);
    let o = trueness(["trend", &parts[0], &bare, "--map", &page]);
    assert_eq!(status(&o), 3, "{}", stdout(&o));
    assert!(stderr(&o).contains("result 2 of 2 holds no deviations at places"), "{}", stderr(&o));
}

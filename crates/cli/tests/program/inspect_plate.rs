//! The example that ships: its features against the reference, its verdicts, its report.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, corpus, document, status, stderr, trueness};
use serde_json::Value;

fn numbers(v: &Value) -> [f64; 3] {
    let of = |k: usize| match &v[k] {
        Value::String(text) => text.parse().unwrap(),
        number => number.as_f64().unwrap(),
    };
    [of(0), of(1), of(2)]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn off_axis(p: [f64; 3], point: [f64; 3], direction: [f64; 3]) -> f64 {
    let q: [f64; 3] = std::array::from_fn(|k| p[k] - point[k]);
    (dot(q, q) - dot(q, direction).powi(2)).max(0.0).sqrt()
}

/// Distance within which a feature found by the nominal agrees with the least-squares element of its labeled points, mm.
const NEAR: f64 = 0.002;

#[test]
fn features_found_by_the_nominal_are_those_of_the_reference() {
    let folder = corpus("examples/plate");
    let text = std::fs::read_to_string(folder.join("reference.json")).unwrap();
    let reference: Value = serde_json::from_str(&text).unwrap();
    let answer = document(["inspect", folder.join("plate.toml").to_str().unwrap()]);
    let transform = &answer["alignment"]["transform"];
    let turned = |v: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| dot(numbers(&transform[k]), v)) };
    let moved = |p: [f64; 3]| -> [f64; 3] {
        let t = turned(p);
        std::array::from_fn(|k| t[k] + transform[k][3].as_f64().unwrap())
    };
    let faces = [
        ("A", 11),
        ("top", 1),
        ("B", 7),
        ("C", 9),
        ("boss", 0),
        ("boss end", 2),
        ("cone", 8),
        ("pocket", 10),
    ];
    for (id, face) in faces {
        let found = answer["features"].as_array().unwrap().iter().find(|f| f["id"] == id).unwrap();
        let known = &reference["features"][face];
        let (own, lsq) = (&found["parameters"], &known["lsq"]);
        let mut off: Vec<(&str, f64)> = vec![];
        let form: f64 = known["form_lsq"].as_str().unwrap().parse().unwrap();
        off.push(("form", found["form_error"].as_f64().unwrap() - form));
        if let Some(radius) = lsq["radius"].as_str() {
            off.push(("radius", own["radius"].as_f64().unwrap() - radius.parse::<f64>().unwrap()));
        }
        // Over the extent of the feature, its axis or plane must be where that of the reference is.
        match known["type"].as_str().unwrap() {
            "plane" => {
                let (point, normal) = (numbers(&own["point"]), numbers(&own["normal"]));
                let (at, way) = (moved(numbers(&lsq["point"])), turned(numbers(&lsq["normal"])));
                off.push(("height", dot(std::array::from_fn(|k| at[k] - point[k]), normal)));
                off.push(("tilt over 40 mm", 40.0 * (1.0 - dot(normal, way).abs()).max(0.0).sqrt()));
            }
            "sphere" => {
                let (a, b) = (numbers(&own["center"]), moved(numbers(&lsq["center"])));
                off.push(("center", off_axis(a, b, [0.0; 3])));
            }
            kind => {
                let key = if kind == "cone" { "apex" } else { "point" };
                let (point, way) = (numbers(&own[key]), numbers(&own["direction"]));
                let (at, direction) = (moved(numbers(&lsq[key])), turned(numbers(&lsq["direction"])));
                for t in [-9.0, 9.0] {
                    let end = std::array::from_fn(|k| at[k] + t * direction[k]);
                    off.push(("axis", off_axis(end, point, way)));
                }
            }
        }
        for (what, off) in off {
            println!("{id}: {what} off by {off:.5}");
            assert!(off.abs() <= NEAR, "{id}: {what} off by {off}");
        }
    }
}

#[test]
fn the_example_reports_what_it_found() {
    let folder = Folder::new();
    let html = folder.file("report.html");
    let plan = corpus("examples/plate/plate.toml");
    let words = ["inspect", plan.to_str().unwrap(), "--html", html.to_str().unwrap(), "--json"];
    let json = folder.file("r.json");
    let o = trueness(words.into_iter().chain([json.to_str().unwrap()]));
    let answer: Value = serde_json::from_str(&std::fs::read_to_string(&json).unwrap()).unwrap();
    let verdict = answer["verdict"].as_str().unwrap();
    assert_eq!(status(&o), i32::from(verdict != "pass"), "{}", stderr(&o));
    let page = std::fs::read_to_string(&html).unwrap();
    for c in answer["characteristics"].as_array().unwrap() {
        assert!(!c["value"].is_null(), "{c}");
        let row = format!("title=\"{0}\">{0}</bdi>", c["id"].as_str().unwrap());
        assert!(page.contains(&row), "{row}");
        assert!(page.contains(&format!("data-t=\"kind.{}\"", c["kind"].as_str().unwrap())));
    }
}

/// The same bytes on any number of threads.
#[test]
fn threads_do_not_change_the_answer() {
    let plan = corpus("examples/plate/plate.toml");
    let run = |threads: &str| {
        let o = trueness(["inspect", plan.to_str().unwrap(), "--threads", threads, "--json", "-"]);
        String::from_utf8(o.stdout).unwrap()
    };
    let one = run("1");
    assert!(one.contains("\"schema\": \"trueness/inspect/1\""), "{one}");
    assert!(one == run("3"));
}

/// The example's plan with a best fit of the scan.
fn best_fitted(folder: &Folder) -> std::path::PathBuf {
    let example = corpus("examples/plate");
    let text = std::fs::read_to_string(example.join("plate.toml")).unwrap();
    let (before, after) = text.split_once("method = \"given\"").unwrap();
    let after = after.split_once("[[feature]]").unwrap().1;
    let at = |name: &str| format!("'{}'", example.join(name).display());
    let plan = format!("{before}method = \"best-fit\"\n[[feature]]{after}")
        .replace("\"scan.stl\"", &at("scan.stl"))
        .replace("\"nominal.stl\"", &at("nominal.stl"));
    folder.write("plan.toml", plan)
}

/// Values within `tolerance` of each other, and the same verdicts.
fn same_values(found: &Value, wanted: &Value, tolerance: f64) {
    let all = |of: &Value| of["characteristics"].as_array().unwrap().clone();
    assert_eq!(all(found).len(), all(wanted).len());
    for (a, b) in all(found).iter().zip(&all(wanted)) {
        let (Some(x), Some(y)) = (a["value"].as_f64(), b["value"].as_f64()) else { panic!("{a} and {b}") };
        assert!((x - y).abs() < tolerance, "{}: {x} and {y}", a["id"]);
        assert_eq!(a["verdict"], b["verdict"]);
    }
}

/// Aligned by best fit from the scanner's pose, the same features are found, and values that do not lean on the model's
/// place are the same.
#[test]
fn the_best_fit_finds_the_same_features() {
    let folder = Folder::new();
    let found = document(["inspect", best_fitted(&folder).to_str().unwrap()]);
    let given = document(["inspect", corpus("examples/plate").join("plate.toml").to_str().unwrap()]);
    assert_eq!(found["alignment"]["method"], "best-fit");
    assert_eq!(found["alignment"]["converged"], true);
    assert!(found["alignment"]["rms"].as_f64().unwrap() < 0.02, "{}", found["alignment"]);
    same_values(&found, &given, 2e-3);
}

/// Facets that point inward are turned round, for the features too: its bores were measured and its planes were not.
#[test]
fn a_scan_turned_inside_out_has_the_same_features() {
    let folder = Folder::new();
    let plan = best_fitted(&folder);
    let mut scan = std::fs::read(corpus("examples/plate").join("scan.stl")).unwrap();
    // Binary STL: after 84 bytes 50 of each facet, its normal, three corners of 12 bytes, two more.
    for facet in scan[84..].chunks_exact_mut(50) {
        let [b, c]: [[u8; 12]; 2] = [24, 36].map(|at| facet[at..at + 12].try_into().unwrap());
        facet[24..36].copy_from_slice(&c);
        facet[36..48].copy_from_slice(&b);
    }
    let scan = folder.write("inward.stl", scan);
    let own = document(["inspect", plan.to_str().unwrap()]);
    let found = document(["inspect".as_ref(), plan.as_os_str(), "--measured".as_ref(), scan.as_os_str()]);
    assert_eq!(found["alignment"]["warnings"][0]["kind"], "normals_turned");
    // Vertices are numbered otherwise, and large faces are placed by some of them: a point at an edge may go to the other face.
    same_values(&found, &own, 2e-4);
}

/// The example's plan with the model itself as the measured part and another alignment.
fn of_the_model(folder: &Folder, align: &str) -> std::path::PathBuf {
    let example = corpus("examples/plate");
    let text = std::fs::read_to_string(example.join("plate.toml")).unwrap();
    let (before, after) = text.split_once("[align]").unwrap();
    let after = after.split_once("[[feature]]").unwrap().1;
    let model = format!("'{}'", example.join("nominal.stl").display());
    let plan = format!("{before}[align]\n{align}\n[[feature]]{after}")
        .replace("\"scan.stl\"", &model)
        .replace("\"nominal.stl\"", &model)
        // All vertices of the model lie on its edges.
        .replace("rim = false", "rim = true");
    folder.write("plan.toml", plan)
}

/// Greatest difference of a 4×4 from another.
fn apart(found: &Value, wanted: [[f64; 4]; 4]) -> f64 {
    let at = |i: usize, j: usize| found[i][j].as_f64().unwrap();
    let cells = (0..4).flat_map(|i| (0..4).map(move |j| (i, j)));
    cells.fold(0.0, |m: f64, (i, j)| m.max((at(i, j) - wanted[i][j]).abs()))
}

const IDENTITY: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// The model lies on itself by its datums, wherever it starts nearby.
#[test]
fn datums_bring_the_model_onto_itself() {
    let folder = Folder::new();
    let turned = "transform = [[1, -0.0005, 0, 0.02], [0.0005, 1, 0, -0.03], [0, 0, 1, 0.05], [0, 0, 0, 1]]";
    for start in [turned, ""] {
        let align = format!("method = \"datum\"\ndatums = [\"A\", \"B\", \"C\"]\n{start}");
        let found = document(["inspect", of_the_model(&folder, &align).to_str().unwrap()]);
        assert_eq!(found["alignment"]["method"], "datum");
        // The file holds single precision, and its bores are polygons.
        let off = apart(&found["alignment"]["transform"], IDENTITY);
        assert!(off < 2e-5, "{off}: {}", found["alignment"]);
    }
    let minimum = "method = \"datum\"\ndatums = [\"A\", \"B\", \"C\"]\ndatum_method = \"minimum-zone\"";
    let found = document(["inspect", of_the_model(&folder, minimum).to_str().unwrap()]);
    assert!(apart(&found["alignment"]["transform"], IDENTITY) < 2e-5, "{}", found["alignment"]);
}

/// Pairs and reference points give the motion that made them.
#[test]
fn pairs_and_reference_points_bring_the_part_back() {
    // A quarter turn about z and a shift: reference from measured.
    let motion = [[0.0, -1.0, 0.0, 5.0], [1.0, 0.0, 0.0, -7.0], [0.0, 0.0, 1.0, 2.0], [0.0, 0.0, 0.0, 1.0]];
    let back = |[x, y, z]: [f64; 3]| [y + 7.0, 5.0 - x, z - 2.0];
    let places = [
        ([0.0, 0.0, 0.0], [0, 0, 1]),
        ([80.0, 0.0, 0.0], [0, 0, 1]),
        ([0.0, 50.0, 0.0], [0, 0, 1]),
        ([10.0, 0.0, 8.0], [0, 1, 0]),
        ([70.0, 0.0, 8.0], [0, 1, 0]),
        ([0.0, 25.0, 8.0], [1, 0, 0]),
    ];
    let folder = Folder::new();
    for method in ["pairs", "rps"] {
        let point = |(nominal, direction): &([f64; 3], [i32; 3])| {
            let held = if method == "rps" { format!(", direction = {direction:?}") } else { String::new() };
            format!("{{ measured = {:?}, nominal = {nominal:?}{held} }}", back(*nominal))
        };
        let points: Vec<String> = places.iter().map(point).collect();
        let align = format!("method = \"{method}\"\npoints = [{}]", points.join(", "));
        let found = document(["inspect", of_the_model(&folder, &align).to_str().unwrap()]);
        assert!(apart(&found["alignment"]["transform"], motion) < 1e-12, "{}", found["alignment"]);
        assert_eq!(found["alignment"]["residuals"].as_array().unwrap().len(), 6);
        assert!(found["alignment"]["rms"].as_f64().unwrap() < 1e-12);
    }
}

/// Features by a place on the reference are those by their written nominals.
#[test]
fn seeds_find_the_features_of_the_model() {
    let seeds = [
        ("A", "[60, 5, 0]"),
        ("top", "[35, 5, 17]"),
        ("B", "[24.1, 16.5, 8]"),
        ("C", "[19.6, 41.25, 8]"),
        ("boss", "[56.15, 27.5, 25]"),
        ("boss end", "[45.65, 27.5, 35]"),
        ("cone", "[73.4, 16.5, 22]"),
        ("pocket", "[66.4, 41.25, 13]"),
    ];
    let example = corpus("examples/plate");
    let mut text = std::fs::read_to_string(example.join("plate.toml")).unwrap();
    for (id, seed) in seeds {
        let start = text.find(&format!("id = \"{id}\"")).unwrap();
        let from = start + text[start..].find("nominal = {").unwrap();
        let to = from + text[from..].find('\n').unwrap();
        text.replace_range(from..to, &format!("seed = {seed}"));
    }
    let at = |name: &str| format!("'{}'", example.join(name).display());
    let plan = text.replace("\"scan.stl\"", &at("scan.stl")).replace("\"nominal.stl\"", &at("nominal.stl"));
    let folder = Folder::new();
    let plan_file = folder.write("plan.toml", &plan);
    let found = document(["inspect", plan_file.to_str().unwrap()]);
    let given = document(["inspect", example.join("plate.toml").to_str().unwrap()]);
    for (a, b) in
        found["characteristics"].as_array().unwrap().iter().zip(given["characteristics"].as_array().unwrap())
    {
        let (x, y) = (a["value"].as_f64().unwrap(), b["value"].as_f64().unwrap());
        assert!((x - y).abs() < 2e-3, "{}: {x} and {y}", a["id"]);
        assert_eq!(a["verdict"], b["verdict"], "{}", a["id"]);
    }
    for (id, _) in seeds {
        let feature = found["features"].as_array().unwrap().iter().find(|f| f["id"] == id).unwrap();
        assert_eq!(feature["source"], "seed");
        // Of the vertices at the edges of the scan some are of neither face.
        assert!(feature["coverage"].as_f64().unwrap() > 0.75, "{feature}");
    }
    // What is not there is told with its place.
    let wrong = folder.write("plan.toml", plan.replace("seed = [24.1, 16.5, 8]", "seed = [35, 5, 17]"));
    let o = trueness(["inspect", wrong.to_str().unwrap()]);
    assert_eq!(status(&o), 3);
    let says = "feature \"B\": the reference has a plane at the seed, not a cylinder";
    assert!(stderr(&o).contains(says), "{}", stderr(&o));
    // A seed in another unit or frame, of a feature and of a region: how far off it is, and what is nearest.
    let far = "the seed is 8.000 mm from the reference; give a place on it (the nearest is 60, 5, 0 mm)";
    let wrong = plan.replace("seed = [60, 5, 0]", "seed = [60, 5, -8]");
    let region =
        "[deviation]\n[[deviation.region]]\nid = \"r\"\nseed = [60, 5, -8]\ntolerance = 1\n[[feature]]";
    for wrong in [wrong, plan.replacen("[[feature]]", region, 1)] {
        let wrong = folder.write("plan.toml", wrong);
        let o = trueness(["inspect", wrong.to_str().unwrap()]);
        assert!(status(&o) == 3 && stderr(&o).contains(far), "{}", stderr(&o));
    }
}

/// A plan proposed from the model measures every feature of the scan, in whatever pose that is, and edges that the scanner
/// rounded are no part of a form.
#[test]
fn a_proposed_plan_measures_every_feature() {
    let (plate, folder) = (corpus("examples/plate"), Folder::new());
    let plan = folder.0.join("plan.toml");
    let [nominal, scan] = ["nominal.stl", "scan.stl"].map(|name| plate.join(name));
    let made =
        trueness(["plan".as_ref(), "init".as_ref(), nominal.as_os_str(), "--out".as_ref(), plan.as_os_str()]);
    assert_eq!(status(&made), 0, "{}", stderr(&made));
    // Of the model, as it was drawn: which way its bores and its boss face, and its sizes without the rounding of single precision.
    let text = std::fs::read_to_string(&plan).unwrap();
    let count = |line: &str| text.lines().filter(|l| *l == line).count();
    assert_eq!([count("internal = true"), count("internal = false")], [3, 2], "{text}");
    let sizes: Vec<&str> = text.lines().filter_map(|l| l.strip_prefix("nominal = ")).collect();
    let sizes: Vec<&str> = sizes.into_iter().filter(|s| !s.starts_with('{')).collect();
    assert!(!sizes.is_empty() && sizes.iter().all(|s| s.len() <= "12.345".len()), "{sizes:?}");
    let answer = document(["inspect".as_ref(), plan.as_os_str(), "--measured".as_ref(), scan.as_os_str()]);
    let all = answer["characteristics"].as_array().unwrap();
    assert!(all.len() > 10, "{}", all.len());
    for c in all {
        assert_ne!(c["verdict"], "not_measured", "{c}");
        if ["flatness", "cylindricity"].iter().any(|kind| c["kind"] == *kind) {
            assert!(c["value"].as_f64().unwrap() < 0.03, "{c}");
        }
    }
}

/// A scan in meters lies nowhere near the part: that is said, and not only that nothing was measured.
#[test]
fn a_scan_of_another_unit_is_doubted() {
    let (plate, folder) = (corpus("examples/plate"), Folder::new());
    let point = |k: u32| format!("{} {} {}\n", f64::from(k % 10) * 0.01, f64::from(k / 10) * 0.01, 0.15);
    let scan = folder.write("metres.xyz", (0..100).map(point).collect::<String>());
    let plan = plate.join("plate.toml");
    let answer = document(["inspect".as_ref(), plan.as_os_str(), "--measured".as_ref(), scan.as_os_str()]);
    let kinds: Vec<&str> = answer["alignment"]["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|w| w["kind"].as_str().unwrap())
        .collect();
    assert!(kinds.contains(&"hardly_overlapping"), "{kinds:?}");
    // In the lists too, with the reason.
    let (junit, csv) = (folder.file("parts.xml"), folder.file("parts.csv"));
    let words = ["inspect".as_ref(), plan.as_os_str(), "--measured".as_ref(), scan.as_os_str()];
    let more = ["--junit".as_ref(), junit.as_os_str(), "--csv".as_ref(), csv.as_os_str()];
    assert_eq!(status(&trueness(words.iter().chain(&more))), 1);
    let [junit, csv] = [junit, csv].map(|path| std::fs::read_to_string(path).unwrap());
    assert!(junit.contains("name=\"alignment\"><error message=\"undecided: "), "{junit}");
    assert!(csv.lines().any(|l| l.contains(",alignment,alignment,") && l.contains(",undecided,")), "{csv}");
    let own = document(["inspect", plan.to_str().unwrap()]);
    assert_eq!(own["alignment"]["warnings"], serde_json::json!([]));
}

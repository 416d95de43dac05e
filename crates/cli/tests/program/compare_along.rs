//! `trueness compare --along`: deviations along lines, with what they do not meet.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stderr, stdout, trueness};
use serde_json::Value;
use std::path::Path;

fn word(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A roof: two faces that rise at 3 : 4 from x = ±40 to the ridge x = 0 at z = 30, over y from 0 to 50; open below.
const ROOF: &str =
    "OFF\n6 4 0\n-40 0 0\n-40 50 0\n0 0 30\n0 50 30\n40 0 0\n40 50 0\n3 0 2 1\n3 1 2 3\n3 2 4 3\n3 3 4 5\n";

/// Points over the roof at height `h` along z, below where `h` is negative, each with a normal across the face; then three beside it.
fn over(h: impl Fn(usize) -> f64) -> Vec<[f64; 6]> {
    let point = |k: usize| {
        let x = -36.0 + (k % 10) as f64 * 8.0;
        let side = if x < 0.0 { -1.0 } else { 1.0 };
        [x, 4.0 + (k / 10) as f64 * 4.0, 30.0 - 0.75 * x.abs() + h(k), 0.6 * side, 0.0, 0.8]
    };
    let beside = [
        [41.0, 25.0, 2.0, 0.0, 0.0, 1.0],
        [0.5, 51.0, 29.0, 0.0, 1.0, 0.0],
        [5.0, 25.0, 28.0, 0.0, 0.0, 0.0],
    ];
    (0..100).map(point).chain(beside).collect()
}

fn csv(points: &[[f64; 6]]) -> String {
    let row = |p: &[f64; 6]| p.map(|x| x.to_string()).join(",") + "\n";
    "x,y,z,nx,ny,nz\n".to_string() + &points.iter().map(row).collect::<String>()
}

fn height(k: usize) -> f64 {
    if k.is_multiple_of(3) { -0.5 } else { 0.25 }
}

fn numbers(c: &Value) -> [f64; 3] {
    ["min", "max", "mean"].map(|k| c["deviation"]["all"][k].as_f64().unwrap())
}

#[test]
fn along_a_direction_and_along_normals_in_closed_form() {
    let folder = Folder::new();
    let (roof, scan) = (folder.write("roof.off", ROOF), folder.write("scan.csv", csv(&over(height))));
    let ask = |along: &'static str, more: &[&'static str]| {
        let words = ["compare", word(&scan), word(&roof), "--along", along, "--max-distance", "5"];
        document(words.iter().copied().chain(more.iter().copied()))["comparisons"][0].clone()
    };
    // Along z the heights themselves; of the three beside it one is met: the one without a normal, 1.75 above its face.
    let up = ask("0,0,1", &[]);
    let mean = ((0..100).map(height).sum::<f64>() + 1.75) / 101.0;
    for (found, want) in numbers(&up).into_iter().zip([-0.5, 1.75, mean]) {
        assert!((found - want).abs() < 1e-12, "{found} {want}");
    }
    let excluded = |c: &Value| c["excluded"].clone();
    assert_eq!(excluded(&up), serde_json::json!({"free_edge": 0, "max_distance": 0, "no_crossing": 2}));
    assert_eq!(up["along"], serde_json::json!({"kind": "direction", "direction": [0.0, 0.0, 1.0]}));
    // Across the faces they are 0.8 of that, by the normals of either; the scan's ends where it has none.
    let own = ask("measured", &[]);
    for (found, want) in
        numbers(&own).into_iter().zip([-0.4, 0.2, 0.8 * (0..100).map(height).sum::<f64>() / 100.0])
    {
        assert!((found - want).abs() < 1e-12, "{found} {want}");
    }
    assert_eq!(excluded(&own)["no_direction"], 1);
    assert_eq!(excluded(&own)["no_crossing"], 2);
    let reference = ask("reference", &[]);
    assert!((numbers(&reference)[0] + 0.4).abs() < 1e-12);
    assert_eq!(
        (&reference["along"]["kind"], &reference["excluded"]["no_direction"]),
        (&"reference".into(), &0.into())
    );
    // Along x the one beside it that looks up meets a face that does not, and so does the one without a normal.
    assert_eq!(ask("1,0,0", &["--facing", "1"])["excluded"]["facing"], 2);
    // The worst place lies along the line, not at the nearest place.
    let worst = &up["worst"][0];
    assert_eq!((worst["deviation"].as_f64(), worst["nearest"][0].as_f64()), (Some(1.75), Some(5.0)));
}

#[test]
fn lines_that_meet_nothing_are_told_everywhere() {
    let folder = Folder::new();
    let (roof, scan) = (folder.write("roof.off", ROOF), folder.write("scan.csv", csv(&over(height))));
    let [out, html] = ["d.csv", "r.html"].map(|n| folder.file(n));
    let words = ["compare", word(&scan), word(&roof), "--along", "0,0,1", "--out", word(&out), "--html"];
    let shown = stdout(&trueness(words.iter().chain([&word(&html), &"-v"])));
    assert!(shown.contains("the direction 0, 0, 1, to the nearest crossing"), "{shown}");
    assert!(shown.contains("2 points (no crossing: the line meets nothing near enough)"), "{shown}");
    let text = std::fs::read_to_string(&out).unwrap();
    let codes: Vec<&str> = text.lines().skip(1).map(|l| l.rsplit(',').next().unwrap()).collect();
    assert_eq!((codes[99], &codes[100..]), ("0", &["5", "5", "0"][..]));
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(page.contains("Measured along") && page.contains("the line meets nothing near enough"));
    // All that goes with lines, and what does not.
    let says = |words: &[&str]| {
        let o = trueness([&["compare", word(&scan), word(&roof)], words].concat());
        (status(&o), stderr(&o))
    };
    for (words, part) in [
        (&["--along", "0,0,0"][..], "a direction is three numbers, not all 0"),
        (&["--along", "up"], "write a direction as in 0,0,1"),
        (&["--along", "0,0,1", "--method", "paper"], "--along measures along lines"),
        (&["--normals", "4,5,6"], "--normals is for --facing and --along measured"),
    ] {
        let (status, text) = says(words);
        assert!(status == 2 && text.contains(part), "{words:?}: {status} {text}");
    }
    let none = folder.write("bare.xyz", "0 0 0\n1 1 1\n");
    let o = trueness(["compare", word(&none), word(&roof), "--along", "measured"]);
    assert!(status(&o) == 3 && stderr(&o).contains("--along measured needs the normals"), "{}", stderr(&o));
}

#[test]
fn a_plan_measures_along_lines_as_a_comparison_does() {
    let folder = Folder::new();
    let roof = folder.write("roof.off", ROOF);
    let scan = folder.write("scan.csv", csv(&over(height)));
    let head =
        "schema = \"trueness/plan/1\"\nmeasured = \"scan.csv\"\nreference = \"roof.off\"\n[deviation]\n";
    let plan = |rest: &str| {
        let plan =
            folder.write("plan.toml", format!("{head}tolerance = [-0.45, 0.45]\nmax_distance = 5\n{rest}"));
        let json = folder.file("r.json");
        let o = trueness(["inspect", word(&plan), "--json", word(&json)]);
        let text = std::fs::read_to_string(&json).unwrap_or_default();
        (status(&o), stdout(&o) + &stderr(&o), serde_json::from_str::<Value>(&text).unwrap_or_default())
    };
    for (in_plan, word_of) in
        [("[0, 0, 1]", "0,0,1"), ("\"reference\"", "reference"), ("\"measured\"", "measured")]
    {
        let (_, table, found) = plan(&format!("along = {in_plan}\n"));
        let words = [
            "compare",
            word(&scan),
            word(&roof),
            "--along",
            word_of,
            "--max-distance",
            "5",
            "--tolerance",
            "0.45",
        ];
        let compared = &document(words)["comparisons"][0];
        for key in ["deviation", "along", "excluded", "tolerance", "worst", "verdict"] {
            assert!(
                !found["deviation"][key].is_null() && found["deviation"][key] == compared[key],
                "{word_of} {key}"
            );
        }
        assert!(table.contains("  along ") && table.contains("no crossing"), "{table}");
    }
    for bad in ["[0, 0, 0]", "\"up\"", "[1, 2]", "3"] {
        let (code, said, _) = plan(&format!("along = {bad}\n"));
        assert!(code == 3 && said.contains("line 7, column 9"), "{bad}: {said}");
    }
}

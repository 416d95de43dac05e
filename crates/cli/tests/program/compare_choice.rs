//! `trueness compare --facing`, `--outliers` and `--coverage`: which points count, and what they do not cover.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stderr, stdout, trueness};
use serde_json::Value;
use std::path::Path;

fn word(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A plate of 100 × 60 × 2 mm with its lower corner in the origin, outward.
const PLATE: &str = "OFF\n8 12 0\n0 0 0\n100 0 0\n0 60 0\n100 60 0\n0 0 2\n100 0 2\n0 60 2\n100 60 2\n\
3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n";

/// A point over the plate's upper side: x, y, z and a normal leaning so many degrees to the side.
fn leaning(k: usize, height: f64, degrees: f64) -> [f64; 6] {
    let (x, y, a) = (5.0 + (k % 30) as f64 * 3.0, 5.0 + (k / 30) as f64 * 3.0, degrees.to_radians());
    [x, y, 2.0 + height, a.sin(), 0.0, a.cos()]
}

/// 100 points 0.1 above the upper side that look up or lean by 29°, 20 that lean by 31°, 30 of the far wall, which lie 0.5 under
/// the upper side and look down, and one whose normal is zero.
fn two_walls() -> Vec<[f64; 6]> {
    let up = (0..100).map(|k| leaning(k, 0.1, if k % 2 == 0 { 0.0 } else { 29.0 }));
    let leans = (100..120).map(|k| leaning(k, 0.1, 31.0));
    let down = (120..150).map(|k| leaning(k, -0.5, 180.0));
    up.chain(leans).chain(down).chain([[50.0, 30.0, 2.1, 0.0, 0.0, 0.0]]).collect()
}

fn rows(points: &[[f64; 6]], head: &str, separator: &str) -> String {
    let row = |p: &[f64; 6]| p.map(|x| x.to_string()).join(separator) + "\n";
    head.to_string() + &points.iter().map(row).collect::<String>()
}

fn counted(answer: &Value) -> (u64, u64) {
    let c = &answer["comparisons"][0];
    (c["deviation"]["all"]["count"].as_u64().unwrap(), c["excluded"]["facing"].as_u64().unwrap())
}

#[test]
fn only_places_that_look_the_same_way_from_every_kind_of_file() {
    let folder = Folder::new();
    let (plate, points) = (folder.write("plate.off", PLATE), two_walls());
    let ply = "ply\nformat ascii 1.0\nelement vertex 151\nproperty double x\nproperty double y\nproperty double z\n\
               property double nx\nproperty double ny\nproperty double nz\nend_header\n";
    let mut binary = ply.replace("ascii", "binary_little_endian").into_bytes();
    binary.extend(points.iter().flatten().flat_map(|x| x.to_le_bytes()));
    let plain = rows(&points, "", " ");
    let files = [
        folder.write("a.csv", rows(&points, "x,y,z,nx,ny,nz\n", ",")),
        folder.write("b.xyzn", &plain),
        folder.write("c.ply", rows(&points, ply, " ")),
        folder.write("d.ply", binary),
        folder.write("e.xyz", &plain),
    ];
    for (k, file) in files.iter().enumerate() {
        let more: &[&str] = if k == 4 { &["--normals", "4,5,6"] } else { &[] };
        let with = |degrees: &'static str| {
            let words = ["compare", word(file), word(&plate), "--facing", degrees];
            document(words.iter().chain(more))
        };
        let answer = with("30");
        assert_eq!(counted(&answer), (100, 51), "{file:?}");
        assert!((answer["facing"].as_f64().unwrap() - 30f64.to_radians()).abs() < 1e-15);
        let mean = answer["comparisons"][0]["deviation"]["all"]["mean"].as_f64().unwrap();
        assert!((mean - 0.1).abs() < 1e-12, "the far wall counts: {mean}");
        assert_eq!(counted(&with("28")), (50, 101));
        assert_eq!(counted(&with("32")), (120, 31));
        // All but the point without a normal.
        assert_eq!(counted(&with("180")), (150, 1));
    }
    let all = document(["compare", word(&files[0]), word(&plate)]);
    assert_eq!(all["comparisons"][0]["deviation"]["all"]["count"], 151);
    assert!(all["comparisons"][0]["excluded"].get("facing").is_none() && all.get("facing").is_none());
}

#[test]
fn what_looks_away_is_told_everywhere() {
    let folder = Folder::new();
    let plate = folder.write("plate.off", PLATE);
    let scan = folder.write("scan.csv", rows(&two_walls(), "x,y,z,nx,ny,nz\n", ","));
    let [out, html] = ["d.csv", "r.html"].map(|n| folder.file(n));
    let words = ["compare", word(&scan), word(&plate), "--facing", "30", "--out", word(&out), "--html"];
    let shown = stdout(&trueness(words.iter().chain([&word(&html), &"-v"])));
    let told = "51 points (facing: more than 30° from the reference's normal)";
    assert!(shown.contains(told), "{shown}");
    let lines: Vec<String> = std::fs::read_to_string(&out).unwrap().lines().map(str::to_string).collect();
    assert_eq!(lines[0], "x,y,z,deviation,excluded");
    for (k, line) in lines[1..].iter().enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[4], if k < 100 { "0" } else { "3" }, "{k}: {line}");
        assert_eq!(cells[3].is_empty(), k >= 100);
    }
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(page.contains("normal turned away") && page.contains("Only normals within"));
    // Nothing left is no number, and no pass.
    let turned = folder.write("turned.csv", rows(&two_walls()[120..150], "x,y,z,nx,ny,nz\n", ","));
    let words = ["compare", word(&turned), word(&plate), "--facing", "30", "--tolerance", "1"];
    let o = trueness(words);
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    assert_eq!(document(words)["verdict"], "undecided");
}

#[test]
fn a_mesh_has_normals_of_its_own_and_they_move_with_it() {
    let folder = Folder::new();
    let plate = folder.write("plate.off", PLATE);
    // The plate against itself: samples on its sides agree to 1°, and so they do when it is found from another pose.
    let words = ["compare", word(&plate), word(&plate), "--sample", "3000", "--facing", "1"];
    assert_eq!(counted(&document(words)), (3000, 0));
    // Vertices at corners look along the diagonals, 54.7° from each side.
    let corners =
        |degrees: &str| counted(&document(["compare", word(&plate), word(&plate), "--facing", degrees]));
    assert_eq!((corners("54"), corners("55")), ((0, 8), (8, 0)));
    // An angle bracket, which has one pose only, and samples of it with normals, turned by 50° about z.
    let bracket = "OFF\n8 12 0\n0 0 0\n80 0 0\n10 30 0\n70 50 0\n0 0 20\n80 0 35\n10 30 25\n70 50 10\n\
        3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n";
    let bracket = folder.write("bracket.off", bracket);
    let numbers: Vec<f64> = bracket_samples(&bracket, &folder);
    let (c, s) = (50f64.to_radians().cos(), 50f64.to_radians().sin());
    let turn = |v: &[f64]| [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]];
    let points: Vec<[f64; 6]> = (numbers.chunks_exact(6))
        .map(|p| {
            let ([x, y, z], [u, v, w]) = (turn(&p[..3]), turn(&p[3..]));
            [x + 7.0, y - 3.0, z + 1.0, u, v, w]
        })
        .collect();
    let scan = folder.write("scan.csv", rows(&points, "x,y,z,nx,ny,nz\n", ","));
    let answer = document(["compare", word(&scan), word(&bracket), "--align", "--facing", "5"]);
    let (count, away) = counted(&answer);
    assert_eq!(count + away, points.len() as u64);
    assert!(away <= 2, "{away} of {} look away although the scan was turned back", points.len());
}

/// Places on the facets of a mesh, away from their edges, with the facet's normal: six numbers each.
fn bracket_samples(mesh: &Path, _: &Folder) -> Vec<f64> {
    let text = std::fs::read_to_string(mesh).unwrap();
    let numbers = |line: &str| line.split(' ').map(|w| w.parse::<f64>().unwrap()).collect::<Vec<f64>>();
    let lines: Vec<&str> = text.lines().collect();
    let positions: Vec<Vec<f64>> = lines[2..10].iter().map(|l| numbers(l)).collect();
    let mut out = vec![];
    for face in &lines[10..] {
        let [a, b, d] = [1, 2, 3].map(|k| &positions[numbers(face)[k] as usize]);
        let [u, v] = [b, d].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        for i in 1..12 {
            for j in 1..(12 - i) {
                let (s, t) = (f64::from(i) / 12.0, f64::from(j) / 12.0);
                out.extend((0..3).map(|k| a[k] + s * u[k] + t * v[k]));
                out.extend(n);
            }
        }
    }
    out
}

#[test]
fn without_normals_the_question_cannot_be_answered() {
    let folder = Folder::new();
    let plate = folder.write("plate.off", PLATE);
    let bare: String = (0..9).map(|k| format!("{} 5 2.25\n", 3.5 + f64::from(k))).collect();
    let ply = "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    let files = [
        (folder.write("bare.xyz", &bare), "bare.xyz"),
        (folder.write("bare.ply", ply.to_string() + &bare), "\"nx\""),
        (folder.write("bare.obj", "v 1 2 3\nv 4 5 6\nv 5 5 9\n"), "no normals are read"),
    ];
    for (file, part) in files {
        let o = trueness(["compare", word(&file), word(&plate), "--facing", "30"]);
        let text = stderr(&o);
        assert_eq!(status(&o), 3, "{text}");
        assert!(text.contains("--facing needs the normals of the points") && text.contains(part), "{text}");
    }
    let bare = folder.file("bare.xyz");
    for (words, part) in [
        (["--facing", "0"], "no angle between normals"),
        (["--facing", "200"], "no angle between normals"),
        (["--normals", "4,5,6"], "--facing"),
        (["--outliers", "iqr"], "mad:5"),
        (["--outliers", "mad:-1"], "a number above 0"),
        (["--coverage", "0"], "no reach"),
    ] {
        let o = trueness(["compare", word(&bare), word(&plate)].into_iter().chain(words));
        assert_eq!(status(&o), 2, "{words:?}");
        assert!(stderr(&o).contains(part), "{}", stderr(&o));
    }
}

/// 997 points within ±0.05 over the plate and 3 wild ones, with their deviations.
fn wild() -> (String, Vec<f64>) {
    let noise = |k: usize| 0.05 * (k as f64 * 0.7).sin() + 0.003 * (k as f64 * 2.9).cos();
    let wild = [(100, 0.9), (500, -0.8), (700, 0.31)];
    let deviation = |k: usize| wild.iter().find(|w| w.0 == k).map_or(noise(k), |w| w.1);
    let all: Vec<f64> = (0..1000).map(deviation).collect();
    let row = |(k, d): (usize, &f64)| {
        format!("{} {} {}\n", 3.0 + (k % 40) as f64 * 2.3, 3.0 + (k / 40) as f64 * 2.1, 2.0 + d)
    };
    (all.iter().enumerate().map(row).collect(), all)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    0.5 * (values[(values.len() - 1) / 2] + values[values.len() / 2])
}

#[test]
fn outliers_are_left_out_by_their_rule_and_kept_in_the_file() {
    let folder = Folder::new();
    let plate = folder.write("plate.off", PLATE);
    let (text, all) = wild();
    let scan = folder.write("scan.xyz", text);
    let center = median(all.clone());
    let spread = 1.4826022185056018 * median(all.iter().map(|d| (d - center).abs()).collect());
    let mean = all.iter().sum::<f64>() / 1000.0;
    let sigma = (all.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / 999.0).sqrt();
    for (rule, center, reach) in [("mad:5", center, 5.0 * spread), ("3sigma", mean, 3.0 * sigma)] {
        let out = folder.file("d.csv");
        // The scan is of the upper side alone, and is meant to be.
        let meant = ["--tolerance", "0.2", "--min-coverage", "0"];
        let words = [&["compare", word(&scan), word(&plate), "--outliers", rule][..], &meant].concat();
        let shown = stdout(&trueness(words.iter().chain([&"--out", &word(&out), &"-v"])));
        let answer = document(words);
        let (c, within) = (&answer["comparisons"][0], |d: &f64| (d - center).abs() <= reach);
        let kept: Vec<f64> = all.iter().copied().filter(within).collect();
        let left_out = 1000 - kept.len() as u64;
        assert_eq!(left_out, 3, "{rule}");
        let o = &c["outliers"];
        let near = |key: &str, value: f64| {
            let found = o[key].as_f64().unwrap();
            assert!((found - value).abs() < 1e-12, "{rule} {key}: {found} against {value}");
        };
        near("center", center);
        near("lower", center - reach);
        near("upper", center + reach);
        assert_eq!(
            (&o["rule"], &o["count"], &c["excluded"]["outlier"]),
            (&rule.into(), &3.into(), &3.into())
        );
        assert!(
            shown.contains(&format!("{rule}: 3 points beyond")) && shown.contains("3 points (outlier)"),
            "{shown}"
        );
        // The statistics, the shares and the worst places are those of the points that count.
        let s = &c["deviation"]["all"];
        assert_eq!(s["count"], 997);
        let rms = (kept.iter().map(|d| d * d).sum::<f64>() / 997.0).sqrt();
        assert!((s["rms"].as_f64().unwrap() - rms).abs() < 1e-12);
        assert_eq!((&c["verdict"], &c["tolerance"]["inside"]), (&"pass".into(), &1.0.into()));
        let worst = c["worst"].as_array().unwrap();
        assert!(worst.iter().all(|w| within(&w["deviation"].as_f64().unwrap())));
        // In the file they keep their deviation, beside the reason.
        let rows = std::fs::read_to_string(&out).unwrap();
        for (k, line) in rows.lines().skip(1).enumerate() {
            let cells: Vec<&str> = line.split(',').collect();
            let d: f64 = cells[3].parse().unwrap();
            assert!((d - all[k]).abs() < 1e-12, "{line}");
            assert_eq!(cells[4], if within(&all[k]) { "0" } else { "4" }, "{line}");
            // With a tolerance there are colors, and that of an outlier is that of no value.
            let gray = cells[5..8] == ["154", "160", "166"];
            assert_eq!(gray, !within(&all[k]), "{line}");
        }
    }
    // Without the rule the wild ones count and fail.
    let plain = document(["compare", word(&scan), word(&plate), "--tolerance", "0.2"]);
    assert_eq!(plain["comparisons"][0]["deviation"]["all"]["count"], 1000);
    assert_eq!(plain["verdict"], "fail");
    assert!(plain["comparisons"][0].get("outliers").is_none());
}

#[test]
fn equal_deviations_have_no_outliers() {
    let folder = Folder::new();
    let plate = folder.write("plate.off", PLATE);
    let level: String = (0..40).map(|k| format!("{} 5 2.25\n", 3.5 + f64::from(k))).collect();
    let scan = folder.write("level.xyz", level + "50 30 3\n");
    let answer = document(["compare", word(&scan), word(&plate), "--outliers", "mad:5"]);
    let c = &answer["comparisons"][0];
    assert_eq!((&c["excluded"]["outlier"], &c["outliers"]["lower"]), (&0.into(), &Value::Null));
    assert!(c["outliers"]["limits_reason"].as_str().unwrap().contains("the MAD of the deviations is 0"));
    assert_eq!(c["deviation"]["all"]["count"], 41);
}

#[test]
fn what_no_point_covers_in_closed_form() {
    let folder = Folder::new();
    let plate = folder.write("plate.off", PLATE);
    // The upper side up to x = 60, every 0.5 mm.
    let row =
        |k: usize| format!("{} {} 2.01\n", 0.25 + (k % 120) as f64 * 0.5, 0.25 + (k / 120) as f64 * 0.5);
    let scan = folder.write("scan.xyz", (0..120 * 120).map(row).collect::<String>());
    let covered = |more: &[&str]| {
        let words = ["compare", word(&scan), word(&plate)];
        document(words.iter().chain(more))["comparisons"][0]["coverage"].clone()
    };
    let number = |c: &Value, key: &str| c[key].as_f64().unwrap();
    let whole = 2.0 * (100.0 * 60.0 + 100.0 * 2.0 + 60.0 * 2.0);
    for more in [&["--coverage", "auto"][..], &["--coverage", "1"], &["--coverage", "4"]] {
        let c = covered(more);
        assert!((number(&c, "area") - whole).abs() < 1e-9 * whole, "{c}");
        // All other sides, and the upper one from 60, less what the points reach over, more a piece that is partly covered.
        let (found, reach) = (number(&c, "uncovered"), number(&c, "reach"));
        let least = whole - 60.0 * (60.0 + reach);
        let most = whole - 60.0 * (60.0 - reach);
        assert!((least..=most).contains(&found), "{more:?}: {found} not in {least} … {most}");
        assert!((number(&c, "uncovered_share") - found / whole).abs() < 1e-12);
        assert!((0.3..0.8).contains(&number(&c, "spacing")), "{c}");
    }
    assert!(
        number(&covered(&["--coverage", "4"]), "uncovered")
            < number(&covered(&["--coverage", "1"]), "uncovered")
    );
    assert!(covered(&[]).is_null());
    // The report's map is the one that is counted, in table, document and page alike.
    let (html, json) = (folder.file("r.html"), folder.file("r.json"));
    let words = ["compare", word(&scan), word(&plate), "--html", word(&html), "--json", word(&json), "-v"];
    let shown = stdout(&trueness(words));
    let from_report: Value = serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap();
    let c = &from_report["comparisons"][0]["coverage"];
    assert_eq!(*c, covered(&["--coverage", "auto"]));
    let percent = format!("{:.3} % of the reference", 100.0 * number(c, "uncovered_share"));
    assert!(shown.contains(&percent), "{percent}: {shown}");
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(
        page.contains("Not covered")
            && page.contains(&format!("{:.2}", 100.0 * number(c, "uncovered_share")))
    );
    // Points that do not count cover nothing.
    let none = covered(&["--coverage", "auto", "--max-distance", "0.001"]);
    assert_eq!(number(&none, "uncovered_share"), 1.0);
}

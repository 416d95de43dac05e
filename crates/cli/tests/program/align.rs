//! `trueness align` as users run it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{CUBE, Folder, corpus, document, status, stderr, stdout, trueness};
use serde_json::Value;
use trueness_geom::rigid::Rigid;

/// A mesh in OFF: vertices and the lines of its faces.
struct Off {
    points: Vec<[f64; 3]>,
    faces: Vec<String>,
}

/// A wedge without symmetry, of few facets.
fn wedge() -> Off {
    let points = vec![
        [0.0, 0.0, 0.0],
        [60.0, 0.0, 0.0],
        [0.0, 35.0, 0.0],
        [60.0, 25.0, 0.0],
        [0.0, 0.0, 12.0],
        [52.0, 0.0, 20.0],
        [0.0, 35.0, 12.0],
        [60.0, 25.0, 15.0],
    ];
    let faces = CUBE.lines().filter(|l| l.starts_with("3 ")).map(str::to_string).collect();
    Off { points, faces }
}

impl Off {
    fn text(&self, motion: &Rigid) -> String {
        let point = |p: &[f64; 3]| {
            let q = motion.point(*p);
            format!("{} {} {}\n", q[0], q[1], q[2])
        };
        let points: String = self.points.iter().map(point).collect();
        format!("OFF\n{} {} 0\n{points}{}\n", self.points.len(), self.faces.len(), self.faces.join("\n"))
    }
}

fn motion() -> Rigid {
    Rigid::translation_by([120.0, -40.0, 7.0]).after(&Rigid::rotation_about([0.0; 3], [1.2, -0.7, 1.9]))
}

fn transform(document: &Value) -> Rigid {
    Rigid::from_matrix(serde_json::from_value(document["transform"].clone()).unwrap()).unwrap()
}

#[test]
fn the_document_takes_the_scan_to_the_reference_and_the_file_lies_there() {
    let folder = Folder::new();
    let (part, pose) = (wedge(), motion());
    let scan = folder.write("scan.off", part.text(&pose));
    let nominal = folder.write("nominal.off", part.text(&Rigid::IDENTITY));
    let out = folder.file("aligned.ply");
    let words = ["align", scan.to_str().unwrap(), nominal.to_str().unwrap(), "-o", out.to_str().unwrap()];
    let found = document(words);
    assert_eq!(
        (found["schema"].as_str(), found["method"].as_str()),
        (Some("trueness/align/1"), Some("best-fit"))
    );
    assert_eq!((found["converged"].as_bool(), found["degrees_of_freedom"].as_u64()), (Some(true), Some(6)));
    let off = transform(&found).after(&pose);
    assert!(off.angle() < 1e-9 && off.displacement([30.0, 15.0, 5.0]) < 1e-8, "{found}");
    assert!(found["rms"].as_f64().unwrap() < 1e-9 && found["mean_abs"].as_f64().unwrap() < 1e-9);
    // What was written lies on the reference as it is.
    let compared = document(["compare", out.to_str().unwrap(), nominal.to_str().unwrap()]);
    assert!(compared["comparisons"][0]["deviation"]["all"]["rms"].as_f64().unwrap() < 1e-5);
    let table = trueness(words);
    assert!(stdout(&table).contains("reference from measured by best-fit, mm"), "{}", stdout(&table));
    assert_eq!(status(&table), 0, "{}", stdout(&table));
}

#[test]
fn compare_aligns_first() {
    let folder = Folder::new();
    let part = wedge();
    let scan = folder.write("scan.off", part.text(&motion()));
    let nominal = folder.write("nominal.off", part.text(&Rigid::IDENTITY));
    let words = ["compare", scan.to_str().unwrap(), nominal.to_str().unwrap(), "--tolerance", "0.001"];
    assert_eq!(status(&trueness(words)), 1);
    let found = document(words.into_iter().chain(["--align"]));
    assert_eq!(found["verdict"], "pass");
    assert!(transform(&found["alignment"]).after(&motion()).angle() < 1e-9);
    assert!(stdout(&trueness(words.into_iter().chain(["--align"]))).contains("best fit to"));
}

#[test]
fn what_looks_the_same_in_several_ways_has_status_1() {
    let folder = Folder::new();
    let cube = folder.write("cube.off", CUBE);
    let again = folder.write("again.off", CUBE);
    let answer = trueness(["align", cube.to_str().unwrap(), again.to_str().unwrap()]);
    assert_eq!(status(&answer), 1, "{}{}", stdout(&answer), stderr(&answer));
    assert!(stdout(&answer).contains("the part looks the same in several ways"), "{}", stdout(&answer));
}

#[test]
fn tables_of_places_give_the_motion() {
    let folder = Folder::new();
    let (part, pose) = (wedge(), motion());
    let scan = folder.write("scan.off", part.text(&pose));
    let nominal = folder.write("nominal.off", part.text(&Rigid::IDENTITY));
    let row = |p: &[f64; 3], more: &str| {
        let q = pose.point(*p);
        format!("{},{},{},{},{},{}{more}\n", q[0], q[1], q[2], p[0], p[1], p[2])
    };
    let pairs: String = part.points[..4].iter().map(|p| row(p, "")).collect();
    let pairs = folder.write("pairs.csv", format!("mx,my,mz,x,y,z\n{pairs}"));
    let held = [(0, "0,0,1"), (1, "0,0,1"), (2, "0,0,1"), (0, "0,1,0"), (1, "0,1,0"), (4, "1,0,0")];
    let rows: String = held.iter().map(|(i, d)| row(&part.points[*i], &format!(",{d}"))).collect();
    let rows = folder.write("rows.csv", rows);
    for (method, file) in [("pairs", &pairs), ("3-2-1", &rows), ("rps", &rows)] {
        let words = [
            "align",
            scan.to_str().unwrap(),
            nominal.to_str().unwrap(),
            "--method",
            method,
            "--points",
            file.to_str().unwrap(),
        ];
        let found = document(words);
        assert_eq!(found["method"], method);
        assert!(transform(&found).after(&pose).angle() < 1e-12, "{method}");
        assert!(found["pairs"].as_array().unwrap().len() >= 4);
    }
}

/// Pairs of a mirror image, and one pair that is wrong: the result cannot be relied on, and the worst row is named.
#[test]
fn pairs_that_do_not_match_are_told() {
    let folder = Folder::new();
    let part = wedge();
    let scan = folder.write("scan.off", part.text(&Rigid::IDENTITY));
    let row = |p: &[f64; 3], q: [f64; 3]| format!("{} {} {} {} {} {}\n", p[0], p[1], p[2], q[0], q[1], q[2]);
    let image: String = part.points.iter().map(|p| row(p, [p[0], p[1], -p[2]])).collect();
    let wrong = |n: usize, p: &[f64; 3]| row(p, if n == 2 { [p[0], p[1] + 30.0, p[2]] } else { *p });
    let one: String = part.points.iter().enumerate().map(|(n, p)| wrong(n, p)).collect();
    let said = |rows: String| {
        let table = folder.write("pairs.txt", rows);
        let [scan, table] = [&scan, &table].map(|p| p.to_str().unwrap());
        let words = ["align", scan, scan, "--method", "pairs", "--points", table];
        let o = trueness(words);
        assert_eq!((status(&o), stderr(&o).as_str()), (1, ""), "{}", stdout(&o));
        let found = document(words);
        assert_eq!(found["warnings"][0]["kind"], "poor");
        let text = found["warnings"][0]["text"].as_str().unwrap().to_string();
        assert!(stdout(&o).contains(&format!("! {text}\n")), "{}", stdout(&o));
        text
    };
    let mirrored = said(image);
    assert!(mirrored.contains("they look mirrored"), "{mirrored}");
    let wrong = said(one);
    assert!(wrong.contains(", row 3 the most, by 2") && wrong.contains("do not belong together"), "{wrong}");
}

#[test]
fn wrong_questions_are_answered_with_the_place_and_the_remedy() {
    let folder = Folder::new();
    let part = wedge();
    let scan = folder.write("scan.off", part.text(&motion()));
    let nominal = folder.write("nominal.off", part.text(&Rigid::IDENTITY));
    let cloud = corpus("reference_fits/cylinder_exact_60.xyz");
    let bad = folder.write("bad.csv", "1,2,3,4,5,6\n1,2,3,4,5\n");
    let letters = folder.write("letters.csv", "1,2,3,4,5,6\n1,2,x,4,5,6\n");
    let (scan, nominal, cloud) = (scan.to_str().unwrap(), nominal.to_str().unwrap(), cloud.to_str().unwrap());
    let (bad, letters) = (bad.to_str().unwrap(), letters.to_str().unwrap());
    for (words, expected, text) in [
        (vec!["align", scan, cloud], 3, "a reference must be a mesh"),
        (vec!["align", scan, nominal, "--method", "pairs"], 2, "--points"),
        (vec!["align", scan, nominal, "--points", bad], 2, "--method"),
        (vec!["align", scan, nominal, "--method", "pairs", "--points", bad], 3, "row 2 has 5 numbers"),
        (vec!["align", scan, nominal, "--method", "pairs", "--points", letters], 3, "line 2"),
        (vec!["align", scan, nominal, "-o", scan], 2, "would overwrite the input"),
        (vec!["align", scan, nominal, "-o", "nowhere.xyz"], 2, ".stl"),
        (vec!["align", "missing.stl", nominal], 3, "missing.stl"),
    ] {
        let answer = trueness(&words);
        assert_eq!(status(&answer), expected, "{words:?}: {}", stderr(&answer));
        assert!(stderr(&answer).contains(text), "{words:?}: {}", stderr(&answer));
    }
}

/// A single bump of 0.3 at the middle of a side: half of it is left on either side, told everywhere; as an outlier it does not count.
#[test]
fn the_least_greatest_distance() {
    let folder = Folder::new();
    let corner = |k: usize| [[-10.0, 10.0], [-6.0, 6.0], [-4.0, 4.0]].map(|r: [f64; 2]| r[k]);
    let places: Vec<String> = (0..8)
        .map(|i| format!("{} {} {}", corner(i & 1)[0], corner(i >> 1 & 1)[1], corner(i >> 2)[2]))
        .collect();
    let block = format!(
        "OFF\n8 12 0\n{}\n3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n",
        places.join("\n")
    );
    let block = folder.write("block.off", block);
    let mut points = String::from("10.3 0 0\n");
    for i in -9..=9 {
        for j in -5..=5 {
            for s in [-1, 1] {
                points += &format!(
                    "{i} {j} {}\n{i} {} {}\n{} {j} {}\n",
                    4 * s,
                    6 * s,
                    f64::from(j) * 0.6,
                    10 * s,
                    f64::from(i) * 0.3
                );
            }
        }
    }
    let scan = folder.write("scan.xyz", points);
    let json = folder.file("r.json");
    let [scan, block, json] = [&scan, &block, &json].map(|p| p.to_str().unwrap());
    let words = ["align", scan, block, "--from-here", "--method", "chebyshev", "--json", json];
    let run = |more: &[&str]| {
        let o = trueness(words.iter().chain(more));
        let text = std::fs::read_to_string(json).unwrap();
        (stdout(&o) + &stderr(&o), serde_json::from_str::<serde_json::Value>(&text).unwrap())
    };
    let (table, found) = run(&["--keep-outliers"]);
    assert_eq!(found["method"], "chebyshev");
    let greatest = found["chebyshev"]["greatest"].as_f64().unwrap();
    assert!((greatest - 0.15).abs() < 1e-9, "{greatest}");
    assert!((found["transform"][0][3].as_f64().unwrap() + 0.15).abs() < 1e-6, "{}", found["transform"]);
    assert!(table.contains("by chebyshev") && table.contains("greatest distance 0.15"), "{table}");
    let (_, found) = run(&[]);
    // Of a block of 25 mm across corners what is 0.3 off is clutter, and told.
    assert!(found["chebyshev"]["greatest"].as_f64().unwrap() < 1e-9 && found["chebyshev"]["left_out"] == 1);
    assert!((found["chebyshev"]["left_out_farthest"].as_f64().unwrap() - 0.3).abs() < 1e-9);
    assert_eq!(found["warnings"][0]["kind"], "left_out");
}

/// Into zones: the block's top may be 0 to 0.2 too high, all else 0.1 either way; a perfect block rises by 0.05 and has as much left.
#[test]
fn the_least_greatest_excess_over_tolerances() {
    let folder = Folder::new();
    let corner = |i: u32| {
        [if i & 1 == 1 { 10 } else { -10 }, if i & 2 == 2 { 6 } else { -6 }, if i & 4 == 4 { 4 } else { -4 }]
    };
    let places: Vec<String> = (0..8).map(corner).map(|[x, y, z]| format!("{x} {y} {z}")).collect();
    let block = format!(
        "OFF\n8 12 0\n{}\n3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n",
        places.join("\n")
    );
    let block = folder.write("block.off", block);
    let mut points = String::new();
    for (i, j) in (-9..=9).flat_map(|i| (-5..=5).map(move |j| (f64::from(i), f64::from(j)))) {
        for s in [-1, 1] {
            points += &format!("{i} {j} {}\n{i} {} {}\n{} {j} {}\n", 4 * s, 6 * s, j * 0.6, 10 * s, i * 0.3);
        }
    }
    let scan = folder.write("scan.xyz", points);
    let top = "[[region]]\nid = \"top\"\nbetween = [[-20, -20, 3.99], [20, 20, 5]]\ntolerance = [0, 0.2]\n";
    let (regions, json) = (folder.write("top.toml", top), folder.file("r.json"));
    let [scan, block, regions, json] = [&scan, &block, &regions, &json].map(|p| p.to_str().unwrap());
    let words = ["align", scan, block, "--from-here", "--method", "zones"];
    let o = trueness(words.iter().chain(&["--regions", regions, "--tolerance", "0.1", "--json", json]));
    assert_eq!(status(&o), 0, "{}{}", stdout(&o), stderr(&o));
    let read = || serde_json::from_str::<serde_json::Value>(&std::fs::read_to_string(json).unwrap()).unwrap();
    let found = read();
    let excess = found["zones"]["excess"].as_f64().unwrap();
    assert!((excess + 0.05).abs() < 1e-9, "{excess}");
    assert!((found["transform"][2][3].as_f64().unwrap() - 0.05).abs() < 1e-6, "{}", found["transform"]);
    assert_eq!((found["method"].as_str(), found["zones"]["without_zone"].as_u64()), (Some("zones"), Some(0)));
    assert!(stdout(&o).contains("all 1,254 points within, 0 at places"), "{}", stdout(&o));
    // What does not fit makes the exit status 1.
    folder.write("top.toml", top.replace("[0, 0.2]", "[0.3, 0.4]"));
    let o = trueness(words.iter().chain(&["--regions", regions, "--tolerance", "0.1", "--json", json]));
    assert_eq!(status(&o), 1, "{}", stdout(&o));
    assert!((read()["zones"]["excess"].as_f64().unwrap() - 0.1).abs() < 1e-9, "{}", read()["zones"]);
    // A dent that the best fit leaves out counts; clutter does not decide the pose, and not all are within.
    folder.write("top.toml", top);
    let plain = std::fs::read_to_string(scan).unwrap();
    let stand = |more: &str| {
        folder.write("scan.xyz", plain.clone() + more);
        let o = trueness(words.iter().chain(&["--tolerance", "0.1", "--json", json]));
        (status(&o), stdout(&o), read()["zones"].clone())
    };
    let (exit, table, found) = stand("0 5.76 0\n");
    assert!(exit == 1 && found["left_out"] == 0, "{table}{found}");
    // Half of it on either side.
    assert!((found["excess"].as_f64().unwrap() - 0.02).abs() < 1e-9, "{found}");
    let (exit, table, found) = stand("0 9 0\n");
    assert!(exit == 1 && found["beyond"] == 1 && found["left_out"] == 1, "{table}{found}");
    assert!((found["excess"].as_f64().unwrap() - 2.9).abs() < 1e-6, "{found}");
    assert!((found["least"].as_f64().unwrap() + 0.1).abs() < 1e-9, "{found}");
    assert!(
        table.contains("1 of 1,255 points beyond") && table.contains("! 1 point does not count"),
        "{table}"
    );
    // Nothing allowed, and something allowed for another method.
    assert_eq!(status(&trueness(words)), 2);
    assert_eq!(status(&trueness(["align", scan, block, "--tolerance", "0.1"])), 2);
}

#[test]
fn places_almost_on_a_line_are_told() {
    let folder = Folder::new();
    let part = wedge();
    let nominal = folder.write("nominal.off", part.text(&Rigid::IDENTITY));
    let rows = [
        "5 5 0 5 5 0 0 0 1",
        "55 5 0 55 5 0 0 0 1",
        "30 5.4 0 30 5.4 0 0 0 1",
        "5 0 5 5 0 5 0 1 0",
        "55 0 5 55 0 5 0 1 0",
        "0 25 5 0 25 5 1 0 0",
    ];
    let near = folder.write("near.txt", rows.join("\n"));
    let far = folder.write("far.txt", rows.join("\n").replace("5.4", "20"));
    let words = |rows: &std::path::Path| {
        let words = ["align", "NOMINAL", "NOMINAL", "--method", "3-2-1", "--points", "ROWS"];
        words.map(|w| w.replace("NOMINAL", nominal.to_str().unwrap()).replace("ROWS", rows.to_str().unwrap()))
    };
    let found = document(words(&near));
    // The box of the wedge ends at y = 35 and z = 20: 30 and 15 from the axis along x that the other rows leave.
    let known = (30.0_f64 * 30.0 + 15.0 * 15.0).sqrt() / 0.4;
    assert!((found["pairs"][2]["amplification"].as_f64().unwrap() - known).abs() < 1e-6, "{found}");
    assert_eq!(found["warnings"][0]["kind"], "amplified", "{found}");
    assert!(found["warnings"][0]["text"].as_str().unwrap().starts_with("row 3:"), "{found}");
    assert!(
        stdout(&trueness(words(&near))).contains("1 mm of error there moves the farthest corner by 83.85 mm")
    );
    assert_eq!(document(words(&far))["warnings"], serde_json::json!([]));
}

/// Points of the walls of the wedge, which lie along z, between two heights, moved up.
fn walls_of_a_block([low, high]: [f64; 2]) -> String {
    let mut text = String::new();
    for k in 0..1200 {
        let (side, along) = (k % 4, f64::from(k / 4) / 300.0);
        let z = low + (high - low) * (f64::from(k * 7 % 300) / 299.0);
        let [x, y] = [[60.0 * along, 0.0], [60.0, 35.0 * along], [60.0 * along, 35.0], [0.0, 35.0 * along]]
            [side as usize];
        // The third wall is cut off, so that no half turn fits as well.
        if side != 2 || x < 25.0 {
            text += &format!("{x} {y} {z}\n");
        }
    }
    text
}

#[test]
fn walls_alone_leave_their_height_free() {
    let folder = Folder::new();
    let block = Off {
        points: (0..8)
            .map(|k| [60.0 * f64::from(k % 2), 35.0 * f64::from(k / 2 % 2), 12.0 * f64::from(k / 4)])
            .collect(),
        faces: CUBE.lines().filter(|l| l.starts_with("3 ")).map(str::to_string).collect(),
    };
    let nominal = folder.write("nominal.off", block.text(&Rigid::IDENTITY));
    // A band that ends at a rim, and one in between.
    for (heights, more) in [([9.0, 12.0], 0.0), ([3.0, 6.0], 0.0), ([3.0, 6.0], 20.0)] {
        let points = walls_of_a_block([heights[0] + more, heights[1] + more]);
        let scan = folder.write("scan.xyz", points);
        let words =
            ["align", scan.to_str().unwrap(), nominal.to_str().unwrap(), "--from-here", "--keep-outliers"];
        let found = document(words);
        let motions = [&found["free"][0], &found["slack"][0]];
        assert!(motions.iter().any(|m| m["kind"] == "slides"), "{found}");
        assert_eq!(found["warnings"][0]["kind"], "undetermined", "{found}");
        let run = trueness(words);
        assert_eq!(status(&run), 1);
        // Of the translation the height alone is free in the table.
        let table = stdout(&run);
        let line = table.lines().find(|l| l.starts_with("standard uncertainty")).unwrap();
        let translation = line.split_once("translation").unwrap().1;
        assert!(translation.ends_with(" free mm") && translation.matches("free").count() == 1, "{line}");
        let motion = transform(&found);
        assert!(motion.angle() < 1e-4, "{found}");
        let z = motion.translation()[2];
        assert!(more > 0.0 || z.abs() < 2e-3, "{z}");
        assert!(heights[0] + more + z > -1e-3 && heights[1] + more + z < 12.0 + 1e-3, "{z}");
    }
    // What follows from such a pose is no verdict.
    let scan = folder.file("scan.xyz");
    let words =
        ["compare", scan.to_str().unwrap(), nominal.to_str().unwrap(), "--align", "--tolerance", "0.1"];
    let compared = document(words.into_iter().chain(["--min-coverage", "0"]));
    let found = &compared["comparisons"][0];
    assert_eq!(found["verdict"], "undecided", "{found}");
    assert_eq!(found["verdict_reasons"][0]["kind"], "alignment", "{found}");
}

#[test]
fn axes_are_locked_from_here() {
    let folder = Folder::new();
    let part = wedge();
    let pose = Rigid::translation_by([0.2, -0.1, 0.3]);
    let scan = folder.write("scan.off", part.text(&pose));
    let nominal = folder.write("nominal.off", part.text(&Rigid::IDENTITY));
    let words = ["align", scan.to_str().unwrap(), nominal.to_str().unwrap()];
    let found = document(words.into_iter().chain(["--from-here", "--lock", "tx,rx,ry,rz"]));
    let motion = transform(&found);
    assert!(motion.angle() < 1e-12 && motion.translation()[0].abs() < 1e-12, "{found}");
    assert_eq!(found["lock"]["axes"], serde_json::json!(["tx", "rx", "ry", "rz"]));
    assert_eq!(found["degrees_of_freedom"], 2);
    for (more, why) in [
        (vec!["--lock", "tz"], "--from-here"),
        (vec!["--from-here", "--lock", "tz", "--method", "chebyshev"], "--lock is for --method best-fit"),
        (vec!["--from-here", "--lock", "up"], "possible values: tx"),
    ] {
        let answer = trueness(words.into_iter().chain(more));
        assert_eq!(status(&answer), 2, "{why}");
        assert!(stderr(&answer).contains(why), "{why}: {}", stderr(&answer));
    }
}

#[test]
fn a_mirrored_part_is_named_and_has_status_1() {
    let folder = Folder::new();
    // Far from its own mirror image.
    let mut part = wedge();
    part.points[5][2] = 45.0;
    let mut other = wedge();
    other.points.clone_from(&part.points);
    other.points.iter_mut().for_each(|p| p[2] = -p[2]);
    for face in &mut other.faces {
        let words: Vec<String> = face.split_whitespace().map(str::to_string).collect();
        *face = format!("3 {} {} {}", words[1], words[3], words[2]);
    }
    let scan = folder.write("scan.off", other.text(&motion()));
    let nominal = folder.write("nominal.off", part.text(&Rigid::IDENTITY));
    let words = ["align", scan.to_str().unwrap(), nominal.to_str().unwrap()];
    let answer = trueness(words);
    assert_eq!(status(&answer), 1, "{}", stdout(&answer));
    assert!(stdout(&answer).contains("looks mirrored"), "{}", stdout(&answer));
}

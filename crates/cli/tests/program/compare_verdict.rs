//! The verdict of `trueness compare`: one value for document, table, page and exit status, by tolerance, alignment, coverage and
//! how much of the reference was read.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, status, stderr, stdout, trueness};
use serde_json::Value;
use std::fmt::Write;
use std::path::{Path, PathBuf};

type Point = [f64; 3];

/// An angle of 60 by 45, walls of 20 and 25, 15 high, which looks like itself in one pose only: its facets.
fn angle() -> Vec<[Point; 3]> {
    let rim = [[0.0, 0.0], [60.0, 0.0], [60.0, 20.0], [25.0, 20.0], [25.0, 45.0], [0.0, 45.0]];
    let at = |k: usize, z: f64| [rim[k % 6][0], rim[k % 6][1], z];
    // The corner between the walls sees all others.
    let fan = [[3, 4, 5], [3, 5, 0], [3, 0, 1], [3, 1, 2]];
    let mut all: Vec<[Point; 3]> = fan.iter().map(|f| f.map(|k| at(k, 15.0))).collect();
    all.extend(fan.iter().map(|[a, b, c]| [a, c, b].map(|k| at(*k, 0.0))));
    for k in 0..6 {
        let [a, b, c, d] = [at(k, 0.0), at(k + 1, 0.0), at(k + 1, 15.0), at(k, 15.0)];
        all.extend([[a, b, c], [a, c, d]]);
    }
    all
}

/// As text STL; with `more`, another facet that cannot be read.
fn stl(facets: &[[Point; 3]], more: bool) -> String {
    let mut text = String::from("solid angle\n");
    let mut facet = |corners: &[String]| {
        text += "facet normal 0 0 0\nouter loop\n";
        corners.iter().for_each(|c| writeln!(text, "vertex {c}").unwrap());
        text += "endloop\nendfacet\n";
    };
    for f in facets {
        facet(&f.map(|[x, y, z]| format!("{x} {y} {z}")));
    }
    if more {
        facet(&["0 0 0", "nan 0 0", "0 1 0"].map(String::from));
    }
    text + "endsolid angle\n"
}

/// Numbers from 0 to 1, always the same.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Places all over the facets, `n` by area, each with the outward normal.
fn places(facets: &[[Point; 3]], n: usize, numbers: &mut Numbers) -> Vec<(Point, Point)> {
    let normal =
        |[a, b, c]: &[Point; 3]| cross([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let length = |v: Point| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let whole: f64 = facets.iter().map(|f| length(normal(f))).sum();
    let (mut all, mut left) = (vec![], 0.0);
    for f in facets {
        let size = length(normal(f));
        left += size / whole * n as f64;
        let unit = normal(f).map(|x| x / size);
        while left >= 1.0 {
            left -= 1.0;
            let (mut u, mut v) = (numbers.next(), numbers.next());
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let place = [0, 1, 2].map(|k| f[0][k] + u * (f[1][k] - f[0][k]) + v * (f[2][k] - f[0][k]));
            all.push((place, unit));
        }
    }
    all
}

fn xyz(points: impl Iterator<Item = Point>) -> String {
    points.map(|[x, y, z]| format!("{x:.9} {y:.9} {z:.9}\n")).collect()
}

/// What a run says in each of the four places.
#[derive(Debug, PartialEq)]
struct Said {
    document: String,
    status: i32,
    table: String,
    page: String,
}

impl Said {
    fn of(verdict: &str) -> Said {
        let status = i32::from(verdict != "pass");
        Said { document: verdict.into(), status, table: verdict.into(), page: verdict.into() }
    }
}

/// Runs a comparison: what it says, the document and the table.
fn run(folder: &Folder, scan: &Path, reference: &Path, more: &[&str]) -> (Said, Value, String) {
    let [json, html] = ["r.json", "r.html"].map(|n| folder.file(n));
    let words: Vec<PathBuf> = ["compare".into(), scan.into(), reference.into()]
        .into_iter()
        .chain(["--json".into(), json.clone(), "--html".into(), html.clone()])
        .chain(more.iter().map(PathBuf::from))
        .collect();
    let o = trueness(&words);
    assert!(status(&o) <= 1, "{words:?}: {}", stderr(&o));
    let document: Value = serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap();
    let page = std::fs::read_to_string(&html).unwrap();
    let head = page.split("class=\"header h-").nth(1).unwrap();
    let table = stdout(&o);
    let line = table.lines().find_map(|l| l.strip_prefix("verdict")).unwrap_or("none").trim();
    let said = Said {
        document: document["verdict"].as_str().unwrap_or("none").into(),
        status: status(&o),
        table: line.split(':').next().unwrap().to_lowercase(),
        page: head.split('"').next().unwrap().into(),
    };
    assert!(table.lines().all(|l| l.chars().count() <= 100), "{table}");
    (said, document, table)
}

fn kinds(document: &Value) -> Vec<&str> {
    let reasons = document["verdict_reasons"].as_array();
    reasons.into_iter().flatten().map(|r| r["kind"].as_str().unwrap()).collect()
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Pose {
    AsItLies,
    Aligned,
    WrongUnit,
    OtherPart,
}

/// Points of a scan.
const POINTS: usize = 1600;

/// Every pose with every coverage, reference and deviation.
#[test]
fn document_status_table_and_page_say_the_same() {
    let folder = Folder::new();
    let facets = angle();
    let whole = folder.write("whole.stl", stl(&facets, false));
    let lacking = folder.write("lacking.stl", stl(&facets, true));
    let all = places(&facets, POINTS, &mut Numbers(7));
    let sphere = |k: usize| {
        let (z, turn) = (1.0 - 2.0 * (k as f64 + 0.5) / POINTS as f64, k as f64 * 2.399_963);
        let r = (1.0 - z * z).sqrt();
        [30.0 + 25.0 * r * turn.cos(), 20.0 + 25.0 * r * turn.sin(), 7.0 + 25.0 * z]
    };
    for pose in [Pose::AsItLies, Pose::Aligned, Pose::WrongUnit, Pose::OtherPart] {
        for part in [false, true] {
            for out in [false, true] {
                let place = |(k, (p, n)): (usize, &(Point, Point))| {
                    let off = if out && k % 40 == 0 { 0.5 } else { 0.0 };
                    let p = [0, 1, 2].map(|k| p[k] + off * n[k]);
                    match pose {
                        Pose::AsItLies => p,
                        // Turned by 0.3 about z and moved.
                        Pose::Aligned => {
                            let (s, c) = 0.3f64.sin_cos();
                            [c * p[0] - s * p[1] + 5.0, s * p[0] + c * p[1] - 3.0, p[2] + 1.0]
                        }
                        Pose::WrongUnit => p.map(|x| 0.001 * x),
                        Pose::OtherPart => sphere(k),
                    }
                };
                let kept = |(_, (p, _)): &(usize, &(Point, Point))| !part || p[0] < 40.0;
                let scan = folder.write("scan.xyz", xyz(all.iter().enumerate().filter(kept).map(place)));
                for (reference, complete) in [(&whole, true), (&lacking, false)] {
                    let aligned: &[&str] = if pose == Pose::AsItLies { &[] } else { &["--align"] };
                    let words = [&["--tolerance", "0.1"][..], aligned].concat();
                    let (said, document, table) = run(&folder, &scan, reference, &words);
                    let reliable = matches!(pose, Pose::AsItLies | Pose::Aligned);
                    let case = format!("{pose:?}, part {part}, out {out}, complete {complete}\n{table}");
                    let wanted = match (reliable && complete, out, part) {
                        (false, ..) => "undecided",
                        (true, true, _) => "fail",
                        (true, false, true) => "undecided",
                        (true, false, false) => "pass",
                    };
                    assert_eq!(said, Said::of(wanted), "{case}");
                    let why = kinds(&document);
                    // The alignment knows a wrong unit by the size of a whole scan; of a part it may know none, but the boxes tell.
                    let boxes = pose == Pose::WrongUnit && part && why.contains(&"size_ratio");
                    assert_eq!(why.contains(&"alignment") || boxes, !reliable, "{why:?} {case}");
                    assert_eq!(why.contains(&"incomplete_reference"), !complete, "{why:?} {case}");
                    if reliable && wanted == "undecided" {
                        assert_eq!(why.contains(&"coverage"), part, "{why:?} {case}");
                    }
                    assert_eq!(why.is_empty(), wanted == "pass", "{why:?} {case}");
                }
            }
        }
    }
}

#[test]
fn a_part_that_is_meant_passes_and_what_was_not_measured_does_not() {
    let folder = Folder::new();
    let facets = angle();
    let reference = folder.write("whole.stl", stl(&facets, false));
    let all = places(&facets, POINTS, &mut Numbers(7));
    let part = || all.iter().map(|p| p.0).filter(|p| p[0] < 12.0);
    let scan = folder.write("part.xyz", xyz(part()));
    let tolerance = ["--tolerance", "0.1"];
    let with = |more: &[&'static str]| [&tolerance[..], more].concat();
    let (said, document, table) = run(&folder, &scan, &reference, &tolerance);
    assert_eq!((said, kinds(&document)), (Said::of("undecided"), vec!["coverage"]));
    assert!(table.contains("a pass needs 90 %"), "{table}");
    let (said, ..) = run(&folder, &scan, &reference, &with(&["--min-coverage", "0"]));
    assert_eq!(said, Said::of("pass"));
    let (said, ..) = run(&folder, &scan, &reference, &with(&["--min-coverage", "15"]));
    assert_eq!(said, Said::of("pass"));
    // Nothing counts: there is nothing that could pass or fail.
    let off = folder.write("off.xyz", xyz(part().map(|p| p.map(|x| x + 0.05))));
    let none = ["--tolerance", "0.0005", "--min-coverage", "0", "--max-distance", "0.001"];
    let (said, document, _) = run(&folder, &off, &reference, &none);
    assert_eq!((said, kinds(&document)), (Said::of("undecided"), vec!["not_measured"]));
    // A tenth of the part looks by its box as if it were in another unit; its points tell that it is not.
    let small = folder.write("small.xyz", xyz(part().filter(|p| p[0] < 5.0 && p[1] < 5.0 && p[2] < 5.0)));
    let (said, document, table) = run(&folder, &small, &reference, &with(&["--min-coverage", "0"]));
    assert!(document["comparisons"][0]["warnings"][0]["kind"] == "size_ratio", "{table}");
    assert_eq!(said, Said::of("pass"), "{table}");
    // In meters without an alignment it lies somewhere near, within the tolerance.
    let meters = folder.write("meters.xyz", xyz(all.iter().map(|p| p.0.map(|x| 0.001 * x))));
    let (said, document, table) = run(&folder, &meters, &reference, &with(&["--min-coverage", "0"]));
    assert_eq!((said, kinds(&document)), (Said::of("undecided"), vec!["size_ratio"]), "{table}");
    for (share, what) in [
        ("101", "a share is from 0 to 100 percent"),
        ("-1", "--min-coverage -1"),
        ("0.9", "write 90 for 90 %"),
        ("1", "write 100 for 100 %"),
    ] {
        let words = ["compare", scan.to_str().unwrap(), reference.to_str().unwrap(), "--min-coverage", share];
        let o = trueness(words);
        assert!(status(&o) == 2 && stderr(&o).contains(what), "{}", stderr(&o));
    }
}

/// Random scans of a random part: how far the share told is from the true one, and whether the verdict follows it.
#[test]
fn covered_shares_of_random_parts_are_those_that_were_kept() {
    let folder = Folder::new();
    let facets = angle();
    let reference = folder.write("whole.stl", stl(&facets, false));
    let mut numbers = Numbers(11);
    let (mut worst, mut sum, cases) = (0.0f64, 0.0, 12);
    for case in 0..cases {
        let n = [1500, 6000, 90_000][case % 3];
        let all = places(&facets, n, &mut numbers);
        // A half space through a random place of the part.
        let normal = [0; 3].map(|_| numbers.next() - 0.5);
        let through = all[(numbers.next() * n as f64 * 0.999) as usize].0;
        let side = |p: &Point| (0..3).map(|k| (p[k] - through[k]) * normal[k]).sum::<f64>();
        let kept: Vec<Point> = all.iter().map(|p| p.0).filter(|p| side(p) <= 0.0).collect();
        let truth = kept.len() as f64 / all.len() as f64;
        if kept.len() < 100 {
            continue;
        }
        let scan = folder.write("scan.xyz", xyz(kept.into_iter()));
        let (said, document, table) = run(&folder, &scan, &reference, &["--tolerance", "0.1"]);
        let told = 1.0 - document["comparisons"][0]["coverage"]["uncovered_share"].as_f64().unwrap();
        assert!((0.0..=1.0).contains(&told), "{told}");
        (worst, sum) = (worst.max((told - truth).abs()), sum + told - truth);
        assert!(
            (told - truth).abs() < if n < 5000 { 0.12 } else { 0.06 },
            "{case}: {told} for {truth}\n{table}"
        );
        assert_eq!(said, Said::of(if told >= 0.9 { "pass" } else { "undecided" }), "{case}: {truth} {table}");
    }
    let mean = sum / cases as f64;
    assert!(
        worst < 0.12 && mean.abs() < 0.05,
        "error of the share: {worst:.4} at most, {mean:.4} in the mean"
    );
}

/// Of a part of 12 faces one is read.
#[test]
fn a_step_file_that_is_read_in_part_is_never_a_pass() {
    let folder = Folder::new();
    let mut model = String::from(
        "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n\
         #2=GLOBAL_UNIT_ASSIGNED_CONTEXT((#1));\n#3=CARTESIAN_POINT('',(0.,0.,0.));\n\
         #4=CARTESIAN_POINT('',(0.,10.,0.));\n#5=CARTESIAN_POINT('',(10.,0.,0.));\n#6=CARTESIAN_POINT('',(10.,10.,0.));\n\
         #7=B_SPLINE_SURFACE_WITH_KNOTS('',1,1,((#3,#4),(#5,#6)),.UNSPECIFIED.,.F.,.F.,.F.,(2,2),(2,2),(0.,1.),(0.,1.),\
         .UNSPECIFIED.);\n#8=ADVANCED_FACE('',(),#7,.F.);\n",
    );
    for k in 0..11 {
        writeln!(
            model,
            "#{}=PLANE('',#90);\n#{}=ADVANCED_FACE('',(),#{},.T.);",
            20 + 2 * k,
            21 + 2 * k,
            20 + 2 * k
        )
        .unwrap();
    }
    model += "#90=AXIS2_PLACEMENT_3D('',#3,$,$);\nENDSEC;\nEND-ISO-10303-21;\n";
    let reference = folder.write("part.stp", &model);
    let grid = |z: f64| (0..441).map(move |k| [f64::from(k % 21) * 0.5, f64::from(k / 21) * 0.5, z]);
    for z in [0.0, 1.0] {
        let scan = folder.write("scan.xyz", xyz(grid(z)));
        let (said, document, table) = run(&folder, &scan, &reference, &["--tolerance", "0.1"]);
        assert_eq!(
            (said, kinds(&document)),
            (Said::of("undecided"), vec!["incomplete_reference"]),
            "{table}"
        );
        assert!(table.contains("1 of 12 faces of the reference was read"), "{table}");
    }
    // All commands say the same of it.
    let o = trueness(["check", reference.to_str().unwrap()]);
    let told = "1 of 12 faces of the file was read; `trueness info` names the others";
    assert!(status(&o) == 1 && stdout(&o).contains(told), "{}{}", stdout(&o), stderr(&o));
    let none = folder.write("planes.stp", model.replace("#7,.F.);", "#20,.F.);"));
    let scan = folder.write("scan.xyz", xyz(grid(0.0)));
    for words in [vec!["plan", "init"], vec!["compare", scan.to_str().unwrap()]] {
        let o = trueness(words.iter().chain(&[none.to_str().unwrap()]));
        let told = "none of its faces can be read";
        assert!(status(&o) == 3 && stderr(&o).contains(told), "{}", stderr(&o));
    }
    // Whole it passes: surfaces are covered by the rule as facets are.
    let whole: String = model
        .lines()
        .filter(|l| !l.contains("PLANE") && !l.contains(".T."))
        .map(|l| format!("{l}\n"))
        .collect();
    let whole = folder.write("whole.stp", whole);
    let (said, _, table) = run(&folder, &scan, &whole, &["--tolerance", "0.1"]);
    assert_eq!(said, Said::of("pass"), "{table}");
    let half = folder.write("half.xyz", xyz(grid(0.0).filter(|p| p[0] < 4.0)));
    let (said, document, table) = run(&folder, &half, &whole, &["--tolerance", "0.1"]);
    assert_eq!((said, kinds(&document)), (Said::of("undecided"), vec!["coverage"]), "{table}");
}

#[test]
fn a_table_has_some_ten_lines_with_the_worst_places_and_all_with_verbose() {
    let folder = Folder::new();
    let facets = angle();
    let reference = folder.write("whole.stl", stl(&facets, false));
    let all = places(&facets, 3000, &mut Numbers(5));
    let [lower, upper] = [[13.0, 31.0, 14.98], [7.0, 41.0, 15.3]];
    let scan = folder.write("scan.xyz", xyz(all.iter().map(|p| p.0).chain([lower, upper])));
    let words = ["compare", scan.to_str().unwrap(), reference.to_str().unwrap(), "--tolerance", "0.1"];
    let table = stdout(&trueness(words));
    assert!(table.lines().count() <= 11, "{table}");
    for part in [
        "highest    +0.3000 mm at 7.0000, 41.0000, 15.3000",
        "lowest     −0.0200 mm at 13.0000, 31.0000, 14.9800",
        "covered    100 % of the reference",
        "verdict    FAIL: 0.03 % of the points are out of tolerance",
    ] {
        assert!(table.contains(part), "{part}\n{table}");
    }
    let full = stdout(&trueness(words.iter().chain(&["-v"])));
    assert!(full.contains("coefficient of variation") && full.contains("verdict    FAIL"), "{full}");
    // Heads of reports may begin with a minus sign.
    let html = folder.file("r.html");
    let head = ["--title", "-2", "--part", "-x", "--serial", "-7", "--operator", "-B"];
    let o = trueness(words.iter().chain(&["--html", html.to_str().unwrap()]).chain(&head));
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    assert!(std::fs::read_to_string(&html).unwrap().contains("-2"));
}

/// Measured meshes whose few vertices all lie on the part, with a facet from rim to rim where the part goes in: by their vertices alone they
/// would pass. Where the tolerance allows it, and where the mesh is the part, they do.
#[test]
fn a_mesh_that_is_off_between_its_vertices_does_not_pass() {
    let folder = Folder::new();
    let whole = angle();
    let reference = folder.write("whole.stl", stl(&whole, false));
    let at = |k: usize, z: f64| {
        let [x, y] = [[0.0, 0.0], [60.0, 0.0], [60.0, 20.0], [25.0, 45.0], [0.0, 45.0]][k % 5];
        [x, y, z]
    };
    let fan = [[0, 1, 2], [0, 2, 3], [0, 3, 4]];
    let mut hull: Vec<[Point; 3]> = fan.iter().map(|f| f.map(|k| at(k, 15.0))).collect();
    hull.extend(fan.iter().map(|[a, b, c]| [a, c, b].map(|k| at(*k, 0.0))));
    for k in 0..5 {
        let [a, b, c, d] = [at(k, 0.0), at(k + 1, 0.0), at(k + 1, 15.0), at(k, 15.0)];
        hull.extend([[a, b, c], [a, c, d]]);
    }
    let scan = folder.write("hull.stl", stl(&hull, false));
    let none = ["--tolerance", "0.1", "--min-coverage", "0"];
    let (said, document, table) = run(&folder, &scan, &reference, &none);
    assert_eq!((said, kinds(&document)), (Said::of("undecided"), vec!["between_vertices"]), "{table}");
    assert_eq!(document["comparisons"][0]["deviation"]["all"]["max"].as_f64(), Some(0.0));
    let found = &document["comparisons"][0]["between_vertices"];
    // The corner between the walls is as far from the facet across as this.
    let depth = 25.0 * 35.0 / f64::hypot(25.0, 35.0);
    let worst = found["deviation"].as_f64().unwrap();
    assert!(worst > 0.6 * depth && worst <= depth, "{worst} of {depth}");
    let (said, ..) = run(&folder, &scan, &reference, &["--tolerance", "25", "--min-coverage", "0"]);
    assert_eq!(said, Said::of("pass"));
    let (said, document, _) = run(&folder, &reference, &reference, &none);
    assert_eq!(said, Said::of("pass"));
    assert!(document["comparisons"][0]["between_vertices"].is_null());
}

/// What is covered, and with it the verdict, is the same with a page and without one, and however many places are named.
#[test]
fn a_page_changes_nothing() {
    let folder = Folder::new();
    let facets = angle();
    let reference = folder.write("whole.stl", stl(&facets, false));
    let mut numbers = Numbers(29);
    for n in [300, 2000] {
        let points = places(&facets, n, &mut numbers);
        let off =
            |(p, normal): &(Point, Point), t: f64| [0, 1, 2].map(|k| p[k] + 0.2 * (t - 0.5) * normal[k]);
        let noisy: Vec<Point> = points.iter().map(|p| off(p, numbers.next())).collect();
        let scan = folder.write("scan.xyz", xyz(noisy.into_iter()));
        for tolerance in ["0.05", "0.2"] {
            let (_, with, _) = run(&folder, &scan, &reference, &["--tolerance", tolerance, "--worst", "9"]);
            let json = folder.file("bare.json");
            let [scan, reference, json] = [&scan, &reference, &json].map(|p| p.to_str().unwrap());
            let o = trueness(["compare", scan, reference, "--tolerance", tolerance, "--json", json]);
            assert!(status(&o) <= 1, "{}", stderr(&o));
            let bare: Value = serde_json::from_slice(&std::fs::read(json).unwrap()).unwrap();
            let told = |d: &Value| (d["comparisons"][0]["coverage"].clone(), d["verdict_reasons"].clone());
            assert_eq!(told(&with), told(&bare));
        }
    }
}

/// Points that do not count because they are far away hide nothing: a limit on their distance lies beyond the tolerance.
#[test]
fn a_distance_within_the_tolerance_is_refused() {
    let folder = Folder::new();
    let reference = folder.write("whole.stl", stl(&angle(), false));
    let path = reference.to_str().unwrap();
    for (tolerance, distance, is_refused) in [
        ("0.1", "0.1", true),
        ("-0.1,+0.5", "0.2", true),
        ("0.1", "0.11", false),
        ("-0.1,+0.5", "0.6", false),
    ] {
        let o = trueness(["compare", path, path, "--tolerance", tolerance, "--max-distance", distance]);
        assert_eq!(status(&o), if is_refused { 2 } else { 0 }, "{}", stderr(&o));
        assert_eq!(stderr(&o).contains("give several times the tolerance"), is_refused);
    }
}

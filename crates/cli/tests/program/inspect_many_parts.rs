//! `trueness inspect` of several parts, of which some cannot be inspected.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, status, stderr, stdout, trueness};
use std::path::PathBuf;
use std::process::Output;

/// A block of 60 × 40 × `height`, its sides cut into squares of 2, as OFF; without its floor if `open`.
fn block(height: f64, open: bool) -> String {
    let size = [60.0, 40.0, height];
    let (mut vertices, mut faces) = (String::new(), String::new());
    let (mut count, mut facets) = (0, 0);
    for (axis, top) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
        if open && axis == 2 && !top {
            continue;
        }
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let [n, m] = [u, v].map(|k| (size[k] / 2.0).ceil() as usize);
        for (i, j) in (0..=n).flat_map(|i| (0..=m).map(move |j| (i, j))) {
            let mut p = [0.0; 3];
            p[axis] = if top { size[axis] } else { 0.0 };
            p[u] = size[u] * i as f64 / n as f64;
            p[v] = size[v] * j as f64 / m as f64;
            vertices += &format!("{} {} {}\n", p[0], p[1], p[2]);
        }
        let at = |i: usize, j: usize| count + i * (m + 1) + j;
        for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            for t in if top { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] } {
                faces += &format!("3 {} {} {}\n", t[0], t[1], t[2]);
                facets += 1;
            }
        }
        count += (n + 1) * (m + 1);
    }
    format!("OFF\n{count} {facets} 0\n{vertices}{faces}")
}

const PLAN: &str = r#"
schema = "trueness/plan/1"
title = "Block"
measured = "nominal.off"
reference = "nominal.off"
[align]
method = "datum"
datums = ["A", "B", "C"]
transform = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
[[feature]]
id = "A"
shape = "plane"
nominal = { point = [0, 0, 0], normal = [0, 0, -1], boundary = [[0, 0, 0], [60, 0, 0], [60, 40, 0], [0, 40, 0]] }
[[feature]]
id = "B"
shape = "plane"
nominal = { point = [0, 0, 0], normal = [-1, 0, 0], boundary = [[0, 0, 0], [0, 40, 0], [0, 40, 20], [0, 0, 20]] }
[[feature]]
id = "C"
shape = "plane"
nominal = { point = [0, 0, 0], normal = [0, -1, 0], boundary = [[0, 0, 0], [60, 0, 0], [60, 0, 20], [0, 0, 20]] }
[[feature]]
id = "T"
shape = "plane"
nominal = { point = [0, 0, 20], normal = [0, 0, 1], boundary = [[0, 0, 20], [60, 0, 20], [60, 40, 20], [0, 40, 20]] }
[[characteristic]]
id = "h"
kind = "distance"
feature = "T"
datums = ["A"]
nominal = 20
upper = 0.1
lower = -0.1
"#;

/// The plan with four parts: two sound ones, one without its first datum, one that is no mesh.
struct Run {
    folder: Folder,
    plan: PathBuf,
}

impl Run {
    fn new() -> Run {
        let folder = Folder::new();
        folder.write("nominal.off", block(20.0, false));
        folder.write("good.off", block(20.05, false));
        folder.write("low.off", block(19.8, false));
        folder.write("open.off", block(20.0, true));
        folder.write("words.off", "these are words\n");
        let plan = folder.write("plan.toml", PLAN);
        Run { folder, plan }
    }

    fn file(&self, name: &str) -> String {
        self.folder.file(name).to_str().unwrap().into()
    }

    /// Inspects these parts into all lists; the answer, CSV, JUnit and QIF.
    fn inspect(&self, parts: &[&str]) -> (Output, [String; 3]) {
        let lists = ["parts.csv", "parts.xml", "parts.qif"].map(|n| self.file(n));
        for list in &lists {
            std::fs::write(list, "of an earlier run").unwrap();
        }
        let mut words = vec!["inspect".to_string(), self.plan.to_str().unwrap().into()];
        for (option, list) in ["--csv", "--junit", "--qif"].iter().zip(&lists) {
            words.extend([option.to_string(), list.clone()]);
        }
        words.push("--measured".into());
        words.extend(parts.iter().map(|p| self.file(p)));
        let o = trueness(words);
        (o, lists.map(|list| std::fs::read_to_string(list).unwrap()))
    }
}

#[test]
fn one_bad_part_does_not_keep_the_others_from_their_results() {
    let run = Run::new();
    let (o, [csv, junit, qif]) = run.inspect(&["good.off", "open.off", "words.off", "none.off", "low.off"]);
    let told = stderr(&o);
    assert_eq!(status(&o), 3, "{told}");
    let of = |name: &str| run.file(name);
    let (open, words, none) = (of("open.off"), of("words.off"), of("none.off"));
    assert!(told.contains(&format!("{open}: the measured data cannot be aligned")), "{told}");
    assert!(told.contains("feature \"A\"") && told.contains(&words) && told.contains(&none), "{told}");
    assert!(!told.contains("plan.toml"), "{told}");
    let table = stdout(&o);
    for bad in [&open, &words, &none] {
        assert!(table.contains(&format!("! {bad}: not inspected\n")), "{table}");
    }
    // Two characteristics, three parts without results.
    let rows: Vec<&str> =
        csv.lines().filter(|l| l.starts_with("part,") || !l.contains(",feature,")).collect();
    assert_eq!(rows.len(), 6, "{csv}");
    assert!(
        rows[1].starts_with(&format!("{},h,distance", of("good.off"))) && rows[1].contains(",pass,"),
        "{csv}"
    );
    assert!(rows[2].starts_with(&format!("{open},part,part,,")), "{csv}");
    assert!(rows[2].contains(",not measured,") && rows[2].contains("cannot be aligned"), "{csv}");
    assert!(
        rows[5].starts_with(&format!("{},h,distance", of("low.off"))) && rows[5].contains(",fail,"),
        "{csv}"
    );
    assert!(rows[3].starts_with(&words) && rows[4].starts_with(&none), "{csv}");
    assert!(junit.contains("<testsuites tests=\"5\" failures=\"1\" errors=\"3\">"), "{junit}");
    assert_eq!(junit.matches("<testsuite name=").count(), 5, "{junit}");
    let suite = junit.split(&format!("<testsuite name=\"{open}\"")).nth(1).unwrap();
    assert!(suite.starts_with(" tests=\"1\" failures=\"0\" errors=\"1\">\n    <testcase"), "{junit}");
    assert!(
        suite.contains("<error message=\"not inspected: ") && suite.contains("cannot be aligned"),
        "{junit}"
    );
    assert_eq!(qif.matches("<MeasurementResults ").count(), 5, "{qif}");
    assert_eq!(qif.matches("name=\"not_inspected\"").count(), 3, "{qif}");
    assert_eq!(qif.matches("<DistanceBetweenCharacteristicMeasurement").count(), 2, "{qif}");
}

/// One part: the lists say so too, and the message names the part.
#[test]
fn a_single_bad_part_is_named() {
    let run = Run::new();
    for (bad, says) in [("open.off", "cannot be aligned"), ("words.off", "words.off")] {
        let (o, [csv, junit, qif]) = run.inspect(&[bad]);
        assert_eq!((status(&o), stdout(&o).as_str()), (3, ""), "{}", stderr(&o));
        assert!(stderr(&o).contains(&run.file(bad)) && stderr(&o).contains(says), "{}", stderr(&o));
        assert!(csv.lines().count() == 2 && csv.contains(says), "{csv}");
        assert!(junit.contains("tests=\"1\" failures=\"0\" errors=\"1\"") && junit.contains(says), "{junit}");
        assert!(qif.contains("not_inspected") && qif.contains("NOT_MEASURED"), "{qif}");
    }
    // The plan's own part, too.
    let nominal = run.file("nominal.off");
    std::fs::copy(run.file("open.off"), &nominal).unwrap();
    let o = trueness(["inspect".as_ref(), run.plan.as_os_str()]);
    assert_eq!(status(&o), 3, "{}", stderr(&o));
    assert!(
        stderr(&o).contains(&format!("{nominal}: the measured data cannot be aligned")),
        "{}",
        stderr(&o)
    );
}

/// What is the same for every part stops the run, and nothing is written.
#[test]
fn a_fault_of_the_plan_stops_at_once() {
    let run = Run::new();
    let of_lists = |says: &str| {
        let (o, lists) = run.inspect(&["good.off", "open.off"]);
        assert_eq!((status(&o), stdout(&o).as_str()), (3, ""), "{}", stderr(&o));
        assert!(stderr(&o).contains(says) && stderr(&o).contains("plan.toml"), "{}", stderr(&o));
        assert!(lists.iter().all(|text| text == "of an earlier run"), "{lists:?}");
    };
    std::fs::write(&run.plan, PLAN.replacen("[\"A\", \"B\", \"C\"]", "[\"A\", \"T\", \"C\"]", 1)).unwrap();
    of_lists("holds nothing that the datums before it leave free");
    std::fs::write(&run.plan, PLAN.replacen("reference = \"nominal", "reference = \"none", 1)).unwrap();
    of_lists("the reference");
    let places = "points = [{ measured = [0, 0, 0], nominal = [0, 0, 0] }, { measured = [1, 0, 0], nominal = [1, 0, 0] }, \
                  { measured = [2, 0, 0], nominal = [2, 0, 0] }]";
    let (head, rest) = PLAN.split_once("method = \"datum\"").unwrap();
    let rest = rest.split_once("[[feature]]").unwrap().1;
    std::fs::write(&run.plan, format!("{head}method = \"pairs\"\n{places}\n[[feature]]{rest}")).unwrap();
    of_lists("on one line");
}

//! `trueness section` as users run it.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Folder, document, status, stderr, stdout, trueness};

/// A line of length 10, a quarter of a circle of radius 5, a line of length 6; two columns.
fn profile() -> String {
    let mut text = String::new();
    (0..100).for_each(|i| text += &format!("{} 0\n", 0.1 * f64::from(i)));
    for i in 0..=78 {
        let a = 0.02 * f64::from(i) + 0.005;
        text += &format!("{} {}\n", 10.0 + 5.0 * a.sin(), 5.0 - 5.0 * a.cos());
    }
    (1..60).for_each(|i| text += &format!("15 {}\n", 5.0 + 0.1 * f64::from(i)));
    text
}

#[test]
fn a_profile_has_its_segments_and_joins() {
    let folder = Folder::new();
    let file = folder.write("profile.txt", profile());
    let file = file.to_str().unwrap();
    let [dxf, svg, csv] = ["p.dxf", "p.svg", "p.csv"].map(|n| folder.file(n).to_str().unwrap().to_string());
    let answer = document(["section", file, "--dxf", &dxf, "--svg", &svg, "--out", &csv]);
    assert_eq!(answer["schema"], "trueness/section/1");
    let contour = &answer["contours"][0];
    assert_eq!(contour["closed"], false);
    let kinds: Vec<&str> =
        contour["segments"].as_array().unwrap().iter().map(|s| s["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["line", "arc", "line"]);
    assert!((contour["segments"][1]["radius"].as_f64().unwrap() - 5.0).abs() < 1e-6);
    for (n, truth) in [[10.0, 0.0], [15.0, 5.0]].into_iter().enumerate() {
        let join = &contour["joins"][n];
        assert_eq!(join["continuity"], "g1");
        let at = |k: usize| join["point"][k].as_f64().unwrap();
        assert!((at(0) - truth[0]).abs() < 1e-5 && (at(1) - truth[1]).abs() < 1e-5, "{join}");
        assert!(join["std_uncertainty"].as_f64().unwrap() >= 0.0);
        assert_eq!(join["interval"].as_array().unwrap().len(), 2);
    }
    let read = |path: &str| std::fs::read_to_string(path).unwrap();
    assert_eq!((read(&dxf).matches("\nLINE\n").count(), read(&dxf).matches("\nARC\n").count()), (2, 1));
    assert_eq!(read(&svg).matches("<path").count(), 3);
    assert_eq!(read(&csv).lines().count(), 1 + 238);
    let again = trueness(["section", file, "--threads", "1"]);
    assert_eq!(status(&again), 0, "{}", stderr(&again));
    assert!(stdout(&again).contains("r 5.000000"), "{}", stdout(&again));
}

#[test]
fn wrong_input_is_refused_with_a_remedy() {
    let folder = Folder::new();
    let few = folder.write("few.txt", "0 0\n1 0\n2 1\n");
    let good = folder.write("good.txt", profile());
    let cube = folder.write("cube.off", common::CUBE);
    let [few, good, cube] = [&few, &good, &cube].map(|p| p.to_str().unwrap());
    let twice = folder.file("a").to_str().unwrap().to_string();
    for (words, want, reason) in [
        (vec![few], 3, "few.txt: a section needs at least 4 different points, there are 3"),
        (vec![good, "--noise", "0"], 2, "noise 0: it must be a length above 0"),
        (vec![good, "--level", "100"], 2, "level 1: it must be between 0 and 1"),
        (vec![cube], 2, "it is a mesh; give the points of its section in their order"),
        (vec![good, "--dxf", &twice, "--svg", &twice], 2, "are the same file; give each its own"),
    ] {
        let answer = trueness([&["section"][..], &words].concat());
        let text = stderr(&answer);
        assert_eq!(status(&answer), want, "{text}");
        assert!(text.contains(reason), "{text}");
    }
}

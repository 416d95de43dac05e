//! `trueness convert` and `trueness info`: what is in a file, and the same in another format.

#![allow(clippy::unwrap_used)]

use crate::common::{Folder, corpus, status, stderr, stdout, trueness};
use serde_json::Value;

fn document(words: &[&str]) -> Value {
    let out = trueness(words.iter().chain(&["--json", "-"]));
    assert_eq!(status(&out), 0, "{words:?}: {}", stderr(&out));
    serde_json::from_str(&stdout(&out)).unwrap()
}

#[test]
fn a_mesh_keeps_its_corners_in_every_format() {
    let folder = Folder::new();
    let bunny = corpus("bunny/zipper_res4.ply").display().to_string();
    let before = document(&["info", &bunny]);
    assert_eq!((&before["content"], &before["unit"]), (&"mesh".into(), &"mm".into()));
    for ending in ["ply", "off", "stl", "obj"] {
        let out = folder.file(&format!("out.{ending}")).display().to_string();
        let written = document(&["convert", &bunny, &out]);
        let moved = written["farthest_moved"].as_f64().unwrap();
        assert!(moved <= 0.0, "{ending}: the bunny is of single precision");
        let after = document(&["info", &out]);
        for key in ["facets", "points", "bounds"] {
            assert_eq!(after[key], before[key], "{ending}: {key}");
        }
        assert!((after["area"].as_f64().unwrap() / before["area"].as_f64().unwrap() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn digits_that_a_format_rounds_are_told() {
    let folder = Folder::new();
    let off = folder.write("a.off", "OFF\n3 1 0\n0 0 0\n0.1 0 0\n0 1 0\n3 0 1 2\n").display().to_string();
    let out = folder.file("a.stl").display().to_string();
    let written = document(&["convert", &off, &out]);
    assert_eq!(written["farthest_moved"].as_f64().unwrap(), f64::from(0.1f32) - 0.1);
    let shown = stdout(&trueness(["convert", &off, &out]));
    assert!(shown.contains("rounded  coordinates by up to 1.5e−9 mm"), "{shown}");
}

#[test]
fn points_are_written_in_their_order_and_units_become_millimeters() {
    let folder = Folder::new();
    let table = folder.write("a.xyz", "1 2 3\n4 5 6\n").display().to_string();
    let out = folder.file("a.csv").display().to_string();
    let written = document(&["convert", &table, &out, "--units", "in"]);
    assert_eq!(written["points"], 2);
    let text = std::fs::read_to_string(&out).unwrap();
    assert!(text.lines().nth(1).unwrap().starts_with("25.4,50.8,76.1"), "{text}");
    assert_eq!(document(&["info", &out])["bounds"][1][0].as_f64().unwrap(), 4.0 * 25.4);
    assert_eq!(document(&["info", &table])["content"], "points");
}

#[test]
fn a_format_of_points_takes_vertices_and_says_so_and_no_facets_are_made_up() {
    let folder = Folder::new();
    let cube = corpus("shapes/mayo__258_cube.off").display().to_string();
    let points = folder.file("a.csv").display().to_string();
    let written = document(&["convert", &cube, &points]);
    assert_eq!((&written["written"], &written["points"]), (&"points".into(), &8.into()));
    assert_eq!(written["lost"][0], "12 facets: the format holds points alone");
    let mesh = folder.file("a.stl").display().to_string();
    let refused = trueness(["convert", &points, &mesh]);
    assert_eq!(status(&refused), 2);
    assert!(stderr(&refused).contains(".csv"), "{}", stderr(&refused));
    assert!(!folder.file("a.stl").exists());
    let itself = trueness(["convert", &cube, &cube]);
    assert_eq!(status(&itself), 2, "{}", stderr(&itself));
}

//! The programs of `examples/`, run as their first lines say, and what they print.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::panic, missing_docs)]

use crate::common::{Folder, corpus};
use std::path::{Path, PathBuf};
use std::process::Command;

/// What an example prints.
fn printed(name: &str, files: &[PathBuf]) -> String {
    let folder = Path::new(env!("CARGO_BIN_EXE_trueness")).parent().unwrap().join("examples");
    let program = folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    let out =
        Command::new(&program).args(files).output().unwrap_or_else(|e| panic!("{}: {e}", program.display()));
    assert!(out.status.success(), "{name}: {}", String::from_utf8_lossy(&out.stderr));
    String::from_utf8(out.stdout).unwrap()
}

#[test]
fn a_scan_against_its_nominal() {
    let files = ["bunny/scans.ply", "bunny/zipper_res4.ply"].map(corpus);
    let text = printed("deviations", &files);
    // The command says the same.
    let told = Command::new(env!("CARGO_BIN_EXE_trueness"))
        .args(["compare", "--json", "-", "--quiet"])
        .args(files)
        .output()
        .unwrap();
    let document: serde_json::Value = serde_json::from_slice(&told.stdout).unwrap();
    let all = &document["comparisons"][0]["deviation"]["all"];
    let number = |key: &str| all[key].as_f64().unwrap();
    let wanted = format!(
        "{} points, mean {:+.4} mm, rms {:.4} mm\n0 beyond the greatest distance\n",
        number("count"),
        number("mean"),
        number("rms")
    );
    assert_eq!(text, wanted);
}

#[test]
fn a_broken_mesh_is_mended() {
    let folder = Folder::new();
    let sound = folder.file("sound.stl");
    let text = printed("mend", &[corpus("broken/hole_one_triangle.stl"), sound.clone()]);
    assert_eq!(text, "boundary_edges: 3\nholes: 1\ndangling_facets: 3\n1 changes, sound\n");
    assert!(sound.exists());
}

#[test]
fn a_bore_is_fitted() {
    let file = corpus("reference_fits/cylinder_exact_60.xyz");
    let wanted = "diameter 120.0000 mm, axis (0.66667, -0.33333, 0.66667)\n60 points, rms 0.5303 mm\n";
    // The axis is (2, -1, 2) and the radius 60 by construction.
    assert_eq!(printed("bore", &[file]), wanted);
}

#[test]
fn elements_of_a_part() {
    let text = printed("elements", &[corpus("shapes/trimesh__unit_cube.STL")]);
    let wanted: String = (1..=6).map(|n| format!("{n}: plane, 2 facets, 1.00 mm²\n")).collect();
    assert_eq!(text, wanted);
}

#[test]
fn a_profile() {
    assert_eq!(printed("profile", &[]), "line\narc\njoin at (5.000, 3.000)\n");
}

#[test]
fn a_scan_onto_its_nominal() {
    let plate = |name| corpus(&format!("examples/plate/{name}.stl"));
    // The angle is that of the matrix which `align` prints: its trace is 0.029156.
    let wanted = "turned by 119.040°\nwithin ±0.1 mm: 100.0 %\n";
    assert_eq!(printed("aligned", &[plate("scan"), plate("nominal")]), wanted);
}

#[test]
fn examples_are_short_and_all_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut names = vec![];
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let lines = std::fs::read_to_string(&path).unwrap().lines().count();
        assert!(lines <= 30, "{}: {lines} lines", path.display());
        names.push(path.file_stem().unwrap().to_str().unwrap().to_string());
    }
    names.sort();
    // A new one belongs into a test above.
    assert_eq!(names, ["aligned", "bore", "deviations", "elements", "mend", "profile"]);
}

//! `trueness curvature` as users run it.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{CUBE, Folder, document, status, stderr, stdout, trueness};
use std::f64::consts::{PI, TAU};

/// A torus of radii 10 and 4, facets outward.
fn torus() -> String {
    let (n, m) = (120, 60);
    let mut text = format!("OFF\n{} {} 0\n", n * m, 2 * n * m);
    for j in 0..m {
        for i in 0..n {
            let (u, v) = (TAU * f64::from(i) / f64::from(n), TAU * f64::from(j) / f64::from(m));
            let rho = 10.0 + 4.0 * v.cos();
            text += &format!("{} {} {}\n", rho * u.cos(), rho * u.sin(), 4.0 * v.sin());
        }
    }
    for j in 0..m {
        for i in 0..n {
            let at = |i: i32, j: i32| (j % m) * n + i % n;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            text += &format!("3 {a} {b} {c}\n3 {a} {c} {d}\n");
        }
    }
    text
}

/// Mean and Gaussian curvature of the torus at a place.
fn known([x, y, _]: [f64; 3]) -> [f64; 2] {
    let rho = x.hypot(y);
    let around = -(rho - 10.0) / (4.0 * rho);
    [0.5 * (around - 0.25), around * -0.25]
}

#[test]
fn a_torus_has_its_curvatures_in_document_table_and_files() {
    let folder = Folder::new();
    let file = folder.write("torus.off", torus());
    let file = file.to_str().unwrap();
    let (csv, ply) = (folder.file("k.csv"), folder.file("k.ply"));
    let answer = document(["curvature", file, "--degree", "4", "--out", csv.to_str().unwrap()]);
    assert_eq!(answer["schema"], "trueness/curvature/1");
    assert_eq!(
        (&answer["count"], &answer["total"], &answer["parts"]),
        (&7200.into(), &7200.into(), &0.into())
    );
    assert_eq!(answer["neighborhood"], serde_json::json!({"kind": "count", "neighbors": 45}));
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    // The greatest principal curvature is on the inner side: 1/6.
    assert!((number(&answer["k1"]["maximum"]["k1"]) - 1.0 / 6.0).abs() < 0.004);
    assert!((number(&answer["k2"]["statistics"]["median"]) + 0.25).abs() < 0.003);
    assert!((number(&answer["gaussian"]["statistics"]["min"]) + 1.0 / 24.0).abs() < 0.001);
    let text = std::fs::read_to_string(&csv).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(names[..7], ["x", "y", "z", "nx", "ny", "nz", "k1"]);
    let column = |name: &str| names.iter().position(|n| *n == name).unwrap();
    let mut rows = 0;
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!((cells.len(), cells[column("reason")]), (names.len(), ""));
        let value = |name: &str| cells[column(name)].parse::<f64>().unwrap();
        let [mean, gaussian] = known([value("x"), value("y"), value("z")]);
        assert!(
            (value("mean") - mean).abs() < 0.003 && (value("gaussian") - gaussian).abs() < 0.001,
            "{line}"
        );
        rows += 1;
    }
    assert_eq!(rows, 7200);
    let o = trueness(["curvature", file, "--out", ply.to_str().unwrap(), "--color", "gaussian"]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let text = stdout(&o);
    assert!(
        text.contains("7,200 of 7,200 vertices with curvatures   degree 3   at least 30 neighbors"),
        "{text}"
    );
    assert!(
        text.contains("positive where the surface bends towards its normal; normals by the facets"),
        "{text}"
    );
    // The mesh is whole: what is written is read again, with as many facets.
    let again = document(["check", ply.to_str().unwrap()]);
    assert_eq!((&again["facets"], &again["vertices"]), (&14400.into(), &7200.into()));
}

#[test]
fn the_same_bytes_on_any_threads_for_mesh_and_cloud() {
    let folder = Folder::new();
    let mesh = folder.write("torus.off", torus());
    let rows: String = torus().lines().skip(2).take(7200).map(|l| format!("{l}\n")).collect();
    let cloud = folder.write("torus.xyz", rows);
    for input in [&mesh, &cloud] {
        let run = |threads: &str| {
            let [json, csv, html] = ["json", "csv", "html"].map(|e| folder.file(&format!("{threads}.{e}")));
            let mut words: Vec<&std::ffi::OsStr> = vec!["curvature".as_ref(), input.as_ref()];
            words.extend(["--threads".as_ref(), threads.as_ref()] as [&std::ffi::OsStr; 2]);
            for (option, path) in [("--json", &json), ("--out", &csv), ("--html", &html)] {
                words.extend([option.as_ref(), path.as_os_str()]);
            }
            let o = trueness(words);
            assert_eq!(status(&o), 0, "{}", stderr(&o));
            [json, csv, html].map(|p| std::fs::read_to_string(p).unwrap())
        };
        let one = run("1");
        assert!(one == run("3"));
        assert!(one[2].contains(">Curvature · torus."), "no title");
        assert_eq!(one[2].matches("<tr data-pick=").count(), 8);
    }
    let answer = document(["curvature".as_ref(), cloud.as_os_str(), "--radius".as_ref(), "2".as_ref()]);
    assert_eq!(
        (&answer["places"], &answer["normals"], &answer["parts"]),
        (&"points".into(), &"neighbors".into(), &1.into())
    );
    // Outward: the body is convex on its outer side.
    assert!(answer["mean"]["statistics"]["max"].as_f64().unwrap() < 0.0);
}

#[test]
fn what_has_no_curvature_is_counted_or_refused_by_name() {
    let folder = Folder::new();
    // A sheet of 12 by 12 vertices: 44 on its rim.
    let mut sheet = String::from("OFF\n144 242 0\n");
    for k in 0..144 {
        let (x, y) = (f64::from(k % 12), f64::from(k / 12));
        sheet += &format!("{x} {y} {}\n", 0.01 * x * x);
    }
    for k in 0..121 {
        let a = k / 11 * 12 + k % 11;
        sheet += &format!("3 {a} {} {}\n3 {a} {} {}\n", a + 1, a + 13, a + 13, a + 12);
    }
    let sheet = folder.write("sheet.off", sheet);
    let sheet = sheet.to_str().unwrap();
    let answer = document(["curvature", sheet]);
    assert_eq!(answer["without"], serde_json::json!({"boundary": 44}));
    assert_eq!((&answer["count"], &answer["total"]), (&100.into(), &144.into()));
    assert_eq!(document(["curvature", sheet, "--boundary"])["count"], 144);
    assert!(stdout(&trueness(["curvature", sheet])).contains("! 44 vertices without a value: boundary"));
    let cube = folder.write("cube.off", CUBE);
    let line: String = (0..50).map(|k| format!("{k} {} {}\n", 2 * k, 3 * k)).collect();
    let (line, flat) = (folder.write("line.xyz", line), folder.write("flat.xy", "0 0\n1 0\n0 1\n1 1\n"));
    let ball = folder.write("ball.off", ball());
    let [cube, line, flat, ball] = [&cube, &line, &flat, &ball].map(|p| p.to_str().unwrap());
    for (words, want, reason) in [
        (vec![cube], 3, "cube.off: no place has a curvature (8 few neighbors); give a smaller --degree"),
        (vec![line], 3, "line.xyz: no place has a curvature (50 undetermined); they lie on lines"),
        (vec![line], 3, "points of a single line have no curvature"),
        (
            vec![ball, "--radius", "100"],
            3,
            "folded); within the radius the surface turns back: give a smaller --radius",
        ),
        (vec![flat], 2, "flat.xy: it has two columns; curvatures need x, y and z"),
        (vec![sheet, "--degree", "7"], 2, "degree 7: it must be from 2 to 6"),
        (vec![sheet, "--neighbors", "4"], 2, "--neighbors 4: a jet of degree 3 needs from 10 to 10000"),
        (vec![sheet, "--radius", "-1"], 2, "radius -1: it must be a length above 0"),
        (vec![sheet, "--radius", "1", "--neighbors", "20"], 2, "cannot be used with"),
        (vec![sheet, "--radius", "0.1"], 3, "few neighbors); give a larger --radius, or a smaller --degree"),
        (vec![sheet, "--out", "k.stl"], 2, ".ply .csv"),
        (vec![sheet, "--out", sheet], 2, ".ply .csv"),
    ] {
        let o = trueness([&["curvature"][..], &words].concat());
        let text = stderr(&o);
        assert_eq!(status(&o), want, "{words:?}: {text}");
        assert!(text.contains(reason), "{words:?}: {text}");
        assert!(stdout(&o).is_empty(), "{words:?}");
    }
}

/// A sphere of radius 10 mm of 12 meridians and 8 parallels.
fn ball() -> String {
    let mut text = String::from("OFF\n98 192 0\n0 0 10\n0 0 -10\n");
    for k in 0..96 {
        let (up, around) = (f64::from(k / 12 + 1) * PI / 9.0, f64::from(k % 12) * PI / 6.0);
        let r = 10.0 * up.sin();
        text += &format!("{} {} {}\n", r * around.cos(), r * around.sin(), 10.0 * up.cos());
    }
    for k in 0..12 {
        let next = (k + 1) % 12;
        text += &format!("3 0 {} {}\n3 1 {} {}\n", 2 + k, 2 + next, 86 + next, 86 + k);
        for row in 0..7 {
            let [a, b] = [k, next].map(|k| 2 + 12 * row + k);
            text += &format!("3 {a} {} {b}\n3 {b} {} {}\n", a + 12, a + 12, b + 12);
        }
    }
    text
}

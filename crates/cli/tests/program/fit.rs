//! `trueness fit` as users run it.
#![allow(clippy::unwrap_used, missing_docs)]

use crate::common::{Folder, corpus, document, status, stderr, stdout, trueness};

#[test]
fn the_document_holds_the_reference_answer() {
    let points = corpus("reference_fits/cylinder_exact_60.xyz");
    let answer = document(["fit", points.to_str().unwrap(), "--shape", "cylinder"]);
    assert_eq!(answer["schema"], "trueness/fit/1");
    assert_eq!(answer["count"], 60);
    let radius = answer["parameters"]["radius"].as_f64().unwrap();
    assert!((radius - 60.0).abs() < 1e-10, "{radius}");
    assert!((answer["form_error"].as_f64().unwrap() - 1.5).abs() < 1e-10);
    assert_eq!(answer["inputs"][0]["points"], 60);
}

#[test]
fn two_columns_are_fitted_in_the_plane() {
    let points = corpus("reference_fits/straightness_exact_3.xyz");
    let words = ["fit", points.to_str().unwrap(), "--shape", "line", "--method", "minimum-zone"];
    let answer = document(words);
    assert_eq!(answer["planar"], true);
    assert!((answer["form_error"].as_f64().unwrap() - 0.3125).abs() < 1e-14);
    assert_eq!(answer["touching"].as_array().unwrap().len(), 3);
    let table = trueness(words);
    assert!(stdout(&table).contains("form error 0.312500000"), "{}", stdout(&table));
}

/// A plane of 3,600 points whose noise is the mean of nine neighbors: nine points tell as much as one, and the uncertainty of their plane is three
/// times that of independent ones.
#[test]
fn uncertainties_know_what_neighbors_share() {
    let mut state = 1u64;
    let mut unit = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1u32 << 31) - 0.5
    };
    let raw: Vec<f64> = (0..62 * 62).map(|_| 0.03 * unit()).collect();
    let mean = |x: usize, y: usize| (0..9).map(|k| raw[(y + k / 3) * 62 + x + k % 3]).sum::<f64>() / 9.0;
    let text = |side: usize| -> String {
        (0..side * side)
            .map(|i| format!("{} {} {:.6}\n", i % side, i / side, mean(i % side, i / side)))
            .collect()
    };
    let folder = Folder::new();
    let scan = folder.write("scan.xyz", text(60));
    let words = ["fit", scan.to_str().unwrap(), "--shape", "plane"];
    let [shared, independent] = [document(words), document(words.into_iter().chain(["--independent"]))];
    let noise = &shared["shared_noise"];
    let points = noise["points_per_independent"].as_f64().unwrap();
    assert!((7.0..11.0).contains(&points), "{noise}");
    let planted = 0.03 / 12f64.sqrt() / 3.0;
    assert!((noise["deviation"].as_f64().unwrap() / planted - 1.0).abs() < 0.1, "{noise}");
    let stated = |d: &serde_json::Value| d["uncertainty"]["point"][2].as_f64().unwrap();
    assert!((stated(&shared) / stated(&independent) / points.sqrt() - 1.0).abs() < 1e-12, "{shared}");
    assert!(independent["shared_noise"].is_null());
    assert!(independent["shared_noise_reason"].as_str().unwrap().contains("--independent"));
    assert!(stdout(&trueness(words)).contains("points tell as much as an independent one"));
    // Too few points to tell.
    let few = folder.write("few.xyz", text(15));
    let few = document(["fit", few.to_str().unwrap(), "--shape", "plane"]);
    assert!(few["shared_noise_reason"].as_str().unwrap().starts_with("it has too few points"), "{few}");
    // The same of a region of the scan.
    let found = document(["segment", scan.to_str().unwrap()]);
    let points = found["shared_noise"]["points_per_independent"].as_f64().unwrap();
    assert!((6.0..12.0).contains(&points), "{}", found["shared_noise"]);
}

#[test]
fn too_few_points_are_refused_with_the_file() {
    let folder = Folder::new();
    let file = folder.write("two.xyz", "0 0 0\n1 2 3\n");
    let answer = trueness(["fit", file.to_str().unwrap(), "--shape", "plane"]);
    assert_eq!(status(&answer), 3);
    let text = stderr(&answer);
    assert!(text.contains("two.xyz: a plane needs at least 3 points, there are 2"), "{text}");
}

#[test]
fn what_determines_no_element_is_refused_by_name() {
    let folder = Folder::new();
    let equal = folder.write("equal.xyz", "1 2 3\n".repeat(9));
    let line: String = (0..9).map(|k| format!("{k} {} {}\n", 2 * k, 3 * k)).collect();
    let line = folder.write("line.xyz", line);
    let nan = folder.write("nan.xyz", "0 0 0\n1 0 0\n0 nan 0\n1 1 1\n");
    for (file, shape, reason) in [
        (&equal, "sphere", "equal.xyz: all points are equal"),
        (&line, "plane", "line.xyz: all points lie on one straight line: they determine no plane"),
        (&nan, "plane", "nan.xyz"),
    ] {
        let answer = trueness(["fit", file.to_str().unwrap(), "--shape", shape]);
        let text = stderr(&answer);
        assert_eq!(status(&answer), 3, "{text}");
        assert!(text.contains(reason), "{text}");
        assert!(stdout(&answer).is_empty() && text.lines().count() <= 3, "{text}");
    }
}

#[test]
fn a_method_without_meaning_is_refused() {
    let points = corpus("reference_fits/cylinder_exact_60.xyz");
    let words = ["fit", points.to_str().unwrap(), "--shape", "plane", "--method", "maximum-inscribed"];
    let answer = trueness(words);
    assert_eq!(status(&answer), 2);
    assert!(stderr(&answer).contains("maximum-inscribed is not defined for a plane"), "{}", stderr(&answer));
}

#[test]
fn a_report_says_what_the_document_says() {
    let f = Folder::new();
    let points = corpus("reference_fits/cylinder_01_lobed.xyz");
    let html = f.file("report.html");
    let words = ["--shape", "cylinder", "--method", "minimum-zone", "--html"].map(std::ffi::OsStr::new);
    let o = trueness(
        [std::ffi::OsStr::new("fit"), points.as_os_str()].into_iter().chain(words).chain([html.as_os_str()]),
    );
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let text = std::fs::read_to_string(html).unwrap();
    assert!(text.contains(">Cylinder · cylinder_01_lobed.xyz</title>"));
    assert_eq!(
        text.matches("data-t=\"touching.outer\"").count() + text.matches("data-t=\"touching.inner\"").count(),
        6
    );
}

//! Rows with points that belong to no contour, thin walls and cut edges, through the program: what is told, and the exit status.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, trueness};
use serde_json::Value;
use std::f64::consts::{PI, TAU};

/// Exit status and document.
fn ran(folder: &Folder, text: &str, words: &[&str]) -> (i32, Value) {
    let (file, json) = (folder.write("row.txt", text), folder.file("row.json"));
    let mut all = vec!["section", file.to_str().unwrap(), "--json", json.to_str().unwrap()];
    all.extend(words);
    let status = trueness(&all).status.code().unwrap();
    (status, serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap())
}

fn row(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x:.6} {y:.6}\n")).collect()
}

/// A half circle of radius 10 is 10π long, whatever stands before and behind it, and what does is listed.
#[test]
fn stray_rows_are_outliers() {
    let folder = Folder::new();
    let half: Vec<[f64; 2]> =
        (0..200).map(|i| PI * f64::from(i) / 199.0).map(|a| [10.0 * a.cos(), 10.0 * a.sin()]).collect();
    for (before, behind) in
        [(Some([100.0, 100.0]), None), (None, Some([1e7, -3e6])), (Some([500.0, 0.0]), Some([500.0, 0.0]))]
    {
        let all: Vec<[f64; 2]> = before.into_iter().chain(half.clone()).chain(behind).collect();
        let (status, document) = ran(&folder, &row(&all), &[]);
        let contour = &document["contours"][0];
        let want: Vec<usize> = before.map(|_| 0).into_iter().chain(behind.map(|_| all.len() - 1)).collect();
        assert_eq!(contour["outliers"], serde_json::json!(want));
        let length = contour["length"].as_f64().unwrap();
        assert!(status == 0 && (length / (10.0 * PI) - 1.0).abs() < 1e-3, "{status} {length}");
    }
    // The center behind it may be the end of a radius: it is kept, and told.
    let all: Vec<[f64; 2]> = half.iter().copied().chain([[0.0, 0.0]]).collect();
    let (status, document) = ran(&folder, &row(&all), &[]);
    let doubts = document["contours"][0]["doubts"].as_array().unwrap().len();
    assert!(status == 1 && doubts == 1, "{document}");
}

/// A tube of radii 10 and 9.8 is two circles.
#[test]
fn faces_of_a_tube_are_two_circles() {
    let folder = Folder::new();
    let share = |i: u32, step: f64| (f64::from(i) * step).fract();
    let cloud: String = (0..1200)
        .map(|i| {
            let r = if i % 2 == 0 { 10.0 } else { 9.8 } + 0.01 * (share(i, 0.754_877_67) - 0.5);
            let a = TAU * share(i, 0.618_033_99);
            format!("{:.4} {:.4} {:.4}\n", r * a.cos(), r * a.sin(), 0.5 * share(i, 0.414_213_56) - 0.25)
        })
        .collect();
    let (status, document) = ran(&folder, &cloud, &["--plane", "0,0,1,0", "--thickness", "0.6"]);
    let contours = document["contours"].as_array().unwrap();
    let mut radii: Vec<f64> = contours.iter().map(|c| c["segments"][0]["radius"].as_f64().unwrap()).collect();
    radii.sort_by(f64::total_cmp);
    assert!(status == 0 && radii.len() == 2, "{status} {radii:?}");
    assert!((radii[0] - 9.8).abs() < 0.002 && (radii[1] - 10.0).abs() < 0.002, "{radii:?}");
}

/// A symmetrical profile cut off at 85 of 100 has a chord of 85, no camber and a face, with points on it or none.
#[test]
fn a_cut_profile_is_blunt() {
    let folder = Folder::new();
    let height = |x: f64| {
        let s = x / 100.0;
        60.0 * (0.2969 * s.sqrt() + s * (-0.126 + s * (-0.3516 + s * (0.2843 - 0.1036 * s))))
    };
    for on_face in [0, 4] {
        let place = |k: i32| {
            let x = 85.0 * (f64::from(k.abs()) / 60.0).powi(2);
            [x, f64::from(k.signum()) * height(x)]
        };
        let face = 2.0 * height(85.0);
        let edge = (1..=on_face).map(|i| [85.0, face * (f64::from(i) / f64::from(on_face + 1) - 0.5)]);
        let all: Vec<[f64; 2]> = (-60..=60).rev().map(place).chain(edge).collect();
        let (_, document) = ran(&folder, &row(&all), &["--airfoil"]);
        let found = &document["airfoils"][0]["measures"];
        let of = |key: &str| found[key].as_f64().unwrap();
        assert!((of("chord") - 85.0).abs() < 0.05 && of("camber").abs() < 0.05, "{on_face}: {found}");
        assert!(
            (of("trailing_thickness") - face).abs() < 0.02 && found["trailing_kind"] != "sharp",
            "{found}"
        );
    }
}

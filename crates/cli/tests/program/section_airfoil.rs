//! `trueness section --airfoil` as users run it.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stdout, trueness};

/// NACA 0012 with a closed trailing edge, 80 long, turned by 30 degrees: from the trailing edge over the upper side and back.
fn naca() -> String {
    let place = |k: u32| {
        let x = 0.5 * (1.0 + (std::f64::consts::PI * f64::from(k) / 100.0).cos());
        let y = 0.6 * (0.2969 * x.sqrt() - x * (0.1260 + x * (0.3516 - x * (0.2843 - 0.1036 * x))));
        let (x, y) = (80.0 * x, if k <= 100 { 80.0 * y } else { -80.0 * y });
        let (sin, cos) = (0.5_f64, 0.75_f64.sqrt());
        format!("{} {}\n", cos * x - sin * y, sin * x + cos * y)
    };
    (0..=200).map(place).collect()
}

#[test]
fn a_profile_has_its_measures_in_document_table_and_report() {
    let folder = Folder::new();
    let file = folder.write("naca.txt", naca());
    let html = folder.file("naca.html");
    let words = ["section", file.to_str().unwrap(), "--airfoil"];
    let answer = document([&words[..], &["--html", html.to_str().unwrap()]].concat());
    let all = answer["airfoils"].as_array().unwrap();
    assert_eq!(all.len(), answer["contours"].as_array().unwrap().len());
    let measures = &all[0]["measures"];
    let number = |key: &str| measures[key].as_f64().unwrap();
    assert!((number("chord") - 80.0).abs() < 1e-3, "{measures}");
    assert!((number("chord_angle").to_degrees() - 30.0).abs() < 0.01);
    // Twice 0.060007 of the chord, at 30 %; radius 1.1019 t², and what the local curve makes of it.
    assert!((number("thickness") - 80.0 * 0.120_014).abs() < 2e-3, "{measures}");
    assert!((number("thickness_at") - 0.3).abs() < 5e-3);
    assert!(number("camber").abs() < 8e-3, "{measures}");
    assert!((number("leading_radius") / (80.0 * 1.1019 * 0.0144) - 1.0).abs() < 0.1);
    assert_eq!(measures["trailing_kind"], "sharp");
    assert!(measures["trailing_radius"].is_null() && measures["trailing_radius_reason"].is_string());
    assert_eq!(measures["camber_line"].as_array().unwrap().len(), 51);
    let table = stdout(&trueness(words));
    for said in ["greatest thickness   9.60", "trailing edge, sharp", "no radius: "] {
        let spaces = |s: &str| s.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(spaces(&table).contains(&spaces(said)), "{said}: {table}");
    }
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(page.contains("Greatest thickness") && page.contains("Leading radius"));
}

#[test]
fn what_is_no_profile_has_a_reason() {
    let folder = Folder::new();
    let text: String = (0..60).map(|i| format!("{} {}\n", i, if i < 30 { 0 } else { i - 30 })).collect();
    let file = folder.write("angle.txt", text);
    let words = ["section", file.to_str().unwrap(), "--airfoil"];
    let answer = document(words);
    assert!(answer["airfoils"][0]["measures"].is_null());
    assert!(
        answer["airfoils"][0]["measures_reason"].as_str().unwrap().contains("do not run around a profile")
    );
    let told = trueness(words);
    assert_eq!(status(&told), 0);
    assert!(stdout(&told).contains("not measured"), "{}", stdout(&told));
    // Without the option there is no block.
    assert!(document(["section", file.to_str().unwrap()]).get("airfoils").is_none());
}

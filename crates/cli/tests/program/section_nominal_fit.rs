//! `trueness section --nominal` with `--fit`, `--tolerance`, and blades; `--tidy`; as users run it.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stderr, stdout, trueness};
use serde_json::Value;

/// A number between −1 and 1 of the normal kind, always the same for the same `i`.
fn wobble(i: usize) -> f64 {
    let unit = |k: u64| {
        let mut z = (12 * i as u64 + k).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z >> 11) as f64 / 9_007_199_254_740_992.0
    };
    ((0..12).map(unit).sum::<f64>() - 6.0) / 3.0
}

/// An L of 40 by 20 with a rounded corner of radius 6, open; points every 0.2, off by `noise`, turned by `turn` and shifted.
fn ell(noise: f64, turn: f64, [x, y]: [f64; 2], least: f64, most: f64) -> String {
    let place = |s: f64| -> ([f64; 2], [f64; 2]) {
        let bow = 3.0 * std::f64::consts::PI;
        if s < 34.0 {
            ([s, 0.0], [0.0, -1.0])
        } else if s < 34.0 + bow {
            let a = (s - 34.0) / 6.0;
            ([34.0 + 6.0 * a.sin(), 6.0 - 6.0 * a.cos()], [a.sin(), -a.cos()])
        } else {
            ([40.0, s - 34.0 - bow + 6.0], [1.0, 0.0])
        }
    };
    let (sin, cos) = turn.sin_cos();
    let mut text = String::new();
    let count = ((most - least) / 0.2) as usize;
    for i in 0..=count {
        let (p, n) = place(least + 0.2 * i as f64);
        let d = noise * wobble(i);
        let [a, b] = [p[0] + d * n[0], p[1] + d * n[1]];
        text.push_str(&format!("{} {}\n", cos * a - sin * b + x, sin * a + cos * b + y));
    }
    text
}

fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer}: {value}"))
}

#[test]
fn a_section_is_brought_onto_its_nominal() {
    let folder = Folder::new();
    let nominal = folder.write("nominal.txt", ell(0.0, 0.0, [0.0, 0.0], 0.0, 56.0));
    let measured = folder.write("measured.txt", ell(0.01, 0.02, [0.3, -0.2], 2.0, 54.0));
    let (m, n) = (measured.to_str().unwrap(), nominal.to_str().unwrap());
    let html = folder.file("fit.html");
    let words = ["section", m, "--nominal", n, "--open"];
    let answer = document([&words[..], &["--fit", "free", "--html", html.to_str().unwrap()]].concat());
    let fit = &answer["nominal"]["fits"][0];
    let (turn, u) = (number(fit, "/turn"), number(fit, "/turn_uncertainty"));
    assert!((turn + 0.02).abs() < 4.0 * u && u < 1e-3, "{fit}");
    // Takes the shifted origin back.
    let row = |k: usize| {
        let at = |i: usize| number(fit, &format!("/transform/{k}/{i}"));
        at(0) * 0.3 + at(1) * -0.2 + at(2)
    };
    assert!(row(0).abs() < 0.01 && row(1).abs() < 0.01, "{fit}");
    assert!(number(fit, "/rms") < 0.005 && number(fit, "/rms_before") > 0.1, "{fit}");
    assert!(number(&answer, "/nominal/deviation/all/rms") < 0.005);
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(page.contains("Best fit, turn") && page.contains("Best fit, shift"));
    // Only x: y and the turn stay.
    let fit = &document([&words[..], &["--fit", "x"]].concat())["nominal"]["fits"][0];
    assert_eq!((number(fit, "/shift/1"), number(fit, "/turn")), (0.0, 0.0));
    assert!(fit["turn_uncertainty"].is_null() && fit["shift_uncertainty"][1].is_null());
    // Without: nothing is moved.
    assert!(document([&words[..], &["--fit", "none"]].concat())["nominal"]["fits"].is_null());
    let table = stdout(&trueness([&words[..], &["--fit", "free"]].concat()));
    assert!(table.contains("best fit onto the nominal: free"), "{table}");
}

#[test]
fn what_a_nominal_does_not_hold_is_an_error_with_a_remedy() {
    let folder = Folder::new();
    let circle = |r: f64| -> String {
        let at = |i: u32| (std::f64::consts::TAU * f64::from(i) / 90.0).sin_cos();
        (0..90).map(at).map(|(s, c)| format!("{} {}\n", r * c, r * s)).collect()
    };
    let (a, b) = (folder.write("a.txt", circle(10.0)), folder.write("b.txt", circle(10.1)));
    let words = ["section", b.to_str().unwrap(), "--nominal", a.to_str().unwrap(), "--fit"];
    let answer = trueness([&words[..], &["free"]].concat());
    assert_eq!(status(&answer), 3);
    let said = stderr(&answer);
    for part in ["a.txt", "a turn about (", "is free", "--fit xy"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert_eq!(status(&trueness([&words[..], &["xy"]].concat())), 0);
    for wrong in [&["--fit", "free"][..], &["--tolerance", "0.1"], &["--max-distance", "1"]] {
        let answer = trueness([&["section", b.to_str().unwrap()][..], wrong].concat());
        assert_eq!(status(&answer), 2, "{wrong:?}");
    }
    let refused = [&words[..4], &["--tolerance", "0.1", "--max-distance", "0.05"]].concat();
    assert_eq!(status(&trueness(refused)), 2);
}

#[test]
fn a_profile_is_judged() {
    let folder = Folder::new();
    let nominal = folder.write("nominal.txt", ell(0.0, 0.0, [0.0, 0.0], 0.0, 56.0));
    let whole = folder.write("whole.txt", ell(0.01, 0.0, [0.0, 0.05], 1.0, 55.0));
    let part = folder.write("part.txt", ell(0.01, 0.0, [0.0, 0.05], 1.0, 28.0));
    let run = |file: &std::path::Path, more: &[&str]| {
        let words = ["section", file.to_str().unwrap(), "--nominal", nominal.to_str().unwrap(), "--open"];
        let answer = document([&words[..], more].concat());
        let status = status(&trueness([&words[..], more].concat()));
        let why: Vec<String> = answer["nominal"]["verdict_reasons"]
            .as_array()
            .map_or(vec![], |all| all.iter().map(|r| r["kind"].as_str().unwrap().to_string()).collect());
        (answer["nominal"]["verdict"].as_str().unwrap_or("none").to_string(), why, status)
    };
    let is = |verdict: &str, why: &[&str], status: i32| {
        (verdict.to_string(), why.iter().map(|w| w.to_string()).collect::<Vec<_>>(), status)
    };
    assert_eq!(run(&whole, &[]), is("none", &[], 0));
    assert_eq!(run(&whole, &["--tolerance", "0.1"]), is("pass", &[], 0));
    assert_eq!(run(&whole, &["--tolerance", "0.03"]), is("fail", &["out_of_tolerance"], 1));
    assert_eq!(run(&whole, &["--tolerance", "0.03", "--inside", "25"]), is("pass", &[], 0));
    assert_eq!(run(&whole, &["--tolerance", "0.03", "--fit", "xy"]), is("pass", &[], 0));
    assert_eq!(run(&part, &["--tolerance", "0.1"]), is("undecided", &["coverage"], 1));
    assert_eq!(run(&part, &["--tolerance", "0.1", "--min-coverage", "0"]), is("pass", &[], 0));
    assert_eq!(run(&part, &["--tolerance", "0.03"]), is("fail", &["out_of_tolerance"], 1));
    let html = folder.file("verdict.html");
    let words = ["section", whole.to_str().unwrap(), "--nominal", nominal.to_str().unwrap(), "--tolerance"];
    let table = stdout(&trueness([&words[..], &["-0.03,+0.2", "--html", html.to_str().unwrap()]].concat()));
    assert!(table.contains("zone of the width 0.2300") && table.contains("verdict   "), "{table}");
    assert!(std::fs::read_to_string(&html).unwrap().contains("Width of the zone"));
}

/// NACA 6409 with a closed trailing edge, 80 long, hollow below; turned by `turn` about the origin and moved.
fn blade(turn: f64, [x, y]: [f64; 2]) -> String {
    let place = |k: u32| {
        let u = 0.5 * (1.0 + (std::f64::consts::PI * f64::from(k) / 100.0).cos());
        let half = 0.45 * (0.2969 * u.sqrt() - u * (0.1260 + u * (0.3516 - u * (0.2843 - 0.1036 * u))));
        let (front, back) = (0.06 / 0.16, 0.06 / 0.36);
        let (height, slope) = match u < 0.4 {
            true => (front * (0.8 * u - u * u), 2.0 * front * (0.4 - u)),
            false => (back * (0.2 + 0.8 * u - u * u), 2.0 * back * (0.4 - u)),
        };
        let (s, c) = slope.atan().sin_cos();
        let side = if k <= 100 { half } else { -half };
        let (a, b) = (80.0 * (u - side * s), 80.0 * (height + side * c));
        let (sin, cos) = turn.sin_cos();
        format!("{} {}\n", cos * a - sin * b + x, sin * a + cos * b + y)
    };
    (0..=200).map(place).collect()
}

#[test]
fn a_blade_has_chords_twist_and_offset() {
    let folder = Folder::new();
    let nominal = folder.write("nominal.txt", blade(0.0, [0.0, 0.0]));
    let measured = folder.write("measured.txt", blade(0.03, [0.2, 0.5]));
    let words = ["section", measured.to_str().unwrap(), "--airfoil", "--nominal", nominal.to_str().unwrap()];
    let html = folder.file("blade.html");
    let answer = document([&words[..], &["--html", html.to_str().unwrap()]].concat());
    let m = &answer["airfoils"][0]["measures"];
    let names: Vec<&str> =
        m["chords"].as_array().unwrap().iter().map(|c| c["definition"].as_str().unwrap()).collect();
    assert_eq!(names, ["farthest", "camber_ends", "bitangent"]);
    for (k, within) in [(0, 3e-4), (1, 3e-3), (2, 3e-4)] {
        let twist = number(m, &format!("/chords/{k}/twist"));
        assert!((twist - 0.03).abs() < within, "{k}: {twist} {m}");
    }
    // The stacking point goes with the centroid.
    let (c, s) = (&m["centroid"], &m["stacking"]);
    assert_eq!(s["by"], "centroid");
    for k in 0..2 {
        let offset = number(c, &format!("/{k}")) - number(s, &format!("/point/{k}"));
        assert!((offset - number(s, &format!("/offset/{k}"))).abs() < 1e-12, "{m}");
    }
    // The origin is where the profile was moved by just what was planted.
    let given = document([&words[..], &["--stacking", "0,0"]].concat());
    let s = &given["airfoils"][0]["measures"]["stacking"];
    assert_eq!(s["by"], "given");
    assert!(
        (number(s, "/offset/0") - 0.2).abs() < 3e-3 && (number(s, "/offset/1") - 0.5).abs() < 3e-3,
        "{s}"
    );
    // Twist is that of the section as it lies.
    let fitted = document([&words[..], &["--fit", "free"]].concat());
    let twist = number(&fitted["airfoils"][0]["measures"], "/chords/0/twist");
    assert!((twist - 0.03).abs() < 3e-4, "{twist}");
    let table = stdout(&trueness(words));
    for part in ["chord by", "camber ends", "bitangent", "twist against the nominal", "stacking point"] {
        assert!(table.contains(part), "{part}: {table}");
    }
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(page.contains("Chord, flat tangent") && page.contains("Offset of the stacking point"));
    // Alone it has angles, no twist.
    let alone = document(["section", measured.to_str().unwrap(), "--airfoil"]);
    let m = &alone["airfoils"][0]["measures"];
    assert!(m["chords"][0]["twist"].is_null() && m["stacking"].is_null(), "{m}");
    assert!(
        (number(m, "/chords/0/angle") - number(&answer["airfoils"][0]["measures"], "/chords/0/angle")).abs()
            < 1e-12
    );
}

#[test]
fn offers_stand_in_document_table_and_report() {
    let folder = Folder::new();
    let file = folder.write("ell.txt", ell(0.01, 0.0, [0.0, 0.0], 0.0, 56.0));
    let html = folder.file("ell.html");
    let words = ["section", file.to_str().unwrap(), "--open"];
    let plain = document(words);
    assert!(plain["contours"][0]["tidy"].is_null());
    let mut answer = document([&words[..], &["--tidy", "--html", html.to_str().unwrap()]].concat());
    let all = answer["contours"][0]["tidy"].as_array().unwrap().clone();
    let has = |kind: &str, offered: f64| {
        all.iter().any(|o| o["kind"] == kind && (o["offered"].as_f64().unwrap() - offered).abs() < 1e-9)
    };
    assert!(has("right_angle", std::f64::consts::FRAC_PI_2), "{all:?}");
    assert!(has("horizontal", 0.0) && has("radius", 6.0), "{all:?}");
    // The contour stays as it was found.
    answer["contours"][0].as_object_mut().unwrap().remove("tidy");
    assert_eq!(answer["contours"], plain["contours"]);
    let table = stdout(&trueness([&words[..], &["--tidy"]].concat()));
    assert!(table.contains("right angle") && table.contains("offered"), "{table}");
    assert!(!stdout(&trueness(words)).contains("offered"));
    assert!(std::fs::read_to_string(&html).unwrap().contains("Relations of a drawing"));
}

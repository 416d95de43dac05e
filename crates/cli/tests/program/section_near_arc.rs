//! `trueness section` where form and noise cannot be told apart.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, stdout, trueness};

/// A circle whose form deviates more than its points scatter is a free curve that tells its arc; with the noise that the table names it is
/// that arc. A curve far from any arc tells none.
#[test]
fn a_curve_that_is_nearly_an_arc_tells_it() {
    let f = Folder::new();
    let row = |lobes: f64, depth: f64| {
        let place = |k: u32| {
            let turn = f64::from(k) / 180.0 * std::f64::consts::TAU;
            let scatter = 0.0005 * (f64::from(k * k % 97) / 97.0 - 0.5);
            let radius = 7.5 + depth * (lobes * turn).cos() + scatter;
            format!("{} {}\n", 3.0 + radius * turn.cos(), radius * turn.sin() - 2.0)
        };
        (0..180).map(place).collect::<String>()
    };
    let bore = f.write("bore.txt", row(3.0, 0.008));
    let segment = |words: &[&str]| {
        let d = document(["section", bore.to_str().unwrap()].iter().chain(words));
        assert_eq!(d["contours"][0]["segments"].as_array().unwrap().len(), 1);
        d["contours"][0]["segments"][0].clone()
    };
    let curve = segment(&[]);
    let arc = &curve["near_arc"];
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    assert_eq!(curve["kind"], "spline");
    assert!(
        (number(&arc["radius"]) - 7.5).abs() < 1e-3 && (number(&arc["max"]) - 0.008).abs() < 1e-3,
        "{arc}"
    );
    assert!((number(&arc["rms"]) - 0.008 / 2f64.sqrt()).abs() < 5e-4, "{arc}");
    let o = trueness(["section", bore.to_str().unwrap()]);
    let noise = stdout(&o).split("--noise ").nth(1).unwrap().split(' ').next().unwrap().to_string();
    let taken = segment(&["--noise", &noise]);
    assert!(taken["kind"] == "arc" && taken.get("near_arc").is_none(), "{taken}");
    let wavy = f.write("wavy.txt", row(3.0, 0.5));
    let d = document(["section", wavy.to_str().unwrap()]);
    assert!(d["contours"][0]["segments"].as_array().unwrap().iter().all(|s| s.get("near_arc").is_none()));
}

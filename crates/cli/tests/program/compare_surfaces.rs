//! `trueness compare` with B-spline surfaces as references.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stderr, stdout, trueness};
use std::path::Path;

/// A quarter of a cylinder of radius 10 about z, from z = 0 to 20, as another program may write it; its normal looks outward.
fn quarter() -> String {
    let h = 0.5f64.sqrt();
    format!(
        "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n\
         #1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.));\n#2=GLOBAL_UNIT_ASSIGNED_CONTEXT((#1));\n\
         #3=CARTESIAN_POINT('',(1.,0.,0.));\n#4=CARTESIAN_POINT('',(1.,0.,2.));\n\
         #5=CARTESIAN_POINT('',(1.,1.,0.));\n#6=CARTESIAN_POINT('',(1.,1.,2.));\n\
         #7=CARTESIAN_POINT('',(0.,1.,0.));\n#8=CARTESIAN_POINT('',(0.,1.,2.));\n\
         #10=(BOUNDED_SURFACE()B_SPLINE_SURFACE(2,1,((#3,#4),(#5,#6),(#7,#8)),.CYLINDRICAL_SURF.,.F.,.F.,.U.)\
         B_SPLINE_SURFACE_WITH_KNOTS((3,3),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)GEOMETRIC_REPRESENTATION_ITEM()\
         RATIONAL_B_SPLINE_SURFACE(((1.,1.),({h},{h}),(1.,1.)))REPRESENTATION_ITEM('')SURFACE());\n\
         ENDSEC;\nEND-ISO-10303-21;\n"
    )
}

/// Points over the quarter, at radii of 10 and these differences.
fn over_the_quarter(differences: &[f64]) -> String {
    let mut text = String::new();
    for (k, d) in differences.iter().enumerate() {
        let angle = 0.1 + 1.3 * k as f64 / differences.len() as f64;
        text +=
            &format!("{} {} {}\n", (10.0 + d) * angle.cos(), (10.0 + d) * angle.sin(), 1.0 + 0.1 * k as f64);
    }
    text
}

fn word(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn a_cylinder_has_its_closed_form() {
    let folder = Folder::new();
    let model = folder.write("quarter.stp", quarter());
    let differences: Vec<f64> = (0..100).map(|k| 0.3 * (f64::from(k) * 0.7).sin()).collect();
    let points = folder.write("points.xyz", over_the_quarter(&differences));
    let out = folder.file("d.csv");
    let words = ["compare", word(&points), word(&model), "--tolerance", "-0.2,+0.25", "--out", word(&out)];
    let answer = document(words);
    let c = &answer["comparisons"][0];
    assert_eq!((&c["sign"]["method"], &c["surfaces"]["count"]), (&"normal".into(), &1.into()));
    assert_eq!(c["surfaces"]["uncertain"], 0);
    assert_eq!(answer["inputs"][1]["unit_assumed"], "cm");
    assert_eq!(answer["inputs"][1]["format"], "step");
    let rows = std::fs::read_to_string(&out).unwrap();
    let found: Vec<f64> =
        rows.lines().skip(1).map(|l| l.split(',').nth(3).unwrap().parse().unwrap()).collect();
    assert_eq!(found.len(), 100);
    for (a, b) in found.iter().zip(&differences) {
        assert!((a - b).abs() < 1e-13, "{a} {b}");
    }
    let inside = differences.iter().filter(|d| (-0.2..=0.25).contains(*d)).count() as f64;
    assert!((c["tolerance"]["inside"].as_f64().unwrap() - inside / 100.0).abs() < 1e-12);
    let worst = &c["worst"][0];
    let (nearest, normal) = (&worst["nearest"], &worst["normal"]);
    let radius = nearest[0].as_f64().unwrap().hypot(nearest[1].as_f64().unwrap());
    assert!((radius - 10.0).abs() < 1e-13);
    assert!((normal[0].as_f64().unwrap() * 10.0 - nearest[0].as_f64().unwrap()).abs() < 1e-12);
    let shown = stdout(&trueness(["compare", word(&points), word(&model), "-v"]));
    assert!(shown.contains("1 exact surface, measured against directly"), "{shown}");
    // Without a sign they are distances.
    let unsigned = document(["compare", word(&points), word(&model), "--sign", "none"]);
    assert!(unsigned["comparisons"][0]["deviation"]["all"]["min"].as_f64().unwrap() >= 0.0);
}

#[test]
fn points_beside_the_surface_are_excluded_when_asked() {
    let folder = Folder::new();
    let model = folder.write("quarter.step", quarter());
    let points = folder.write("points.xyz", over_the_quarter(&[0.1, 0.2]) + "11 0 25\n0.5 11 5\n-3 10 5\n");
    let all = document(["compare", word(&points), word(&model)]);
    assert_eq!(all["comparisons"][0]["deviation"]["all"]["count"], 5);
    let some =
        document(["compare", word(&points), word(&model), "--skip-boundary", "--max-distance", "3.05"]);
    let excluded = &some["comparisons"][0]["excluded"];
    assert_eq!((&excluded["free_edge"], &excluded["max_distance"]), (&1.into(), &1.into()));
    // That over z = 20 is 1 outward and 5 up.
    let farthest = all["comparisons"][0]["deviation"]["all"]["max"].as_f64().unwrap();
    assert!((farthest - 26f64.sqrt()).abs() < 1e-13, "{farthest}");
}

#[test]
fn a_fitted_surface_is_the_same_from_document_step_and_iges() {
    let folder = Folder::new();
    let wave = |k: u32| {
        let (x, y) = (f64::from(k % 60) + 0.3, f64::from(k / 60) + 0.1);
        let odd = f64::from(k.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5;
        format!("{x} {y} {}\n", 3.0 * (0.1 * x).sin() * (0.15 * y).cos() + 0.1 * odd)
    };
    let points = folder.write("wave.xyz", (0..2400).map(wave).collect::<String>());
    let [json, step, iges, obj] = ["s.json", "s.stp", "s.igs", "s.obj"].map(|n| folder.file(n));
    let o = trueness([
        "surface",
        word(&points),
        "--json",
        word(&json),
        "--step",
        word(&step),
        "--iges",
        word(&iges),
        "--obj",
        word(&obj),
    ]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let out = folder.file("d.csv");
    let references = [&json, &step, &iges, &obj].map(|p| word(p));
    let words = ["compare", word(&points)].into_iter().chain(references);
    let html = folder.file("r.html");
    let all: Vec<&str> = words.chain(["--out", word(&out), "--html", word(&html), "--both"]).collect();
    let refused = trueness(&all);
    assert_eq!(status(&refused), 2, "points have no facets to measure back to");
    let answer = document(&all[..all.len() - 1]);
    let deviations = |n: u32| std::fs::read(folder.file(&format!("d.{n}.csv"))).unwrap();
    assert!(deviations(1) == deviations(2) && deviations(1) == deviations(3));
    assert!(deviations(1) != deviations(4), "facets are no surface");
    // The fit says the same of its points.
    let fit: serde_json::Value = serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap();
    for key in ["min", "max", "rms", "mean", "median"] {
        let [a, b] = [&fit["deviation"][key], &answer["comparisons"][0]["deviation"]["all"][key]];
        assert!((a.as_f64().unwrap() - b.as_f64().unwrap()).abs() < 1e-12, "{key} {a} {b}");
    }
    let first = std::fs::read(&html).unwrap();
    assert!(first.len() > 100_000);
    let again = trueness(all[..all.len() - 1].iter().chain(&["--threads", "1"]));
    assert_eq!(status(&again), 0, "{}", stderr(&again));
    assert!(std::fs::read(&html).unwrap() == first, "the same bytes on one thread");
}

#[test]
fn wrong_questions_are_refused() {
    let folder = Folder::new();
    let model = folder.write("quarter.step", quarter());
    let points = folder.write("points.xyz", over_the_quarter(&[0.1, 0.2, 0.3]));
    let said = |words: &[&str], code: i32, wanted: &str| {
        let o = trueness(words);
        assert_eq!(status(&o), code, "{words:?} {}", stderr(&o));
        assert!(stderr(&o).contains(wanted), "{words:?} {}", stderr(&o));
    };
    let (p, m) = (word(&points), word(&model));
    said(&["compare", p, m, "--method", "paper"], 2, "B-spline surfaces");
    said(&["compare", p, m, "--sign", "winding"], 2, "take auto");
    said(&["check", m], 3, "this command needs a mesh");
    said(&["compare", m, m], 3, "this command needs a mesh or points");
    let empty =
        folder.write("empty.step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n");
    said(&["compare", p, word(&empty)], 3, "the file holds no shape");
    let cut = folder.write("cut.step", &quarter()[..500]);
    said(&["compare", p, word(&cut)], 3, "line");
    let other = folder.write(
        "other.json",
        r#"{"schema": "trueness/fit/1", "degree": [1,1], "knots": {"u": [], "v": []}, "control_points": []}"#,
    );
    said(&["compare", p, word(&other)], 3, "trueness/fit/1");
    let odd = folder.write("odd.json", r#"{"vertices": 3}"#);
    said(&["compare", p, word(&odd)], 3, "trueness surface --json");
    let knots = r#"{"schema": "trueness/surface/1", "units": "mm", "degree": [1,1], "knots": {"u": [0,0,1,1], "v": [0,0,1,1]}, "control_points": [[[0,0,0],[0,1,0]],[[1,0,0]]]}"#;
    said(&["compare", p, word(&folder.write("few.json", knots))], 3, "control_points[1] has 1 points");
    let inches = knots.replace("\"mm\"", "\"in\"");
    said(
        &["compare", p, word(&folder.write("inches.json", &inches))],
        3,
        "its units are in; documents of surfaces are in mm",
    );
}

//! `trueness surface` over bases that points fold or stand over.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stderr, stdout, trueness};

/// A pipe of 300°, as a mesh, with a wave of 0.02 mm on it: it folds over any plane, and is fitted over its own facets.
#[test]
fn a_pipe_is_fitted_over_its_facets() {
    let folder = Folder::new();
    let mut text = String::new();
    for k in 0..101 * 31 {
        let (angle, z) = (f64::from(k % 101) / 100.0 * 300f64.to_radians(), f64::from(k / 101));
        let r = 20.0 + 0.02 * (3.0 * angle + 0.2 * z).sin();
        text += &format!("v {:.9} {:.9} {z:.9}\n", r * angle.cos(), r * angle.sin());
    }
    for k in (0..101 * 30).filter(|k| k % 101 < 100) {
        let a = k + 1;
        text += &format!("f {a} {} {}\nf {a} {} {}\n", a + 1, a + 102, a + 102, a + 101);
    }
    let pipe = folder.write("pipe.obj", text);
    let pipe = pipe.to_str().unwrap();
    let file = |name: &str| folder.file(name).to_str().unwrap().to_string();
    let (json, html, step) = (file("a.json"), file("a.html"), file("a.stp"));
    let o = trueness([
        "surface", pipe, "--base", "mesh", "--spans", "16x6", "--trim", "--json", &json, "--html", &html,
        "--step", &step,
    ]);
    assert_eq!(status(&o), 0, "{}{}", stdout(&o), stderr(&o));
    assert!(
        stdout(&o).contains("base mesh, laid flat: lengths 0.999 to 1.001 of what they are"),
        "{}",
        stdout(&o)
    );
    let answer: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
    assert_eq!(answer["base"]["kind"], "mesh");
    assert!(answer["deviation"]["rms"].as_f64().unwrap() < 1e-3, "{}", answer["deviation"]);
    assert!(answer["trim"]["share"].as_f64().unwrap() > 0.99, "{}", answer["trim"]);
    assert_eq!(answer["warnings"], serde_json::json!([]));
    // The domain is the pipe unrolled: 300° of 20 mm, 30 mm high.
    let knots = |name: &str| answer["knots"][name].as_array().unwrap().last().unwrap().as_f64().unwrap();
    assert!((knots("u") - 104.7).abs() < 0.1 && (knots("v") - 30.0).abs() < 0.1, "{}", answer["knots"]);
    // Its normal looks outward, as that of the facets.
    assert!(
        (answer["curvature"]["k2"]["median"].as_f64().unwrap() + 0.05).abs() < 1e-3,
        "{}",
        answer["curvature"]
    );
    // What was written is the surface.
    let compared = document(["compare", pipe, &step]);
    assert!(compared["comparisons"][0]["deviation"]["all"]["rms"].as_f64().unwrap() < 1e-3);
    // Over a plane it lies in layers, or stands on edge.
    let o = trueness(["surface", pipe]);
    assert_eq!(status(&o), 1, "{}", stdout(&o));
    let (mut cube, corner) = (String::new(), |k: usize| [k & 1, k >> 1 & 1, k >> 2 & 1]);
    (0..8).map(corner).for_each(|[x, y, z]| cube += &format!("v {x} {y} {z}\n"));
    for [a, b, c, d] in [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] {
        cube += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
    }
    let cube = folder.write("cube.obj", cube);
    let o = trueness(["surface", cube.to_str().unwrap(), "--base", "mesh"]);
    assert_eq!(status(&o), 3);
    assert!(
        stderr(&o).contains("cube.obj: the mesh is closed, it has no rim to be laid out from"),
        "{}",
        stderr(&o)
    );
}

/// A sock is laid flat with its toe crushed: the knots do not tell one place there from the next.
#[test]
fn a_mesh_that_is_crushed_as_it_is_laid_flat_leaves_the_surface_undecided() {
    let folder = Folder::new();
    let sock = |length: u32| {
        let mut text = "v 0 0 -10\n".to_string();
        let rows = 8 + length / 2;
        for row in 1..=rows {
            let angle = std::f64::consts::FRAC_PI_2 * f64::from(row.min(8)) / 8.0;
            let (radius, height) =
                (10.0 * angle.sin(), -10.0 * angle.cos() + 2.0 * f64::from(row.max(8) - 8));
            for k in 0..32 {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 32.0).sin_cos();
                text += &format!("v {} {} {height}\n", radius * cos, radius * sin);
            }
        }
        for k in 0..32 {
            let next = (k + 1) % 32;
            text += &format!("f 1 {} {}\n", next + 2, k + 2);
            for row in 0..rows - 1 {
                let [a, b] = [k, next].map(|k| 2 + 32 * row + k);
                text += &format!("f {a} {b} {}\nf {a} {} {}\n", b + 32, b + 32, a + 32);
            }
        }
        folder.write(&format!("sock{length}.obj"), text)
    };
    for (length, is_crushed) in [(10, false), (30, false), (100, true), (200, true)] {
        let o = trueness(["surface", sock(length).to_str().unwrap(), "--base", "mesh"]);
        assert_eq!(status(&o), i32::from(is_crushed), "{length}: {}", stdout(&o));
        assert_eq!(stdout(&o).contains("the surface may cross itself there"), is_crushed, "{}", stdout(&o));
    }
}

/// A strip narrower than its ripples is fitted flat, and said to be; a fence stands on edge, whatever the plane.
#[test]
fn what_stands_on_edge_is_told() {
    let folder = Folder::new();
    let odd = |k: u32, n: u32| {
        f64::from(k.wrapping_mul(2_654_435_761).wrapping_add(n * 40_503_311) >> 8 & 0xffff) / 65536.0
    };
    let (mut strip, mut fence) = (String::new(), String::new());
    for k in 0..4000 {
        let (x, y) = (100.0 * odd(k, 0), 0.5 * f64::from(k % 83) / 82.0);
        strip += &format!("{x} {y} {}\n", 0.3 * (x / 7.0).sin() + 0.2 * (y / 5.0).cos());
        let angle = std::f64::consts::TAU * odd(k, 0);
        fence +=
            &format!("{} {} {}\n", 50.0 * angle.cos(), 50.0 * angle.sin(), 10.0 * f64::from(k % 83) / 82.0);
    }
    let o = trueness(["surface", folder.write("strip.xyz", strip).to_str().unwrap(), "--spans", "12x2"]);
    let text = stdout(&o);
    assert_eq!(status(&o), 0, "{text}");
    assert!(text.contains("from the least-squares plane, over which it folds or stands on edge"), "{text}");
    assert!(
        text.contains("the points lie in a strip of 99.9") || text.contains("control points 15x5"),
        "{text}"
    );
    let file = folder.write("fence.xyz", fence);
    let o = trueness(["surface", file.to_str().unwrap()]);
    let text = stdout(&o);
    assert_eq!(status(&o), 1, "{text}");
    assert!(text.contains("100.0 % of the points stand on edge on the base (plane)"), "{text}");
    let answer = document(["surface", file.to_str().unwrap(), "--base", "cylinder"]);
    assert_eq!(answer["base"]["standing_share"], 0.0);
}

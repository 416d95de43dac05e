//! Drawings as nominals of sections, and contours that cross themselves.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod common;

use common::{Folder, document, status, stderr, stdout, trueness};

/// A drawing of these groups, with the unit's number.
fn drawing(unit: u32, entities: &str) -> String {
    let groups: String = entities.split_whitespace().map(|w| format!("{w}\n")).collect();
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{groups}0\nENDSEC\n0\nEOF\n"
    )
}

/// Points around a rectangle of 40 by 20 with corners of radius 5, `off` outside of it; every `step`.
fn rounded(off: f64, step: f64) -> Vec<[f64; 2]> {
    let mut all = vec![];
    for (center, side, from) in [
        ([35.0, 5.0], 10.0, -90.0_f64),
        ([35.0, 15.0], 30.0, 0.0),
        ([5.0, 15.0], 10.0, 90.0),
        ([5.0, 5.0], 30.0, 180.0),
    ] {
        let r = 5.0 + off;
        let turns = (0.5 * std::f64::consts::PI * r / step).ceil() as u32;
        for i in 0..turns {
            let a = from.to_radians() + 0.5 * std::f64::consts::PI * f64::from(i) / f64::from(turns);
            all.push([center[0] + r * a.cos(), center[1] + r * a.sin()]);
        }
        let (c, s) = ((from + 90.0).to_radians().cos(), (from + 90.0).to_radians().sin());
        let steps = (side / step).ceil() as u32;
        for i in 0..steps {
            let t = side * f64::from(i) / f64::from(steps);
            all.push([center[0] + r * c - t * s, center[1] + r * s + t * c]);
        }
    }
    all
}

fn text(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x} {y}\n")).collect()
}

#[test]
fn points_are_measured_against_a_drawing() {
    let folder = Folder::new();
    // tan(90° / 4): quarters of circles. In inches, begun anywhere, clockwise.
    let bulge = -(22.5_f64.to_radians()).tan();
    let at = |x: f64, y: f64, b: f64| format!("10 {} 20 {} 42 {b} ", x / 25.4, y / 25.4);
    let vertices = [
        at(0.0, 5.0, 0.0),
        at(0.0, 15.0, bulge),
        at(5.0, 20.0, 0.0),
        at(35.0, 20.0, bulge),
        at(40.0, 15.0, 0.0),
        at(40.0, 5.0, bulge),
        at(35.0, 0.0, 0.0),
        at(5.0, 0.0, bulge),
    ];
    let outline = format!("0 LWPOLYLINE 8 0 90 8 70 1 {}", vertices.concat());
    let inch = folder.write("inch.dxf", drawing(1, &format!("{outline} 0 TEXT 1 hello")));
    for off in [0.25, -0.25] {
        let file = folder.write("row.txt", text(&rounded(off, 0.3)));
        let answer = document(["section", file.to_str().unwrap(), "--nominal", inch.to_str().unwrap()]);
        let nominal = &answer["nominal"];
        assert_eq!((&nominal["outline"], &nominal["positive"]), (&"drawing".into(), &"outside".into()));
        let all = nominal["deviations"][0].as_array().unwrap();
        assert!(all.iter().all(|d| (d.as_f64().unwrap() - off).abs() < 1e-9), "{off} {all:?}");
        assert_eq!(answer["inputs"][1]["unit_assumed"], "in");
        assert!(answer["inputs"][1]["warnings"][0].as_str().unwrap().contains("1 TEXT"));
    }
    // The same outline as lines and arcs in millimeters, in any order and direction, with a hole in it that is drawn twice.
    let arcs = "0 ARC 10 35 20 5 40 5 50 270 51 0 0 ARC 10 5 20 15 40 5 50 90 51 180 0 ARC 10 35 20 15 40 5 50 0 51 90 0 ARC 10 5 20 5 40 5 50 180 51 270";
    let lines = "0 LINE 10 5 20 0 11 35 21 0 0 LINE 10 0 20 5 11 0 21 15 0 LINE 10 35 20 20 11 5 21 20 0 LINE 10 40 20 15 11 40 21 5";
    let hole = "0 CIRCLE 10 20 20 10 40 4 0 CIRCLE 10 20 20 10 40 4";
    let holed = folder.write("holed.dxf", drawing(4, &format!("{arcs} {hole} {lines}")));
    let ring: Vec<[f64; 2]> =
        (0..90).map(|i| f64::from(i) * 0.07).map(|a| [20.0 + 3.5 * a.cos(), 10.0 + 3.5 * a.sin()]).collect();
    let file = folder.write("ring.txt", text(&ring));
    let answer = document(["section", file.to_str().unwrap(), "--nominal", holed.to_str().unwrap()]);
    let all = answer["nominal"]["deviations"][0].as_array().unwrap();
    assert!(
        all.iter().all(|d| (d.as_f64().unwrap() - 0.5).abs() < 1e-9),
        "within the hole is outside of the material"
    );
}

/// What a section writes is a nominal of the same section: of points, and of several planes by its layers.
#[test]
fn a_section_is_its_own_nominal() {
    let folder = Folder::new();
    let row = folder.write("row.txt", text(&rounded(0.0, 0.3)));
    let cube = folder.write("cube.off", common::CUBE);
    let dxf = folder.file("own.dxf");
    let dxf = dxf.to_str().unwrap();
    let planes = ["--stack", "1,2,3,0.05,0.35,0.1"];
    for words in [vec![row.to_str().unwrap()], [&[cube.to_str().unwrap()][..], &planes].concat()] {
        document([&["section"][..], &words, &["--dxf", dxf]].concat());
        let answer = document([&["section"][..], &words, &["--nominal", dxf]].concat());
        let nominal = &answer["nominal"];
        let all: Vec<f64> = (nominal["deviations"].as_array().unwrap().iter())
            .flat_map(|c| c.as_array().unwrap().iter().map(|d| d.as_f64().unwrap()))
            .collect();
        assert!(all.len() > 10 && all.iter().all(|d| d.abs() < 1e-6), "{all:?}");
    }
}

#[test]
fn drawings_that_are_no_nominal_are_refused() {
    let folder = Folder::new();
    let row = folder.write("row.txt", text(&rounded(0.0, 0.3)));
    let row = row.to_str().unwrap();
    let tie = "0 LWPOLYLINE 90 4 70 1 10 0 20 0 10 20 20 20 10 20 20 0 10 0 20 20";
    for (name, entities, word) in [
        ("tie.dxf", tie, "crosses itself at (10.0000, 10.0000)"),
        ("text.dxf", "0 TEXT 1 hello", "neither lines nor arcs"),
        ("bad.dxf", "0 LINE 10 0 20 nan 11 1 21 0", "line 20"),
    ] {
        let file = folder.write(name, drawing(4, entities));
        let answer = trueness(["section", row, "--nominal", file.to_str().unwrap()]);
        assert_eq!(status(&answer), 3, "{name}: {}", stderr(&answer));
        assert!(stderr(&answer).contains(word) && stderr(&answer).contains(name), "{}", stderr(&answer));
    }
    let file = folder.write("good.dxf", drawing(4, "0 CIRCLE 10 0 20 0 40 1"));
    for words in [vec!["check", file.to_str().unwrap()], vec!["section", file.to_str().unwrap()]] {
        let answer = trueness(&words);
        assert_eq!(status(&answer), 3, "{}", stderr(&answer));
        assert!(stderr(&answer).contains("drawings are nominals"), "{}", stderr(&answer));
    }
    let cube = folder.write("cube.off", common::CUBE);
    let planes = ["section", cube.to_str().unwrap(), "--stack", "0,0,1,0.2,0.8,0.3"];
    let answer = trueness([&planes[..], &["--nominal", file.to_str().unwrap()]].concat());
    assert_eq!(status(&answer), 2, "{}", stderr(&answer));
    assert!(stderr(&answer).contains("section-1"), "{}", stderr(&answer));
}

/// A figure of eight is told, is no profile and no nominal.
#[test]
fn contours_that_cross_themselves_are_told() {
    let folder = Folder::new();
    let eight: Vec<[f64; 2]> = (0..300)
        .map(|i| (f64::from(i) + 0.4) * std::f64::consts::TAU / 300.0)
        .map(|a| [30.0 * a.sin(), 10.0 * a.sin() * a.cos()])
        .collect();
    let file = folder.write("eight.txt", text(&eight));
    let file = file.to_str().unwrap();
    let answer = document(["section", file, "--airfoil"]);
    let crossings = answer["contours"][0]["crossings"].as_array().unwrap();
    let at = |k: usize| crossings[0][k].as_f64().unwrap();
    assert!(crossings.len() == 1 && at(0).abs() < 1e-2 && at(1).abs() < 1e-2, "{crossings:?}");
    let reason = answer["airfoils"][0]["measures_reason"].as_str().unwrap();
    assert!(reason.contains("crosses itself"), "{reason}");
    let table = trueness(["section", file]);
    assert!(stdout(&table).contains("! the contour crosses itself at ("), "{}", stdout(&table));
    let row = folder.write("row.txt", text(&rounded(0.0, 0.3)));
    let refused = trueness(["section", row.to_str().unwrap(), "--nominal", file]);
    assert_eq!(status(&refused), 3, "{}", stderr(&refused));
    assert!(stderr(&refused).contains("crosses itself"), "{}", stderr(&refused));
}

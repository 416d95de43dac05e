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

/// A hole that no point is near to, and the half of an outline where there are no points, in document, table and report.
#[test]
fn what_of_a_nominal_was_not_measured_is_told() {
    let folder = Folder::new();
    let outline = "0 LWPOLYLINE 90 4 70 1 10 0 20 0 10 40 20 0 10 40 20 20 10 0 20 20";
    let file = folder.write("holed.dxf", drawing(4, &format!("0 CIRCLE 10 20 20 12 40 4 {outline}")));
    let (nominal, html) = (file.to_str().unwrap(), folder.file("report.html"));
    // From the middle of the lower side, every half millimeter, to the right; 0.01 inside.
    let at = |s: f64| match (s + 20.0) % 120.0 {
        s if s < 40.0 => [s, 0.01],
        s if s < 60.0 => [39.99, s - 40.0],
        s if s < 100.0 => [100.0 - s, 19.99],
        s => [0.01, 120.0 - s],
    };
    let row = |count: u32| -> Vec<[f64; 2]> { (0..count).map(|i| at(0.5 * f64::from(i) + 0.25)).collect() };
    // Of the half: 120 points, 119 steps of half a millimeter.
    for (count, covered, told) in [(240, 1.0, "100"), (120, 59.5 / 120.0, "50")] {
        let points = folder.write("row.txt", text(&row(count)));
        let words = ["section", points.to_str().unwrap(), "--nominal", nominal];
        let answer = document(words);
        let outlines = answer["nominal"]["outlines"].as_array().unwrap();
        assert_eq!(outlines.len(), 2);
        let (holes, others): (Vec<_>, Vec<_>) = outlines.iter().partition(|o| o["hole"].as_bool().unwrap());
        assert_eq!((&holes[0]["covered"], &holes[0]["points"]), (&0.0.into(), &0.into()));
        let near = |list: &serde_json::Value, wanted: [f64; 2]| {
            (0..2).all(|k| (list[k].as_f64().unwrap() - wanted[k]).abs() < 1e-9)
        };
        assert!(near(&holes[0]["center"], [20.0, 12.0]) && near(&holes[0]["size"], [8.0; 2]), "{holes:?}");
        assert!((others[0]["covered"].as_f64().unwrap() - covered).abs() < 1e-3, "{others:?}");
        assert_eq!(others[0]["points"], count);
        let html = html.to_str().unwrap();
        let table = stdout(&trueness([&words[..], &["--html", html]].concat()));
        let hole = "of the nominal was not measured (a hole of about 8.000 × 8.000 at 20.000 12.000)";
        assert!(table.lines().any(|l| l.starts_with("! contour ") && l.ends_with(hole)), "{table}");
        let half = format!("of the nominal was measured over {told} % of its length (about 40.000 × 20.000");
        assert_eq!(table.contains(&half), covered < 1.0, "{table}");
        let report = std::fs::read_to_string(html).unwrap();
        assert_eq!(report.matches("class=\"nominal missed\"").count(), 1);
    }
    // Of a mesh that two planes cut where the part has one contour and none.
    let cube = folder.write("cube.off", common::CUBE);
    let flat = common::CUBE.replace("0 0 1\n1 0 1\n0 1 1\n1 1 1\n", "0 0 0.5\n1 0 0.5\n0 1 0.5\n1 1 0.5\n");
    let low = folder.write("low.off", flat);
    let planes = ["section", low.to_str().unwrap(), "--plane", "0,0,1,0.25", "--plane", "0,0,1,0.75"];
    let words = [&planes[..], &["--nominal", cube.to_str().unwrap()]].concat();
    let answer = document(&words);
    let covered: Vec<f64> = (answer["nominal"]["outlines"].as_array().unwrap().iter())
        .map(|o| o["covered"].as_f64().unwrap())
        .collect();
    assert_eq!(covered, [1.0, 0.0]);
    let table = stdout(&trueness(&words));
    assert!(
        table.contains("! contour 2 in plane 2 of the nominal was not measured (about 1.000 × 1.000"),
        "{table}"
    );
}

/// A drawing in another unit than it says is noticed by its size.
#[test]
fn a_nominal_in_another_unit_is_told() {
    let folder = Folder::new();
    let row = folder.write("row.txt", text(&rounded(0.0, 0.3)));
    let outline = "0 LWPOLYLINE 90 4 70 1 10 0 20 0 10 40 20 0 10 40 20 20 10 0 20 20";
    for (unit, times) in
        [(4, None), (1, Some("25.4 times smaller")), (5, Some("10.0 times smaller")), (6, Some("1000 times"))]
    {
        let file = folder.write("drawn.dxf", drawing(unit, outline));
        let words = ["section", row.to_str().unwrap(), "--nominal", file.to_str().unwrap()];
        let (answer, table) = (document(words), stdout(&trueness(words)));
        let warnings = answer["nominal"]["warnings"].as_array();
        let Some(times) = times else {
            assert!(warnings.is_none() && !table.contains("is a unit wrong"), "{table}");
            continue;
        };
        let warning = &warnings.unwrap()[0];
        assert_eq!(warning["kind"], "size_ratio");
        let text = warning["text"].as_str().unwrap();
        assert!(text.contains(times) && text.contains("--reference-units"), "{text}");
        assert!(table.contains(&format!("! {text}")), "{table}");
    }
}

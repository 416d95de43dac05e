//! Drawings as nominals of sections, and contours that cross themselves.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stderr, stdout, trueness};

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
    let cube = folder.write("cube.off", crate::common::CUBE);
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
    let cube = folder.write("cube.off", crate::common::CUBE);
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
        // The hole, and the half.
        assert_eq!(report.matches("class=\"nominal missed\"").count(), if covered < 1.0 { 2 } else { 1 });
    }
    // Of a mesh that two planes cut where the part has one contour and none.
    let cube = folder.write("cube.off", crate::common::CUBE);
    let flat =
        crate::common::CUBE.replace("0 0 1\n1 0 1\n0 1 1\n1 1 1\n", "0 0 0.5\n1 0 0.5\n0 1 0.5\n1 1 0.5\n");
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

/// Points in three columns, exactly in a plane and scattered about it, far off along its normal: their coordinates are the first two, as a
/// drawing has them.
#[test]
fn rows_in_space_have_the_axes_of_their_plane() {
    let folder = Folder::new();
    let lines = "0 LWPOLYLINE 90 8 70 1 10 0 20 5 10 0 20 15 42 B 10 5 20 20 10 35 20 20 42 B 10 40 20 15 10 40 20 5 42 B 10 35 20 0 10 5 20 0 42 B";
    let outline = lines.replace('B', &(-(22.5_f64.to_radians()).tan()).to_string());
    let nominal = folder.write("rounded.dxf", drawing(4, &outline));
    for (height, scatter) in [(5.0, 0.0), (0.1, 0.0), (-123.4, 0.0), (5.0, 0.01), (800.0, 0.01)] {
        // Scatter without a pattern that a plane could follow.
        let z = |i: usize| height + scatter * (f64::from(i as u32 * 37 % 101) / 50.0 - 1.0);
        let rows = rounded(0.25, 0.3);
        let row: String = rows.iter().enumerate().map(|(i, [x, y])| format!("{x},{y},{}\n", z(i))).collect();
        let row = folder.write("row.csv", row);
        let answer = document(["section", row.to_str().unwrap(), "--nominal", nominal.to_str().unwrap()]);
        let all = answer["nominal"]["deviations"][0].as_array().unwrap();
        assert!(all.iter().all(|d| (d.as_f64().unwrap() - 0.25).abs() < 1e-9), "{height} {scatter}: {all:?}");
    }
}

/// An outline that a hair is missing of is open; the hole within it stays a hole, and all is told.
#[test]
fn a_hair_of_a_gap_turns_no_other_outline() {
    let folder = Folder::new();
    let outline = "0 LWPOLYLINE 90 5 70 0 10 0.001 20 0 10 40 20 0 10 40 20 20 10 0 20 20 10 0 20 0";
    let file = folder.write("gap.dxf", drawing(4, &format!("0 CIRCLE 10 20 20 10 40 4 {outline}")));
    let ring: Vec<[f64; 2]> =
        (0..90).map(|i| f64::from(i) * 0.07).map(|a| [20.0 + 3.5 * a.cos(), 10.0 + 3.5 * a.sin()]).collect();
    let side: Vec<[f64; 2]> = (0..60).map(|i| [5.0 + 0.5 * f64::from(i), 0.1]).collect();
    for (points, positive, off, told) in
        [(ring, "outside", 0.5, ", + outside\n"), (side, "left", 0.1, ", + left of the nominal\n")]
    {
        let points = folder.write("row.txt", text(&points));
        let words = ["section", points.to_str().unwrap(), "--nominal", file.to_str().unwrap()];
        let answer = document(words);
        let nominal = &answer["nominal"];
        assert_eq!(nominal["positive"], positive);
        let all = nominal["deviations"][0].as_array().unwrap();
        assert!(all.iter().all(|d| (d.as_f64().unwrap() - off).abs() < 1e-9), "{all:?}");
        let warning = &nominal["warnings"][0];
        assert_eq!(warning["kind"], "nearly_closed");
        assert!((warning["value"].as_f64().unwrap() - 0.001).abs() < 1e-12);
        let table = stdout(&trueness(words));
        assert!(
            table.contains("is open by 0.0010 mm at (0.0010, 0.0000)") && table.contains(told),
            "{table}"
        );
    }
}

/// How near an ellipse is followed does not depend on what else is drawn.
#[test]
fn a_small_ellipse_in_a_large_drawing_is_measured_as_alone() {
    let folder = Folder::new();
    let ellipse = "0 ELLIPSE 10 0 20 0 11 3 21 0 40 0.5";
    let file = folder.write("both.dxf", drawing(4, &format!("{ellipse} 0 CIRCLE 10 0 20 0 40 20000")));
    let on: Vec<[f64; 2]> = (0..200)
        .map(|i| std::f64::consts::TAU * f64::from(i) / 200.0)
        .map(|a| [3.0 * a.cos(), 1.5 * a.sin()])
        .collect();
    let points = folder.write("row.txt", text(&on));
    let answer = document(["section", points.to_str().unwrap(), "--nominal", file.to_str().unwrap()]);
    let all = answer["nominal"]["deviations"][0].as_array().unwrap();
    // A millionth of a quarter's size is 3.4e-6.
    assert!(all.iter().all(|d| d.as_f64().unwrap().abs() < 5e-6), "{all:?}");
}

/// Of a drawing of several sections one plane is compared with the first, and what is passed over is told.
#[test]
fn one_plane_has_the_first_layer_of_several() {
    let folder = Folder::new();
    let cube = folder.write("cube.off", crate::common::CUBE);
    let cube = cube.to_str().unwrap();
    let dxf = folder.file("own.dxf");
    let dxf = dxf.to_str().unwrap();
    document(["section", cube, "--stack", "1,2,3,0.05,0.35,0.1", "--dxf", dxf]);
    for (distance, off) in [("0.05", false), ("0.15", true)] {
        let plane = format!("1,2,3,{distance}");
        let words = ["section", cube, "--plane", &plane, "--nominal", dxf];
        let answer = document(words);
        let nominal = &answer["nominal"];
        assert_eq!(nominal["outlines"].as_array().unwrap().len(), 1);
        let all = nominal["deviations"][0].as_array().unwrap();
        assert_eq!(all.iter().any(|d| d.as_f64().unwrap().abs() > 1e-6), off, "{all:?}");
        let warnings = nominal["warnings"].as_array().unwrap();
        let told = warnings.iter().find(|w| w["kind"] == "layers_passed_over").unwrap();
        let text = told["text"].as_str().unwrap();
        assert!(
            text.contains("section-2 (") && text.contains("section-4 (") && !text.contains("section-1 (")
        );
        assert!(stdout(&trueness(words)).contains(text));
    }
    let layers = "0 CIRCLE 8 section-2 10 0 20 0 40 1 0 CIRCLE 8 section-3 10 0 20 0 40 2";
    let file = folder.write("others.dxf", drawing(4, layers));
    let answer = trueness(["section", cube, "--plane", "0,0,1,0.5", "--nominal", file.to_str().unwrap()]);
    assert!(
        status(&answer) == 2 && stderr(&answer).contains("none is named section-1"),
        "{}",
        stderr(&answer)
    );
}

/// What is refused says what there is, and what to do.
#[test]
fn refusals_of_a_nominal_say_what_there_is() {
    let folder = Folder::new();
    let row = folder.write("row.txt", text(&rounded(0.0, 0.3)));
    let cube = folder.write("cube.off", crate::common::CUBE);
    let tall = crate::common::CUBE
        .replace("0 0 0\n1 0 0\n0 1 0\n1 1 0\n", "0 0 -1\n1 0 -1\n0 1 -1\n1 1 -1\n")
        .replace("0 0 1\n1 0 1\n0 1 1\n1 1 1\n", "0 0 4\n1 0 4\n0 1 4\n1 1 4\n");
    let tall = folder.write("tall.off", tall);
    let [row, cube, tall] = [&row, &cube, &tall].map(|file| file.to_str().unwrap());
    let blocks = folder.write("blocks.dxf", drawing(4, "0 INSERT 2 part 10 0 20 0 0 TEXT 1 hello"));
    let fit = folder.write("fit.dxf", drawing(4, "0 SPLINE 71 3 11 1 21 1 31 0 11 1 21 1 31 0"));
    let [blocks, fit] = [&blocks, &fit].map(|file| file.to_str().unwrap());
    let at = |z: &'static str| ["section", tall, "--plane", z, "--nominal", cube];
    for (words, told) in [
        (
            vec!["section", row, "--nominal", blocks],
            "1 INSERT of `PART`, a block that is not in the file, 1 TEXT",
        ),
        (vec!["section", row, "--nominal", blocks], "explode"),
        (vec!["section", row, "--nominal", fit], "control points"),
        (at("0,0,1,2").to_vec(), "it reaches from 0 to 1 mm, and the first plane lies at 2; bring"),
        (at("0,0,1,2").to_vec(), "--reference-units"),
        (at("0,0,1,0").to_vec(), "only touches"),
    ] {
        let answer = trueness(&words);
        assert!(stderr(&answer).contains(told), "{}", stderr(&answer));
        assert_eq!(stderr(&answer).matches("export it").count(), usize::from(words.contains(&fit)));
    }
    let html = folder.file("report.html");
    let report = |mb| trueness(["section", row, "--html", html.to_str().unwrap(), "--html-budget", mb]);
    assert!(stderr(&report("0.3")).contains("a number of MB, 2 or more"), "{}", stderr(&report("0.3")));
    assert_eq!(status(&report("2.5")), 0);
}

//! `trueness section` as users run it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod common;

use common::{Folder, document, status, stderr, stdout, trueness};

/// A line of length 10, a quarter of a circle of radius 5, a line of length 6; two columns.
fn profile() -> String {
    let mut text = String::new();
    (0..100).for_each(|i| text += &format!("{} 0\n", 0.1 * f64::from(i)));
    for i in 0..=78 {
        let a = 0.02 * f64::from(i) + 0.005;
        text += &format!("{} {}\n", 10.0 + 5.0 * a.sin(), 5.0 - 5.0 * a.cos());
    }
    (1..60).for_each(|i| text += &format!("15 {}\n", 5.0 + 0.1 * f64::from(i)));
    text
}

#[test]
fn a_profile_has_its_segments_and_joins() {
    let folder = Folder::new();
    let file = folder.write("profile.txt", profile());
    let file = file.to_str().unwrap();
    let [dxf, svg, csv] = ["p.dxf", "p.svg", "p.csv"].map(|n| folder.file(n).to_str().unwrap().to_string());
    let answer = document(["section", file, "--dxf", &dxf, "--svg", &svg, "--out", &csv]);
    assert_eq!(answer["schema"], "trueness/section/1");
    let contour = &answer["contours"][0];
    assert_eq!(contour["closed"], false);
    let kinds: Vec<&str> =
        contour["segments"].as_array().unwrap().iter().map(|s| s["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["line", "arc", "line"]);
    assert!((contour["segments"][1]["radius"].as_f64().unwrap() - 5.0).abs() < 1e-6);
    for (n, truth) in [[10.0, 0.0], [15.0, 5.0]].into_iter().enumerate() {
        let join = &contour["joins"][n];
        assert_eq!(join["continuity"], "g1");
        let at = |k: usize| join["point"][k].as_f64().unwrap();
        assert!((at(0) - truth[0]).abs() < 1e-5 && (at(1) - truth[1]).abs() < 1e-5, "{join}");
        assert!(join["std_uncertainty"].as_f64().unwrap() >= 0.0);
        assert_eq!(join["interval"].as_array().unwrap().len(), 2);
    }
    let read = |path: &str| std::fs::read_to_string(path).unwrap();
    assert_eq!((read(&dxf).matches("\nLINE\n").count(), read(&dxf).matches("\nARC\n").count()), (2, 1));
    assert_eq!(read(&svg).matches("<path").count(), 3);
    assert_eq!(read(&csv).lines().count(), 1 + 238);
    let again = trueness(["section", file, "--threads", "1"]);
    assert_eq!(status(&again), 0, "{}", stderr(&again));
    assert!(stdout(&again).contains("r 5.000000"), "{}", stdout(&again));
}

/// The report carries the document that is written, and draws a path for each segment and a sign for each join.
#[test]
fn a_section_has_a_report() {
    let folder = Folder::new();
    let profile = folder.write("profile.txt", profile());
    let cube = folder.write("cube.off", common::CUBE);
    let html = folder.file("report.html");
    for words in [vec![profile.to_str().unwrap()], vec![cube.to_str().unwrap(), "--plane", "1,2,3,0.1"]] {
        let answer = document([&["section"][..], &words, &["--html", html.to_str().unwrap()]].concat());
        let page = std::fs::read_to_string(&html).unwrap();
        let manifest = page.split_once("id=\"manifest\">").unwrap().1.split_once("</script>").unwrap().0;
        let manifest: serde_json::Value = serde_json::from_str(manifest).unwrap();
        assert_eq!(manifest["result"], answer);
        let contour = &answer["contours"][0];
        let count = |key: &str| contour[key].as_array().unwrap().len();
        assert_eq!(page.matches("<path class=\"segment k-").count(), count("segments"));
        assert_eq!(page.matches("<g class=\"join g").count(), count("joins"));
        assert_eq!(manifest["picks"].as_array().unwrap().len(), count("segments") + count("joins"));
        assert!(!page.contains("src=\"data:image/png"));
    }
    let own = trueness(["section", profile.to_str().unwrap(), "--html", profile.to_str().unwrap()]);
    assert_eq!(status(&own), 2, "{}", stderr(&own));
}

#[test]
fn wrong_input_is_refused_with_a_remedy() {
    let folder = Folder::new();
    let few = folder.write("few.txt", "0 0\n1 0\n2 1\n");
    let good = folder.write("good.txt", profile());
    let cube = folder.write("cube.off", common::CUBE);
    let cloud = folder.write("cloud.xyz", "0 0 0\n1 0 0\n2 1 0\n0 1 1\n");
    let [few, good, cube, cloud] = [&few, &good, &cube, &cloud].map(|p| p.to_str().unwrap());
    let twice = folder.file("a").to_str().unwrap().to_string();
    for (words, want, reason) in [
        (vec![few], 3, "few.txt: a section needs at least 4 different points, there are 3"),
        (vec![good, "--noise", "0"], 2, "noise 0: it must be a length above 0"),
        (vec![good, "--level", "100"], 2, "level 1: it must be between 0 and 1"),
        (vec![cube], 2, "it is a mesh; say where to cut it: --plane"),
        (vec![cube, "--plane", "0,0,0,1"], 2, "the normal [0.0, 0.0, 0.0] has no direction"),
        (vec![cube, "--plane", "0,0,1"], 2, "give 4 numbers, not 3"),
        (vec![cube, "--stack", "0,0,1,0,1,-1"], 2, "the step must lead from the first distance to the last"),
        (vec![cube, "--plane", "0,0,1,0", "--thickness", "1"], 2, "it is a mesh; --thickness is for clouds"),
        (
            vec![cube, "--plane", "0,0,1,77"],
            3,
            "the plane meets nothing; along the first normal it reaches from",
        ),
        (vec![good, "--plane", "0,0,1,0"], 2, "its points have two coordinates; leave --plane"),
        (vec![cloud, "--plane", "0,0,1,0"], 2, "say with --thickness how far from the plane they count"),
        (vec![good, "--dxf", &twice, "--svg", &twice], 2, "are the same file; give each its own"),
    ] {
        let answer = trueness([&["section"][..], &words].concat());
        let text = stderr(&answer);
        assert_eq!(status(&answer), want, "{text}");
        assert!(text.contains(reason), "{text}");
    }
}

/// The corners of a cube's section, of each of three planes; the area is that of the faces.
#[test]
fn a_cube_has_square_sections() {
    let folder = Folder::new();
    let cube = folder.write("cube.off", common::CUBE);
    let cube = cube.to_str().unwrap();
    let bounds = document(["section", cube, "--plane", "0,0,1,0.5"])["inputs"][0]["bounds"].clone();
    let (low, high) = (bounds["min"][2].as_f64().unwrap(), bounds["max"][2].as_f64().unwrap());
    let [from, to, step] = [low + 0.25 * (high - low), high, 0.25 * (high - low)];
    let stack = format!("0,0,2,{from},{to},{step}");
    let dxf = folder.file("cube.dxf").to_str().unwrap().to_string();
    let answer = document(["section", cube, "--stack", &stack, "--dxf", &dxf]);
    // What lies on a plane counts as above: the plane of the top face cuts below it.
    assert_eq!(answer["planes"].as_array().unwrap().len(), 4);
    for n in 0..3 {
        let plane = &answer["planes"][n];
        assert!((plane["area"].as_f64().unwrap() - (high - low).powi(2)).abs() < 1e-12, "{plane}");
        let contour = &answer["contours"][n];
        assert_eq!(
            (&contour["plane"], &contour["taken"]),
            (&serde_json::json!(n), &serde_json::json!("facets"))
        );
        let segments = contour["segments"].as_array().unwrap();
        assert!(segments.len() == 4 && segments.iter().all(|s| s["kind"] == "line"), "{segments:?}");
        for join in contour["joins"].as_array().unwrap() {
            assert_eq!(join["continuity"], "g0");
            assert!((join["position"][2].as_f64().unwrap() - (from + n as f64 * step)).abs() < 1e-12);
        }
    }
    let drawing = std::fs::read_to_string(&dxf).unwrap();
    assert!(drawing.contains("section-3") && drawing.matches("\nLINE\n").count() >= 12);
}

/// A cloud of a tube: at any height a circle, from shuffled points on either side of the plane.
#[test]
fn a_cloud_of_a_tube_has_a_circle() {
    let folder = Folder::new();
    let mut text = String::new();
    for i in 0..6000_u32 {
        // Steps without a common divisor: neither angle nor height is in order.
        let (a, z) = (f64::from(i * 2377 % 6000) * std::f64::consts::TAU / 6000.0, f64::from(i % 100) * 0.1);
        let r = 12.5 + 0.004 * (f64::from(i * 7919 % 1000) / 500.0 - 1.0);
        text += &format!("{} {} {z}\n", r * a.cos(), r * a.sin());
    }
    let file = folder.write("tube.xyz", text);
    let answer = document(["section", file.to_str().unwrap(), "--plane", "0,0,1,4.95", "--thickness", "1.2"]);
    let contour = &answer["contours"][0];
    assert_eq!(
        (&contour["closed"], contour["segments"].as_array().unwrap().len()),
        (&true.into(), 1),
        "{contour}"
    );
    assert!((contour["segments"][0]["radius"].as_f64().unwrap() - 12.5).abs() < 0.001);
    assert_eq!(answer["planes"][0]["loose"], 0);
    assert!(answer["planes"][0]["area"].is_null() && answer["planes"][0]["area_reason"].is_string());
}

/// The three methods side by side on a line at 45° and a curve, and a clear word where there is no line.
#[test]
fn the_methods_of_the_paper_stand_side_by_side() {
    let folder = Folder::new();
    let mut text = String::new();
    let half = 0.5_f64.sqrt();
    (0..40).for_each(|i| {
        let s = 0.5 * f64::from(39 - i) + 0.2;
        text += &format!("{} {}\n", 5.0 - s * half, 1.0 - s * half);
    });
    for i in 0..40 {
        let a = (0.5 * f64::from(i) + 0.3) / 6.0;
        let (x, y) = (6.0 * a.sin(), 6.0 * (1.0 - a.cos()));
        text += &format!("{} {}\n", 5.0 + half * (x + y), 1.0 + half * (x - y));
    }
    let file = folder.write("row.txt", text);
    let file = file.to_str().unwrap();
    let answer = document(["section", file, "--search", "golden"]);
    let methods = answer["methods"]["table"].as_array().unwrap();
    let names: Vec<&str> = methods.iter().map(|m| m["method"].as_str().unwrap()).collect();
    assert_eq!(names, ["stepwise", "improved", "golden"]);
    let off = |m: &serde_json::Value| {
        let at = |k: usize| m["join"][k].as_f64().unwrap();
        ((at(0) - 5.0).powi(2) + (at(1) - 1.0).powi(2)).sqrt()
    };
    assert!(off(&methods[2]) < off(&methods[0]) && off(&methods[2]) < 0.05, "{methods:?}");
    assert_eq!(answer["contours"][0]["joins"][0]["point"], methods[2]["join"]);
    let profile = document(["section", file, "--search", "stepwise", "--interval", "profile"]);
    assert_eq!(
        (&profile["methods"]["chosen"], &profile["methods"]["interval"]),
        (&"stepwise".into(), &"profile".into())
    );
    let mut ring = String::new();
    (0..90).for_each(|i| {
        ring += &format!("{} {}\n", 9.0 * (0.05 * f64::from(i)).cos(), 9.0 * (0.05 * f64::from(i)).sin())
    });
    let ring = folder.write("ring.txt", ring);
    let answer = trueness(["section", ring.to_str().unwrap(), "--interval", "paper"]);
    assert_eq!(status(&answer), 3);
    assert!(stderr(&answer).contains("no line segment found"), "{}", stderr(&answer));
}

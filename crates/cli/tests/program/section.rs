//! `trueness section` as users run it.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stderr, stdout, trueness};

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
    let cube = folder.write("cube.off", crate::common::CUBE);
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
    let cube = folder.write("cube.off", crate::common::CUBE);
    let cloud = folder.write("cloud.xyz", "0 0 0\n1 0 0\n2 1 0\n0 1 1\n");
    let [few, good, cube, cloud] = [&few, &good, &cube, &cloud].map(|p| p.to_str().unwrap());
    let area: String = (1..6000)
        .map(|i| format!("{} {} 0\n", f64::from(i) * 0.754_877_67 % 1.0, f64::from(i) * 0.569_840_3 % 1.0))
        .collect();
    let area = folder.write("area.xyz", area);
    let area = area.to_str().unwrap();
    let twice = folder.file("a.dxf").to_str().unwrap().to_string();
    for (words, want, reason) in [
        (vec![few], 3, "few.txt: a section needs at least 4 different points, there are 3"),
        (vec![good, "--noise", "0"], 2, "noise 0: it must be a length above 0"),
        (vec![good, "--level", "100"], 2, "a number of percent between 1 and 100"),
        (vec![good, "--level", "0.95"], 2, "it is in percent: write 95"),
        (vec![cube], 2, "it is a mesh; say where to cut it: --plane"),
        (vec![cube, "--plane", "0,0,0,1"], 2, "--plane 0,0,0,1: the normal has no direction"),
        (vec![cube, "--plane", "0,0,1"], 2, "give 4 numbers, not 3"),
        (vec![cube, "--stack", "0,0,1,0,1,-1"], 2, "the step must lead from the first distance to the last"),
        (vec![cube, "--plane", "0,0,1,0", "--thickness", "1"], 2, "it is a mesh; --thickness is for clouds"),
        (
            vec![cube, "--plane", "0,0,1,77"],
            3,
            "the plane does not meet the part; along the first normal it reaches from",
        ),
        (
            vec![cube, "--plane", "0,0,1,0"],
            3,
            "or lies in a face of it, there is no section: move it inwards",
        ),
        (vec![good, "--plane", "0,0,1,0"], 2, "its points have two coordinates; leave --plane"),
        (vec![cloud, "--plane", "0,0,1,0"], 2, "say with --thickness how far from the plane they count"),
        (
            vec![cloud, "--plane", "0,0,1,0", "--thickness", "1"],
            3,
            "the slab holds 3 points, too few in a row for a contour; a larger --thickness may help",
        ),
        (vec![good, "--dxf", &twice, "--json", &twice], 2, "are the same file; give each its own"),
        (vec![good, "--out", &twice], 2, "a.dxf: the ending must be .csv"),
        (vec![good, "--noise", "1e300"], 2, "--noise 1e300: all of"),
        (
            vec![good, "--reference-units", "in"],
            2,
            "--reference-units is for the file of --nominal; give one",
        ),
        (
            vec![area, "--plane", "0,0,1,0", "--thickness", "1"],
            3,
            "5999 points: the slab holds an area of points, not contours",
        ),
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
    let cube = folder.write("cube.off", crate::common::CUBE);
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
    let of = |name: &str, text: &str| {
        let file = folder.write(name, text);
        document(["section", file.to_str().unwrap(), "--plane", "0,0,1,4.95", "--thickness", "1.2"])
    };
    let answer = of("tube.xyz", &text);
    // Copies of points tell nothing more.
    assert_eq!(of("copies.xyz", &text.repeat(3))["contours"], answer["contours"]);
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

/// A tube sampled at random is one contour; the gap is told. A gap that tears it comes with a hint, and so with a remedy.
#[test]
fn a_scattered_cloud_is_one_contour_and_a_torn_one_has_a_hint() {
    let folder = Folder::new();
    let mut state = 1_u64;
    // Knuth's linear congruential generator.
    let mut unit = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let text: String = (0..8000)
        .map(|_| {
            let (a, z) = (unit() * std::f64::consts::TAU, 20.0 * unit());
            format!("{} {} {z}\n", 10.0 * a.cos(), 10.0 * a.sin())
        })
        .collect();
    let file = folder.write("tube.xyz", text);
    let words = ["section", file.to_str().unwrap(), "--plane", "0,0,1,10", "--thickness", "1"];
    let answer = document(words);
    let plane = &answer["planes"][0];
    assert_eq!((&plane["contours"], &plane["loose"]), (&1.into(), &0.into()), "{plane}");
    assert_eq!(answer["contours"][0]["closed"], true);
    let gap = plane["gap"].as_f64().unwrap();
    assert!((0.2..6.0).contains(&gap) && plane["hint"].is_null(), "{plane}");
    assert!(stdout(&trueness(words)).contains(&format!("   gap {gap:.4}")));
    let torn = [&words[..], &["--gap", "0.3"]].concat();
    let text = stdout(&trueness(&torn));
    assert!(text.contains("   gap 0.3000") && text.contains("open and end near each other"), "{text}");
    let wider = text.split_once("; --gap ").unwrap().1.split_once(' ').unwrap().0;
    let mended = document([&words[..], &["--gap", wider]].concat());
    let count = |answer: &serde_json::Value| answer["planes"][0]["contours"].as_u64().unwrap();
    assert!(2 * count(&mended) < count(&document(&torn)), "{wider}");
}

/// Points of an area need a thinner slab; two points to a side of an octagon a thicker one.
/// A gap smaller than what lies between the points is raised, and both the table and the document tell to what.
#[test]
fn a_gap_that_is_raised_is_told() {
    let folder = Folder::new();
    let at = |i: u32| (f64::from(i) * std::f64::consts::TAU / 200.0).sin_cos();
    let ring: String = (0..200).map(|i| format!("{} {} 0\n", 12.5 * at(i).0, 12.5 * at(i).1)).collect();
    let file = folder.write("ring.xyz", ring);
    let words = ["section", file.to_str().unwrap(), "--plane", "0,0,1,0", "--thickness", "1", "--gap"];
    let small = [&words[..], &["0.01"]].concat();
    let plane = document(&small)["planes"][0].clone();
    let gap = plane["gap"].as_f64().unwrap();
    // The points are 0.39 apart.
    assert!((0.39..4.0).contains(&gap), "{plane}");
    let want = format!("points lie too far apart for --gap 0.01: contours go on over {gap:.4}");
    assert_eq!(plane["hint"], serde_json::json!(want));
    assert!(stdout(&trueness(&small)).contains(&format!("\n! {want}\n")));
    let enough = document([&words[..], &["4"]].concat());
    assert!(
        enough["planes"][0]["gap"] == 4.0 && enough["planes"][0]["hint"].is_null(),
        "{}",
        enough["planes"]
    );
}

/// A plane across the cone of a plate: its curve is one free curve, with corners at its ends alone.
#[test]
fn a_curve_across_facets_has_no_false_corner() {
    let plate = crate::common::corpus("examples/plate/nominal.stl");
    let answer = document(["section", plate.to_str().unwrap(), "--plane", "0,1,0,23.65"]);
    let kinds = |contour: &serde_json::Value| -> Vec<String> {
        let segments = contour["segments"].as_array().unwrap().iter();
        segments.map(|s| s["kind"].as_str().unwrap().to_string()).collect()
    };
    let of = |n: usize| kinds(&answer["contours"][n]);
    let (free, lines): (Vec<String>, Vec<String>) = of(0).into_iter().partition(|k| k == "spline");
    assert_eq!((free.len(), lines), (1, vec!["line".to_string(); 9]), "{:?}", of(0));
    assert_eq!(of(1), ["line"; 4]);
    assert!(answer["contours"][0]["astray"].as_array().is_some_and(Vec::is_empty), "{}", answer["contours"]);
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

/// The round of a rectangle with rounded corners, 30 by 20, radius 4; the numbers of its dimensions in every form of the answer.
#[test]
fn dimensions_stand_in_document_table_and_report() {
    let folder = Folder::new();
    let quarter = 2.0 * std::f64::consts::PI;
    let round = |s: f64| -> [f64; 2] {
        let arc = |x: f64, y: f64, from: f64, s: f64| {
            let a = from + s / 4.0;
            [x + 4.0 * a.cos(), y + 4.0 * a.sin()]
        };
        let half = std::f64::consts::FRAC_PI_2;
        match s {
            s if s < 22.0 => [s + 4.0, 0.0],
            s if s < 22.0 + quarter => arc(26.0, 4.0, -half, s - 22.0),
            s if s < 34.0 + quarter => [30.0, 4.0 + s - 22.0 - quarter],
            s if s < 34.0 + 2.0 * quarter => arc(26.0, 16.0, 0.0, s - 34.0 - quarter),
            s if s < 56.0 + 2.0 * quarter => [26.0 - (s - 34.0 - 2.0 * quarter), 20.0],
            s if s < 56.0 + 3.0 * quarter => arc(4.0, 16.0, half, s - 56.0 - 2.0 * quarter),
            s if s < 68.0 + 3.0 * quarter => [0.0, 16.0 - (s - 56.0 - 3.0 * quarter)],
            s => arc(4.0, 4.0, 2.0 * half, s - 68.0 - 3.0 * quarter),
        }
    };
    let text: String = (0..400)
        .map(|i| round((68.0 + 4.0 * quarter) * (f64::from(i) + 0.3) / 400.0))
        .enumerate()
        .map(|(i, [x, y])| {
            let wave = 1e-4 * ((i * 7919 % 101) as f64 - 50.0) / 50.0;
            format!("{} {}\n", x + wave, y - wave)
        })
        .collect();
    let file = folder.write("round.txt", text);
    let file = file.to_str().unwrap();
    let html = folder.file("round.html").to_str().unwrap().to_string();
    let answer = document(["section", file, "--html", &html]);
    let all = answer["dimensions"]["items"].as_array().unwrap();
    assert_eq!((all.len(), &answer["dimensions"]["truncated"]), (12, &false.into()), "{all:?}");
    let of = |kind: &str| -> Vec<(f64, f64)> {
        let own = all.iter().filter(|d| d["kind"] == kind);
        own.map(|d| (d["value"].as_f64().unwrap(), d["std_uncertainty"].as_f64().unwrap())).collect()
    };
    let near = |list: &[(f64, f64)], truths: &[f64]| {
        assert_eq!(list.len(), truths.len(), "{list:?}");
        for truth in truths {
            assert!(list.iter().any(|(x, u)| (x - truth).abs() < 5.0 * u && *u < 1e-3), "{truth} {list:?}");
        }
    };
    near(&of("angle"), &[std::f64::consts::FRAC_PI_2; 4]);
    near(&of("width"), &[20.0, 30.0]);
    near(&of("centers"), &[22.0, 22.0, 12.0, 12.0, 22f64.hypot(12.0), 22f64.hypot(12.0)]);
    let segments = answer["contours"][0]["segments"].as_array().unwrap();
    for segment in segments {
        let u = segment["length_uncertainty"].as_f64().unwrap();
        let truth = if segment["kind"] == "arc" {
            quarter
        } else if (segment["length"].as_f64().unwrap() - 22.0).abs() < 1.0 {
            22.0
        } else {
            12.0
        };
        assert!((segment["length"].as_f64().unwrap() - truth).abs() < 5.0 * u && u < 0.01, "{segment}");
    }
    let shown = stdout(&trueness(["section", file]));
    assert!(shown.contains("centers") && shown.contains("width") && shown.contains("90.00"), "{shown}");
    let page = std::fs::read_to_string(&html).unwrap();
    assert_eq!(
        page.split_once("<table class=\"dimensions\">")
            .unwrap()
            .1
            .split_once("</table>")
            .unwrap()
            .0
            .matches("<tr>")
            .count(),
        1 + 12
    );
}

/// A box against a larger one: the cut of a mesh, points against that cut, points against points. Outside is positive.
#[test]
fn sections_are_compared_with_a_nominal() {
    let folder = Folder::new();
    let cube = folder.write("cube.off", crate::common::CUBE);
    // The same cube, twice as large, about the same middle.
    let larger = "OFF\n8 12 0\n-0.5 -0.5 -0.5\n1.5 -0.5 -0.5\n-0.5 1.5 -0.5\n1.5 1.5 -0.5\n-0.5 -0.5 1.5\n1.5 -0.5 1.5\n-0.5 1.5 1.5\n1.5 1.5 1.5\n";
    let larger =
        folder.write("larger.off", larger.to_string() + crate::common::CUBE.split_once("1 1 1\n").unwrap().1);
    let square = |size: f64| -> String {
        let at = |i: u32| size * (f64::from(i) + 0.5) / 40.0;
        let low = 0.5 * (1.0 - size);
        (0..160)
            .map(|i| match (i / 40, at(i % 40)) {
                (0, s) => [s, 0.0],
                (1, s) => [size, s],
                (2, s) => [size - s, size],
                (_, s) => [0.0, size - s],
            })
            .map(|[x, y]| format!("{} {}\n", low + x, low + y))
            .collect()
    };
    let (small, large) = (folder.write("small.txt", square(1.0)), folder.write("large.txt", square(2.0)));
    let [cube, larger, small, large] = [&cube, &larger, &small, &large].map(|p| p.to_str().unwrap());
    let csv = folder.file("points.csv").to_str().unwrap().to_string();
    let plane = ["--plane", "0,0,1,0.5"];
    for (words, truth, outline, count) in [
        (vec![cube, "--nominal", larger, plane[0], plane[1]], -0.5, "facets", 8),
        (vec![larger, "--nominal", cube, plane[0], plane[1]], 0.5, "facets", 8),
        (vec![small, "--nominal", large], -0.5, "contour", 160),
        (vec![large, "--nominal", small], 0.5, "contour", 160),
    ] {
        let answer = document([&["section"][..], &words, &["--out", &csv]].concat());
        let nominal = &answer["nominal"];
        assert_eq!((&nominal["outline"], &nominal["positive"]), (&outline.into(), &"outside".into()));
        let all = &nominal["deviation"]["all"];
        assert_eq!(all["count"], count);
        // The middles of sides are half a side off; corners of the larger one farther.
        let (near, far) = if truth > 0.0 { ("min", "max") } else { ("max", "min") };
        assert!((all[near].as_f64().unwrap() - truth).abs() < 1e-6, "{all}");
        assert!(all[far].as_f64().unwrap() * truth > 0.0, "{all}");
        assert_eq!(answer["inputs"][1]["role"], "reference");
        let each = nominal["deviations"][0].as_array().unwrap();
        assert_eq!(each.len() as i64, count);
        let rows = std::fs::read_to_string(&csv).unwrap();
        let last = |line: &str| line.rsplit_once(',').unwrap().1.parse::<f64>().unwrap();
        assert!(rows.lines().skip(1).zip(each).all(|(line, x)| last(line) == x.as_f64().unwrap()));
    }
    let shown = trueness(["section", small, "--nominal", large]);
    assert!(status(&shown) == 0 && stdout(&shown).contains("+ outside"), "{}", stderr(&shown));
    let html = folder.file("n.html").to_str().unwrap().to_string();
    document(["section", small, "--nominal", large, "--html", &html]);
    assert!(std::fs::read_to_string(&html).unwrap().contains("Deviation from the nominal"));
    let away = ["section", cube, "--plane", "0,0,1,0.5", "--plane", "1,0,0,0.5", "--nominal"];
    for (words, want, reason) in [
        ([&away[..], &[large]].concat(), 2, "it holds points in order, which are of one plane"),
        (
            ["section", larger, "--plane", "0,0,1,-0.25", "--nominal", cube].to_vec(),
            3,
            "no plane of the section meets it",
        ),
        (["section", small, "--nominal", "missing.txt"].to_vec(), 3, "missing.txt"),
    ] {
        let answer = trueness(words);
        assert_eq!(status(&answer), want, "{}", stderr(&answer));
        assert!(stderr(&answer).contains(reason), "{}", stderr(&answer));
    }
}

/// Curves for CAD programs lie where the section lies in space.
#[test]
fn curves_are_written_for_cad_programs() {
    let folder = Folder::new();
    let cube = folder.write("cube.off", crate::common::CUBE);
    let [step, iges] = ["c.stp", "c.igs"].map(|n| folder.file(n).to_str().unwrap().to_string());
    let words = ["section", cube.to_str().unwrap(), "--plane", "0,0,1,0.5", "--plane", "0,0,1,0.75"];
    document([&words[..], &["--step", &step, "--iges", &iges]].concat());
    let [step, iges] = [step, iges].map(|path| std::fs::read_to_string(path).unwrap());
    assert_eq!((step.matches("=LINE(").count(), step.matches("GEOMETRIC_CURVE_SET(").count()), (8, 2));
    // Every place is at the height of its plane.
    let heights = step.split("=CARTESIAN_POINT('',(").skip(1).map(|p| p.split(')').next().unwrap());
    let heights: Vec<f64> = heights.map(|p| p.rsplit(',').next().unwrap().parse().unwrap()).collect();
    assert!(heights[1..].iter().all(|z| [0.5, 0.75].contains(z)), "{heights:?}");
    assert_eq!(iges.lines().filter(|l| l.starts_with("     110") && l.contains("D")).count(), 16);
    assert!(iges.lines().all(|l| l.len() == 80));
}

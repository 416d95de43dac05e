//! `trueness surface` as users run it.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, corpus, document, status, stderr, stdout, trueness};

/// The nine points of the paper.
const NINE: &str = "1 1 0\n1 2 0\n1 3 0\n2 1 0\n2 2 0.3\n2 3 0\n3 1 0\n3 2 0\n3 3 0\n";

/// A wave of 60 by 40 mm.
fn wave(noise: f64) -> String {
    let mut text = String::new();
    for i in 0..2400u32 {
        let (x, y) = (f64::from(i % 60) + 0.3, f64::from(i / 60) + 0.1);
        let odd = f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5;
        text += &format!("{x} {y} {}\n", 3.0 * (0.1 * x).sin() * (0.15 * y).cos() + noise * odd);
    }
    text
}

#[test]
fn nine_points_have_the_surface_of_the_paper() {
    let folder = Folder::new();
    let file = folder.write("nine.asc", NINE);
    let file = file.to_str().unwrap();
    let answer = document(["surface", file, "--degree", "2x2", "--spans", "1x1", "--fairness", "0"]);
    assert_eq!(answer["schema"], "trueness/surface/1");
    assert_eq!(answer["degree"], serde_json::json!([2, 2]));
    let control = &answer["control_points"];
    for i in 0..3 {
        for j in 0..3 {
            let height = control[i][j][2].as_f64().unwrap();
            assert!((height - if (i, j) == (1, 1) { 1.2 } else { 0.0 }).abs() < 1e-12, "{control}");
        }
    }
    let middle = &answer["curvature"]["middle"];
    let number = |name: &str| middle[name].as_f64().unwrap();
    let side = number("mean").signum();
    for (name, expected) in [("k1", 0.6), ("k2", 0.6), ("mean", 0.6), ("gaussian", 0.36 * side)] {
        assert!((side * number(name) - expected).abs() < 1e-10, "{name} {middle}");
    }
    // At all nine, by the closed form of a height: in the middle, at the four corners and between those.
    let steep = 0.6 / 1.36f64.powf(1.5);
    let ones = [[-0.6, -0.6], [1.2, -1.2], [0.0, -steep]];
    let all =
        [0, 1, 1, 1, 1, 2, 2, 2, 2].map(|k| if side < 0.0 { ones[k] } else { [-ones[k][1], -ones[k][0]] });
    for (n, name) in ["k1", "k2", "mean", "gaussian"].into_iter().enumerate() {
        let mut sorted = all.map(|[a, b]| [a, b, 0.5 * (a + b), a * b][n]);
        sorted.sort_unstable_by(f64::total_cmp);
        for (which, expected) in [("min", sorted[0]), ("median", sorted[4]), ("max", sorted[8])] {
            let found = answer["curvature"][name][which].as_f64().unwrap();
            assert!((found - expected).abs() < 1e-10, "{name} {which}: {found} {expected}");
        }
    }
    assert_eq!(answer["unsupported_share"], 0.0);
    assert_eq!(answer["knots"]["u"].as_array().unwrap().len(), 6);
    assert!(answer["deviation"]["max"].as_f64().unwrap() < 1e-12);
    assert_eq!(
        (&answer["degrees_of_freedom"], &answer["fairness_from"]),
        (&serde_json::Value::Null, &"given".into())
    );
    let o = trueness(["surface", file, "--degree", "2", "--spans", "1", "--fairness", "0"]);
    assert!(stdout(&o).contains("control points 3x3   base plane   9 points"), "{}", stdout(&o));
}

#[test]
fn given_knots_have_the_reference_coefficients() {
    let folder = Folder::new();
    let knots = folder.write(
        "knots.json",
        r#"{"u": [0,0,0,0,0.25,0.5,0.75,1,1,1,1], "v": [0,0,0,0,0.25,0.5,0.75,1,1,1,1]}"#,
    );
    let points = corpus("reference_surfaces/franke_400.txt");
    let words = ["--base", "xy", "--fairness", "0", "--knots", knots.to_str().unwrap()];
    let answer = document([&["surface", points.to_str().unwrap()][..], &words].concat());
    let first = answer["control_points"][0][0][2].as_f64().unwrap();
    assert!((first / 0.631_455_809_573_769_6 - 1.0).abs() < 1e-9);
    let sum = answer["residual"]["sum_of_squares"].as_f64().unwrap();
    assert!((sum / 0.093_497_693_025_005_22 - 1.0).abs() < 1e-9);
}

#[test]
fn a_tolerance_is_reached_or_not_and_says_so() {
    let folder = Folder::new();
    let (clean, noisy) = (folder.write("clean.xyz", wave(0.0)), folder.write("noisy.xyz", wave(0.2)));
    let o = trueness(["surface", clean.to_str().unwrap(), "--tolerance", "0.01"]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    assert!(stdout(&o).contains("tolerance 0.01: reached, all points are within"), "{}", stdout(&o));
    let o = trueness(["surface", noisy.to_str().unwrap(), "--tolerance", "0.01"]);
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    assert!(stdout(&o).contains("not reached"), "{}", stdout(&o));
    assert!(stdout(&o).contains("more knots would follow the noise"), "{}", stdout(&o));
}

#[test]
fn a_rectangle_turned_along_a_step_is_told() {
    let folder = Folder::new();
    let mut text = String::new();
    for i in 0..71 * 71 {
        let (x, y) = (f64::from(i / 71), f64::from(i % 71));
        let across = (0.6 * (x - 35.0) + 0.8 * (y - 35.0)) / 2.0;
        text += &format!("{x} {y} {}\n", across.tanh());
    }
    let (file, html) = (folder.write("step.xyz", text), folder.file("step.html"));
    let words = ["surface", file.to_str().unwrap(), "--tolerance", "0.02"];
    let answer = document(words);
    let base = &answer["base"];
    let number = |v: &serde_json::Value| v.as_f64().unwrap();
    let turned = number(&base["turned"]).to_degrees();
    // The step runs along (0.8, -0.6), 36.87 degrees off the sides of the square.
    let off = (turned.abs() - 36.87).abs().min((turned.abs() - 53.13).abs());
    assert!(off < 0.3, "{turned}");
    let along = [0, 1].map(|k| (0.6 * number(&base["axes"][k][0]) + 0.8 * number(&base["axes"][k][1])).abs());
    assert!(along[0].max(along[1]) > 0.998, "{base}");
    let o = trueness([&words[..], &["--html", html.to_str().unwrap()]].concat());
    let told =
        format!("base plane, turned by {turned:.2}° along what bends   5,041 points").replace('-', "−");
    assert!(stdout(&o).contains(&told), "{told}: {}", stdout(&o));
    let page = std::fs::read_to_string(html).unwrap();
    let told = format!("{:.2}", turned.abs());
    assert!(page.contains("Rectangle turned by") && page.contains(&told), "{told}");
}

#[test]
fn models_are_written_the_same_on_any_threads() {
    let folder = Folder::new();
    let file = folder.write("wave.xyz", wave(0.01));
    let run = |threads: &str, name: &str| {
        let [step, iges, obj, json] =
            ["stp", "igs", "obj", "json"].map(|e| folder.file(&format!("{name}.{e}")));
        let mut words: Vec<&std::ffi::OsStr> =
            vec!["surface".as_ref(), file.as_ref(), "--threads".as_ref(), threads.as_ref()];
        for (option, path) in [("--step", &step), ("--iges", &iges), ("--obj", &obj), ("--json", &json)] {
            words.extend([option.as_ref(), path.as_os_str()]);
        }
        let o = trueness(words);
        assert_eq!(status(&o), 0, "{}", stderr(&o));
        [step, iges, obj, json].map(|p| std::fs::read_to_string(p).unwrap())
    };
    let one = run("1", "one");
    assert_eq!(one, run("3", "three"));
    let [step, iges, obj, _] = one;
    assert!(step.starts_with("ISO-10303-21;") && step.ends_with("END-ISO-10303-21;\n"));
    for (word, count) in
        [("B_SPLINE_SURFACE_WITH_KNOTS", 1), ("B_SPLINE_CURVE_WITH_KNOTS", 4), ("ADVANCED_FACE", 1)]
    {
        assert_eq!(step.matches(word).count(), count, "{word}");
    }
    assert_eq!(step.matches("=CARTESIAN_POINT").count(), 11 * 11 + 1);
    assert!(iges.lines().all(|l| l.len() == 80));
    assert!(obj.lines().filter(|l| l.starts_with("f ")).count() > 100);
}

#[test]
fn a_report_says_what_the_document_says() {
    let folder = Folder::new();
    let file = folder.write("wave.xyz", wave(0.0));
    let report = |words: &[&str], name: &str| {
        let (html, json) = (folder.file(&format!("{name}.html")), folder.file(&format!("{name}.json")));
        let files =
            [file.to_str().unwrap(), "--html", html.to_str().unwrap(), "--json", json.to_str().unwrap()];
        let o = trueness([&["surface"][..], &files, words].concat());
        let document: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
        (status(&o), std::fs::read_to_string(html).unwrap(), document)
    };
    let (done, one, document) = report(&["--threads", "1"], "one");
    assert_eq!(done, 0);
    assert!(one.contains(">Surface through the points · wave.xyz</title>"));
    // A row for the deviation and for each curvature.
    assert_eq!(one.matches("<tr data-choose=").count(), 5);
    assert_eq!(document["curvature"]["maps"].as_object().unwrap().len(), 4);
    assert_eq!(document["map"]["scale"]["unit"], "mm");
    let bars = &document["map"]["histogram"];
    let counts = bars["counts"].as_array().unwrap().iter().chain([&bars["below"], &bars["above"]]);
    let sum: u64 = counts.map(|n| n.as_u64().unwrap()).sum();
    assert_eq!(sum, 2400);
    assert!(one == report(&["--threads", "3"], "three").1);
    let (done, text, document) = report(&["--tolerance", "1e-9"], "tight");
    assert_eq!((done, &document["map"]["scale"]["tolerance"]), (1, &serde_json::json!([-1e-9, 1e-9])));
    assert!(text.contains(">Fail · wave.xyz</title>"));
}

#[test]
fn wrong_input_is_refused_with_a_remedy() {
    let folder = Folder::new();
    let good = folder.write("good.xyz", wave(0.0));
    let line = folder.write("line.xyz", "0 0 0\n1 1 1\n2 2 2\n3 3 3\n5 5 5\n");
    let few = folder.write("few.xyz", "0 0 0\n1 0 0\n0 1 0\n");
    let flat = folder.write("flat.xy", "0 0\n1 0\n0 1\n1 1\n");
    let open = folder.write("open.json", r#"{"u": [0,1,2,3,4,5], "v": [0,0,1,1]}"#);
    let other = folder.write("other.json", r#"{"x": [0,0,1,1], "v": [0,0,1,1]}"#);
    let short = folder.write("short.json", r#"{"u": [0,0,9,9], "v": [0,0,9,9]}"#);
    let torn = folder.write("torn.json", r#"{"u": [0,0,0,0,50,50,50,50,99,99,99,99], "v": [0,0,9,9]}"#);
    let [good, line, few, flat, open, other, short, torn] =
        [&good, &line, &few, &flat, &open, &other, &short, &torn].map(|p| p.to_str().unwrap());
    for (words, want, reason) in [
        (vec![line], 3, "line.xyz: all points lie on one straight line"),
        (vec![few], 3, "few.xyz: a surface needs at least 4 points, there are 3"),
        (vec![flat], 2, "flat.xy: it has two columns; a surface needs x, y and z"),
        (vec![good, "--degree", "0x3"], 2, "degree 0: it must be from 1 to 9"),
        (vec![good, "--degree", "3y3"], 2, "is no whole number; write 8x8"),
        (vec![good, "--spans", "0x3"], 2, "there must be at least 1 in each direction"),
        (vec![good, "--spans", "99999x99999"], 3, "are allowed: ask for fewer spans"),
        (vec![good, "--tolerance", "0"], 2, "tolerance 0: it must be a length above 0"),
        (vec![good, "--tolerance", "-1"], 2, "tolerance -1: it must be a length above 0"),
        (vec![good, "--tolerance", "0,1"], 2, "write it with a decimal point"),
        (vec![good, "--tolerance", "1", "--spans", "3"], 2, "cannot be used with"),
        (vec![good, "--fairness", "-1"], 2, "it is auto, or a number from 0 upwards"),
        (vec![good, "--base", "mesh"], 2, "--base mesh lays facets flat, and the file has none; give a mesh"),
        (vec![good, "--spans", "80x80", "--fairness", "0"], 3, "ask for fewer spans or a fairness above 0"),
        (vec![good, "--knots", open], 3, "open.json: the knots of u are not clamped"),
        (
            vec![good, "--knots", torn],
            3,
            "torn.json: the knot 50 of u stands 4 times and tears the surface apart",
        ),
        (vec![good, "--knots", other], 3, "other.json: it holds no knots; give"),
        (vec![good, "--knots", short, "--base", "xy"], 3, "the knots along u run from 0 to"),
        (vec![good, "--knots", short, "--degree", "3"], 3, "are of degree 1, but --degree asks for 3"),
        (vec![good, "--knots", short, "--json", short], 2, "would overwrite the input"),
        (vec![good, "--step", "surface.txt"], 2, "the ending must be .stp or .step"),
        (vec![good, "--obj", "a.obj", "--chord", "0"], 2, "give a length above 0"),
    ] {
        let o = trueness([&["surface"][..], &words].concat());
        let text = stderr(&o);
        assert_eq!(status(&o), want, "{words:?}: {text}");
        assert!(text.contains(reason), "{words:?}: {text}");
        assert!(stdout(&o).is_empty(), "{words:?}");
    }
}

/// What comes of points that no surface, or hardly one, goes through: the message or a warning says it, and no number is wild.
#[test]
fn ugly_points_are_told() {
    let folder = Folder::new();
    let lines = |rows: Vec<[f64; 3]>| -> String {
        rows.iter().map(|[x, y, z]| format!("{x:.9} {y:.9} {z:.9}\n")).collect()
    };
    let wave: Vec<[f64; 3]> = wave(0.01)
        .lines()
        .map(|l| {
            <[f64; 3]>::try_from(l.split(' ').map(|w| w.parse().unwrap()).collect::<Vec<f64>>()).unwrap()
        })
        .collect();
    let keep = |f: &dyn Fn(f64, f64) -> bool| wave.iter().copied().filter(|p| f(p[0], p[1])).collect();
    let ell: Vec<[f64; 3]> = keep(&|x, y| x < 25.0 || y < 15.0);
    let steep = wave.iter().map(|[x, y, _]| [*x, *y, 15.0 * (2.0 * (x - 30.0)).tanh()]).collect();
    // A shelf that hangs over by 20 mm.
    let over = (0..3600u32).map(|i| (f64::from(i % 90) / 30.0, f64::from(i / 90))).map(|(t, y)| match t {
        t if t < 1.0 => [40.0 * t, y, 0.0],
        t if t < 2.0 => [40.0 - 20.0 * (t - 1.0), y, 5.0 * (t - 1.0)],
        t => [20.0 + 40.0 * (t - 2.0), y, 5.0],
    });
    let few = wave.iter().copied().step_by(80).collect();
    // Written with nine decimals, no point of a line lies on it.
    let line = (0..400).map(|k| f64::from(k) / 7.0).map(|t| [t, 2.0 * t, 3.0 - t]).collect();
    let odd = |k: u32| f64::from(k.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5;
    let strip =
        (0..400u32).map(|k| (k, f64::from(k) / 8.0)).map(|(k, t)| [t, 1e-2 * odd(k), 1e-2 * odd(k + 400)]);
    let stray = |times: f64| {
        let mut all = wave.clone();
        all[7] = all[7].map(|x| times * x);
        all
    };
    let refused = |reason| (3, reason);
    for (name, rows, words, (want, told)) in [
        (
            "ell",
            ell,
            "",
            (
                0,
                "of the control points have no points near them: there the surface is a thin plate, not data",
            ),
        ),
        ("steep", steep, "--tolerance 0.05", (0, "reached, all points are within")),
        (
            "over",
            over.collect(),
            "",
            (1, "of the points lie in layers over one another as seen on the base (plane)"),
        ),
        ("few", few, "", (0, "there are fewer points (30) than control points (121)")),
        ("line", line, "", refused("line.xyz: all points lie on one straight line as seen on the base")),
        ("strip", strip.collect(), "", (0, "the points lie in a strip of 49.87")),
        ("same", vec![wave[0]; 50], "", refused("same.xyz: all points lie on one straight line")),
        ("stray", stray(1e9), "", refused("or one lies very far from the others")),
        ("astray", stray(1e4), "", (0, "the points lie in a strip of 7569")),
        ("twice", [wave.clone(), wave.clone()].concat(), "", (0, "4,800 points")),
    ] {
        let file = folder.write(&format!("{name}.xyz"), lines(rows));
        let json = folder.file(&format!("{name}.json"));
        let files = ["surface", file.to_str().unwrap(), "--json", json.to_str().unwrap()];
        let o = trueness(files.into_iter().chain(words.split_whitespace()));
        let text = stdout(&o) + &stderr(&o);
        assert_eq!(status(&o), want, "{name}: {text}");
        assert!(text.contains(told), "{name}: {text}");
        if want != 3 {
            let answer: serde_json::Value =
                serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
            assert_eq!(answer["far_control_points"], 0, "{name}");
        }
    }
    let broken = folder.write("nan.xyz", "0 0 0\n1 0 0\n0 1 nan\n1 1 1\n2 1 1\n");
    let o = trueness(["surface", broken.to_str().unwrap()]);
    assert_eq!(status(&o), 3);
    assert!(stderr(&o).contains("nan.xyz, line 3: column 3 (z): expected a finite number"), "{}", stderr(&o));
}

#[test]
fn layers_and_holes_are_told() {
    let folder = Folder::new();
    let mut ball = String::new();
    for i in 0..3000 {
        let z = 1.0 - (f64::from(i) + 0.5) / 1500.0;
        let (r, a) = ((1.0 - z * z).sqrt(), 2.399963229728653 * f64::from(i));
        ball += &format!("{} {} {}\n", 20.0 * r * a.cos(), 20.0 * r * a.sin(), 20.0 * z);
    }
    let ball = folder.write("ball.xyz", ball);
    let o = trueness(["surface", ball.to_str().unwrap()]);
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    assert!(stdout(&o).contains("in layers over one another"), "{}", stdout(&o));
    let far = |l: &&str| {
        let n: Vec<f64> = l.split(' ').map(|w| w.parse().unwrap()).collect();
        (n[0] - 30.0).hypot(n[1] - 20.0) > 14.0
    };
    let hole: Vec<String> = wave(0.01).lines().filter(far).map(String::from).collect();
    let hole = folder.write("hole.xyz", hole.join("\n"));
    let answer = document(["surface", hole.to_str().unwrap(), "--spans", "24x16"]);
    let share = answer["unsupported_share"].as_f64().unwrap();
    assert!(share > 0.02 && share < 0.5, "{share}");
    assert_eq!(answer["far_control_points"], 0);
    assert!(
        answer["warnings"][0].as_str().unwrap().contains("a thin plate, not data"),
        "{}",
        answer["warnings"]
    );
}

/// An L with a hole is cut along its outline: the document has the polygons, the files the faces, and who reads them is told.
#[test]
fn a_surface_is_cut_along_the_outline() {
    let f = Folder::new();
    let inside = |x: f64, y: f64| (x < 50.0 || y < 30.0) && (x - 25.0).hypot(y - 20.0) > 9.0;
    let grid = (0..101).flat_map(|i| (0..61).map(move |j| (f64::from(i), f64::from(j))));
    let rows = grid
        .filter(|(x, y)| inside(*x, *y))
        .map(|(x, y)| format!("{x} {y} {}\n", (x / 20.0).sin() * (y / 15.0).cos()));
    let points = f.write("l.asc", rows.collect::<String>());
    let files = ["l.stp", "l.igs", "l.obj"].map(|name| f.file(name));
    let [step, iges, obj] = files.each_ref().map(|p| p.to_str().unwrap());
    let ask = |trim: &str| {
        document(["surface", points.to_str().unwrap(), trim, "--step", step, "--iges", iges, "--obj", obj])
    };
    let d = ask("--trim");
    let regions = d["trim"]["regions"].as_array().unwrap();
    assert_eq!((regions.len(), regions[0]["holes"].as_array().unwrap().len()), (1, 1));
    let (share, want) =
        (d["trim"]["share"].as_f64().unwrap(), (4500.0 - 81.0 * std::f64::consts::PI) / 6000.0);
    assert!(share > want && share < want + 0.08, "{share} {want}");
    let text = std::fs::read_to_string(step).unwrap();
    assert_eq!([text.matches("ADVANCED_FACE").count(), text.matches("FACE_BOUND").count()], [1, 1]);
    let text = std::fs::read_to_string(iges).unwrap();
    let entries =
        |kind: &str| text.lines().filter(|l| l.as_bytes()[72] == b'D' && l.starts_with(kind)).count();
    // Two lines an entry: the face, and a curve on the surface for each bound.
    assert_eq!([entries("     144"), entries("     142")], [2, 4]);
    let result = f.file("l.json");
    let json = result.to_str().unwrap();
    assert_eq!(status(&trueness(["surface", points.to_str().unwrap(), "--trim", "--json", json])), 0);
    for file in [step, iges] {
        let cut = &document(["compare", points.to_str().unwrap(), file])["inputs"][1];
        assert_eq!((&cut["cad"]["faces"], &cut["trimmed_faces"]), (&1.into(), &serde_json::Value::Null));
    }
    let warned = document(["compare", points.to_str().unwrap(), json])["inputs"][1]["warnings"].to_string();
    assert!(warned.contains("each surface was taken whole"), "{warned}");
    let facets = trueness::read(obj).unwrap().mesh.faces.len();
    std::fs::remove_file(obj).unwrap();
    assert!(ask("--spans=8x8").get("trim").is_none());
    assert!(trueness::read(obj).unwrap().mesh.faces.len() != facets);
    // The gap of the inner corner and the hole are narrower than twice this.
    let bridged = ask("--trim=12");
    assert_eq!(bridged["trim"]["regions"][0]["holes"].as_array().unwrap().len(), 0);
    let line = f.write("line.asc", (0..40).map(|k| format!("{k} 0 {}\n", k % 3)).collect::<String>());
    let o = trueness(["surface", line.to_str().unwrap(), "--base", "xy", "--trim"]);
    assert!(status(&o) > 1, "{}", stderr(&o));
    for wrong in ["--trim=0", "--trim=-1", "--trim=wide", "--trim=inf"] {
        let o = trueness(["surface", points.to_str().unwrap(), wrong]);
        assert!(status(&o) == 2 && stderr(&o).contains("it is auto, or a length above 0"), "{}", stderr(&o));
    }
}

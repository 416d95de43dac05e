//! `trueness segment` as users run it.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, missing_docs)]

use crate::common::{CUBE, Folder, corpus, document, status, stderr, stdout, trueness};

#[test]
fn a_cube_has_six_planes() {
    let folder = Folder::new();
    let file = folder.write("cube.off", CUBE);
    let (file, out) = (file.to_str().unwrap(), folder.file("regions.ply"));
    let answer = document(["segment", file, "--out", out.to_str().unwrap(), "--members"]);
    assert_eq!(answer["schema"], "trueness/segment/1");
    assert_eq!(answer["unassigned"], 0);
    let regions = answer["regions"].as_array().unwrap();
    assert_eq!(regions.len(), 6);
    let mut members: Vec<u64> = Vec::new();
    for region in regions {
        assert_eq!((&region["shape"], &region["pieces"]), (&"plane".into(), &2.into()));
        assert!((region["area"].as_f64().unwrap() - 1.0).abs() < 1e-12);
        members.extend(region["members"].as_array().unwrap().iter().map(|m| m.as_u64().unwrap()));
    }
    members.sort_unstable();
    assert_eq!(members, (0..12).collect::<Vec<u64>>());
    assert!(std::fs::read(out).unwrap().windows(20).any(|w| w == b"property int region\n"));
}

#[test]
fn points_of_a_cylinder_are_one() {
    let folder = Folder::new();
    let mut text = String::new();
    for k in 0..900 {
        let (turn, height) = (0.7 * f64::from(k % 90) * std::f64::consts::TAU / 63.0, f64::from(k / 90));
        text += &format!("{} {} {height}\n", 5.0 * turn.cos(), 5.0 * turn.sin());
    }
    let file = folder.write("bore.xyz", text);
    let table = trueness(["segment", file.to_str().unwrap(), "--threads", "1"]);
    let text = stdout(&table);
    assert_eq!(status(&table), 0, "{}", stderr(&table));
    assert!(text.contains("cylinder  r 5.0000"), "{text}");
    assert!(text.contains("1 region; 0 of 900 points in none"), "{text}");
}

#[test]
fn what_holds_no_surface_is_refused_by_name() {
    let folder = Folder::new();
    let line: String = (0..50).map(|k| format!("{k} {} {}\n", 2 * k, 3 * k)).collect();
    let line = folder.write("line.xyz", line);
    let equal = folder.write("equal.xyz", "1 2 3\n".repeat(50));
    let good = corpus("reference_fits/cylinder_exact_60.xyz");
    for (words, want, reason) in [
        (vec![line.to_str().unwrap()], 3, "line.xyz: it holds no surface"),
        (vec![equal.to_str().unwrap()], 3, "equal.xyz: it holds no surface"),
        (vec![good.to_str().unwrap(), "--tolerance", "0"], 2, "tolerance 0: it must be a length above 0"),
        (
            vec![good.to_str().unwrap(), "--min-share", "200"],
            2,
            "--min-share 200: it must be between 0 and 100 percent",
        ),
        (vec![good.to_str().unwrap(), "--out", "x.stl"], 2, ".ply .csv"),
    ] {
        let answer = trueness([&["segment"][..], &words].concat());
        let text = stderr(&answer);
        assert_eq!(status(&answer), want, "{text}");
        assert!(text.contains(reason), "{text}");
        assert!(text.lines().count() <= 3, "{text}");
    }
}

#[test]
fn a_report_draws_every_region() {
    let folder = Folder::new();
    let file = folder.write("cube.off", CUBE);
    let html = folder.file("report.html");
    let answer = trueness(["segment", file.to_str().unwrap(), "--html", html.to_str().unwrap()]);
    assert_eq!(status(&answer), 0, "{}", stderr(&answer));
    let text = std::fs::read_to_string(html).unwrap();
    assert!(text.contains(">Elements found · cube.off</title>"));
    assert_eq!(text.matches("<tr data-pick=").count(), 6);
    // Nothing is in none; four lines around each plane.
    assert_eq!(text.matches("\"role\":\"part\"").count(), 6);
    assert!(text.contains("\"segments\":24"));
}

/// Of every mesh of the corpus and real scans (the two largest files take half a minute): no region reaches beyond the tolerance, found or given.
#[test]
fn no_member_lies_beyond_the_tolerance() {
    let mut tried = 0;
    for folder in ["broken", "shapes", "bunny"] {
        let mut files: Vec<_> =
            std::fs::read_dir(corpus(folder)).unwrap().map(|e| e.unwrap().path()).collect();
        files.sort();
        for file in files {
            let file = file.to_str().unwrap();
            if file.ends_with("scans.ply") || file.ends_with("zipper_res1.ply") {
                continue;
            }
            let found = trueness(["segment", file, "--json", "-"]);
            // Files that hold no surface are refused.
            let Ok(answer) = serde_json::from_slice::<serde_json::Value>(&found.stdout) else { continue };
            let regions = answer["regions"].as_array().unwrap();
            let tolerance = answer["tolerance"].as_f64().unwrap();
            assert!(regions.iter().all(|r| r["max"].as_f64().unwrap() <= tolerance), "{file}: {tolerance}");
            tried += 1;
        }
    }
    assert!(tried > 60, "{tried}");
}

/// A stepped shaft of radii 22.9089, 18.0551 and 12.9580 with a bore of 6.4262 along it, which ends in a floor, and one of 3.8466 across.
#[test]
fn a_bore_between_two_circles_of_corners_is_no_sphere() {
    let answer = document(["segment", corpus("segments/shaft_with_bores.stl").to_str().unwrap()]);
    let regions = answer["regions"].as_array().unwrap();
    assert!(regions.iter().all(|r| r["shape"] == "cylinder" || r["shape"] == "plane"), "{regions:#?}");
    for radius in [22.9089, 18.0551, 12.958, 6.4262, 3.8466] {
        let is_it = |r: &serde_json::Value| {
            r["parameters"]["radius"].as_f64().is_some_and(|found| (found - radius).abs() < 1e-3)
        };
        assert!(regions.iter().any(is_it), "{radius}");
    }
}

//! `--progress`: what appears on stderr, and that results know nothing of it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use crate::common::*;
use std::process::Output;

const POINTS: usize = 1000;

/// A comparison of a thousand points with the unit cube.
fn compared(style: &[&str]) -> Output {
    let f = Folder::new();
    let cube = f.write("cube.off", CUBE);
    let header = format!(
        "ply\nformat ascii 1.0\nelement vertex {POINTS}\n{}end_header\n",
        ["x", "y", "z"].map(|k| format!("property double {k}\n")).concat()
    );
    let points: String = (0..POINTS).map(|i| format!("{} 0.5 2\n", i as f64 / POINTS as f64)).collect();
    let points = f.write("points.ply", header + &points);
    let o = trueness(
        ["compare".as_ref(), points.as_os_str(), cube.as_os_str()]
            .into_iter()
            .chain(style.iter().map(AsRef::as_ref)),
    );
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    o
}

#[test]
fn json_lines_tell_stage_count_and_rate() {
    let o = compared(&["--progress", "json"]);
    let last: serde_json::Value = serde_json::from_str(stderr(&o).lines().last().unwrap()).unwrap();
    assert_eq!(
        (&last["event"], &last["stage"], &last["unit"]),
        (&"progress".into(), &"comparing".into(), &"points".into())
    );
    assert_eq!((&last["done"], &last["total"]), (&POINTS.into(), &POINTS.into()));
    assert!(last["per_second"].as_f64().unwrap() > 0.0);
    assert_eq!(last["seconds_left"], 0.0);
}

#[test]
fn plain_lines_are_for_people() {
    let text = stderr(&compared(&["--progress", "plain"]));
    assert!(text.starts_with("comparing: 1,000 of 1,000 points, "), "{text}");
    assert!(text.ends_with(" M/s, 0 s left\n"), "{text}");
}

#[test]
fn away_from_a_terminal_there_is_none() {
    let plain = compared(&["--progress", "plain"]);
    for style in [&["--progress", "none"][..], &["--progress", "auto"], &[]] {
        let o = compared(style);
        assert_eq!(stderr(&o), "", "{style:?}");
        let without_paths = |o: &Output| stdout(o).lines().skip(3).map(String::from).collect::<Vec<_>>();
        assert_eq!(without_paths(&o), without_paths(&plain));
    }
}

/// The last line of each stage of a command that answers.
fn ends(args: &[&std::ffi::OsStr]) -> Vec<serde_json::Value> {
    let o = trueness(args.iter().copied().chain(["--progress".as_ref(), "json".as_ref()]));
    assert!(status(&o) < 2, "{}", stderr(&o));
    let lines = stderr(&o);
    let events: Vec<serde_json::Value> = lines.lines().filter_map(|l| serde_json::from_str(l).ok()).collect();
    events.into_iter().filter(|e| e["event"] == "progress").collect()
}

#[test]
fn every_stage_ends_at_its_total_and_counts_what_it_names() {
    let f = Folder::new();
    let cube = f.write("cube.off", CUBE);
    let ring = |i: usize| libm::sincos(i as f64 * 0.37);
    let round: String =
        (0..400).map(|i| format!("{} {} {}\n", ring(i).0, ring(i).1, 0.01 * i as f64)).collect();
    let points = f.write("points.xyz", round);
    let plan = f.write(
        "plan.toml",
        "schema = \"trueness/plan/1\"\nfeature = [{ id = \"A\", shape = \"cylinder\", points = \"points.xyz\" }]\n\
         characteristic = [{ id = \"1\", kind = \"cylindricity\", feature = \"A\", tolerance = 0.5 }]\n",
    );
    let html = f.file("page.html");
    let report = ["--html".as_ref(), html.as_os_str()];
    let (cube, points, plan) = (cube.as_os_str(), points.as_os_str(), plan.as_os_str());
    let of = |args: &[&'static str], file: &std::ffi::OsStr, with: bool| {
        let mut all: Vec<std::ffi::OsString> = args.iter().map(Into::into).collect();
        all.insert(1, file.into());
        if with {
            all.extend(report.iter().map(Into::into));
        }
        ends(&all.iter().map(|a| a.as_os_str()).collect::<Vec<_>>())
    };
    // The command, and how many of what its first stage does.
    let runs: [(Vec<serde_json::Value>, &str, Option<u64>); 8] = [
        (of(&["check"], cube, true), "facets", Some(12)),
        (of(&["segment"], cube, true), "facets", Some(12)),
        (of(&["segment"], points, false), "points", Some(400)),
        (of(&["fit", "--shape", "cylinder"], points, true), "points", Some(400)),
        (of(&["fit", "--shape", "plane", "--method", "minimum-zone"], points, false), "points", Some(400)),
        (of(&["curvature"], points, false), "patches", Some(160)),
        (of(&["curvature", "--independent"], points, false), "places", Some(400)),
        (of(&["inspect"], plan, true), "steps", Some(7)),
    ];
    for (stages, unit, total) in runs {
        let first = &stages[0];
        assert_eq!((first["unit"].as_str(), first["total"].as_u64()), (Some(unit), total), "{first}");
        for stage in stages {
            assert_eq!(stage["ended"], true, "{stage}");
            assert_eq!(stage["done"], stage["total"], "{stage}");
        }
    }
}

//! `--progress`: what appears on stderr, and that results know nothing of it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;
use common::*;
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

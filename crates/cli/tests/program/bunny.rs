//! The main job on real data: the bunny's ten range scans against its model and the three coarser ones.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use crate::common::*;
use serde_json::Value;

fn words() -> Vec<std::ffi::OsString> {
    let mut words: Vec<std::ffi::OsString> = vec!["compare".into(), corpus("bunny/scans.ply").into()];
    words.extend((1..=4).map(|i| corpus(&format!("bunny/zipper_res{i}.ply")).into()));
    words
}

/// Every number of `corpus/bunny/reference.json`, which another program computed, to 1e-9.
#[test]
fn statistics_equal_the_reference() {
    let mut all = words();
    all.extend(["--sign".into(), "none".into()]);
    let d = document(all);
    let reference: Value =
        serde_json::from_slice(&std::fs::read(corpus("bunny/reference.json")).unwrap()).unwrap();
    assert_eq!(d["measured"]["count"], reference["points"]);
    let models = reference["models"].as_array().unwrap();
    assert_eq!(d["comparisons"].as_array().unwrap().len(), models.len());
    for (i, model) in models.iter().enumerate() {
        let c = &d["comparisons"][i];
        assert_eq!(c["rank"], i + 1, "finer is better");
        assert!(c["reference"].as_str().unwrap().ends_with(model["file"].as_str().unwrap()));
        let s = &c["deviation"]["all"];
        let mut compared = 0;
        for (key, want) in model.as_object().unwrap().iter().filter(|(k, _)| *k != "file") {
            let got = if key == "p95" { &s["percentiles"]["95"] } else { &s[key] };
            let (got, want) = (got.as_f64().unwrap(), want.as_f64().unwrap());
            let close = (got - want).abs() <= 1e-9 * want.abs();
            // Below a nanometer the reference's own rounding shows: its distances are good to 1e-13 mm.
            assert!(close || (got - want).abs() < 1e-12, "{} {key}: {got} instead of {want}", model["file"]);
            compared += 1;
        }
        assert_eq!(compared, 10);
    }
    let paired = d["paired"].as_array().unwrap();
    assert_eq!(paired.len(), 6);
    for p in paired {
        assert!(p["better"].as_u64() < p["other"].as_u64() && p["mean_difference"].as_f64().unwrap() < 0.0);
        assert!(p["interval"][1].as_f64().unwrap() < 0.0, "the difference is significant");
    }
}

/// The model is open at its foot: the winding number decides, and the two methods hardly disagree.
#[test]
fn open_model_is_signed_by_winding_number() {
    let d = document(words());
    for c in d["comparisons"].as_array().unwrap() {
        assert_eq!(c["sign"]["method"], "winding");
        assert!(c["sign"]["reason"].as_str().unwrap().contains("open at"));
        assert_eq!(c["soundness"]["closed"], false);
        let count = |part: &str| c["deviation"][part]["count"].as_u64().unwrap();
        assert!(count("positive") + count("negative") <= count("all") && count("negative") > 10_000);
    }
    assert!(d["comparisons"][0]["sign"]["disagreement"].as_f64().unwrap() < 0.02);
}

#[test]
fn same_bytes_on_any_number_of_threads() {
    let with = |threads: &str| {
        let mut all = words();
        all.extend(["--threads", threads, "--json", "-"].map(Into::into));
        let o = trueness(all);
        assert_eq!(status(&o), 0);
        o.stdout
    };
    let one = with("1");
    assert!(one == with("2"));
    assert!(one == with("5"));
}

#[test]
fn table_ranks_the_models() {
    let o = trueness(words());
    let text = stdout(&o);
    let rows: Vec<&str> =
        text.lines().filter(|l| l.contains("zipper_res") && l.contains("362,272")).collect();
    assert_eq!(rows.len(), 4, "{text}");
    assert!(rows[0].starts_with('1') && rows[0].contains("zipper_res1.ply"));
    assert!(rows[3].starts_with('4') && rows[3].contains("zipper_res4.ply"));
    assert!(!text.contains("NaN"));
}

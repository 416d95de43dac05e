//! Each task by the command line and by its function: the same document and page to the byte, and one outcome for document, page and exit
//! status.
#![allow(clippy::unwrap_used, clippy::panic)]

use crate::common::{Folder, corpus, status, stderr, stdout, trueness};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use trueness::task::{Done, Outcome, Request};
use trueness::tasks::align::AlignRequest;
use trueness::tasks::check::CheckRequest;
use trueness::tasks::compare::CompareRequest;
use trueness::tasks::convert::ConvertRequest;
use trueness::tasks::curvature::CurvatureRequest;
use trueness::tasks::fit::FitRequest;
use trueness::tasks::info::InfoRequest;
use trueness::tasks::inspect::InspectRequest;
use trueness::tasks::plan_init::PlanInitRequest;
use trueness::tasks::repair::RepairRequest;
use trueness::tasks::section::SectionRequest;
use trueness::tasks::segment::SegmentRequest;
use trueness::tasks::surface::SurfaceRequest;
use trueness::tasks::trend::TrendRequest;
use trueness_files::FileSources;
use trueness_geom::progress::Silent;
use trueness_report::{ReportOptions, Subject};

/// The request of JSON, and what it answers.
fn run<R: Request>(request: Value) -> Done<R::Document> {
    let request: R = serde_json::from_value(request).unwrap_or_else(|e| panic!("{}: {e}", R::COMMAND));
    request.run(&FileSources, &Silent).unwrap_or_else(|e| panic!("{}: {e}", R::COMMAND))
}

/// What the program says to words.
fn program(words: &str) -> (i32, String) {
    let out = trueness(words.split_whitespace());
    assert!(stderr(&out).is_empty(), "{words}: {}", stderr(&out));
    (status(&out), stdout(&out))
}

fn exit(outcome: Outcome) -> i32 {
    match outcome {
        Outcome::Conforming => 0,
        Outcome::NotConforming => 1,
        Outcome::Unanswered(_) => 3,
    }
}

/// The document of the command, and its exit status, are those of the function.
fn document<R: Request>(words: &str, request: Value) -> i32 {
    let done = run::<R>(request);
    let (status, text) = program(&format!("{} {words} --json -", R::COMMAND));
    assert_eq!(text, done.json().unwrap(), "{words}");
    assert_eq!(status, exit(done.outcome), "{words}");
    status
}

/// The same, with the page, whose head agrees with the exit status.
fn page<R: Request<Document: Subject>>(words: &str, request: Value) -> i32 {
    let mut with_view = request.clone();
    // The page of a trend draws nothing in space.
    if R::COMMAND != TrendRequest::COMMAND {
        with_view["view"] = json!(true);
    }
    let status = document::<R>(words, request);
    let done = run::<R>(with_view);
    let folder = Folder::new();
    let html = folder.file("page.html");
    let words = format!("{} {words} --quiet --html {}", R::COMMAND, html.display());
    assert_eq!(program(&words).0, status, "{words}");
    let written = std::fs::read_to_string(&html).unwrap();
    let made = done.report(&ReportOptions::default(), &Silent).unwrap();
    assert_eq!(written.as_bytes(), made, "{words}");
    head_says(status, &written, &words);
    status
}

/// The head of a page says pass or nothing where the exit status is 0, and neither where it is 1.
fn head_says(status: i32, page: &str, words: &str) {
    let (_, head) = page.split_once("<header class=\"header h-").unwrap();
    let (tone, _) = head.split_once('"').unwrap();
    assert_eq!(["pass", "not_judged"].contains(&tone), status == 0, "{words}: {tone}, exit status {status}");
}

fn path(name: &str) -> String {
    corpus(name).display().to_string()
}

#[test]
fn meshes() {
    let [bunny, coarse, hole, cube] = [
        "bunny/zipper_res3.ply",
        "bunny/zipper_res4.ply",
        "broken/hole_one_triangle.stl",
        "shapes/trimesh__unit_cube.STL",
    ]
    .map(path);
    assert_eq!(page::<CheckRequest>(&hole, json!({"mesh": hole})), 1);
    assert_eq!(page::<CheckRequest>(&format!("{cube} --gap 0.001"), json!({"mesh": cube, "gap": 0.001})), 0);
    assert_eq!(
        page::<CompareRequest>(
            &format!("{bunny} {coarse}"),
            json!({"measured": bunny, "references": [coarse]})
        ),
        0
    );
    for (tolerance, expected) in [("0.001", 1), ("-90,+90", 0)] {
        let words = format!("{bunny} {coarse} --tolerance {tolerance} --min-coverage 0");
        let request =
            json!({"measured": bunny, "references": [coarse], "tolerance": tolerance, "min_coverage": 0});
        assert_eq!(page::<CompareRequest>(&words, request), expected, "{tolerance}");
    }
    document::<AlignRequest>(&format!("{bunny} {coarse}"), json!({"measured": bunny, "reference": coarse}));
    page::<CurvatureRequest>(&format!("{coarse} --degree 2"), json!({"input": coarse, "degree": 2}));
    page::<SegmentRequest>(&cube, json!({"input": cube}));
    assert_eq!(document::<InfoRequest>(&bunny, json!({"file": bunny})), 0);
    let folder = Folder::new();
    let out = folder.file("out.ply").display().to_string();
    page::<RepairRequest>(&format!("{hole} -o {out}"), json!({"mesh": hole, "out": out}));
    document::<ConvertRequest>(&format!("{cube} {out}"), json!({"input": cube, "out": out}));
}

#[test]
fn points() {
    let folder = Folder::new();
    let ring: String = (0..60u32)
        .map(|k| {
            let (s, c) = libm::sincos(0.1 * f64::from(k));
            format!("{} {}\n", 10.0 * c, 10.0 * s + 0.001 * f64::from(k % 3))
        })
        .collect();
    let ring = folder.write("ring.xyz", ring).display().to_string();
    page::<FitRequest>(&format!("{ring} --shape circle"), json!({"points": ring, "shape": "circle"}));
    page::<SectionRequest>(&ring, json!({"input": ring}));
    let franke = path("reference_surfaces/franke_400_noise.txt");
    for tolerance in [0.5, 1e-6] {
        let words = format!("{franke} --tolerance {tolerance}");
        let status = page::<SurfaceRequest>(&words, json!({"points": franke, "tolerance": tolerance}));
        assert_eq!(status, i32::from(tolerance < 1e-3), "{tolerance}");
    }
    let scan = path("examples/plate/scan.stl");
    let request = json!({"input": scan, "plane": [[0, 0, 1, 3]]});
    page::<SectionRequest>(&format!("{scan} --plane 0,0,1,3"), request);
}

#[test]
fn plans() {
    let folder = Folder::new();
    let [plan, nominal] = ["examples/plate/plate.toml", "examples/plate/nominal.stl"].map(path);
    let mut results = vec![];
    for measured in [None, Some(&nominal)] {
        let words = measured.map_or(plan.clone(), |m| format!("{plan} --measured {m}"));
        let request = json!({"plan": plan, "measured": measured.iter().collect::<Vec<_>>()});
        page::<InspectRequest>(&words, request);
        let json = folder.file(&format!("{}.json", results.len())).display().to_string();
        program(&format!("inspect {words} --quiet --json {json}"));
        results.push(json);
    }
    page::<TrendRequest>(&results.join(" "), json!({"results": results}));
    let out = folder.file("plan.toml");
    // What is not committed is not there: the program may write it.
    let done = run::<PlanInitRequest>(json!({"nominal": nominal, "out": out}));
    let (status, _) = program(&format!("plan init {nominal} -o {}", out.display()));
    assert_eq!(status, exit(done.outcome));
    assert!(done.document.text == std::fs::read_to_string(&out).unwrap(), "the plan is another");
}

/// Both pages of a trend say what its document and the exit status say: of parts that pass, and of one that does not.
#[test]
fn both_pages_of_a_trend_have_its_verdict() {
    let folder = Folder::new();
    let [nominal, cube] = ["examples/plate/nominal.stl", "shapes/trimesh__unit_cube.STL"].map(path);
    let plan = format!(
        "schema = \"trueness/plan/1\"\nmeasured = {nominal:?}\nreference = {nominal:?}\n[deviation]\ntolerance = 0.05\n"
    );
    let plan = folder.write("plan.toml", plan).display().to_string();
    let mut results = vec![];
    for (measured, verdict, expected) in [(&nominal, "pass", 0), (&cube, "fail", 1)] {
        let json = folder.file(&format!("{expected}.json")).display().to_string();
        program(&format!("inspect {plan} --measured {measured} --places --quiet --json {json}"));
        results.push(json);
        let done = run::<TrendRequest>(json!({"results": results}));
        assert_eq!(serde_json::to_value(done.document.verdict).unwrap(), verdict);
        let [html, map] = ["page.html", "map.html"].map(|name| folder.file(name));
        let words = format!("trend {} --quiet --html {}", results.join(" "), html.display());
        let words = format!("{words} --map {}", map.display());
        assert_eq!((program(&words).0, exit(done.outcome)), (expected, expected), "{words}");
        let made = trueness::tasks::trend::maps(&done.document).unwrap();
        assert_eq!(made.outcome, done.outcome);
        assert_eq!(std::fs::read(&map).unwrap(), made.report(&ReportOptions::default(), &Silent).unwrap());
        for page in [html, map] {
            let page = std::fs::read_to_string(page).unwrap();
            head_says(expected, &page, &words);
            assert!(page.contains(&format!("<header class=\"header h-{verdict}\"")), "{words}");
        }
    }
}

/// Each command of the program but the list of formats is a task, with a request of its name and a row here.
#[test]
fn every_command_is_a_task() {
    let (_, help) = program("--help");
    let lines =
        help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    // What goes on on a further line begins farther in.
    let listed = lines.filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')));
    let commands: BTreeSet<&str> = listed.filter_map(|line| line.split_whitespace().next()).collect();
    let tasks = [
        AlignRequest::COMMAND,
        CheckRequest::COMMAND,
        CompareRequest::COMMAND,
        ConvertRequest::COMMAND,
        CurvatureRequest::COMMAND,
        FitRequest::COMMAND,
        InfoRequest::COMMAND,
        InspectRequest::COMMAND,
        PlanInitRequest::COMMAND,
        RepairRequest::COMMAND,
        SectionRequest::COMMAND,
        SegmentRequest::COMMAND,
        SurfaceRequest::COMMAND,
        TrendRequest::COMMAND,
    ];
    let known = tasks.iter().filter_map(|task| task.split(' ').next());
    assert_eq!(commands, known.chain(["formats", "help"]).collect());
}

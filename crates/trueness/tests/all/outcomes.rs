//! A result document that is read back says the outcome of the one that was written.

use serde_json::{Value, json};
use std::collections::BTreeSet;
use trueness::document::ResultDocument;
use trueness::files::{FileSources, MemorySources, Sources};
use trueness::geom::progress::Silent;
use trueness::task::{Outcome, Request};
use trueness::tasks::align::AlignRequest;
use trueness::tasks::check::CheckRequest;
use trueness::tasks::compare::CompareRequest;
use trueness::tasks::convert::ConvertRequest;
use trueness::tasks::curvature::CurvatureRequest;
use trueness::tasks::fit::FitRequest;
use trueness::tasks::info::InfoRequest;
use trueness::tasks::inspect::InspectRequest;
use trueness::tasks::repair::RepairRequest;
use trueness::tasks::section::SectionRequest;
use trueness::tasks::segment::SegmentRequest;
use trueness::tasks::surface::SurfaceRequest;
use trueness::tasks::trend::TrendRequest;

const CUBE: &str = "../../corpus/shapes/trimesh__unit_cube.STL";
const HOLE: &str = "../../corpus/broken/hole_one_triangle.stl";
const FINE: &str = "../../corpus/bunny/zipper_res3.ply";
const SCAN: &str = "../../corpus/examples/plate/scan.stl";
const NOMINAL: &str = "../../corpus/examples/plate/nominal.stl";
const COARSE: &str = "../../corpus/bunny/zipper_res4.ply";

/// Runs a request and reads its document back: the command, the outcome and the document's text.
fn read_back<R: Request>(asked: Value, sources: &dyn Sources) -> (&'static str, Outcome, String)
where
    R::Document: ResultDocument,
{
    let request: R = serde_json::from_value(asked).unwrap();
    let done = request.run(sources, &Silent).unwrap();
    let text = done.json().unwrap();
    let read = serde_json::from_str(&text);
    let read: R::Document = read.unwrap_or_else(|e| panic!("{}: {e}: {text}", R::COMMAND));
    assert_eq!(Outcome::from(read.conforms()), done.outcome, "{}: {text}", R::COMMAND);
    (R::COMMAND, done.outcome, text)
}

/// The result of a plate whose middle is so high: with 0.1 it is not flat enough.
fn inspected(height: f64) -> (&'static str, Outcome, String) {
    let plan = "schema = \"trueness/plan/1\"\n[[feature]]\nid = \"A\"\nshape = \"plane\"\npoints = \"part.xyz\"\n\
                [[characteristic]]\nid = \"1\"\nkind = \"flatness\"\nfeature = \"A\"\ntolerance = 0.05\n";
    let points = format!("0 0 0\n9 0 0\n0 9 0\n9 9 0\n4 5 {height}\n");
    let sources: MemorySources =
        [("plan.toml", plan.to_string()), ("part.xyz", points)].into_iter().collect();
    read_back::<InspectRequest>(json!({"plan": "plan.toml"}), &sources)
}

/// The course of some results.
fn trend(results: [String; 3]) -> (&'static str, Outcome, String) {
    let named = (1..).zip(results).map(|(n, text)| (format!("part-{n}.json"), text));
    let sources: MemorySources = named.collect();
    read_back::<TrendRequest>(json!({"results": ["part-1.json", "part-2.json", "part-3.json"]}), &sources)
}

/// Points of z = x y / 100 over 30 by 30, each 0.5 from the next.
fn sheet() -> MemorySources {
    let point = |k: u32| {
        let (x, y) = (0.5 * f64::from(k % 60), 0.5 * f64::from(k / 60));
        format!("{x} {y} {}\n", x * y / 100.0)
    };
    [("sheet.xyz", (0..3600).map(point).collect::<String>())].into_iter().collect()
}

/// Points strewn over a square at z = 0, and a row of points beside it at z = 5.
fn floor_and_row() -> MemorySources {
    let spread = |k: u32, by: f64| 30.0 * (f64::from(k) * by).fract();
    let floor = (1..3000).map(|k| format!("{} {} 0\n", spread(k, 0.754_877_666), spread(k, 0.569_840_291)));
    let row = (0..60).map(|k| format!("50 {} 5\n", 0.5 * f64::from(k)));
    [("strewn.xyz", floor.chain(row).collect::<String>())].into_iter().collect()
}

#[test]
fn a_document_says_the_same_when_it_is_read_back() {
    let folder = std::env::temp_dir().join(format!("trueness-outcomes-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let mended = |mesh: &str, more: Value| {
        let mut asked = json!({"mesh": mesh, "out": folder.join("mended.stl")});
        asked.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        read_back::<RepairRequest>(asked, &FileSources)
    };
    let [first, second, third, fails] = [0.02, 0.022, 0.021, 0.1].map(inspected);
    let [one, two, three, bad] = [&first, &second, &third, &fails].map(|part| part.2.clone());
    let slab = json!({"input": "strewn.xyz", "plane": [[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 50.0]], "thickness": 1});
    let corner = json!({"input": CUBE, "plane": [[0.0, 0.0, 1.0, 0.25]]});
    let all = [
        (read_back::<CheckRequest>(json!({"mesh": CUBE}), &FileSources), true),
        (read_back::<CheckRequest>(json!({"mesh": HOLE}), &FileSources), false),
        (read_back::<InfoRequest>(json!({"file": CUBE}), &FileSources), true),
        (
            read_back::<ConvertRequest>(json!({"input": CUBE, "out": folder.join("cube.ply")}), &FileSources),
            true,
        ),
        (mended(HOLE, json!({})), true),
        (mended(HOLE, json!({"only": ["orient"]})), false),
        (read_back::<CompareRequest>(json!({"measured": FINE, "references": [COARSE]}), &FileSources), true),
        (
            read_back::<CompareRequest>(
                json!({"measured": FINE, "references": [COARSE], "tolerance": "0.00001"}),
                &FileSources,
            ),
            false,
        ),
        // Its pose does not come to rest.
        (read_back::<AlignRequest>(json!({"measured": FINE, "reference": COARSE}), &FileSources), false),
        (read_back::<AlignRequest>(json!({"measured": SCAN, "reference": NOMINAL}), &FileSources), true),
        (read_back::<FitRequest>(json!({"points": "sheet.xyz", "shape": "plane"}), &sheet()), true),
        (read_back::<SegmentRequest>(json!({"input": CUBE}), &FileSources), true),
        (read_back::<CurvatureRequest>(json!({"input": COARSE}), &FileSources), true),
        (read_back::<SurfaceRequest>(json!({"points": "sheet.xyz"}), &sheet()), true),
        (read_back::<SurfaceRequest>(json!({"points": COARSE, "spans": "4x4"}), &FileSources), false),
        (read_back::<SectionRequest>(corner, &FileSources), true),
        // The first slab lies in the floor.
        (read_back::<SectionRequest>(slab, &floor_and_row()), false),
        (trend([one.clone(), two.clone(), three]), true),
        (trend([one, two, bad]), false),
        (first, true),
        (fails, false),
    ];
    for ((command, outcome, text), conforms) in &all {
        assert_eq!(*outcome, Outcome::from(*conforms), "{command}: {text}");
    }
    // A plan is no result.
    let told: BTreeSet<&str> = all.iter().map(|(told, _)| told.0).collect();
    let documents: BTreeSet<&str> = trueness::document::schemas()
        .into_iter()
        .map(|(name, _)| name)
        .filter(|name| *name != "plan")
        .collect();
    assert_eq!(told, documents);
    std::fs::remove_dir_all(&folder).unwrap();
}

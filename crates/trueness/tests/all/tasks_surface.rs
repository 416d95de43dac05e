//! A surface asked by JSON, of a file and of memory.

use crate::common::{is_read_back, refuses_what_it_lacks};
use serde_json::json;
use trueness::files::{FileSources, MemorySources};
use trueness::geom::progress::Silent;
use trueness::task::Request;
use trueness::tasks::surface::SurfaceRequest;

const INPUT: &str = "../../corpus/bunny/zipper_res4.ply";

fn request() -> SurfaceRequest {
    serde_json::from_value(
        json!({ "points": INPUT, "spans": "5x4", "base": "sphere", "fairness": "0.01", "trim": "auto" }),
    )
    .unwrap()
}

#[test]
fn memory_gives_the_document_of_the_file() {
    let request = request();
    let sources: MemorySources = [(INPUT, std::fs::read(INPUT).unwrap())].into_iter().collect();
    let memory = request.run(&sources, &Silent).unwrap();
    let file = request.run(&FileSources, &Silent).unwrap();
    assert_eq!(memory.json().unwrap(), file.json().unwrap());
    let document = memory.document;
    assert_eq!((document.control_points.len(), document.control_points[0].len()), (8, 7));
    assert_eq!((document.base.kind.name(), document.fairness_from.as_str()), ("sphere", "given"));
    assert!(document.trim.is_some() && memory.outputs.is_empty() && memory.scene.is_none());
}

#[test]
fn a_request_is_read_back_as_it_was_written() {
    is_read_back(&request());
}

#[test]
fn an_unknown_field_is_refused_by_its_name() {
    refuses_what_it_lacks::<SurfaceRequest>(json!({ "points": INPUT }));
}

#[test]
fn knots_come_from_memory_too() {
    let flat: String = (0..36).map(|k| format!("{} {} {}\n", k % 6, k / 6, 0.1 * f64::from(k % 5))).collect();
    let knots = r#"{"u": [0, 0, 0, 5, 5, 5], "v": [0, 0, 0, 5, 5, 5]}"#;
    let sources: MemorySources =
        [("flat.xyz", flat), ("knots.json", knots.to_string())].into_iter().collect();
    let asked = json!({ "points": "flat.xyz", "knots": "knots.json", "base": "xy", "fairness": "0" });
    let request: SurfaceRequest = serde_json::from_value(asked).unwrap();
    let done = request.run(&sources, &Silent).unwrap();
    assert_eq!((done.document.degree, done.document.knots.u.len()), ([2, 2], 6));
    let missing = SurfaceRequest { knots: Some("knot.json".into()), ..request };
    let said = missing.run(&sources, &Silent).err().unwrap().to_string();
    assert_eq!(said, "knot.json: the knots cannot be read; check the path");
}

#[test]
fn files_are_in_their_places_once_they_are_committed() {
    let folder = std::env::temp_dir().join(format!("trueness-surface-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let step = folder.join("surface.stp");
    let request = SurfaceRequest { step: Some(step.clone()), view: true, ..request() };
    request.files(&FileSources).unwrap().check(&Silent).unwrap();
    let mut done = request.run(&FileSources, &Silent).unwrap();
    assert!(!step.exists() && done.scene.is_some());
    done.commit().unwrap();
    let text = std::fs::read_to_string(&step).unwrap();
    assert!(text.starts_with("ISO-10303-21;"), "{text}");
    std::fs::remove_dir_all(&folder).unwrap();
}

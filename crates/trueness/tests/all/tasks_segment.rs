//! Regions asked by JSON, of a file and of memory.

use crate::common::{is_read_back, refuses_what_it_lacks};
use serde_json::json;
use trueness::files::{FileSources, MemorySources};
use trueness::geom::progress::Silent;
use trueness::task::Request;
use trueness::tasks::segment::SegmentRequest;

const INPUT: &str = "../../corpus/shapes/trimesh__angle_block.STL";

fn request() -> SegmentRequest {
    serde_json::from_value(
        json!({ "input": INPUT, "shapes": ["plane"], "min_share": 1.0, "members": true, "seed": 2 }),
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
    let regions = &memory.document.regions;
    assert!(!regions.is_empty() && regions.iter().all(|r| r.shape.name() == "plane" && r.share >= 0.01));
    assert!(regions.iter().all(|r| r.members.as_ref().unwrap().len() as u64 == r.pieces));
    assert!(memory.outputs.is_empty() && memory.scene.is_none());
}

#[test]
fn a_request_is_read_back_as_it_was_written() {
    is_read_back(&request());
}

#[test]
fn an_unknown_field_is_refused_by_its_name() {
    refuses_what_it_lacks::<SegmentRequest>(json!({ "input": INPUT }));
}

#[test]
fn files_are_in_their_places_once_they_are_committed() {
    let folder = std::env::temp_dir().join(format!("trueness-segment-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let out = folder.join("regions.csv");
    let request = SegmentRequest { out: Some(out.clone()), view: true, ..request() };
    request.files(&FileSources).unwrap().check(&Silent).unwrap();
    let mut done = request.run(&FileSources, &Silent).unwrap();
    assert!(!out.exists() && done.scene.is_some());
    done.commit().unwrap();
    let text = std::fs::read_to_string(&out).unwrap();
    assert!(text.starts_with("x,y,z,region\n"), "{text}");
    std::fs::remove_dir_all(&folder).unwrap();
}

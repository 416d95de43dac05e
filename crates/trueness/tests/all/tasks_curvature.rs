//! Curvatures asked by JSON, of a file and of memory.

use crate::common::{is_read_back, refuses_what_it_lacks};
use serde_json::json;
use trueness::files::{FileSources, MemorySources};
use trueness::geom::progress::Silent;
use trueness::task::{ErrorKind, Request};
use trueness::tasks::curvature::CurvatureRequest;

const INPUT: &str = "../../corpus/bunny/zipper_res4.ply";

fn request() -> CurvatureRequest {
    serde_json::from_value(
        json!({ "input": INPUT, "degree": 4, "neighbors": 50, "boundary": true, "color": "gaussian" }),
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
    assert_eq!((memory.document.degree, memory.document.boundary), (4, true));
    assert!(memory.outputs.is_empty() && memory.scene.is_none());
}

#[test]
fn a_request_is_read_back_as_it_was_written() {
    is_read_back(&request());
}

#[test]
fn an_unknown_field_is_refused_by_its_name() {
    refuses_what_it_lacks::<CurvatureRequest>(json!({ "input": INPUT }));
}

#[test]
fn a_neighborhood_is_said_in_one_way() {
    let request = CurvatureRequest { radius: Some(2.0), ..request() };
    let error = request.run(&FileSources, &Silent).err().unwrap();
    assert_eq!(error.kind(), ErrorKind::Usage);
    assert!(error.to_string().contains("--neighbors and --radius"), "{error}");
}

#[test]
fn files_are_in_their_places_once_they_are_committed() {
    let folder = std::env::temp_dir().join(format!("trueness-curvature-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let out = folder.join("curvature.csv");
    let request = CurvatureRequest { out: Some(out.clone()), view: true, ..request() };
    request.files(&FileSources).unwrap().check(&Silent).unwrap();
    let mut done = request.run(&FileSources, &Silent).unwrap();
    assert!(!out.exists() && done.scene.is_some());
    done.commit().unwrap();
    let text = std::fs::read_to_string(&out).unwrap();
    assert!(text.starts_with("x,y,z,nx,ny,nz,k1,k2,"), "{text}");
    std::fs::remove_dir_all(&folder).unwrap();
}

//! An element asked by JSON, of a file and of memory.

use crate::common::{is_read_back, refuses_what_it_lacks};
use serde_json::json;
use trueness::files::{FileSources, MemorySources};
use trueness::geom::progress::Silent;
use trueness::task::{ErrorKind, Request};
use trueness::tasks::fit::FitRequest;

const INPUT: &str = "../../corpus/reference_fits/sphere_02_hemisphere.xyz";

fn request() -> FitRequest {
    serde_json::from_value(json!({ "points": INPUT, "shape": "sphere", "method": "minimum-zone", "independent": true, "seed": 3 })).unwrap()
}

#[test]
fn memory_gives_the_document_of_the_file() {
    let request = request();
    let sources: MemorySources = [(INPUT, std::fs::read(INPUT).unwrap())].into_iter().collect();
    let memory = request.run(&sources, &Silent).unwrap();
    let file = request.run(&FileSources, &Silent).unwrap();
    assert_eq!(memory.json().unwrap(), file.json().unwrap());
    let document = memory.document;
    assert_eq!((document.method.name(), document.seed), ("minimum-zone", 3));
    assert_eq!(document.shared_noise_reason.unwrap(), "errors are independent, as --independent says");
    assert!(memory.scene.is_none());
}

#[test]
fn a_request_is_read_back_as_it_was_written() {
    is_read_back(&request());
}

#[test]
fn an_unknown_field_is_refused_by_its_name() {
    refuses_what_it_lacks::<FitRequest>(json!({ "points": INPUT }));
}

#[test]
fn a_shape_has_to_be_given() {
    let request = FitRequest { shape: None, ..request() };
    let error = request.run(&FileSources, &Silent).err().unwrap();
    assert_eq!(error.kind(), ErrorKind::Usage);
    assert!(error.to_string().contains("line, plane, circle"), "{error}");
}

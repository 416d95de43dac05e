//! A repair as an object of JSON, on files and in memory.

use serde_json::json;
use std::path::Path;
use trueness::files::{FileSources, MemorySources};
use trueness::geom::progress::Silent;
use trueness::task::{ErrorKind, Request};
use trueness::tasks::repair::RepairRequest;

const MESH: &str = "../../corpus/broken/hole_one_triangle.stl";

fn request(out: &Path) -> serde_json::Value {
    json!({"mesh": MESH, "out": out, "skip": ["outward"], "gap": 0.001, "items": 3, "view": true})
}

#[test]
fn memory_gives_the_document_of_files() {
    let folder = std::env::temp_dir().join(format!("trueness-tasks-repair-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let out = folder.join("mended.ply");
    let request: RepairRequest = serde_json::from_value(request(&out)).unwrap();
    let mut of_files = request.run(&FileSources, &Silent).unwrap();
    let memory: MemorySources = [(MESH, std::fs::read(MESH).unwrap())].into_iter().collect();
    let of_memory = request.run(&memory, &Silent).unwrap();
    assert_eq!(of_memory.json().unwrap(), of_files.json().unwrap());
    assert_eq!(of_memory.outcome, of_files.outcome);
    let page = |done: &trueness::task::Done<_>| done.report(&Default::default(), &Silent).unwrap();
    assert!(page(&of_memory) == page(&of_files));
    assert!(!out.exists(), "nothing is in its place before it is committed");
    of_files.commit().unwrap();
    assert!(out.exists());
    drop((of_files, of_memory));
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1, "nothing is left beside it");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn what_cannot_be_meant_is_refused() {
    let error = serde_json::from_str::<RepairRequest>(r#"{"mesh": "a.stl", "wield": 0.1}"#).unwrap_err();
    assert!(error.to_string().contains("`wield`"), "{error}");
    for (asked, said) in [
        (json!({"mesh": "a.stl"}), "--out or --in-place"),
        (
            json!({"mesh": "a.stl", "in_place": true, "only": ["orient"], "skip": ["outward"]}),
            "--only and --skip",
        ),
        (
            json!({"mesh": "a.stl", "in_place": true, "only": ["polish"]}),
            "--only polish: there is no such step",
        ),
        (json!({"mesh": "a.stl", "in_place": true, "gap": -1.0}), "--gap -1: give a number"),
    ] {
        let request: RepairRequest = serde_json::from_value(asked).unwrap();
        let Err(error) = request.run(&MemorySources::new(), &Silent) else { panic!("{said}: not refused") };
        assert_eq!(error.kind(), ErrorKind::Usage, "{error}");
        assert!(error.to_string().contains(said), "{error}");
    }
}

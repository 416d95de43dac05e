//! A proposed plan as an object of JSON, on files and in memory.

use trueness::files::{FileSources, MemorySources};
use trueness::geom::progress::Silent;
use trueness::task::{ErrorKind, Request};
use trueness::tasks::plan_init::PlanInitRequest;

const NOMINAL: &str = "../../corpus/shapes/mayo__258_cube.off";

#[test]
fn memory_gives_the_plan_of_files() {
    let asked = format!(r#"{{"nominal": "{NOMINAL}", "units": "in", "seed": 3}}"#);
    let request: PlanInitRequest = serde_json::from_str(&asked).unwrap();
    let of_files = request.run(&FileSources, &Silent).unwrap();
    let memory: MemorySources = [(NOMINAL, std::fs::read(NOMINAL).unwrap())].into_iter().collect();
    let of_memory = request.run(&memory, &Silent).unwrap();
    assert_eq!(of_memory.json().unwrap(), of_files.json().unwrap());
    assert!(
        of_files.document.text.contains("reference = \"mayo__258_cube.off\""),
        "{}",
        of_files.document.text
    );
    assert_eq!(of_files.document.inputs[0].unit_assumed, "in");
}

#[test]
fn what_cannot_be_meant_is_refused() {
    let error = serde_json::from_str::<PlanInitRequest>(r#"{"mesh": "mayo__258_cube.off"}"#).unwrap_err();
    assert!(error.to_string().contains("`mesh`"), "{error}");
    let there =
        PlanInitRequest { nominal: NOMINAL.into(), out: Some("Cargo.toml".into()), ..Default::default() };
    let error = there.run(&FileSources, &Silent).err().unwrap();
    assert_eq!((error.kind(), error.to_string().contains("the file exists")), (ErrorKind::Usage, true));
}

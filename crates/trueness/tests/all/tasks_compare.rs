//! A comparison asked for as JSON: the same from memory and from files, and wrong questions are refused.

use trueness::files::{FileSources, MemorySources, Sources};
use trueness::geom::progress::Silent;
use trueness::report::ReportOptions;
use trueness::task::{Done, ErrorKind, Outcome, Request, TaskError};
use trueness::tasks::compare::{CompareRequest, FacingAngle};
use trueness_document::compare::CompareDocument;

const SCAN: &str = "../../corpus/bunny/zipper_res3.ply";
const NOMINAL: &str = "../../corpus/bunny/zipper_res4.ply";
const REGIONS: &str = "regions of a part.toml";
const SCALE: &str = "scale of a part.json";

/// A folder of this run, which is removed at its end.
struct Folder(std::path::PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("tasks_compare_{name}_{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
    fn path(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn request(json: &serde_json::Value) -> CompareRequest {
    serde_json::from_value(json.clone()).unwrap()
}

fn run(request: &CompareRequest, sources: &dyn Sources) -> Result<Done<CompareDocument>, TaskError> {
    request.run(sources, &Silent)
}

#[test]
fn memory_and_files_give_the_same() {
    let folder = Folder::new("same");
    let [regions, scale] = [REGIONS, SCALE].map(|name| folder.path(name));
    let text = "[[region]]\nid = \"ear\"\nbetween = [[-100, 150, -100], [0, 200, 0]]\ntolerance = [-9, 9]\n";
    std::fs::write(&regions, text).unwrap();
    let drawn = trueness_document::scale::Scale::for_deviations(7.0, None);
    std::fs::write(&scale, serde_json::to_string(&drawn).unwrap()).unwrap();
    let asked = request(&serde_json::json!({
        "measured": SCAN, "references": [NOMINAL], "units": "mm", "tolerance": "-5,+5", "inside": 90,
        "regions": regions, "scale": scale, "facing": 60, "outliers": "mad:9", "coverage": "auto", "worst": 2,
        "both": true, "seed": 3, "view": true
    }));
    assert!(asked.view);
    let mut memory = MemorySources::new();
    for name in [SCAN, NOMINAL, &regions, &scale] {
        memory.insert(name, std::fs::read(name).unwrap());
    }
    let [of_files, of_memory] = [&FileSources as &dyn Sources, &memory].map(|s| run(&asked, s).unwrap());
    assert_eq!(of_files.json().unwrap(), of_memory.json().unwrap());
    assert_eq!(of_files.outcome, of_memory.outcome);
    let page = |done: &Done<CompareDocument>| done.report(&ReportOptions::default(), &Silent).unwrap();
    assert!(page(&of_files) == page(&of_memory));
    let document = &of_memory.document;
    assert_eq!((document.scale.upper, document.seed, document.comparisons.len()), (7.0, 3, 1));
    assert!(document.inputs.iter().all(|input| input.sha256.is_some()));
    assert_eq!(document.comparisons[0].regions[0].id, "ear");
    assert!(document.comparisons[0].reverse.is_some() && document.facing.is_some());
    assert_eq!(document.sampling.unwrap().shown, 1889);
}

#[test]
fn files_of_points_are_in_their_places_after_commit() {
    let folder = Folder::new("points");
    let there = || std::fs::read_dir(&folder.0).unwrap().count();
    for (n, name) in ["a.csv", "b.ply"].into_iter().enumerate() {
        let asked = request(&serde_json::json!({
            "measured": SCAN, "references": [NOMINAL, SCAN], "out": folder.path(name)
        }));
        drop(run(&asked, &FileSources).unwrap());
        assert_eq!(there(), 2 * n, "{name}");
        let mut done = run(&asked, &FileSources).unwrap();
        assert_eq!(done.outcome, Outcome::Conforming);
        done.commit().unwrap();
        assert_eq!(there(), 2 * n + 2, "{name}");
    }
    let points = trueness::read(folder.path("b.2.ply")).unwrap();
    assert_eq!(points.points().len(), 1889);
}

#[test]
fn a_request_is_the_same_there_and_back() {
    let facing = Some(FacingAngle::try_from(60.0).unwrap());
    let request = CompareRequest {
        measured: SCAN.into(),
        references: vec![NOMINAL.into()],
        tolerance: Some("-0.1,+0.2".parse().unwrap()),
        along: Some("0,0,1".parse().unwrap()),
        normals: Some("nx,ny,nz".parse().unwrap()),
        facing,
        view: true,
        ..CompareRequest::default()
    };
    let json = serde_json::to_value(&request).unwrap();
    assert_eq!((&json["tolerance"], &json["facing"]), (&"-0.1,+0.2".into(), &60.0.into()));
    assert_eq!(serde_json::from_value::<CompareRequest>(json).unwrap(), request);
}

#[test]
fn what_cannot_be_meant_is_refused() {
    for (json, said) in [
        (r#"{"max_distanc": 1}"#, "unknown field `max_distanc`"),
        (r#"{"facing": 0}"#, "‘0’ is no angle between normals"),
        (r#"{"method": "fast"}"#, "unknown variant `fast`"),
    ] {
        let error = serde_json::from_str::<CompareRequest>(json).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    for (json, said) in [
        (serde_json::json!({ "references": [] }), "there is no reference; give at least one"),
        (serde_json::json!({ "worst": 0 }), "--worst 0: give a number from 1 to 1000"),
        (serde_json::json!({ "worst": 1001 }), "--worst 1001: give a number from 1 to 1000"),
        (serde_json::json!({ "sample": 0 }), "--sample 0: give a number from 1 upwards"),
        (serde_json::json!({ "inside": 90 }), "--inside 90 is a share within a tolerance; give --tolerance"),
        (serde_json::json!({ "weld": -1.0 }), "--weld -1: give a number from 0 upwards"),
        (serde_json::json!({ "along": "reference", "both": true }), "leave --along out"),
    ] {
        let mut asked = serde_json::json!({ "measured": SCAN, "references": [NOMINAL] });
        asked.as_object_mut().unwrap().extend(json.as_object().unwrap().clone());
        let error = run(&request(&asked), &FileSources).err().unwrap();
        assert_eq!(error.kind(), ErrorKind::Usage, "{error}");
        assert!(error.to_string().contains(said), "{error}");
    }
}

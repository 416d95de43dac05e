//! A trend as an object of JSON, on files and in memory.

use serde_json::json;
use trueness::document::trend::TrendDocument;
use trueness::files::{FileSources, MemorySources};
use trueness::geom::progress::Silent;
use trueness::task::{Done, ErrorKind, Outcome, Request};
use trueness::tasks::inspect::InspectRequest;
use trueness::tasks::trend::{TrendRequest, maps};

const PLAN: &str = "schema = \"trueness/plan/1\"\n[[feature]]\nid = \"A\"\nshape = \"plane\"\npoints = \"part.xyz\"\n\
                    [[characteristic]]\nid = \"1\"\nkind = \"flatness\"\nfeature = \"A\"\ntolerance = 0.025\n";

/// The results of three parts, of which the last one fails.
fn results() -> Vec<(String, String)> {
    let mut sources = MemorySources::new();
    sources.insert("plan.toml", PLAN);
    let one = |n: usize| {
        sources.insert("part.xyz", format!("0 0 0\n9 0 0\n0 9 0\n9 9 0\n4 5 0.0{n}\n"));
        let request = InspectRequest { plan: "plan.toml".into(), ..InspectRequest::default() };
        (format!("part-{n}.json"), request.run(&sources, &Silent).unwrap().json().unwrap())
    };
    (1..=3).map(one).collect()
}

#[test]
fn memory_gives_the_document_of_files() {
    let folder = std::env::temp_dir().join(format!("trueness-tasks-trend-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let csv = folder.join("trend.csv");
    let (mut names, mut memory) = (vec![], MemorySources::new());
    for (name, text) in results() {
        let path = folder.join(name);
        std::fs::write(&path, &text).unwrap();
        memory.insert(path.clone(), text);
        names.push(path);
    }
    let asked = json!({"results": names, "csv": csv}).to_string();
    let request: TrendRequest = serde_json::from_str(&asked).unwrap();
    let mut of_files = request.run(&FileSources, &Silent).unwrap();
    let of_memory: Done<TrendDocument> = request.run(&memory, &Silent).unwrap();
    assert_eq!(of_memory.json().unwrap(), of_files.json().unwrap());
    assert_eq!((of_memory.outcome, of_memory.document.parts.len()), (Outcome::NotConforming, 3));
    assert!(!csv.exists(), "nothing is in its place before it is committed");
    of_files.commit().unwrap();
    assert_eq!(std::fs::read_to_string(&csv).unwrap().lines().count(), 2);
    let why = maps(&of_memory.document).err().unwrap().to_string();
    assert!(why.starts_with("there is no map: "), "{why}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn what_cannot_be_meant_is_refused() {
    let error = serde_json::from_str::<TrendRequest>(r#"{"result": []}"#).unwrap_err();
    assert!(error.to_string().contains("`result`"), "{error}");
    let error = TrendRequest::default().run(&MemorySources::new(), &Silent).err().unwrap();
    assert_eq!((error.kind(), error.to_string().as_str()), (ErrorKind::Usage, "there are no results"));
}

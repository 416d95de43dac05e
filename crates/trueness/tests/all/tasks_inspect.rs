//! An inspection as an object of JSON, on files and in memory.

use std::path::Path;
use trueness::document::ResultDocument;
use trueness::files::{FileSources, MemorySources};
use trueness::geom::progress::Silent;
use trueness::task::{Done, ErrorKind, Outcome, Request};
use trueness::tasks::inspect::{InspectRequest, Part};

const PLAN: &str = "schema = \"trueness/plan/1\"\nmeasured = \"first.off\"\nreference = \"square.off\"\n\
                    [deviation]\ntolerance = 0.2\nmax_distance = 3\n\
                    [[feature]]\nid = \"A\"\nshape = \"plane\"\npoints = \"own.xyz\"\n\
                    [[characteristic]]\nid = \"1\"\nkind = \"flatness\"\nfeature = \"A\"\ntolerance = 0.05\n";

/// A square whose corner lies at this height.
fn square(height: f64) -> String {
    format!("OFF\n4 2 0\n0 0 0\n9 0 0\n9 9 {height}\n0 9 0\n3 0 1 2\n3 0 2 3\n")
}

/// The plan with all that it names, in a folder.
fn files(folder: &Path) -> MemorySources {
    std::fs::create_dir_all(folder).unwrap();
    let all = [
        ("plan.toml", PLAN.to_string()),
        ("own.xyz", "0 0 0\n9 0 0\n0 9 0\n9 9 0.01\n4 4 0.02\n".into()),
        ("square.off", square(0.0)),
        ("first.off", square(0.1)),
        ("second.off", square(0.5)),
        ("broken.off", "OFF\n4 2 0\n0 0 0\n".into()),
    ];
    let one = |(name, text): (&str, String)| {
        std::fs::write(folder.join(name), &text).unwrap();
        (folder.join(name), text)
    };
    all.into_iter().map(one).collect()
}

fn folder(name: &str) -> std::path::PathBuf {
    std::env::temp_dir().join(format!("trueness-tasks-inspect-{name}-{}", std::process::id()))
}

#[test]
fn memory_gives_the_document_of_files() {
    let folder = folder("one");
    let memory = files(&folder);
    let (plan, qif) = (folder.join("plan.toml"), folder.join("result.qif"));
    let asked = serde_json::json!({"plan": plan, "places": true, "qif": qif, "seed": 2, "view": true});
    let request: InspectRequest = serde_json::from_str(&asked.to_string()).unwrap();
    let mut of_files = request.run(&FileSources, &Silent).unwrap();
    let of_memory = request.run(&memory, &Silent).unwrap();
    assert_eq!(of_memory.json().unwrap(), of_files.json().unwrap());
    assert_eq!(of_memory.outcome, Outcome::Conforming, "{}", of_memory.json().unwrap());
    let page =
        |done: &Done<_>| String::from_utf8(done.report(&Default::default(), &Silent).unwrap()).unwrap();
    assert!(page(&of_memory) == page(&of_files));
    assert!(of_files.document.deviation_map.is_some(), "places were asked for");
    assert!(!page(&of_files).contains("deviation_map"), "the page has a map of its own");
    assert!(!qif.exists(), "nothing is in its place before it is committed");
    of_files.commit().unwrap();
    assert!(std::fs::read_to_string(&qif).unwrap().contains("QIFDocument"));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_part_that_fails_does_not_stop_the_others() {
    let folder = folder("several");
    let memory = files(&folder);
    let measured = ["broken.off", "first.off", "second.off"].map(|name| folder.join(name));
    let csv = folder.join("parts.csv");
    let asked = serde_json::json!({"plan": folder.join("plan.toml"), "measured": measured, "csv": csv});
    let request: InspectRequest = serde_json::from_str(&asked.to_string()).unwrap();
    let error = request.run(&memory, &Silent).err().unwrap();
    assert!(error.kind() == ErrorKind::Usage && error.to_string().contains("hold one part"), "{error}");
    let inspecting = request.open(&memory, &Silent).unwrap();
    let parts: Result<Vec<Part>, _> = inspecting.parts().collect();
    let mut done = inspecting.finish(parts.unwrap()).unwrap();
    assert_eq!(done.outcome, Outcome::Unanswered(ErrorKind::Unanswerable));
    let conform: Vec<Option<bool>> = done.document.iter().map(|p| Some(p.document()?.conforms())).collect();
    assert_eq!(conform, [None, Some(true), Some(false)]);
    done.commit().unwrap();
    let table = std::fs::read_to_string(&csv).unwrap();
    assert!(table.contains("broken.off,part,part") && table.contains("second.off,1,flatness"), "{table}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn what_cannot_be_meant_is_refused() {
    let error = serde_json::from_str::<InspectRequest>(r#"{"plan": "a.toml", "mesured": []}"#).unwrap_err();
    assert!(error.to_string().contains("`mesured`"), "{error}");
    let mut memory = MemorySources::new();
    let deviation = "[deviation]\ntolerance = 0.2\nmax_distance = 3\n";
    memory.insert("plan.toml", PLAN.replace("measured = \"first.off\"\n", "").replace(deviation, ""));
    for (asked, kind, said) in [
        (r#"{"plan": "plan.toml", "measured": ["a.off"]}"#, ErrorKind::Usage, "the plan names none"),
        (r#"{"plan": "plan.toml", "places": true}"#, ErrorKind::Usage, "the plan has no [deviation]"),
        (
            r#"{"plan": "plan", "measured": ["a.off"]}"#,
            ErrorKind::Unanswerable,
            "plan: the plan cannot be read",
        ),
        (r#"{"plan": "a", "measured": ["a.off", "b.off"], "view": true}"#, ErrorKind::Usage, "hold one part"),
    ] {
        let request: InspectRequest = serde_json::from_str(asked).unwrap();
        let error = request.open(&memory, &Silent).err().unwrap();
        assert!(error.kind() == kind && error.to_string().contains(said), "{error}");
    }
}

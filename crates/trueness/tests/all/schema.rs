//! The schemas under `docs/schema/requests` are those of the types.

use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn kept_schemas_are_those_of_the_requests() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/schema/requests");
    for (name, schema) in trueness::tasks::schemas() {
        let kept = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
        assert!(
            kept == schema,
            "docs/schema/requests/{name}.json is not up to date: run `cargo xtask schema`"
        );
    }
}

/// Every task that there is, every schema that is given, and every file that is kept are the same.
#[test]
fn every_task_has_a_schema() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let list = std::fs::read_to_string(root.join("src/tasks/mod.rs")).unwrap();
    let modules = list.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
    let tasks: BTreeSet<String> = modules.map(|name| name.replace('_', "-")).collect();
    let given: BTreeSet<String> =
        trueness::tasks::schemas().into_iter().map(|(name, _)| name.into()).collect();
    assert_eq!(tasks, given, "the modules of `tasks/mod.rs` and its `schemas`");
    let kept = std::fs::read_dir(root.join("../../docs/schema/requests")).unwrap();
    let kept = kept.map(|file| file.unwrap().path().file_stem().unwrap().to_str().unwrap().to_string());
    assert_eq!(
        kept.collect::<BTreeSet<_>>(),
        given,
        "docs/schema/requests: run `cargo xtask schema`, and remove what is left over"
    );
    let told = |task: &String| list.contains(&format!("//! | `{}` |", task.replace('-', " ")));
    let untold: Vec<&String> = tasks.iter().filter(|task| !told(task)).collect();
    assert!(untold.is_empty(), "no row in the table of `tasks/mod.rs` for {untold:?}");
}

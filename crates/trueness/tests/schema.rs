//! The schemas under `docs/schema/requests` are those of the types.
#![allow(clippy::unwrap_used, missing_docs)]

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

//! The schemas under `docs/schema` are those of the types.

use std::path::Path;

#[test]
fn kept_schemas_are_those_of_the_types() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/schema");
    for (name, schema) in trueness_document::schemas() {
        let kept = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
        assert!(kept == schema, "docs/schema/{name}.json is not up to date: run `cargo xtask schema`");
    }
}

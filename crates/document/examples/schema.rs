//! Writes the JSON schemas of the result documents to the folder given, `docs/schema` by default.

use std::path::PathBuf;
use trueness_document::schemas;

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).map_or_else(|| PathBuf::from("docs/schema"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    for (name, schema) in schemas() {
        std::fs::write(folder.join(format!("{name}.json")), schema)?;
    }
    Ok(())
}

//! Writes the JSON schemas of the requests to the folder given, `docs/schema/requests` by default.

use std::path::PathBuf;
use trueness::tasks::schemas;

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).map_or_else(|| PathBuf::from("docs/schema/requests"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    for (name, schema) in schemas() {
        std::fs::write(folder.join(format!("{name}.json")), schema)?;
    }
    Ok(())
}

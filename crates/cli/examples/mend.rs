//! What is wrong with a mesh, and the mesh without it.
//!
//! ```text
//! cargo run --release --example mend -- corpus/broken/crack.stl sound.stl
//! ```
#![allow(clippy::print_stdout, reason = "an example")]

use std::env::args;
use trueness::{check, read, repair, write_mesh};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (broken, sound) = args().nth(1).zip(args().nth(2)).ok_or("usage: mend BROKEN SOUND")?;
    let part = read(broken)?;
    for (kind, found) in check(&part)?.defects {
        let count = found.map_or(0, |found| found.count);
        if count > 0 {
            println!("{}: {count}", kind.name);
        }
    }
    let mended = repair(&part.mesh)?;
    println!("{} changes, {}", mended.changes.len(), if mended.after.sound { "sound" } else { "not sound" });
    write_mesh(sound, &mended.mesh)?;
    Ok(())
}

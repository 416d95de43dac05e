//! The planes, cylinders, cones, spheres and tori of a part, without a nominal.
//!
//! ```text
//! cargo run --release --example elements -- corpus/examples/plate/nominal.stl
//! ```
#![allow(clippy::print_stdout, reason = "an example")]

use trueness::{read, segment};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).ok_or("usage: elements PART")?;
    for (number, region) in segment(&read(file)?.mesh)?.regions.iter().enumerate() {
        let name = region.fit.shape.kind().name();
        println!("{}: {name}, {} facets, {:.2} mm²", number + 1, region.pieces, region.area);
    }
    Ok(())
}

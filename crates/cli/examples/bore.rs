//! The cylinder of least squares through measured points.
//!
//! ```text
//! cargo run --release --example bore -- corpus/reference_fits/cylinder_01_lobed.xyz
//! ```
#![allow(clippy::print_stdout, reason = "an example")]

use trueness::{Kind, Shape, fit, read};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).ok_or("usage: bore POINTS")?;
    let found = fit(read(file)?.points(), Kind::Cylinder)?;
    if let Shape::Cylinder { direction: [x, y, z], radius, .. } = found.shape {
        println!("diameter {:.4} mm, axis ({x:.5}, {y:.5}, {z:.5})", 2.0 * radius);
    }
    println!("{} points, rms {:.4} mm", found.residuals.count, found.residuals.rms);
    Ok(())
}

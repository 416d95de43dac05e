//! Brings a scan onto its nominal, and measures it there.
//!
//! ```text
//! cargo run --release --example aligned -- corpus/examples/plate/scan.stl corpus/examples/plate/nominal.stl
//! ```
#![allow(clippy::print_stdout, reason = "an example")]

use std::env::args;
use trueness::{Reference, read};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (scan, nominal) = args().nth(1).zip(args().nth(2)).ok_or("usage: aligned SCAN NOMINAL")?;
    let (mut scan, reference) = (read(scan)?, Reference::read(nominal)?);
    let pose = reference.align(&scan.mesh)?;
    scan.mesh.positions.iter_mut().for_each(|p| *p = pose.reference_from_measured.point(*p));
    println!("turned by {:.3}°", pose.reference_from_measured.angle().to_degrees());
    for warning in &pose.warnings {
        println!("{warning:?}");
    }
    let deviations = reference.deviations(scan.points())?;
    println!("within ±0.1 mm: {:.1} %", 100.0 * deviations.share_within(-0.1, 0.1).unwrap_or(0.0));
    Ok(())
}

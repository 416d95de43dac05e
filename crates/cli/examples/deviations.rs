//! How far a scan is from its nominal.
//!
//! ```text
//! cargo run --release --example deviations -- corpus/bunny/scans.ply corpus/bunny/zipper_res4.ply
//! ```
#![allow(clippy::print_stdout, reason = "an example")]

use std::env::args;
use trueness::{Exclusion, Reference, read};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (scan, nominal) = args().nth(1).zip(args().nth(2)).ok_or("usage: deviations SCAN NOMINAL")?;
    let reference = Reference::read(nominal)?;
    let deviations = reference.deviations(read(scan)?.points())?;
    let all = deviations.statistics().all;
    println!("{} points, mean {:+.4} mm, rms {:.4} mm", all.count, all.mean?, all.rms?);
    println!("{} beyond the greatest distance", deviations.excluded(Exclusion::MaxDistance));
    Ok(())
}

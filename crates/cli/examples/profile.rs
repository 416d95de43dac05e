//! The lines and arcs of a profile, and where they join: a line that runs into an arc of 10 mm, a point every half millimeter.
//!
//! ```text
//! cargo run --release --example profile
//! ```
#![allow(clippy::print_stdout, reason = "an example")]

use trueness::contour;

fn measured(number: u32) -> [f64; 2] {
    let along = 0.5 * f64::from(number) - 20.25;
    let (sine, cosine) = libm::sincos(0.1 * along);
    if along < 0.0 { [5.0 + along, 3.0] } else { [5.0 + 10.0 * sine, 13.0 - 10.0 * cosine] }
}

fn main() -> Result<(), trueness::Error> {
    let points: Vec<[f64; 2]> = (0..70).map(measured).collect();
    let found = contour(&points)?;
    for segment in &found.segments {
        println!("{}", segment.geometry.kind().name());
    }
    for join in &found.joins {
        println!("join at ({:.3}, {:.3})", join.point[0], join.point[1]);
    }
    Ok(())
}

//! Places of files: what documents say of them, and those that are refused.

use std::path::Path;
use trueness_document::InputRecord;
use trueness_geom::closest::MIN_COORDINATE;
use trueness_geom::space::{Aabb, Point};

/// Whether a coordinate has a size that no command measures with: not 0, and below what distances keep their digits of, or
/// above `greatest`. What is not finite is another fault.
pub fn out_of_range(p: &Point, greatest: f64) -> bool {
    let size = |x: &f64| x.abs();
    p.iter().map(size).any(|x| x.is_finite() && x > 0.0 && !(MIN_COORDINATE..=greatest).contains(&x))
}

/// Why a file is refused in which the coordinates of a place are [`out_of_range`].
pub fn refusal(path: &Path, what: &str, number: usize, greatest: f64) -> String {
    let file = path.display();
    format!(
        "{file}: {what} {number} has a coordinate that is not 0 or from {MIN_COORDINATE:e} to {greatest:e} mm: give the \
         file's unit (--units), or leave the {what} out"
    )
}

/// Fills in number and box of the points of a file.
pub fn describe(record: &mut InputRecord, points: &[Point]) {
    record.points = points.len() as u64;
    record.bounds = trueness_measure::bounds(&Aabb::of(points));
}

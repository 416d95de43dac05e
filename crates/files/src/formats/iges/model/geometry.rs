//! What geometry is read with.

use super::super::record::Record;
use super::super::text::File;
use crate::formats::brep::{Budget, Wrong};
use trueness_cad::frame::{Frame, Placement};
use trueness_geom::space::Point;

/// What geometry is read with.
#[derive(Clone, Copy)]
pub(super) struct Geometry<'f> {
    pub file: &'f File,
    /// Millimeters in one unit of the file.
    pub unit: f64,
    /// Within which two places are one, millimeters.
    pub tolerance: f64,
    pub budget: &'f Budget,
}

/// Axes along those of space.
pub(super) fn upright(origin: Point) -> Frame {
    Frame { origin, axes: Placement::IDENTITY.rows }
}

/// How many control points there are, and the degree: parameter `k` is the upper index, `degree` the degree.
pub(super) fn numbers(record: &Record, k: usize, degree: usize) -> Result<(usize, usize), Wrong> {
    let (most, degree) = (record.count(k)?, record.count(degree)?);
    match degree >= 1 && degree <= most {
        true => Ok((most + 1, degree)),
        false => Err(record.wrong(format!(
            "has the upper index {most} and the degree {degree}, where degrees are at least 1 and no greater"
        ))),
    }
}

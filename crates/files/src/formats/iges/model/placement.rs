//! Matrices, points and directions.

use super::super::record::Record;
use super::geometry::Geometry;
use crate::formats::brep::MAX_BASES;
use crate::formats::brep::Wrong;
use trueness_cad::frame::{Frame, Placement};
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, times, unit};

/// By how much axes of a matrix may differ from unit length and from right angles: files have about seven digits at least.
const UNEVEN_AXES: f64 = 1e-4;

impl Geometry<'_> {
    /// What the matrix of an entity does to it, and those that place this matrix.
    pub fn placed(&self, record: &Record) -> Result<Placement, Wrong> {
        let mut at = Placement::IDENTITY;
        let mut next = record.entity.matrix;
        for _ in 0..MAX_BASES {
            if next == 0 {
                return Ok(at);
            }
            let matrix = self.file.record(next)?;
            if matrix.entity.kind != 124 {
                return Err(record.wrong(format!("is placed by entity {next}, which is no matrix")));
            }
            at = self.matrix(&matrix)?.after(&at);
            next = matrix.entity.matrix;
        }
        Err(record.wrong("is placed by a matrix that rests on itself"))
    }

    /// Three rows of a rotation, of a mirror or of a scale, and of a shift.
    fn matrix(&self, record: &Record) -> Result<Placement, Wrong> {
        let numbers = record.reals(0, 12)?;
        let column = |k: usize| [numbers[k], numbers[4 + k], numbers[8 + k]];
        let axes = [column(0), column(1), column(2)];
        let scale = norm(axes[0]);
        let wrong = || record.wrong("is a matrix that does not keep the shape of what it places");
        let uneven = |v: Vector| (norm(v) - scale).abs() > UNEVEN_AXES * scale;
        if scale <= 0.0 || !scale.is_finite() || axes.into_iter().any(uneven) {
            return Err(wrong());
        }
        // Digits of the file are few: the nearest axes at right angles are meant.
        let (x, _) = unit(axes[0]).ok_or_else(wrong)?;
        let (y, _) = unit(minus(axes[1], times(dot(axes[1], x), x))).ok_or_else(wrong)?;
        let z = cross(x, y);
        let side = dot(z, axes[2]) / scale;
        if (side.abs() - 1.0).abs() > UNEVEN_AXES || dot(x, axes[1]).abs() > UNEVEN_AXES * scale {
            return Err(wrong());
        }
        let z = times(side.signum(), z);
        let scale = if (scale - 1.0).abs() <= UNEVEN_AXES { 1.0 } else { scale };
        let rows = std::array::from_fn(|k| [x[k], y[k], z[k]]);
        Ok(Placement { rows, scale, shift: column(3).map(|x| x * self.unit) })
    }

    /// A point (116), millimeters.
    pub fn point(&self, number: u64) -> Result<Point, Wrong> {
        let record = self.file.record(number)?;
        if record.entity.kind != 116 {
            return Err(record.wrong(format!("is no point but of the kind {}", record.entity.kind)));
        }
        Ok(self.placed(&record)?.point(self.place(&record, 0)?))
    }

    /// Three coordinates, millimeters.
    pub fn place(&self, record: &Record, k: usize) -> Result<Point, Wrong> {
        self.finite(record, record.triple(k)?.map(|x| x * self.unit))
    }

    /// A place whose coordinates have not become too large in millimeters.
    pub fn finite(&self, record: &Record, p: Point) -> Result<Point, Wrong> {
        match p.iter().all(|x| x.is_finite()) {
            true => Ok(p),
            false => Err(record.wrong("has a coordinate that is too large")),
        }
    }

    /// A direction (123), of length 1.
    pub fn direction(&self, number: u64) -> Result<Vector, Wrong> {
        let record = self.file.record(number)?;
        if record.entity.kind != 123 {
            return Err(record.wrong(format!("is no direction but of the kind {}", record.entity.kind)));
        }
        let (found, _) =
            unit(record.triple(0)?).ok_or_else(|| record.wrong("is a direction without length"))?;
        Ok(self.placed(&record)?.direction(found))
    }

    /// Axes at the point that parameter `at` names, with the direction of parameter `axis`, and where there is one that of parameter `first`.
    pub fn axes(&self, record: &Record, at: usize, axis: usize, first: usize) -> Result<Frame, Wrong> {
        let origin = self.point(record.pointer(at)?)?;
        let z = match record.optional(axis)? {
            Some(number) => self.direction(number)?,
            None => [0.0, 0.0, 1.0],
        };
        let x = record.optional(first)?.map(|number| self.direction(number)).transpose()?;
        Frame::new(origin, z, x).ok_or_else(|| record.wrong("has no axis"))
    }
}

//! Surfaces of a file.

use super::super::part21::{Entity, Record, Wrong};
use super::super::spline::spline;
use super::curve::Geometry;
use super::placement::{axis, frame, operator, vector};
use crate::formats::brep::MAX_BASES;
use crate::formats::spline::surface as spline_surface;
use std::f64::consts::FRAC_PI_2;
use trueness_cad::surface::Surface;

/// A surface, and whether the normal that the file gives it is opposite to `∂u × ∂v`.
pub(super) struct Oriented {
    pub surface: Surface,
    pub is_flipped: bool,
}

impl From<Surface> for Oriented {
    fn from(surface: Surface) -> Oriented {
        Oriented { surface, is_flipped: false }
    }
}

impl<'f> Geometry<'f> {
    /// A surface; of a bounded one that on which it lies.
    pub fn surface(&self, number: u64, depth: usize) -> Result<Oriented, Wrong> {
        let entity = self.file.entity(number)?;
        if depth > MAX_BASES {
            return Err(entity.wrong("rests on itself"));
        }
        if let Some(surface) = self.spline_surface(&entity)? {
            return Ok(surface.into());
        }
        let record = entity.main(&[]);
        match record.keyword {
            "PLANE"
            | "CYLINDRICAL_SURFACE"
            | "CONICAL_SURFACE"
            | "SPHERICAL_SURFACE"
            | "TOROIDAL_SURFACE"
            | "DEGENERATE_TOROIDAL_SURFACE" => self.elementary(&record),
            "SURFACE_OF_LINEAR_EXTRUSION" => {
                let curve = self.curve(record.entity(1)?, depth + 1)?;
                let direction = vector(self.file, self.units, record.entity(2)?)?;
                Ok(Surface::Extrusion { curve: Box::new(curve), direction }.into())
            }
            "SURFACE_OF_REVOLUTION" => {
                let curve = self.curve(record.entity(1)?, depth + 1)?;
                let (origin, axis) = axis(self.file, self.units, record.entity(2)?)?;
                Ok(Surface::Revolution { curve: Box::new(curve), origin, axis }.into())
            }
            "OFFSET_SURFACE" => {
                let Oriented { surface, is_flipped } = self.surface(record.entity(1)?, depth + 1)?;
                let distance = record.real(2)? * self.units.length;
                let distance = if is_flipped { -distance } else { distance };
                Ok(Oriented { surface: Surface::Offset { basis: Box::new(surface), distance }, is_flipped })
            }
            "RECTANGULAR_TRIMMED_SURFACE" => {
                let basis = self.surface(record.entity(1)?, depth + 1)?;
                let turned = record.truth(6)? != record.truth(7)?;
                Ok(Oriented { is_flipped: basis.is_flipped != turned, ..basis })
            }
            "CURVE_BOUNDED_SURFACE" => self.surface(record.entity(1)?, depth + 1),
            "SURFACE_REPLICA" => {
                let at = operator(self.file, self.units, record.entity(2)?)?;
                let basis = self.surface(record.entity(1)?, depth + 1)?;
                Ok(Oriented { surface: basis.surface.placed(&at), ..basis })
            }
            keyword => Err(record.wrong(format!("is no surface that is read but {keyword}"))),
        }
    }

    fn elementary(&self, record: &Record) -> Result<Oriented, Wrong> {
        let frame = frame(self.file, self.units, record.entity(1)?)?;
        let surface = match record.keyword {
            "PLANE" => Surface::Plane(frame),
            "CYLINDRICAL_SURFACE" => Surface::Cylinder { frame, radius: self.length(record, 2)? },
            "SPHERICAL_SURFACE" => Surface::Sphere { frame, radius: self.length(record, 2)? },
            "CONICAL_SURFACE" => {
                let (radius, half_angle) =
                    (record.real(2)? * self.units.length, record.real(3)? * self.units.angle);
                if radius < 0.0 || half_angle == 0.0 || half_angle.abs() >= FRAC_PI_2 {
                    return Err(record.wrong("has a radius below 0 or an angle that no cone has"));
                }
                Surface::Cone { frame, radius, half_angle }
            }
            _ => {
                let (major, minor) = (self.length(record, 2)?, self.length(record, 3)?);
                // The inner part of a spindle torus: its tube is gone around the other way, and so its normal is turned.
                if minor > major && record.keyword.starts_with("DEGENERATE") && !record.truth(4)? {
                    let surface = Surface::Torus { frame, major: -major, minor };
                    return Ok(Oriented { surface, is_flipped: true });
                }
                Surface::Torus { frame, major, minor }
            }
        };
        Ok(surface.into())
    }

    fn spline_surface(&self, entity: &Entity<'f>) -> Result<Option<Surface>, Wrong> {
        let Some(record) = spline(entity, 2)? else { return Ok(None) };
        self.budget.spend(record.points().len(), entity)?;
        let points = record.points().iter().map(|n| self.point(*n)).collect::<Result<Vec<_>, _>>()?;
        let nurbs = spline_surface(record.with(points)?).map_err(|fault| entity.wrong(fault.to_string()))?;
        Ok(Some(Surface::Spline(Box::new(nurbs))))
    }

    /// First and last `u` and `v` of a rectangular trimmed surface, as its basis has them.
    pub fn rectangle(&self, record: &Record, surface: &Surface) -> Result<[[f64; 2]; 2], Wrong> {
        let (scales, domain) = (self.parameters(surface), surface.domain());
        let mut sides = [[0.0; 2]; 2];
        for (k, side) in sides.iter_mut().enumerate() {
            let mut ends = [record.real(2 + 2 * k)? * scales[k], record.real(3 + 2 * k)? * scales[k]];
            if !record.truth(6 + k)? {
                ends.reverse();
            }
            let [from, to] = ends;
            let turn = domain[k][1] - domain[k][0];
            *side = match to > from {
                true => [from, to],
                // Over the seam of a surface that closes.
                false if turn.is_finite() => [from, to + turn],
                false => return Err(record.wrong("has sides that end before they begin")),
            };
        }
        Ok(sides)
    }

    /// What one unit of `u` and of `v` in the file is in the parameters of a surface.
    fn parameters(&self, surface: &Surface) -> [f64; 2] {
        let (length, angle) = (self.units.length, self.units.angle);
        let of_curve =
            |curve: &trueness_cad::curve::Curve| if curve.period().is_some() { angle } else { 1.0 };
        match surface {
            Surface::Plane(_) => [length, length],
            Surface::Cylinder { .. } | Surface::Cone { .. } => [angle, length],
            Surface::Sphere { .. } | Surface::Torus { .. } => [angle, angle],
            Surface::Spline(_) => [1.0, 1.0],
            Surface::Extrusion { curve, .. } => [of_curve(curve), 1.0],
            Surface::Revolution { curve, .. } => [angle, of_curve(curve)],
            Surface::Offset { basis, .. } => self.parameters(basis),
        }
    }
}

/// Whether a keyword is one of surfaces.
pub(super) fn is_surface(keyword: &str) -> bool {
    super::super::spline::SURFACES.contains(&keyword)
        || matches!(
            keyword,
            "PLANE"
                | "RECTANGULAR_TRIMMED_SURFACE"
                | "CURVE_BOUNDED_SURFACE"
                | "SURFACE_REPLICA"
                | "OFFSET_SURFACE"
        )
        || matches!(keyword, "SURFACE_OF_LINEAR_EXTRUSION" | "SURFACE_OF_REVOLUTION" | "BOUNDED_SURFACE")
        || matches!(keyword, "CYLINDRICAL_SURFACE" | "CONICAL_SURFACE" | "SPHERICAL_SURFACE")
        || keyword.ends_with("TOROIDAL_SURFACE")
}

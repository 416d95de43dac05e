//! Entities of a drawing that have a course in its plane.

use super::conic::conic;
use super::groups::{FILE_ROUNDING, Group};
use super::through::{PointsOnCurve, through};
use crate::Unit;
use crate::content::drawing::Drawn;
use crate::error::{Fault, Located, Result};
use crate::formats::spline::{Raw, curve};
use std::f64::consts::{PI, TAU};

/// The groups of an entity but its name, in the order of the file.
pub(super) struct EntityGroups<'a> {
    pub groups: &'a [Group<'a>],
    /// Line of its name.
    pub line: u64,
    pub unit: Unit,
}

impl EntityGroups<'_> {
    fn group(&self, code: i64) -> Option<&Group<'_>> {
        self.groups.iter().find(|g| g.code == code)
    }
    pub fn wrong(&self, what: &str, remedy: &'static str) -> Located {
        Fault::Unsupported { what: what.into(), remedy }.at_line(self.line)
    }
    pub fn integer(&self, code: i64) -> Result<i64> {
        self.group(code).map_or(Ok(0), Group::integer)
    }
    fn number(&self, code: i64) -> Result<f64> {
        let missing = || Fault::unexpected("all numbers of the entity", b"").at_line(self.line);
        self.group(code).ok_or_else(missing)?.number()
    }
    pub fn or(&self, code: i64, default: f64) -> Result<f64> {
        self.group(code).map_or(Ok(default), Group::number)
    }
    pub fn has(&self, code: i64) -> bool {
        self.group(code).is_some()
    }
    /// A length; 0 where it is left out.
    pub fn length_or_0(&self, code: i64) -> Result<f64> {
        Ok(self.unit.to_millimeters(self.or(code, 0.0)?))
    }
    fn length(&self, code: i64) -> Result<f64> {
        Ok(self.unit.to_millimeters(self.number(code)?))
    }
    pub fn place(&self, code: i64) -> Result<[f64; 2]> {
        Ok([self.length(code)?, self.length(code + 10)?])
    }
    fn all(&self, code: i64) -> Result<Vec<f64>> {
        self.groups.iter().filter(|g| g.code == code).map(Group::number).collect()
    }
    fn lengths(&self, code: i64) -> Result<Vec<f64>> {
        Ok(self.all(code)?.into_iter().map(|x| self.unit.to_millimeters(x)).collect())
    }

    /// Whether the entity is drawn as seen from below. An entity in another plane than the drawing is refused.
    pub fn mirrored(&self) -> Result<bool> {
        match [self.or(210, 0.0)?, self.or(220, 0.0)?, self.or(230, 1.0)?] {
            [x, y, z] if x.abs() < FILE_ROUNDING && y.abs() < FILE_ROUNDING && z != 0.0 => Ok(z < 0.0),
            _ => Err(self.wrong("an entity is turned out of the plane of the drawing", "draw it flat")),
        }
    }

    /// Refuses an entity that is not parallel to the plane of the drawing.
    fn flat(&self, heights: &[f64], size: f64) -> Result<()> {
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        match high - low > FILE_ROUNDING * size {
            true => Err(self.wrong("an entity leaves the plane of the drawing", "draw it flat")),
            false => Ok(()),
        }
    }
}

/// Diagonal of the box around places.
fn size(points: &[[f64; 2]]) -> f64 {
    let range = |k: usize| {
        let all = points.iter().map(|p| p[k]);
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    };
    if points.is_empty() { 0.0 } else { libm::hypot(range(0), range(1)) }
}

/// A `LINE`.
pub(super) fn line(entity: &EntityGroups, out: &mut Vec<Drawn>) -> Result<()> {
    let (start, end) = (entity.place(10)?, entity.place(11)?);
    entity.flat(&[entity.or(30, 0.0)?, entity.or(31, 0.0)?], size(&[start, end]))?;
    if start != end {
        out.push(Drawn::Line { start, end });
    }
    Ok(())
}

/// An `ARC` or `CIRCLE`: counter-clockwise as seen from the side of its normal.
pub(super) fn arc(entity: &EntityGroups, whole: bool, out: &mut Vec<Drawn>) -> Result<()> {
    let (mut center, radius) = (entity.place(10)?, entity.length(40)?);
    if radius <= 0.0 {
        return Err(Fault::unexpected("a radius above 0", radius.to_string().as_bytes()).at_line(entity.line));
    }
    let (mut start, mut sweep) = (0.0, TAU);
    if !whole {
        let (from, to) = (entity.number(50)?.to_radians(), entity.number(51)?.to_radians());
        let turn = (to - from).rem_euclid(TAU);
        (start, sweep) = (from, if turn == 0.0 { TAU } else { turn });
    }
    if entity.mirrored()? {
        (center[0], start, sweep) = (-center[0], PI - start, -sweep);
    }
    out.push(Drawn::Arc { center, radius, start, sweep });
    Ok(())
}

/// A vertex of a polyline and the bulge of what follows: the tangent of a quarter of its sweep.
pub(super) type Vertex = ([f64; 2], f64);

/// The vertices of an `LWPOLYLINE`.
pub(super) fn vertices(entity: &EntityGroups) -> Result<Vec<Vertex>> {
    let (mut all, mut x): (Vec<Vertex>, Option<f64>) = (vec![], None);
    for group in entity.groups {
        match group.code {
            10 => x = Some(entity.unit.to_millimeters(group.number()?)),
            20 => {
                let y = entity.unit.to_millimeters(group.number()?);
                let x = x.take().ok_or_else(|| group.wrong("the first coordinate before the second"))?;
                all.push(([x, y], 0.0));
            }
            42 => {
                let bulge = group.number()?;
                if let Some(last) = all.last_mut() {
                    last.1 = bulge;
                }
            }
            _ => {}
        }
    }
    Ok(all)
}

/// A `VERTEX` of a `POLYLINE`.
pub(super) fn vertex(entity: &EntityGroups) -> Result<Vertex> {
    Ok((entity.place(10)?, entity.or(42, 0.0)?))
}

/// Lines and arcs between the vertices of a polyline.
pub(super) fn polyline(
    entity: &EntityGroups,
    vertices: &[Vertex],
    closed: bool,
    out: &mut Vec<Drawn>,
) -> Result<()> {
    let mirror = if entity.mirrored()? { -1.0 } else { 1.0 };
    let n = vertices.len();
    for i in 0..if closed { n } else { n.saturating_sub(1) } {
        let ((a, bulge), (b, _)) = (vertices[i], vertices[(i + 1) % n]);
        let [start, end] = [a, b].map(|p| [mirror * p[0], p[1]]);
        let (dx, dy) = (end[0] - start[0], end[1] - start[1]);
        let (chord, bulge) = (libm::hypot(dx, dy), mirror * bulge);
        if chord == 0.0 {
            continue;
        }
        if bulge == 0.0 {
            out.push(Drawn::Line { start, end });
            continue;
        }
        // The center lies on the left of the chord where the bulge is to its right and less than a half circle.
        let up = 0.25 * (1.0 / bulge - bulge);
        let center = [0.5 * (start[0] + end[0]) - up * dy, 0.5 * (start[1] + end[1]) + up * dx];
        let radius = 0.25 * chord * (bulge + 1.0 / bulge).abs();
        let from = libm::atan2(start[1] - center[1], start[0] - center[0]);
        if !radius.is_finite() {
            out.push(Drawn::Line { start, end });
            continue;
        }
        out.push(Drawn::Arc { center, radius, start: from, sweep: 4.0 * libm::atan(bulge) });
    }
    Ok(())
}

/// A `SPLINE`, polynomial or rational, by its control points.
pub(super) fn spline(entity: &EntityGroups, out: &mut Vec<Drawn>) -> Result<()> {
    let (x, y, z) = (entity.lengths(10)?, entity.lengths(20)?, entity.lengths(30)?);
    if x.is_empty() {
        return fitted(entity, out);
    }
    if x.len() != y.len() {
        return Err(Fault::unexpected("two coordinates of each control point", b"").at_line(entity.line));
    }
    let points: Vec<[f64; 3]> = x.iter().zip(&y).map(|(x, y)| [*x, *y, 0.0]).collect();
    entity.flat(&z, size(&points.iter().map(|p| [p[0], p[1]]).collect::<Vec<_>>()))?;
    let mut weights = entity.all(41)?;
    if weights.is_empty() {
        weights = vec![1.0; points.len()];
    }
    let degree = usize::try_from(entity.integer(71)?).unwrap_or(0);
    let raw = Raw {
        degree: vec![degree],
        knots: vec![entity.all(40)?],
        counts: vec![points.len()],
        points,
        weights,
    };
    out.push(Drawn::Spline(curve(raw).map_err(|f| f.at_line(entity.line))?));
    Ok(())
}

/// A `SPLINE` by the points alone that it passes through.
fn fitted(entity: &EntityGroups, out: &mut Vec<Drawn>) -> Result<()> {
    let (x, y, z) = (entity.lengths(11)?, entity.lengths(21)?, entity.lengths(31)?);
    if x.len() != y.len() {
        return Err(Fault::unexpected("two coordinates of each point of a spline", b"").at_line(entity.line));
    }
    let points: Vec<[f64; 2]> = x.iter().zip(&y).map(|(x, y)| [*x, *y]).collect();
    entity.flat(&z, size(&points))?;
    let tangent = |code: i64| -> Result<Option<[f64; 2]>> {
        let direction = [entity.or(code, 0.0)?, entity.or(code + 10, 0.0)?];
        Ok((direction != [0.0; 2]).then_some(direction))
    };
    // 1: closed, 2: periodic.
    let closed = entity.integer(70)? & 3 != 0;
    let given = PointsOnCurve { points, tangents: [tangent(12)?, tangent(13)?], closed };
    let found = through(given).ok_or_else(|| {
        let what = "a spline by the points that it passes through has fewer than two different ones";
        entity.wrong(what, "export it with its control points")
    })?;
    out.push(found);
    Ok(())
}

/// An `ELLIPSE`: quarters of it as rational curves of degree 2, exactly.
pub(super) fn ellipse(entity: &EntityGroups, out: &mut Vec<Drawn>) -> Result<()> {
    let (center, major, ratio) = (entity.place(10)?, entity.place(11)?, entity.number(40)?);
    entity.flat(&[0.0, entity.or(31, 0.0)?], size(&[[0.0; 2], major]))?;
    let turn = if entity.mirrored()? { -1.0 } else { 1.0 };
    let minor = [-turn * ratio * major[1], turn * ratio * major[0]];
    let (from, to) = (entity.or(41, 0.0)?, entity.or(42, TAU)?);
    let sweep = if to > from { to - from } else { to - from + TAU };
    if major == [0.0; 2] || ratio <= 0.0 || sweep <= 0.0 || sweep > TAU + FILE_ROUNDING {
        return Err(Fault::unexpected("axes and a range of an ellipse", b"").at_line(entity.line));
    }
    out.extend(conic(center, [major, minor], from, sweep).map_err(|f| f.at_line(entity.line))?);
    Ok(())
}

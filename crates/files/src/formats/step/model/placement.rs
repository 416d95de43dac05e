//! Points, directions, axes, and what brings a part to its place.

use super::super::part21::{File, Value, Wrong};
use trueness_cad::frame::{Frame, Placement};
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, times, unit};

/// What a file's numbers are in millimeters and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Units {
    /// Millimeters in one unit of length.
    pub length: f64,
    /// Radians in one unit of angle.
    pub angle: f64,
}

/// The place of a point, millimeters.
pub(super) fn point(file: &File, units: Units, number: u64) -> Result<Point, Wrong> {
    let entity = file.entity(number)?;
    let record = entity.main(&["CARTESIAN_POINT"]);
    if record.keyword != "CARTESIAN_POINT" {
        return Err(record.wrong(format!("is no CARTESIAN_POINT but {}", record.keyword)));
    }
    // Of a complex instance the record has its coordinates alone.
    let coordinates = record.list(usize::from(entity.is_simple()))?;
    let number = |v: &Value| record.number(*v).filter(|x| (x * units.length).is_finite());
    match coordinates {
        [x, y, z] => match (number(x), number(y), number(z)) {
            (Some(x), Some(y), Some(z)) => Ok([x, y, z].map(|x| x * units.length)),
            _ => Err(record.wrong("has a coordinate that is no finite number")),
        },
        _ => Err(record.wrong("has not three coordinates")),
    }
}

/// A direction, of length 1.
pub(super) fn direction(file: &File, number: u64) -> Result<Vector, Wrong> {
    let entity = file.entity(number)?;
    let record = entity.main(&["DIRECTION"]);
    if record.keyword != "DIRECTION" {
        return Err(record.wrong(format!("is no DIRECTION but {}", record.keyword)));
    }
    let ratios = record.list(usize::from(entity.is_simple()))?;
    let number = |v: &Value| record.number(*v).filter(|x| x.is_finite());
    let found = match ratios {
        [x, y, z] => match (number(x), number(y), number(z)) {
            (Some(x), Some(y), Some(z)) => unit([x, y, z]),
            _ => return Err(record.wrong("has a component that is no finite number")),
        },
        _ => return Err(record.wrong("has not three components")),
    };
    found.map(|(v, _)| v).ok_or_else(|| record.wrong("is a direction without length"))
}

/// A vector, millimeters.
pub(super) fn vector(file: &File, units: Units, number: u64) -> Result<Vector, Wrong> {
    let entity = file.entity(number)?;
    let record = entity.main(&["VECTOR"]);
    let length = record.real(2)? * units.length;
    match length > 0.0 {
        true => Ok(times(length, direction(file, record.entity(1)?)?)),
        false => Err(record.wrong("is a vector without length")),
    }
}

/// The axes of a placement.
pub(super) fn frame(file: &File, units: Units, number: u64) -> Result<Frame, Wrong> {
    let entity = file.entity(number)?;
    let record = entity.main(&["AXIS2_PLACEMENT_3D"]);
    if !matches!(record.keyword, "AXIS2_PLACEMENT_3D" | "AXIS1_PLACEMENT") {
        return Err(record.wrong(format!("is no AXIS2_PLACEMENT_3D but {}", record.keyword)));
    }
    let origin = point(file, units, record.entity(1)?)?;
    let optional = |k: usize| match record.is_absent(k) {
        true => Ok(None),
        false => direction(file, record.entity(k)?).map(Some),
    };
    let z = optional(2)?.unwrap_or([0.0, 0.0, 1.0]);
    let x = optional(3)?.unwrap_or_else(|| first_axis(z));
    Frame::new(origin, z, Some(x)).ok_or_else(|| record.wrong("has no axis"))
}

/// The direction that the first axis follows where a file does not give it (ISO 10303-42, `first_proj_axis`).
fn first_axis(z: Vector) -> Vector {
    match norm(cross(z, [1.0, 0.0, 0.0])) > 0.0 {
        true => [1.0, 0.0, 0.0],
        false => [0.0, 1.0, 0.0],
    }
}

/// A transformation operator (ISO 10303-42, `base_axis`): its parameters follow its origin, the only point among them.
pub(super) fn operator(file: &File, units: Units, number: u64) -> Result<Placement, Wrong> {
    let entity = file.entity(number)?;
    let record = entity.main(&["CARTESIAN_TRANSFORMATION_OPERATOR_3D"]);
    if record.keyword != "CARTESIAN_TRANSFORMATION_OPERATOR_3D" {
        return Err(
            record.wrong(format!("is no CARTESIAN_TRANSFORMATION_OPERATOR_3D but {}", record.keyword))
        );
    }
    let is_point = |n: u64| file.entity(n).is_ok_and(|e| e.record("CARTESIAN_POINT").is_some());
    let origin = (2..record.values.len()).find(|k| record.reference(*k).is_some_and(is_point));
    let Some(at) = origin else { return Err(record.wrong("has no origin")) };
    let optional = |k: usize| match record.is_absent(k) {
        true => Ok(None),
        false => direction(file, record.entity(k)?).map(Some),
    };
    let shift = point(file, units, record.entity(at)?)?;
    let (x, y, z) = (optional(at - 2)?, optional(at - 1)?, optional(at + 2)?);
    let scale = if record.is_absent(at + 1) { 1.0 } else { record.real(at + 1)? };
    if scale <= 0.0 {
        return Err(record.wrong("scales by a number that is not above 0"));
    }
    let z = z.unwrap_or([0.0, 0.0, 1.0]);
    let axes = Frame::new(shift, z, Some(x.unwrap_or_else(|| first_axis(z))));
    let Some(Frame { axes: [x, mut across, z], .. }) = axes else { return Err(record.wrong("has no axis")) };
    // The second axis tells whether it mirrors.
    let side = dot(y.unwrap_or([0.0, 1.0, 0.0]), across);
    if side < 0.0 {
        across = times(-1.0, across);
    }
    Ok(Placement { rows: std::array::from_fn(|k| [x[k], across[k], z[k]]), scale, shift })
}

/// Where a placement or an operator brings what lies in `from`.
pub(super) fn target(file: &File, units: Units, number: u64, from: &Frame) -> Result<Placement, Wrong> {
    let entity = file.entity(number)?;
    match entity.record("CARTESIAN_TRANSFORMATION_OPERATOR_3D") {
        Some(_) => {
            let origin = Frame { origin: [0.0; 3], axes: Placement::IDENTITY.rows };
            Ok(operator(file, units, number)?.after(&Placement::between(from, &origin)))
        }
        None => Ok(Placement::between(from, &frame(file, units, number)?)),
    }
}

/// The axis of a surface of revolution: a place on it and its direction.
pub(super) fn axis(file: &File, units: Units, number: u64) -> Result<(Point, Vector), Wrong> {
    let frame = frame(file, units, number)?;
    Ok((frame.origin, frame.axes[2]))
}

/// The plane of a closed polygon: its normal is the sum of those of its corners (Newell).
pub(super) fn plane_of(points: &[Point]) -> Option<Frame> {
    let first = *points.first()?;
    let mut sum = [0.0; 3];
    for pair in points.windows(2) {
        let n = cross(minus(pair[0], first), minus(pair[1], first));
        sum = std::array::from_fn(|k| sum[k] + n[k]);
    }
    Frame::new(first, unit(sum)?.0, points.get(1).map(|p| minus(*p, first)))
}

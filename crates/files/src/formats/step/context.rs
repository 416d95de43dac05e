//! The units and the uncertainty of a representation, by its context.

use super::part21::{Entity, File, Record, Wrong};
use std::f64::consts::PI;

/// What a context says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Context {
    /// Millimeters in one unit of length.
    pub length: Option<f64>,
    /// Radians in one unit of angle.
    pub angle: Option<f64>,
    /// Of lengths, millimeters.
    pub uncertainty: Option<f64>,
}

/// Units that rest on other units at most, one on another.
const MAX_CONVERSIONS: usize = 8;
/// Relative difference within which a rounded factor is the exact one of its name.
const ROUNDED: f64 = 1e-4;

/// Reads a context.
pub(super) fn context(file: &File, number: u64) -> Result<Context, Wrong> {
    let entity = file.entity(number)?;
    let mut found = Context::default();
    if let Some(units) = entity.record("GLOBAL_UNIT_ASSIGNED_CONTEXT") {
        for unit in units.entities(units.values.len().saturating_sub(1))? {
            let unit = file.entity(unit)?;
            if is_length(&unit) {
                found.length = Some(factor(file, &unit, 0)?);
            } else if unit.record("PLANE_ANGLE_UNIT").is_some() {
                found.angle = Some(factor(file, &unit, 0)?);
            }
        }
    }
    if let Some(record) = entity.record("GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT") {
        let all = record.entities(record.values.len().saturating_sub(1))?;
        // A damaged statement of uncertainty is no reason to lose the model.
        let lengths = all.filter_map(|number| uncertainty(file, number));
        found.uncertainty = lengths.reduce(f64::max);
    }
    Ok(found)
}

fn is_length(unit: &Entity) -> bool {
    let meter = |r: Record| r.word(r.values.len().saturating_sub(1)).as_deref() == Some("METRE");
    unit.record("LENGTH_UNIT").is_some() || unit.is_simple() && unit.record("SI_UNIT").is_some_and(meter)
}

/// A length in millimeters, or an angle in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Measure {
    Length(f64),
    Angle(f64),
}

/// What a measure with a unit is.
pub(super) fn measure(file: &File, number: u64) -> Result<Measure, Wrong> {
    let entity = file.entity(number)?;
    let record = entity.main(&["MEASURE_WITH_UNIT", "UNCERTAINTY_MEASURE_WITH_UNIT"]);
    let first = usize::from(record.keyword == "MEASURE_REPRESENTATION_ITEM");
    let unit = file.entity(record.entity(first + 1)?)?;
    let value = || match record.real(first)? * factor(file, &unit, 0)? {
        x if x.is_finite() => Ok(x),
        _ => Err(record.wrong("is beyond all numbers")),
    };
    match unit.record("PLANE_ANGLE_UNIT") {
        _ if is_length(&unit) => Ok(Measure::Length(value()?)),
        Some(_) => Ok(Measure::Angle(value()?)),
        None => Err(record.wrong("is neither a length nor an angle")),
    }
}

/// An uncertainty of lengths in millimeters; `None` where it is one of something else.
fn uncertainty(file: &File, number: u64) -> Option<f64> {
    match measure(file, number) {
        Ok(Measure::Length(length)) => Some(length).filter(|x| *x > 0.0),
        _ => None,
    }
}

/// What one unit is in millimeters or radians.
fn factor(file: &File, unit: &Entity, depth: usize) -> Result<f64, Wrong> {
    if depth > MAX_CONVERSIONS {
        return Err(unit.wrong("rests on itself"));
    }
    if let Some(conversion) = unit.record("CONVERSION_BASED_UNIT") {
        let measure = file.entity(conversion.entity(conversion.values.len().saturating_sub(1))?)?;
        let measure =
            measure.main(&["MEASURE_WITH_UNIT", "LENGTH_MEASURE_WITH_UNIT", "PLANE_ANGLE_MEASURE_WITH_UNIT"]);
        let base = file.entity(measure.entity(1)?)?;
        let own = measure.real(0)? * factor(file, &base, depth + 1)?;
        let exact = exact(&conversion.text(conversion.values.len().saturating_sub(2)).to_ascii_uppercase());
        let own = exact.filter(|e| (own / e - 1.0).abs() < ROUNDED).unwrap_or(own);
        return match own > 0.0 && own.is_finite() {
            true => Ok(own),
            false => Err(conversion.wrong("is not above 0")),
        };
    }
    let Some(si) = unit.record("SI_UNIT") else { return Err(unit.wrong("is no unit that is known")) };
    let last = si.values.len().saturating_sub(1);
    let base = match si.word(last).as_deref() {
        Some("METRE") => 1000.0,
        Some("RADIAN") => 1.0,
        _ => return Err(si.wrong("is no unit that is known")),
    };
    let prefix = si.word(last.saturating_sub(1)).filter(|_| last > 0).unwrap_or_default();
    let scale = match &prefix[..] {
        "" => 1.0,
        "MILLI" if base != 1.0 => return Ok(1.0),
        "MICRO" if base != 1.0 => return Ok(1e-3),
        "NANO" if base != 1.0 => return Ok(1e-6),
        "PICO" if base != 1.0 => return Ok(1e-9),
        "EXA" => 1e18,
        "PETA" => 1e15,
        "TERA" => 1e12,
        "GIGA" => 1e9,
        "MEGA" => 1e6,
        "KILO" => 1e3,
        "HECTO" => 1e2,
        "DECA" => 1e1,
        "DECI" => 1e-1,
        "CENTI" => 1e-2,
        "MILLI" => 1e-3,
        "MICRO" => 1e-6,
        "NANO" => 1e-9,
        "PICO" => 1e-12,
        "FEMTO" => 1e-15,
        "ATTO" => 1e-18,
        _ => return Err(si.wrong("has a prefix that is not known")),
    };
    Ok(base * scale)
}

/// What units of these names are exactly: files have rounded factors.
fn exact(name: &str) -> Option<f64> {
    match name {
        "INCH" | "INCHES" => Some(25.4),
        "FOOT" | "FEET" => Some(304.8),
        "DEGREE" | "DEGREES" | "DEG" => Some(PI / 180.0),
        _ => None,
    }
}

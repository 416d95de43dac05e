//! A surface from a result document of `trueness surface`.

use crate::task::{Meaning, TaskError};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::path::Path;
use trueness_document::UNITS;
use trueness_document::surface::SCHEMA;
use trueness_document::{InputRecord, Role};
use trueness_files::{Sources, Warning};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::surface::{Nurbs, Surface};

/// What of the document is needed.
#[derive(Deserialize)]
struct Document {
    schema: String,
    units: Option<String>,
    degree: [usize; 2],
    knots: Directions,
    control_points: Vec<Vec<[f64; 3]>>,
    trim: Option<Trim>,
}

/// The outline that it is cut along.
#[derive(Deserialize)]
struct Trim {
    regions: Vec<IgnoredAny>,
}

#[derive(Deserialize)]
struct Directions {
    u: Vec<f64>,
    v: Vec<f64>,
}

/// Bytes looked at for the first one that is no blank.
const MAX_BLANK_BYTES: usize = 64;
/// Largest document that is taken.
const MAX_DOCUMENT_BYTES: u64 = 4 << 30;

/// The surface; `None` if the file is no JSON. Streams are never looked into.
pub fn read(sources: &dyn Sources, path: &Path) -> Result<Option<(Nurbs, InputRecord)>, TaskError> {
    if sources.is_stream(path) || !begins_with_a_brace(sources, path) {
        return Ok(None);
    }
    let shown = path.display();
    let bytes = sources.length(path).unwrap_or(0);
    if bytes > MAX_DOCUMENT_BYTES {
        let text = format!("{shown}: {} MB are too large for a document of a surface", bytes >> 20);
        return Err(TaskError::unanswerable(text));
    }
    let text = sources.text(path, MAX_DOCUMENT_BYTES as usize)?;
    let wanted = "a reference in JSON is a document of `trueness surface --json`";
    let document: Document = serde_json::from_str(&text).meaning(|| format!("{shown}: {wanted}"))?;
    if document.schema != SCHEMA {
        return Err(TaskError::unanswerable(format!(
            "{shown}: this is a document {}; {wanted} ({SCHEMA})",
            document.schema
        )));
    }
    if document.units.as_deref() != Some(UNITS) {
        let units = document.units.as_deref().unwrap_or("not told");
        return Err(TaskError::unanswerable(format!(
            "{shown}: its units are {units}; documents of surfaces are in {UNITS}"
        )));
    }
    let Document { degree, knots, control_points, trim, .. } = document;
    let direction = |name: &str, degree: usize, values: Vec<f64>| {
        Knots::new(degree, values).meaning(|| format!("{shown}: knots of {name}"))
    };
    let knots = [direction("u", degree[0], knots.u)?, direction("v", degree[1], knots.v)?];
    let columns = knots[1].count();
    if let Some(row) = control_points.iter().position(|row| row.len() != columns) {
        return Err(TaskError::unanswerable(format!(
            "{shown}: control_points[{row}] has {} points; by the knots of v there must be {columns}",
            control_points[row].len()
        )));
    }
    let points = control_points.concat();
    let count = points.len() as u64;
    let surface = Surface::new(knots, points).meaning(|| format!("{shown}: control_points"))?;
    let trimmed = trim.map(|trim| Warning::Trimmed { count: trim.regions.len() as u64 });
    let record = InputRecord {
        role: Role::Reference,
        path: shown.to_string(),
        format: "surface-json".into(),
        bytes,
        sha256: None,
        sha256_reason: None,
        unit_assumed: "mm".into(),
        unit_from: "header".into(),
        table: None,
        points: count,
        facets: None,
        incomplete: None,
        cad: None,
        trimmed_faces: super::unread::trimmed(trimmed.as_slice()),
        bounds: None,
        warnings: trimmed.iter().map(ToString::to_string).collect(),
    };
    Ok(Some((surface.into(), record)))
}

/// Whether the first byte that is no blank opens an object. What cannot be read is left to the other readers to say.
fn begins_with_a_brace(sources: &dyn Sources, path: &Path) -> bool {
    let head = sources.bytes(path).and_then(|bytes| bytes.head(MAX_BLANK_BYTES));
    head.is_ok_and(|head| head.trim_ascii_start().starts_with(b"{"))
}

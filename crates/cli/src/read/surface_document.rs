//! A surface from a result document of `trueness surface`.

use crate::run_files::is_stream;
use anyhow::{Context, bail};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::fs::File;
use std::io::Read;
use std::path::Path;
use trueness_document::surface::SCHEMA;
use trueness_document::{InputRecord, Role, UNITS};
use trueness_files::Warning;
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

/// Largest document that is taken.
const LARGEST: u64 = 4 << 30;

/// The surface; `None` if the file is no JSON. Streams are never looked into.
pub fn read(path: &Path) -> anyhow::Result<Option<(Nurbs, InputRecord)>> {
    if is_stream(path) || !begins_with_a_brace(path) {
        return Ok(None);
    }
    let shown = path.display();
    let bytes = std::fs::metadata(path).with_context(|| format!("{shown}: it cannot be read"))?.len();
    if bytes > LARGEST {
        bail!("{shown}: {} MB are too large for a document of a surface", bytes >> 20);
    }
    let text = std::fs::read(path).with_context(|| format!("{shown}: it cannot be read"))?;
    let wanted = "a reference in JSON is a document of `trueness surface --json`";
    let document: Document = serde_json::from_slice(&text).with_context(|| format!("{shown}: {wanted}"))?;
    if document.schema != SCHEMA {
        bail!("{shown}: this is a document {}; {wanted} ({SCHEMA})", document.schema);
    }
    if document.units.as_deref() != Some(UNITS) {
        let units = document.units.as_deref().unwrap_or("not told");
        bail!("{shown}: its units are {units}; documents of surfaces are in {UNITS}");
    }
    let Document { degree, knots, control_points, trim, .. } = document;
    let direction = |name: &str, degree: usize, values: Vec<f64>| {
        Knots::new(degree, values).with_context(|| format!("{shown}: knots of {name}"))
    };
    let knots = [direction("u", degree[0], knots.u)?, direction("v", degree[1], knots.v)?];
    let columns = knots[1].count();
    if let Some(row) = control_points.iter().position(|row| row.len() != columns) {
        bail!(
            "{shown}: control_points[{row}] has {} points; by the knots of v there must be {columns}",
            control_points[row].len()
        );
    }
    let points = control_points.concat();
    let count = points.len() as u64;
    let surface = Surface::new(knots, points).with_context(|| format!("{shown}: control_points"))?;
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
        trimmed_faces: super::unread::trimmed(trimmed.as_slice()),
        bounds: None,
        warnings: trimmed.iter().map(ToString::to_string).collect(),
    };
    Ok(Some((surface.into(), record)))
}

/// Whether the first byte that is no blank opens an object. What cannot be read is left to the other readers to say.
fn begins_with_a_brace(path: &Path) -> bool {
    let mut head = [0; 64];
    let read = File::open(path).and_then(|mut file| file.read(&mut head)).unwrap_or(0);
    head[..read].trim_ascii_start().starts_with(b"{")
}

//! Deviations of all that was measured from the reference, as `compare` computes them.

use super::data::{Data, Stop};
use crate::compare::{self, CompareError, Comparisons, Facing, Lines, Options, Reference, vertex_normals};
use crate::plan::Deviation;
use std::convert::Infallible;
use trueness_geom::closest::QueryError;
use trueness_geom::cloud::Whole;
use trueness_geom::deviation::surface::SurfaceOptions;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;

/// Deviations from the reference, with what they were asked by.
pub struct Deviations {
    /// What was found; one reference.
    pub found: Comparisons,
    /// How it was asked.
    pub options: Options,
    /// The reference.
    pub reference: Mesh,
    /// `points` of a cloud, `vertices` of a mesh.
    pub kind: &'static str,
}

impl Deviations {
    /// The reference under the name that documents call it by.
    pub fn references(&self, name: &str) -> [Reference<'_>; 1] {
        [Reference { name: name.into(), mesh: &self.reference, splines: None }]
    }
}

/// Of the data where the alignment took them. The reference is moved out of the data.
pub(super) fn deviations(
    asked: &Deviation,
    data: &mut Data,
    progress: &dyn Progress,
) -> Result<Deviations, Stop> {
    let (Some(measured), Some(reference)) = (&data.measured, data.reference.take()) else {
        return Err(Stop::Deviation("one of them is not there".into()));
    };
    let normals = match asked.needs_normals() {
        None => vec![],
        Some(_) if measured.faces.is_empty() => std::mem::take(&mut data.normals),
        Some(_) => vertex_normals(measured),
    };
    let options = Options {
        facing: asked.facing.map(|angle| Facing::new(angle, normals.clone())),
        along: asked.along.map(|rule| Lines::new(rule, normals)),
        outliers: asked.outliers,
        coverage: asked.coverage,
        surface: SurfaceOptions {
            max_distance: asked.max_distance,
            skip_boundary: asked.skip_boundary,
            ..SurfaceOptions::default()
        },
        tolerance: asked.tolerance,
        required_share: asked.required_share,
        shown: data.shown,
        seed: data.seed,
        ..Options::default()
    };
    let mut points = Whole::<Infallible>::new(measured.positions.clone());
    let references = [Reference { name: "the reference".into(), mesh: &reference, splines: None }];
    let found = compare::run(&mut points, &references, &options, progress, |_| Ok::<(), Infallible>(()));
    let found = found.map_err(|e| match e {
        CompareError::Query(QueryError::Cancelled(e)) => e.into(),
        e => Stop::Deviation(e.to_string()),
    })?;
    let kind = if measured.faces.is_empty() { "points" } else { "vertices" };
    Ok(Deviations { found, options, reference, kind })
}

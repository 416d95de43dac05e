//! From a segmentation to the result document.

use crate::file_numbers::LeftOut;
use crate::fit::{named, uncertainty};
use crate::noise::{NoiseOrReason, points_per_independent, record as noise_record};
use crate::words::ToWord;
use std::collections::HashMap;
use trueness_document::segment::{PieceKind, RegionRecord, SCHEMA, SegmentDocument};
use trueness_document::{Bounds, InputRecord, UNITS, VERSION};
use trueness_geom::mesh::Mesh;
use trueness_geom::segment::{Options, Region, Segmentation};

/// The document of what was found in the file of `inputs`, with its noise; with `members`, the pieces of each region are listed by their
/// numbers in the file.
pub fn document(
    found: &Segmentation,
    noise: &NoiseOrReason,
    pieces: PieceKind,
    inputs: Vec<InputRecord>,
    options: &Options,
    members: Option<LeftOut>,
) -> SegmentDocument {
    let mut listed = vec![members.map(|_| Vec::new()); found.regions.len()];
    for (piece, &label) in found.labels.iter().enumerate() {
        if let Some(Some(list)) = listed.get_mut(label as usize) {
            list.push(members.unwrap_or_default().in_file(piece as u32));
        }
    }
    let shared = points_per_independent(noise);
    let (shared_noise, shared_noise_reason) = noise_record(noise);
    let record = |((number, region), members)| record(number, region, shared, pieces, members);
    SegmentDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs,
        pieces,
        count: found.labels.len() as u64,
        unassigned: found.labels.iter().filter(|&&label| label == u32::MAX).count() as u64,
        noise: found.noise,
        shared_noise,
        shared_noise_reason,
        tolerance: found.tolerance,
        tolerance_given: options.tolerance.is_some(),
        crease: options.crease,
        min_share: found.min_share,
        seed: options.seed,
        regions: found.regions.iter().enumerate().zip(listed).map(record).collect(),
    }
}

fn record(
    number: usize,
    region: &Region,
    points_per_independent: f64,
    pieces: PieceKind,
    members: Option<Vec<u32>>,
) -> RegionRecord {
    let residuals = &region.fit.residuals;
    let (uncertainty, uncertainty_reason) = uncertainty(&region.fit, points_per_independent);
    let area = (pieces == PieceKind::Facets).then_some(region.area);
    RegionRecord {
        number: number as u64,
        shape: region.fit.shape.kind().word(),
        parameters: named(region.fit.shape.parameters()),
        uncertainty,
        uncertainty_reason,
        pieces: region.pieces as u64,
        area,
        area_reason: area.is_none().then(|| "points have no area".into()),
        share: region.share,
        points: region.points.len() as u64,
        rms: residuals.rms,
        max: region.farthest,
        form_error: residuals.form_error,
        bounds: Bounds { min: region.bounds.min, max: region.bounds.max },
        members,
    }
}

/// These facets with their own vertices.
pub fn cut_out(mesh: &Mesh, facets: &[usize]) -> Mesh {
    let mut part = Mesh::default();
    let mut number: HashMap<u32, u32> = HashMap::new();
    for face in facets.iter().filter_map(|f| mesh.faces.get(*f)) {
        let corner = face.map(|v| {
            *number.entry(v).or_insert_with(|| {
                part.positions.extend(mesh.positions.get(v as usize));
                part.positions.len() as u32 - 1
            })
        });
        part.faces.push(corner);
    }
    part
}

//! `trueness/segment/1`: elements found in a mesh or cloud.

mod page;

use super::fit::{Number, named, uncertainty};
use super::{
    Bounds, InputRecord, NoiseOrReason, SharedNoise, UNITS, VERSION, Word, noise_record,
    points_per_independent,
};
use crate::file_numbers::LeftOut;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use trueness_geom::segment::{Options, Region, Segmentation};
use trueness_geom::shape::Kind;

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/segment/1";

/// The whole document. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct SegmentDocument {
    /// `trueness/segment/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// What was put into regions: `facets` or `points`.
    pub pieces: PieceKind,
    /// How many there are.
    pub count: u64,
    /// How many belong to no region.
    pub unassigned: u64,
    /// Standard deviation of the noise found in the data.
    pub noise: f64,
    /// The noise of the points about their elements, and how far neighbors share it: the uncertainties take it into account.
    #[serde(default)]
    pub shared_noise: Option<SharedNoise>,
    /// Why none is told: the uncertainties are those of independent points.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shared_noise_reason: Option<String>,
    /// Distance up to which points belong to an element: no point of a region lies farther off.
    pub tolerance: f64,
    /// Whether that distance was given, not found.
    pub tolerance_given: bool,
    /// Angle between neighboring pieces from which on there is an edge between them.
    pub crease: f64,
    /// Least share of the area, or of the points, that a region must have.
    pub min_share: f64,
    /// Seed of everything random.
    pub seed: u64,
    /// The regions, largest first.
    pub regions: Vec<RegionRecord>,
}

/// What regions are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PieceKind {
    /// Facets of a mesh.
    Facets,
    /// Points of a cloud.
    Points,
}

/// One element and what belongs to it.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct RegionRecord {
    /// Its number, from 0; the label of its facets or points.
    pub number: u64,
    /// `plane`, `cylinder`, `cone`, `sphere` or `torus`.
    pub shape: Word<Kind>,
    /// The element by least squares, by names, as in a fit.
    pub parameters: BTreeMap<String, Number>,
    /// Standard uncertainty of each parameter; of places and directions, coordinate by coordinate.
    pub uncertainty: Option<BTreeMap<String, Number>>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub uncertainty_reason: Option<String>,
    /// Number of facets, or of points of a cloud.
    pub pieces: u64,
    /// Area of the facets, mm²; `null` for a cloud.
    pub area: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub area_reason: Option<String>,
    /// Share of the area of all facets, or of all points of a cloud.
    pub share: f64,
    /// Points that the element was fitted to: those inside the region, not on its edges, where there are enough.
    pub points: u64,
    /// Root mean square of their distances.
    pub rms: f64,
    /// Greatest magnitude of the distances of all points of the region's facets, or of its points: within the tolerance.
    pub max: f64,
    /// Of the points that it was fitted to, greatest less least signed distance.
    pub form_error: f64,
    /// Box around the region.
    pub bounds: Bounds,
    /// The numbers of its facets or points in the file, from 0, where they were asked for.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub members: Option<Vec<u32>>,
}

impl SegmentDocument {
    /// The document of what was found in the file of `inputs`, with its noise; with `members`, the pieces of each region are listed by their
    /// numbers in the file.
    pub fn new(
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
        shape: Word(region.fit.shape.kind()),
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

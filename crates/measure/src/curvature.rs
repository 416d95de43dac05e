//! From the curvatures of a mesh or cloud to the result document, and to what a report draws of them.

mod bend;
mod values;

pub use bend::bend_record;
pub use values::{value, values};

use crate::noise::{NoiseOrReason, noise_or_reason, record};
use crate::statistics::{counted, statistics};
use crate::words::ToWord;
use std::collections::BTreeMap;
use trueness_document::curvature::{
    CurvatureDocument, CurvatureKind, CurvaturePlace, Neighborhood, NoCurvature, NormalSource, PlaceKind,
    Quantity, Range, SCHEMA,
};
use trueness_document::scale::Scale;
use trueness_document::surface::MapRecord;
use trueness_document::{InputRecord, UNITS, VERSION, Word};
use trueness_geom::noise::{self, NoNoise};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::scan::Scan;
use trueness_geom::segment::is_drawn;
use trueness_geom::space::{Aabb, Point};
use trueness_geom::stats::statistics::{Statistics, Summary};
use trueness_surface::curvature::{Curvatures, Jet, Options, Reach};

/// The noise of the vertices of a mesh, or of the points of a cloud, and how far neighbors share it; or why none is told: it is drawn, or there
/// are too few points.
///
/// # Errors
/// Cancelled.
pub fn noise(of: &Scan, seed: u64, progress: &dyn Progress) -> Result<NoiseOrReason, Cancelled> {
    let found = noise::scan(of, seed, progress);
    let is_drawn = || of.mesh().is_some_and(is_drawn);
    noise_or_reason(found.and_then(|noise| if is_drawn() { Err(NoNoise::Drawn) } else { Ok(noise) }))
}

/// The document of the curvatures at the points of `scan`, as `inputs` has them.
/// `None` where no place has curvatures; [`without`] tells why.
///
/// Cost: some passes over the places, and one number a place.
pub fn document(
    found: &Curvatures,
    scan: &Scan,
    options: &Options,
    noise: &NoiseOrReason,
    inputs: Vec<InputRecord>,
) -> Option<CurvatureDocument> {
    let points = scan.points();
    let (places, normals) = match scan {
        Scan::Mesh(_) => (PlaceKind::Vertices, NormalSource::Facets),
        Scan::Cloud(_) => (PlaceKind::Points, NormalSource::Neighbors),
    };
    let jets: Vec<&Jet> = found.places.iter().flatten().collect();
    let size =
        Aabb::of(found.places.iter().zip(points).filter(|(p, _)| p.is_ok()).map(|(_, p)| p)).diagonal();
    let (shared_noise, shared_noise_reason) = record(noise);
    let [mean, gaussian, k1, k2] = CurvatureKind::ALL.map(|kind| quantity(found, points, size, kind));
    Some(CurvatureDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs,
        places: Word(places),
        degree: options.degree as u64,
        neighborhood: neighborhood(options),
        boundary: options.boundary,
        sign: "positive towards the normal".into(),
        normals: Word(normals),
        parts: found.parts as u64,
        total: points.len() as u64,
        count: jets.len() as u64,
        without: without(found),
        mean: mean?,
        gaussian: gaussian?,
        k1: k1?,
        k2: k2?,
        shared_noise,
        shared_noise_reason,
        uncertainty: range(&jets, |j| j.uncertainty)?,
        residual: range(&jets, |j| j.residual)?,
        condition: range(&jets, |j| j.condition)?,
        neighbors: range(&jets, |j| f64::from(j.neighbors))?,
        reach: range(&jets, |j| j.reach)?,
    })
}

fn neighborhood(options: &Options) -> Neighborhood {
    match (options.reach, options.reach.neighbors(options.degree)) {
        (Reach::Radius(radius), _) => Neighborhood::Radius { radius },
        (_, count) => Neighborhood::Count { neighbors: count.unwrap_or(0) as u64 },
    }
}

/// How many places have no curvatures, by reason.
pub fn without(found: &Curvatures) -> BTreeMap<Word<NoCurvature>, u64> {
    let mut all = BTreeMap::new();
    for why in found.places.iter().filter_map(|p| p.as_ref().err()) {
        *all.entry(why.word()).or_insert(0) += 1;
    }
    all
}

fn quantity(found: &Curvatures, points: &[Point], size: f64, kind: CurvatureKind) -> Option<Quantity> {
    let all = values(found, kind);
    let known: Vec<f64> = all.iter().copied().filter(|v| !v.is_nan()).collect();
    let (all_known, map) = map(&known, kind, size);
    let extreme = |better: fn(f64, f64) -> bool| {
        let known = (0..all.len()).filter(|i| !all[*i].is_nan());
        known.reduce(|best, i| if better(all[i], all[best]) { i } else { best })
    };
    let place = |index: usize| Some(place(index, points, found.places[index].as_ref().ok()?));
    Some(Quantity {
        statistics: statistics(&all_known, 0.0),
        histogram: map.histogram,
        maximum: place(extreme(|a, b| a > b)?)?,
        minimum: place(extreme(|a, b| a < b)?)?,
        scale: map.scale,
    })
}

/// Statistics of the known values of a curvature on a body of this size, and what reports draw them by.
pub(crate) fn map(known: &[f64], kind: CurvatureKind, size: f64) -> (Statistics, MapRecord) {
    let all = Summary::of(known).all;
    // A single edge must not hide how the rest bends.
    let [.., p2_5, _, _, _, _, _, p97_5, _, _] = all.percentiles;
    let most = p2_5.map_or(0.0, f64::abs).max(p97_5.map_or(0.0, f64::abs));
    let scale = Scale::for_values(most.max(kind.least(size)), kind.unit());
    let mean = all.mean.ok();
    let record = MapRecord { histogram: counted(&all, known), mean, scale };
    (all, record)
}

fn place(index: usize, points: &[Point], jet: &Jet) -> CurvaturePlace {
    CurvaturePlace {
        index: index as u64,
        position: points[index],
        bend: bend_record(&jet.bend),
        uncertainty: jet.uncertainty,
        residual: jet.residual,
        condition: jet.condition,
        neighbors: u64::from(jet.neighbors),
    }
}

fn range(jets: &[&Jet], value: impl Fn(&Jet) -> f64) -> Option<Range> {
    Range::of(jets.iter().map(|jet| value(jet)).collect())
}

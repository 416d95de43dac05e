//! From an element fitted to points to the result document, and to what a report draws of it.

mod distances;
mod extent;

pub use distances::distances;
pub use extent::extent;

use trueness_document::fit::FitDocument;
use trueness_document::scale::Scale;
use trueness_document::{Histogram, InputRecord, NoiseOrReason, noise_or_reason};
use trueness_geom::fit::Fit;
use trueness_geom::mesh::Mesh;
use trueness_geom::noise;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Point;
use trueness_geom::stats::statistics::Summary;

/// The noise of the vertices, or without facets the points, of `scan` about the element fitted to them, and how far neighbors share it; or why
/// none is told: the element is a curve, or there are too few points.
///
/// # Errors
/// Cancelled.
pub fn noise(fit: &Fit, scan: &Mesh, seed: u64, progress: &dyn Progress) -> Result<NoiseOrReason, Cancelled> {
    if fit.shape.kind().is_curve() {
        return Ok(Err("it is a curve: how far neighbors share noise is found along surfaces".into()));
    }
    // What a robust fit left out lies beyond the rest.
    let [(least, _), (most, _)] = [fit.residuals.min, fit.residuals.max];
    let counted = |d: f64| if (least..=most).contains(&d) { d } else { f64::NAN };
    let distances: Vec<f64> = distances(&fit.shape, &scan.positions).into_iter().map(counted).collect();
    noise_or_reason(noise::about(scan, &distances, seed, progress))
}

/// The document of a fit to `points`, which are those of `inputs` in their order, with their noise: with the points' extent on the element,
/// the histogram of their distances, and colors for them.
///
/// Cost: some passes over the points, and one number a point.
pub fn document(
    fit: &Fit,
    noise: &NoiseOrReason,
    points: &[Point],
    inputs: Vec<InputRecord>,
    seed: u64,
) -> FitDocument {
    let mut document = FitDocument::new(fit, noise, inputs, seed);
    let place = |index: u64| points.get(index as usize).copied();
    document.minimum.position = place(document.minimum.point);
    document.maximum.position = place(document.maximum.point);
    document.touching.iter_mut().for_each(|t| t.position = place(t.point));
    let distances = distances(&fit.shape, points);
    let all = Summary::of(&distances).all;
    document.extent = extent(&fit.shape, points);
    document.histogram = Histogram::counted(&all, &distances);
    // A single point far off must not hide the form of the rest.
    let [.., p2_5, _, _, _, _, _, p97_5, _, _] = all.percentiles;
    let p95 = p2_5.map_or(0.0, f64::abs).max(p97_5.map_or(0.0, f64::abs));
    document.scale = Some(Scale::for_deviations(p95, None));
    document
}

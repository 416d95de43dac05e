//! From an element fitted to points to the result document, and to what a report draws of it.

mod distances;
mod extent;
mod parameters;

pub use distances::distances;
pub use extent::extent;
pub use parameters::{named, uncertainty};

use crate::noise::{NoSharedNoise, NoiseOrReason, noise_or_reason, points_per_independent, record};
use crate::statistics::counted;
use crate::words::{ToGeometry, ToWord};
use parameters::NONE_LEFT;
use trueness_document::fit::{Extreme, FitDocument, SCHEMA, Touching};
use trueness_document::scale::Scale;
use trueness_document::{InputRecord, UNITS, VERSION};

use trueness_geom::fit::Fit;
use trueness_geom::noise;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::scan::Scan;
use trueness_geom::shape::Kind;
use trueness_geom::space::Point;
use trueness_geom::stats::statistics::Summary;

/// The noise of the points of `scan` about the element fitted to them, and how far neighbors share it; or why
/// none is told: the element is a curve, or there are too few points.
///
/// # Errors
/// Cancelled.
pub fn noise(fit: &Fit, scan: &Scan, seed: u64, progress: &dyn Progress) -> Result<NoiseOrReason, Cancelled> {
    if fit.shape.kind().is_curve() {
        return Ok(Err(NoSharedNoise::Curve));
    }
    // What a robust fit left out lies beyond the rest.
    let [(least, _), (most, _)] = [fit.residuals.min, fit.residuals.max];
    let counted = |d: f64| if (least..=most).contains(&d) { d } else { f64::NAN };
    let distances: Vec<f64> = distances(&fit.shape, scan.points()).into_iter().map(counted).collect();
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
    let mut document = bare(fit, noise, inputs, seed);
    let place = |index: u64| points.get(index as usize).copied();
    document.minimum.position = place(document.minimum.point);
    document.maximum.position = place(document.maximum.point);
    document.touching.iter_mut().for_each(|t| t.position = place(t.point));
    let distances = distances(&fit.shape, points);
    let all = Summary::of(&distances).all;
    document.extent = extent(&fit.shape, points);
    document.histogram = counted(&all, &distances);
    // A single point far off must not hide the form of the rest.
    let [.., p2_5, _, _, _, _, _, p97_5, _, _] = all.percentiles;
    let p95 = p2_5.map_or(0.0, f64::abs).max(p97_5.map_or(0.0, f64::abs));
    document.scale = Some(Scale::for_deviations(p95, None));
    document
}

/// Which element it is, in the plane or in space.
pub fn kind(document: &FitDocument) -> Kind {
    Kind::named(document.shape.name(), document.planar).unwrap_or(document.shape.geometry())
}

/// The document of a fit to the points of `inputs`, with their noise.
fn bare(fit: &Fit, noise: &NoiseOrReason, inputs: Vec<InputRecord>, seed: u64) -> FitDocument {
    let residuals = &fit.residuals;
    let extreme = |(distance, point): (f64, usize)| Extreme { distance, point: point as u64, position: None };
    let (uncertainty, uncertainty_reason) = uncertainty(fit, points_per_independent(noise));
    let (shared_noise, shared_noise_reason) = record(noise);
    FitDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs,
        shape: fit.shape.kind().word(),
        planar: fit.shape.kind().is_flat(),
        method: fit.method.word(),
        parameters: named(fit.shape.parameters()),
        uncertainty,
        uncertainty_reason,
        shared_noise,
        shared_noise_reason,
        form_error: residuals.form_error,
        rms: residuals.rms,
        std_dev: residuals.std_dev,
        std_dev_reason: residuals.std_dev.is_none().then(|| NONE_LEFT.into()),
        count: residuals.count as u64,
        outliers: fit.outliers as u64,
        minimum: extreme(residuals.min),
        maximum: extreme(residuals.max),
        touching: fit
            .touching
            .iter()
            .map(|t| Touching {
                point: t.point as u64,
                side: t.side,
                multiplier: t.multiplier,
                position: None,
            })
            .collect(),
        extent: None,
        histogram: None,
        scale: None,
        iterations: fit.iterations as u64,
        converged: fit.converged,
        seed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::fit::{Method, Options, fit};
    use trueness_geom::progress::Silent;

    #[test]
    fn a_document_is_read_back_as_it_was_written() {
        let points: Vec<[f64; 3]> = (0..12)
            .map(|k| {
                let (a, r) = (f64::from(k), 10.0 + 0.01 * f64::from(k % 3));
                [r * a.cos(), r * a.sin(), 0.0]
            })
            .collect();
        for method in Method::ALL {
            let options = Options { method, ..Options::default() };
            let fit = fit(&points, Kind::Circle2, &options, &Silent).unwrap();
            let document = bare(&fit, &Err(NoSharedNoise::Curve), vec![], 0);
            let text = serde_json::to_string(&document).unwrap();
            let back: FitDocument = serde_json::from_str(&text).unwrap();
            assert_eq!((back.parameters.clone(), kind(&back)), (document.parameters.clone(), Kind::Circle2));
            let value: serde_json::Value = serde_json::from_str(&text).unwrap();
            assert_eq!(value["shape"], "circle");
            assert_eq!(value["parameters"]["center"].as_array().unwrap().len(), 3);
            assert_eq!(value["uncertainty"].is_null(), value["uncertainty_reason"].is_string());
            assert_eq!(value["touching"].as_array().unwrap().is_empty(), fit.touching.is_empty());
        }
    }
}

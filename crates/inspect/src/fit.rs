//! From an element fitted to points to the result document, and to what a report draws of it.

mod distances;
mod element;
mod extent;
mod view;

pub use view::{View, side_color};

use crate::results::fit::FitDocument;
use crate::results::{Histogram, InputRecord};
use crate::scale::Scale;
use distances::distances;
use trueness_geom::fit::Fit;
use trueness_geom::space::Point;
use trueness_geom::stats::statistics::Summary;

/// The document of a fit to `points`, which are those of `inputs` in their order: with the points' extent on the element,
/// the histogram of their distances, and colors for them.
///
/// Cost: some passes over the points, and one number a point.
pub fn document(fit: &Fit, points: &[Point], inputs: Vec<InputRecord>, seed: u64) -> FitDocument {
    let mut document = FitDocument::new(fit, inputs, seed);
    let place = |index: u64| points.get(index as usize).copied();
    document.minimum.position = place(document.minimum.point);
    document.maximum.position = place(document.maximum.point);
    document.touching.iter_mut().for_each(|t| t.position = place(t.point));
    let distances = distances(&fit.shape, points);
    let all = Summary::of(&distances).all;
    document.extent = extent::extent(&fit.shape, points);
    document.histogram = Histogram::counted(&all, &distances);
    // A single point far off must not hide the form of the rest.
    let [.., p2_5, _, _, _, _, _, p97_5, _, _] = all.percentiles;
    let p95 = p2_5.map_or(0.0, f64::abs).max(p97_5.map_or(0.0, f64::abs));
    document.scale = Some(Scale::for_deviations(p95, None));
    document
}

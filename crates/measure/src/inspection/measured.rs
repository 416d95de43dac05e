//! What was measured beside the features of a plan, where no reference tells: elements that a segmentation finds.

use super::stop::Stop;
use crate::plan::Plan;
use crate::requirement::Feature;
use std::borrow::Cow;
use trueness_geom::feature::{Nearness, Nominal, in_cloud};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::parallel::prelude::*;
use trueness_geom::partition::{Faces, spacing};
use trueness_geom::progress::Progress;
use trueness_geom::scan::Scan;
use trueness_geom::segment::{self, Region, SegmentError, Segmentation};
use trueness_geom::space::{Point, cross, dot, minus, plus, times, unit};
use trueness_geom::spatial::neighbors::PointTree;

/// Points of a cloud that are segmented, at most.
const MAX_SEGMENTED: usize = 200_000;
/// A region is of a feature if this share of its points within the bounds of the nominal is within its reach.
const MIN_SHARE_IN_REACH: f64 = 0.5;
/// Points of a region that are looked at for its width.
const WIDTH_SAMPLES: usize = 500;
/// Points within three distances of points.
const POINTS_WITHIN_THREE_SPACINGS: usize = 28;
/// Points of a region lie no farther apart than so many times their mean distance.
const MAX_POINT_SPACINGS: f64 = 1.5;

/// Adds the elements that are of no feature as faces.
///
/// Cost: one segmentation.
pub(super) fn add(
    faces: &mut Faces,
    scan: &Scan,
    plan: &Plan,
    seed: u64,
    progress: &dyn Progress,
) -> Result<(), Stop> {
    let options = segment::Options { seed, ..segment::Options::default() };
    let (points, found) = match scan {
        Scan::Mesh(mesh) => (Cow::Borrowed(&mesh.positions[..]), segment::mesh(mesh, &options, progress)),
        Scan::Cloud(points) => {
            let chosen = Random::new(seed).choose(MAX_SEGMENTED, points.len());
            let chosen: Vec<Point> = chosen.into_iter().map(|i| points[i]).collect();
            let found = segment::cloud(&chosen, &options, progress);
            (Cow::Owned(chosen), found)
        }
    };
    let points = &points[..];
    let found = match found {
        Ok(found) => found,
        Err(SegmentError::Cancelled(e)) => return Err(e.into()),
        // What has no elements has none beside the features.
        Err(_) => return Ok(()),
    };
    let apart = MAX_POINT_SPACINGS * spacing(points, seed);
    let wide = wide(points, &found.regions, seed);
    for (number, region) in (0u32..).zip(&found.regions) {
        let places: Vec<Point> = region.points.iter().map(|p| points[*p as usize]).collect();
        let is_of = |feature: &Feature| {
            feature.nominal.as_ref().is_some_and(|nominal| is_of(region, &places, feature, nominal))
        };
        if !plan.features.iter().any(is_of) {
            let way = (outward(scan.mesh(), &found, number), !wide[number as usize]);
            faces.add_measured(&places, region.fit.shape, apart, way);
        }
    }
    Ok(())
}

/// Which regions are wider than six distances of points somewhere: a narrower one may be where a scan rounds an edge, and no face.
fn wide(points: &[Point], regions: &[Region], seed: u64) -> Vec<bool> {
    let mut labels = vec![u32::MAX; points.len()];
    for (number, region) in (0u32..).zip(regions) {
        region.points.iter().for_each(|p| labels[*p as usize] = number);
    }
    let tree = PointTree::new(points);
    let is_wide = |(number, region): (usize, &Region)| {
        let chosen = Random::new(seed).choose(WIDTH_SAMPLES, region.points.len());
        let is_middle = |i: usize| {
            let near = tree.k_nearest(&points[region.points[i] as usize], POINTS_WITHIN_THREE_SPACINGS, None);
            near.iter().all(|n| labels[n.1 as usize] == number as u32)
        };
        chosen.into_iter().any(is_middle)
    };
    regions.par_iter().enumerate().map(is_wide).collect()
}

/// Whether a region lies where a feature is sought, and faces as it does.
fn is_of(region: &Region, places: &[Point], feature: &Feature, nominal: &Nominal) -> bool {
    let near = feature.near(nominal);
    let wide = Nearness { distance: f64::INFINITY, margin: 0.0, ..near };
    let Some(surface) = nominal.surface() else { return false };
    let Ok(within) = in_cloud(places, nominal, &wide) else { return false };
    let faces = |p: Point| {
        let (off, way) = surface.distance(p)?;
        let own = unit(region.fit.shape.normal(p))?.0;
        Some(off.abs() <= near.distance && dot(way, own).abs() >= libm::cos(near.angle))
    };
    let near = within.points.iter().filter(|p| faces(places[**p as usize]) == Some(true)).count();
    near > 0 && near as f64 >= MIN_SHARE_IN_REACH * within.points.len() as f64
}

/// Whether distances of the element of a region are positive outside of the material; `true` of a cloud, which does not tell.
fn outward(mesh: Option<&Mesh>, found: &Segmentation, region: u32) -> bool {
    let Some(mesh) = mesh else { return true };
    let shape = &found.regions[region as usize].fit.shape;
    let along = |f: &[u32; 3]| {
        let [a, b, c] = f.map(|v| mesh.positions[v as usize]);
        let middle = times(1.0 / 3.0, plus(a, plus(b, c)));
        dot(cross(minus(b, a), minus(c, a)), shape.normal(middle))
    };
    let own = mesh.faces.iter().zip(&found.labels).filter(|(_, label)| **label == region);
    own.map(|(f, _)| along(f)).sum::<f64>() >= 0.0
}

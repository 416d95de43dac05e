//! Measured points over a feature that lie so deep that the other side of its wall is nearer.
//!
//! The ground of a dent deeper than half the wall has its nearest place on the reference on the face behind the feature, and is yet of
//! the feature. It lies within the wall, off both faces, and faces as the feature does: of a mesh the facets tell, of a cloud the heights of
//! the points around.

use super::belonging::Belonging;
use super::data::Stop;
use super::own_facets::OwnFacets;
use super::reference::{height, nearest, normal};
use std::collections::BTreeMap;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, Vector, dot, minus, norm, plus};
use trueness_geom::spatial::neighbors::PointTree;

/// Cosine of the angle between the ground and the feature, and between both faces of the wall, up to which they run along each other: 60°.
const ALONG: f64 = 0.5;
/// Share of the distance from the feature that a point over it has as height: what is beside it lies at an angle.
const OVER: f64 = 0.99;
/// Neighbors of a point that are asked, the fewest that tell, of how many times as many they are sought, the share of them that must lie about as high,
/// and the rise that they may have to it: 30°.
const NEIGHBORS: usize = 12;
const FEWEST: usize = 6;
const ASKED: usize = 4;
const LEVEL: f64 = 0.8;
const RISE: f64 = 0.5;
/// Points lie around a place if their mean is off it by no more than this share of their distance: of some on one side it is 0.4.
const CENTRAL: f64 = 0.15;
/// One in so many points of the ground of a dent must be seen to have the other face behind it. Of twelve neighbors strewn all around, by chance
/// the mean of more than half is off by more than [`CENTRAL`]; at the rim of a dent in the other face few pass.
const SOME: usize = 5;

/// How far off the feature such points are that are beyond its distance, mm.
///
/// Cost: one look at each measured point, a closest place for each that lies on no face, one look at each facet.
pub(super) fn behind(
    belonging: &Belonging,
    own: &OwnFacets,
    progress: &dyn Progress,
) -> Result<Vec<f64>, Stop> {
    let (reference, measured) = (belonging.reference.mesh, belonging.measured);
    let OwnFacets { near, mesh, tree, .. } = own;
    let upon = belonging.upon(near);
    let is_asked = |p: &u32| {
        let (face, off) = belonging.nearest[*p as usize];
        face != u32::MAX && off > upon && !own.has_within(face)
    };
    let asked: Vec<u32> = (0..measured.positions.len() as u32).filter(is_asked).collect();
    let places: Vec<Point> = asked.iter().map(|p| measured.positions[*p as usize]).collect();
    let hits = nearest(tree, &places, f64::INFINITY, progress)?;
    let mut within: BTreeMap<u32, (f64, Vector)> = BTreeMap::new();
    for ((p, at), (face, away)) in asked.into_iter().zip(places).zip(hits) {
        let other = belonging.nearest[p as usize].0;
        let Some((out, back)) = normal(mesh, face).zip(normal(reference, other)) else { continue };
        let deep = -height(mesh, face, at);
        let is_within = deep >= OVER * away && height(reference, other, at) < 0.0;
        if away > near.distance && is_within && dot(out, back) <= -ALONG {
            within.insert(p, (away, out));
        }
    }
    let mut found: BTreeMap<u32, f64> = BTreeMap::new();
    if within.is_empty() {
        return Ok(vec![]);
    }
    if measured.faces.is_empty() {
        found = of_cloud(belonging, upon, &within);
    }
    for (facet, corners) in (0u32..).zip(&measured.faces) {
        let inside = corners.iter().filter_map(|v| Some((*v, within.get(v)?)));
        for (v, (away, out)) in inside {
            if normal(measured, facet).is_some_and(|facing| dot(facing, *out) >= ALONG) {
                found.insert(v, *away);
            }
        }
    }
    Ok(found.into_values().collect())
}

/// Those of a cloud among the points within a wall that lie about as high as others around that are on no face, if the other face was measured
/// behind them: else they are the ground of a dent in that face.
fn of_cloud(belonging: &Belonging, upon: f64, within: &BTreeMap<u32, (f64, Vector)>) -> BTreeMap<u32, f64> {
    let places = &belonging.measured.positions;
    let all = PointTree::new(places);
    let off = |p: u32| belonging.nearest[p as usize].1;
    let around = |p: &Point, own: Option<u32>, is: &dyn Fn(u32) -> bool| -> Vec<Vector> {
        let near = all.k_nearest(p, ASKED * NEIGHBORS, own).into_iter().filter(|n| is(n.1));
        near.take(NEIGHBORS).map(|n| minus(places[n.1 as usize], *p)).collect()
    };
    let is_level = |p: u32, out: Vector| {
        let rises = around(&places[p as usize], Some(p), &|q| off(q) > upon);
        let level = rises.iter().filter(|d| dot(**d, out).abs() <= RISE * norm(**d)).count();
        rises.len() >= FEWEST && level as f64 >= LEVEL * rises.len() as f64
    };
    let level: BTreeMap<u32, f64> =
        within.iter().filter(|(p, w)| is_level(**p, w.1)).map(|(p, w)| (*p, w.0)).collect();
    let is_measured_behind = |p: &u32| {
        let foot = belonging.reference.tree().closest(&places[*p as usize], f64::INFINITY).ok().flatten();
        let Some(foot) = foot else { return false };
        let near = around(&foot.point, None, &|q| off(q) <= upon);
        let farthest = near.iter().map(|d| norm(*d)).fold(0.0, f64::max);
        let sum = near.iter().fold([0.0; 3], |sum, d| plus(sum, *d));
        // At the rim of a dent they lie on one side.
        near.len() >= FEWEST && norm(sum) <= CENTRAL * farthest * near.len() as f64
    };
    let behind = level.keys().filter(|p| is_measured_behind(p)).count();
    if SOME * behind >= level.len() { level } else { BTreeMap::new() }
}

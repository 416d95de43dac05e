//! Where the measured data lie on the reference, and which of its facets each feature has.

use super::data::{Data, Stop};
use super::own_facets::OwnFacets;
use super::seed::Seeded;
use crate::plan::{Feature, Plan};
use std::collections::BTreeMap;
use trueness_geom::closest::{Hit, Query, QueryError, Tree};
use trueness_geom::feature::{FeatureSearch, Nearness};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::space::{self, Point, Vector, dot};

/// Points farther off than this share of the size of the reference are of something else.
pub(super) const ELSEWHERE: f64 = 0.1;
/// So many times the median distance from the reference a point lies upon it: above six standard deviations of noise, for of the points of a wall
/// not one shall remain.
pub(super) const UPON: f64 = 10.0;
/// But no farther than this share of the distance up to which points are sought.
const FARTHEST: f64 = 0.25;
/// So many times nearer a face is clearly the nearer one.
pub(super) const NEARER: f64 = 2.0;

/// The measured data on the reference.
pub(super) struct Belonging<'a> {
    pub(super) reference: &'a Mesh,
    pub(super) measured: &'a Mesh,
    /// Of the features that the reference has.
    pub(super) search: FeatureSearch<'a>,
    pub(super) size: f64,
    /// Of each measured point the nearest facet and how far off it is, mm; `u32::MAX` for what is elsewhere.
    pub(super) nearest: Vec<(u32, f64)>,
    /// Median of the distances, mm.
    pub(super) median: f64,
    /// A step of single precision, which meshes pass through in their files, mm.
    pub(super) rounding: f64,
    /// Of the features, by their numbers, those facets of the reference that are their own; of some none is.
    own: BTreeMap<usize, OwnFacets>,
}

impl<'a> Belonging<'a> {
    /// Where there is a reference and a feature is sought by a nominal. Cost: a search tree, a closest place for each measured
    /// point, and a look at the facets of the reference near each feature.
    pub fn new(
        plan: &Plan,
        data: &'a Data,
        seeds: &BTreeMap<usize, Seeded>,
        progress: &dyn Progress,
    ) -> Result<Option<Belonging<'a>>, Stop> {
        let nominal = |(n, feature): &(usize, &Feature)| {
            let nominal = seeds.get(n).map(|s| s.nominal.clone()).or_else(|| feature.nominal.clone());
            nominal.map(|nominal| (*n, feature.near(&nominal), nominal))
        };
        let sought: Vec<_> = plan.features.iter().enumerate().filter_map(|f| nominal(&f)).collect();
        let (Some(measured), Some(reference)) = (&data.measured, &data.reference) else { return Ok(None) };
        if sought.is_empty() || reference.faces.is_empty() {
            return Ok(None);
        }
        let tree = Tree::build_watched(reference, progress).map_err(|e| Stop::Nominal(e.to_string()))?;
        let bounds = reference.bounds();
        let size = bounds.diagonal();
        let greatest = bounds.min.iter().chain(&bounds.max).fold(0.0, |m: f64, x| m.max(x.abs()));
        let rounding = f64::from(f32::EPSILON) * greatest;
        let nearest = nearest(&tree, &measured.positions, ELSEWHERE * size, progress)?;
        let mut all: Vec<f64> = nearest.iter().filter(|n| n.0 != u32::MAX).map(|n| n.1).collect();
        all.sort_unstable_by(f64::total_cmp);
        let median = all.get(all.len() / 2).copied().unwrap_or(0.0);
        let search = FeatureSearch::new(reference, tree);
        let own = sought.par_iter().map(|(n, near, nominal)| {
            let own = OwnFacets::new((reference, &search), nominal, near, rounding, progress)?;
            Ok(own.map(|own| (*n, own)))
        });
        let own = own.collect::<Result<Vec<_>, Stop>>()?.into_iter().flatten().collect();
        Ok(Some(Belonging { reference, measured, search, size, nearest, median, rounding, own }))
    }

    /// The facets of the reference that are those of a feature; `None` where it has none.
    pub fn own(&self, feature: usize) -> Option<&OwnFacets> {
        self.own.get(&feature)
    }

    /// How far off a face of the reference points lie upon it, as most of the measured do.
    pub fn upon(&self, near: &Nearness) -> f64 {
        (UPON * self.median).min(FARTHEST * near.distance).max(self.rounding)
    }

    /// Whether a measured point lies upon a facet of the reference that is none of a feature's.
    pub fn is_upon_other(&self, point: u32, feature: usize, near: &Nearness) -> bool {
        let (face, off) = self.nearest[point as usize];
        face != u32::MAX && off <= self.upon(near) && !self.own(feature).is_some_and(|own| own.has(face))
    }
}

/// The nearest facet to each place and how far off it is; `u32::MAX` beyond `farthest`.
pub(super) fn nearest(
    tree: &Tree,
    places: &[Point],
    farthest: f64,
    progress: &dyn Progress,
) -> Result<Vec<(u32, f64)>, Stop> {
    let query = Query { max_distance: farthest, ..Query::default() };
    let of = |hit: Option<Hit>| hit.map_or((u32::MAX, 0.0), |h| (h.face, h.distance()));
    tree.map_closest(places, &query, progress, |_, hit| of(hit)).map_err(|e| match e {
        QueryError::Cancelled(_) => Stop::Cancelled,
        e => Stop::Mesh(e.to_string()),
    })
}

/// Height over the plane of a facet, mm, positive outside the material; 0 of one without area.
pub(super) fn height(mesh: &Mesh, face: u32, p: Point) -> f64 {
    let corner = mesh.positions[mesh.faces[face as usize][0] as usize];
    normal(mesh, face).map_or(0.0, |out| dot(space::minus(p, corner), out))
}

pub(super) fn normal(mesh: &Mesh, face: u32) -> Option<Vector> {
    space::normal(mesh.faces.get(face as usize)?.map(|v| mesh.positions[v as usize]))
}

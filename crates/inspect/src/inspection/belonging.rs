//! Where the measured data lie on the reference, and which of its facets each feature has.

use super::data::{Data, Stop};
use super::own_facets::OwnFacets;
use super::reference::{ELSEWHERE, Reference, nearest};
use super::seed::Seeded;
use crate::plan::{Feature, Plan};
use std::collections::BTreeMap;
use trueness_geom::feature::Nearness;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;

/// So many times the median distance from the reference a point lies upon it: above six standard deviations of noise, for of the points of a wall
/// not one shall remain.
pub(super) const UPON: f64 = 10.0;
/// But no farther than this share of the distance up to which points are sought.
pub(super) const FARTHEST: f64 = 0.25;

/// The measured data on the reference.
pub(super) struct Belonging<'a> {
    pub(super) reference: Reference<'a>,
    pub(super) measured: &'a Mesh,
    /// Of each measured point the nearest facet and how far off it is, mm; `u32::MAX` for what is elsewhere.
    pub(super) nearest: Vec<(u32, f64)>,
    /// Median of the distances, mm.
    pub(super) median: f64,
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
        let reference = Reference::new(reference, progress)?;
        let nearest = nearest(reference.tree(), &measured.positions, ELSEWHERE * reference.size, progress)?;
        let mut all: Vec<f64> = nearest.iter().filter(|n| n.0 != u32::MAX).map(|n| n.1).collect();
        all.sort_unstable_by(f64::total_cmp);
        let median = all.get(all.len() / 2).copied().unwrap_or(0.0);
        let own = sought.par_iter().map(|(n, near, nominal)| {
            let own = OwnFacets::new(&reference, nominal, near, progress)?;
            Ok(own.map(|own| (*n, own)))
        });
        let own = own.collect::<Result<Vec<_>, Stop>>()?.into_iter().flatten().collect();
        Ok(Some(Belonging { reference, measured, nearest, median, own }))
    }

    /// The facets of the reference that are those of a feature; `None` where it has none.
    pub fn own(&self, feature: usize) -> Option<&OwnFacets> {
        self.own.get(&feature)
    }

    /// How far off a face of the reference points lie upon it, as most of the measured do.
    pub fn upon(&self, near: &Nearness) -> f64 {
        (UPON * self.median).min(FARTHEST * near.distance).max(self.reference.rounding)
    }

    /// Whether a measured point lies upon a facet of the reference that is none of a feature's.
    pub fn is_upon_other(&self, point: u32, feature: usize, near: &Nearness) -> bool {
        let (face, off) = self.nearest[point as usize];
        face != u32::MAX && off <= self.upon(near) && !self.own(feature).is_some_and(|own| own.has(face))
    }
}

//! Features that a plan names by a place on the reference: the region around it gives their nominal.

use super::data::{Data, Stop};
use crate::compare::far_seed;
use crate::plan::region::{facets_of, nominal_of};
use crate::plan::{Class, Plan, Source};
use std::collections::BTreeMap;
use trueness_geom::closest::Tree;
use trueness_geom::feature::Nominal;
use trueness_geom::progress::Progress;
use trueness_geom::segment::{self, SegmentError};
use trueness_geom::shape::Kind;
use trueness_geom::space::{cross, minus, norm};

/// The nominal that a seed leads to.
pub(super) struct Seeded {
    pub nominal: Nominal,
    /// Area of the region's facets, mm².
    pub area: f64,
}

/// The nominals of all features with a seed, by their numbers.
pub(super) fn seeded(
    plan: &Plan,
    data: &Data,
    progress: &dyn Progress,
) -> Result<BTreeMap<usize, Seeded>, Stop> {
    let mut all = BTreeMap::new();
    if !plan.features.iter().any(|f| matches!(f.source, Source::Seed(_))) {
        return Ok(all);
    }
    let Some(reference) = &data.reference else { return Ok(all) };
    let options = segment::Options { seed: data.seed, ..segment::Options::default() };
    let found = segment::mesh(reference, &options, progress).map_err(|e| match e {
        SegmentError::Cancelled(e) => e.into(),
        e => Stop::Nominal(format!("the reference cannot be segmented: {e}")),
    })?;
    let tree = Tree::build_watched(reference, progress).map_err(|e| Stop::Nominal(e.to_string()))?;
    for (number, feature) in plan.features.iter().enumerate() {
        let Source::Seed(seed) = &feature.source else { continue };
        let wrong = |what: String| Stop::Plan {
            span: seed.span.clone(),
            what: format!("feature \"{}\": {what}", feature.id),
        };
        let hit = tree.closest(&seed.value, f64::INFINITY).map_err(|e| wrong(e.to_string()))?;
        if let Some(what) = hit.and_then(|hit| far_seed(hit.distance, hit.point, reference)) {
            return Err(wrong(what));
        }
        let label = hit.and_then(|hit| found.labels.get(hit.face as usize).copied());
        let region = label.and_then(|l| found.regions.get(l as usize).map(|r| (l, r)));
        let Some((label, region)) = region else {
            return Err(wrong(
                "there is no plane, cylinder, cone or sphere of the reference at the seed".into(),
            ));
        };
        let kind = region.fit.shape.kind();
        if Some(kind) != kind_of(feature.class) {
            let what =
                format!("the reference has a {} at the seed, not a {}", kind.name(), feature.class.word());
            return Err(wrong(what));
        }
        let facets = facets_of(reference, &found, label);
        let nominal = nominal_of(&region.fit.shape, &facets)
            .ok_or_else(|| wrong("the region at the seed has no facets".into()))?;
        let area = facets.iter().map(|[a, b, c]| 0.5 * norm(cross(minus(*b, *a), minus(*c, *a)))).sum();
        all.insert(number, Seeded { nominal, area });
    }
    Ok(all)
}

/// The kind of region that a feature may have.
fn kind_of(class: Class) -> Option<Kind> {
    match class {
        Class::Plane => Some(Kind::Plane),
        Class::Cylinder => Some(Kind::Cylinder),
        Class::Cone => Some(Kind::Cone),
        Class::Sphere => Some(Kind::Sphere),
        Class::Point | Class::Line | Class::Circle | Class::Torus => None,
    }
}

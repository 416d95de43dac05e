//! Features that a plan names by a place on the reference: the region around it gives their nominal.

use super::own_faces::{Located, Model, OwnFaces, kind_of};
use super::stop::{NominalFault, Stop};
use crate::compare::far_seed;
use crate::plan::Plan;
use crate::plan::region::nominal_of;
use crate::requirement::Source;
use std::collections::BTreeMap;
use trueness_geom::closest::Tree;
use trueness_geom::mesh::Mesh;
use trueness_geom::partition::{Face, Faces, element};
use trueness_geom::progress::Progress;
use trueness_geom::segment;
use trueness_geom::space::{Point, cross, minus, norm};

/// The nominals of all features with a seed, by their numbers.
pub(super) fn seeded(
    plan: &Plan,
    reference: &Mesh,
    (faces, model): (&Faces, Option<&Model>),
    progress: &dyn Progress,
) -> Result<BTreeMap<usize, Located>, Stop> {
    let mut all = BTreeMap::new();
    if !plan.features.iter().any(|f| matches!(f.source, Source::Seed(_))) {
        return Ok(all);
    }
    let crease = segment::Options::default().crease;
    let tree =
        Tree::build_watched(reference, progress).map_err(|e| Stop::Nominal(NominalFault::Search(e)))?;
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
        let place = hit.and_then(|hit| faces.of_facets.get(hit.face as usize)).copied();
        let face = place.and_then(|place| faces.all.get(place as usize));
        let kind = kind_of(feature.class);
        // A narrow face may lie on elements of several kinds.
        let asked = |face: &Face| match face.shape.filter(|shape| Some(shape.kind()) == kind) {
            Some(shape) => Some(shape),
            None => element(reference, &face.facets, kind?, crease),
        };
        let Some((face, shape)) = face.and_then(|f| Some((f, asked(f)?))) else {
            let there = face.and_then(|f| f.shape).map(|shape| shape.kind().name());
            return Err(wrong(match there {
                Some(name) => {
                    format!("the reference has a {name} at the seed, not a {}", feature.class.word())
                }
                None => "there is no plane, cylinder, cone or sphere of the reference at the seed".into(),
            }));
        };
        let corners = |f: &u32| reference.faces[*f as usize].map(|v| reference.positions[v as usize]);
        let facets: Vec<[Point; 3]> = face.facets.iter().map(corners).collect();
        // The faces of a CAD model are known beyond their facets, where they are elements in the file.
        let members =
            model.zip(place).and_then(|(m, place)| Some((&m.faces, m.members.get(place as usize)?)));
        let exact = members.and_then(|(faces, own)| faces.nominal(own, kind?, reference).ok());
        let nominal = exact
            .or_else(|| nominal_of(&shape, &facets))
            .ok_or_else(|| wrong("the region at the seed has no facets".into()))?;
        let own = members.zip(place).map(|(_, place)| {
            let inward = face.inward();
            OwnFaces { faces: vec![place], inward, is_over: true, part: None }
        });
        let area = facets.iter().map(|[a, b, c]| 0.5 * norm(cross(minus(*b, *a), minus(*c, *a)))).sum();
        all.insert(number, Located { nominal, area, own });
    }
    Ok(all)
}

//! Features that are faces of a CAD model.

use super::own_faces::{Located, Model, OwnFaces, PartOfFaces, kind_of};
use super::stop::Stop;
use crate::area::mesh_area;
use crate::plan::Plan;
use crate::requirement::{Feature, Source};
use std::collections::BTreeMap;
use trueness_geom::closest::Tree;
use trueness_geom::mesh::Mesh;
use trueness_geom::partition::Faces;

/// The features that are named by faces, by their numbers.
pub(super) fn chosen(
    plan: &Plan,
    reference: &Mesh,
    (faces, model): (&Faces, Option<&Model>),
) -> Result<BTreeMap<usize, Located>, Stop> {
    let mut all = BTreeMap::new();
    for (number, feature) in plan.features.iter().enumerate() {
        let Source::Faces(choice) = &feature.source else { continue };
        let wrong = |what: String| Stop::Plan {
            span: choice.span.clone(),
            what: format!("feature \"{}\": {what}", feature.id),
        };
        let Some(model) = model else {
            let what = "the reference is a mesh, whose facets have no faces with numbers or names; give a CAD model (STEP), or a `seed` or \
                        `nominal`";
            return Err(wrong(what.into()));
        };
        let own = model.faces.chosen(&choice.value).map_err(|e| wrong(e.to_string()))?;
        let kind = kind_of(feature.class).ok_or_else(|| wrong("faces have no such shape".into()))?;
        let nominal = model.faces.nominal(&own, kind, reference).map_err(|e| wrong(e.to_string()))?;
        let inward = own.first().and_then(|face| model.faces.faces[*face as usize].inward);
        contradicted(feature, inward).map_err(wrong)?;
        let area = mesh_area(reference, &model.faces.facets(&own));
        let own = own_faces(model, reference, faces, own).map_err(wrong)?;
        let own = Some(OwnFaces { inward, ..own });
        all.insert(number, Located { nominal, area, own });
    }
    Ok(all)
}

/// Refuses a bore that the model has as a shaft, and a shaft that it has as a bore.
fn contradicted(feature: &Feature, inward: Option<bool>) -> Result<(), String> {
    match (feature.internal, inward) {
        (Some(internal), Some(inward)) if internal != inward => Err(format!(
            "`internal` is {internal}, but the material of the reference is {} the face there",
            if inward { "around" } else { "within" }
        )),
        _ => Ok(()),
    }
}

/// The faces of the partition that have some faces of the file.
fn own_faces(model: &Model, reference: &Mesh, faces: &Faces, own: Vec<u32>) -> Result<OwnFaces, String> {
    let has_some = |members: &Vec<u32>| members.iter().any(|m| own.binary_search(m).is_ok());
    let with_some: Vec<u32> =
        (0..).zip(&model.members).filter(|(_, m)| has_some(m)).map(|(n, _)| n).collect();
    let whole: usize = with_some.iter().map(|n| model.members[*n as usize].len()).sum();
    let part = match whole > own.len() {
        false => None,
        true => {
            let facets = with_some.iter().flat_map(|n| &faces.all[*n as usize].facets);
            let facets: Vec<u32> = facets.copied().collect();
            let is_own = |f: &u32| own.binary_search(&model.faces.drawn.of_facet[*f as usize]).is_ok();
            let is_own = facets.iter().map(is_own).collect();
            let corners = facets.iter().map(|f| reference.faces[*f as usize]).collect();
            let mesh = Mesh { positions: reference.positions.clone(), faces: corners };
            let tree = Tree::build(&mesh).map_err(|e| e.to_string())?;
            Some(PartOfFaces { faces: own, tree, is_own })
        }
    };
    Ok(OwnFaces { faces: with_some, inward: None, is_over: true, part })
}

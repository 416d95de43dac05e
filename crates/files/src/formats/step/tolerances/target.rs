//! What a tolerance is of: the faces that an aspect of the shape leads to.

use super::super::part21::Entity;
use super::graph::{Graph, list, told};
use std::collections::BTreeSet;
use trueness_cad::tolerances::Target;

/// Entities that stand for a face.
const FACE_KEYWORDS: [&str; 4] = ["ADVANCED_FACE", "FACE_SURFACE", "FACE", "ORIENTED_FACE"];
/// Entities whose first reference says what they are of.
const OWNING_KEYWORDS: [&str; 3] = ["DIMENSIONAL_SIZE", "DIMENSIONAL_SIZE_WITH_PATH", "ANGULAR_SIZE"];
/// The entity of the shape of a whole product.
const PRODUCT: &str = "PRODUCT_DEFINITION_SHAPE";
/// Aspects that are derived from others.
const DERIVED: [&str; 8] = [
    "CENTRE_OF_SYMMETRY",
    "APEX",
    "EXTENSION",
    "GEOMETRIC_ALIGNMENT",
    "GEOMETRIC_INTERSECTION",
    "PARALLEL_OFFSET",
    "PERPENDICULAR_TO",
    "TANGENT",
];

impl Graph<'_> {
    /// What an aspect, or the reference to something else that is toleranced, leads to.
    pub fn target(&self, number: u64) -> Target {
        let mut target = Target { entity: number, ..Target::default() };
        let (mut pending, mut seen) = (vec![number], BTreeSet::from([number]));
        let mut datums = vec![];
        while let Some(next) = pending.pop() {
            let entity = match self.file.entity(next) {
                Ok(entity) => entity,
                Err(wrong) => {
                    target.notes.push(wrong.to_string());
                    continue;
                }
            };
            if let Err(wrong) = self.budget.spend(1, &entity) {
                target.notes.push(wrong.to_string());
                break;
            }
            if next == number {
                target.name = entity.main(&["SHAPE_ASPECT"]).text(0);
            }
            self.items_of(&entity, &mut target);
            for record in entity.records() {
                if OWNING_KEYWORDS.contains(&record.keyword) {
                    pending.extend(record.reference(0).filter(|n| seen.insert(*n)));
                }
            }
            for related in list(&self.related, next) {
                match self.file.entity(*related) {
                    Ok(datum) if datum.record("DATUM").is_some() => datums.push(*related),
                    _ if seen.insert(*related) => pending.push(*related),
                    _ => {}
                }
            }
        }
        // Some programs tie the faces to the datum, not to its feature.
        if target.faces.is_empty() && target.others.is_empty() {
            for entity in datums.into_iter().filter_map(|n| self.file.entity(n).ok()) {
                self.items_of(&entity, &mut target);
            }
        }
        target.faces.sort_unstable();
        target.faces.dedup();
        target.others.sort();
        target.others.dedup();
        target
    }

    fn items_of(&self, entity: &Entity, target: &mut Target) {
        for record in entity.records() {
            let group = record.keyword.strip_suffix("_SHAPE_ASPECT");
            if let Some(word) = group.filter(|g| !g.starts_with("COMPOSITE")) {
                target.notes.push(told(word));
            } else if DERIVED.contains(&record.keyword) {
                target.notes.push(told(record.keyword));
            } else if record.keyword == PRODUCT {
                target.notes.push("whole part".into());
            }
        }
        let own = list(&self.items, entity.number());
        // A product shows its solids, and a dimension its numbers.
        let is_aspect =
            entity.records().all(|r| r.keyword != PRODUCT && !OWNING_KEYWORDS.contains(&r.keyword));
        let shown = if own.is_empty() && is_aspect { self.shown(entity.number()) } else { vec![] };
        for item in own.iter().chain(&shown) {
            let Ok(entity) = self.file.entity(*item) else {
                target.others.push((*item, "what is not in the file".into()));
                continue;
            };
            if self.budget.spend(1, &entity).is_err() {
                break;
            }
            let keyword = entity.main(&FACE_KEYWORDS).keyword;
            match FACE_KEYWORDS.contains(&keyword) {
                true => target.faces.push(*item),
                false => target.others.push((*item, keyword.to_string())),
            }
        }
    }
}

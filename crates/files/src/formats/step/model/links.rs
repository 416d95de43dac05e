//! Whether the links between products, their shapes and their places lead anywhere: what they lead to is lost without them.

use super::super::part21::{Entity, File, Value, Wrong};
use super::groups::TRANSFORMED;
use super::item::{Item, item};
use crate::formats::brep::MAX_TOLD;
use std::collections::BTreeSet;
use trueness_cad::model::Unread;

/// What links products, their shapes and their occurrences.
const LINKS: [&str; 7] = [
    "SHAPE_DEFINITION_REPRESENTATION",
    "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION",
    "PRODUCT_DEFINITION_SHAPE",
    "NEXT_ASSEMBLY_USAGE_OCCURRENCE",
    "SHAPE_REPRESENTATION_RELATIONSHIP",
    "REPRESENTATION_RELATIONSHIP",
    "REPRESENTATION_MAP",
];
/// Parameters of a link at most.
const MAX_LINKED: usize = 6;

/// Whether all that a link names is there.
pub(super) fn leads_on(file: &File, entity: &Entity) -> Result<(), Wrong> {
    for record in entity.records().filter(|r| LINKS.contains(&r.keyword)) {
        (0..MAX_LINKED).filter_map(|k| record.reference(k)).try_for_each(|n| file.entity(n).map(drop))?;
    }
    Ok(())
}

/// Whether an entity of a kind that is not known names shapes: it may be a part of the model.
pub(super) fn names_shapes(file: &File, entity: &Entity) -> bool {
    let is_shape = |value: &Value| {
        let Value::Reference(number) = value else { return false };
        let Ok(named) = file.entity(*number) else { return false };
        let shapes = [Item::Solid, Item::Replica, Item::Model, Item::Shell, Item::Face, Item::Mapped];
        named.record("REPRESENTATION_MAP").is_some() || shapes.contains(&item(&named))
    };
    entity.records().any(|record| {
        let values = record.values.iter();
        values.copied().any(|v| is_shape(&v) || record.items(v).is_some_and(|list| list.iter().any(is_shape)))
    })
}

/// Whether a file says of any shapes where they stand, or which belong to its products.
pub(super) fn places_shapes(file: &File) -> bool {
    let links = ["MAPPED_ITEM", TRANSFORMED, "SHAPE_DEFINITION_REPRESENTATION", "SOLID_REPLICA"];
    file.entities().any(|e| links.iter().any(|keyword| e.record(keyword).is_some()))
}

/// Faces of a file that no representation of a shape led to. Faces that aspects of shapes have for themselves are no part of the model.
pub(super) fn unreached(file: &File, reached: &BTreeSet<u64>, aspects: &BTreeSet<u64>) -> Vec<Unread> {
    let items = aspects.iter().filter_map(|number| {
        let aspect = file.entity(*number).ok()?;
        Some(aspect.main(&["REPRESENTATION"]).entities(1).ok()?.collect::<Vec<u64>>())
    });
    let apart: BTreeSet<u64> = items.flatten().collect();
    let keywords = ["ADVANCED_FACE", "FACE_SURFACE"];
    let is_face = |e: &Entity| e.records().any(|r| keywords.contains(&r.keyword));
    let lost = file
        .entities()
        .filter(|e| is_face(e) && !reached.contains(&e.number()) && !apart.contains(&e.number()));
    let told = |entity: Entity| {
        let wrong = entity.wrong("belongs to no shape of a product that can be read");
        Unread {
            entity: entity.number(),
            keyword: entity.main(&keywords).keyword.into(),
            reason: format!("line {}: {}", wrong.line, wrong.reason),
            holds_faces: true,
        }
    };
    lost.take(MAX_TOLD).map(told).collect()
}

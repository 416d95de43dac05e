//! The representations of a file: items in a context, and which of them are shapes of products.

use super::super::context::{Context, context};
use super::super::part21::{File, Record, Value, Wrong};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// A representation: items in a context.
pub(super) struct Representation {
    pub name: String,
    pub items: Vec<u64>,
    pub context: Result<Context, Wrong>,
}

/// The representations of a file's shapes. Those of `aspects` of shapes, such as targets of datums, are none.
pub(super) fn representations(file: &File, aspects: &BTreeSet<u64>) -> BTreeMap<u64, Representation> {
    let mut contexts: HashMap<u64, Result<Context, Wrong>> = HashMap::new();
    let mut all = BTreeMap::new();
    for entity in file.entities().filter(|e| !aspects.contains(&e.number())) {
        let is_shape =
            |r: &Record| r.keyword.ends_with("SHAPE_REPRESENTATION") && !r.keyword.contains("HISTORY");
        // Drawings have items of parts, mapped for a view of them.
        if !entity.records().any(|r| is_shape(&r)) || entity.record("DRAUGHTING_MODEL").is_some() {
            continue;
        }
        let record = entity.main(&["REPRESENTATION"]);
        let Ok(items) = record.list(1) else { continue };
        let context = match record.entity(2) {
            Ok(number) => contexts.entry(number).or_insert_with(|| context(file, number)).clone(),
            Err(wrong) => Err(wrong),
        };
        let items = items.iter().filter_map(reference).collect();
        all.insert(entity.number(), Representation { name: record.text(0), items, context });
    }
    all
}

fn reference(value: &Value) -> Option<u64> {
    match value {
        Value::Reference(n) => Some(*n),
        _ => None,
    }
}

/// What a shape or a property is of.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Owner {
    /// A product, by its definition.
    Product(u64),
    /// A part of a shape, or an occurrence.
    Aspect,
    /// What is damaged, or of a kind that is not known.
    Unknown,
}

/// Parts of keywords of what has shapes of its own beside products.
const ASPECTS: [&str; 10] = [
    "ASPECT",
    "DATUM",
    "DIMENSION",
    "TOLERANCE",
    "FEATURE",
    "OCCURRENCE",
    "VIEW",
    "SYMMETRY",
    "LOCATION",
    "SIZE",
];

/// What the shape or the property of this number is of.
pub(super) fn owner(file: &File, number: u64) -> Owner {
    let Ok(definition) = file.entity(number) else { return Owner::Unknown };
    let property = definition.main(&["PRODUCT_DEFINITION_SHAPE", "PROPERTY_DEFINITION"]);
    let has_index = definition.is_simple() || property.keyword == "PROPERTY_DEFINITION";
    let Some(target) = property.reference(2).filter(|_| has_index) else { return Owner::Unknown };
    let Ok(entity) = file.entity(target) else { return Owner::Unknown };
    if entity.main(&[]).keyword.starts_with("PRODUCT_DEFINITION") {
        return Owner::Product(target);
    }
    let is_aspect = entity.records().any(|r| ASPECTS.iter().any(|a| r.keyword.contains(a)));
    if is_aspect { Owner::Aspect } else { Owner::Unknown }
}

/// The representations of what is no product.
pub(super) fn aspects(file: &File) -> BTreeSet<u64> {
    let mut all = BTreeSet::new();
    for entity in file.entities() {
        for record in entity.records().filter(|r| r.keyword.ends_with("DEFINITION_REPRESENTATION")) {
            if let (Some(definition), Some(used)) = (record.reference(0), record.reference(1))
                && owner(file, definition) == Owner::Aspect
            {
                all.insert(used);
            }
        }
    }
    all
}

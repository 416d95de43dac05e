//! What points at what: entities that relate tolerances, aspects of the shape, their items and their numbers.

use super::super::part21::{Entity, File, Record, Value};
use crate::formats::brep::Budget;
use std::collections::HashMap;

/// Numbers of entities by the number of the one that they belong to, in the order of the file.
type Lists = HashMap<u64, Vec<u64>>;

/// The relations of a file.
pub(super) struct Graph<'f> {
    pub file: &'f File<'f>,
    pub budget: &'f Budget,
    /// Items of aspects: faces, edges.
    pub items: Lists,
    /// What aspects are related to: the parts of a whole, the datum of a feature.
    pub related: Lists,
    /// The same, from those to the aspects.
    pub relating: Lists,
    /// Representations of aspects and of dimensions.
    pub representations: Lists,
    /// Ranges of dimensions.
    pub ranges: Lists,
    /// Zones of tolerances.
    pub zones: Lists,
    /// Definitions of zones: projected, not uniform.
    pub definitions: Lists,
    /// Relationships of tolerances, such as composite ones.
    pub tiers: Lists,
}

impl<'f> Graph<'f> {
    /// The relations of a file.
    pub fn of(file: &'f File<'f>, budget: &'f Budget) -> Graph<'f> {
        let mut graph = Graph {
            file,
            budget,
            items: Lists::new(),
            related: Lists::new(),
            relating: Lists::new(),
            representations: Lists::new(),
            ranges: Lists::new(),
            zones: Lists::new(),
            definitions: Lists::new(),
            tiers: Lists::new(),
        };
        let mut properties = vec![];
        for entity in file.entities() {
            // A dimension is a relation of its own kind.
            let is_dimension = entity.records().any(|r| r.keyword.ends_with("_LOCATION"));
            for record in entity.records().filter(|_| !is_dimension) {
                graph.add(&entity, &record, &mut properties);
            }
        }
        // What a property is of has the representations of the property.
        for (property, definition) in properties {
            let own = graph.representations.get(&property).cloned().unwrap_or_default();
            graph.representations.entry(definition).or_default().extend(own);
        }
        graph
    }

    fn add(&mut self, entity: &Entity, record: &Record, properties: &mut Vec<(u64, u64)>) {
        let pair = |a: usize, b: usize| Some((record.reference(a)?, record.reference(b)?));
        match record.keyword {
            "GEOMETRIC_ITEM_SPECIFIC_USAGE" | "ITEM_IDENTIFIED_REPRESENTATION_USAGE" => {
                if let (Some(aspect), Some(value)) = (record.reference(2), record.values.get(4)) {
                    self.items.entry(aspect).or_default().extend(references(record, *value));
                }
            }
            "SHAPE_ASPECT_RELATIONSHIP"
            | "SHAPE_ASPECT_DERIVING_RELATIONSHIP"
            | "FEATURE_FOR_DATUM_TARGET_RELATIONSHIP" => {
                if let Some((relating, related)) = pair(2, 3) {
                    self.related.entry(relating).or_default().push(related);
                    self.relating.entry(related).or_default().push(relating);
                }
            }
            "PROPERTY_DEFINITION" => {
                if let Some(definition) = record.reference(2) {
                    properties.push((entity.number(), definition));
                }
            }
            "SHAPE_DEFINITION_REPRESENTATION"
            | "PROPERTY_DEFINITION_REPRESENTATION"
            | "DIMENSIONAL_CHARACTERISTIC_REPRESENTATION" => {
                if let Some((owner, representation)) = pair(0, 1) {
                    self.representations.entry(owner).or_default().push(representation);
                }
            }
            "PLUS_MINUS_TOLERANCE" => {
                if let Some((range, dimension)) = pair(0, 1) {
                    self.ranges.entry(dimension).or_default().push(range);
                }
            }
            "GEOMETRIC_TOLERANCE_RELATIONSHIP" => {
                for tolerance in pair(2, 3).into_iter().flat_map(|(a, b)| [a, b]) {
                    self.tiers.entry(tolerance).or_default().push(entity.number());
                }
            }
            "TOLERANCE_ZONE" => {
                let tolerances = record.values.iter().flat_map(|v| match v {
                    Value::List(_) => references(record, *v),
                    _ => vec![],
                });
                for tolerance in tolerances.collect::<Vec<u64>>() {
                    self.zones.entry(tolerance).or_default().push(entity.number());
                }
            }
            keyword if keyword.ends_with("_ZONE_DEFINITION") => {
                if let Some(zone) = record.reference(0) {
                    self.definitions.entry(zone).or_default().push(entity.number());
                }
            }
            _ => {}
        }
    }

    /// Items of the representations that something has.
    pub fn shown(&self, owner: u64) -> Vec<u64> {
        let all = list(&self.representations, owner).iter();
        let items = all.filter_map(|n| {
            let entity = self.file.entity(*n).ok()?;
            // Of a complex instance the record has name, items and context as well.
            Some(entity.main(&["REPRESENTATION"]).entities(1).ok()?.collect::<Vec<u64>>())
        });
        items.flatten().collect()
    }
}

/// What belongs to an entity.
pub(super) fn list(lists: &Lists, owner: u64) -> &[u64] {
    lists.get(&owner).map_or(&[], Vec::as_slice)
}

/// All references within a value, however deep in lists.
pub(super) fn references<'f>(record: &Record<'f>, value: Value<'f>) -> Vec<u64> {
    let (mut found, mut pending) = (vec![], vec![value]);
    while let Some(value) = pending.pop() {
        match value {
            Value::Reference(number) => found.push(number),
            value => pending.extend(record.items(value).unwrap_or_default().iter().rev()),
        }
    }
    found
}

/// A word of the file as it is told: in lower case, without underscores.
pub(super) fn told(word: &str) -> String {
    word.to_ascii_lowercase().replace('_', " ")
}

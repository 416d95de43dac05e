//! Products and representations that share their coordinates.

use super::super::part21::{Entity, File};
use super::representation::{Owner, Representation, owner};
use std::collections::BTreeMap;

/// The record of a relationship that has a transformation.
pub(super) const TRANSFORMED: &str = "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION";
/// Relationships of representations without one.
const WITHOUT_TRANSFORMATION: [&str; 2] =
    ["SHAPE_REPRESENTATION_RELATIONSHIP", "REPRESENTATION_RELATIONSHIP"];

/// Numbers that belong together.
#[derive(Default)]
pub(super) struct Groups {
    index_of: BTreeMap<u64, usize>,
    parents: Vec<usize>,
}

impl Groups {
    /// Those of a file: a product and its representation, two representations.
    pub fn of(file: &File, representations: &BTreeMap<u64, Representation>) -> Groups {
        let mut groups = Groups::default();
        for number in representations.keys() {
            groups.index(*number);
        }
        for entity in file.entities() {
            groups.add(file, &entity, representations);
        }
        groups
    }

    /// Joins what an entity says to share its coordinates.
    fn add(&mut self, file: &File, entity: &Entity, representations: &BTreeMap<u64, Representation>) {
        for record in entity.records() {
            match record.keyword {
                "SHAPE_DEFINITION_REPRESENTATION" => {
                    let product = record.reference(0).map(|d| owner(file, d));
                    if let (Some(Owner::Product(product)), Some(used)) = (product, record.reference(1))
                        && representations.contains_key(&used)
                    {
                        self.join(product, used);
                    }
                }
                "NEXT_ASSEMBLY_USAGE_OCCURRENCE" => {
                    for product in [3, 4].into_iter().filter_map(|k| record.reference(k)) {
                        self.index(product);
                    }
                }
                keyword if WITHOUT_TRANSFORMATION.contains(&keyword) && is_plain(entity) => {
                    if let (Some(a), Some(b)) = (record.reference(2), record.reference(3))
                        && [a, b].iter().all(|r| representations.contains_key(r))
                    {
                        self.join(a, b);
                    }
                }
                _ => {}
            }
        }
    }

    fn index(&mut self, number: u64) -> usize {
        let next = self.parents.len();
        let index = *self.index_of.entry(number).or_insert(next);
        if index == next {
            self.parents.push(next);
        }
        index
    }

    fn root(&mut self, mut index: usize) -> usize {
        while self.parents[index] != index {
            self.parents[index] = self.parents[self.parents[index]];
            index = self.parents[index];
        }
        index
    }

    fn join(&mut self, a: u64, b: u64) {
        let [a, b] = [a, b].map(|n| self.index(n));
        let [a, b] = [self.root(a), self.root(b)];
        self.parents[a.max(b)] = a.min(b);
    }

    /// All numbers in their order, each with the root of its group.
    pub fn members(mut self) -> Vec<(u64, usize)> {
        let all: Vec<(u64, usize)> = self.index_of.iter().map(|(number, index)| (*number, *index)).collect();
        all.into_iter().map(|(number, index)| (number, self.root(index))).collect()
    }
}

/// Whether a relationship says no more than that two representations share their coordinates. What a record that is not known says of
/// them may move one of them.
pub(super) fn is_plain(entity: &Entity) -> bool {
    entity.records().all(|r| WITHOUT_TRANSFORMATION.contains(&r.keyword))
}

//! Which representations make up a part, and where parts stand.
//!
//! A node stands for a product and all representations that share its coordinates. A node is placed in another one by an occurrence
//! of its product, by a relationship of representations with a transformation, or as a mapped item.

use super::super::context::{Context, context};
use super::super::part21::{Entity, File, Record, Value, Wrong};
use super::placement::{Units, frame, operator, target};
use super::shape::{Item, item};
use crate::formats::brep::tree::{self, Child};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use trueness_cad::frame::Placement;
use trueness_cad::model::Unread;

/// A part or an assembly.
#[derive(Default)]
pub(super) struct Node {
    /// Its name, and what stands in it.
    pub tree: tree::Node,
    /// Whether it is the shape of a product, not only a representation.
    pub is_product: bool,
    /// In the order of their numbers.
    pub representations: Vec<u64>,
    /// Whether it has mapped items.
    maps: bool,
}

/// A representation: items in a context.
pub(super) struct Representation {
    pub name: String,
    pub items: Vec<u64>,
    pub context: Result<Context, Wrong>,
}

/// All nodes of a file.
pub(super) struct Assembly<'f> {
    file: &'f File<'f>,
    fallback: Units,
    pub representations: BTreeMap<u64, Representation>,
    /// Of representations and of definitions of products.
    node_of: HashMap<u64, usize>,
    pub nodes: Vec<Node>,
    pub unread: Vec<Unread>,
}

/// The representations of a file's shapes. Those of aspects of shapes, such as targets of datums, are none.
pub(super) fn representations(file: &File) -> BTreeMap<u64, Representation> {
    let mut contexts: HashMap<u64, Result<Context, Wrong>> = HashMap::new();
    let aspects = aspects(file);
    let mut all = BTreeMap::new();
    for entity in file.entities().filter(|e| !aspects.contains(&e.number())) {
        let is_shape =
            |r: &Record| r.keyword.ends_with("SHAPE_REPRESENTATION") && !r.keyword.contains("HISTORY");
        // Drawings have items of parts, mapped for a view of them.
        if !entity.records().any(|r| is_shape(&r)) || entity.record("DRAUGHTING_MODEL").is_some() {
            continue;
        }
        let record = entity.main(&["REPRESENTATION"]);
        let (Ok(items), Ok(number)) = (record.list(1), record.entity(2)) else { continue };
        let items = items.iter().filter_map(|v| match v {
            Value::Reference(n) => Some(*n),
            _ => None,
        });
        let items: Vec<u64> = items.collect();
        let context = contexts.entry(number).or_insert_with(|| context(file, number)).clone();
        all.insert(entity.number(), Representation { name: record.text(0), items, context });
    }
    all
}

/// The representations that define something other than a product.
fn aspects(file: &File) -> BTreeSet<u64> {
    let mut all = BTreeSet::new();
    for entity in file.entities() {
        for record in entity.records().filter(|r| r.keyword.ends_with("DEFINITION_REPRESENTATION")) {
            if let (Some(definition), Some(used)) = (record.reference(0), record.reference(1))
                && product_of(file, definition).is_none()
            {
                all.insert(used);
            }
        }
    }
    all
}

/// The definition of the product that a shape or a property is of.
fn product_of(file: &File, number: u64) -> Option<u64> {
    let definition = file.entity(number).ok()?;
    let property = definition.main(&["PRODUCT_DEFINITION_SHAPE", "PROPERTY_DEFINITION"]);
    let index =
        if definition.is_simple() || property.keyword == "PROPERTY_DEFINITION" { 2 } else { return None };
    let product = property.reference(index)?;
    let keyword = file.entity(product).ok()?.main(&[]).keyword;
    keyword.starts_with("PRODUCT_DEFINITION").then_some(product)
}

impl<'f> Assembly<'f> {
    /// The nodes of a file and how they stand in one another.
    pub fn of(
        file: &'f File<'f>,
        representations: BTreeMap<u64, Representation>,
        fallback: Units,
    ) -> Assembly<'f> {
        let mut groups = Groups::default();
        for number in representations.keys() {
            groups.index(*number);
        }
        for entity in file.entities() {
            join(file, &entity, &representations, &mut groups);
        }
        let mut assembly = Assembly {
            file,
            fallback,
            representations,
            node_of: HashMap::new(),
            nodes: vec![],
            unread: vec![],
        };
        assembly.make_nodes(groups);
        assembly.place_occurrences();
        assembly.place_mapped();
        assembly
    }

    fn make_nodes(&mut self, groups: Groups) {
        let mut node_of_root: HashMap<usize, usize> = HashMap::new();
        for (number, root) in groups.members() {
            let count = self.nodes.len();
            let node = *node_of_root.entry(root).or_insert(count);
            if node == count {
                self.nodes.push(Node::default());
            }
            self.node_of.insert(number, node);
            let node = &mut self.nodes[node];
            if self.representations.contains_key(&number) {
                node.representations.push(number);
                let items = &self.representations[&number].items;
                node.maps |=
                    items.iter().any(|n| self.file.entity(*n).is_ok_and(|e| item(&e) == Item::Mapped));
            } else {
                node.is_product = true;
                if node.tree.name.is_empty() {
                    node.tree.name = product_name(self.file, number).unwrap_or_default();
                }
            }
        }
        for node in &mut self.nodes {
            if node.tree.name.is_empty() {
                let names = node.representations.iter().filter_map(|r| self.representations.get(r));
                node.tree.name = names.map(|r| r.name.clone()).find(|n| !n.is_empty()).unwrap_or_default();
            }
        }
    }

    /// The units of a representation.
    pub fn units(&self, number: u64) -> Units {
        let context = self.representations.get(&number).and_then(|r| r.context.as_ref().ok());
        let (length, angle) = context.map_or((None, None), |c| (c.length, c.angle));
        Units { length: length.unwrap_or(self.fallback.length), angle: angle.unwrap_or(self.fallback.angle) }
    }

    fn tell(&mut self, entity: &Entity, wrong: &Wrong) {
        self.unread.push(Unread {
            entity: entity.number(),
            keyword: entity.main(&[]).keyword.into(),
            reason: wrong.to_string(),
            holds_faces: true,
        });
    }

    /// Occurrences of products, and relationships of representations that place one in another.
    fn place_occurrences(&mut self) {
        let file = self.file;
        let (mut relation_of, mut used) = (HashMap::new(), BTreeSet::new());
        for record in file.entities().filter_map(|e| e.record("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION")) {
            let (Some(relation), Some(shape)) = (record.reference(0), record.reference(1)) else { continue };
            let occurrence = file.entity(shape).ok().and_then(|s| s.main(&[]).reference(2));
            if let Some(occurrence) = occurrence {
                relation_of.insert(occurrence, relation);
                used.insert(relation);
            }
        }
        for entity in file.entities() {
            let placed = if let Err(wrong) = self.leads_on(&entity) {
                Err(wrong)
            } else if let Some(record) = entity.record("NEXT_ASSEMBLY_USAGE_OCCURRENCE") {
                let relation = relation_of.get(&entity.number()).copied();
                self.occurrence(&entity, &record, relation)
            } else if entity.record(TRANSFORMED).is_some() && !used.contains(&entity.number()) {
                self.related(&entity, None)
            } else {
                Ok(())
            };
            if let Err(wrong) = placed {
                self.tell(&entity, &wrong);
            }
        }
    }

    /// Whether all that a link between products and their shapes names is there: without one, parts are lost.
    fn leads_on(&self, entity: &Entity) -> Result<(), Wrong> {
        for record in entity.records().filter(|r| LINKS.contains(&r.keyword)) {
            (0..MAX_LINKED)
                .filter_map(|k| record.reference(k))
                .try_for_each(|n| self.file.entity(n).map(drop))?;
        }
        Ok(())
    }

    fn occurrence(&mut self, entity: &Entity, record: &Record, relation: Option<u64>) -> Result<(), Wrong> {
        let (parent, child) = (record.entity(3)?, record.entity(4)?);
        let nodes = [parent, child].map(|n| self.node_of.get(&n).copied());
        if let Some(relation) = relation {
            // Its relationship places a representation that no product has.
            if nodes[1].is_some_and(|child| !self.has_shape(child)) {
                return Err(record.wrong("places a product without a shape"));
            }
            let relation = self.file.entity(relation)?;
            let name = [1, 2, 0].map(|k| record.text(k)).into_iter().find(|n| !n.is_empty());
            return self.related(&relation, Some((nodes, name.unwrap_or_default(), entity.number())));
        }
        match nodes {
            // Mapped items place those without a transformation of their own; one part may also be all of its assembly.
            [Some(parent), Some(child)]
                if parent != child && self.has_shape(child) && !self.nodes[parent].maps =>
            {
                Err(record.wrong("says of no place where its part stands"))
            }
            _ => Ok(()),
        }
    }

    fn has_shape(&self, node: usize) -> bool {
        self.nodes.get(node).is_some_and(|n| !n.representations.is_empty())
    }

    /// Places the first representation of a relationship in the second; the other way around where their products say so.
    fn related(
        &mut self,
        entity: &Entity,
        occurrence: Option<([Option<usize>; 2], String, u64)>,
    ) -> Result<(), Wrong> {
        let main = entity.main(&["REPRESENTATION_RELATIONSHIP"]);
        let pair = [main.entity(2)?, main.entity(3)?];
        let [first, second] = pair.map(|r| self.node_of.get(&r).copied());
        let (Some(first), Some(second)) = (first, second) else {
            return Err(main.wrong("relates representations that are not there"));
        };
        let Some(transformed) = entity.record(TRANSFORMED) else { return Ok(()) };
        let (nodes, name, by) = occurrence.unwrap_or(([None; 2], main.text(0), entity.number()));
        let turned = nodes[1] == Some(second) && nodes[1] != Some(first);
        let child = if turned { second } else { first };
        let parent = nodes[0].unwrap_or(if turned { first } else { second });
        let placement = self.transformation(transformed.entity(0)?, pair, turned)?;
        let name = if name.is_empty() { self.nodes[child].tree.name.clone() } else { name };
        let styled = entity.number();
        self.nodes[parent].tree.children.push(Child {
            node: child,
            name,
            placement,
            entity: by,
            styled,
            is_cut: false,
        });
        Ok(())
    }

    /// What brings one of a pair of representations into the other one. The items of a transformation stand in the order of the
    /// representations, also where these are turned.
    fn transformation(&self, number: u64, pair: [u64; 2], turned: bool) -> Result<Placement, Wrong> {
        let entity = self.file.entity(number)?;
        let [first, second] = pair.map(|r| self.units(r));
        let Some(record) = entity.record("ITEM_DEFINED_TRANSFORMATION") else {
            return operator(self.file, if turned { first } else { second }, number);
        };
        let from = frame(self.file, first, record.entity(2)?)?;
        let to = frame(self.file, second, record.entity(3)?)?;
        Ok(if turned { Placement::between(&to, &from) } else { Placement::between(&from, &to) })
    }

    /// Items that are other representations, placed.
    fn place_mapped(&mut self) {
        let pairs: Vec<(u64, u64)> =
            self.representations.iter().flat_map(|(n, r)| r.items.iter().map(|i| (*n, *i))).collect();
        for (owner, number) in pairs {
            let Ok(entity) = self.file.entity(number) else { continue };
            if item(&entity) != Item::Mapped {
                continue;
            }
            if let Err(wrong) = self.mapped(owner, &entity) {
                self.tell(&entity, &wrong);
            }
        }
    }

    fn mapped(&mut self, owner: u64, entity: &Entity) -> Result<(), Wrong> {
        let record = entity.main(&["MAPPED_ITEM"]);
        let first = usize::from(entity.is_simple());
        let map = self.file.entity(record.entity(first)?)?;
        let map = map.main(&["REPRESENTATION_MAP"]);
        let mapped = map.entity(1)?;
        let (Some(parent), Some(child)) =
            (self.node_of.get(&owner).copied(), self.node_of.get(&mapped).copied())
        else {
            return Err(map.wrong("maps a representation that is not there"));
        };
        let from = frame(self.file, self.units(mapped), map.entity(0)?)?;
        let placement = target(self.file, self.units(owner), record.entity(first + 1)?, &from)?;
        let name = Some(record.text(0)).filter(|n| first == 1 && !n.is_empty());
        let name = name.unwrap_or_else(|| self.nodes[child].tree.name.clone());
        let (entity, styled) = (entity.number(), entity.number());
        self.nodes[parent].tree.children.push(Child {
            node: child,
            name,
            placement,
            entity,
            styled,
            is_cut: false,
        });
        Ok(())
    }
}

/// What links products, their shapes and their occurrences.
const LINKS: [&str; 4] = [
    "SHAPE_DEFINITION_REPRESENTATION",
    "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION",
    "PRODUCT_DEFINITION_SHAPE",
    "NEXT_ASSEMBLY_USAGE_OCCURRENCE",
];
/// Parameters of a link at most.
const MAX_LINKED: usize = 6;
/// The record of a relationship that has a transformation.
const TRANSFORMED: &str = "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION";

/// Joins what an entity says to share its coordinates: a product and its representation, two representations.
fn join(file: &File, entity: &Entity, representations: &BTreeMap<u64, Representation>, groups: &mut Groups) {
    for record in entity.records() {
        match record.keyword {
            "SHAPE_DEFINITION_REPRESENTATION" => {
                let product = record.reference(0).and_then(|d| product_of(file, d));
                if let (Some(product), Some(used)) = (product, record.reference(1))
                    && representations.contains_key(&used)
                {
                    groups.join(product, used);
                }
            }
            "NEXT_ASSEMBLY_USAGE_OCCURRENCE" => {
                for product in [3, 4].into_iter().filter_map(|k| record.reference(k)) {
                    groups.index(product);
                }
            }
            "SHAPE_REPRESENTATION_RELATIONSHIP" | "REPRESENTATION_RELATIONSHIP"
                if entity.record(TRANSFORMED).is_none() =>
            {
                if let (Some(a), Some(b)) = (record.reference(2), record.reference(3))
                    && [a, b].iter().all(|r| representations.contains_key(r))
                {
                    groups.join(a, b);
                }
            }
            _ => {}
        }
    }
}

/// The name of the product of a definition.
fn product_name(file: &File, definition: u64) -> Option<String> {
    let formation = file.entity(definition).ok()?.main(&["PRODUCT_DEFINITION"]).reference(2)?;
    let product = file.entity(formation).ok()?.main(&["PRODUCT_DEFINITION_FORMATION"]).reference(2)?;
    let product = file.entity(product).ok()?.main(&["PRODUCT"]);
    [1, 0].map(|k| product.text(k)).into_iter().find(|n| !n.is_empty())
}

/// Numbers that belong together.
#[derive(Default)]
struct Groups {
    index_of: BTreeMap<u64, usize>,
    parents: Vec<usize>,
}

impl Groups {
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
    fn members(mut self) -> Vec<(u64, usize)> {
        let all: Vec<(u64, usize)> = self.index_of.iter().map(|(number, index)| (*number, *index)).collect();
        all.into_iter().map(|(number, index)| (number, self.root(index))).collect()
    }
}

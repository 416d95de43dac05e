//! Which representations make up a part, and where parts stand.
//!
//! A node stands for a product and all representations that share its coordinates. A node is placed in another one by an occurrence
//! of its product, by a relationship of representations with a transformation, or as a mapped item.

use super::super::part21::{Entity, File, Record, Wrong};
use super::groups::{Groups, TRANSFORMED, is_plain};
use super::item::{Item, item};
use super::links::leads_on;
use super::placement::{Units, frame, operator, target};
use super::representation::Representation;
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

impl<'f> Assembly<'f> {
    /// The nodes of a file and how they stand in one another.
    pub fn of(
        file: &'f File<'f>,
        representations: BTreeMap<u64, Representation>,
        fallback: Units,
    ) -> Assembly<'f> {
        let groups = Groups::of(file, &representations);
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
        for entity in file.entities() {
            match occurrence_with_place(file, &entity) {
                Ok(None) => {}
                Ok(Some((occurrence, relation))) => {
                    relation_of.insert(occurrence, relation);
                    used.insert(relation);
                }
                Err(wrong) => self.tell(&entity, &wrong),
            }
        }
        for entity in file.entities() {
            let placed = if let Err(wrong) = leads_on(file, &entity) {
                Err(wrong)
            } else if let Some(record) = entity.record("NEXT_ASSEMBLY_USAGE_OCCURRENCE") {
                let relation = relation_of.get(&entity.number()).copied();
                self.occurrence(&entity, &record, relation)
            } else if self.moves(&entity) && !used.contains(&entity.number()) {
                self.related(&entity, None)
            } else {
                Ok(())
            };
            if let Err(wrong) = placed {
                self.tell(&entity, &wrong);
            }
        }
    }

    /// Whether an entity relates two shapes and may move one of them.
    fn moves(&self, entity: &Entity) -> bool {
        let main = entity.main(&["REPRESENTATION_RELATIONSHIP"]);
        let is_node = |k: usize| main.reference(k).is_some_and(|n| self.representations.contains_key(&n));
        entity.record(TRANSFORMED).is_some()
            || main.keyword == "REPRESENTATION_RELATIONSHIP" && !is_plain(entity) && is_node(2) && is_node(3)
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
        let Some(transformed) = entity.record(TRANSFORMED) else {
            // Shapes that share their coordinates are one node.
            let wrong = || main.wrong("does not say in a way that is known where its part stands");
            return if first == second { Ok(()) } else { Err(wrong()) };
        };
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

/// The occurrence that an entity gives a place, and the relationship that says which.
fn occurrence_with_place(file: &File, entity: &Entity) -> Result<Option<(u64, u64)>, Wrong> {
    let Some(record) = entity.record("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION") else { return Ok(None) };
    let (relation, shape) = (record.entity(0)?, record.entity(1)?);
    // What is missing is told where links are followed.
    let Ok(shape) = file.entity(shape) else { return Ok(None) };
    let occurrence = shape.main(&[]).entity(2)?;
    let Ok(target) = file.entity(occurrence) else { return Ok(None) };
    match target.record("NEXT_ASSEMBLY_USAGE_OCCURRENCE") {
        Some(_) => Ok(Some((occurrence, relation))),
        None => Err(record.wrong(format!(
            "gives a place to what is no NEXT_ASSEMBLY_USAGE_OCCURRENCE but {}",
            target.main(&[]).keyword
        ))),
    }
}

/// The name of the product of a definition.
fn product_name(file: &File, definition: u64) -> Option<String> {
    let formation = file.entity(definition).ok()?.main(&["PRODUCT_DEFINITION"]).reference(2)?;
    let product = file.entity(formation).ok()?.main(&["PRODUCT_DEFINITION_FORMATION"]).reference(2)?;
    let product = file.entity(product).ok()?.main(&["PRODUCT"]);
    [1, 0].map(|k| product.text(k)).into_iter().find(|n| !n.is_empty())
}

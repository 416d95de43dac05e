//! Which shapes a part has, and where subfigures stand.
//!
//! What no other entity uses stands by itself: it belongs to the root. A subfigure (308, 320) is a part whose instances (408, 420) stand in the root or in
//! other subfigures.

use super::super::record::Record;
use super::super::text::{Entity, File};
use super::curve::CURVE_KINDS;
use super::geometry::Geometry;
use super::kinds::name;
use super::surface::SURFACE_KINDS;
use crate::formats::brep::Wrong;
use crate::formats::brep::tree::{Child, Node};
use std::collections::{BTreeMap, BTreeSet};
use trueness_cad::frame::Placement;
use trueness_cad::model::Unread;

/// The parts of a file: the root first. For each node the entities that are its shapes, and the number of its curves.
#[derive(Default)]
pub(super) struct Assembly {
    pub nodes: Vec<Node>,
    /// The subfigure that a node is; 0 for the root.
    definitions: Vec<u64>,
    pub shapes: Vec<Vec<u64>>,
    pub wires: Vec<u64>,
    pub unread: Vec<Unread>,
}

/// Shapes with faces that stand by themselves, whether they are read or only told.
fn is_shape(kind: u64) -> bool {
    matches!(kind, 143 | 144 | 186 | 510 | 514 | 150..=184) || SURFACE_KINDS.contains(&kind)
}

fn is_instance(kind: u64) -> bool {
    matches!(kind, 408 | 420)
}

/// Switches of the status of an entity: what it depends on, and what it is used for.
const PHYSICALLY_DEPENDENT: u8 = 1;
const ANNOTATION: u8 = 1;
const IN_PARAMETERS: u8 = 5;
const CONSTRUCTION: u8 = 6;

impl Assembly {
    /// The nodes of a file and how they stand in one another; `root` is the name of the first.
    pub fn of(geometry: &Geometry, root: String) -> Assembly {
        let file = geometry.file;
        let used: BTreeSet<u64> = file.entities.values().flat_map(|e| uses(file, e)).collect();
        let members: Vec<u64> = file.entities.keys().copied().filter(|n| !used.contains(n)).collect();
        let mut all = Assembly::default();
        let mut known = BTreeMap::new();
        all.node(root, 0);
        all.add(geometry, 0, &members, &mut known);
        // Subfigures, each once, as instances lead to them.
        let mut node = 1;
        while let Some(number) = all.definitions.get(node).copied() {
            match file.record(number).and_then(|record| listed(&record, 2)) {
                Ok(members) => all.add(geometry, node, &members, &mut known),
                Err(wrong) => all.tell(file, number, &wrong, true),
            }
            node += 1;
        }
        for entity in file.entities.values().filter(|e| matches!(e.kind, 308 | 320)) {
            if !known.contains_key(&entity.number) {
                all.tell(file, entity.number, &entity.wrong("is placed nowhere"), false);
            }
        }
        all
    }

    /// Adds a node; its number.
    fn node(&mut self, name: String, definition: u64) -> usize {
        self.nodes.push(Node { name, children: vec![] });
        self.definitions.push(definition);
        self.shapes.push(vec![]);
        self.wires.push(0);
        self.nodes.len() - 1
    }

    fn tell(&mut self, file: &File, number: u64, wrong: &Wrong, holds_faces: bool) {
        let keyword = file.entities.get(&number).map_or_else(String::new, |e| name(e.kind));
        self.unread.push(Unread { entity: number, keyword, reason: wrong.to_string(), holds_faces });
    }

    fn add(&mut self, geometry: &Geometry, node: usize, members: &[u64], known: &mut BTreeMap<u64, usize>) {
        let file = geometry.file;
        for number in members {
            let Some(entity) = file.entities.get(number) else {
                let wrong = Wrong { entity: *number, line: 0, reason: "is not in the file".into() };
                self.tell(file, *number, &wrong, true);
                continue;
            };
            let dependent = node == 0 && entity.status[1] & PHYSICALLY_DEPENDENT != 0;
            let aside = matches!(entity.status[2], ANNOTATION | IN_PARAMETERS | CONSTRUCTION);
            match entity.kind {
                kind if is_instance(kind) => match self.instance(geometry, entity, known) {
                    Ok(child) => self.nodes[node].children.push(child),
                    Err(wrong) => self.tell(file, *number, &wrong, true),
                },
                412 | 414 | 430 => {
                    self.tell(file, *number, &entity.wrong("repeats shapes in a way that is not read"), true);
                }
                // A surface that belongs to another entity is part of what that one is.
                kind if SURFACE_KINDS.contains(&kind) && (dependent || aside) => {}
                kind if is_shape(kind) => self.shapes[node].push(*number),
                kind if CURVE_KINDS.contains(&kind) && !dependent && !aside => self.wires[node] += 1,
                _ => {}
            }
        }
    }

    /// A subfigure where an instance places it: scaled, moved, then placed by the matrix of the instance.
    fn instance(
        &mut self,
        geometry: &Geometry,
        entity: &Entity,
        known: &mut BTreeMap<u64, usize>,
    ) -> Result<Child, Wrong> {
        let record = geometry.file.record(entity.number)?;
        let definition = geometry.file.record(record.pointer(0)?)?;
        if !matches!(definition.entity.kind, 308 | 320) {
            return Err(record.wrong("is an instance of what is no subfigure"));
        }
        let scale = |k: usize| if record.is_absent(k) { Ok(1.0) } else { record.real(k) };
        let own = scale(4)?;
        let even =
            entity.kind == 408 || [5, 6].iter().all(|k| record.is_absent(*k) || record.real(*k) == Ok(own));
        if own <= 0.0 || !even {
            return Err(
                record.wrong("scales by a number that is not above 0, or not alike in all directions")
            );
        }
        let moved = Placement { scale: own, shift: geometry.place(&record, 1)?, ..Placement::IDENTITY };
        let placement = geometry.placed(&record)?.after(&moved);
        let number = definition.entity.number;
        let node = match known.get(&number) {
            Some(node) => *node,
            None => self.node(definition.text(1), number),
        };
        known.insert(number, node);
        let name = self.nodes[node].name.clone();
        Ok(Child { node, name, placement, entity: entity.number, styled: entity.number, is_cut: false })
    }
}

/// Entities in a list: how many stand at `k`, they follow.
fn listed(record: &Record, k: usize) -> Result<Vec<u64>, Wrong> {
    (1..=record.count(k)?).map(|i| record.pointer(k + i)).collect()
}

/// The entities that an entity is made of. Groups (402) only name what stands by itself.
fn uses(file: &File, entity: &Entity) -> Vec<u64> {
    let Ok(record) = file.record(entity.number) else { return vec![] };
    let at = |places: &[usize]| places.iter().filter_map(|k| record.pointer(*k).ok()).collect::<Vec<u64>>();
    let every = |first: usize, step: usize| {
        (first..record.len()).step_by(step).filter_map(|k| record.pointer(k).ok()).collect()
    };
    match entity.kind {
        102 => listed(&record, 0).unwrap_or_default(),
        108 if entity.form != 0 => at(&[4]),
        118 | 120 => at(&[0, 1]),
        122 | 130 => at(&[0]),
        140 => at(&[4]),
        141 => {
            let mut all = at(&[2]);
            let (count, mut k) = (record.count(3).unwrap_or_default(), 4);
            for _ in 0..count {
                all.extend(at(&[k]));
                let own = record.count(k + 2).unwrap_or_default();
                all.extend((k + 3..k + 3 + own).filter_map(|k| record.pointer(k).ok()));
                k += 3 + own;
            }
            all
        }
        142 => at(&[1, 2, 3]),
        143 => [at(&[1]), listed(&record, 2).unwrap_or_default()].concat(),
        144 => {
            let holes = record.count(2).unwrap_or_default();
            [at(&[0, 3]), (4..4 + holes).filter_map(|k| record.pointer(k).ok()).collect()].concat()
        }
        162 | 164 => at(&[0]),
        168 | 182 => at(&[0]),
        // Operands stand below 0, operations above.
        180 => (1..record.len())
            .filter_map(|k| record.integer(k).ok().filter(|n| *n < 0))
            .map(i64::unsigned_abs)
            .collect(),
        184 => listed(&record, 0).unwrap_or_default(),
        186 => [at(&[0]), every(3, 2)].concat(),
        190 | 192 | 194 | 198 => at(&[0, 1]),
        196 => at(&[0, 2]),
        308 | 320 => listed(&record, 2).unwrap_or_default(),
        408 | 420 => at(&[0]),
        430 => at(&[0]),
        504 => every(1, 5),
        508 => {
            let (count, mut k) = (record.count(0).unwrap_or_default(), 1);
            let mut all = vec![];
            for _ in 0..count {
                all.extend(at(&[k + 1]));
                let own = record.count(k + 4).unwrap_or_default();
                all.extend((0..own).filter_map(|i| record.pointer(k + 6 + 2 * i).ok()));
                k += 5 + 2 * own;
            }
            all
        }
        510 => {
            let loops = record.count(1).unwrap_or_default();
            [at(&[0]), (3..3 + loops).filter_map(|k| record.pointer(k).ok()).collect()].concat()
        }
        514 => every(1, 2),
        _ => vec![],
    }
}

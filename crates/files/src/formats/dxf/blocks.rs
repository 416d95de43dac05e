//! Blocks, and where they are inserted.

use super::entities::EntityGroups;
use super::groups::Group;
use super::hidden::{Hidden, State, Unseen};
use super::place::Placing;
use crate::content::drawing::{Drawing, DrawnEntity};
use crate::error::{Fault, Located, Result};
use std::collections::BTreeMap;

/// Blocks may lie within blocks to this depth. Deeper ones contain themselves.
const MAX_BLOCK_DEPTH: usize = 32;
/// So many entities and blocks may be placed. Without a limit, a few hundred bytes of nested rows ask for more memory than there is.
const MAX_PLACED_ITEMS: u64 = 1_000_000;

/// An entity or an inserted block, in the order of the file.
#[derive(Debug)]
pub(super) enum Item {
    Drawn(DrawnEntity),
    Insert(Insert),
}

/// Entities with a name, to be inserted.
#[derive(Debug, Default)]
pub(super) struct Block {
    pub base: [f64; 2],
    pub items: Vec<Item>,
    /// Entities in it that have no course in the plane.
    pub passed_over: BTreeMap<String, u64>,
    /// Entities in it that are not seen.
    pub unseen: Unseen,
}

/// Whether entities of a block on this layer take the layer on which the block is inserted.
pub(super) fn is_layer_0(layer: &str) -> bool {
    layer == "0" || layer.is_empty()
}

/// A place of a block, or rows and columns of places.
#[derive(Debug)]
pub(super) struct Insert {
    name: String,
    layer: String,
    line: u64,
    placing: Placing,
    counts: [u64; 2],
    /// From column to column, and from row to row.
    steps: [[f64; 2]; 2],
}

/// The name of a block in capitals, as names do not differ by case.
pub(super) fn block_name(groups: &[Group]) -> String {
    let name = groups.iter().find(|g| g.code == 2).map_or(&b""[..], |g| g.value);
    String::from_utf8_lossy(name).to_uppercase()
}

impl Insert {
    /// The place that an `INSERT` gives.
    pub fn of(entity: &EntityGroups, layer: String) -> Result<Insert> {
        let mirror = if entity.mirrored()? { -1.0 } else { 1.0 };
        let at = entity.place(10)?;
        let [x, y] = [entity.or(41, 1.0)?, entity.or(42, 1.0)?];
        if x == 0.0 || y == 0.0 {
            return Err(entity.wrong("a block is inserted with a scale of 0", "insert it with its scale"));
        }
        let (sin, cos) = libm::sincos(entity.or(50, 0.0)?.to_radians());
        let turned = |v: [f64; 2]| [mirror * (cos * v[0] - sin * v[1]), sin * v[0] + cos * v[1]];
        let count = |code: i64| -> Result<u64> {
            Ok(if entity.has(code) { u64::try_from(entity.integer(code)?).unwrap_or(0).max(1) } else { 1 })
        };
        Ok(Insert {
            name: block_name(entity.groups),
            layer,
            line: entity.line,
            placing: Placing { axes: [turned([x, 0.0]), turned([0.0, y])], origin: [mirror * at[0], at[1]] },
            counts: [count(70)?, count(71)?],
            steps: [turned([entity.length_or_0(44)?, 0.0]), turned([0.0, entity.length_or_0(45)?])],
        })
    }
}

/// A drawing while blocks are placed in it.
pub(super) struct Placed<'h> {
    /// Blocks by their names; a faulty one is a fault where it is inserted.
    pub blocks: BTreeMap<String, Result<Block>>,
    pub drawing: Drawing,
    pub passed_over: BTreeMap<String, u64>,
    pub unseen: Unseen,
    hidden: &'h Hidden,
    left: u64,
}

impl<'h> Placed<'h> {
    pub fn new(
        blocks: BTreeMap<String, Result<Block>>,
        passed_over: BTreeMap<String, u64>,
        unseen: Unseen,
        hidden: &'h Hidden,
    ) -> Placed<'h> {
        Placed { blocks, drawing: Drawing::default(), passed_over, unseen, hidden, left: MAX_PLACED_ITEMS }
    }

    /// The entities of the drawing itself, with those of the blocks inserted.
    pub fn place(&mut self, items: Vec<Item>) -> Result<()> {
        for item in items {
            match item {
                Item::Drawn(entity) => self.show(entity),
                Item::Insert(insert) => {
                    // A fault of a block is one of the file.
                    let mut blocks = std::mem::take(&mut self.blocks);
                    self.insert(&mut blocks, &insert, &Placing::UNMOVED, "0", 0)?;
                    self.blocks = blocks;
                }
            }
        }
        Ok(())
    }

    /// Takes up an entity unless its layer is hidden.
    fn show(&mut self, entity: DrawnEntity) {
        match self.hidden.state(&entity.layer) {
            Some(_) => self.unseen.count_on_layer(&entity.layer),
            None => self.drawing.entities.push(entity),
        }
    }

    fn insert(
        &mut self,
        blocks: &mut BTreeMap<String, Result<Block>>,
        insert: &Insert,
        outer: &Placing,
        layer: &str,
        depth: usize,
    ) -> Result<()> {
        // Entities on layer 0 of a block take the layer of its place.
        let layer = if is_layer_0(&insert.layer) { layer } else { &insert.layer };
        if self.hidden.state(layer) == Some(State::Frozen) {
            self.unseen.count_on_layer(layer);
            return Ok(());
        }
        let wrong = |what: &str, remedy: &'static str| -> Located {
            Fault::Unsupported { what: what.into(), remedy }.at_line(insert.line)
        };
        if depth >= MAX_BLOCK_DEPTH {
            return Err(wrong("blocks within blocks without end", "explode the blocks"));
        }
        // The block is taken out while it is placed, so that a block within itself is missing.
        let block = match blocks.remove(&insert.name) {
            Some(block) => block?,
            None => {
                let what = format!("INSERT of `{}`, a block that is not in the file", insert.name);
                *self.passed_over.entry(what).or_default() += 1;
                return Ok(());
            }
        };
        let [columns, rows] = insert.counts;
        for (column, row) in (0..columns).flat_map(|c| (0..rows).map(move |r| (c, r))) {
            let shift = [0, 1].map(|k| column as f64 * insert.steps[0][k] + row as f64 * insert.steps[1][k]);
            let own = &insert.placing;
            let at = Placing { origin: [own.origin[0] + shift[0], own.origin[1] + shift[1]], ..*own };
            let based = Placing { origin: block.base.map(|x| -x), ..Placing::UNMOVED };
            let placing = outer.after(&at.after(&based));
            for item in &block.items {
                match item {
                    Item::Insert(inner) => self.insert(blocks, inner, &placing, layer, depth + 1)?,
                    Item::Drawn(entity) => {
                        let own = if is_layer_0(&entity.layer) { layer } else { &entity.layer };
                        let drawn = placing.drawn(&entity.drawn).map_err(|f| f.at_line(insert.line))?;
                        let of = |drawn| DrawnEntity { layer: own.to_owned(), drawn };
                        drawn.into_iter().map(of).for_each(|entity| self.show(entity));
                    }
                }
            }
            for (name, count) in &block.passed_over {
                *self.passed_over.entry(name.clone()).or_default() += count;
            }
            self.unseen.add(&block.unseen);
            self.left = self.left.saturating_sub(1 + block.items.len() as u64);
            if self.left == 0 {
                let what = format!("inserted blocks make more than {MAX_PLACED_ITEMS} entities");
                return Err(wrong(&what, "explode the blocks, or leave out what is not needed"));
            }
        }
        blocks.insert(insert.name.clone(), Ok(block));
        Ok(())
    }
}

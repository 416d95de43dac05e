//! Colors, names and levels, and what is not shown.

use super::super::text::{Entity, File};
use super::surface::SURFACE_KINDS;
use std::collections::{BTreeMap, BTreeSet};
use trueness_cad::brep::Color;

/// How entities look.
pub(super) struct Looks {
    colors: BTreeMap<u64, Color>,
    names: BTreeMap<u64, String>,
}

/// Whether an entity may stand for a face, a solid or an instance.
fn is_named(entity: &Entity) -> bool {
    matches!(entity.kind, 143 | 144 | 186 | 408 | 510) || SURFACE_KINDS.contains(&entity.kind)
}

/// The colors that have a number of their own, from 1.
const STANDARD: [[f32; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];

impl Looks {
    /// Those of a file. What is damaged among them is no fault of what it describes.
    pub fn of(file: &File) -> Looks {
        let mut looks = Looks { colors: BTreeMap::new(), names: BTreeMap::new() };
        let mut count: BTreeMap<&str, usize> = BTreeMap::new();
        for entity in file.entities.values().filter(|e| is_named(e)) {
            *count.entry(&entity.label).or_default() += 1;
        }
        for entity in file.entities.values() {
            if let Some(color) = defined(file, entity) {
                looks.colors.insert(entity.number, color);
            }
            if !is_named(entity) {
                continue;
            }
            // A label that several have names none of them.
            let label =
                Some(&entity.label).filter(|l| !l.is_empty() && count.get(&l[..]) == Some(&1)).cloned();
            if let Some(name) = property(file, entity).or(label) {
                looks.names.insert(entity.number, name);
            }
        }
        looks
    }

    /// The color that an entity has itself.
    pub fn color(&self, entity: &Entity) -> Option<Color> {
        if entity.color < 0 {
            return self.colors.get(&entity.color.unsigned_abs()).copied();
        }
        let number = usize::try_from(entity.color).ok()?.checked_sub(1)?;
        STANDARD.get(number).map(|[r, g, b]| [*r, *g, *b, 1.0])
    }

    /// The name of an entity; may be empty.
    pub fn name(&self, entity: &Entity) -> String {
        self.names.get(&entity.number).cloned().unwrap_or_default()
    }
}

/// The color that an entity defines (314): percents of red, green and blue.
fn defined(file: &File, entity: &Entity) -> Option<Color> {
    if entity.kind != 314 {
        return None;
    }
    let [r, g, b] =
        file.record(entity.number).ok()?.triple(0).ok()?.map(|x| (x / 100.0).clamp(0.0, 1.0) as f32);
    Some([r, g, b, 1.0])
}

/// The name that a property (406, form 15) gives. Behind its own parameters an entity has two lists: of what it belongs to, and of its properties.
fn property(file: &File, entity: &Entity) -> Option<String> {
    let record = file.record(entity.number).ok()?;
    let own = match entity.kind {
        144 => 4 + record.count(2).ok()?,
        143 => 3 + record.count(2).ok()?,
        186 => 3 + 2 * record.count(2).ok()?,
        510 => 3 + record.count(1).ok()?,
        108 => 9,
        118 => 4,
        120 => 4,
        122 => 4,
        140 => 5,
        408 => 5,
        _ => return None,
    };
    let first = own + 1 + record.count(own).ok()?;
    let count = record.count(first).ok()?;
    let named = |k: usize| {
        let property = file.record(record.pointer(k).ok()?).ok()?;
        let is_name = property.entity.kind == 406 && property.entity.form == 15;
        is_name.then(|| property.text(1)).filter(|name| !name.is_empty())
    };
    (first + 1..=first + count).find_map(named)
}

/// Numbers of the shapes that are blanked, and names of the levels of all shapes.
pub(super) fn hidden_and_layers(file: &File) -> (Vec<u64>, Vec<String>) {
    let shapes = || file.entities.values().filter(|e| is_named(e));
    let hidden = shapes().filter(|e| e.status[0] == 1).map(|e| e.number).collect();
    let levels: BTreeSet<i64> = shapes().map(|e| e.level).filter(|level| *level > 0).collect();
    (hidden, levels.into_iter().map(|level| level.to_string()).collect())
}

//! Colors, what is not shown, and the names of layers.

use super::super::part21::{Entity, File, Value};
use std::collections::{BTreeSet, HashMap};
use trueness_cad::brep::Color;

/// Entities that are looked at for the color of one style: those on the way to it, and some that lead elsewhere.
const MAX_VISITED: usize = 64;

/// How items look.
#[derive(Default)]
pub(super) struct Looks {
    colors: HashMap<u64, Color>,
    /// Faces, shells, solids, representations that are not shown.
    pub hidden: BTreeSet<u64>,
    /// Names of layers.
    pub layers: BTreeSet<String>,
}

/// Entities on the way from a styled item to the color of its surface.
const STYLES: [&str; 10] = [
    "PRESENTATION_STYLE_ASSIGNMENT",
    "PRESENTATION_STYLE_BY_CONTEXT",
    "SURFACE_STYLE_USAGE",
    "SURFACE_SIDE_STYLE",
    "SURFACE_STYLE_FILL_AREA",
    "FILL_AREA_STYLE",
    "FILL_AREA_STYLE_COLOUR",
    "SURFACE_STYLE_RENDERING",
    "SURFACE_STYLE_RENDERING_WITH_PROPERTIES",
    "SURFACE_STYLE_TRANSPARENT",
];

impl Looks {
    /// Those of a file. Damaged styles are no fault of what they style.
    pub fn of(file: &File) -> Looks {
        let mut looks = Looks::default();
        let mut styles = HashMap::new();
        // What overrides comes second, whatever its number.
        for overrides in [false, true] {
            for entity in file.entities() {
                let styled = entity.records().find(|r| r.keyword.ends_with("STYLED_ITEM"));
                if styled.is_some_and(|r| r.keyword.contains("OVER_RIDING") == overrides) {
                    looks.style(file, &entity, overrides, &mut styles);
                }
            }
        }
        for entity in file.entities() {
            if let Some(layer) = entity.record("PRESENTATION_LAYER_ASSIGNMENT") {
                looks.layers.insert(layer.text(0));
            }
            if let Some(record) = entity.record("INVISIBILITY") {
                let items = record.list(0).unwrap_or_default();
                looks.hidden.extend(items.iter().filter_map(reference).flat_map(|n| shown(file, n)));
            }
        }
        looks
    }

    fn style(
        &mut self,
        file: &File,
        entity: &Entity,
        overrides: bool,
        styles: &mut HashMap<u64, Option<Color>>,
    ) {
        // Of a complex instance the record STYLED_ITEM has styles and item alone.
        let record = entity.main(&["STYLED_ITEM"]);
        let first = usize::from(entity.is_simple());
        let (Ok(list), Some(item)) = (record.list(first), record.reference(first + 1)) else { return };
        // In a context it is one occurrence that has the color, not all of the item.
        let item = match record.keyword.starts_with("CONTEXT_DEPENDENT") {
            false => item,
            true => match record.list(record.values.len() - 1) {
                Ok([Value::Reference(relation)]) => *relation,
                _ => return,
            },
        };
        let found = list.iter().filter_map(reference).find_map(|style| {
            let color = styles.entry(style).or_insert_with(|| color(file, style));
            *color
        });
        if let Some(color) = found {
            let own = self.colors.entry(item).or_insert(color);
            if overrides {
                *own = color;
            }
        }
    }

    /// The color that an item has itself.
    pub fn color(&self, item: u64) -> Option<Color> {
        self.colors.get(&item).copied()
    }
}

fn reference(value: &Value) -> Option<u64> {
    match value {
        Value::Reference(n) => Some(*n),
        _ => None,
    }
}

/// What an invisible item stands for: what is styled, what lies on a layer, or itself.
fn shown(file: &File, number: u64) -> Vec<u64> {
    let Ok(entity) = file.entity(number) else { return vec![] };
    if let Some(layer) = entity.record("PRESENTATION_LAYER_ASSIGNMENT") {
        return layer.list(2).unwrap_or_default().iter().filter_map(reference).collect();
    }
    let styled = entity.main(&["STYLED_ITEM"]);
    match styled.keyword.ends_with("STYLED_ITEM") {
        true => styled.reference(1 + usize::from(entity.is_simple())).into_iter().collect(),
        false => vec![number],
    }
}

/// The color of surfaces that a style has.
fn color(file: &File, style: u64) -> Option<Color> {
    let (mut found, mut opacity) = (None, 1.0);
    let mut pending = vec![style];
    for _ in 0..MAX_VISITED {
        let Some(number) = pending.pop() else { break };
        let Ok(entity) = file.entity(number) else { continue };
        for record in entity.records() {
            match record.keyword {
                "COLOUR_RGB" => {
                    let part = |k: usize| record.real(k).map_or(0.0, |x| x.clamp(0.0, 1.0) as f32);
                    found = found.or(Some([1, 2, 3].map(part)));
                }
                "DRAUGHTING_PRE_DEFINED_COLOUR" | "PRE_DEFINED_COLOUR" => {
                    found = found.or_else(|| named(&record.text(0)));
                }
                "SURFACE_STYLE_TRANSPARENT" => {
                    opacity = 1.0 - record.real(0).map_or(0.0, |x| x.clamp(0.0, 1.0) as f32);
                }
                keyword if STYLES.contains(&keyword) => {
                    for value in record.values {
                        let list = record.items(*value).unwrap_or(std::slice::from_ref(value));
                        // The last one pushed is looked at first.
                        pending.extend(list.iter().rev().filter_map(reference));
                    }
                }
                _ => {}
            }
        }
    }
    found.map(|[r, g, b]| [r, g, b, opacity])
}

/// Colors that drawings have by name.
fn named(name: &str) -> Option<[f32; 3]> {
    match &name.to_ascii_lowercase()[..] {
        "red" => Some([1.0, 0.0, 0.0]),
        "green" => Some([0.0, 1.0, 0.0]),
        "blue" => Some([0.0, 0.0, 1.0]),
        "yellow" => Some([1.0, 1.0, 0.0]),
        "magenta" => Some([1.0, 0.0, 1.0]),
        "cyan" => Some([0.0, 1.0, 1.0]),
        "black" => Some([0.0; 3]),
        "white" => Some([1.0; 3]),
        _ => None,
    }
}

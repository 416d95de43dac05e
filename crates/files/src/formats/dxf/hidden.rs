//! Entities of a drawing that are not seen: marked as invisible, or on a layer that is frozen or switched off.

use super::groups::Group;
use crate::Warning;
use crate::error::Result;
use std::collections::{BTreeMap, BTreeSet};

/// The bit of a layer's flags that freezes it.
const FROZEN_FLAG: i64 = 1;
/// A message names this many layers.
const MAX_LAYERS_NAMED: usize = 8;

/// How a layer is hidden.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// Entities on it are not seen.
    Off,
    /// Entities on it are not seen, nor are those of a block inserted on it.
    Frozen,
}

/// The hidden layers of a drawing, by their names in capitals, as names do not differ by case.
#[derive(Clone, Debug, Default)]
pub(super) struct Hidden(BTreeMap<String, State>);

impl Hidden {
    /// Adds the layer of a record of the table of layers, if it is hidden.
    pub fn add(&mut self, record: &[Group]) -> Result<()> {
        let find = |code| record.iter().find(|g| g.code == code);
        let integer = |code| find(code).map_or(Ok(0), |g| g.integer());
        let state = match (integer(70)? & FROZEN_FLAG != 0, integer(62)? < 0) {
            (true, _) => State::Frozen,
            (false, true) => State::Off,
            (false, false) => return Ok(()),
        };
        if let Some(name) = find(2) {
            self.0.insert(String::from_utf8_lossy(name.value).to_uppercase(), state);
        }
        Ok(())
    }

    /// How a layer is hidden, if it is.
    pub fn state(&self, layer: &str) -> Option<State> {
        if self.0.is_empty() { None } else { self.0.get(&layer.to_uppercase()).copied() }
    }
}

/// Entities that are not seen, counted.
#[derive(Clone, Debug, Default)]
pub(super) struct Unseen {
    marked: u64,
    on_layers: u64,
    layers: BTreeSet<String>,
}

impl Unseen {
    /// One that is marked as invisible.
    pub fn count_marked(&mut self) {
        self.marked += 1;
    }
    /// One on a layer that is hidden.
    pub fn count_on_layer(&mut self, layer: &str) {
        self.on_layers += 1;
        self.layers.insert(layer.to_owned());
    }
    /// Adds the entities counted elsewhere.
    pub fn add(&mut self, other: &Unseen) {
        self.marked += other.marked;
        self.on_layers += other.on_layers;
        self.layers.extend(other.layers.iter().cloned());
    }
    /// The warning about them, if there are any.
    pub fn warning(&self) -> Option<Warning> {
        let layers: Vec<&str> = self.layers.iter().map(String::as_str).collect();
        let (marked, on_layers, layers) = (self.marked, self.on_layers, short(&layers));
        (marked + on_layers > 0).then_some(Warning::Unseen { marked, on_layers, layers })
    }
}

/// The first names of many.
fn short(names: &[&str]) -> String {
    let more = if names.len() > MAX_LAYERS_NAMED { ", …" } else { "" };
    names.iter().take(MAX_LAYERS_NAMED).copied().collect::<Vec<_>>().join(", ") + more
}

/// The warning about entities on several layers, because lines that are no outline look like any other. Layers named as sections belong
/// to several planes.
pub(super) fn several<'a>(layers: impl Iterator<Item = &'a str>) -> Option<Warning> {
    let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
    layers.for_each(|layer| *counts.entry(layer).or_default() += 1);
    let is_section = |layer: &&str| layer.strip_prefix("section-").is_some_and(|n| n.parse::<u32>().is_ok());
    if counts.len() < 2 || counts.keys().all(is_section) {
        return None;
    }
    let named: Vec<String> = counts.iter().map(|(layer, count)| format!("{layer} ({count})")).collect();
    let named: Vec<&str> = named.iter().map(String::as_str).collect();
    Some(Warning::SeveralLayers { layers: short(&named) })
}

//! Datums, the places they are taken from, and references to them.

use super::super::context::{Measure, measure};
use super::super::part21::{Entity, Record, Value};
use super::graph::{Graph, list, references, told};
use trueness_cad::tolerances::{Datum, DatumPart, DatumReference, DatumTarget};

/// Entities that refer to one datum, or to several as a common one, in a datum system.
const COMPARTMENTS: [&str; 3] =
    ["GENERAL_DATUM_REFERENCE", "DATUM_REFERENCE_COMPARTMENT", "DATUM_REFERENCE_ELEMENT"];
/// Ways from a tolerance to a datum are no longer than this.
const MAX_WAY_TO_DATUM: usize = 4;

/// The datums of a file.
pub(super) fn datums(graph: &Graph) -> Vec<Datum> {
    let of = |entity: Entity| Some(datum(graph, &entity.record("DATUM")?, &entity));
    graph.file.entities().filter_map(of).collect()
}

fn datum(graph: &Graph, record: &Record, entity: &Entity) -> Datum {
    let (number, letter) = (entity.number(), letter(record));
    let mut datum = Datum { entity: number, letter, features: vec![], targets: vec![] };
    for feature in list(&graph.relating, number) {
        let Ok(entity) = graph.file.entity(*feature) else { continue };
        let target = entity.records().find(|r| r.keyword.contains("DATUM_TARGET"));
        match target {
            Some(record) => datum.targets.push(datum_target(graph, &entity, &record)),
            None => datum.features.push(graph.target(*feature)),
        }
    }
    if datum.features.is_empty() && datum.targets.is_empty() {
        let own = graph.target(number);
        datum.features.extend(Some(own).filter(|t| !t.faces.is_empty() || !t.others.is_empty()));
    }
    datum
}

/// The letter of a datum: its last parameter.
fn letter(record: &Record) -> String {
    record.text(record.values.len().saturating_sub(1))
}

fn datum_target(graph: &Graph, entity: &Entity, record: &Record) -> DatumTarget {
    let aspect = entity.main(&["SHAPE_ASPECT"]);
    let mut of = graph.target(entity.number());
    of.others.retain(|(n, _)| list(&graph.items, entity.number()).contains(n));
    for item in graph.shown(entity.number()) {
        let Ok(shown) = graph.file.entity(item) else { continue };
        if let Some((name, length)) = named_length(graph, &shown) {
            of.notes.push(format!("{name} {length} mm"));
        }
    }
    DatumTarget { entity: entity.number(), number: letter(record), form: aspect.text(1), of }
}

/// The name of a measure and its length.
fn named_length(graph: &Graph, entity: &Entity) -> Option<(String, f64)> {
    match measure(graph.file, entity.number()).ok()? {
        Measure::Length(length) => Some((entity.main(&["REPRESENTATION_ITEM"]).text(0), length)),
        Measure::Angle(_) => None,
    }
}

impl Graph<'_> {
    /// The datums that a tolerance refers to: a datum system, or references in the order of their precedence.
    pub fn datum_references(&self, numbers: &[u64]) -> (Vec<DatumReference>, Vec<String>) {
        let (mut ranked, mut notes) = (vec![], vec![]);
        for number in numbers {
            let entity = match self.file.entity(*number) {
                Ok(entity) => entity,
                Err(wrong) => {
                    notes.push(wrong.to_string());
                    continue;
                }
            };
            if let Some(system) = entity.record("DATUM_SYSTEM") {
                let last = system.values.last().copied().unwrap_or(Value::Nothing);
                for compartment in references(&system, last) {
                    let found =
                        DatumReference { parts: self.parts(compartment, MAX_WAY_TO_DATUM, &mut notes) };
                    ranked.push((0, found));
                }
            } else {
                let record = entity.main(&["DATUM_REFERENCE"]);
                let rank = record.count(0).unwrap_or_default();
                ranked.push((
                    rank,
                    DatumReference { parts: self.parts(*number, MAX_WAY_TO_DATUM, &mut notes) },
                ));
            }
        }
        ranked.sort_by_key(|(rank, _)| *rank);
        (ranked.into_iter().map(|(_, found)| found).collect(), notes)
    }

    /// The datums that an entity within a datum system leads to.
    fn parts(&self, number: u64, depth: usize, notes: &mut Vec<String>) -> Vec<DatumPart> {
        let entity = match self.file.entity(number) {
            Ok(entity) if depth > 0 => entity,
            Ok(entity) => {
                notes.push(entity.wrong("rests on itself").to_string());
                return vec![];
            }
            Err(wrong) => {
                notes.push(wrong.to_string());
                return vec![];
            }
        };
        if let Some(datum) = entity.record("DATUM") {
            return vec![DatumPart { letter: letter(&datum), modifiers: vec![] }];
        }
        if let Err(wrong) = self.budget.spend(1, &entity) {
            notes.push(wrong.to_string());
            return vec![];
        }
        let record = entity.main(&COMPARTMENTS);
        let (below, modifiers) = match COMPARTMENTS.contains(&record.keyword) {
            // The last two parameters are what it refers to, and the modifiers.
            true => {
                let count = record.values.len();
                let value = |k: usize| record.values.get(k).copied().unwrap_or(Value::Nothing);
                let modifiers = self.modifiers(&record, value(count.saturating_sub(1)));
                (references(&record, value(count.saturating_sub(2))), modifiers)
            }
            // DATUM_REFERENCE of ISO 10303-47: precedence, datum; REFERENCED_MODIFIED_DATUM has a modifier more.
            false => {
                let words = entity.records().filter(|r| r.keyword == "REFERENCED_MODIFIED_DATUM");
                let words = words.filter_map(|r| r.word(r.values.len().saturating_sub(1)));
                (record.reference(1).into_iter().collect(), words.map(|w| told(&w)).collect())
            }
        };
        let mut found: Vec<DatumPart> = below.iter().flat_map(|n| self.parts(*n, depth - 1, notes)).collect();
        found.iter_mut().for_each(|part| part.modifiers.extend(modifiers.iter().cloned()));
        found
    }

    fn modifiers(&self, record: &Record, value: Value) -> Vec<String> {
        let (mut found, mut pending) = (vec![], vec![value]);
        while let Some(value) = pending.pop() {
            match value {
                Value::Word(word) => found.push(told(&String::from_utf8_lossy(word))),
                Value::Reference(number) => found.push(self.valued_modifier(number)),
                Value::Typed(_) => {
                    found.extend(record.items(value).unwrap_or_default().iter().filter_map(|v| match v {
                        Value::Word(word) => Some(told(&String::from_utf8_lossy(word))),
                        _ => None,
                    }))
                }
                value => pending.extend(record.items(value).unwrap_or_default().iter().rev()),
            }
        }
        found
    }

    /// A modifier with a length.
    fn valued_modifier(&self, number: u64) -> String {
        let Ok(entity) = self.file.entity(number) else {
            return format!("#{number}, which is not in the file");
        };
        let record = entity.main(&[]);
        let word = told(&record.word(0).unwrap_or_else(|| record.keyword.into()));
        match record.entity(1).and_then(|n| measure(self.file, n)) {
            Ok(Measure::Length(length)) => format!("{word} {length} mm"),
            _ => word,
        }
    }
}

//! Datums of a model as plans name them.

use super::draft::Draft;
use super::faces::{Group, median};
use super::text::listed;
use std::collections::BTreeMap;
use trueness_cad::tolerances::{Datum, DatumReference, GeometricTolerance, Target};
use trueness_geom::shape::Shape;
use trueness_geom::zone::datum::{Datum as Held, System};

/// A datum that plans can name.
struct Known {
    /// How: the id of its feature, or those of two opposite planes with a dash between.
    name: String,
    /// The features.
    ids: Vec<String>,
    /// What it holds.
    held: Option<Held>,
}

/// The datums of a model by their letters, or why plans have them not.
pub(super) struct Datums {
    known: BTreeMap<String, Result<Known, String>>,
}

/// A datum system as it stands in a plan.
#[derive(Debug)]
pub(super) struct Named {
    /// The datums with their material requirements.
    pub names: Vec<String>,
    /// The features.
    pub ids: Vec<String>,
}

impl Datums {
    /// Makes features of the datums, and says which are none; with their number.
    pub fn of(draft: &mut Draft, datums: &[Datum]) -> (Datums, usize) {
        let mut known = BTreeMap::new();
        let mut sayable = 0;
        for datum in datums {
            let found = match known.contains_key(&datum.letter) {
                true => Err("another datum has its letter".to_string()),
                false => feature(draft, datum),
            };
            let text = format!("datum {}, #{}, of {}", datum.letter, datum.entity, said(datum));
            match &found {
                Ok(_) => sayable += 1,
                Err(why) => draft.say(&format!("Not in the plan: {text}: {why}")),
            }
            if let Ok(Known { name, ids, .. }) = &found {
                ids.iter().for_each(|id| draft.keep(id));
                draft.say(&format!(
                    "Datum {}, #{}, of {}, is \"{name}\".",
                    datum.letter,
                    datum.entity,
                    said(datum)
                ));
            }
            known.entry(datum.letter.clone()).or_insert(found);
        }
        (Datums { known }, sayable)
    }

    /// A datum system as plans write it.
    ///
    /// # Errors
    /// Why they cannot.
    pub fn named(&self, references: &[DatumReference]) -> Result<Named, String> {
        let mut named = Named { names: vec![], ids: vec![] };
        for reference in references {
            let mut parts = vec![];
            for part in &reference.parts {
                let known = match self.known.get(&part.letter) {
                    Some(Ok(known)) => known,
                    Some(Err(why)) => return Err(format!("datum {}: {why}", part.letter)),
                    None => return Err(format!("there is no datum {}", part.letter)),
                };
                let mut requirement = "";
                for modifier in &part.modifiers {
                    requirement = match material(modifier) {
                        Some("M") => "(M)",
                        Some(_) => "(L)",
                        None => return Err(format!("datum {} has the modifier \"{modifier}\"", part.letter)),
                    };
                }
                parts.push(format!("{}{requirement}", known.name));
                named.ids.extend(known.ids.iter().cloned());
            }
            if parts.is_empty() {
                return Err("a reference leads to no datum".into());
            }
            named.names.push(parts.join("-"));
        }
        Ok(named)
    }

    /// The datum system that most tolerances refer to, of those that hold a part completely and have single features.
    pub fn most_used(&self, tolerances: &[GeometricTolerance]) -> Option<Named> {
        let mut counts: BTreeMap<Vec<&str>, usize> = BTreeMap::new();
        for tolerance in tolerances {
            let letters = tolerance.datums.iter().map(|d| match d.parts.as_slice() {
                [one] => Some(one.letter.as_str()),
                _ => None,
            });
            if let Some(letters) = letters.collect::<Option<Vec<&str>>>() {
                *counts.entry(letters).or_default() += 1;
            }
        }
        let complete = counts.into_iter().filter(|(letters, _)| self.is_complete(letters));
        // Of equal ones the first by its letters.
        let (letters, _) = complete.rev().max_by_key(|(_, count)| *count)?;
        let known = letters.iter().filter_map(|letter| self.known.get(*letter)?.as_ref().ok());
        let names: Vec<String> = known.map(|k| k.name.clone()).collect();
        Some(Named { ids: names.clone(), names })
    }

    /// Whether these datums, as drawn, hold all motions.
    fn is_complete(&self, letters: &[&str]) -> bool {
        let held = letters.iter().map(|letter| match self.known.get(*letter) {
            Some(Ok(Known { ids, held, .. })) if ids.len() == 1 => *held,
            _ => None,
        });
        let held = held.collect::<Option<Vec<Held>>>();
        held.is_some_and(|held| System::of(&held).is_ok_and(|system| system.free.is_none()))
    }
}

/// The letter of a material requirement in plans.
pub(super) fn material(modifier: &str) -> Option<&'static str> {
    match modifier {
        "maximum material requirement" | "maximum material condition" => Some("M"),
        "least material requirement" | "least material condition" => Some("L"),
        _ => None,
    }
}

/// Faces, and what else a tolerance or datum is of.
pub(super) fn place(target: &Target) -> String {
    let mut parts = vec![];
    match target.faces.as_slice() {
        [] => {}
        [one] => parts.push(format!("face {one}")),
        several => parts.push(format!("faces {}", listed(several))),
    }
    let others: Vec<String> = target.others.iter().map(|(n, keyword)| format!("{keyword} #{n}")).collect();
    parts.extend(others);
    match parts.is_empty() {
        true => format!("#{} without faces", target.entity),
        false => parts.join(", "),
    }
}

fn said(datum: &Datum) -> String {
    let features = datum.features.iter().map(place);
    let targets = datum.targets.iter().map(|t| {
        let notes: String = t.of.notes.iter().map(|n| format!(", {n}")).collect();
        format!("target {}{}, #{}, {}, {}{notes}", datum.letter, t.number, t.entity, t.form, place(&t.of))
    });
    let all: Vec<String> = features.chain(targets).collect();
    if all.is_empty() { "nothing".into() } else { all.join("; ") }
}

fn feature(draft: &mut Draft, datum: &Datum) -> Result<Known, String> {
    if !datum.targets.is_empty() {
        return Err("plans have no datum targets".into());
    }
    let faces: Vec<u64> = datum.features.iter().flat_map(|f| f.faces.iter().copied()).collect();
    if faces.is_empty() {
        return Err("it has no faces".into());
    }
    let (groups, none) = draft.faces.groups(faces);
    if let Some(first) = none.first() {
        return Err(first.clone());
    }
    match groups.as_slice() {
        [one] => {
            let id = draft.feature(one, Some(&datum.letter));
            Ok(Known { name: id.clone(), ids: vec![id], held: held(&one.shape) })
        }
        several => match median(several) {
            Some(middle) => {
                let sides: Vec<String> = several.iter().map(|g: &Group| draft.feature(g, None)).collect();
                Ok(Known { name: sides.join("-"), ids: sides, held: held(&middle) })
            }
            None => {
                Err(format!("its faces are {} surfaces, and plans have no datum of a pattern", several.len()))
            }
        },
    }
}

fn held(shape: &Shape) -> Option<Held> {
    match *shape {
        Shape::Plane { point, normal } => Some(Held::Plane { point, normal }),
        Shape::Cylinder { point, direction, .. } => Some(Held::Axis { point, direction }),
        Shape::Cone { apex, direction, .. } => Some(Held::Axis { point: apex, direction }),
        Shape::Sphere { center, .. } => Some(Held::Point(center)),
        _ => None,
    }
}

//! Sizes, distances and angles, with their limits.

use super::super::context::{Measure, measure};
use super::super::part21::{Entity, File, Record};
use super::graph::{Graph, list, references};
use trueness_cad::tolerances::Dimension;

/// Keywords of dimensions of one feature.
const SIZE_KEYWORDS: [&str; 4] =
    ["DIMENSIONAL_SIZE", "ANGULAR_SIZE", "DIMENSIONAL_SIZE_WITH_PATH", "DIMENSIONAL_SIZE_WITH_DATUM_FEATURE"];
/// Keywords of dimensions between two features.
const LOCATIONS: [&str; 5] = [
    "DIMENSIONAL_LOCATION",
    "ANGULAR_LOCATION",
    "DIRECTED_DIMENSIONAL_LOCATION",
    "DIMENSIONAL_LOCATION_WITH_PATH",
    "DIMENSIONAL_LOCATION_WITH_DATUM_FEATURE",
];

/// The dimensions of a file.
pub(super) fn dimensions(graph: &Graph) -> Vec<Dimension> {
    graph.file.entities().filter_map(|entity| dimension(graph, &entity)).collect()
}

fn dimension(graph: &Graph, entity: &Entity) -> Option<Dimension> {
    let is_of = |all: &[&str]| entity.records().any(|r| all.contains(&r.keyword));
    let (name, of) = if is_of(&SIZE_KEYWORDS) {
        let record = entity.main(&["DIMENSIONAL_SIZE"]);
        // Where it is a datum feature too, the parameters of that come first.
        let first = if record.keyword == "DIMENSIONAL_SIZE_WITH_DATUM_FEATURE" { 4 } else { 0 };
        (record.text(first + 1), vec![record.entity(first)])
    } else if is_of(&LOCATIONS) {
        let record = entity.main(&["SHAPE_ASPECT_RELATIONSHIP"]);
        (record.text(0), vec![record.entity(2), record.entity(3)])
    } else {
        return None;
    };
    let is_angle = entity.records().any(|r| r.keyword.starts_with("ANGULAR_"));
    let mut made = Dimension { entity: entity.number(), name, is_angle, ..Dimension::default() };
    for target in of {
        match target {
            Ok(number) => made.of.push(graph.target(number)),
            Err(wrong) => made.notes.push(wrong.to_string()),
        }
    }
    let mut values = Values { file: graph.file, made };
    let mut pending: Vec<u64> = graph.shown(entity.number());
    pending.reverse();
    while let Some(item) = pending.pop() {
        match graph.file.entity(item) {
            Ok(item) if graph.budget.spend(1, &item).is_ok() => pending.extend(values.item(&item)),
            Ok(_) => break,
            Err(wrong) => values.made.notes.push(wrong.to_string()),
        }
    }
    for range in list(&graph.ranges, entity.number()) {
        match graph.file.entity(*range) {
            Ok(range) => values.range(&range),
            Err(wrong) => values.made.notes.push(wrong.to_string()),
        }
    }
    Some(values.finished())
}

/// A dimension whose numbers are being read.
struct Values<'f> {
    file: &'f File<'f>,
    made: Dimension,
}

impl Values<'_> {
    /// A number of the dimension, in millimeters or radians.
    fn number(&mut self, number: u64) -> Option<f64> {
        match measure(self.file, number) {
            Ok(Measure::Length(length)) if !self.made.is_angle => Some(length),
            Ok(Measure::Angle(angle)) => {
                self.made.is_angle = true;
                Some(angle)
            }
            Ok(Measure::Length(length)) => {
                self.made.notes.push(format!("#{number} is a length, {length} mm, of an angle"));
                None
            }
            Err(wrong) => {
                self.made.notes.push(wrong.to_string());
                None
            }
        }
    }

    /// An item of the representation; the items that it holds are still to be looked at.
    fn item(&mut self, entity: &Entity) -> Vec<u64> {
        let held =
            entity.records().find(|r| matches!(r.keyword, "VALUE_RANGE" | "COMPOUND_REPRESENTATION_ITEM"));
        if let Some(record) = held {
            return record.values.iter().flat_map(|v| references(&record, *v)).collect();
        }
        if let Some(record) = entity.record("DESCRIPTIVE_REPRESENTATION_ITEM") {
            let text = record.values.len().saturating_sub(1);
            self.made.notes.push(record.text(text));
            return vec![];
        }
        if !entity.records().any(|r| r.keyword.contains("MEASURE")) {
            return vec![];
        }
        let Some(value) = self.number(entity.number()) else { return vec![] };
        let name = entity.main(&["REPRESENTATION_ITEM"]).text(0);
        self.named(&name, value);
        if let Some(record) = entity.record("QUALIFIED_REPRESENTATION_ITEM") {
            self.qualifiers(&record);
        }
        vec![]
    }

    fn named(&mut self, name: &str, value: f64) {
        let is = |word: &str| name.to_ascii_lowercase().contains(word);
        let made = &mut self.made;
        if is("upper") || is("maximum") {
            made.limits = Some([made.limits.map_or(f64::NEG_INFINITY, |l| l[0]), value]);
        } else if is("lower") || is("minimum") {
            made.limits = Some([value, made.limits.map_or(f64::INFINITY, |l| l[1])]);
        } else {
            match made.nominal {
                None => made.nominal = Some(value),
                Some(known) if known == value => {}
                Some(_) => made.notes.push(format!("{name} {value}")),
            }
        }
    }

    /// Qualifiers that say more than how many digits are shown.
    fn qualifiers(&mut self, record: &Record) {
        let all = record.values.iter().flat_map(|v| references(record, *v));
        let types = all.filter_map(|n| self.file.entity(n).ok()?.record("TYPE_QUALIFIER"));
        let words: Vec<String> = types.map(|record| record.text(0)).collect();
        self.made.notes.extend(words);
    }

    /// One limit alone is no range.
    fn finished(mut self) -> Dimension {
        if let Some([least, greatest]) = self.made.limits.filter(|l| l.iter().any(|x| x.is_infinite())) {
            self.made.limits = None;
            self.made.notes.push(match least.is_finite() {
                true => format!("at least {least}"),
                false => format!("at most {greatest}"),
            });
        }
        self.made
    }

    fn range(&mut self, range: &Entity) {
        if let Some(record) = range.record("LIMITS_AND_FITS") {
            let class = format!("{}{}", record.text(0), record.text(2));
            match &self.made.class {
                None => self.made.class = Some(class),
                Some(_) => self.made.notes.push(format!("class {class}")),
            }
            return;
        }
        let record = range.main(&["TOLERANCE_VALUE"]);
        let bounds = match (record.entity(0), record.entity(1)) {
            (Ok(lower), Ok(upper)) if record.keyword == "TOLERANCE_VALUE" => [lower, upper],
            _ => {
                self.made.notes.push(record.wrong("has no lower and upper bound").to_string());
                return;
            }
        };
        let (Some(lower), Some(upper)) = (self.number(bounds[0]), self.number(bounds[1])) else { return };
        match self.made.deviations {
            None => self.made.deviations = Some([lower, upper]),
            Some(known) if known == [lower, upper] => {}
            Some(_) => self.made.notes.push(format!("from {lower} to {upper} too")),
        }
    }
}

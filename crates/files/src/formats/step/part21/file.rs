//! The entities of a file: where they stand, and what is wrong with some.

use super::lines::Lines;
use super::record::Record;
use super::value::{Run, Value};
use crate::formats::brep::{Faulty, Wrong};

/// Where an entity stands.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub number: u64,
    pub at: usize,
    pub records: Run,
}

/// A keyword, by its index among all, and its parameters.
#[derive(Clone, Copy)]
pub(super) struct RawRecord {
    pub keyword: u32,
    pub values: Run,
}

/// An entity that could not be parsed.
#[derive(Clone, Copy)]
pub(in super::super) struct Broken {
    /// Its number.
    pub number: u64,
    pub(super) at: usize,
    /// The index of its keyword, where it has one that is known.
    pub(super) keyword: Option<u32>,
    /// What is wrong.
    pub reason: &'static str,
}

/// All entities of a file.
pub(in super::super) struct File<'t> {
    pub(super) lines: Lines<'t>,
    pub(super) values: Vec<Value<'t>>,
    pub(super) records: Vec<RawRecord>,
    /// In the order of their numbers.
    pub(super) places: Vec<Place>,
    /// Upper case.
    pub(super) keywords: Vec<String>,
    /// In the order of their numbers.
    pub(super) broken: Vec<Broken>,
    pub(super) is_whole: bool,
}

/// An entity: one record, or those of a complex one.
#[derive(Clone, Copy)]
pub(in super::super) struct Entity<'f> {
    file: &'f File<'f>,
    place: &'f Place,
}

impl<'t> File<'t> {
    /// Whether the text goes on to the line that ends such files.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// How many entities there are.
    pub fn count(&self) -> usize {
        self.places.len()
    }

    /// The entities that could not be parsed.
    pub fn broken(&self) -> &[Broken] {
        &self.broken
    }

    /// The keyword of an entity that could not be parsed, as far as it is known.
    pub fn keyword_of(&self, broken: &Broken) -> &str {
        broken.keyword.and_then(|k| self.keywords.get(k as usize)).map_or("", String::as_str)
    }

    /// All entities in the order of their numbers.
    pub fn entities(&self) -> impl Iterator<Item = Entity<'_>> + '_ {
        self.places.iter().map(|place| Entity { file: self, place })
    }

    /// The entity of this number.
    ///
    /// # Errors
    /// There is none, or it could not be parsed.
    pub fn entity(&self, number: u64) -> Result<Entity<'_>, Wrong> {
        match self.places.binary_search_by_key(&number, |p| p.number) {
            Ok(index) => Ok(Entity { file: self, place: &self.places[index] }),
            Err(_) => Err(self.absent(number)),
        }
    }

    fn absent(&self, number: u64) -> Wrong {
        match self.broken.binary_search_by_key(&number, |b| b.number) {
            Ok(index) => {
                let broken = self.broken[index];
                Wrong { entity: number, line: self.lines.line(broken.at), reason: broken.reason.into() }
            }
            Err(_) => Wrong { entity: number, line: 0, reason: "is not in the file".into() },
        }
    }

    /// The number of the last line.
    pub fn last_line(&self) -> u64 {
        self.lines.line(self.lines.text.len())
    }
}

impl<'t> File<'t> {
    /// In the order of the numbers; a number that has several different entities is broken.
    pub(super) fn sorted(mut self) -> File<'t> {
        self.places.sort_by_key(|p| (p.number, p.at));
        self.broken.sort_by_key(|b| (b.number, b.at));
        self.broken.dedup_by_key(|b| b.number);
        let mut several = vec![];
        for same in self.places.chunk_by(|a, b| a.number == b.number) {
            let again = same.get(1..).unwrap_or_default();
            let broken = self.broken.binary_search_by_key(&same[0].number, |b| b.number).is_ok();
            if broken || again.iter().any(|p| !self.is_alike(&same[0], p)) {
                several.push(same[0]);
            }
        }
        for place in several {
            let keyword = place.records.of(&self.records).first().map(|r| r.keyword);
            let reason = "stands in the file more than once, not always alike";
            self.broken.push(Broken { number: place.number, at: place.at, keyword, reason });
        }
        self.broken.sort_by_key(|b| b.number);
        self.broken.dedup_by_key(|b| b.number);
        let broken = &self.broken;
        self.places.dedup_by_key(|p| p.number);
        self.places.retain(|p| broken.binary_search_by_key(&p.number, |b| b.number).is_err());
        self
    }

    /// Whether two entities have the same text.
    fn is_alike(&self, a: &Place, b: &Place) -> bool {
        let text = |p: &Place| {
            let rest = &self.lines.text[p.at..];
            &rest[..memchr::memchr(b';', rest).unwrap_or(rest.len())]
        };
        text(a) == text(b)
    }
}

impl<'f> Entity<'f> {
    /// Its number.
    pub fn number(&self) -> u64 {
        self.place.number
    }

    /// Its records.
    pub fn records(&self) -> impl Iterator<Item = Record<'f>> + 'f {
        let (file, place) = (self.file, self.place);
        place.records.of(&file.records).iter().map(move |raw| Record {
            lines: &file.lines,
            all: &file.values,
            entity: place.number,
            at: place.at,
            keyword: file.keywords.get(raw.keyword as usize).map_or("", String::as_str),
            values: raw.values.of(&file.values),
        })
    }

    /// Whether it is one record.
    pub fn is_simple(&self) -> bool {
        self.place.records.count == 1
    }

    /// The record with this keyword.
    pub fn record(&self, keyword: &str) -> Option<Record<'f>> {
        self.records().find(|r| r.keyword == keyword)
    }

    /// The only record of a simple entity; of a complex one the first whose keyword is among these, else the first.
    pub fn main(&self, keywords: &[&str]) -> Record<'f> {
        let known = self.records().find(|r| keywords.contains(&r.keyword));
        known.or_else(|| self.records().next()).unwrap_or(Record {
            lines: &self.file.lines,
            all: &[],
            entity: self.place.number,
            at: self.place.at,
            keyword: "",
            values: &[],
        })
    }

    /// A fault of the entity.
    pub fn wrong(&self, reason: impl Into<String>) -> Wrong {
        Wrong { entity: self.place.number, line: self.file.lines.line(self.place.at), reason: reason.into() }
    }
}

impl Faulty for Entity<'_> {
    fn wrong(&self, reason: &str) -> Wrong {
        Entity::wrong(self, reason)
    }
}

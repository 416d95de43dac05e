//! The parameters of an entity by their places, from 0 behind its kind.

use super::text::{Entity, File};
use crate::formats::brep::{Faulty, Wrong};
use crate::number::{integer, whole_number};
use std::ops::Range;
use trueness_geom::space::Point;

/// An entity whose parameters can be read.
#[derive(Clone, Copy)]
pub(super) struct Record<'f> {
    file: &'f File,
    pub entity: &'f Entity,
    words: &'f [Range<usize>],
}

impl File {
    /// The entity of this number.
    pub fn record(&self, number: u64) -> Result<Record<'_>, Wrong> {
        let absent = || Wrong { entity: number, line: 0, reason: "is not in the file".into() };
        let entity = self.entities.get(&number).ok_or_else(absent)?;
        match &entity.words {
            Ok(words) => Ok(Record { file: self, entity, words }),
            Err(reason) => Err(entity.wrong(reason)),
        }
    }
}

impl Faulty for Record<'_> {
    fn wrong(&self, reason: &str) -> Wrong {
        self.entity.wrong(reason)
    }
}

impl<'f> Record<'f> {
    pub fn wrong(&self, reason: impl Into<String>) -> Wrong {
        self.entity.wrong(reason)
    }

    /// How many parameters there are.
    pub fn len(&self) -> usize {
        self.words.len()
    }

    fn word(&self, k: usize) -> &'f [u8] {
        self.words.get(k).and_then(|word| self.file.text.get(word.clone())).unwrap_or_default()
    }

    pub fn is_absent(&self, k: usize) -> bool {
        self.word(k).is_empty()
    }

    pub fn text(&self, k: usize) -> String {
        String::from_utf8_lossy(self.word(k)).trim().to_string()
    }

    /// A whole number; 0 where it is left out.
    pub fn integer(&self, k: usize) -> Result<i64, Wrong> {
        let word = self.word(k);
        if word.is_empty() {
            return Ok(0);
        }
        // Some programs write whole numbers with a point.
        let rounded =
            || whole_number(word, b'.').filter(|x| x.fract() == 0.0 && x.abs() < 1e15).map(|x| x as i64);
        integer(word).or_else(rounded).ok_or_else(|| self.unlike("a whole number", k))
    }

    /// How many follow: no more than there are parameters.
    pub fn count(&self, k: usize) -> Result<usize, Wrong> {
        let found = self.integer(k)?;
        let good = usize::try_from(found).ok().filter(|n| *n <= self.len());
        good.ok_or_else(|| self.wrong(format!("says that {found} follow, but has {} parameters", self.len())))
    }

    /// The entity that it names; `None` for 0.
    pub fn optional(&self, k: usize) -> Result<Option<u64>, Wrong> {
        match self.integer(k)? {
            0 => Ok(None),
            n => match u64::try_from(n) {
                Ok(n) => Ok(Some(n)),
                Err(_) => Err(self.unlike("the number of an entity", k)),
            },
        }
    }

    /// The entity that it names.
    pub fn pointer(&self, k: usize) -> Result<u64, Wrong> {
        self.optional(k)?.ok_or_else(|| self.unlike("the number of an entity", k))
    }

    /// A number; 0 where it is left out.
    pub fn real(&self, k: usize) -> Result<f64, Wrong> {
        let word = self.word(k);
        let value = if word.is_empty() { Some(0.0) } else { whole_number(word, b'.') };
        value.filter(|x| x.is_finite()).ok_or_else(|| self.unlike("a number", k))
    }

    /// So many numbers from `k` on.
    pub fn reals(&self, k: usize, count: usize) -> Result<Vec<f64>, Wrong> {
        let end = k.checked_add(count).filter(|end| *end <= self.len());
        let Some(end) = end else {
            let there = self.len().saturating_sub(k);
            return Err(self.wrong(format!("is cut short: {count} numbers declared, {there} present")));
        };
        (k..end).map(|k| self.real(k)).collect()
    }

    /// Three numbers.
    pub fn triple(&self, k: usize) -> Result<Point, Wrong> {
        Ok([self.real(k)?, self.real(k + 1)?, self.real(k + 2)?])
    }

    fn unlike(&self, expected: &str, k: usize) -> Wrong {
        self.wrong(format!(
            "has {} where {expected} is expected, as parameter {}",
            crate::error::quoted(self.word(k)),
            k + 1
        ))
    }
}

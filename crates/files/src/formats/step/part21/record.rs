//! The parameters of an entity by their place, and what is wrong with them.

use super::lines::Lines;
use super::text;
use super::value::{Value, whole};
use crate::formats::brep::Wrong;

/// A keyword with its parameters.
#[derive(Clone, Copy)]
pub(in super::super) struct Record<'f> {
    pub(super) lines: &'f Lines<'f>,
    /// The values of the file, of which lists are parts.
    pub(super) all: &'f [Value<'f>],
    pub(super) entity: u64,
    pub(super) at: usize,
    /// Upper case.
    pub keyword: &'f str,
    /// Its parameters.
    pub values: &'f [Value<'f>],
}

impl<'f> Record<'f> {
    /// A fault of the entity.
    pub fn wrong(&self, reason: impl Into<String>) -> Wrong {
        Wrong { entity: self.entity, line: self.lines.line(self.at), reason: reason.into() }
    }

    /// The fault of a parameter, counted from 0.
    fn unlike(&self, index: usize, expected: &str) -> Wrong {
        self.wrong(format!("has no {expected} as parameter {} of {}", index + 1, self.keyword))
    }

    /// The values of a list, of what stands in brackets behind a keyword too.
    pub fn items(&self, value: Value<'f>) -> Option<&'f [Value<'f>]> {
        match value {
            Value::List(run) => Some(run.of(self.all)),
            Value::Typed(run) => run.of(self.all).get(1..),
            _ => None,
        }
    }

    /// A number, of what stands in brackets behind a keyword too.
    pub fn number(&self, value: Value<'f>) -> Option<f64> {
        match value {
            Value::Integer(n) => Some(n as f64),
            Value::Real(x) => Some(x),
            // A value has one keyword: within its brackets there is no other one.
            Value::Typed(_) => match self.items(value)?.first()? {
                Value::Integer(n) => Some(*n as f64),
                Value::Real(x) => Some(*x),
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether parameter `index` is left out.
    pub fn is_absent(&self, index: usize) -> bool {
        matches!(self.values.get(index), None | Some(Value::Nothing))
    }

    /// The number of the entity that parameter `index` refers to, if it does.
    pub fn reference(&self, index: usize) -> Option<u64> {
        match self.values.get(index) {
            Some(Value::Reference(n)) => Some(*n),
            _ => None,
        }
    }

    /// The number of the entity that parameter `index` must refer to.
    pub fn entity(&self, index: usize) -> Result<u64, Wrong> {
        self.reference(index).ok_or_else(|| self.unlike(index, "reference"))
    }

    /// Parameter `index`: a finite number.
    pub fn real(&self, index: usize) -> Result<f64, Wrong> {
        let number = self.values.get(index).and_then(|v| self.number(*v));
        number.filter(|x| x.is_finite()).ok_or_else(|| self.unlike(index, "finite number"))
    }

    /// Parameter `index`: a number that is not below 0.
    pub fn count(&self, index: usize) -> Result<usize, Wrong> {
        let count = self.values.get(index).and_then(|v| whole(*v));
        count.ok_or_else(|| self.unlike(index, "whole number"))
    }

    /// Parameter `index`: a list.
    pub fn list(&self, index: usize) -> Result<&'f [Value<'f>], Wrong> {
        let list = self.values.get(index).and_then(|v| self.items(*v));
        list.ok_or_else(|| self.unlike(index, "list"))
    }

    /// Parameter `index`: a list of references.
    pub fn entities(&self, index: usize) -> Result<impl ExactSizeIterator<Item = u64> + Clone + 'f, Wrong> {
        let list = self.list(index)?;
        let reference = |v: &Value| match v {
            Value::Reference(n) => Some(*n),
            _ => None,
        };
        match list.iter().all(|v| reference(v).is_some()) {
            true => Ok(list.iter().map(move |v| reference(v).unwrap_or_default())),
            false => Err(self.unlike(index, "list of references")),
        }
    }

    /// Parameter `index`: true or false.
    pub fn truth(&self, index: usize) -> Result<bool, Wrong> {
        match self.values.get(index) {
            Some(Value::Word(b"T" | b"t")) => Ok(true),
            Some(Value::Word(b"F" | b"f")) => Ok(false),
            _ => Err(self.unlike(index, ".T. or .F.")),
        }
    }

    /// Parameter `index` in upper case, if it is a word between points.
    pub fn word(&self, index: usize) -> Option<String> {
        match self.values.get(index) {
            Some(Value::Word(word)) => Some(String::from_utf8_lossy(word).to_ascii_uppercase()),
            _ => None,
        }
    }

    /// Parameter `index` as text; empty where it is none.
    pub fn text(&self, index: usize) -> String {
        match self.values.get(index) {
            Some(Value::Text(raw)) => text::decoded(raw),
            _ => String::new(),
        }
    }
}

//! What is wrong with a value of a plan, before it is put into words.

use serde::de::{Error, Expected, Unexpected};
use std::fmt;
use std::ops::Range;

/// A fault and its place.
#[derive(Debug)]
pub(super) struct Fault {
    pub kind: Box<Kind>,
    /// Bytes of the text.
    pub span: Option<Range<usize>>,
}

/// What is wrong.
#[derive(Debug)]
pub(super) enum Kind {
    /// A key or word is none of a list.
    Unknown {
        /// What it should be.
        what: &'static str,
        word: String,
        known: &'static [&'static str],
    },
    /// A key is not there.
    Missing(&'static str),
    /// A value is of another type; `message` is the reader's, for types that have no words here.
    Type { wanted: Option<Wanted>, message: String },
    /// A list has so many elements.
    Length { found: usize, wanted: Option<Wanted>, message: String },
    /// What the value's own reading says.
    Said(String),
}

/// What a value should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    Number,
    Text,
    Bool,
    Whole,
    List,
    Several(usize),
    Table,
    Word,
}

impl Fault {
    /// The same, where nothing closer has said what was wanted.
    pub fn wanting(mut self, asked: Option<Wanted>) -> Fault {
        if let Kind::Type { wanted, .. } | Kind::Length { wanted, .. } = &mut *self.kind {
            *wanted = wanted.or(asked);
        }
        self
    }

    /// The same, at this place where it has no closer one.
    pub fn within(mut self, span: &Range<usize>) -> Fault {
        self.span.get_or_insert_with(|| span.clone());
        self
    }
}

impl From<Kind> for Fault {
    fn from(kind: Kind) -> Fault {
        Fault { kind: Box::new(kind), span: None }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{:?}", self.kind)
    }
}

impl std::error::Error for Fault {}

impl Error for Fault {
    fn custom<T: fmt::Display>(message: T) -> Fault {
        Kind::Said(message.to_string()).into()
    }
    fn invalid_type(found: Unexpected, wanted: &dyn Expected) -> Fault {
        let message = format!("invalid type: {found}, expected {wanted}");
        Kind::Type { wanted: None, message }.into()
    }
    fn invalid_value(found: Unexpected, wanted: &dyn Expected) -> Fault {
        let message = format!("invalid value: {found}, expected {wanted}");
        Kind::Type { wanted: None, message }.into()
    }
    fn invalid_length(found: usize, wanted: &dyn Expected) -> Fault {
        let message = format!("invalid length {found}, expected {wanted}");
        Kind::Length { found, wanted: None, message }.into()
    }
    fn unknown_variant(word: &str, known: &'static [&'static str]) -> Fault {
        Kind::Unknown { what: "value", word: word.into(), known }.into()
    }
    fn unknown_field(word: &str, known: &'static [&'static str]) -> Fault {
        Kind::Unknown { what: "field", word: word.into(), known }.into()
    }
    fn missing_field(key: &'static str) -> Fault {
        Kind::Missing(key).into()
    }
}

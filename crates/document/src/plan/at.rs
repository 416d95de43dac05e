//! Values that know where in the text they stand.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

/// A value and the bytes of the text that it was read from.
#[derive(Clone, Debug, PartialEq)]
pub struct At<T> {
    /// The value.
    pub value: T,
    /// Its bytes.
    pub span: Range<usize>,
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for At<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<At<T>, D::Error> {
        from.deserialize_struct(AT, &["start", "end", "value"], Placed(PhantomData))
    }
}

/// The name by which a value asks the reader for its place: first byte, byte behind the last, and the value itself.
pub(super) const AT: &str = "$at";

/// Takes a value with its place.
struct Placed<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Placed<T> {
    type Value = At<T>;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a value with its place")
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut from: A) -> Result<At<T>, A::Error> {
        let missing = |n: usize| A::Error::invalid_length(n, &"a value with its place");
        let start = from.next_element()?.ok_or_else(|| missing(0))?;
        let end = from.next_element()?.ok_or_else(|| missing(1))?;
        let value = from.next_element()?.ok_or_else(|| missing(2))?;
        Ok(At { value, span: start..end })
    }
}

impl<T: JsonSchema> JsonSchema for At<T> {
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
    fn inline_schema() -> bool {
        T::inline_schema()
    }
}

//! Reads values from TOML. What is wrong with one is a [`Fault`] that knows its place.

use super::at::AT;
use super::error::PlanError;
use super::fault::{Fault, Kind, Wanted};
use serde::Deserializer;
use serde::de::value::{StrDeserializer, UsizeDeserializer};
use serde::de::{
    DeserializeOwned, DeserializeSeed, EnumAccess, Error, IntoDeserializer, MapAccess, SeqAccess, Unexpected,
    VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any as forward;
use std::ops::Range;
use toml::de::{DeString, DeTable, DeValue};

/// The value that a text in TOML has.
pub(super) fn read<T: DeserializeOwned>(text: &str) -> Result<T, PlanError> {
    let table = DeTable::parse(text).map_err(|e| PlanError::of_toml(text, &e))?;
    let span = table.span();
    let root = Node { value: DeValue::Table(table.into_inner()), span };
    T::deserialize(root).map_err(|fault| PlanError::of_fault(text, fault))
}

/// A value and its bytes.
struct Node<'i> {
    value: DeValue<'i>,
    span: Range<usize>,
}

impl<'i> From<toml::Spanned<DeValue<'i>>> for Node<'i> {
    fn from(value: toml::Spanned<DeValue<'i>>) -> Node<'i> {
        Node { span: value.span(), value: value.into_inner() }
    }
}

impl<'i> Node<'i> {
    /// The value; a fault that its type finds after all of it was read lies here.
    fn read<T: DeserializeSeed<'i>>(self, seed: T) -> Result<T::Value, Fault> {
        let span = self.span.clone();
        seed.deserialize(self).map_err(|fault| fault.within(&span))
    }

    /// What a visitor makes of it, where this is `wanted`.
    fn visited<V: Visitor<'i>>(self, visitor: V, wanted: Option<Wanted>) -> Result<V::Value, Fault> {
        let span = self.span;
        let found = match self.value {
            DeValue::String(DeString::Owned(text)) => visitor.visit_string(text),
            DeValue::String(DeString::Borrowed(text)) => visitor.visit_borrowed_str(text),
            DeValue::Integer(n) => match i128::from_str_radix(n.as_str(), n.radix()) {
                Ok(n) => match (i64::try_from(n), u64::try_from(n)) {
                    (Ok(n), _) => visitor.visit_i64(n),
                    (_, Ok(n)) => visitor.visit_u64(n),
                    _ => visitor.visit_i128(n),
                },
                Err(_) => Err(Kind::Said("integer number overflowed".into()).into()),
            },
            DeValue::Float(x) => match x.as_str().parse::<f64>() {
                Ok(number) if number.is_finite() || x.as_str().contains("inf") || number.is_nan() => {
                    visitor.visit_f64(number)
                }
                _ => Err(Kind::Said("floating-point number overflowed".into()).into()),
            },
            DeValue::Boolean(is) => visitor.visit_bool(is),
            // Nothing of a plan is a date.
            DeValue::Datetime(_) if wanted == Some(Wanted::Table) => {
                Err(Fault::invalid_type(Unexpected::Other("a date"), &visitor))
            }
            DeValue::Datetime(_) => visitor.visit_map(Entries { rest: std::iter::empty(), value: None }),
            DeValue::Array(all) => visitor.visit_seq(Elements(all.into_iter())),
            DeValue::Table(all) => visitor.visit_map(Entries { rest: all.into_iter(), value: None }),
        };
        found.map_err(|fault: Fault| fault.wanting(wanted).within(&span))
    }
}

impl<'de> Deserializer<'de> for Node<'de> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.visited(visitor, None)
    }
    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.visited(visitor, Some(Wanted::Bool))
    }
    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.visited(visitor, Some(Wanted::Whole))
    }
    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.visited(visitor, Some(Wanted::Whole))
    }
    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.visited(visitor, Some(Wanted::Number))
    }
    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.visited(visitor, Some(Wanted::Text))
    }
    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.visited(visitor, Some(Wanted::List))
    }
    fn deserialize_tuple<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value, Fault> {
        self.visited(visitor, Some(Wanted::Several(len)))
    }
    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }
    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match name {
            AT => visitor.visit_seq(Placed { next: 0, span: self.span.clone(), node: Some(self) }),
            _ => self.visited(visitor, Some(Wanted::Table)),
        }
    }
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let span = self.span;
        let found = match self.value {
            DeValue::String(word) => visitor.visit_enum(IntoDeserializer::<Fault>::into_deserializer(&*word)),
            DeValue::Table(all) => match all.len() {
                0 => Err(Kind::Said("wanted exactly 1 element, found 0 elements".into()).into()),
                1 => visitor.visit_enum(Entries { rest: all.into_iter(), value: None }),
                _ => Err(Kind::Said("wanted exactly 1 element, more than 1 element".into()).into()),
            },
            _ => {
                Err(Kind::Type { wanted: Some(Wanted::Word), message: "wanted string or table".into() }
                    .into())
            }
        };
        found.map_err(|fault: Fault| fault.within(&span))
    }

    forward! {
        u8 u16 u128 i8 i16 i32 i64 i128 f32 char str bytes byte_buf map unit
        ignored_any unit_struct tuple_struct identifier
    }
}

/// The elements of a list.
struct Elements<I>(I);

impl<'i, I: Iterator<Item = toml::Spanned<DeValue<'i>>>> SeqAccess<'i> for Elements<I> {
    type Error = Fault;
    fn next_element_seed<T: DeserializeSeed<'i>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        self.0.next().map(|value| Node::from(value).read(seed)).transpose()
    }
}

/// The entries of a table.
struct Entries<'i, I> {
    rest: I,
    value: Option<toml::Spanned<DeValue<'i>>>,
}

type Entry<'i> = (toml::Spanned<DeString<'i>>, toml::Spanned<DeValue<'i>>);

/// The key of an entry.
fn key<'i, K: DeserializeSeed<'i>>(key: &toml::Spanned<DeString>, seed: K) -> Result<K::Value, Fault> {
    let read = seed.deserialize(StrDeserializer::<Fault>::new(key.get_ref()));
    read.map_err(|fault| fault.within(&key.span()))
}

impl<'i, I: Iterator<Item = Entry<'i>>> MapAccess<'i> for Entries<'i, I> {
    type Error = Fault;
    fn next_key_seed<K: DeserializeSeed<'i>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        let Some((name, value)) = self.rest.next() else { return Ok(None) };
        self.value = Some(value);
        key(&name, seed).map(Some)
    }
    fn next_value_seed<T: DeserializeSeed<'i>>(&mut self, seed: T) -> Result<T::Value, Fault> {
        let value = self.value.take().ok_or(Kind::Said("there is no value".into()))?;
        Node::from(value).read(seed)
    }
}

impl<'i, I: Iterator<Item = Entry<'i>>> EnumAccess<'i> for Entries<'i, I> {
    type Error = Fault;
    type Variant = Node<'i>;
    fn variant_seed<T: DeserializeSeed<'i>>(mut self, seed: T) -> Result<(T::Value, Node<'i>), Fault> {
        let (name, value) = self.rest.next().ok_or(Kind::Said("there is no variant".into()))?;
        Ok((key(&name, seed)?, Node::from(value)))
    }
}

/// What a word written as a table has: nothing, as all words are without.
impl<'i> VariantAccess<'i> for Node<'i> {
    type Error = Fault;
    fn unit_variant(self) -> Result<(), Fault> {
        let message = match &self.value {
            DeValue::Array(all) if all.is_empty() => return Ok(()),
            DeValue::Table(all) if all.is_empty() => return Ok(()),
            DeValue::Array(_) => "expected empty array".into(),
            DeValue::Table(_) => "expected empty table".into(),
            other => format!("expected table, found {}", other.type_str()),
        };
        Err(Fault::from(Kind::Said(message)).within(&self.span))
    }
    fn newtype_variant_seed<T: DeserializeSeed<'i>>(self, seed: T) -> Result<T::Value, Fault> {
        seed.deserialize(self)
    }
    fn tuple_variant<V: Visitor<'i>>(self, len: usize, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_tuple(len, visitor)
    }
    fn struct_variant<V: Visitor<'i>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_struct("", fields, visitor)
    }
}

/// A value between its place: first byte, byte behind the last, the value.
struct Placed<'i> {
    next: usize,
    span: Range<usize>,
    node: Option<Node<'i>>,
}

impl<'i> SeqAccess<'i> for Placed<'i> {
    type Error = Fault;
    fn next_element_seed<T: DeserializeSeed<'i>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        self.next += 1;
        let number = |n: usize| UsizeDeserializer::<Fault>::new(n);
        match self.next {
            1 => seed.deserialize(number(self.span.start)).map(Some),
            2 => seed.deserialize(number(self.span.end)).map(Some),
            _ => self.node.take().map(|node| node.read(seed)).transpose(),
        }
    }
}

//! Values of requests that are written as one text, on a command line and in JSON alike.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt::{self, Display};
use std::str::FromStr;
use trueness_files::{FORMATS, Format};

/// A value by its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text<T> {
    /// As it was written.
    text: String,
    /// What it means.
    pub value: T,
}

impl<T: FromStr> FromStr for Text<T> {
    type Err = T::Err;
    fn from_str(text: &str) -> Result<Text<T>, T::Err> {
        Ok(Text { text: text.to_string(), value: text.parse()? })
    }
}

impl<T> Serialize for Text<T> {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.serialize_str(&self.text)
    }
}

impl<'de, T: FromStr<Err: Display>> Deserialize<'de> for Text<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Text<T>, D::Error> {
        String::deserialize(from)?.parse().map_err(Error::custom)
    }
}

impl<T> JsonSchema for Text<T> {
    fn schema_name() -> Cow<'static, str> {
        "Text".into()
    }
    fn inline_schema() -> bool {
        true
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string" })
    }
}

/// The name of a format that is read.
#[derive(Clone, Copy, Debug)]
pub struct FormatName(pub &'static Format);

impl PartialEq for FormatName {
    fn eq(&self, other: &FormatName) -> bool {
        self.0.name == other.0.name
    }
}

impl FromStr for FormatName {
    type Err = NoFormat;
    fn from_str(name: &str) -> Result<FormatName, NoFormat> {
        Format::named(name).filter(|f| f.reads()).map(FormatName).ok_or(NoFormat)
    }
}

/// No format that is read has this name.
#[derive(Debug)]
pub struct NoFormat;

impl Display for NoFormat {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let known: Vec<&str> = FORMATS.iter().filter(|f| f.reads()).map(|f| f.name).collect();
        write!(f, "there is no such format to read; there are {}", known.join(", "))
    }
}

impl std::error::Error for NoFormat {}

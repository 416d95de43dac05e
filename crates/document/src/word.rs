//! Enums in result documents, by the names that they have everywhere.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::cmp::Ordering;
use std::fmt::{Debug, Display, Formatter};
use std::ops::Deref;

/// One of few things, each with a name.
pub trait Named: Copy + PartialEq + Debug + 'static {
    /// What a reader that knows none of these is told that it should have been.
    const WHAT: &'static str;
    /// All of them.
    fn all() -> &'static [Self];
    /// Its name. Two may share one where another key of the document tells them apart: `circle` in the plane and in space.
    fn name(self) -> &'static str;
}

/// One of few things, of which documents hold the name as a string. As a key it is in the order of the names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word<T>(pub T);

impl<T> Deref for Word<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: Named> Display for Word<T> {
    fn fmt(&self, f: &mut Formatter) -> std::fmt::Result {
        f.pad(self.0.name())
    }
}

impl<T: Named + Eq> Ord for Word<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.name().cmp(other.0.name())
    }
}

impl<T: Named + Eq> PartialOrd for Word<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T: Named> Serialize for Word<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.0.name())
    }
}

impl<'de, T: Named> Deserialize<'de> for Word<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = Cow::<'_, str>::deserialize(deserializer)?;
        let found = T::all().iter().find(|known| known.name() == name);
        found.map(|known| Word(*known)).ok_or_else(|| {
            let known: Vec<&str> = T::all().iter().map(|known| known.name()).collect();
            D::Error::custom(format!("\u{201c}{name}\u{201d} is no {}: {}", T::WHAT, known.join(", ")))
        })
    }
}

/// In schemas a plain string.
impl<T> JsonSchema for Word<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        String::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        String::json_schema(generator)
    }
}

/// Gives things names for documents: `named!(Type, "what", Type::ALL, |t| t.name());`.
macro_rules! named {
    ($type:ty, $what:literal, $all:expr, $name:expr) => {
        impl $crate::word::Named for $type {
            const WHAT: &'static str = $what;
            fn all() -> &'static [Self] {
                &$all
            }
            fn name(self) -> &'static str {
                let name: fn($type) -> &'static str = $name;
                name(self)
            }
        }
    };
}
pub(crate) use named;

/// Makes an enum of words: its variants with their names, and the list of all; `"what"` is what a reader is told that an unknown name is none
/// of.
macro_rules! words {
    ($(#[$meta:meta])* $name:ident, $what:literal, { $($(#[$about:meta])* $variant:ident = $word:literal,)* }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum $name {
            $($(#[$about])* $variant,)*
        }

        impl $name {
            /// All of them.
            pub const ALL: [$name; [$($name::$variant),*].len()] = [$($name::$variant),*];

            /// Its name in documents.
            pub fn name(self) -> &'static str {
                match self {
                    $($name::$variant => $word,)*
                }
            }
        }

        $crate::word::named!($name, $what, $name::ALL, |word| word.name());
    };
}
pub(crate) use words;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curvature::NoCurvature;
    use crate::shape::FitMethod as Method;
    use std::collections::BTreeMap;

    #[test]
    fn words_are_strings_and_come_back() {
        for method in Method::ALL {
            let text = serde_json::to_string(&Word(method)).unwrap();
            assert_eq!(text, format!("\"{}\"", method.name()));
            assert_eq!(serde_json::from_str::<Word<Method>>(&text).unwrap(), Word(method));
        }
        let error = serde_json::from_str::<Word<Method>>("\"best\"").unwrap_err().to_string();
        assert!(error.contains("is no method of a fit: gaussian, minimum-zone,"), "{error}");
        assert_eq!(
            schemars::schema_for!(Word<Method>).get("type"),
            schemars::schema_for!(String).get("type")
        );
    }

    #[test]
    fn keys_are_in_the_order_of_their_names() {
        let all: BTreeMap<Word<NoCurvature>, u8> = NoCurvature::ALL.map(|why| (Word(why), 1)).into();
        let by_name: BTreeMap<&str, u8> = NoCurvature::ALL.map(|why| (why.name(), 1)).into();
        assert_eq!(serde_json::to_string(&all).unwrap(), serde_json::to_string(&by_name).unwrap());
    }
}

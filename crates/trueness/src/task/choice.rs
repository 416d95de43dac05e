//! Values of requests that are one word of a few.

/// One word of a few.
pub trait Choice: Copy + PartialEq + Send + Sync + 'static {
    /// All of them, each with its word and a sentence for help texts, without full stop; empty where the word says it.
    const ALL: &'static [(Self, &'static str, &'static str)];

    /// The one of this word.
    fn named(word: &str) -> Option<Self> {
        Self::ALL.iter().find(|(_, name, _)| *name == word).map(|(choice, ..)| *choice)
    }

    /// Its word.
    fn word(self) -> &'static str {
        Self::ALL.iter().find(|(choice, ..)| *choice == self).map_or("", |(_, name, _)| name)
    }
}

/// Defines choices: each variant with its word and what it means. The first is the default.
macro_rules! choices {
    ($(#[$about:meta])* pub enum $name:ident { $first:ident = $first_word:literal: $first_help:literal, $($variant:ident = $word:literal: $help:literal),* $(,)? }) => {
        $(#[$about])*
        #[allow(clippy::empty_docs, reason = "a word may say it all")]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        pub enum $name {
            #[doc = $first_help]
            #[default]
            #[serde(rename = $first_word)]
            $first,
            $(
                #[doc = $help]
                #[serde(rename = $word)]
                $variant,
            )*
        }

        impl $crate::task::Choice for $name {
            const ALL: &'static [($name, &'static str, &'static str)] =
                &[($name::$first, $first_word, $first_help), $(($name::$variant, $word, $help)),*];
        }
    };
}
pub(crate) use choices;

#[cfg(test)]
mod tests {
    use super::*;

    choices! {
        /// Which end.
        pub enum End {
            Low = "low": "The lower one",
            High = "high": "The higher one",
        }
    }

    #[test]
    fn words_are_those_of_json() {
        assert_eq!(
            (End::named("high"), End::High.word(), End::named("High")),
            (Some(End::High), "high", None)
        );
        assert_eq!(serde_json::to_string(&End::default()).unwrap(), "\"low\"");
        assert_eq!(serde_json::from_str::<End>("\"high\"").unwrap(), End::High);
    }
}

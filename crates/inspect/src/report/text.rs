//! The page's words in four languages.

use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A language of the page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    En,
    /// German.
    De,
    /// Russian.
    Ru,
    /// Chinese, simplified.
    Zh,
}

impl Language {
    /// All, in the order of the table's columns.
    pub const ALL: [Language; 4] = [Language::En, Language::De, Language::Ru, Language::Zh];

    /// The `lang` attribute.
    pub fn code(self) -> &'static str {
        match self {
            Language::En => "en",
            Language::De => "de",
            Language::Ru => "ru",
            Language::Zh => "zh-Hans",
        }
    }

    /// The language of a code such as `de`, `de_DE.UTF-8` or `zh-Hans`; `None` for one we do not speak.
    pub fn from_code(code: &str) -> Option<Language> {
        let start = code.get(..2)?.to_ascii_lowercase();
        Language::ALL.into_iter().find(|l| l.code().starts_with(&start))
    }
}

/// The word for `key`; the key itself where the table has none, which a test forbids.
pub fn word(key: &str, language: Language) -> &str {
    static WORDS: LazyLock<BTreeMap<&str, [&str; 4]>> =
        LazyLock::new(|| lines().map(|[key, words @ ..]| (key, words)).collect());
    WORDS.get(key).map_or(key, |words| words[language as usize])
}

/// The whole table as `{language: {key: word}}`, for the script.
pub fn table() -> Value {
    let of = |l: Language| Map::from_iter(lines().map(|c| (c[0].to_string(), json!(c[1 + l as usize]))));
    Value::Object(Language::ALL.into_iter().map(|l| (l.code().to_string(), Value::Object(of(l)))).collect())
}

fn lines() -> impl Iterator<Item = [&'static str; 5]> {
    trueness_viewer::TEXTS.lines().filter_map(|line| {
        let mut columns = line.split('\t');
        Some([columns.next()?, columns.next()?, columns.next()?, columns.next()?, columns.next()?])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn languages_from_codes() {
        assert_eq!(Language::from_code("de_DE.UTF-8"), Some(Language::De));
        assert_eq!(Language::from_code("zh"), Some(Language::Zh));
        assert_eq!(Language::from_code("C"), None);
        assert_eq!(Language::from_code("fr"), None);
    }

    #[test]
    fn words_of_all_languages() {
        let words = Language::ALL.map(|l| word("verdict.fail", l));
        assert_eq!(words, ["Fail", "Nicht in Ordnung", "Не годен", "不合格"]);
        assert_eq!(table()["de"]["verdict.pass"], "In Ordnung");
    }
}

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
    /// Of every registry and list of words whose entries pages name, in every language: nothing new is shown by its bare name.
    #[test]
    fn every_entry_has_its_words() {
        use crate::NoValue;
        use trueness_document::Named;
        use trueness_document::check::Severity;
        use trueness_document::compare::SignBy;
        use trueness_document::curvature::NoCurvature;
        use trueness_document::section::{
            BEYOND_END, Continuity, DimensionKind, NO_OUTLINE, Positive, Taken,
        };
        use trueness_geom::check;
        use trueness_geom::shape;
        use trueness_section::SegmentKind;
        use trueness_solid::repair;
        fn of<T: Named>(before: &str) -> Vec<String> {
            T::all().iter().map(|entry| format!("{before}.{}", entry.name())).collect()
        }
        let parameters = shape::Kind::ALL.iter().flat_map(|kind| kind.parameters());
        let keys = [
            of::<Continuity>("join"),
            of::<DimensionKind>("dimension"),
            of::<NoCurvature>("reason"),
            of::<Positive>("nominal"),
            of::<SignBy>("sign.by"),
            of::<Taken>("taken"),
            of::<Severity>("severity"),
            of::<trueness_document::plan::Class>("shape"),
            [BEYOND_END, NO_OUTLINE].map(|reason| format!("nominal.{reason}")).to_vec(),
            [SegmentKind::Line, SegmentKind::Arc, SegmentKind::Spline]
                .map(|kind| format!("segment.{}", kind.name()))
                .to_vec(),
            NoValue::ALL.iter().map(|reason| format!("reason.{}", reason.name())).collect(),
            check::KINDS
                .iter()
                .chain(&trueness_measure::model_check::MODEL_KINDS)
                .flat_map(|k| [format!("defect.{}", k.name), format!("about.{}", k.name)])
                .collect(),
            repair::STEPS.iter().map(|step| format!("step.{}", step.name)).collect(),
            trueness_measure::characteristic::ALL
                .iter()
                .map(|kind| format!("kind.{}", kind.word()))
                .collect(),
            parameters.map(|(name, _)| format!("parameter.{name}")).collect(),
        ];
        let is_missing =
            |key: &String| Language::ALL.iter().any(|language| ["", key].contains(&word(key, *language)));
        let missing: Vec<String> = keys.concat().into_iter().filter(is_missing).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }
}

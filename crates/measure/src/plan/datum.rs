//! The datums of a characteristic: single ones, and common ones of several features.

use super::checker::Checker;
use crate::requirement::{DatumSpec, Feature, Source};
use trueness_document::plan::{At, CharacteristicText, Class, MaterialWord, PlanError, unknown};

/// Most features of a common datum.
const MAX_COMMON_FEATURES: usize = 3;

pub(super) fn datums(
    checker: &Checker,
    written: &CharacteristicText,
    own: &[usize],
    features: &[Feature],
) -> Result<Vec<DatumSpec>, PlanError> {
    let Some(list) = &written.datums else { return Ok(vec![]) };
    if list.value.len() > 3 {
        return checker.wrong(&list.span, "a datum system has up to three datums");
    }
    let mut all: Vec<DatumSpec> = Vec::new();
    for name in &list.value {
        let datum = datum(checker, name, features)?;
        for number in &datum.features {
            let feature = &features[*number];
            // A bearing seat may be part of the common datum of both: it is toleranced to the axis that they have together.
            if own.contains(number) && datum.features.len() == 1 {
                let what =
                    format!("\"{}\" is the toleranced feature; it cannot be its own datum", feature.id);
                return checker.wrong(&name.span, what);
            }
            let before = all.iter().flat_map(|d| &d.features);
            let within = datum.features.iter().filter(|n| *n == number).count();
            if before.filter(|n| *n == number).count() + within > 1 {
                return checker.wrong(&name.span, format!("datum \"{}\" is named twice", feature.id));
            }
            let derived = matches!(feature.source, Source::Derived { .. });
            if derived && list.value.len() > 1 {
                let what = "a derived feature can be a datum alone, but not in a system yet";
                return checker.wrong(&name.span, what);
            }
            if derived && datum.features.len() > 1 {
                return checker.wrong(&name.span, "a derived feature is no part of a common datum yet");
            }
        }
        all.push(datum);
    }
    Ok(all)
}

/// A datum as it is written, with features that can be one.
fn datum(checker: &Checker, name: &At<String>, features: &[Feature]) -> Result<DatumSpec, PlanError> {
    let (plain, material) = match known(&name.value, features) {
        Some(_) => (name.value.as_str(), None),
        None => requirement(&name.value),
    };
    let mut ways = Vec::new();
    read(plain, features, &mut Vec::new(), &mut ways);
    // No feature is meant twice, where there is another way to read it.
    let once = |way: &Vec<usize>| way.iter().enumerate().all(|(k, n)| !way[..k].contains(n));
    if ways.iter().any(once) {
        ways.retain(once);
    }
    let found = match ways.as_slice() {
        [one] => one.clone(),
        [] => {
            let names: Vec<&str> = features.iter().map(|f| f.id.as_str()).collect();
            let parts: Vec<&str> = plain.split('-').collect();
            if parts.len() > MAX_COMMON_FEATURES && parts.iter().all(|p| known(p, features).is_some()) {
                return checker.wrong(&name.span, "a common datum has up to three features");
            }
            let strange = parts.iter().find(|p| known(p, features).is_none()).filter(|_| parts.len() > 1);
            return checker.wrong(&name.span, unknown("feature", strange.unwrap_or(&plain), &names));
        }
        _ => {
            let what = format!("\"{plain}\" can be read as common datums of different features; rename one");
            return checker.wrong(&name.span, what);
        }
    };
    let classes: Vec<Class> = found.iter().map(|n| features[*n].class).collect();
    if let Some(class) = classes.iter().find(|c| matches!(c, Class::Circle | Class::Torus)) {
        return checker.wrong(&name.span, format!("a {} cannot be a datum here", class.word()));
    }
    let only = |these: &[Class]| classes.iter().all(|c| these.contains(c));
    if found.len() > 1 && !only(&[Class::Plane]) && !only(&[Class::Cylinder, Class::Line]) {
        let what = "a common datum is made of planes, or of cylinders and lines, and of nothing else yet";
        return checker.wrong(&name.span, what);
    }
    Ok(DatumSpec { features: found, material, boundary: None })
}

fn known(name: &str, features: &[Feature]) -> Option<usize> {
    features.iter().position(|f| f.id == name)
}

/// The name without its material requirement.
fn requirement(name: &str) -> (&str, Option<MaterialWord>) {
    for word in [MaterialWord::M, MaterialWord::L] {
        let end = format!("({})", word.word());
        if let Some(plain) = name.strip_suffix(&end) {
            return (plain.trim_end(), Some(word));
        }
    }
    (name, None)
}

/// All ways to read a name as features with dashes between: names may have dashes of their own.
fn read(name: &str, features: &[Feature], before: &mut Vec<usize>, ways: &mut Vec<Vec<usize>>) {
    if before.len() == MAX_COMMON_FEATURES {
        return;
    }
    let ends = name.match_indices('-').map(|(at, _)| at).chain([name.len()]);
    for end in ends {
        let Some(number) = known(&name[..end], features) else { continue };
        before.push(number);
        match name.get(end + 1..) {
            None => ways.push(before.clone()),
            Some(rest) => read(rest, features, before, ways),
        }
        before.pop();
    }
}

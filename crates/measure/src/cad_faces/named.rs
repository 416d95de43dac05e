//! Faces by their number or name.

use super::faces::CadFaces;
use std::collections::BTreeSet;
use trueness_document::plan::unknown;

/// Faces that a plan names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceChoice {
    /// Numbers of their entities; none where they go by a name.
    pub numbers: Vec<u64>,
    /// The name of all of them.
    pub name: Option<String>,
    /// The instance that they are of.
    pub instance: Option<String>,
}

/// Why there are no such faces.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoFace {
    /// No face has the number.
    #[error(
        "the reference has no face {number}; it has {count} faces, from {first} to {last}, and the nearest numbers are {near}"
    )]
    Number {
        /// The number.
        number: u64,
        /// How many there are.
        count: usize,
        /// The least number.
        first: u64,
        /// The greatest one.
        last: u64,
        /// Some numbers near to it.
        near: String,
    },
    /// No face was read.
    #[error("no face of the reference was read")]
    Nothing,
    /// The face is in the file, and could not be read.
    #[error("face {number} of the reference could not be read: {why}")]
    Unread {
        /// Its number.
        number: u64,
        /// Why.
        why: String,
    },
    /// No face has the name.
    #[error("{0}")]
    Name(String),
    /// No face has any name.
    #[error("the faces of the reference have no names; give the number of a `face`")]
    Nameless,
    /// There is no such instance.
    #[error("{0}")]
    Instance(String),
    /// Several instances have it.
    #[error("{what} occurs in {count} instances; say which by `instance`: {paths}")]
    Instances {
        /// What.
        what: String,
        /// In how many.
        count: usize,
        /// Names of some.
        paths: String,
    },
}

/// Numbers, names and instances that a message lists at most.
const MAX_LISTED: usize = 5;
/// Names up to which a message lists all.
const MAX_LISTED_NAMES: usize = 40;

/// As [`unknown`], without a list of hundreds.
fn not_known(what: &str, word: &str, known: &[&str]) -> String {
    match known.len() > MAX_LISTED_NAMES {
        true => {
            let some = known[..MAX_LISTED].join(", ");
            format!("there is no {what} \"{word}\" (known: {} names, {some}, …)", known.len())
        }
        false => unknown(what, word, known),
    }
}

impl CadFaces {
    /// The faces that are asked for, ascending.
    ///
    /// # Errors
    /// [`NoFace`].
    pub fn chosen(&self, choice: &FaceChoice) -> Result<Vec<u32>, NoFace> {
        if self.faces.is_empty() {
            return Err(NoFace::Nothing);
        }
        let instance = choice.instance.as_ref().map(|path| self.instance(path)).transpose()?;
        let mut all = vec![];
        for number in &choice.numbers {
            all.extend(
                self.one(&format!("face {number}"), instance, |n| self.faces[n].entity == *number)?
                    .ok_or_else(|| self.no_number(*number))?,
            );
        }
        if let Some(name) = &choice.name {
            let own = self.one(&format!("name \"{name}\""), instance, |n| self.faces[n].name == *name)?;
            all.extend(own.ok_or_else(|| self.no_name(name))?);
        }
        all.sort_unstable();
        all.dedup();
        match all.iter().find_map(|n| Some((n, self.faces[*n as usize].missing.clone()?))) {
            Some((n, why)) => Err(NoFace::Unread { number: self.faces[*n as usize].entity, why }),
            None => Ok(all),
        }
    }

    /// The faces of one instance that fit; `None` where none does.
    fn one(
        &self,
        what: &str,
        instance: Option<u32>,
        fits: impl Fn(usize) -> bool,
    ) -> Result<Option<Vec<u32>>, NoFace> {
        let is_of = |n: &usize| instance.is_none_or(|i| self.faces[*n].instance == i) && fits(*n);
        let all: Vec<usize> = (0..self.faces.len()).filter(is_of).collect();
        let instances: BTreeSet<u32> = all.iter().map(|n| self.faces[*n].instance).collect();
        if instances.len() > 1 {
            let path =
                |i: &u32| format!("\"{}\"", self.instances.get(*i as usize).map_or("", String::as_str));
            let paths: Vec<String> = instances.iter().take(MAX_LISTED).map(path).collect();
            let more = if instances.len() > MAX_LISTED { ", …" } else { "" };
            return Err(NoFace::Instances {
                what: what.into(),
                count: instances.len(),
                paths: format!("{}{more}", paths.join(", ")),
            });
        }
        Ok((!all.is_empty()).then(|| all.into_iter().map(|n| n as u32).collect()))
    }

    fn instance(&self, path: &str) -> Result<u32, NoFace> {
        let found = self.instances.iter().position(|own| own == path);
        let known: Vec<&str> = self.instances.iter().map(String::as_str).collect();
        found.map(|n| n as u32).ok_or_else(|| NoFace::Instance(not_known("instance", path, &known)))
    }

    fn no_number(&self, number: u64) -> NoFace {
        if let Some((_, why)) = self.unread.iter().find(|u| u.0 == number) {
            return NoFace::Unread { number, why: why.clone() };
        }
        let all: BTreeSet<u64> = self.faces.iter().map(|f| f.entity).collect();
        let mut near: Vec<u64> = all.iter().copied().collect();
        near.sort_by_key(|n| n.abs_diff(number));
        near.truncate(MAX_LISTED);
        near.sort_unstable();
        let near: Vec<String> = near.iter().map(u64::to_string).collect();
        let [first, last] = [all.first(), all.last()].map(|n| n.copied().unwrap_or(0));
        NoFace::Number { number, count: self.faces.len(), first, last, near: near.join(", ") }
    }

    fn no_name(&self, name: &str) -> NoFace {
        let known: BTreeSet<&str> =
            self.faces.iter().map(|f| f.name.as_str()).filter(|n| !n.is_empty()).collect();
        let known: Vec<&str> = known.into_iter().collect();
        if known.is_empty() { NoFace::Nameless } else { NoFace::Name(not_known("face", name, &known)) }
    }
}

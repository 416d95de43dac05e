//! A plan while it is made: what the reader of plans refuses becomes a comment.

use super::faces::{Faces, Group, median};
use super::text::{comment, listed, quoted};
use crate::plan::Plan;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use trueness_geom::shape::Kind;

/// How a plan begins in which one characteristic is tried.
const TRIAL: &str = "schema = \"trueness/plan/1\"\nmeasured = \"scan\"\nreference = \"model\"\n";

/// A feature of the plan.
struct Feature {
    text: String,
    /// Those that it is derived from.
    of: Vec<String>,
    /// Characteristics that material requirements on it go by.
    bounds: String,
}

/// A plan that grows.
pub(super) struct Draft<'f, 'm> {
    pub faces: &'f Faces<'m>,
    order: Vec<String>,
    features: BTreeMap<String, Feature>,
    /// Ids by the numbers of the faces.
    ids: BTreeMap<Vec<u64>, String>,
    /// What stands in the plan: other features are left out.
    used: BTreeSet<String>,
    body: String,
    /// Characteristics that the model contradicts, by their ids, and why.
    refused: &'f Refused,
}

/// Characteristics that a plan shall not have, by their ids, and why.
pub(super) type Refused = BTreeMap<String, String>;

impl<'f, 'm> Draft<'f, 'm> {
    /// One without features.
    pub fn of(faces: &'f Faces<'m>, refused: &'f Refused) -> Draft<'f, 'm> {
        Draft {
            faces,
            order: vec![],
            features: BTreeMap::new(),
            ids: BTreeMap::new(),
            used: BTreeSet::new(),
            body: String::new(),
            refused,
        }
    }

    /// A line for the reader.
    pub fn say(&mut self, text: &str) {
        self.body.push('\n');
        self.body.push_str(&comment(text));
    }

    /// The id of the feature of these faces; `wanted` is its name where it has none yet.
    pub fn feature(&mut self, group: &Group, wanted: Option<&str>) -> String {
        if let Some(id) = self.ids.get(&group.faces) {
            return id.clone();
        }
        let class = group.shape.kind().name();
        let first = group.faces.first().copied().unwrap_or_default();
        let wanted = wanted.filter(|id| !id.is_empty() && id.chars().all(char::is_alphanumeric));
        let names = [wanted.map(Into::into), Some(format!("{class} {first}"))];
        let free = names.into_iter().flatten().find(|id| !self.features.contains_key(id));
        let id = free.unwrap_or_else(|| format!("{class} {}", listed(&group.faces)));
        let mut text = format!("\n[[feature]]\nid = {}\nshape = \"{class}\"\n", quoted(&id));
        let _ = match group.faces.as_slice() {
            [one] => writeln!(text, "face = {one}"),
            several => writeln!(text, "face = [{}]", listed(several)),
        };
        if let Some((path, count)) = self.faces.instance(group) {
            let others = comment(&format!("the first of {count} instances"));
            let _ = writeln!(text, "{others}instance = {}", quoted(path));
        }
        if let Some(internal) = group.internal.filter(|_| group.shape.kind() == Kind::Cylinder) {
            let _ = writeln!(text, "internal = {internal}");
        }
        self.ids.insert(group.faces.clone(), id.clone());
        self.add(id.clone(), text, vec![]);
        id
    }

    /// Keeps a feature in the plan, whether a characteristic names it or not.
    pub fn keep(&mut self, id: &str) {
        let of = self.features.get(id).map(|f| f.of.clone()).unwrap_or_default();
        self.used.extend(of);
        self.used.insert(id.into());
    }

    /// The median plane of two opposite planes.
    pub fn median(&mut self, groups: &[Group]) -> Option<String> {
        median(groups)?;
        let of: Vec<String> = groups.iter().map(|g| self.feature(g, None)).collect();
        let id = format!("median of {}", of.join(" and "));
        if !self.features.contains_key(&id) {
            let names: Vec<String> = of.iter().map(|name| quoted(name)).collect();
            let text = format!(
                "\n[[feature]]\nid = {}\nderived = \"median-plane\"\nof = [{}]\n",
                quoted(&id),
                names.join(", ")
            );
            self.add(id.clone(), text, of);
        }
        Some(id)
    }

    fn add(&mut self, id: String, text: String, of: Vec<String>) {
        self.order.push(id.clone());
        self.features.insert(id, Feature { text, of, bounds: String::new() });
    }

    /// Adds a characteristic that names these features, with a line for the reader above it.
    ///
    /// # Errors
    /// Why plans cannot have it.
    pub fn characteristic(
        &mut self,
        said: &str,
        (id, lines): (&str, &str),
        features: &[String],
    ) -> Result<(), String> {
        if let Some(why) = self.refused.get(id) {
            return Err(why.clone());
        }
        let text = format!("\n{}[[characteristic]]\nid = {}\n{lines}", comment(said), quoted(id));
        let mut trial = TRIAL.to_string();
        let mut needed: Vec<&String> = features.iter().collect();
        let derived = features.iter().filter_map(|id| self.features.get(id)).flat_map(|f| &f.of);
        needed.extend(derived);
        let used: Vec<&Feature> = self
            .order
            .iter()
            .filter(|id| needed.contains(id))
            .filter_map(|id| self.features.get(id))
            .collect();
        used.iter().for_each(|f| trial.push_str(&f.text));
        used.iter().for_each(|f| trial.push_str(&f.bounds));
        trial.push_str(&text);
        Plan::parse(&trial).map_err(|e| e.what)?;
        // Material requirements go by the size, and by what the feature itself keeps to itself.
        if let [own] = features
            && let Some(feature) = self.features.get_mut(own)
            && lines.contains("kind = \"size\"")
        {
            feature.bounds.push_str(&text);
        }
        features.iter().for_each(|id| self.keep(id));
        self.body.push_str(&text);
        Ok(())
    }

    /// Whether it has a characteristic.
    pub fn is_judged(&self) -> bool {
        self.body.lines().any(|line| line == "[[characteristic]]")
    }

    /// The features, then what stands in the plan about them.
    pub fn finished(self) -> String {
        let used = self.order.iter().filter(|id| self.used.contains(*id));
        let features = used.filter_map(|id| self.features.get(id));
        features.map(|f| f.text.as_str()).chain([self.body.as_str()]).collect()
    }
}

//! The datums that a characteristic refers to.

use super::boundary::Boundary;
use super::feature::Feature;
use trueness_document::plan::MaterialWord;

/// A datum that can be associated.
#[derive(Clone, Debug, PartialEq)]
pub struct DatumSpec {
    /// Numbers of its features: one, or those of a common datum.
    pub features: Vec<usize>,
    /// Its material requirement.
    pub material: Option<MaterialWord>,
    /// The virtual condition that the requirement sets; its size has all tolerances in it.
    pub boundary: Option<Boundary>,
}

impl DatumSpec {
    /// As plans and results write it: `A`, `A-B`, `A(M)`.
    pub fn name(&self, features: &[Feature]) -> String {
        let names: Vec<&str> = self.features.iter().map(|n| features[*n].id.as_str()).collect();
        let requirement = self.material.map_or(String::new(), |m| format!("({})", m.word()));
        names.join("-") + &requirement
    }
}

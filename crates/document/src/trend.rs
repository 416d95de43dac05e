//! `trueness/trend/1`: one plan over many parts.

mod record;

pub use record::{Control, IndexRecord, OutOfControl, RuleRecord, TrendError, TrendRecord};

use super::place_map::TrendMap;
use super::result::ResultDocument;
use super::verdict::rank;
use super::{Verdict, overall};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name of this document's schema.
pub const SCHEMA: &str = "trueness/trend/1";

/// The whole document. Values in millimeters, of angles in degrees.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct TrendDocument {
    /// `trueness/trend/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Always `mm`.
    pub units: String,
    /// The plan's heading.
    pub title: Option<String>,
    /// The results read, in the order given: the order of the parts.
    pub inputs: Vec<ResultInput>,
    /// The parts, in the same order.
    pub parts: Vec<PartRecord>,
    /// What makes the results doubtful as results of one plan.
    pub warnings: Vec<String>,
    /// Confidence of the intervals: 0.95.
    pub confidence: f64,
    /// The characteristics, in the plan's order; then, where deviations from the reference are judged, the shares of points within
    /// tolerance, of kind `deviation` and in percent: of each region, then of all other points.
    pub characteristics: Vec<TrendRecord>,
    /// Mean and spread of the deviations over the part.
    pub map: Option<TrendMap>,
    /// Why there is none: results without deviations at places.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub map_reason: Option<String>,
    /// Whether no value of any characteristic is out of control.
    pub in_control: bool,
    /// The worst verdict of all parts.
    pub verdict: Verdict,
}

/// A result document that was read.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ResultInput {
    /// As given on the command line.
    pub path: String,
    /// Its schema.
    pub format: String,
    /// Size of the file.
    pub bytes: u64,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: Option<String>,
    /// Always `mm`: documents are in millimeters.
    pub unit_assumed: String,
}

/// A part.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PartRecord {
    /// Its first measured file; where results name none, or several the same one, the result.
    pub name: String,
    /// Its verdict.
    pub verdict: Verdict,
    /// That on its deviations from the reference; absent where they were not judged.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub deviation: Option<Verdict>,
}

impl ResultDocument for TrendDocument {
    /// Whether every part passes and no value is out of control.
    fn conforms(&self) -> bool {
        self.verdict == Verdict::Pass && self.in_control
    }
}

impl TrendDocument {
    /// Numbers of the characteristics in the order in which people look at them: by their worst verdict, then by how many
    /// parts have it, then what is out of control, then the least of Ppk.
    pub fn rows(&self) -> Vec<usize> {
        let of = |n: &usize| {
            let c = &self.characteristics[*n];
            let worst = c.verdict();
            let have = c.verdicts.iter().filter(|v| **v == worst && worst != Verdict::Pass).count();
            let last = (c.out_of_control.is_empty(), c.ppk.map_or(f64::INFINITY, |i| i.value));
            (std::cmp::Reverse((rank(worst), have)), last)
        };
        let mut rows: Vec<usize> = (0..self.characteristics.len()).collect();
        rows.sort_by(|a, b| {
            let (a, b) = (of(a), of(b));
            a.0.cmp(&b.0).then(a.1.0.cmp(&b.1.0)).then(a.1.1.total_cmp(&b.1.1))
        });
        rows
    }

    /// Numbers of the parts in the order in which people look at them: by verdict, then by how many characteristics have it.
    pub fn worst_parts(&self) -> Vec<usize> {
        let of = |n: &usize| {
            let worst = self.parts[*n].verdict;
            let have = self.characteristics.iter().filter(|c| c.verdicts.get(*n) == Some(&worst)).count();
            std::cmp::Reverse((rank(worst), if worst == Verdict::Pass { 0 } else { have }))
        };
        let mut parts: Vec<usize> = (0..self.parts.len()).collect();
        parts.sort_by_cached_key(of);
        parts
    }
}

impl TrendRecord {
    /// The worst verdict of all parts.
    pub fn verdict(&self) -> Verdict {
        overall(self.verdicts.iter().copied())
    }
}

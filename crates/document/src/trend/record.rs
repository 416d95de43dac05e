//! What a trend says of one characteristic, and why results make none.

use crate::Verdict;
use crate::inspect::Counts;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A characteristic over all parts.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct TrendRecord {
    /// Its name.
    pub id: String,
    /// What it is.
    pub kind: String,
    /// Its sign on drawings, where it has one.
    pub symbol: String,
    /// The toleranced feature.
    pub feature: String,
    /// The datums.
    pub datums: Vec<String>,
    /// Unit of the values: `mm`, `deg`, `1` or `%`.
    pub unit: String,
    /// Nominal value of a dimension.
    pub nominal: Option<f64>,
    /// Least allowed value of a dimension.
    pub lower: Option<f64>,
    /// Greatest allowed value; null where a material requirement allows each part its own.
    pub upper: Option<f64>,
    /// Its value of each part; null where it was not measured.
    pub values: Vec<Option<f64>>,
    /// Its verdict on each part.
    pub verdicts: Vec<Verdict>,
    /// Expanded uncertainty (k = 2) of each value; absent where no value has one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub uncertainties: Option<Vec<Option<f64>>>,
    /// From and to where the true value of each part lies: the `interval` of its result, or the value less and plus its uncertainty; absent
    /// where no value has one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub intervals: Option<Vec<Option<[f64; 2]>>>,
    /// Greatest allowed value of each part, where a material requirement allows each its own; else absent.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub own_upper: Option<Vec<f64>>,
    /// Number of parts by verdict.
    pub counts: Counts,
    /// Number of values.
    pub measured: u64,
    /// Their mean.
    pub mean: Option<f64>,
    /// Least value.
    pub min: Option<f64>,
    /// Greatest value.
    pub max: Option<f64>,
    /// Standard deviation of all values.
    pub std_dev: Option<f64>,
    /// Standard deviation within: by the moving ranges of two.
    pub std_dev_within: Option<f64>,
    /// Limits of the control charts of values and of moving ranges.
    pub control: Option<Control>,
    /// Why there is no course: fewer than two values.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub course_reason: Option<String>,
    /// Parts that are out of control.
    pub out_of_control: Vec<OutOfControl>,
    /// Tolerance over six standard deviations within; null of one limit.
    pub cp: Option<IndexRecord>,
    /// Distance of the mean from the nearer limit over three standard deviations within.
    pub cpk: Option<IndexRecord>,
    /// As `cp`, by the standard deviation of all values.
    pub pp: Option<IndexRecord>,
    /// As `cpk`, by the standard deviation of all values.
    pub ppk: Option<IndexRecord>,
    /// Why some or all of these are missing.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub capability_reason: Option<String>,
}

impl TrendRecord {
    /// The parts that are out of control, from 0, each once.
    pub fn signaled(&self) -> Vec<u64> {
        let mut parts: Vec<u64> = self.out_of_control.iter().map(|o| o.part).collect();
        parts.dedup();
        parts
    }
}

/// Limits of the control charts of individuals and moving ranges (ISO 7870-2).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Control {
    /// Lower control limit of values.
    pub lower: f64,
    /// Their mean.
    pub center: f64,
    /// Upper control limit of values.
    pub upper: f64,
    /// Mean moving range.
    pub moving_range: f64,
    /// Upper control limit of moving ranges.
    pub moving_range_upper: f64,
}

/// A part that is out of control.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct OutOfControl {
    /// Its number, from 0.
    pub part: u64,
    /// By which rule: `beyond`, `range`, `run` (nine on one side of the mean) or `steady` (six rising or falling).
    pub rule: RuleRecord,
}

/// A rule of control charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RuleRecord {
    /// The value is beyond a control limit.
    Beyond,
    /// Its distance from the value before is beyond the limit of moving ranges.
    Range,
    /// The ninth or a later one in a row on one side of the mean.
    Run,
    /// The sixth or a later one in a row of rising, or of falling values.
    Steady,
}

impl RuleRecord {
    /// What it says of a part.
    pub fn words(self) -> &'static str {
        match self {
            RuleRecord::Beyond => "beyond a control limit",
            RuleRecord::Range => "farther from the part before than moving ranges reach",
            RuleRecord::Run => "the ninth or a later one in a row on one side of the mean",
            RuleRecord::Steady => "the sixth or a later one in a row that rises or falls",
        }
    }
}

/// An index of capability with its confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct IndexRecord {
    /// The estimate.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Why results make no trend. Results are counted from 0, in the order given.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TrendError {
    /// There are none.
    #[error("there are no results")]
    None,
    /// A result is given twice.
    #[error("it is the same as result {}, to the last byte; give each part once", first + 1)]
    Twice {
        /// Which result.
        index: usize,
        /// Which one it repeats.
        first: usize,
    },
    /// A result contradicts itself.
    #[error("{what}; give the result as `trueness inspect --json` wrote it")]
    Changed {
        /// Which result.
        index: usize,
        /// What cannot be.
        what: String,
    },
    /// A result does not fit the first one.
    #[error("{what}; a trend is of results of one plan")]
    Different {
        /// Which result.
        index: usize,
        /// What is different.
        what: String,
    },
}

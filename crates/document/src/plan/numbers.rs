//! Numbers that no part has.

use super::error::PlanError;
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// What every number of a plan is below. Squares and products of larger ones would leave the numbers there are, and results would
/// hold what is none; in meters it is seven times the way to the sun.
const MAX_PLAN_NUMBER: f64 = 1e12;

/// Refuses the first number of a plan's text that no part has. What is not finite is refused where it is used, by its name.
pub(super) fn checked(text: &str) -> Result<(), PlanError> {
    let table = DeTable::parse(text).map_err(|e| PlanError::of_toml(text, &e))?;
    let mut found = vec![];
    table.get_ref().values().for_each(|value| huge(value.get_ref(), value.span(), &mut found));
    match found.into_iter().min_by_key(|span| span.start) {
        None => Ok(()),
        Some(span) => {
            let written = text.get(span.clone()).unwrap_or("this").trim();
            let what = format!("{written} is no number of a part; give less than {MAX_PLAN_NUMBER:e}");
            Err(PlanError::at(text, &span, what))
        }
    }
}

/// Adds where numbers in a value stand that are too large.
fn huge(value: &DeValue, span: Range<usize>, found: &mut Vec<Range<usize>>) {
    let number = match value {
        DeValue::Float(x) => x.as_str().parse::<f64>().ok(),
        DeValue::Integer(n) => i128::from_str_radix(n.as_str(), n.radix()).ok().map(|n| n as f64),
        DeValue::Array(all) => {
            all.iter().for_each(|v| huge(v.get_ref(), v.span(), found));
            None
        }
        DeValue::Table(all) => {
            all.values().for_each(|v| huge(v.get_ref(), v.span(), found));
            None
        }
        DeValue::String(_) | DeValue::Boolean(_) | DeValue::Datetime(_) => None,
    };
    if number.is_some_and(|x| x.is_finite() && x.abs() >= MAX_PLAN_NUMBER) {
        found.push(span);
    }
}

//! Reading with care: what is wrong is told with its place.

use std::ops::Range;
use trueness_document::plan::{At, PlanError};

/// A text under examination: what is wrong is told with its place.
pub(super) struct Checker<'a> {
    pub(super) text: &'a str,
    /// Millimeters in the plan's unit.
    pub(super) unit: f64,
}

impl Checker<'_> {
    pub(super) fn wrong<T>(&self, span: &Range<usize>, what: impl Into<String>) -> Result<T, PlanError> {
        Err(PlanError::at(self.text, span, what))
    }

    /// A finite length in millimeters.
    pub(super) fn length(&self, number: &At<f64>, what: &str) -> Result<f64, PlanError> {
        match number.value.is_finite() {
            true => Ok(number.value * self.unit),
            false => self.wrong(&number.span, format!("{what} is {}; give a finite number", number.value)),
        }
    }

    /// A finite length in millimeters that is not below zero.
    pub(super) fn not_negative(&self, number: &At<f64>, what: &str) -> Result<f64, PlanError> {
        match self.length(number, what)? {
            x if x >= 0.0 => Ok(x),
            _ => self.wrong(&number.span, format!("{what} is {}; it cannot be below 0", number.value)),
        }
    }

    /// A finite length in millimeters above zero.
    pub(super) fn positive(&self, number: &At<f64>, what: &str) -> Result<f64, PlanError> {
        match self.length(number, what)? {
            x if x > 0.0 => Ok(x),
            _ => self.wrong(&number.span, format!("{what} is {}; give a length above 0", number.value)),
        }
    }

    /// A name that can be read in every result: it has letters, and none that steers a terminal or another program.
    pub(super) fn id(&self, id: &At<String>) -> Result<(), PlanError> {
        if id.value.trim().is_empty() {
            return self.wrong(&id.span, "an id cannot be empty; give a name or number");
        }
        match id.value.chars().find(|c| c.is_control()) {
            None => Ok(()),
            Some(c) => {
                let what = format!("the id holds the control character U+{:04X}; leave it out", u32::from(c));
                self.wrong(&id.span, what)
            }
        }
    }

    /// A path without control characters: these are escapes that nobody meant.
    pub(super) fn path(&self, path: &At<String>) -> Result<(), PlanError> {
        if !path.value.chars().any(char::is_control) {
            return Ok(());
        }
        let written = self.text.get(path.span.clone()).unwrap_or("").trim_matches('"');
        let what = format!(
            "in double quotes \\ begins an escape; write '{written}' in single quotes, or \"{}\" with forward slashes",
            written.replace('\\', "/")
        );
        self.wrong(&path.span, what)
    }

    pub(super) fn place(&self, p: [f64; 3]) -> [f64; 3] {
        p.map(|x| x * self.unit)
    }
}

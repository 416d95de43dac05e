//! How files are taken that do not say all of themselves.

use super::numbers::not_negative;
use super::{FormatName, TaskError, Text};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_files::{Columns, ReadOptions, Unit, Weld};

/// How a file is taken.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Reading {
    /// Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    pub units: Option<Text<Unit>>,
    /// Format of the file; without it told by its content, then by its ending.
    pub format: Option<Text<FormatName>>,
}

impl Reading {
    /// The same for the readers.
    pub fn options(&self) -> ReadOptions {
        ReadOptions {
            units: self.units.as_ref().map(|u| u.value),
            format: self.format.as_ref().map(|f| f.value.0),
            ..ReadOptions::default()
        }
    }
}

/// How a file is taken that may be a table of points. Its fields stand here and not in a flattened [`Reading`]: a request takes the fields of
/// what it flattens, but not of what that flattens in turn.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct PointReading {
    /// Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    pub units: Option<Text<Unit>>,
    /// Format of the file; without it told by its content, then by its ending.
    pub format: Option<Text<FormatName>>,
    /// Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is (`-,x,y,z`).
    pub columns: Option<Text<Columns>>,
}

impl PointReading {
    /// The same for the readers.
    pub fn options(&self) -> ReadOptions {
        let file = Reading { units: self.units.clone(), format: self.format.clone() };
        ReadOptions { columns: self.columns.as_ref().map(|c| c.value.clone()), ..file.options() }
    }
}

/// How a reference is taken.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct ReferenceReading {
    /// Unit of the reference; without it that of the measured file.
    pub reference_units: Option<Text<Unit>>,
    /// Format of the reference; without it told by its content.
    pub reference_format: Option<Text<FormatName>>,
}

impl ReferenceReading {
    /// Refuses what is said of a reference where there is none; `option` is what names one.
    ///
    /// # Errors
    /// Wrong usage.
    pub fn without_reference(&self, option: &str) -> Result<(), TaskError> {
        let given = [("units", self.reference_units.is_some()), ("format", self.reference_format.is_some())];
        match given.iter().find(|(_, given)| *given) {
            Some((what, _)) => {
                Err(TaskError::usage(format!("--reference-{what} is for the file of {option}; give one")))
            }
            None => Ok(()),
        }
    }

    /// The same for the readers, beside what was said of the measured file.
    pub fn options(&self, measured: &PointReading) -> ReadOptions {
        let own = self.reference_units.as_ref().or(measured.units.as_ref());
        ReadOptions {
            units: own.map(|u| u.value),
            format: self.reference_format.as_ref().map(|f| f.value.0),
            ..ReadOptions::default()
        }
    }
}

/// Which vertices of a file are joined: those within `distance`, or those at the same place.
///
/// # Errors
/// A distance that is none.
pub fn welding(distance: Option<f64>) -> Result<Weld, TaskError> {
    distance.map_or(Ok(Weld::Same), |d| Ok(Weld::Within(not_negative("weld", d)?)))
}

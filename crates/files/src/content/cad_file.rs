//! A CAD file as a model of exact faces.

use super::spline_model::SplineModel;
use super::unit_from::UnitFrom;
use crate::{Unit, Warning};
use trueness_cad::model::Model;

/// The unit of a file's lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthUnit {
    /// Millimeters in one.
    pub millimeters: f64,
    /// Where it comes from.
    pub from: UnitFrom,
}

impl LengthUnit {
    /// The unit of this length, if it is one of [`Unit::ALL`], else millimeters.
    pub(crate) fn nearest(&self) -> Unit {
        Unit::ALL.into_iter().find(|unit| unit.to_millimeters(1.0) == self.millimeters).unwrap_or_default()
    }
}

/// A CAD file.
#[derive(Clone, Debug)]
pub struct CadFile {
    /// Its parts and where they stand, millimeters; what of them could not be read is told there.
    pub model: Model,
    /// What its content proved to be: `step`, `iges`.
    pub format: &'static str,
    /// Size on disk; 0 where it is not known (standard input).
    pub bytes: u64,
    /// True if the file is packed.
    pub gzip: bool,
    /// The unit of its lengths; of the first part where parts have different ones.
    pub unit: LengthUnit,
    /// What was odd.
    pub warnings: Vec<Warning>,
    /// The same as whole B-spline surfaces, where all of its faces are such.
    pub splines: Option<SplineModel>,
}

/// What a reader makes of a file.
pub(crate) struct CadContent {
    pub model: Model,
    pub unit: LengthUnit,
    pub warnings: Vec<Warning>,
    pub splines: Option<SplineModel>,
}

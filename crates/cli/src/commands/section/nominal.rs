//! The nominal that a section is compared with.

use crate::options::{ReferenceArgs, choice, number};
use clap::Args;
use std::path::PathBuf;
use trueness::task::{Text, ToleranceText};
use trueness::tasks::section::{Fit, SectionRequest};
use trueness_measure::compare::MIN_COVERAGE;

/// What the section should be.
#[derive(Args, Debug)]
#[command(next_help_heading = "Nominal")]
pub struct NominalArgs {
    /// Compare the points with the section of this nominal: a mesh, cut by the same planes or by the plane of the points; a DXF
    /// drawing in the coordinates of the plane; or points in their order along the contour
    #[arg(long, value_name = "FILE")]
    nominal: Option<PathBuf>,
    /// First bring the section nearest to the nominal, within its plane, by least squares [default: none]
    #[arg(long, value_parser = choice::<Fit>(), value_name = "WAY", requires = "nominal")]
    fit: Option<Fit>,
    /// Allowed deviation of the profile, mm: T for ±T, or -L,+U with both signs; the exit status is then the verdict. T is half of the
    /// profile tolerance in a drawing, which is the whole width of the zone
    #[arg(long, value_name = "T | -L,+U", allow_hyphen_values = true, requires = "nominal")]
    tolerance: Option<Text<ToleranceText>>,
    /// At least this share of the points must lie within the tolerance, percent
    #[arg(
        long,
        value_name = "PERCENT",
        default_value = "100",
        requires = "tolerance",
        allow_hyphen_values = true,
        value_parser = number,
    )]
    inside: f64,
    /// For a pass, at least this share of the length of the nominal must be measured, and this share of the points must have a
    /// counterpart on it, percent; 0 where only a part is measured on purpose. With less, the verdict is undecided, unless it is a fail
    #[arg(
        long,
        value_name = "PERCENT",
        default_value_t = 100.0 * MIN_COVERAGE,
        requires = "tolerance",
        allow_hyphen_values = true,
        value_parser = number,
    )]
    min_coverage: f64,
    /// Exclude (and count) points farther from the nominal than this, mm, also from the fit
    #[arg(long, value_name = "MM", requires = "nominal", allow_hyphen_values = true, value_parser = number)]
    max_distance: Option<f64>,
    #[command(flatten)]
    reading: ReferenceArgs,
}

impl NominalArgs {
    /// The request with these.
    pub fn ask(&self, request: SectionRequest) -> SectionRequest {
        SectionRequest {
            nominal: self.nominal.clone(),
            reference_reading: self.reading.reading(),
            fit: self.fit,
            tolerance: self.tolerance.clone(),
            inside: self.inside,
            min_coverage: self.min_coverage,
            max_distance: self.max_distance,
            ..request
        }
    }
}

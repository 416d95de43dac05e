//! The nominal that a section is compared with.

use crate::options::{ReferenceArgs, choice};
use clap::Args;
use std::path::PathBuf;
use trueness::task::{Text, ToleranceText};
use trueness::tasks::section::{Fit, SectionRequest};
use trueness_measure::compare::MIN_COVERAGE;

/// What the section should be.
#[derive(Args, Debug)]
#[command(next_help_heading = "Nominal")]
pub struct NominalArgs {
    /// Compare the points with the section of this nominal: a mesh, cut by the same planes (or by the plane of the points), a DXF
    /// drawing in the plane's coordinates, or points in order, of which the contour is found
    #[arg(long, value_name = "FILE")]
    nominal: Option<PathBuf>,
    /// Bring the section nearest to the nominal first, within its plane, by least squares [default: none, it stays where it is]
    #[arg(long, value_parser = choice::<Fit>(), value_name = "WAY", requires = "nominal")]
    fit: Option<Fit>,
    /// Allowed deviation of the profile: T for ±T (a zone of the width 2 T, even about the nominal: write half of the profile
    /// tolerance of a drawing), or -L,+U with both signs; the exit status is then the verdict
    #[arg(long, value_name = "T | -L,+U", allow_hyphen_values = true, requires = "nominal")]
    tolerance: Option<Text<ToleranceText>>,
    /// Share of the points that must lie within the tolerance, in percent
    #[arg(
        long,
        value_name = "PERCENT",
        default_value = "100",
        requires = "tolerance",
        allow_hyphen_values = true
    )]
    inside: f64,
    /// Share of the nominal's length that must be measured for a pass, and of the points that must have a counterpart on it, in
    /// percent as --inside; 0: a part of it is measured on purpose. Where it is less, what does not fail is undecided
    #[arg(
        long,
        value_name = "PERCENT",
        default_value_t = 100.0 * MIN_COVERAGE,
        requires = "tolerance",
        allow_hyphen_values = true
    )]
    min_coverage: f64,
    /// Exclude (and count) points farther from the nominal than this, mm; the best fit does not look at them either
    #[arg(long, value_name = "MM", requires = "nominal", allow_hyphen_values = true)]
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

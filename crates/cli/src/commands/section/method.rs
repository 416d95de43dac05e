//! The methods of a paper for the join of one line and one curve.

use crate::options::choice;
use clap::Args;
use trueness::tasks::section::{Interval, Search, SectionRequest};

/// How the join of a line and a curve is found, if not by the likelihood of the whole contour.
#[derive(Args, Debug)]
#[command(next_help_heading = "One line and one curve")]
pub struct MethodArgs {
    /// Find the one join of a line at an end of the row and one curve. golden: by golden-section search between points; stepwise:
    /// the measured point where the curvature leaves that of the line; improved: golden section about that point. The table has all three
    #[arg(long, value_parser = choice::<Search>(), value_name = "NAME")]
    search: Option<Search>,
    /// Interval of the join of the search: from the likelihood, or from 3 σ and correlation as in the paper
    /// [default: profile]
    #[arg(long, value_parser = choice::<Interval>(), value_name = "NAME")]
    interval: Option<Interval>,
}

impl MethodArgs {
    /// The request with these.
    pub fn ask(&self, request: SectionRequest) -> SectionRequest {
        SectionRequest { search: self.search, interval: self.interval.unwrap_or_default(), ..request }
    }
}

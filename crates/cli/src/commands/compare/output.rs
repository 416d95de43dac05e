//! Where the answer of a comparison goes: document, points with deviations, report.

use crate::options::DocumentArgs;
use crate::report::ReportArgs;
use clap::Args;
use std::path::PathBuf;
use trueness_files::write::Writable;

/// Files that a comparison can write.
#[derive(Args, Debug)]
#[command(next_help_heading = "Output")]
pub struct OutputArgs {
    #[command(flatten)]
    pub document: DocumentArgs,
    /// Write x, y, z, deviation of every point
    #[arg(long, value_name = "FILE", help = out_help())]
    pub out: Option<PathBuf>,
    /// Color scale of the report (an object trueness/scale/1)
    #[arg(long, value_name = "FILE")]
    pub scale: Option<PathBuf>,
    #[command(flatten)]
    pub report: ReportArgs,
}

fn out_help() -> String {
    format!(
        "Write x, y, z and deviation of every point, in the order of the input ({}); with several references one file each: \
         name.1.csv, name.2.csv …",
        Writable::Points.shown()
    )
}

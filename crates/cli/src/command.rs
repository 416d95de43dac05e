//! The words of the command line: the list of commands, and what each of them is to the program.

use crate::commands::align::AlignArgs;
use crate::commands::check::CheckArgs;
use crate::commands::compare::CompareArgs;
use crate::commands::curvature::CurvatureArgs;
use crate::commands::fit::FitArgs;
use crate::commands::inspect::InspectArgs;
use crate::commands::plan::PlanArgs;
use crate::commands::repair::RepairArgs;
use crate::commands::section::SectionArgs;
use crate::commands::segment::SegmentArgs;
use crate::commands::surface::SurfaceArgs;
use crate::commands::trend::TrendArgs;
use crate::exit::Outcome;
use crate::options::Common;
use crate::run_files::RunFiles;
use clap::{Parser, Subcommand};

/// How far is every measured point from the model?
///
/// Exit status: 0 done and conforming; 1 done, but out of tolerance or not sound; 2 wrong usage;
/// 3 the input could not be read or does not allow an answer; 4 internal error; 128 and the signal's number (130: Ctrl-C)
/// when interrupted.
#[derive(Parser, Debug)]
#[command(name = "trueness", version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
    #[command(flatten)]
    pub common: Common,
}

/// What the program can do: one file each in `commands/`.
#[derive(Subcommand, Debug)]
pub enum Command {
    Align(AlignArgs),
    Check(CheckArgs),
    Compare(Box<CompareArgs>),
    Curvature(Box<CurvatureArgs>),
    Fit(FitArgs),
    Inspect(Box<InspectArgs>),
    Plan(PlanArgs),
    Repair(RepairArgs),
    Section(Box<SectionArgs>),
    Segment(SegmentArgs),
    Surface(Box<SurfaceArgs>),
    Trend(TrendArgs),
}

/// A command with its words.
pub trait Run {
    /// All files that it reads and writes. They are tried before it runs.
    fn files(&self) -> anyhow::Result<RunFiles>;
    /// Does the work.
    fn run(&self, common: &Common) -> anyhow::Result<Outcome>;
}

impl Command {
    /// The command chosen.
    pub fn get(&self) -> &dyn Run {
        match self {
            Command::Align(args) => args,
            Command::Check(args) => args,
            Command::Compare(args) => args.as_ref(),
            Command::Curvature(args) => args.as_ref(),
            Command::Fit(args) => args,
            Command::Inspect(args) => args.as_ref(),
            Command::Plan(args) => args,
            Command::Repair(args) => args,
            Command::Section(args) => args.as_ref(),
            Command::Segment(args) => args,
            Command::Surface(args) => args.as_ref(),
            Command::Trend(args) => args,
        }
    }
}

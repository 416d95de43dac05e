//! The words of the command line: global options and the list of commands.

use crate::commands::check::CheckArgs;
use crate::commands::compare::CompareArgs;
use crate::commands::fit::FitArgs;
use crate::commands::repair::RepairArgs;
use crate::commands::segment::SegmentArgs;
use clap::{Parser, Subcommand, ValueEnum};

/// How far is every measured point from the model?
///
/// Exit status: 0 done and conforming; 1 done, but out of tolerance or not sound; 2 wrong usage;
/// 3 the input could not be read or does not allow an answer; 4 internal error; 130 interrupted.
#[derive(Parser, Debug)]
#[command(name = "trueness", version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
    #[command(flatten)]
    pub common: Common,
}

/// Options that every command takes.
#[derive(clap::Args, Debug)]
#[command(next_help_heading = "Common options")]
pub struct Common {
    /// Threads to use [default: all]; results do not depend on it
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Seed of everything random
    #[arg(long, global = true, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Print no table
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Progress on stderr: a bar on a terminal, plain lines, JSON lines, or nothing
    #[arg(long, global = true, value_enum, default_value = "auto")]
    pub progress: ProgressStyle,
}

/// How progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ProgressStyle {
    /// A bar on a terminal, nothing elsewhere.
    Auto,
    /// A line every two seconds.
    Plain,
    /// The same as JSON objects, one a line.
    Json,
    /// Nothing.
    None,
}

/// What the program can do: one file each in `commands/`.
#[derive(Subcommand, Debug)]
pub enum Command {
    Check(CheckArgs),
    Compare(Box<CompareArgs>),
    Fit(FitArgs),
    Repair(RepairArgs),
    Segment(SegmentArgs),
}

//! The words of the command line: the list of commands, one file or folder each.

mod align;
mod check;
mod compare;
mod convert;
mod curvature;
mod fit;
mod formats;
mod info;
mod inspect;
mod plan;
mod repair;
mod section;
mod segment;
mod surface;
mod trend;

use crate::command::Run;
use crate::options::Common;
use align::AlignArgs;
use check::CheckArgs;
use clap::{Parser, Subcommand};
use compare::CompareArgs;
use convert::ConvertArgs;
use curvature::CurvatureArgs;
use fit::FitArgs;
use formats::FormatsArgs;
use info::InfoArgs;
use inspect::InspectArgs;
use plan::PlanArgs;
use repair::RepairArgs;
use section::SectionArgs;
use segment::SegmentArgs;
use surface::SurfaceArgs;
use trend::TrendArgs;

/// 3D inspection and reverse engineering: how far is every measured point from the model?
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

/// What the program can do: one file or folder each.
#[derive(Subcommand, Debug)]
pub enum Command {
    Align(AlignArgs),
    Check(CheckArgs),
    Compare(Box<CompareArgs>),
    Convert(ConvertArgs),
    Curvature(Box<CurvatureArgs>),
    Fit(FitArgs),
    Formats(FormatsArgs),
    Info(InfoArgs),
    Inspect(Box<InspectArgs>),
    Plan(PlanArgs),
    Repair(RepairArgs),
    Section(Box<SectionArgs>),
    Segment(SegmentArgs),
    Surface(Box<SurfaceArgs>),
    Trend(TrendArgs),
}

impl Command {
    /// The command chosen.
    pub fn get(&self) -> &dyn Run {
        match self {
            Command::Align(args) => args,
            Command::Check(args) => args,
            Command::Compare(args) => args.as_ref(),
            Command::Convert(args) => args,
            Command::Curvature(args) => args.as_ref(),
            Command::Fit(args) => args,
            Command::Formats(args) => args,
            Command::Info(args) => args,
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

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn every_command_says_what_it_does_and_takes_its_own_examples() {
        let whole = Arguments::command();
        whole.clone().debug_assert();
        for command in whole.get_subcommands() {
            let name = command.get_name();
            assert!(command.get_about().is_some(), "{name}");
            // Commands of two words have their help at the second one.
            let texts = std::iter::once(command).chain(command.get_subcommands());
            let help: String =
                texts.filter_map(|c| c.get_after_help()).map(|help| format!("{help}\n")).collect();
            let start = format!("trueness {name}");
            let examples: Vec<&str> = help.lines().map(str::trim).filter(|l| l.starts_with(&start)).collect();
            assert!(!examples.is_empty(), "{name} has no example");
            let judges =
                ["align", "check", "compare", "convert", "inspect", "repair", "section", "surface", "trend"];
            let told = help.lines().find(|l| l.starts_with("Exit status: 0 done"));
            assert_eq!(told.is_some_and(|l| l.contains("; 1 done, but ")), judges.contains(&name), "{name}");
            for example in examples {
                let read = Arguments::try_parse_from(example.split_whitespace());
                assert!(read.is_ok(), "{example}: {}", read.unwrap_err());
            }
        }
    }
}

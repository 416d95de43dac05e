//! The command-line program: reads files, asks the libraries, prints and writes what they answer.

mod command;
mod commands;
mod console;
mod exit;
mod progress;
mod read;
mod report;
mod tolerance;

use clap::Parser;
use command::{Arguments, Command};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    console::quiet(arguments.common.quiet);
    progress::stop_on_interrupt();
    let outcome = exit::catch(|| {
        if let Some(n) = arguments.common.threads {
            rayon::ThreadPoolBuilder::new().num_threads(n.into()).build_global()?;
        }
        match &arguments.command {
            Command::Check(args) => commands::check::run(args, &arguments.common),
            Command::Compare(args) => commands::compare::run(args, &arguments.common),
            Command::Fit(args) => commands::fit::run(args, &arguments.common),
            Command::Repair(args) => commands::repair::run(args, &arguments.common),
            Command::Segment(args) => commands::segment::run(args, &arguments.common),
        }
    });
    exit::code(outcome)
}

//! The command-line program: reads files, asks the libraries, prints and writes what they answer.

mod command;
mod commands;
mod console;
mod exit;
mod inputs;
mod instructions;
mod layout;
mod memory;
mod noise;
mod number;
mod options;
mod output;
mod progress;
mod report;
mod signals;
mod task;
mod time_left;

use clap::Parser;
use commands::Arguments;
use std::process::ExitCode;
use trueness::task::Outcome;

#[global_allocator]
static MEMORY: memory::Allocator = memory::Allocator;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(message) => return before_any_work(&message),
    };
    console::quiet(arguments.common.quiet);
    signals::listen();
    exit::code(exit::catch(|| run(&arguments)))
}

/// Help, version, or wrong words.
fn before_any_work(message: &clap::Error) -> ExitCode {
    match console::parser(message) {
        Ok(()) => ExitCode::from(u8::try_from(message.exit_code()).unwrap_or(2)),
        Err(e) => exit::code(Err(e.into())),
    }
}

fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    instructions::limit()?;
    if let Some(n) = arguments.common.threads {
        rayon::ThreadPoolBuilder::new().num_threads(n.into()).build_global()?;
    }
    let command = arguments.command.get();
    command.files(&arguments.common)?.check(&progress::Console { style: arguments.common.progress })?;
    command.run(&arguments.common)
}

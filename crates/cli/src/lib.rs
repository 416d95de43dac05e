//! The command-line program: reads files, asks the libraries, prints and writes what they answer.
//!
//! A library, so that the Python package is the program too.

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

pub use memory::Allocator;

use clap::Parser;
use commands::Arguments;
use std::ffi::OsString;
use trueness::task::Outcome;

/// The program with these words, of which the first is its name: what it prints goes to the terminal, and its exit status is the answer.
///
/// From then on the process hears signals as the program does, and panics print nothing.
pub fn main_from(words: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments = match Arguments::try_parse_from(words) {
        Ok(arguments) => arguments,
        Err(message) => return before_any_work(&message),
    };
    console::quiet(arguments.common.quiet);
    signals::listen();
    exit::code(exit::catch(|| run(&arguments)))
}

/// Help, version, or wrong words.
fn before_any_work(message: &clap::Error) -> u8 {
    match console::parser(message) {
        Ok(()) => u8::try_from(message.exit_code()).unwrap_or(2),
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

//! The program `trueness`.

use std::process::ExitCode;

#[global_allocator]
static MEMORY: trueness_cli::Allocator = trueness_cli::Allocator;

fn main() -> ExitCode {
    ExitCode::from(trueness_cli::main_from(std::env::args_os()))
}

//! Exit status: what a script learns from a run.

use crate::{console, signals};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use trueness::task::{self, ErrorKind, TaskError};
use trueness_files::{ReadError, WriteError};
use trueness_geom::progress::Cancelled;

/// What a command that ran to its end found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Done and conforming.
    Conforming,
    /// Done, but out of tolerance, not sound or undecided.
    NotConforming,
    /// Some of what was asked has no answer. It was told; the exit status is this one.
    Unanswered(u8),
}

impl From<task::Outcome> for Outcome {
    fn from(outcome: task::Outcome) -> Outcome {
        match outcome {
            task::Outcome::Conforming => Outcome::Conforming,
            task::Outcome::NotConforming => Outcome::NotConforming,
            task::Outcome::Unanswered(kind) => Outcome::Unanswered(match kind {
                ErrorKind::Usage => 2,
                ErrorKind::Unanswerable => 3,
                ErrorKind::Cancelled => signals::status(),
            }),
        }
    }
}

/// What the help of a command says at its end: all exit statuses, of which `one` says what 1 means for it, then `rest`.
pub fn help(one: &str, rest: &str) -> String {
    format!(
        "Exit status: 0 done and conforming; 1 done, but {one}; 2 wrong usage; 3 the input could not be read or does not allow \
         an answer; 4 internal error.\n\n{rest}"
    )
}

/// Wrong use of an option that the parser of the command line cannot see.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);

/// `x`, the value of the option `name`, if it is finite and not below 0.
pub fn not_negative(name: &str, x: f64) -> Result<f64, Usage> {
    match x.is_finite() && x >= 0.0 {
        true => Ok(x),
        false => Err(Usage(format!("--{name} {x}: give a number from 0 upwards"))),
    }
}

/// A fault of the program itself.
#[derive(Debug, thiserror::Error)]
#[error("internal error: {0}. Please report it with the command and the files that caused it.")]
pub struct Internal(pub String);

/// Runs `work`; a panic becomes an [`Internal`] error.
pub fn catch(work: impl FnOnce() -> anyhow::Result<Outcome>) -> anyhow::Result<Outcome> {
    std::panic::set_hook(Box::new(|_| {}));
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|cause| {
        let text = cause
            .downcast_ref::<String>()
            .cloned()
            .or_else(|| cause.downcast_ref::<&str>().map(|s| s.to_string()))
            .unwrap_or_else(|| "no message".into());
        Err(Internal(text).into())
    })
}

/// Whether the words of the command line are what is wrong: an option that does not fit the file, an unknown ending.
fn is_usage(e: &(dyn std::error::Error + 'static)) -> bool {
    e.is::<Usage>()
        || e.downcast_ref::<TaskError>().is_some_and(|e| e.kind() == ErrorKind::Usage)
        || e.downcast_ref::<ReadError>().is_some_and(|e| e.fault.is_wrong_usage())
        || e.downcast_ref::<WriteError>().is_some_and(|e| e.fault.is_wrong_usage())
}

/// Prints the error, if any, and chooses the exit status.
pub fn code(outcome: anyhow::Result<Outcome>) -> ExitCode {
    let error = match outcome {
        Ok(Outcome::Conforming) => return ExitCode::SUCCESS,
        Ok(Outcome::NotConforming) => return ExitCode::from(1),
        Ok(Outcome::Unanswered(status)) => return ExitCode::from(status),
        Err(error) => error,
    };
    console::error(error.as_ref());
    ExitCode::from(status(&error))
}

/// The exit status of a run that ends with this error.
fn status(error: &anyhow::Error) -> u8 {
    let is = |test: fn(&(dyn std::error::Error + 'static)) -> bool| error.chain().any(test);
    if is(is_usage) {
        2
    } else if is(|e| e.is::<Cancelled>()) {
        signals::status()
    } else if is(|e| e.is::<Internal>()) {
        4
    } else {
        3
    }
}

//! A task on the terminal: run, written and printed.

use crate::options::{Common, DocumentArgs};
use crate::progress::Console;
use crate::report::ReportArgs;
use trueness::task::Outcome;
use trueness::task::{Done, Request};
use trueness_files::FileSources;
use trueness_report::Subject;

/// Runs the task of a request; writes its files and its document, and prints the table.
pub fn run<R: Request>(
    request: &R,
    document: &DocumentArgs,
    common: &Common,
    table: impl FnOnce(&Done<R::Document>) -> String,
) -> anyhow::Result<Outcome> {
    let done = request.answer(&FileSources, &Console { style: common.progress })?;
    finish(done, document, table)
}

/// The same with its report.
pub fn run_reported<R: Request<Document: Subject>>(
    request: &R,
    (document, report): (&DocumentArgs, &ReportArgs),
    common: &Common,
    table: impl FnOnce(&Done<R::Document>) -> String,
) -> anyhow::Result<Outcome> {
    let watch = Console { style: common.progress };
    let done = request.answer(&FileSources, &watch)?;
    report.write_done(&done, &watch)?;
    finish(done, document, table)
}

/// Puts the files of a task in their places, writes its document and prints the table.
pub fn finish<D: serde::Serialize>(
    mut done: Done<D>,
    document: &DocumentArgs,
    table: impl FnOnce(&Done<D>) -> String,
) -> anyhow::Result<Outcome> {
    done.commit()?;
    document.write(&done.document)?;
    document.table(|| table(&done))?;
    Ok(done.outcome)
}

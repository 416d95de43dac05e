//! `trueness trend`: one plan over many parts.

mod table;

use crate::command::Run;
use crate::exit;
use crate::options::{Common, DocumentArgs};
use crate::progress::Console;
use crate::report::ReportArgs;
use crate::task;
use anyhow::anyhow;
use clap::Args;
use std::path::PathBuf;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles};
use trueness::tasks::trend::{TrendRequest, maps};
use trueness_files::FileSources;

/// Follow the characteristics of a plan over many parts: course, capability, control limits
///
/// Reads the results that `trueness inspect --json` wrote, in the order in which the parts were made.
#[derive(Args, Debug)]
#[command(after_help = exit::help("a part does not pass, or a value is out of control", "\
Examples:
  trueness trend part-01.json part-02.json part-03.json
  trueness trend results/*.json --json trend.json --csv trend.csv --html trend.html
  trueness trend results/*.json --map map.html"))]
pub struct TrendArgs {
    /// Results of `trueness inspect --json`, one for each part, in the order of production
    #[arg(required = true)]
    results: Vec<PathBuf>,
    #[command(flatten)]
    document: DocumentArgs,
    /// Write the characteristics as a table, one line each
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a report with maps of the mean and the spread over the part; the results need the places of `trueness inspect --places`
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArgs,
}

impl TrendArgs {
    fn request(&self) -> TrendRequest {
        TrendRequest { results: self.results.clone(), csv: self.csv.clone() }
    }
}

impl Run for TrendArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        let document = RunFiles::default().document(self.document.json.as_ref());
        let files = document.report(self.report.html.as_ref()).and(self.request().files(&FileSources)?);
        Ok(files.also("--map", self.map.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        let watch = Console { style: common.progress };
        let done = self.request().answer(&FileSources, &watch)?;
        let map = self.map.as_ref().map(|path| match maps(&done.document) {
            Ok(page) => Ok((path, page)),
            Err(why) => Err(anyhow!("{}: {why}", path.display())),
        });
        let map = map.transpose()?;
        self.report.write_done(&done, &watch)?;
        if let Some((path, page)) = &map {
            self.report.write_done_to(path, page, &watch)?;
        }
        drop(map);
        task::finish(done, &self.document, |done| table::text(&done.document, common.verbose))
    }
}

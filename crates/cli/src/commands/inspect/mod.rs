//! `trueness inspect`: a plan and measured parts make verdicts.

mod features;
mod table;

use crate::command::Run;
use crate::console;
use crate::exit;
use crate::options::{Common, DocumentArgs};
use crate::progress::Console;
use crate::report::ReportArgs;
use clap::Args;
use std::path::PathBuf;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles};
use trueness::tasks::inspect::{InspectRequest, Part};
use trueness_files::FileSources;

/// Evaluate an inspection plan: features, characteristics, verdicts
///
/// The plan is a TOML file that names the measured data, the features and the characteristics with their tolerances. The message about a
/// fault in it names line and column.
#[derive(Args, Debug)]
#[command(after_help = exit::help("a characteristic fails, is undecided or was not measured", "\
Examples:
  trueness inspect bracket.toml
  trueness inspect bracket.toml --measured scan-0815.stl --json result.json --html report.html
  trueness inspect bracket.toml --measured scan-0816.stl --json part-0816.json --places
  trueness inspect bracket.toml --measured scans/*.stl --csv parts.csv --junit parts.xml
  trueness inspect bracket.toml --qif results.qif"))]
pub struct InspectArgs {
    /// The plan; paths in it are relative to its folder
    plan: PathBuf,
    /// Measured meshes or clouds, one for each part, instead of the one that the plan names
    #[arg(long, value_name = "FILE", num_args = 1..)]
    measured: Vec<PathBuf>,
    #[command(flatten)]
    document: DocumentArgs,
    /// Keep the deviations at fixed places of the reference in the document of --json, for the maps of `trueness trend`
    #[arg(long, requires = "json")]
    places: bool,
    /// Write the characteristics as a table, one line each
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the verdicts as JUnit XML, for continuous integration
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write characteristics, features, values and verdicts as QIF 3.0 results (ISO 23952)
    #[arg(long, value_name = "FILE")]
    qif: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArgs,
}

impl InspectArgs {
    fn request(&self, common: &Common) -> InspectRequest {
        InspectRequest {
            plan: self.plan.clone(),
            measured: self.measured.clone(),
            places: self.places,
            csv: self.csv.clone(),
            junit: self.junit.clone(),
            qif: self.qif.clone(),
            seed: common.seed,
            view: self.report.html.is_some(),
        }
    }
}

impl Run for InspectArgs {
    fn files(&self, common: &Common) -> anyhow::Result<RunFiles> {
        let document = RunFiles::default().document(self.document.json.as_ref());
        Ok(document.report(self.report.html.as_ref()).and(self.request(common).files(&FileSources)?))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        let (request, watch) = (self.request(common), Console { style: common.progress });
        if self.document.json.is_some() {
            request.one_part()?;
        }
        let inspecting = request.open(&FileSources, &watch)?;
        let several = request.measured.len() > 1;
        let mut parts = vec![];
        for part in inspecting.parts() {
            let part = part?;
            match &part {
                Part::Inspected(done) => {
                    self.report.write_done(done, &watch)?;
                    self.document.write(&done.document)?;
                }
                Part::Failed(failed) => console::error(&failed.error),
            }
            self.document.table(|| table::table(&part, several, common.verbose))?;
            parts.push(part);
        }
        let mut done = inspecting.finish(parts)?;
        done.commit()?;
        Ok(done.outcome)
    }
}

//! `trueness inspect`: a plan and measured parts make verdicts.

mod features;
mod files;
mod lists;
mod part;
mod qif;
mod table;

use crate::command::Run;
use crate::console;
use crate::exit::{self, Outcome, Usage};
use crate::options::{Common, DocumentArgs};
use crate::output::whole_file;
use crate::progress::{STEPS, Stage};
use crate::report::ReportArgs;
use anyhow::anyhow;
use clap::Args;
use files::PlanFile;
use part::{Failed, Fault, Part};
use std::path::{Path, PathBuf};
use trueness::task::RunFiles;
use trueness_document::Verdict;
use trueness_document::inspect::InspectDocument;
use trueness_document::plan::PlanError;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_measure::inspection::{self, Deviations, Stop};
use trueness_report::views::inspect::View;

/// Run an inspection plan: features, tolerances, verdicts
///
/// The plan is a TOML file that names the measured data, the features and the characteristics with their tolerances. A fault
/// in it is told with line and column.
#[derive(Args, Debug)]
#[command(after_help = exit::help("a characteristic fails, is undecided or was not measured", "\
Examples:
  trueness inspect bracket.toml
  trueness inspect bracket.toml --measured scan-0815.stl --json result.json --html report.html
  trueness inspect bracket.toml --measured scan-0816.stl --json part-0816.json --places
  trueness inspect bracket.toml --measured scans/*.stl --csv parts.csv --junit parts.xml
  trueness inspect bracket.toml --qif results.qif"))]
pub struct InspectArgs {
    /// The plan; paths in it are relative to it
    plan: PathBuf,
    /// Measured meshes or clouds, in place of the plan's own: one part each
    #[arg(long, value_name = "FILE", num_args = 1..)]
    measured: Vec<PathBuf>,
    #[command(flatten)]
    document: DocumentArgs,
    /// Keep in the document of --json the deviations at places that are the same for every part: for the maps of `trend`
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
    /// The parts: files in place of the plan's own, or that one.
    fn parts(&self) -> Vec<Option<&Path>> {
        match self.measured.is_empty() {
            true => vec![None],
            false => self.measured.iter().map(|p| Some(p.as_path())).collect(),
        }
    }
}

impl Run for InspectArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        let mut inputs = vec![self.plan.clone()];
        inputs.extend(self.measured.iter().cloned());
        // What is wrong with the plan is told when it is run; here its files must not be written over.
        if let Ok(plan) = PlanFile::read(&self.plan) {
            inputs.extend(plan.inputs(self.measured.is_empty()));
        }
        Ok(RunFiles::of(&inputs)
            .document(self.document.json.as_ref())
            .report(self.report.html.as_ref())
            .also("--csv", self.csv.as_ref())
            .also("--junit", self.junit.as_ref())
            .also("--qif", self.qif.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

fn run(args: &InspectArgs, common: &Common) -> anyhow::Result<Outcome> {
    if args.measured.len() > 1 && (args.document.json.is_some() || args.report.html.is_some()) {
        let what =
            "--json and --html hold one part; give one --measured, or --csv, --junit and --qif for all";
        return Err(Usage(what.into()).into());
    }
    let plan = PlanFile::read(&args.plan)?;
    if !args.measured.is_empty() && plan.plan.measured.is_none() {
        let what =
            "--measured replaces the plan's measured data, but the plan names none; add `measured` to it";
        return Err(Usage(what.into()).into());
    }
    if args.places && plan.plan.deviation.is_none() {
        let what = "--places keeps deviations from the reference, but the plan has no [deviation]; add it";
        return Err(Usage(what.into()).into());
    }
    let several = args.measured.len() > 1;
    let (mut parts, mut status) = (Vec::new(), None);
    for file in args.parts() {
        let part = match inspect(args, &plan, file, common) {
            Ok(document) => Part::Inspected(Box::new(document)),
            Err(Fault::Run(error)) => return Err(error),
            // Whatever is wrong with a part, the others are inspected.
            Err(Fault::Part(error)) => {
                console::error(&error);
                status = status.or(Some(exit::status(&error)));
                Part::Failed(Failed::new(plan.name_of(file), &error, plan.record()))
            }
        };
        args.document.table(|| table::table(&part, several, common.verbose))?;
        parts.push(part);
    }
    if let Some(path) = &args.csv {
        let text = lists::csv(&parts);
        whole_file(path, |file| file.write_all(&text))?;
    }
    if let Some(path) = &args.junit {
        let text = lists::junit(&parts);
        whole_file(path, |file| file.write_all(text.as_bytes()))?;
    }
    if let Some(path) = &args.qif {
        let text = qif::qif(&parts, plan.plan.title.as_deref());
        whole_file(path, |file| file.write_all(text.as_bytes()))?;
    }
    if let Some(status) = status {
        return Ok(Outcome::Unanswered(status));
    }
    let pass = parts.iter().filter_map(Part::document).all(|d| d.verdict == Verdict::Pass);
    Ok(if pass { Outcome::Conforming } else { Outcome::NotConforming })
}

/// One part.
fn inspect(
    args: &InspectArgs,
    plan: &PlanFile,
    part: Option<&Path>,
    common: &Common,
) -> Result<InspectDocument, Fault> {
    let (mut data, inputs) = plan.data(part, common.seed, args.report.shown())?;
    data.places = args.places;
    let stage = Stage::new(common.progress, "inspecting", STEPS, Some(inspection::STEPS));
    let found = inspection::run(&plan.plan, data, &stage);
    let cancelled = stage.cancelled();
    stage.end(&found);
    let found = found.map_err(|stop| match stop {
        // Whatever it stopped at: nothing of it is told.
        _ if cancelled => Fault::Run(Cancelled.into()),
        Stop::Cancelled => Fault::Run(Cancelled.into()),
        Stop::Plan { span, what } => {
            Fault::Run(anyhow!("{}: {}", plan.path.display(), PlanError::at(&plan.text, &span, what)))
        }
        stop if stop.of_part() => Fault::Part(anyhow!("{}: {stop}", plan.name_of(part))),
        stop => Fault::Run(anyhow!("{}: {stop}", plan.path.display())),
    })?;
    let mut document = inspection::document(&plan.plan, plan.record(), &found, inputs);
    if args.report.html.is_some() {
        let name = document.inputs.first().map_or("", |i| &i.path);
        let references = found.deviations.as_ref().zip(document.deviation.as_ref());
        let references = references.map(|(d, record)| d.references(&record.reference));
        let deviations = found.deviations.as_ref().zip(references.as_ref()).map(|(d, references)| {
            let mesh = found.measured.as_ref().filter(|m| !m.faces.is_empty());
            trueness_report::views::compare::View::new(name, mesh, references, &d.found)
        });
        let view = View::new(&document, &found, deviations.as_ref());
        args.report.write(&document, &view.objects(), &view.marks, common.progress)?;
    }
    // Pages do without: they have a map of their own.
    document.deviation_map = found.deviations.as_ref().and_then(Deviations::place_map);
    args.document.write(&document)?;
    Ok(document)
}

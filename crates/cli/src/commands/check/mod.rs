//! `trueness check`: is this mesh sound, and if not, where not?

mod table;

use crate::command::Run;
use crate::exit;
use crate::options::{Common, DocumentArgs, InputArgs, count, number};
use crate::report::ReportArgs;
use crate::task;
use clap::Args;
use std::path::PathBuf;
use trueness::files::FileSources;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles};
use trueness::tasks::check::CheckRequest;
use trueness_geom::check;
use trueness_measure::model_check::MODEL_KINDS;

/// Report size and defects of a mesh
///
/// Reports facets, shells, area, volume and genus of the mesh, and every defect with its place.
#[derive(Args, Debug)]
#[command(after_help = exit::help("the mesh is not sound", "\
Examples:
  trueness check part.stl
  trueness check part.stl --html report.html
  trueness check part.stl --json defects.json --items 100000
  trueness check scan.ply --gap 0.01 --no-self-intersections"))]
pub struct CheckArgs {
    /// The mesh or the CAD model; `-` reads stdin
    mesh: PathBuf,
    /// Places within this distance may have been meant as one, mm [default: eight steps of single precision]
    #[arg(long, value_name = "MM", value_parser = number, allow_negative_numbers = true)]
    gap: Option<f64>,
    /// Join vertices within this distance before the check, mm [default: only those at the same place]
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number)]
    weld: Option<f64>,
    /// A facet with an angle below this is a sliver, degrees
    #[arg(long, value_name = "DEGREES", default_value = "0.1", value_parser = number, allow_negative_numbers = true)]
    sliver_angle: f64,
    /// A shell with a diagonal below this share of the whole is an island, percent
    #[arg(long, value_name = "PERCENT", default_value = "1", value_parser = number, allow_negative_numbers = true)]
    island: f64,
    /// Do not look for self-intersections
    #[arg(long)]
    no_self_intersections: bool,
    /// List at most this many defects of each kind in the document; all are counted
    #[arg(long, value_name = "N", default_value = "1000", value_parser = count, allow_negative_numbers = true)]
    items: usize,
    #[command(flatten)]
    input: InputArgs,
    #[command(flatten)]
    document: DocumentArgs,
    #[command(flatten)]
    report: ReportArgs,
}

impl CheckArgs {
    fn request(&self) -> CheckRequest {
        CheckRequest {
            mesh: self.mesh.clone(),
            reading: self.input.reading(),
            gap: self.gap,
            weld: self.weld,
            sliver_angle: self.sliver_angle,
            island: self.island,
            no_self_intersections: self.no_self_intersections,
            items: self.items,
            view: self.report.html.is_some(),
        }
    }
}

impl Run for CheckArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        let files = self.request().files(&FileSources)?.document(self.document.json.as_ref());
        Ok(files.report(self.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        task::run_reported(&self.request(), (&self.document, &self.report), common, |done| {
            let kinds: Vec<_> = check::KINDS.into_iter().chain(MODEL_KINDS).collect();
            table::text(&done.document, &kinds)
        })
    }
}

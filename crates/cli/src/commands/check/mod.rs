//! `trueness check`: is this mesh sound, and if not, where not?

mod table;

use crate::command::Run;
use crate::exit;
use crate::options::{Common, DocumentArgs, InputArgs};
use crate::report::ReportArgs;
use crate::task;
use clap::Args;
use std::path::PathBuf;
use trueness::files::FileSources;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles};
use trueness::tasks::check::CheckRequest;
use trueness_geom::check;

/// Size and defects of a mesh
///
/// Tells what the mesh is (facets, shells, area, volume, genus) and finds every defect with its place.
#[derive(Args, Debug)]
#[command(after_help = exit::help("the mesh is not sound", "\
Examples:
  trueness check part.stl
  trueness check part.stl --html report.html
  trueness check part.stl --json defects.json --items 100000
  trueness check scan.ply --gap 0.01 --no-self-intersections"))]
pub struct CheckArgs {
    /// The mesh: STL, PLY, OBJ, OFF; `-` reads stdin
    mesh: PathBuf,
    /// Distance up to which two places may have been meant as one, mm [default: eight steps of single precision]
    #[arg(long, value_name = "MM")]
    gap: Option<f64>,
    /// Join vertices within this distance before looking, mm [default: those at the same place]
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    weld: Option<f64>,
    /// Facets with a smaller angle than this are slivers, degrees
    #[arg(long, value_name = "DEGREES", default_value = "0.1")]
    sliver_angle: f64,
    /// Shells with a smaller diagonal than this share of the whole are islands, percent
    #[arg(long, value_name = "PERCENT", default_value = "1")]
    island: f64,
    /// Do not look for self-intersections
    #[arg(long)]
    no_self_intersections: bool,
    /// Defects of each kind to list in the document; all are counted
    #[arg(long, value_name = "N", default_value = "1000")]
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
            table::text(&done.document, &check::KINDS)
        })
    }
}

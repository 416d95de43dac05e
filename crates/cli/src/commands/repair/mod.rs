//! `trueness repair`: a mesh without its defects, and without a vertex moved.

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
use trueness::tasks::repair::RepairRequest;
use trueness_files::write::Writable;
use trueness_solid::repair::STEPS;

/// A mesh without its defects
///
/// Mends what `trueness check` finds and tells every change, the deviation introduced, and what is left. No vertex moves:
/// what stays keeps its place bit for bit. The file written is read again and checked before it takes its place.
#[derive(Args, Debug)]
#[command(after_help = help())]
pub struct RepairArgs {
    /// The mesh: STL, PLY, OBJ, OFF; `-` reads stdin
    mesh: PathBuf,
    /// The mended mesh, in mm; STL holds single precision only
    #[arg(short, long, value_name = "FILE", help = out_help(), required_unless_present = "in_place")]
    out: Option<PathBuf>,
    /// Replace the mesh by the mended one, once that is written and read again
    #[arg(long)]
    in_place: bool,
    /// Only these steps, separated by commas
    #[arg(long, value_name = "STEPS", value_delimiter = ',', conflicts_with = "skip")]
    only: Vec<String>,
    /// All steps but these, separated by commas
    #[arg(long, value_name = "STEPS", value_delimiter = ',')]
    skip: Vec<String>,
    /// Distance up to which two places may have been meant as one, mm [default: eight steps of single precision]
    #[arg(long, value_name = "MM")]
    gap: Option<f64>,
    /// Fill holes up to this share of the area of their shell, percent; of a shell with a larger one, up to 0.5 % only
    #[arg(long, value_name = "PERCENT", default_value = "25", conflicts_with = "all_holes")]
    holes: f64,
    /// Fill all holes, however large, even the rim of a sheet that is not flat
    #[arg(long)]
    all_holes: bool,
    /// Stitch edges up to this distance, mm [default: a ten-thousandth of the diagonal]
    #[arg(long, value_name = "MM")]
    stitch: Option<f64>,
    /// Remove shells with a smaller diagonal than this share of the whole, percent [without a number: 1]
    #[arg(long, value_name = "PERCENT", num_args = 0..=1, default_missing_value = "1")]
    remove_islands: Option<f64>,
    /// Share of the diagonal, and of the volume, by which the part may change, percent: beyond it the result is closed, but
    /// changed, and the exit status 1
    #[arg(long, value_name = "PERCENT", default_value = "0.01")]
    max_change: f64,
    /// Changes to list in the document; all are counted
    #[arg(long, value_name = "N", default_value = "1000")]
    items: usize,
    #[command(flatten)]
    input: InputArgs,
    #[command(flatten)]
    document: DocumentArgs,
    #[command(flatten)]
    report: ReportArgs,
}

fn help() -> String {
    let steps: Vec<String> = STEPS.iter().map(|s| format!("  {:<24}{}", s.name, s.about)).collect();
    let rest = format!(
        "Steps, in their order:\n{}\n\nExamples:\n  trueness repair part.stl -o sound.stl\n  \
         trueness repair scan.ply -o closed.ply --all-holes --html report.html\n  \
         trueness repair part.stl -o turned.stl --only orient,outward",
        steps.join("\n")
    );
    exit::help("the result is not sound, or another part; it is written all the same", &rest)
}

impl RepairArgs {
    fn request(&self) -> RepairRequest {
        RepairRequest {
            mesh: self.mesh.clone(),
            reading: self.input.reading(),
            out: self.out.clone(),
            in_place: self.in_place,
            only: self.only.clone(),
            skip: self.skip.clone(),
            gap: self.gap,
            holes: self.holes,
            all_holes: self.all_holes,
            stitch: self.stitch,
            remove_islands: self.remove_islands,
            max_change: self.max_change,
            items: self.items,
            view: self.report.html.is_some(),
        }
    }
}

fn out_help() -> String {
    format!("The mended mesh, in mm: {}; STL holds single precision only", Writable::Mesh.shown())
}

impl Run for RepairArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        let files = self.request().files(&FileSources)?.document(self.document.json.as_ref());
        Ok(files.report(self.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        task::run_reported(&self.request(), (&self.document, &self.report), common, |done| {
            table::text(&done.document)
        })
    }
}

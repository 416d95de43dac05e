//! `trueness repair`: a mesh without its defects, and without a vertex moved.

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
use trueness::tasks::repair::RepairRequest;
use trueness_files::write::Writable;
use trueness_solid::repair::STEPS;

/// Repair the defects of a mesh
///
/// Repairs the defects that `trueness check` finds. Reports every change, the deviation that the changes introduce, and the defects that
/// are left. No vertex moves: a vertex that stays keeps its place bit for bit. The written file is read again and checked before it
/// takes its place.
#[derive(Args, Debug)]
#[command(after_help = help())]
pub struct RepairArgs {
    /// The mesh; `-` reads stdin
    mesh: PathBuf,
    /// The repaired mesh, in mm; STL holds single precision only
    #[arg(short, long, value_name = "FILE", help = out_help(), required_unless_present = "in_place")]
    out: Option<PathBuf>,
    /// Replace the mesh by the repaired one, once that is written and read again
    #[arg(long)]
    in_place: bool,
    /// Run only these steps, separated by commas
    #[arg(long, value_name = "STEPS", value_delimiter = ',', conflicts_with = "skip")]
    only: Vec<String>,
    /// Run all steps but these, separated by commas
    #[arg(long, value_name = "STEPS", value_delimiter = ',')]
    skip: Vec<String>,
    /// Places within this distance may have been meant as one, mm [default: eight steps of single precision]
    #[arg(long, value_name = "MM", value_parser = number, allow_negative_numbers = true)]
    gap: Option<f64>,
    /// Fill holes up to this share of the area of their shell, percent; in a shell with a larger hole, only up to 0.5 %
    #[arg(long, value_name = "PERCENT", default_value = "25", conflicts_with = "all_holes", value_parser = number, allow_negative_numbers = true)]
    holes: f64,
    /// Fill all holes, however large, even the rim of a sheet that is not flat
    #[arg(long)]
    all_holes: bool,
    /// Stitch edges up to this distance, mm [default: 1/10000 of the diagonal]
    #[arg(long, value_name = "MM", value_parser = number, allow_negative_numbers = true)]
    stitch: Option<f64>,
    /// Remove shells with a diagonal below this share of the whole, percent [without a number: 1]
    #[arg(long, value_name = "PERCENT", num_args = 0..=1, default_missing_value = "1", value_parser = number, allow_negative_numbers = true)]
    remove_islands: Option<f64>,
    /// The part may change by this share of its diagonal and of its volume, percent. Beyond it the result is "closed, but
    /// changed", and the exit status is 1
    #[arg(long, value_name = "PERCENT", default_value = "0.01", value_parser = number, allow_negative_numbers = true)]
    max_change: f64,
    /// List at most this many changes in the document; all are counted
    #[arg(long, value_name = "N", default_value = "1000", value_parser = count, allow_negative_numbers = true)]
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
    exit::help("the result is not sound, or changed beyond --max-change; it is written all the same", &rest)
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
    format!("Write the repaired mesh, in mm: {}; STL holds single precision only", Writable::Mesh.shown())
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

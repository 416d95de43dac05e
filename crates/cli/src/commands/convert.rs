//! `trueness convert`: a file in another format.

use crate::command::Run;
use crate::exit;
use crate::number::{FACETS, POINTS, counted, short};
use crate::options::{Common, DocumentArgs, PointInputArgs, number};
use crate::task;
use clap::Args;
use std::path::PathBuf;
use trueness::task::{Outcome, Request, RunFiles};
use trueness::tasks::convert::ConvertRequest;
use trueness_document::convert::ConvertDocument;
use trueness_files::FileSources;
use trueness_files::write::Writable;

/// A file in another format
///
/// Reads a mesh, points or a CAD model, writes it in the format of the ending of OUT, in mm, and tells what is lost.
#[derive(Args, Debug)]
#[command(after_help = exit::help("not all of the input could be read", "\
Examples:
  trueness convert part.stl part.ply
  trueness convert part.stp part.stl --chord 0.01
  trueness convert scan.txt scan.csv --units in"))]
pub struct ConvertArgs {
    /// A file of any format that is read as a mesh or points; `-` reads stdin
    input: PathBuf,
    /// The file to write
    #[arg(help = out_help())]
    out: PathBuf,
    /// How far facets of a CAD model may lie from its faces, mm [default: a twenty-thousandth of its diagonal]
    #[arg(long, value_name = "MM", value_parser = number, allow_negative_numbers = true)]
    chord: Option<f64>,
    #[command(flatten)]
    reading: PointInputArgs,
    #[command(flatten)]
    document: DocumentArgs,
}

fn out_help() -> String {
    format!(
        "The file to write, in mm: meshes {}; points {}",
        Writable::Mesh.shown(),
        Writable::Points.shown()
    )
}

impl ConvertArgs {
    fn request(&self) -> ConvertRequest {
        ConvertRequest {
            input: self.input.clone(),
            out: self.out.clone(),
            reading: self.reading.reading(),
            chord: self.chord,
        }
    }
}

impl Run for ConvertArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        Ok(self.request().files(&FileSources)?.document(self.document.json.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        task::run(&self.request(), &self.document, common, |done| table(&done.document))
    }
}

fn table(d: &ConvertDocument) -> String {
    let mut rows: Vec<(&str, String)> = vec![];
    for input in &d.inputs {
        rows.push(("read", format!("{}  ({}, {})", input.path, input.format, input.unit_assumed)));
        rows.extend(input.warnings.iter().map(|w| ("!", w.clone())));
    }
    let facets = d.facets.map(|n| format!(", {}", counted(n, FACETS))).unwrap_or_default();
    rows.push(("written", format!("{}: {}, {}{facets}", d.output, d.written, counted(d.points, POINTS))));
    if let Some(moved) = d.farthest_moved.filter(|x| *x > 0.0) {
        rows.push(("rounded", format!("coordinates by up to {} mm", short(moved))));
    }
    rows.extend(d.lost.iter().map(|what| ("lost", what.clone())));
    rows.into_iter().map(|(name, text)| format!("{name:<8} {text}\n")).collect()
}

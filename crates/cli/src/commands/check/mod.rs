//! `trueness check`: is this mesh sound, and if not, where not?

mod table;

use crate::command::Run;
use crate::exit::{self, Outcome, Usage, not_negative};
use crate::options::{Common, DocumentArgs, InputArgs, weld};
use crate::progress::Stage;
use crate::read;
use crate::report::ReportArgs;
use crate::run_files::RunFiles;
use clap::Args;
use std::path::PathBuf;
use trueness_document::Role;
use trueness_files::ReadOptions;
use trueness_geom::check::{self, CheckError, Options};
use trueness_measure::file_numbers::LeftOut;
use trueness_report::views::check::View;

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
    fn options(&self) -> Result<Options, Usage> {
        Ok(Options {
            limit: self.items,
            self_intersections: !self.no_self_intersections,
            gap: self.gap.map(|x| not_negative("gap", x)).transpose()?,
            sliver_angle: not_negative("sliver-angle", self.sliver_angle)?.min(60.0).to_radians(),
            island_share: not_negative("island", self.island)? / 100.0,
        })
    }
}

impl Run for CheckArgs {
    fn files(&self) -> anyhow::Result<RunFiles> {
        Ok(RunFiles::of([&self.mesh]).document(self.document.json.as_ref()).report(self.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

fn run(args: &CheckArgs, common: &Common) -> anyhow::Result<Outcome> {
    let options = args.options()?;
    let reading = ReadOptions { weld: weld(args.weld)?, ..args.input.reading() };
    let (source, mut record) = read::mesh(&args.mesh, Role::Mesh, &reading)?;
    let facets = source.mesh.faces.len() as u64;
    let stage = Stage::new(common.progress, "checking", "facets", Some(facets));
    let (hash, report) = rayon::join(
        || read::hash(&mut record, &args.mesh),
        || check::check(&source.mesh, source.stored_normals.as_deref(), &options, &stage),
    );
    stage.end(&report);
    let report = report.map_err(|e| match e {
        CheckError::Cancelled(e) => e.into(),
        e => anyhow::anyhow!("{}: {e}", args.mesh.display()),
    })?;
    hash?;
    let left_out = LeftOut(&source.nonfinite_facets);
    let document = trueness_measure::check::document(&report, record, facets, left_out, &options);
    if args.report.html.is_some() {
        let view = View::new(&document, &document.inputs[0].path, &source.mesh, left_out);
        args.report.write(&document, &view.objects(), &view.marks, common.progress)?;
    }
    args.document.write(&document)?;
    args.document.table(|| table::text(&document, &check::KINDS))?;
    Ok(if document.sound { Outcome::Conforming } else { Outcome::NotConforming })
}

//! `trueness repair`: a mesh without its defects, and without a vertex moved.

mod table;

use crate::command::Run;
use crate::exit::{self, Outcome, Usage, not_negative};
use crate::options::{Common, DocumentArgs, InputArgs};
use crate::progress::{self, Stage};
use crate::report::ReportArgs;
use clap::Args;
use std::path::PathBuf;
use trueness::read;
use trueness::task::RunFiles;
use trueness_document::Role;
use trueness_document::repair::OutputRecord;
use trueness_files::FileSources;
use trueness_files::write::{MeshFile, Writable};
use trueness_geom::check;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_measure::repair::{Around, at_least, defects, document};
use trueness_report::views::repair::View;
use trueness_solid::repair::{self, Holes, Options, RepairError, Repaired, STEPS, Step};

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
    /// Where the mended mesh goes.
    fn target(&self) -> &PathBuf {
        self.out.as_ref().unwrap_or(&self.mesh)
    }

    fn options(&self) -> Result<Options, Usage> {
        let (only, skip) = (names("only", &self.only)?, names("skip", &self.skip)?);
        let wanted = |s: &&'static Step| (only.is_empty() || only.contains(s)) && !skip.contains(s);
        Ok(Options {
            steps: STEPS.into_iter().filter(wanted).collect(),
            gap: self.gap.map(|x| not_negative("gap", x)).transpose()?,
            stitch: self.stitch.map(|x| not_negative("stitch", x)).transpose()?,
            islands: (self.remove_islands.map(|x| not_negative("remove-islands", x)).transpose()?)
                .map(|x| x / 100.0),
            single: self.target().extension().is_some_and(|e| e.eq_ignore_ascii_case("stl")),
            holes: match self.all_holes {
                true => Holes::All,
                false => Holes::UpTo(not_negative("holes", self.holes)? / 100.0),
            },
        })
    }
}

/// The steps of these names.
fn names(option: &str, given: &[String]) -> Result<Vec<&'static Step>, Usage> {
    let find = |name: &String| {
        repair::step(&name.replace('-', "_")).ok_or_else(|| {
            let known: Vec<&str> = STEPS.iter().map(|s| s.name).collect();
            Usage(format!("--{option} {name}: there is no such step; there are {}", known.join(", ")))
        })
    };
    given.iter().map(find).collect()
}

fn out_help() -> String {
    format!("The mended mesh, in mm: {}; STL holds single precision only", Writable::Mesh.shown())
}

impl Run for RepairArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        Ok(RunFiles::of([&self.mesh])
            .in_place(self.in_place)
            .out(Some(self.target()), Writable::Mesh)
            .document(self.document.json.as_ref())
            .report(self.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

fn run(args: &RepairArgs, common: &Common) -> anyhow::Result<Outcome> {
    let options = args.options()?;
    let max_change = not_negative("max-change", args.max_change)? / 100.0;
    let (source, mut record) =
        read::mesh(&FileSources, &args.mesh, Role::Mesh, &args.input.reading().options())?;
    if !source.unread.is_empty() {
        record.warnings.push(lost(&source.unread));
    }
    let stage = Stage::new(common.progress, "repairing", progress::STEPS, None);
    let repaired = repair::repair(&source.mesh, &options, &stage).map_err(|e| match e {
        RepairError::Cancelled(e) => e.into(),
        e => anyhow::anyhow!("{}: {e}", args.mesh.display()),
    })?;
    drop(stage);
    let stage = Stage::new(common.progress, "measuring", progress::STEPS, None);
    // One after the other the bytes of a file leave all threads but one idle.
    let write = || -> anyhow::Result<MeshFile> {
        read::hash(&FileSources, &mut record, &args.mesh)?;
        Ok(MeshFile::write(args.target(), &repaired.mesh)?)
    };
    let (deviation, file) = rayon::join(|| repaired.deviation(&source.mesh, &stage), write);
    let mut file = file?;
    drop(stage);
    let stage = Stage::new(common.progress, "checking the file", progress::STEPS, None);
    let output = again(args, &mut file, &repaired, &stage)?;
    drop(stage);
    let left_out = source.nonfinite_facets.len() as u64;
    let around = Around { file: record, left_out, output, deviation, limit: args.items, max_change };
    let document = document(&repaired, &options, around);
    if args.report.html.is_some() {
        let view = View::new(&document, &document.inputs[0].path, &source.mesh, &repaired.mesh);
        args.report.write(&document, &view.objects(), &view.marks, common.progress)?;
    }
    file.finish()?;
    args.document.write(&document)?;
    args.document.table(|| table::text(&document))?;
    Ok(if document.sound { Outcome::Conforming } else { Outcome::NotConforming })
}

/// What the file read tells of its vertices and facets and the file written will not.
fn lost(names: &[String]) -> String {
    /// A header may name thousands.
    const NAMED: usize = 12;
    let named = names.iter().take(NAMED).map(String::as_str).collect::<Vec<_>>().join(", ");
    let more = if names.len() > NAMED { ", …" } else { "" };
    format!("the mended mesh has places and facets only; the file's other data are not in it: {named}{more}")
}

/// Reads the file written and checks it.
fn again(
    args: &RepairArgs,
    file: &mut MeshFile,
    repaired: &Repaired,
    progress: &dyn Progress,
) -> anyhow::Result<OutputRecord> {
    let back: Option<Mesh> = file.read_back()?;
    let options = check::Options { gap: args.gap, ..check::Options::default() };
    let report = match &back {
        // The same mesh has the same report.
        Some(mesh) if *mesh == repaired.mesh => Some(repaired.after.clone()),
        Some(mesh) => Some(check::check(mesh, None, &options, progress)?),
        None => None,
    };
    Ok(OutputRecord {
        path: args.target().display().to_string(),
        rounded_vertices: file.loss.moved + repaired.rounded.vertices,
        rounding: file.loss.farthest.max(repaired.rounded.farthest),
        sound: report.as_ref().map(|r| r.sound),
        sound_reason: report.is_none().then(|| "it cannot be read again".into()),
        defects: report.as_ref().map(defects).unwrap_or_default(),
        at_least: report.as_ref().map(at_least).unwrap_or_default(),
    })
}

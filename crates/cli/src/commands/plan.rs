//! `trueness plan init`: a plan proposed from the nominal.

use crate::command::Run;
use crate::console;
use crate::exit::{Outcome, Usage};
use crate::options::{Common, InputArgs};
use crate::output::whole_file;
use crate::progress::Stage;
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};
use trueness::read;
use trueness::task::RunFiles;
use trueness_document::Role;
use trueness_files::FileSources;
use trueness_geom::segment::{self, Options, SegmentError};
use trueness_measure::plan::proposal;

/// Propose an inspection plan
#[derive(Args, Debug)]
pub struct PlanArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand, Debug)]
enum What {
    Init(InitArgs),
}

/// Propose a plan: every plane, cylinder, cone and sphere of the nominal a feature, with placeholder tolerances
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness plan init nominal.stl --out part.toml")]
struct InitArgs {
    /// The nominal mesh
    nominal: PathBuf,
    #[command(flatten)]
    reading: InputArgs,
    /// Where the plan goes, a new file [default: standard output]
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Run for PlanArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        let What::Init(args) = &self.what;
        Ok(RunFiles::of([&args.nominal]).also("--out", args.out.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        let What::Init(args) = &self.what;
        init(args, common)
    }
}

fn init(args: &InitArgs, common: &Common) -> anyhow::Result<Outcome> {
    // A plan is written by hand in the end: it is never replaced.
    if let Some(path) = args.out.as_ref().filter(|path| path.exists()) {
        return Err(
            Usage(format!("--out {}: the file exists; name another or remove it", path.display())).into()
        );
    }
    let (source, _) =
        read::mesh(&FileSources, &args.nominal, Role::Reference, &args.reading.reading().options())?;
    let mesh = source.mesh;
    let stage = Stage::new(common.progress, "segmenting", "facets", Some(mesh.faces.len() as u64));
    let options = Options { seed: common.seed, ..Options::default() };
    let found = segment::mesh(&mesh, &options, &stage);
    stage.end(&found);
    let found = found.map_err(|e| match e {
        SegmentError::Cancelled(e) => anyhow::Error::from(e),
        e => anyhow::anyhow!("{}: {e}", args.nominal.display()),
    })?;
    let text = proposal(&mesh, &found, &reference(args));
    match &args.out {
        Some(path) => whole_file(path, |file| file.write_all(text.as_bytes()))?,
        None => console::document(&text)?,
    }
    Ok(Outcome::Conforming)
}

/// The nominal as the plan names it: relative to its folder where it lies beside it.
fn reference(args: &InitArgs) -> String {
    let folder = |path: &Path| match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.canonicalize().ok(),
        _ => Path::new(".").canonicalize().ok(),
    };
    let beside = args.out.as_ref().is_none_or(|out| folder(out) == folder(&args.nominal));
    let name = match beside {
        true => args.nominal.file_name().map(PathBuf::from),
        false => args.nominal.canonicalize().ok(),
    };
    name.unwrap_or_else(|| args.nominal.clone()).to_string_lossy().into_owned()
}

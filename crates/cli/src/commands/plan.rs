//! `trueness plan init`: a plan proposed from the nominal.

use crate::command::Run;
use crate::console;
use crate::options::{Common, InputArgs};
use crate::progress::Console;
use clap::{Args, Subcommand};
use std::path::PathBuf;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles};
use trueness::tasks::plan_init::PlanInitRequest;
use trueness_files::FileSources;

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

/// Propose a plan: the tolerances of a CAD model, else a feature for every plane, cylinder, cone and sphere of the nominal, with
/// placeholder tolerances
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness plan init nominal.stl --out part.toml
  trueness plan init part.stp --out part.toml
  trueness plan init part.stp --general ISO2768-mK --out part.toml")]
struct InitArgs {
    /// The nominal: a CAD model or a mesh
    nominal: PathBuf,
    #[command(flatten)]
    reading: InputArgs,
    /// General tolerances for what a CAD model states none for: f, m, c or v of ISO 2768-1, H, K or L of ISO 2768-2
    #[arg(long, value_name = "ISO2768-mK")]
    general: Option<String>,
    /// Write the plan to this file, which must not exist yet [default: stdout]
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl InitArgs {
    fn request(&self, common: &Common) -> PlanInitRequest {
        PlanInitRequest {
            nominal: self.nominal.clone(),
            reading: self.reading.reading(),
            general: self.general.clone(),
            out: self.out.clone(),
            seed: common.seed,
        }
    }
}

impl Run for PlanArgs {
    fn files(&self, common: &Common) -> anyhow::Result<RunFiles> {
        let What::Init(args) = &self.what;
        Ok(args.request(common).files(&FileSources)?)
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        let What::Init(args) = &self.what;
        let mut done = args.request(common).answer(&FileSources, &Console { style: common.progress })?;
        done.commit()?;
        if args.out.is_none() {
            console::document(&done.document.text)?;
        }
        Ok(done.outcome)
    }
}

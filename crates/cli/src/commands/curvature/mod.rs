//! `trueness curvature`: principal, mean and Gaussian curvature of a mesh or cloud.

mod table;

use crate::command::Run;
use crate::noise::NoiseArgs;
use crate::options::{Common, DocumentArgs, PointInputArgs, choice, count, number};
use crate::report::ReportArgs;
use crate::task;
use clap::Args;
use std::path::PathBuf;
use trueness::files::FileSources;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles};
use trueness::tasks::curvature::{Color, CurvatureRequest};
use trueness_files::write::Writable;

/// Compute principal, mean and Gaussian curvature at every vertex of a mesh or point of a cloud
///
/// Polynomials (jets) are fitted to the neighborhoods. A curvature is positive where the surface bends towards its normal: on a convex body
/// with outward normals, both principal curvatures are negative. A place at the boundary, or whose neighbors do not determine it, has no
/// value and is counted.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness curvature scan.stl
  trueness curvature scan.ply --radius 2 --out curvature.ply --color gaussian
  trueness curvature cloud.xyz --neighbors 60 --json curvature.json --html curvature.html")]
pub struct CurvatureArgs {
    /// A mesh, or points; `-` reads stdin
    input: PathBuf,
    /// Degree of the polynomials, 2 to 6
    #[arg(long, value_name = "D", default_value = "3", value_parser = count, allow_negative_numbers = true)]
    degree: usize,
    /// At least this many neighbors: whole rings in a mesh, the nearest ones in a cloud [default: 3 for each unknown, 30 at degree 3]
    #[arg(long, value_name = "N", conflicts_with = "radius", value_parser = count, allow_negative_numbers = true)]
    neighbors: Option<usize>,
    /// Use all neighbors within this distance, mm, which sets the scale of the curvature
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number)]
    radius: Option<f64>,
    /// Give places on a boundary values too, from the side where the surface is
    #[arg(long)]
    boundary: bool,
    #[command(flatten)]
    noise: NoiseArgs,
    #[command(flatten)]
    reading: PointInputArgs,
    #[command(flatten)]
    document: DocumentArgs,
    /// Write the vertices or points with their curvatures
    #[arg(long, value_name = "FILE", help = out_help())]
    out: Option<PathBuf>,
    /// Curvature that colors a .ply file of --out
    #[arg(long, value_parser = choice::<Color>(), value_name = "WHICH", default_value = "mean")]
    color: Color,
    #[command(flatten)]
    report: ReportArgs,
}

fn out_help() -> String {
    format!("Write the vertices or points with their curvatures ({})", Writable::Values.shown())
}

impl CurvatureArgs {
    fn request(&self, common: &Common) -> CurvatureRequest {
        CurvatureRequest {
            input: self.input.clone(),
            degree: self.degree,
            neighbors: self.neighbors,
            radius: self.radius,
            boundary: self.boundary,
            noise: self.noise.request(),
            reading: self.reading.reading(),
            out: self.out.clone(),
            color: self.color,
            seed: common.seed,
            view: self.report.html.is_some(),
        }
    }
}

impl Run for CurvatureArgs {
    fn files(&self, common: &Common) -> anyhow::Result<RunFiles> {
        let files = self.request(common).files(&FileSources)?.document(self.document.json.as_ref());
        Ok(files.report(self.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        task::run_reported(&self.request(common), (&self.document, &self.report), common, |done| {
            table::table(&done.document)
        })
    }
}

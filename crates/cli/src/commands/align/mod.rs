//! `trueness align`: the motion that brings a measured part onto its reference.

mod table;

use crate::command::Run;
use crate::exit;
use crate::options::{Common, DocumentArgs, PointInputArgs, ReferenceArgs, choice};
use crate::task;
use clap::Args;
use std::path::PathBuf;
use trueness::files::FileSources;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles, Text, ToleranceText};
use trueness::tasks::align::{AlignRequest, Axis, Method};
use trueness_files::write::Writable;

/// Brings a scan onto its reference, from any starting pose
///
/// The best fit has the least mean square distance to the surface of the reference, weighted by area where the scan is a
/// mesh; outliers do not count. Whole and partial scans, meshes and points.
#[derive(Args, Debug)]
#[command(after_help = exit::help("the result cannot be relied on: poor, ambiguous, mirrored, not held by what was measured, of a wrong unit, of few points or not settled, or out of tolerance; files are written all the same", "\
Tables of --points, one row a line, mm: of pairs, x y z measured and x y z of the reference; of 3-2-1 and rps, these six and
the direction in which the point is held. A last column, if there, is the weight.

Examples:
  trueness align scan.stl nominal.stl -o aligned.stl
  trueness align scan.ply nominal.stl --json transform.json
  trueness align scan.stl nominal.stl --from-here --lock tz,rx,ry -o aligned.stl
  trueness align scan.stl nominal.stl --scale -o aligned.stl
  trueness align scan.stl nominal.stl --method chebyshev -o aligned.stl
  trueness align scan.stl nominal.stl --method zones --tolerance 0.2 --regions regions.toml -o aligned.stl
  trueness align scan.stl nominal.stl --method rps --points rps.csv -o aligned.stl"))]
pub struct AlignArgs {
    /// The scan: a mesh or points; `-` reads stdin
    measured: PathBuf,
    /// The nominal: a mesh, which does not move
    reference: PathBuf,
    /// The scan in the frame of the reference, mm
    #[arg(short, long, value_name = "FILE", help = out_help())]
    out: Option<PathBuf>,
    /// What makes a pose the best
    #[arg(long, value_parser = choice::<Method>(), default_value = "best-fit")]
    method: Method,
    /// Table of places that belong together, for the methods other than best-fit
    #[arg(long, value_name = "FILE", required_if_eq_any = [("method", "pairs"), ("method", "3-2-1"), ("method", "rps")])]
    points: Option<PathBuf>,
    /// For zones: what deviations may be, ±T or -L,+U in mm, where no region says otherwise
    #[arg(long, value_name = "T | -L,+U", allow_hyphen_values = true)]
    tolerance: Option<Text<ToleranceText>>,
    /// For zones: regions of the reference with tolerances of their own, as for `trueness compare`
    #[arg(long, value_name = "FILE")]
    regions: Option<PathBuf>,
    /// Start from the pose in the files instead of looking for one
    #[arg(long)]
    from_here: bool,
    /// Components of the motion from here that stay zero: tx, ty, tz of the translation of the middle of the scan, rx, ry, rz of the rotation
    /// about it, in the frame of the reference; for best-fit
    #[arg(long, value_parser = choice::<Axis>(), value_delimiter = ',', value_name = "AXES", requires = "from_here", ignore_case = true)]
    lock: Vec<Axis>,
    /// Find a scale, too: how many times as large the scan has to be made; for best-fit
    #[arg(long, conflicts_with = "lock")]
    scale: bool,
    /// Let all points count, however far off they are
    #[arg(long)]
    keep_outliers: bool,
    #[command(flatten)]
    input: PointInputArgs,
    #[command(flatten)]
    of_reference: ReferenceArgs,
    #[command(flatten)]
    document: DocumentArgs,
}

fn out_help() -> String {
    format!(
        "The scan in the frame of the reference, mm: a mesh {}; points {}",
        Writable::Mesh.shown(),
        Writable::Points.shown()
    )
}

impl AlignArgs {
    fn request(&self, common: &Common) -> AlignRequest {
        AlignRequest {
            measured: self.measured.clone(),
            reference: self.reference.clone(),
            reading: self.input.reading(),
            reference_reading: self.of_reference.reading(),
            out: self.out.clone(),
            method: self.method,
            points: self.points.clone(),
            tolerance: self.tolerance.clone(),
            regions: self.regions.clone(),
            from_here: self.from_here,
            lock: self.lock.clone(),
            scale: self.scale,
            keep_outliers: self.keep_outliers,
            seed: common.seed,
        }
    }
}

impl Run for AlignArgs {
    fn files(&self, common: &Common) -> anyhow::Result<RunFiles> {
        Ok(self.request(common).files(&FileSources)?.document(self.document.json.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        task::run(&self.request(common), &self.document, common, table::text)
    }
}

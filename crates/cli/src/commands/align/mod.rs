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

/// Bring a scan onto its reference, from any starting pose
///
/// The best fit has the least mean square distance to the surface of the reference. Where the scan is a mesh, its points count by area;
/// outliers do not count. The scan may be a mesh or points, of the whole part or of a piece of it.
#[derive(Args, Debug)]
#[command(after_help = exit::help("the result cannot be relied on: poor, ambiguous, mirrored, undetermined by the measured surface, in a wrong unit, of few points or not settled; or it is out of tolerance; files are written all the same", "\
Tables of --points, one row on each line, mm. For pairs: x y z measured, then x y z of the reference. For 3-2-1 and rps: these six,
then the direction in which the point is held. A further column is the weight.

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
    /// Criterion of the best pose
    #[arg(long, value_parser = choice::<Method>(), default_value = "best-fit")]
    method: Method,
    /// Table of places that belong together, for pairs, 3-2-1 and rps
    #[arg(long, value_name = "FILE", required_if_eq_any = [("method", "pairs"), ("method", "3-2-1"), ("method", "rps")])]
    points: Option<PathBuf>,
    /// For zones: allowed deviation outside of the regions, T for ±T, or -L,+U with both signs, mm
    #[arg(long, value_name = "T | -L,+U", allow_hyphen_values = true)]
    tolerance: Option<Text<ToleranceText>>,
    /// For zones: regions of the reference with tolerances of their own, as for `trueness compare`
    #[arg(long, value_name = "FILE")]
    regions: Option<PathBuf>,
    /// Start from the pose in the files instead of searching all poses
    #[arg(long)]
    from_here: bool,
    /// For best-fit with --from-here: components of the motion that stay zero, in the frame of the reference. tx, ty, tz move the
    /// middle of the scan; rx, ry, rz turn the scan about its middle
    #[arg(long, value_parser = choice::<Axis>(), value_delimiter = ',', value_name = "AXES", requires = "from_here", ignore_case = true)]
    lock: Vec<Axis>,
    /// For best-fit: also find the factor by which the scan must be enlarged
    #[arg(long, conflicts_with = "lock")]
    scale: bool,
    /// Count all points, however far off they are
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
        "Write the scan in the frame of the reference, mm: a mesh {}; points {}",
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

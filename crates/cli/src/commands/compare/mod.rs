//! `trueness compare`: how far is every measured point from the reference?

mod output;
mod table;

use crate::command::Run;
use crate::exit;
use crate::options::{Common, PointInputArgs, ReferenceArgs, choice, count_above_zero, number};
use crate::task;
use clap::Args;
use std::path::PathBuf;
pub use table::{along, coverage, outliers, regions};
use trueness::files::FileSources;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles, Text, ToleranceText};
use trueness::tasks::compare::{CompareRequest, FacingAngle, Method, Sign};
use trueness_files::Columns;
use trueness_measure::compare::{AlongRule, Coverage, MIN_COVERAGE, OutlierRule};

/// Compare measured points or a mesh with one or several references: meshes or B-spline surfaces
///
/// Reports the deviation of every point: its exact distance to the nearest facet, or to the nearest place of the faces themselves (of a
/// CAD file, or the document of `trueness surface`). Deviations are + outside the reference and − inside. Several references are ranked by
/// their root mean square.
#[derive(Args, Debug)]
#[command(after_help = exit::help("out of tolerance, undecided or not measured, or an alignment that cannot be relied on", "\
Examples:
  trueness compare scan.ply nominal.stl
  trueness compare scan.xyz nominal.stl --tolerance -0.1,+0.2 --html report.html
  trueness compare scan.stl nominal.stl --align --tolerance 0.1
  trueness compare scan.ply fine.ply coarse.ply --sign none --json result.json
  trueness compare scan.ply nominal.stl --outliers mad:5 --facing 60 --coverage auto
  trueness compare scan.ply nominal.stl --along 0,0,1 --max-distance 2
  trueness compare scan.ply nominal.stl --tolerance 0.2 --regions regions.toml
  trueness compare part.stl nominal.stl --sample 1000000 --both --max-distance 5
  trueness compare scan.ply nominal.step --tolerance 0.05 --html report.html"))]
pub struct CompareArgs {
    /// The scan: points or a mesh (its vertices are compared); `-` reads stdin
    measured: PathBuf,
    /// The nominal, or the mesh under test: a mesh, or B-spline surfaces; several are ranked side by side
    #[arg(required = true)]
    references: Vec<PathBuf>,
    /// First bring the scan onto the first reference, by the best fit from any pose (see `trueness align`)
    #[arg(long)]
    align: bool,
    /// Method of computing distances
    #[arg(long, value_parser = choice::<Method>(), default_value = "exact")]
    method: Method,
    /// Method of telling inside from outside
    #[arg(long, value_parser = choice::<Sign>(), default_value = "auto")]
    sign: Sign,
    /// Allowed deviation, mm: T for ±T, or -L,+U with both signs; the exit status is then the verdict
    #[arg(long, value_name = "T | -L,+U", allow_hyphen_values = true)]
    tolerance: Option<Text<ToleranceText>>,
    /// Regions of the reference with tolerances of their own: a TOML file of [[region]] with `id`, `seed` or `between`, and `tolerance`
    #[arg(long, value_name = "FILE")]
    regions: Option<PathBuf>,
    /// At least this share of the points must lie within the tolerance, percent
    #[arg(
        long,
        value_name = "PERCENT",
        default_value = "100",
        requires = "tolerance",
        allow_hyphen_values = true,
        value_parser = number,
    )]
    inside: f64,
    /// Exclude (and count) points farther than this, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number)]
    max_distance: Option<f64>,
    /// Exclude (and count) points whose nearest place is a boundary edge of the reference
    #[arg(long)]
    skip_boundary: bool,
    /// Measure along lines instead of to the nearest place: along a direction, or along the normals of the reference or of the scan
    #[arg(long, value_name = "X,Y,Z | reference | measured", allow_hyphen_values = true)]
    along: Option<Text<AlongRule>>,
    /// Exclude (and count) points whose normals turn away from those of the reference by more than this, degrees
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    facing: Option<FacingAngle>,
    /// Columns of the normals in a table of points, for --facing and `--along measured` [default: nx,ny,nz]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    normals: Option<Text<Columns>>,
    /// Exclude (and count) outliers: `mad:5` beyond 5 × 1.4826 MAD from the median, `3sigma` beyond 3 σ from the mean
    #[arg(long, value_name = "RULE", allow_hyphen_values = true)]
    outliers: Option<Text<OutlierRule>>,
    /// Report the part of the reference that no point covers within this reach: `auto` (three spacings of the points) or mm;
    /// --tolerance reports it in any case
    #[arg(long, value_name = "auto | MM", allow_hyphen_values = true)]
    coverage: Option<Text<Coverage>>,
    /// The points must cover at least this share of the reference for a pass, percent; 0 where only a part is measured on purpose.
    /// With less coverage the verdict is undecided, unless it is a fail
    #[arg(long, value_name = "PERCENT", default_value_t = 100.0 * MIN_COVERAGE, allow_hyphen_values = true, value_parser = number)]
    min_coverage: f64,
    /// Name at most N worst places above the reference, and as many below; with this option the table names them too [default: 3]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000), allow_negative_numbers = true)]
    worst: Option<u16>,
    /// Compare N points spread evenly over the area of the measured mesh instead of its vertices
    #[arg(long, value_name = "N", value_parser = count_above_zero, allow_negative_numbers = true)]
    sample: Option<u64>,
    /// Compare also from the reference to the measured mesh: Hausdorff and mean distance
    #[arg(long)]
    both: bool,
    /// For several references: take the errors of the points as independent, as of points probed one by one. Without this option, paired
    /// differences allow for errors that neighbors share
    #[arg(long)]
    independent: bool,
    /// Add bootstrap intervals, a test of normality, the best distribution and Moran's I
    #[arg(long)]
    research: bool,
    /// Join vertices of the references within this distance, mm [default: only those at the same place]
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number)]
    weld: Option<f64>,
    #[command(flatten)]
    input: PointInputArgs,
    #[command(flatten)]
    of_references: ReferenceArgs,
    #[command(flatten)]
    output: output::OutputArgs,
}

impl CompareArgs {
    fn request(&self, common: &Common) -> CompareRequest {
        CompareRequest {
            measured: self.measured.clone(),
            references: self.references.clone(),
            reading: self.input.reading(),
            reference_reading: self.of_references.reading(),
            weld: self.weld,
            out: self.output.out.clone(),
            scale: self.output.scale.clone(),
            align: self.align,
            method: self.method,
            sign: self.sign,
            tolerance: self.tolerance.clone(),
            regions: self.regions.clone(),
            inside: self.inside,
            max_distance: self.max_distance,
            skip_boundary: self.skip_boundary,
            along: self.along.clone(),
            facing: self.facing,
            normals: self.normals.clone(),
            outliers: self.outliers.clone(),
            coverage: self.coverage.clone(),
            min_coverage: self.min_coverage,
            worst: self.worst,
            sample: self.sample,
            both: self.both,
            independent: self.independent,
            research: self.research,
            seed: common.seed,
            view: self.output.report.html.is_some(),
        }
    }
}

impl Run for CompareArgs {
    fn files(&self, common: &Common) -> anyhow::Result<RunFiles> {
        let output = &self.output;
        let files = self.request(common).files(&FileSources)?.document(output.document.json.as_ref());
        Ok(files.report(output.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        let output = (&self.output.document, &self.output.report);
        task::run_reported(&self.request(common), output, common, |done| {
            table::text(&done.document, common.verbose, self.worst.is_some())
        })
    }
}

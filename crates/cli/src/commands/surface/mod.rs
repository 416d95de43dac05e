//! `trueness surface`: a B-spline surface through scattered points.

mod table;

use crate::command::Run;
use crate::exit;
use crate::options::{Common, DocumentArgs, PointInputArgs, choice, number};
use crate::report::ReportArgs;
use crate::task;
use clap::Args;
use std::path::PathBuf;
use trueness::files::FileSources;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles, Text};
use trueness::tasks::surface::{Base, Gap, MAX_CORRECTIONS, Pair, SurfaceRequest, Weight};

/// Fit a B-spline surface to scattered points, with its deviation and its curvature
///
/// The surface fits by least squares. Parameters come from a base and are corrected to the nearest places. Knots are uniform, given, or as
/// many as a tolerance needs. A thin-plate term bridges areas that were not measured.
#[derive(Args, Debug)]
#[command(after_help = exit::help("the tolerance was not reached, or the surface is doubtful", "\
Examples:
  trueness surface scan.asc --spans 12x8 --step surface.stp
  trueness surface scan.ply --tolerance 0.02 --json result.json --html report.html
  trueness surface shoulder.stl --base mesh --spans 20x12 --step surface.stp --trim
  trueness surface heights.xyz --base xy --knots knots.json --fairness 0"))]
pub struct SurfaceArgs {
    /// The points, or a mesh (its vertices count); `-` reads stdin
    points: PathBuf,
    /// Degrees along u and v [default: 3x3, or the degrees of the knots]
    #[arg(long, value_name = "PxQ")]
    degree: Option<Text<Pair>>,
    /// Number of equal spans along u and v [default: 8x8; on a cylinder or sphere one for each 15°, where that is more]
    #[arg(long, value_name = "MxN", conflicts_with_all = ["knots", "tolerance"])]
    spans: Option<Text<Pair>>,
    /// Whole clamped knots, a JSON file {"u": […], "v": […]}
    #[arg(long, value_name = "FILE", conflicts_with = "tolerance")]
    knots: Option<PathBuf>,
    /// Insert knots until all points are within this distance, mm, or until only noise is left
    #[arg(long, value_name = "MM", value_parser = number, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Base that gives the parameters
    #[arg(long, value_parser = choice::<Base>(), default_value = "plane")]
    base: Base,
    /// Weight of the thin-plate term, mm²: auto, or a number (0 for none)
    #[arg(long, value_name = "W", default_value = "auto", allow_hyphen_values = true)]
    fairness: Text<Weight>,
    /// Correct the parameters to the nearest places at most this often; with --base xy never
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u8).range(0..=i64::from(MAX_CORRECTIONS)), allow_negative_numbers = true)]
    corrections: u8,
    /// Leave out, and count, points that contradict their neighbors
    #[arg(long)]
    robust: bool,
    /// Cut the surface along the outline of the points; gaps up to twice this length, mm, do not count [auto: three times the
    /// distance of neighbors]
    #[arg(long, value_name = "MM|auto", num_args = 0..=1, require_equals = true, default_missing_value = "auto")]
    trim: Option<Text<Gap>>,
    #[command(flatten)]
    input: PointInputArgs,
    #[command(flatten)]
    document: DocumentArgs,
    #[command(flatten)]
    models: Models,
    #[command(flatten)]
    report: ReportArgs,
}

/// Files that a surface can be written to.
#[derive(Args, Debug)]
#[command(next_help_heading = "Output")]
pub struct Models {
    /// Write the surface as STEP (AP214)
    #[arg(long, value_name = "FILE")]
    step: Option<PathBuf>,
    /// Write the surface as IGES (entity 128; with --trim 144)
    #[arg(long, value_name = "FILE")]
    iges: Option<PathBuf>,
    /// Write the surface as facets (.obj)
    #[arg(long, value_name = "FILE")]
    obj: Option<PathBuf>,
    /// Largest distance of the facets from the surface, mm [default: 1/10000 of its size]
    #[arg(long, value_name = "MM", requires = "obj", value_parser = number, allow_negative_numbers = true)]
    chord: Option<f64>,
}

impl SurfaceArgs {
    fn request(&self) -> SurfaceRequest {
        SurfaceRequest {
            points: self.points.clone(),
            degree: self.degree.clone(),
            spans: self.spans.clone(),
            knots: self.knots.clone(),
            tolerance: self.tolerance,
            base: self.base,
            fairness: Some(self.fairness.clone()),
            corrections: self.corrections,
            robust: self.robust,
            trim: self.trim.clone(),
            reading: self.input.reading(),
            step: self.models.step.clone(),
            iges: self.models.iges.clone(),
            obj: self.models.obj.clone(),
            chord: self.models.chord,
            view: self.report.html.is_some(),
        }
    }
}

impl Run for SurfaceArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        let files = self.request().files(&FileSources)?;
        let answers = RunFiles::default().document(self.document.json.as_ref());
        Ok(answers.report(self.report.html.as_ref()).and(files))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        task::run_reported(&self.request(), (&self.document, &self.report), common, |done| {
            table::table(&done.document)
        })
    }
}

//! `trueness segment`: planes, cylinders, cones, spheres and tori in a mesh or cloud.

use crate::command::Run;
use crate::console;
use crate::inputs;
use crate::noise::{self, NoiseArgs};
use crate::number::{FACETS, POINTS, counted, fixed, grouped, scientific};
use crate::options::{Common, DocumentArgs, PointInputArgs, choice, count, number};
use crate::report::ReportArgs;
use crate::task;
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use trueness::files::FileSources;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles};
use trueness::tasks::segment::{Element, SegmentRequest};
use trueness_document::fit::Number;
use trueness_document::segment::{PieceKind, RegionRecord, SegmentDocument};
use trueness_files::write::Writable;
use trueness_geom::shape::Quantity;
use trueness_measure::words::ToGeometry;

/// Find planes, cylinders, cones, spheres and tori in a mesh or cloud, without a nominal
///
/// Finds the regions, fits an element to each by least squares, and reports its parameters with their uncertainties. Points may lie as far
/// from an element as the noise of the data explains, or as --tolerance says.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness segment scan.stl
  trueness segment scan.ply --shapes plane,cylinder --out regions.ply
  trueness segment cloud.xyz --tolerance 0.05 --min-share 1 --json regions.json")]
pub struct SegmentArgs {
    /// A mesh, or points; `-` reads stdin
    input: PathBuf,
    /// Shapes to look for
    #[arg(
        long,
        value_parser = choice::<Element>(),
        value_delimiter = ',',
        value_name = "LIST",
        default_value = "plane,cylinder,cone,sphere,torus"
    )]
    shapes: Vec<Element>,
    /// Points within this distance belong to an element, mm [default: eight standard deviations of the estimated noise]
    #[arg(long, value_name = "MM", value_parser = number, allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Neighboring facets, or normals of points, that differ by this angle have an edge between them, degrees
    #[arg(long, value_name = "DEGREES", default_value = "32", value_parser = number, allow_negative_numbers = true)]
    crease: f64,
    /// A region has at least this share of the area, or of the points of a cloud, percent [default: 0.2, for a mesh of a drawing 0.01]
    #[arg(long, value_name = "PERCENT", value_parser = number, allow_negative_numbers = true)]
    min_share: Option<f64>,
    /// A region has at least this many measured points
    #[arg(long, value_name = "N", default_value = "0", value_parser = count, allow_negative_numbers = true)]
    min_points: usize,
    #[command(flatten)]
    reading: PointInputArgs,
    #[command(flatten)]
    noise: NoiseArgs,
    #[command(flatten)]
    document: DocumentArgs,
    /// List the facets or points of every region in the document
    #[arg(long, requires = "json")]
    members: bool,
    /// Write the facets or points with the number of their region
    #[arg(long, value_name = "FILE", help = out_help())]
    out: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArgs,
}

fn out_help() -> String {
    format!("Write the facets or points with the number of their region ({})", Writable::Regions.shown())
}

impl SegmentArgs {
    fn request(&self, common: &Common) -> SegmentRequest {
        SegmentRequest {
            input: self.input.clone(),
            shapes: self.shapes.clone(),
            tolerance: self.tolerance,
            crease: self.crease,
            min_share: self.min_share,
            min_points: self.min_points,
            reading: self.reading.reading(),
            noise: self.noise.request(),
            members: self.members,
            out: self.out.clone(),
            seed: common.seed,
            view: self.report.html.is_some(),
        }
    }
}

impl Run for SegmentArgs {
    fn files(&self, common: &Common) -> anyhow::Result<RunFiles> {
        let files = self.request(common).files(&FileSources)?.document(self.document.json.as_ref());
        Ok(files.report(self.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        task::run_reported(&self.request(common), (&self.document, &self.report), common, |done| {
            table(&done.document)
        })
    }
}

/// Rows of the table.
const MAX_REGION_ROWS: usize = 60;

/// The document for people.
fn table(document: &SegmentDocument) -> String {
    let head = ["region", "shape", "size", "share", "points", "rms", "max"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for region in document.regions.iter().take(MAX_REGION_ROWS) {
        rows.push(vec![
            region.number.to_string(),
            region.shape.to_string(),
            size(region),
            format!("{:.2} %", 100.0 * region.share),
            grouped(region.points),
            scientific(region.rms, 2),
            scientific(region.max, 2),
        ]);
    }
    let mut out = inputs::notes(&document.inputs);
    out.push_str(&console::columns(&rows));
    if document.regions.len() > MAX_REGION_ROWS {
        let _ = writeln!(out, "… and {} more", document.regions.len() - MAX_REGION_ROWS);
    }
    let what = match document.pieces {
        PieceKind::Facets => FACETS,
        PieceKind::Points => POINTS,
    };
    let _ = writeln!(
        out,
        "{}; {} of {} in none   noise {}   tolerance {}   mm and degrees",
        counted(document.regions.len() as u64, ["region", "regions"]),
        grouped(document.unassigned),
        counted(document.count, what),
        scientific(document.noise, 2),
        scientific(document.tolerance, 2)
    );
    out.push_str(&noise::line(document.shared_noise.as_ref()));
    out
}

/// What a shape is called by: its radii and angle, with their standard uncertainties.
fn size(region: &RegionRecord) -> String {
    let names = [("major_radius", "R"), ("minor_radius", "r"), ("radius", "r"), ("half_angle", "half angle")];
    let mut words = Vec::new();
    for (name, short) in names {
        // The radius of a cone is that at some place.
        let own = name != "radius" || !region.parameters.contains_key("half_angle");
        let Some(Number::One(value)) = region.parameters.get(name).filter(|_| own) else { continue };
        let is_angle = region.shape.geometry().quantity(name) == Some(Quantity::Angle);
        let scale = if is_angle { 180.0 / std::f64::consts::PI } else { 1.0 };
        let mut word = format!("{short} {}", fixed(value * scale, 4));
        if let Some(Number::One(u)) = region.uncertainty.as_ref().and_then(|u| u.get(name)) {
            let _ = write!(word, " ± {}", scientific(u * scale, 1));
        }
        words.push(word);
    }
    words.join(", ")
}

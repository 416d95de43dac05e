//! `trueness segment`: planes, cylinders, cones, spheres and tori in a mesh or cloud.

use crate::command::Run;
use crate::console;
use crate::exit::{Outcome, Usage};
use crate::noise::{self, NoiseArgs};
use crate::number::{FACETS, POINTS, counted, fixed, grouped, scientific};
use crate::options::{Common, DocumentArgs, PointInputArgs};
use crate::progress::Stage;
use crate::read::{self, Body, Opened};
use crate::report::ReportArgs;
use crate::run_files::RunFiles;
use clap::Args;
use clap::builder::PossibleValuesParser;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::LazyLock;
use trueness_document::Role;
use trueness_document::fit::Number;
use trueness_document::segment::{PieceKind, RegionRecord, SegmentDocument};
use trueness_files::write::{Pieces, Writable, regions};
use trueness_geom::mesh::Mesh;
use trueness_geom::segment::{self, KINDS, Options, SegmentError, Segmentation};
use trueness_geom::shape::{Kind, Quantity};
use trueness_measure::file_numbers::LeftOut;
use trueness_measure::noise_or_reason;
use trueness_measure::words::ToGeometry;
use trueness_report::views::segment::{View, color};

/// Planes, cylinders, cones, spheres and tori in a mesh or cloud, without a nominal
///
/// Finds the regions, fits an element to each by least squares and tells its parameters with their uncertainties. How
/// far a point may lie off is found from the noise of the data, unless --tolerance says it.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness segment scan.stl
  trueness segment scan.ply --shapes plane,cylinder --out regions.ply
  trueness segment cloud.xyz --tolerance 0.05 --min-share 1 --json regions.json")]
pub struct SegmentArgs {
    /// A mesh, or points; `-` reads stdin
    input: PathBuf,
    /// What is looked for
    #[arg(
        long,
        value_parser = PossibleValuesParser::new(names()),
        value_delimiter = ',',
        value_name = "LIST",
        default_value = ALL.as_str()
    )]
    shapes: Vec<String>,
    /// Distance up to which a point belongs to an element, mm [default: eight standard deviations of the noise found]
    #[arg(long, value_name = "MM")]
    tolerance: Option<f64>,
    /// Angle between neighboring facets, or normals of points, from which on there is an edge between them, degrees
    #[arg(long, value_name = "DEGREES", default_value = "32")]
    crease: f64,
    /// Least share of the area, or of the points of a cloud, that a region must have, percent [default: 0.2, of a drawn mesh 0.01]
    #[arg(long, value_name = "PERCENT")]
    min_share: Option<f64>,
    /// Fewest measured points of a region
    #[arg(long, value_name = "N", default_value = "0")]
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

/// What is looked for unless something else is asked for.
static ALL: LazyLock<String> = LazyLock::new(|| names().join(","));

/// The names of the shapes that can be found.
fn names() -> [&'static str; KINDS.len()] {
    KINDS.map(Kind::name)
}

impl SegmentArgs {
    fn options(&self, seed: u64) -> Options {
        Options {
            kinds: self.shapes.iter().filter_map(|name| Kind::named(name, false)).collect(),
            tolerance: self.tolerance,
            crease: self.crease.to_radians(),
            min_share: self.min_share.map(|percent| percent / 100.0),
            min_points: self.min_points,
            seed,
        }
    }
}

fn out_help() -> String {
    format!("Write the facets or points with the number of their region ({})", Writable::Regions.shown())
}

impl Run for SegmentArgs {
    fn files(&self) -> anyhow::Result<RunFiles> {
        Ok(RunFiles::of([&self.input])
            .out(self.out.as_ref(), Writable::Regions)
            .document(self.document.json.as_ref())
            .report(self.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

fn run(args: &SegmentArgs, common: &Common) -> anyhow::Result<Outcome> {
    let options = args.options(common.seed);
    let Opened { mut record, body, .. } = read::open(&args.input, Role::Measured, &args.reading.reading())?;
    let (mesh, kind, left_out) = match body {
        Body::Mesh(source) => (source.mesh, PieceKind::Facets, source.nonfinite_facets),
        Body::Points(source) => (
            Mesh { positions: read::all_points(&args.input, source)?, faces: Vec::new() },
            PieceKind::Points,
            vec![],
        ),
    };
    read::describe(&mut record, &mesh.positions);
    let pieces = match kind {
        PieceKind::Facets => Pieces::Facets(&mesh.faces),
        PieceKind::Points => Pieces::Points,
    };
    let (word, total) = match kind {
        PieceKind::Facets => ("facets", mesh.faces.len()),
        PieceKind::Points => ("points", mesh.positions.len()),
    };
    let stage = Stage::new(common.progress, "segmenting", word, Some(total as u64));
    let (hash, found) = rayon::join(
        || read::hash(&mut record, &args.input),
        || match kind {
            PieceKind::Facets => segment::mesh(&mesh, &options, &stage),
            PieceKind::Points => segment::cloud(&mesh.positions, &options, &stage),
        },
    );
    stage.end(&found);
    hash?;
    let found = found.map_err(|e| match e {
        SegmentError::Cancelled(e) => e.into(),
        e @ (SegmentError::WrongOption { .. } | SegmentError::NoKind) => Usage(e.to_string()).into(),
        e => anyhow::anyhow!("{}: {e}", args.input.display()),
    })?;
    if let Some(path) = &args.out {
        let labels: Vec<i32> = found.labels.iter().map(|&label| label as i32).collect();
        regions(path, &mesh.positions, pieces, &labels, |label| color(usize::try_from(label).ok()))?;
    }
    let members = args.members.then_some(LeftOut(&left_out));
    let noise = args
        .noise
        .found(common.progress, |stage| noise_or_reason(found.shared_noise(&mesh, common.seed, stage)))?;
    let document = trueness_measure::segment::document(&found, &noise, kind, vec![record], &options, members);
    if args.report.html.is_some() {
        let view = View::new(&document, &mesh, &found.labels);
        args.report.write(&document, &view.objects(), &view.marks, common.progress)?;
    }
    args.document.write(&document)?;
    args.document.table(|| table(&document, &found))?;
    Ok(Outcome::Conforming)
}

/// Rows of the table.
const ROWS: usize = 60;

/// The document for people.
fn table(document: &SegmentDocument, found: &Segmentation) -> String {
    let head = ["region", "shape", "size", "share", "points", "rms", "max"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for region in document.regions.iter().take(ROWS) {
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
    let mut out = read::notes(&document.inputs);
    out.push_str(&console::columns(&rows));
    if document.regions.len() > ROWS {
        let _ = writeln!(out, "… and {} more", document.regions.len() - ROWS);
    }
    let what = match document.pieces {
        PieceKind::Facets => FACETS,
        PieceKind::Points => POINTS,
    };
    let _ = writeln!(
        out,
        "{}; {} of {} in none   noise {}   tolerance {}   mm and degrees",
        counted(found.regions.len() as u64, ["region", "regions"]),
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

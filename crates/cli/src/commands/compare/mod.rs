//! `trueness compare`: how far is every measured point from the reference?

mod measured;
mod output;
mod references;
mod table;
mod words;

use crate::command::Run;
use crate::exit::{self, Outcome, Usage};
use crate::options::{Common, PointInputArgs, ReferenceArgs, weld};
use crate::progress::{STEPS, Stage};
use crate::read;
use crate::run_files::RunFiles;
use crate::tolerance::ToleranceArg;
use clap::{Args, ValueEnum};
use measured::Measured;
use output::PointFiles;
use std::path::{Path, PathBuf};
pub use table::{along, coverage, outliers, regions};
use trueness_document::align::AlignedTo;
use trueness_document::compare::{MeasuredKind, Method, Reverse, Sampling};
use trueness_document::of_percent;
use trueness_document::scale::Scale;
use trueness_document::tolerance::cannot_fail;
use trueness_files::{Columns, ReadError, ReadOptions, WriteError};
use trueness_geom::closest::QueryError;
use trueness_geom::deviation::sign_choice::SignRequest;
use trueness_geom::deviation::surface::SurfaceOptions;
use trueness_geom::mesh::Mesh;
use trueness_measure::compare::{
    self, AlongRule, Between, Coverage, Facing, Inputs, Lines, MIN_COVERAGE, Options, OutlierRule, Reference,
};
use trueness_report::views::compare::View;
use words::FacingArg;

/// Deviations of measured points (or a mesh) from one or several reference meshes or B-spline surfaces
///
/// Every point's exact distance to the nearest facet, or to the nearest place of the surfaces themselves (STEP, IGES, or the
/// document of `trueness surface`), + outside the reference, − inside, with its statistics. Several references are ranked by
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
    /// Bring the measured to the first reference first, by the best fit from any pose (see `trueness align`)
    #[arg(long)]
    align: bool,
    /// How distances are computed
    #[arg(long, value_enum, default_value = "exact")]
    method: MethodArg,
    /// How inside and outside are told apart
    #[arg(long, value_enum, default_value = "auto")]
    sign: SignArg,
    /// Allowed deviation: T for ±T, or -L,+U with both signs; the exit status is then the verdict
    #[arg(long, value_name = "T | -L,+U", allow_hyphen_values = true)]
    tolerance: Option<ToleranceArg>,
    /// Regions of the reference with tolerances of their own: a TOML file of [[region]] with id, seed or between, tolerance
    #[arg(long, value_name = "FILE")]
    regions: Option<PathBuf>,
    /// Share of the points that must lie within the tolerance, in percent
    #[arg(
        long,
        value_name = "PERCENT",
        default_value = "100",
        requires = "tolerance",
        allow_hyphen_values = true
    )]
    inside: f64,
    /// Exclude (and count) points farther than this, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    max_distance: Option<f64>,
    /// Exclude (and count) points whose nearest place is a boundary edge of the reference
    #[arg(long)]
    skip_boundary: bool,
    /// Measure along lines instead of to the nearest place: a direction, or the normals of the reference or of the measured
    #[arg(long, value_name = "X,Y,Z | reference | measured", allow_hyphen_values = true)]
    along: Option<AlongRule>,
    /// Exclude (and count) points whose normals turn away from the reference's by more than this, degrees
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    facing: Option<FacingArg>,
    /// Columns of the normals in a table of points, for --facing and --along measured [default: nx,ny,nz]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    normals: Option<Columns>,
    /// Exclude (and count) outliers: mad:5 for 5 × 1.4826 MAD from the median, 3sigma for 3 σ from the mean
    #[arg(long, value_name = "RULE", allow_hyphen_values = true)]
    outliers: Option<OutlierRule>,
    /// Tell what part of the reference no point covers within a reach: auto (three spacings of the points) or mm; --tolerance
    /// tells it in any case
    #[arg(long, value_name = "auto | MM", allow_hyphen_values = true)]
    coverage: Option<Coverage>,
    /// Share of the reference that the points must cover for a pass, in percent as --inside; 0: a part of it is measured on
    /// purpose. Where less is covered, what does not fail is undecided
    #[arg(long, value_name = "PERCENT", default_value_t = 100.0 * MIN_COVERAGE, allow_hyphen_values = true)]
    min_coverage: f64,
    /// Name at most N worst places above the reference, and as many below [default: 3; the table names them with this option]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    worst: Option<u16>,
    /// Compare N points spread evenly over the measured mesh's area instead of its vertices
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    sample: Option<u64>,
    /// Also from the reference to the measured mesh: Hausdorff and mean distance
    #[arg(long)]
    both: bool,
    /// Of several references: take the errors of the points as independent, as of points probed one by one. Without it paired differences take into
    /// account how far those of neighbors go together
    #[arg(long)]
    independent: bool,
    /// Add bootstrap intervals, a normality test, the best distribution, Moran's I
    #[arg(long)]
    research: bool,
    /// Join vertices of the references within this distance, mm [default: those at the same place]
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    weld: Option<f64>,
    #[command(flatten)]
    input: PointInputArgs,
    #[command(flatten)]
    of_references: ReferenceArgs,
    #[command(flatten)]
    output: output::OutputArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum MethodArg {
    /// The true minimum over all facets.
    Exact,
    /// The nearest-vertex method of the literature, beside the exact one.
    Paper,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum SignArg {
    /// The method that is valid for the reference.
    Auto,
    /// Angle-weighted pseudonormals.
    Pseudonormal,
    /// Generalized winding number.
    Winding,
    /// Distances without a sign.
    None,
}

impl CompareArgs {
    fn options(&self, common: &Common) -> anyhow::Result<Options> {
        let share = |name: &str, written: f64| {
            of_percent(written).map_err(|what| Usage(format!("{name} {written}: {what}")))
        };
        let required_share = share("--inside", self.inside)?;
        let min_coverage = share("--min-coverage", self.min_coverage)?;
        let max_distance = self.max_distance.unwrap_or(f64::INFINITY);
        if self.max_distance.is_some_and(|d| !(0.0..f64::INFINITY).contains(&d)) {
            return Err(Usage(format!(
                "--max-distance {max_distance}: a distance is a finite number of mm, 0 or more; without the option there is no limit"
            ))
            .into());
        }
        self.check_along()?;
        let regions = self.regions.as_deref().map(read::regions).transpose()?.unwrap_or_default();
        let zones = self.tolerance.iter().map(|t| t.0).chain(regions.iter().map(|r| r.tolerance));
        if let Some(why) = cannot_fail(max_distance, zones) {
            return Err(Usage(format!("--max-distance {max_distance}: {why}")).into());
        }
        Ok(Options {
            method: match self.method {
                MethodArg::Exact => Method::Exact,
                MethodArg::Paper => Method::Paper,
            },
            surface: SurfaceOptions {
                sign: match self.sign {
                    SignArg::Auto => SignRequest::Auto,
                    SignArg::Pseudonormal => SignRequest::Pseudonormal,
                    SignArg::Winding => SignRequest::Winding,
                    SignArg::None => SignRequest::None,
                },
                max_distance,
                skip_boundary: self.skip_boundary,
            },
            along: self.along.map(|rule| Lines::new(rule, vec![])),
            outliers: self.outliers,
            coverage: self.coverage,
            min_coverage,
            regions,
            tolerance: self.tolerance.map(|t| t.0),
            worst: self.worst.map_or(Options::default().worst, usize::from),
            required_share,
            shown: self.output.report.shown(),
            independent: self.independent,
            research: self.research,
            seed: common.seed,
            ..Options::default()
        })
    }
}

impl CompareArgs {
    /// Refuses what lines do not go with.
    fn check_along(&self) -> Result<(), Usage> {
        let measured = self.along == Some(AlongRule::Measured);
        if self.normals.is_some() && self.facing.is_none() && !measured {
            return Err(Usage("--normals is for --facing and --along measured; give one of them".into()));
        }
        match (self.along, self.method) {
            (Some(_), MethodArg::Paper) => {
                Err(Usage("--along measures along lines, --method paper to vertices; choose one".into()))
            }
            (Some(_), _) if self.both => Err(Usage(
                "--both measures to the nearest place in both directions; leave out --along".into(),
            )),
            _ => Ok(()),
        }
    }
}

impl Run for CompareArgs {
    fn files(&self) -> anyhow::Result<RunFiles> {
        let inputs = [&self.measured]
            .into_iter()
            .chain(&self.references)
            .chain(&self.output.scale)
            .chain(&self.regions);
        Ok(self.output.files(RunFiles::of(inputs), self.references.len()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

fn run(args: &CompareArgs, common: &Common) -> anyhow::Result<Outcome> {
    let mut options = args.options(common)?;
    let tolerance = options.tolerance.map(|t| [t.lower, t.upper]);
    let scale = args.output.read_scale()?.map(|s| s.for_tolerance(tolerance));
    let mut measured = Measured::open(&args.measured, &args.input.reading(), args.sample, common.seed)?;
    if args.both && measured.mesh.is_none() {
        return Err(
            Usage("--both needs a measured mesh: points have no facets to measure back to".into()).into()
        );
    }
    let reading = ReadOptions { weld: weld(args.weld)?, ..args.of_references.reading(&args.input) };
    let (opened, records) = references::open(&args.references, &reading, &options, common)?;
    let mut files = vec![measured.record.clone()];
    files.extend(records);
    let alignment = match args.align {
        true => Some(aligned(args, &mut measured, opened[0].mesh(), &files[1].path, common)?),
        false => None,
    };
    beside_points(args, &measured, &mut options)?;
    let references: Vec<Reference> =
        files[1..].iter().zip(&opened).map(|(f, r)| r.reference(f.path.clone())).collect();
    let judged = tolerance.filter(|_| options.regions.is_empty());
    let early_scale = scale.clone().or_else(|| judged.map(|t| Scale::for_deviations(0.0, Some(t))));
    let mut points_files = match &args.output.out {
        Some(path) => {
            let reasons = options.facing.is_some() || options.outliers.is_some() || options.along.is_some();
            Some(PointFiles::create(path, references.len(), early_scale, reasons)?)
        }
        None => None,
    };
    let stage =
        Stage::new(common.progress, "comparing", "points", total(&measured, &options, references.len()));
    let (hashes, found) =
        rayon::join(
            || {
                let paths = [&args.measured].into_iter().chain(&args.references);
                files.iter_mut().zip(paths).try_for_each(|(file, path)| read::hash(file, path))
            },
            || {
                compare::run(&mut *measured.points, &references, &options, &stage, |block| {
                    match &mut points_files {
                        Some(files) => files.write(block),
                        None => Ok(()),
                    }
                })
            },
        );
    stage.end(&found);
    let found = found.map_err(|e| in_file(e, &args.measured))?;
    hashes?;
    let reverse = match &measured.mesh {
        Some(mesh) if args.both => reverse(mesh, &references, &found, common)?,
        _ => vec![],
    };
    let inputs = Inputs { files, kind: measured.kind, scale, reverse, alignment, doubts: vec![] };
    let mut document = compare::document(&found, inputs, &options);
    if args.output.report.html.is_some() {
        let shown = if measured.kind == MeasuredKind::Vertices {
            found.count
        } else {
            found.shown.points.len() as u64
        };
        document.sampling = Some(Sampling { shown, total: found.count });
    }
    let drawn = measured.mesh.as_ref().filter(|_| args.sample.is_none());
    let view = View::new(&document.inputs[0].path, drawn, &references, &found);
    args.output.write_html(&document, &view, common.progress)?;
    if let Some(files) = points_files {
        files.finish(&document.scale)?;
    }
    args.output.document.write(&document)?;
    args.output.document.table(|| table::text(&document, common.verbose, args.worst.is_some()))?;
    Ok(if document.conforms() { Outcome::Conforming } else { Outcome::NotConforming })
}

/// What is asked of the measured beside its points: places on large facets for maps, normals where a rule needs them.
fn beside_points(args: &CompareArgs, measured: &Measured, options: &mut Options) -> anyhow::Result<()> {
    let mapped = options.tells_coverage();
    let vertices = measured.mesh.as_ref().filter(|_| mapped && measured.kind == MeasuredKind::Vertices);
    options.between = vertices.map(Between::of).unwrap_or_default();
    let between = options.between.normals.clone();
    let read = |what: &str| {
        let own = measured.normals(&args.measured, args.normals.as_ref(), &args.input.reading(), what);
        own.map(|own| [own, between.clone()].concat())
    };
    if args.along == Some(AlongRule::Measured) {
        options.along = Some(Lines::new(AlongRule::Measured, read("--along measured")?));
    }
    if let Some(FacingArg(angle)) = args.facing {
        options.facing = Some(Facing::new(angle.to_radians(), read("--facing")?));
    }
    Ok(())
}

/// Brings the measured to the first reference.
fn aligned(
    args: &CompareArgs,
    measured: &mut Measured,
    reference: &Mesh,
    name: &str,
    common: &Common,
) -> anyhow::Result<AlignedTo> {
    let stage = Stage::new(common.progress, "aligning", STEPS, None);
    let found = measured.align(&args.measured, reference, common.seed, &stage)?;
    Ok(trueness_measure::align::aligned_to(&found, name.into()))
}

/// Points times references, where the number of points is known.
fn total(measured: &Measured, options: &Options, references: usize) -> Option<u64> {
    let between = options.between.points.len() as u64;
    measured.points.expected().map(|n| (n + between) * references as u64)
}

/// A comparison that failed, with the file that it failed on.
fn in_file(error: compare::CompareError<ReadError, WriteError>, measured: &Path) -> anyhow::Error {
    use compare::CompareError::{NoPoints, Normals, Query, Reference, Sink, Stream};
    match error {
        Stream(e) => e.into(),
        Sink(e) => e.into(),
        Query(QueryError::Cancelled(e)) => e.into(),
        e @ (Query(_) | NoPoints | Normals { .. }) => anyhow::anyhow!("{}: {e}", measured.display()),
        e @ Reference { .. } => e.into(),
    }
}

/// Both directions together.
fn reverse(
    mesh: &Mesh,
    references: &[Reference],
    found: &compare::Comparisons,
    common: &Common,
) -> anyhow::Result<Vec<Option<Reverse>>> {
    let stage = Stage::new(common.progress, "measuring back", "points", None);
    let back = |(r, forth): (&Reference, &compare::Compared)| {
        compare::reverse(mesh, r.mesh, forth, &stage).map(Some)
    };
    let all: Result<Vec<_>, _> = references.iter().zip(&found.references).map(back).collect();
    all.map_err(|e| match e {
        compare::ReverseError::Query(QueryError::Cancelled(e)) => e.into(),
        e => e.into(),
    })
}

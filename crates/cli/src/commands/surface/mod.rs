//! `trueness surface`: a B-spline surface through scattered points.

mod knots;
mod table;
mod write;

use crate::command::Run;
use crate::exit::{self, Outcome, Usage};
use crate::options::{Common, DocumentArgs, PointInputArgs};
use crate::progress::{STEPS, Stage};
use crate::report::ReportArgs;
use anyhow::bail;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueness::read::{self, Body, Opened};
use trueness::task::RunFiles;
use trueness_document::Role;
use trueness_files::FileSources;
use trueness_geom::mesh::Mesh;
use trueness_report::views::surface::View;
use trueness_surface::{self as surface, BaseKind, Fairness, Layout, Options, SurfaceError};

/// A B-spline surface through scattered points, with its deviation and its curvature
///
/// By least squares: parameters from a base, uniform knots (or given ones, or as many as a tolerance asks for), a thin-plate term
/// that bridges what was not measured, and parameters corrected to the nearest places.
#[derive(Args, Debug)]
#[command(after_help = exit::help("the tolerance was not reached, or the surface is doubtful", "\
Examples:
  trueness surface scan.asc --spans 12x8 --step surface.stp
  trueness surface scan.ply --tolerance 0.02 --json result.json --html report.html
  trueness surface shoulder.stl --base mesh --spans 20x12 --step surface.stp --trim
  trueness surface heights.xyz --base xy --knots knots.json --fairness 0"))]
pub struct SurfaceArgs {
    /// The points, or a mesh (its vertices are taken); `-` reads stdin
    points: PathBuf,
    /// Degrees along u and v [default: 3x3, or those that the knots tell]
    #[arg(long, value_name = "PxQ", value_parser = pair)]
    degree: Option<[usize; 2]>,
    /// Equal spans along u and v [default: 8x8; on a cylinder or sphere one for each 15°, where that is more]
    #[arg(long, value_name = "MxN", value_parser = pair, conflicts_with_all = ["knots", "tolerance"])]
    spans: Option<[usize; 2]>,
    /// Whole clamped knots, a JSON file {"u": […], "v": […]}
    #[arg(long, value_name = "FILE", conflicts_with = "tolerance")]
    knots: Option<PathBuf>,
    /// Set knots until all points are within this distance, mm, or until noise is all that is left
    #[arg(long, value_name = "MM", value_parser = length, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// What the parameters are taken from
    #[arg(long, value_enum, default_value = "plane")]
    base: BaseArg,
    /// Weight of the thin-plate term, mm²: auto, or a number (0 for none)
    #[arg(long, value_name = "W", default_value = "auto", value_parser = fairness, allow_hyphen_values = true)]
    fairness: Fairness,
    /// Corrections of the parameters to the nearest places at most; with --base xy there are none
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u8).range(0..=50))]
    corrections: u8,
    /// Leave out points that contradict their neighbors; they are counted
    #[arg(long)]
    robust: bool,
    /// Cut the surface along the outline of the points; gaps up to twice this length (mm) do not count [auto: three times the
    /// distance of neighbors]
    #[arg(long, value_name = "MM|auto", num_args = 0..=1, require_equals = true, default_missing_value = "auto", value_parser = trim)]
    trim: Option<Trim>,
    #[command(flatten)]
    input: PointInputArgs,
    #[command(flatten)]
    document: DocumentArgs,
    #[command(flatten)]
    models: write::Models,
    #[command(flatten)]
    report: ReportArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum BaseArg {
    /// The least-squares plane and the minimum bounding rectangle in it.
    Plane,
    /// x and y themselves.
    Xy,
    /// The least-squares cylinder.
    Cylinder,
    /// The least-squares sphere.
    Sphere,
    /// The facets of the mesh, laid flat: for parts that fold over any plane.
    Mesh,
}

/// Half the width of the gaps that do not count.
#[derive(Clone, Copy, Debug)]
enum Trim {
    /// By the distance of neighbors.
    Auto,
    /// Millimeters.
    Reach(f64),
}

fn trim(text: &str) -> Result<Trim, String> {
    match (text, text.parse::<f64>()) {
        ("auto", _) => Ok(Trim::Auto),
        (_, Ok(reach)) if reach > 0.0 && reach.is_finite() => Ok(Trim::Reach(reach)),
        _ => Err("it is auto, or a length above 0".into()),
    }
}

fn length(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| match text.contains(',') {
        true => "write it with a decimal point, like 0.05".into(),
        false => "it is a length above 0, in millimeters".into(),
    })
}

fn pair(text: &str) -> Result<[usize; 2], String> {
    let number = |s: &str| s.parse::<usize>().map_err(|_| format!("{s:?} is no whole number; write 8x8"));
    match text.split_once(['x', 'X', '×']) {
        Some((a, b)) => Ok([number(a)?, number(b)?]),
        None => number(text).map(|n| [n, n]),
    }
}

fn fairness(text: &str) -> Result<Fairness, String> {
    match (text, text.parse::<f64>()) {
        ("auto", _) => Ok(Fairness::Auto),
        (_, Ok(w)) if w >= 0.0 && w.is_finite() => Ok(Fairness::Weight(w)),
        _ => Err("it is auto, or a number from 0 upwards".into()),
    }
}

impl SurfaceArgs {
    fn options(&self) -> anyhow::Result<Options> {
        let base = match self.base {
            BaseArg::Plane => BaseKind::Plane,
            BaseArg::Xy => BaseKind::Xy,
            BaseArg::Cylinder => BaseKind::Cylinder,
            BaseArg::Sphere => BaseKind::Sphere,
            BaseArg::Mesh => BaseKind::Mesh,
        };
        let layout = match (&self.knots, self.tolerance) {
            (Some(path), _) => Layout::Knots(knots::read(path, self.degree)?),
            (None, Some(t)) => Layout::Tolerance(t),
            (None, None) => self.spans.map_or(Layout::Auto, Layout::Spans),
        };
        Ok(Options {
            degree: self.degree.unwrap_or([3, 3]),
            layout,
            base,
            fairness: self.fairness,
            corrections: self.corrections.into(),
            robust: self.robust,
            ..Options::default()
        })
    }
}

impl Run for SurfaceArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        self.models.check_chord()?;
        let inputs = std::iter::once(&self.points).chain(&self.knots);
        let files = RunFiles::of(inputs).document(self.document.json.as_ref());
        Ok(self.models.files(files.report(self.report.html.as_ref())))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

fn run(args: &SurfaceArgs, common: &Common) -> anyhow::Result<Outcome> {
    let options = args.options()?;
    let Opened { mut record, body, planar, .. } =
        read::open(&FileSources, &args.points, Role::Measured, &args.input.reading().options())?;
    let shown = args.points.display();
    if planar {
        return Err(Usage(format!("{shown}: it has two columns; a surface needs x, y and z")).into());
    }
    let mesh = match body {
        Body::Mesh(mesh) => mesh.mesh,
        Body::Points(source) => Mesh { positions: read::all_points(&args.points, source)?, faces: vec![] },
    };
    if mesh.faces.is_empty() && options.base == BaseKind::Mesh {
        return Err(Usage(format!(
            "{shown}: --base mesh lays facets flat, and the file has none; give a mesh (STL, PLY, OBJ, OFF), or take plane, xy, cylinder or sphere"
        ))
        .into());
    }
    let points = &mesh.positions;
    read::describe(&mut record, points);
    read::hash(&FileSources, &mut record, &args.points)?;
    let stage = Stage::new(common.progress, "fitting", STEPS, None);
    let fit = surface::fit_mesh(&mesh, &options, &stage);
    let fit = fit.map_err(|e| match e {
        SurfaceError::Cancelled(e) => anyhow::Error::from(e),
        e @ (SurfaceError::Degree { .. }
        | SurfaceError::Spans { .. }
        | SurfaceError::Tolerance(_)
        | SurfaceError::Fairness(_)) => Usage(e.to_string()).into(),
        e => anyhow::anyhow!("{shown}: {e}"),
    })?;
    let outline = match args.trim {
        None => None,
        Some(Trim::Auto) => Some(fit.outline(None, &stage)?),
        Some(Trim::Reach(reach)) => Some(fit.outline(Some(reach), &stage)?),
    };
    if outline.as_ref().is_some_and(|o| o.regions.is_empty()) {
        bail!("{shown}: the points have no outline on the base to cut along; leave out --trim");
    }
    let document =
        trueness_measure::surface::document(&fit, points, &options, outline.as_ref(), vec![record]);
    drop(stage);
    if args.report.html.is_some() {
        let view = View::new(&document, &fit, outline.as_ref(), &document.inputs[0].path, points);
        args.report.write(&document, &view.objects(), &view.marks, common.progress)?;
    }
    let stage = Stage::new(common.progress, "writing the surface", STEPS, None);
    args.models.write(&fit.surface, outline.as_ref(), &stage)?;
    drop(stage);
    args.document.write(&document)?;
    args.document.table(|| table::table(&document))?;
    let out = document.tolerance.as_ref().is_some_and(|t| !t.reached);
    let doubtful = trueness_measure::surface::is_doubtful(&document.base);
    Ok(if out || doubtful { Outcome::NotConforming } else { Outcome::Conforming })
}

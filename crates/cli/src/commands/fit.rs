//! `trueness fit`: the best line, plane, circle, … through points.

use crate::command::Run;
use crate::console;
use crate::exit::{Outcome, Usage};
use crate::noise::{self, NoiseArgs};
use crate::number::{POINTS, counted, fixed, scientific};
use crate::options::{Common, DocumentArgs, PointInputArgs};
use crate::progress::Stage;
use crate::report::ReportArgs;
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, ValueEnum};
use std::fmt::Write;
use std::path::PathBuf;
use trueness::read::{self, Body, Opened};
use trueness::task::RunFiles;
use trueness_document::Role;
use trueness_document::fit::{FitDocument, Number};
use trueness_files::FileSources;
use trueness_geom::fit::{self, FitError, Method, Options};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Cancelled;
use trueness_geom::shape::Kind;
use trueness_report::views::fit::View;

/// The best line, plane, circle, ellipse, sphere, cylinder, cone or torus through points
///
/// By least squares, as the narrowest zone, as the smallest around or the largest within, or by a robust rule that
/// leaves outliers out. Points of two columns have lines and circles in the plane.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness fit bore.xyz --shape cylinder
  trueness fit face.xyz --shape plane --method minimum-zone --html report.html
  trueness fit scan_of_ball.ply --shape sphere --method robust --json result.json")]
pub struct FitArgs {
    /// The points, or a mesh (its vertices are taken); `-` reads stdin
    points: PathBuf,
    /// What is fitted
    #[arg(long, value_parser = shapes())]
    shape: String,
    /// What makes an element the best
    #[arg(long, value_enum, default_value = "gaussian")]
    method: MethodArg,
    #[command(flatten)]
    input: PointInputArgs,
    #[command(flatten)]
    noise: NoiseArgs,
    #[command(flatten)]
    document: DocumentArgs,
    #[command(flatten)]
    report: ReportArgs,
}

/// The names of all shapes, each once.
fn shapes() -> PossibleValuesParser {
    let mut names: Vec<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    names.dedup();
    names
        .into_iter()
        .map(|name| {
            let only_flat = Kind::named(name, false).is_none();
            let value = PossibleValue::new(name);
            if only_flat {
                value.help("In the plane: of points of two columns, or of x and y")
            } else {
                value
            }
        })
        .collect::<Vec<_>>()
        .into()
}

/// The shape of a name, in the plane where the points are and there is such, else as there is one.
fn shape(name: &str, planar: bool) -> anyhow::Result<Kind> {
    let known = Kind::named(name, planar).or_else(|| Kind::named(name, !planar));
    known.ok_or_else(|| Usage(format!("--shape {name} is not known")).into())
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum MethodArg {
    /// Least squares.
    Gaussian,
    /// The narrowest zone that holds all points.
    MinimumZone,
    /// The smallest circle, sphere or cylinder around all points.
    MinimumCircumscribed,
    /// The largest circle, sphere or cylinder within the points.
    MaximumInscribed,
    /// Outliers do not count.
    Robust,
}

impl From<MethodArg> for Method {
    fn from(method: MethodArg) -> Method {
        match method {
            MethodArg::Gaussian => Method::Gaussian,
            MethodArg::MinimumZone => Method::MinimumZone,
            MethodArg::MinimumCircumscribed => Method::MinimumCircumscribed,
            MethodArg::MaximumInscribed => Method::MaximumInscribed,
            MethodArg::Robust => Method::Robust,
        }
    }
}

impl Run for FitArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        Ok(RunFiles::of([&self.points])
            .document(self.document.json.as_ref())
            .report(self.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

fn run(args: &FitArgs, common: &Common) -> anyhow::Result<Outcome> {
    let Opened { mut record, body, planar, .. } =
        read::open(&FileSources, &args.points, Role::Measured, &args.input.reading().options())?;
    let scan = match body {
        Body::Mesh(mesh) => mesh.mesh,
        Body::Points(source) => {
            Mesh { positions: read::all_points(&args.points, source)?, faces: Vec::new() }
        }
    };
    let points = &scan.positions;
    read::describe(&mut record, points);
    read::hash(&FileSources, &mut record, &args.points)?;
    let options = Options { method: args.method.into(), start: None, seed: common.seed };
    let stage = Stage::new(common.progress, "fitting", "points", Some(points.len() as u64));
    let fit = fit::fit(points, shape(&args.shape, planar)?, &options, &stage);
    stage.end(&fit);
    let fit = fit.map_err(|e| match e {
        FitError::Cancelled => anyhow::Error::from(Cancelled),
        e @ FitError::NoSuchMethod { .. } => Usage(e.to_string()).into(),
        e => anyhow::anyhow!("{}: {e}", args.points.display()),
    })?;
    let noise = args
        .noise
        .found(common.progress, |stage| trueness_measure::fit::noise(&fit, &scan, common.seed, stage))?;
    let document = trueness_measure::fit::document(&fit, &noise, points, vec![record], common.seed);
    if args.report.html.is_some() {
        let view = View::new(&document, &document.inputs[0].path, &fit.shape, points);
        args.report.write(&document, &view.objects(), &view.marks, common.progress)?;
    }
    args.document.write(&document)?;
    args.document.table(|| table(&document))?;
    Ok(Outcome::Conforming)
}

/// The document for people.
fn table(document: &FitDocument) -> String {
    let uncertainty = document.uncertainty.as_ref();
    let heading = if uncertainty.is_some() { "± standard uncertainty" } else { "" };
    let mut rows = vec![vec![String::new(), "value".into(), heading.into()]];
    let shown = |n: &Number| match n {
        Number::One(x) => fixed(*x, 9),
        Number::Three(v) => v.map(|x| fixed(x, 9)).join("  "),
    };
    let small = |n: &Number| match n {
        Number::One(x) => scientific(*x, 2),
        Number::Three(v) => v.map(|x| scientific(x, 2)).join("  "),
    };
    for (name, value) in &document.parameters {
        let of_it = uncertainty.and_then(|u| u.get(name)).map_or_else(String::new, small);
        rows.push(vec![name.replace('_', " "), shown(value), of_it]);
    }
    let mut out = read::notes(&document.inputs);
    let _ = writeln!(out, "{} by {}, mm and radians", document.shape, document.method);
    out.push_str(&console::columns(&rows));
    let _ = writeln!(
        out,
        "form error {}   rms {}   {}",
        fixed(document.form_error, 9),
        fixed(document.rms, 9),
        counted(document.count, POINTS)
    );
    out.push_str(&noise::line(document.shared_noise.as_ref()));
    if document.outliers > 0 {
        let _ = writeln!(out, "{} left out", counted(document.outliers, ["outlier", "outliers"]));
    }
    if !document.touching.is_empty() {
        let points: Vec<String> = document.touching.iter().map(|t| t.point.to_string()).collect();
        let _ = writeln!(out, "touching points {}", points.join(", "));
    }
    if !document.converged {
        out.push_str("the points hardly determine it: the last digits did not settle\n");
    }
    out
}

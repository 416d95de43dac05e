//! `trueness fit`: the best line, plane, circle, … through points.

use crate::command::Common;
use crate::commands::compare::output::json_file;
use crate::exit::Outcome;
use crate::progress::Stage;
use crate::report::ReportArgs;
use crate::{console, read};
use clap::{Args, ValueEnum};
use std::fmt::Write;
use std::path::PathBuf;
use trueness_files::{Body, Columns, ReadOptions, Unit};
use trueness_geom::fit::{self, FitError, Method, Options};
use trueness_geom::progress::Cancelled;
use trueness_geom::shape::Kind;
use trueness_inspect::fit::View;
use trueness_inspect::report::Answer;
use trueness_inspect::results::Role;
use trueness_inspect::results::fit::{FitDocument, Number};

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
    #[arg(long, value_enum)]
    shape: ShapeArg,
    /// What makes an element the best
    #[arg(long, value_enum, default_value = "gaussian")]
    method: MethodArg,
    /// Unit of a file that does not say its own [default: mm]
    #[arg(long, value_name = "UNIT")]
    units: Option<Unit>,
    /// Columns of a text file, e.g. x,y,z or -,x,y,z
    #[arg(long, value_name = "LIST")]
    columns: Option<Columns>,
    /// Write the result document; `-` for stdout, then without a table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ShapeArg {
    Line,
    Plane,
    Circle,
    /// In the plane: of points of two columns, or of x and y.
    Ellipse,
    Sphere,
    Cylinder,
    Cone,
    Torus,
}

impl ShapeArg {
    fn kind(self, planar: bool) -> Kind {
        match self {
            ShapeArg::Line if planar => Kind::Line2,
            ShapeArg::Line => Kind::Line,
            ShapeArg::Plane => Kind::Plane,
            ShapeArg::Circle if planar => Kind::Circle2,
            ShapeArg::Circle => Kind::Circle,
            ShapeArg::Ellipse => Kind::Ellipse2,
            ShapeArg::Sphere => Kind::Sphere,
            ShapeArg::Cylinder => Kind::Cylinder,
            ShapeArg::Cone => Kind::Cone,
            ShapeArg::Torus => Kind::Torus,
        }
    }
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

/// Runs the command.
pub fn run(args: &FitArgs, common: &Common) -> anyhow::Result<Outcome> {
    let reading = ReadOptions { units: args.units, columns: args.columns.clone(), ..ReadOptions::default() };
    let input = trueness_files::open(&args.points, &reading)?;
    let mut record = read::record(Role::Measured, &input.provenance, &input.warnings);
    let planar = input.provenance.planar;
    let points = match input.body {
        Body::Mesh(mesh) => {
            record.facets = Some(mesh.mesh.faces.len() as u64);
            mesh.mesh.positions
        }
        Body::Points(source) => read::all_points(source)?,
    };
    record.points = points.len() as u64;
    read::hash(&mut record)?;
    let options = Options { method: args.method.into(), start: None, seed: common.seed };
    let stage = Stage::new(common.progress, "fitting", "points", Some(points.len() as u64));
    let fit = fit::fit(&points, args.shape.kind(planar), &options, &stage);
    drop(stage);
    let fit = fit.map_err(|e| match e {
        FitError::Cancelled => anyhow::Error::from(Cancelled),
        e => anyhow::anyhow!("{}: {e}", args.points.display()),
    })?;
    let document = trueness_inspect::fit::document(&fit, &points, vec![record], common.seed);
    let on_stdout = json_file(args.json.as_deref(), &document)?;
    if args.report.html.is_some() {
        let view = View::new(&document, &document.inputs[0].path, &fit.shape, &points);
        args.report.write(Answer::Fit(&document), &view.objects(), &view.marks)?;
    }
    if !on_stdout {
        console::table(&table(&document));
    }
    Ok(Outcome::Conforming)
}

/// The document for people.
fn table(document: &FitDocument) -> String {
    let mut rows = vec![vec![String::new(), "value".into(), "± standard uncertainty".into()]];
    let shown = |n: &Number| match n {
        Number::One(x) => format!("{x:.9}"),
        Number::Three(v) => v.map(|x| format!("{x:.9}")).join("  "),
    };
    let small = |n: &Number| match n {
        Number::One(x) => format!("{x:.2e}"),
        Number::Three(v) => v.map(|x| format!("{x:.2e}")).join("  "),
    };
    for (name, value) in &document.parameters {
        let uncertainty = document.uncertainty.as_ref().and_then(|u| u.get(name));
        rows.push(vec![name.replace('_', " "), shown(value), uncertainty.map_or_else(String::new, small)]);
    }
    let mut out = format!("{} by {}, mm and radians\n", document.shape, document.method);
    out.push_str(&console::columns(&rows));
    let _ = writeln!(
        out,
        "form error {:.9}   rms {:.9}   {} points",
        document.form_error,
        document.rms,
        console::grouped(document.count)
    );
    if document.outliers > 0 {
        let _ = writeln!(out, "{} outliers left out", console::grouped(document.outliers));
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

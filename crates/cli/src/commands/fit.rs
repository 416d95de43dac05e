//! `trueness fit`: the best line, plane, circle, … through points.

use crate::command::Run;
use crate::console;
use crate::inputs;
use crate::noise::{self, NoiseArgs};
use crate::number::{POINTS, counted, fixed, scientific};
use crate::options::{Common, DocumentArgs, PointInputArgs, choice};
use crate::report::ReportArgs;
use crate::task;
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use trueness::files::FileSources;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles};
use trueness::tasks::fit::{Element, FitRequest, Method};
use trueness_document::fit::{FitDocument, Number};

/// Fit a line, plane, circle, ellipse, sphere, cylinder, cone or torus to points
///
/// The element fits by least squares, as the narrowest zone, as the smallest around or the largest within the points, or by a robust rule
/// that leaves outliers out. Points of two columns give lines, circles and ellipses in the plane.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness fit bore.xyz --shape cylinder
  trueness fit face.xyz --shape plane --method minimum-zone --html report.html
  trueness fit scan_of_ball.ply --shape sphere --method robust --json result.json")]
pub struct FitArgs {
    /// The points, or a mesh (its vertices count); `-` reads stdin
    points: PathBuf,
    /// Shape of the element
    #[arg(long, value_parser = choice::<Element>())]
    shape: Element,
    /// Criterion of the best element
    #[arg(long, value_parser = choice::<Method>(), default_value = "gaussian")]
    method: Method,
    #[command(flatten)]
    input: PointInputArgs,
    #[command(flatten)]
    noise: NoiseArgs,
    #[command(flatten)]
    document: DocumentArgs,
    #[command(flatten)]
    report: ReportArgs,
}

impl FitArgs {
    fn request(&self, common: &Common) -> FitRequest {
        FitRequest {
            points: self.points.clone(),
            shape: Some(self.shape),
            method: self.method,
            reading: self.input.reading(),
            noise: self.noise.request(),
            seed: common.seed,
            view: self.report.html.is_some(),
        }
    }
}

impl Run for FitArgs {
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
    let mut out = inputs::notes(&document.inputs);
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

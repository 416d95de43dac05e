//! `trueness section`: the lines, arcs and curves of sections, and where they join.

mod method;
mod nominal;
mod planes;
mod table;
mod write;

use crate::command::Run;
use crate::exit;
use crate::noise::NoiseArgs;
use crate::options::{Common, DocumentArgs, PointInputArgs, choice, number};
use crate::report::ReportArgs;
use crate::task;
use clap::Args;
use std::path::PathBuf;
use trueness::files::FileSources;
use trueness::task::Outcome;
use trueness::task::{Request, RunFiles};
use trueness::tasks::section::{Continuity, NoLevel, SectionRequest, level};

/// Find the lines, arcs and curves of a section, and the exact places where they join
///
/// The section is a row of points in their order along a contour, or the cut of planes with a mesh or cloud. The command finds number and
/// kinds of the segments, refines all of them together, and reports every join with its uncertainty.
#[derive(Args, Debug)]
#[command(after_help = exit::help("out of tolerance or undecided, a segment is unreliable, a contour is doubtful, or a slab holds an area instead of contours; files are written all the same", "\
Examples:
  trueness section profile.txt
  trueness section profile.csv --noise 0.003 --dxf profile.dxf --json profile.json
  trueness section profile.csv --html report.html
  trueness section blade.csv --airfoil
  trueness section profile.csv --tidy
  trueness section profile.csv --nominal profile.dxf --fit free --tolerance 0.05
  trueness section part.stl --plane 0,0,1,12.5 --dxf at-12.5.dxf
  trueness section part.stl --stack 0,0,1,0,40,5
  trueness section scan.stl --plane 0,0,1,12.5 --nominal part.stl
  trueness section cloud.ply --plane 1,0,0,30 --thickness 0.4"))]
pub struct SectionArgs {
    /// Points in their order along the contour, of two or three columns; or, with planes, a mesh or a cloud; `-` reads stdin
    input: PathBuf,
    #[command(flatten)]
    planes: planes::PlaneArgs,
    /// Standard deviation of the points across the contour, mm [default: estimated from the data]
    #[arg(long, value_name = "MM", value_parser = number, allow_negative_numbers = true)]
    noise: Option<f64>,
    /// Continuity of all joins [default: decided by the data]
    #[arg(long, value_parser = choice::<Continuity>(), value_name = "G")]
    continuity: Option<Continuity>,
    /// The contour is closed [default: decided by the gap between its ends]
    #[arg(long, conflicts_with = "open")]
    closed: bool,
    /// The contour is open
    #[arg(long)]
    open: bool,
    /// Confidence level of the intervals, percent
    #[arg(long, value_name = "PERCENT", default_value = "95", value_parser = percent, allow_negative_numbers = true)]
    level: f64,
    /// Measure each contour as an airfoil or blade: chords, camber line, greatest thickness, radii of its edges; with
    /// --nominal, also twist and offset
    #[arg(long)]
    airfoil: bool,
    /// Stacking point of the airfoils, in the plane's coordinates of the nominal, mm [default: the centroid of the nominal profile]
    #[arg(long, value_name = "X,Y", requires = "airfoil", allow_hyphen_values = true, value_parser = place)]
    stacking: Option<[f64; 2]>,
    /// Offer relations of a drawing that the points allow: parallel lines, right angles, tangents, equal radii, common
    /// centers, whole numbers; the contour itself does not change
    #[arg(long)]
    tidy: bool,
    #[command(flatten)]
    shared: NoiseArgs,
    #[command(flatten)]
    method: method::MethodArgs,
    #[command(flatten)]
    nominal: nominal::NominalArgs,
    #[command(flatten)]
    file: PointInputArgs,
    #[command(flatten)]
    document: DocumentArgs,
    #[command(flatten)]
    drawings: write::Drawings,
    #[command(flatten)]
    report: ReportArgs,
}

impl SectionArgs {
    fn request(&self, common: &Common) -> SectionRequest {
        let request = SectionRequest {
            input: self.input.clone(),
            reading: self.file.reading(),
            noise: self.noise,
            continuity: self.continuity,
            closed: self.closed,
            open: self.open,
            level: self.level,
            airfoil: self.airfoil,
            stacking: self.stacking,
            tidy: self.tidy,
            independence: self.shared.request(),
            seed: common.seed,
            view: self.report.html.is_some(),
            ..SectionRequest::default()
        };
        self.drawings.ask(self.nominal.ask(self.method.ask(self.planes.ask(request))))
    }
}

/// A level of confidence.
fn percent(text: &str) -> Result<f64, NoLevel> {
    level(text.parse().unwrap_or(f64::NAN))
}

/// A place in the plane.
fn place(text: &str) -> Result<[f64; 2], String> {
    let numbers =
        text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    let finite = numbers.filter(|p: &[f64; 2]| p.iter().all(|x| x.is_finite()));
    finite.ok_or_else(|| format!("‘{text}’ is no place: write two numbers in mm, such as 12.5,-3"))
}

impl Run for SectionArgs {
    fn files(&self, common: &Common) -> anyhow::Result<RunFiles> {
        let first = RunFiles::default().document(self.document.json.as_ref());
        Ok(first.report(self.report.html.as_ref()).and(self.request(common).files(&FileSources)?))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        task::run_reported(&self.request(common), (&self.document, &self.report), common, |done| {
            table::table(&done.document)
        })
    }
}
